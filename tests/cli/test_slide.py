"""``seisblock slide`` answers as its issue promises, and refuses bad input in one sentence."""

from __future__ import annotations

import csv
import json
import re

import numpy as np
import pytest
from click.testing import CliRunner

import seisblock
from seisblock.bodies.sliding_base import sliding_base
from seisblock.cli import main
from seisblock.core.i18n import use_locale
from seisblock.models.slide.describe import describe, describe_base
from seisblock.models.slide.plot import figure
from seisblock.models.slide.solve import solve_slide
from seisblock.readers import read
from seisblock.records import Motion
from tests.lengths import all_but_slow

KEYS = {"component", "slips", "slip_start_s", "max_slip_m", "residual_slip_m", "slip_count", "fell_off_slope"}


def run(*arguments):
    return CliRunner().invoke(main, ["slide", *map(str, arguments)])


def answer(*arguments):
    result = run(*arguments, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def test_slide_with_mu_alone_uses_sample():
    """``seisblock slide --mu 0.2`` works as written, names its record, and fits 80 columns."""
    result = run("--mu", "0.2")
    assert result.exit_code == 0
    assert result.stdout.startswith("Record: synthetic_jma.csv (bundled, synthetic); none given.\n")
    assert "residual (cm)" in result.stdout
    assert max(map(len, result.stdout.splitlines())) <= 80


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((), "path 196.1 cm during the record, residual displacement 294.2 cm to +EW at rest"),
        (("--slope", "10", "--mu-kinetic", "0.1"), "; not at rest at the end"),
    ],
)
def test_slide_reports_slip_after_record(tmp_path, arguments, says):
    """0.3 g for 2 s over friction of 0.2: (0.1 g) 2^2/2 in the record, half as much after it; a slope that is too steep has no end."""
    path = tmp_path / "push.csv"
    path.write_text("EW\n" + "-2.9419950000\n" * 201)
    output = " ".join(run(path, "--mu", 0.2, "--units", "m/s2", "--dt", 0.01, *arguments).stdout.split())
    assert says in output
    assert "ends -" not in output


@pytest.mark.parametrize(
    ("options", "base"), [(("--vertical",), "vertical motion"), (("--vertical-scale", 0.5), "vertical motion scaled by 0.5")]
)
def test_slide_heading_states_factor_of_vertical_motion(options, base):
    """A factor of 1 is not printed."""
    assert f"Sliding, mu 0.2, kinetic 0.2, {base}\n" in run("hanmer_springs_2016", "--mu", 0.2, *options).stdout


def test_record_line_names_analytic_motion_once():
    """The format of an analytic motion is its kind."""
    text = run("sine:300gal@1.5Hz,10s", "--mu", 0.2).stdout
    assert "sine:300gal@1.5Hz,10s  analytic motion, 6001 samples, 600 Hz\n" in text


def test_slide_document_equals_solve_slide():
    """One entry per horizontal component with the promised keys, and the numbers of ``solve_slide``."""
    document = answer("--mu", "0.2", "--kappa", "0.5", "--vertical")
    assert document["schema"] == "seisblock/slide/1"
    assert document["parameters"]["mu_kinetic"] == 0.1
    assert document["parameters"]["vertical_scale"] == 1.0
    assert [entry["component"] for entry in document["results"]] == ["NS", "EW"]
    record = read("synthetic_jma.csv")
    for entry in document["results"]:
        assert set(entry) >= KEYS
        single = seisblock.solve_slide(sliding_base(0.2, kappa=0.5), seisblock.motion_of(record, entry["component"]), vertical=1.0)
        assert entry["max_slip_m"] == single.outcome.max_slip_m
        assert entry["residual_slip_m"] == single.outcome.residual_slip_m


def test_slide_component_accepts_azimuth():
    """--component 37 rotates the horizontals, and one component can be chosen."""
    assert [entry["component"] for entry in answer("--mu", "0.2", "--component", "37")["results"]] == ["37"]
    assert [entry["component"] for entry in answer("--mu", "0.2", "--component", "EW")["results"]] == ["EW"]


def test_slide_all_azimuths_reports_worst():
    """Every 5 degrees is solved on a level base; the result is the direction with the largest slip."""
    document = answer("--mu", "0.3", "--component", "all-azimuths")
    sweep = document["azimuths"]
    assert [entry["component"] for entry in sweep] == [str(5 * k) for k in range(36)]
    (worst,) = document["results"]
    assert worst["max_slip_m"] == max(entry["max_slip_m"] for entry in sweep)
    uphill = answer("--mu", "0.3", "--component", "all-azimuths", "--slope", "5")
    assert len(uphill["azimuths"]) == 72
    study = answer("--mu", "0.3,0.4", "--component", "all-azimuths")
    assert [entry["mu"] for entry in study["results"]] == [0.3, 0.4]
    assert study["results"][0]["max_slip_m"] == worst["max_slip_m"]


def test_slide_lists_and_ranges_make_study(tmp_path):
    """A range of mu times a list of kappa gives every combination as table, CSV, JSON and figure."""
    files = tmp_path / "study.csv", tmp_path / "study.png"
    document = answer("--mu", "0.05:0.20:0.05", "--kappa", "0.5,1", "--component", "NS", "--csv", files[0], "--plot", files[1])
    points = document["results"]
    assert [(p["mu"], p["kappa"]) for p in points] == [(m, k) for m in (0.05, 0.1, 0.15, 0.2) for k in (0.5, 1.0)]
    with files[0].open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["max_slip_m"]) for row in rows] == [point["max_slip_m"] for point in points]
    assert files[1].stat().st_size > 10_000
    table = run("--mu", "0.05:0.20:0.05", "--kappa", "0.5,1", "--component", "NS").stdout
    assert "κ 0.5" in table


def test_slide_study_with_vertical_reports_beta():
    """With vertical motion the study holds the ratio to the slip without it; without vertical motion there is none."""
    points = answer("--mu", "0.1,0.2", "--vertical-scale", "0,1,3", "--component", "NS")["results"]
    base = {point["mu"]: point["max_slip_m"] for point in points if point["vertical_scale"] == 0.0}
    for point in points:
        assert point["beta"] == pytest.approx(point["max_slip_m"] / base[point["mu"]], rel=1e-15)
    assert "beta" in run("--mu", "0.1,0.2", "--vertical").stdout
    assert all(point["beta"] is None for point in answer("--mu", "0.1,0.2")["results"])


def test_slide_study_counts_too_steep_slopes():
    """In a study the combinations that friction does not hold are null, and a warning counts them."""
    result = run("--mu", "0.2,0.4", "--slope", "0,15", "--component", "NS", "--json")
    points = json.loads(result.stdout)["results"]
    assert [point["holds_at_rest"] for point in points] == [True, False, True, True]
    assert points[1]["max_slip_m"] is None
    assert "1 combinations omitted" in result.stderr


@pytest.mark.parametrize(
    "extra", all_but_slow([(), ("--slope", "0:20:2", "--kappa", "0.5"), ("--slope", "5", "--slope-length", "1m", "--vertical")], {()})
)
def test_slide_draws_every_figure(tmp_path, extra):
    """Histories, the plane of fig. 16 and the slope with a foot each make a file."""
    target = tmp_path / "figure.svg"
    mu = "0.4:0.8:0.05" if "0:20:2" in extra else "0.3"
    result = run("--mu", mu, *extra, "--plot", target, "--quiet")
    assert result.exit_code == 0, result.stderr
    assert target.read_text().startswith("<?xml")
    assert result.stderr == ""


def test_slide_csv_has_both_limits_of_each_event(tmp_path):
    """--csv holds t, ground acceleration, relative motion and phase; velocity is zero in stick."""
    target = tmp_path / "history.csv"
    assert run("--mu", "0.2", "--component", "NS", "--csv", target).exit_code == 0
    with target.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert {
        "time_s",
        "ground_acceleration_m_s2",
        "acceleration_m_s2",
        "velocity_m_s",
        "displacement_m",
        "phase",
    } <= set(rows[0])
    assert {row["phase"] for row in rows} == {"stick", "slip forward", "slip backward"}
    assert all(float(row["velocity_m_s"]) == 0.0 for row in rows if row["phase"] == "stick")
    times = np.array([float(row["time_s"]) for row in rows])
    assert (np.diff(times) >= 0).all()


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        ((), 2, "friction required: give --mu"),
        (("--mu", "x"), 2, "not a number"),
        (("--mu", "0"), 3, "must be positive"),
        (("--mu", "-0.2"), 3, "must be positive"),
        (("--mu", "0.2", "--kappa", "1.2"), 3, "kappa"),
        (("--mu", "0.2", "--kappa", "0"), 3, "kappa"),
        (("--mu", "0.2", "--mu-kinetic", "0.3"), 3, "between 0 and mu"),
        (("--mu", "0.2", "--mu-kinetic", "0.1", "--kappa", "0.5"), 3, "exclude each other"),
        (("--mu", "0.2", "--slope", "90"), 3, "lie in (-90, 90)"),
        (("--mu", "0.2", "--slope", "15"), 3, "slides without any ground motion"),
        (("--mu", "0.1,0.2", "--slope", "15"), 3, "slides without any ground motion"),
        (("--mu", "0.2", "--slope-length", "1"), 3, "requires a slope"),
        (("--mu", "0.1,0.2", "--slope-length", "1"), 3, "requires a slope"),
        (("--mu", "0.2", "--slope", "5", "--slope-length", "-1"), 3, "must be positive"),
        (("--mu", "0.3", "--slope", "-5", "--one-way"), 3, "downhill"),
        (("--mu", "0.2,-0.1"), 3, "must be positive"),
        (("elcentro_1940_ns", "--mu", "0.2", "--vertical"), 3, "no vertical component"),
        (("--mu", "0.2", "--component", "UD"), 3, "vertical"),
        (("elcentro_1940_ns", "--mu", "0.2", "--component", "all-azimuths"), 3, "two horizontal"),
        (("--mu", "0.2", "--gravity", "0"), 2, "positive"),
    ],
)
def test_slide_reports_bad_input_in_one_sentence(arguments, code, says):
    """Bad input gives one sentence, exit code 2 or 3, no traceback."""
    result = run(*arguments)
    assert result.exit_code == code, result.output
    assert says in result.stderr
    assert "Traceback" not in result.stderr


def test_slide_rejects_components_of_unequal_length():
    """Horizontal and vertical motion of different lengths are one sentence."""
    with pytest.raises(seisblock.errors.ParameterError, match="differ in length"):
        seisblock.Motion.from_arrays(np.zeros(5), 0.01, vertical=np.zeros(4))


def test_slide_study_reports_progress_to_the_end():
    """A study reports the number of finished runs up to all of them."""
    collected = []
    motion = seisblock.motion_of(read("elcentro_1940_ns"), "NS")
    seisblock.studies.slide_study(
        [0.1, 0.2, 0.3], motion, kappa=[0.5, 1.0], progress=lambda result, total: collected.append((result, total)), workers=2
    )
    assert collected[-1] == (6, 6)
    assert [completed for completed, _ in collected] == sorted(completed for completed, _ in collected)


def test_slide_prints_outcome_first_or_record_name():
    """With one record the verdict is the first line; with two each part begins with the record line."""
    first = run("elcentro_1940_ns", "--mu", "0.2", "--quiet").stdout.splitlines()
    assert first[0].startswith("NS: slides, maximum displacement 3.25 mm") and first[2].startswith("elcentro_1940_ns")
    two = run("elcentro_1940_ns", "synthetic_jma", "--mu", "0.2", "--component", "NS", "--quiet").stdout.splitlines()
    assert [line[:3] for line in two if line.startswith(("elcentro", "SYN", "NS: slides"))] == ["elc", "NS:", "SYN", "NS:"]


def test_slide_csv_has_no_round_off_in_friction(tmp_path):
    """The ratio of kinetic to static friction is written as given, and so is their product."""
    path = tmp_path / "study.csv"
    assert run("--mu", "0.05,0.1", "--kappa", "0.2,0.3", "--component", "NS", "--csv", path).exit_code == 0
    with path.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [(row["kappa"], row["mu_kinetic"]) for row in rows] == [("0.2", "0.01"), ("0.3", "0.015"), ("0.2", "0.02"), ("0.3", "0.03")]


def test_slide_gives_a_small_displacement_in_mm_beside_a_path_of_cm():
    """Slips of up to 9 mm over a path of 4 cm were "0.9 cm" and "less than 0.1 cm" beside a table in mm; figures have the Greek letter."""
    motion = Motion.from_arrays(np.tile(np.sin(np.linspace(0.0, 4.0 * np.pi, 80)), 10) * 2.2, 0.01, name="EW")
    response = solve_slide(0.2, motion)
    assert response.outcome.max_slip_m < 0.01 < response.outcome.path_m
    sentence = describe(response)
    assert re.search(r"maximum displacement \d\.\d\d mm, residual displacement .* mm .*, path \d+\.\d cm", sentence), sentence
    with use_locale("en"):
        assert describe_base(response) == "mu 0.2, kinetic 0.2" and describe_base(response, in_figure=True) == "μ 0.2, kinetic 0.2"
        titles = [axis.get_title(loc="left") for axis in figure([response]).axes]
    assert any("μ 0.2, kinetic 0.2" in title for title in titles) and not any("mu 0.2" in title for title in titles)
