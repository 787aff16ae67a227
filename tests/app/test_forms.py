"""Forms of the local page: arguments of commands from the values of fields."""

import json
import re

import pytest
from click.testing import CliRunner

from seisblock.app import forms
from seisblock.app.views import python_lines
from seisblock.bodies.table import read_bodies
from seisblock.cli import main
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import use_locale
from seisblock.models.respond.options import RespondOptions
from seisblock.studies.scenario.assess import UNKNOWN_FRICTION, scenario_bodies


def test_sizes_without_unit_are_centimetres_and_a_bare_block_names_no_kind():
    form = {"object": "sizes:block", "width": "45", "height": "1.8 m", "mu": "0.3"}
    assert forms.body_arguments(form) == ["--width", "45cm", "--height", "1.8 m", "--mu", "0.3"]


def test_sizes_of_a_kind_name_it():
    form = {"object": "sizes:statue", "width": "4", "height": "9", "mu": "0.3"}
    assert forms.body_arguments(form)[4:6] == ["--kind", "statue"]


@pytest.mark.parametrize("missing", ["width", "height", "mu"])
def test_missing_size_or_friction_is_an_error_in_terms_of_the_form(missing):
    """The error of the command named options, which a form does not have."""
    form = {"object": "sizes:block", "width": "45", "height": "180", "mu": "0.3", missing: " "}
    with pytest.raises(ParameterError, match="required: fill in") as error:
        forms.body_arguments(form)
    assert "--" not in str(error.value)
    assert forms.body_arguments({**form, "width": "45", "height": "180", "mu": "", "surface": "wood/wood"})[-2:] == [
        "--surface",
        "wood/wood",
    ]


def test_fields_and_surfaces_are_in_the_language_of_the_page_and_name_no_option():
    """Fields whose help states a default were in English, as were all materials."""
    with use_locale("ja"):
        labels = [field.label for field in forms.solver_fields()] + list(forms.surface_labels().values())
    for label in labels:
        assert re.search(r"[ぁ-んァ-ヶ一-龠]", label) and "--" not in label and "既定" not in label, label
    with use_locale("en"):
        assert not [field.label for field in forms.solver_fields() if field.label.endswith(".")]


def test_bundled_body_with_its_own_values_is_named_so_that_its_ranges_apply():
    body = forms.find_body("bookcase")
    width, height = forms.size_texts(body)
    form = {"object": "bookcase", "width": width, "height": height, "mu": forms.number_text(body.mu)}
    assert forms.body_arguments(form) == ["--block", "bookcase"]
    assert forms.body_arguments({**form, "mu": "0.25"}) == ["--block", "bookcase", "--mu", "0.25"]
    assert forms.body_arguments({**form, "width": "40"})[:6] == ["--width", "40cm", "--height", f"{height}cm", "--kind", "furniture"]


def test_file_of_an_object_is_required_where_it_was_chosen():
    with pytest.raises(ParameterError, match="no file of an object"):
        forms.body_arguments({"object": forms.FILE})
    assert forms.body_arguments({"object": forms.FILE}, ("pine.toml",)) == ["--block", "pine.toml"]


@pytest.mark.parametrize(("height", "expected"), [("0", []), ("", []), ("0.5", ["--floor", "T=0.5,height=0.5"])])
def test_floor_motion_only_above_the_ground(height, expected):
    assert forms.floor_arguments({"floor": height}) == expected


def test_fields_of_solver_options_follow_the_dataclass():
    names = {field.name for field in forms.solver_fields()}
    assert names == {"mu_kinetic", "restitution", "rocking_restitution", "vertical", "gravity", "settle_s", "tenon"}
    assert names < set(RespondOptions.__dataclass_fields__)
    line = forms.solver_arguments({"option-vertical": "no", "option-restitution": " 0.2 ", "option-gravity": ""})
    assert line == ["--restitution", "0.2", "--no-vertical"]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("--block statue", {}),
        ("--block statue --mu 0.2 --restitution 0.1", {"mu": 0.2, "restitution": 0.1}),
        ("--block gravestone --surface wood/wood", {"mu": 0.5, "mu_kinetic": 0.3}),
        ("--width 45cm --height 180cm --surface wood/wood", {"mu": 0.5, "mu_kinetic": 0.3}),
        ("--width 45cm --height 180cm --mu 0.3 --mu-kinetic 0.2 --tenon 2cm", {"mu": 0.3, "mu_kinetic": 0.2, "tenon": 0.02}),
    ],
)
def test_object_of_a_scenario_is_that_of_the_response(line, expected, tmp_path, monkeypatch):
    """A bundled object lost the friction of the user, any object its kinetic friction and all other options."""
    monkeypatch.chdir(tmp_path)
    _, bodies, *others = forms.scenario_object([*line.split(), "--no-vertical", "--gravity", "9.7"], tmp_path)
    assert others == ["--no-vertical", "--gravity", "9.7"]
    (body,), _ = scenario_bodies(read_bodies([bodies]), {})
    assert {name: getattr(body.options, name) for name in expected} == expected
    assert (bodies == "statue") is (expected == {}) and body.name == ("object" if "width" in line else line.split()[1])


def test_option_that_a_scenario_lacks_is_refused(tmp_path):
    with pytest.raises(ParameterError, match="--settle has no effect with JMA intensity"):
        forms.scenario_object(["--block", "statue", "--settle", "20"], tmp_path)


def test_report_keeps_record_body_friction_and_floor():
    line = ("respond", "a.NS", "a.EW", "--width", "45cm", "--height", "180cm", "--surface", "wood/wood", "--floor", "T=0.5,height=1")
    assert forms.report_arguments((*line, "--no-vertical")) == (
        "report", "a.NS", "a.EW", "--body", "45cmx180cm", "--mu", "0.5", "--mu-kinetic", "0.3", "--floor", "T=0.5,height=1",
    )  # fmt: skip
    assert forms.options_without_report((*line, "--restitution", "0.2", "--no-vertical")) == ["--restitution 0.2", "--no-vertical"]


def test_python_lines_exist_only_where_they_give_the_same():
    sizes = ("--width", "45cm", "--height", "1.8m")
    assert "seisblock.Block(0.45, 1.8)" in python_lines(("respond", "a.csv", *sizes, "--mu", "0.3"))
    assert "mu=0.5, mu_kinetic=0.3" in python_lines(("respond", "a.csv", *sizes, "--surface", "wood/wood"))
    assert "seisblock.read(['a.NS', 'a.EW'], station='AOM008')" in python_lines(
        ("respond", "a.NS", "a.EW", "--station", "AOM008", *sizes, "--mu", "0.3")
    )
    for line in (
        ("a.csv", *sizes, "--mu", "0.3", "--restitution", "0.2"),
        ("a.csv", "--block", "bookcase"),
        ("a.csv", "--block", "boulder", "--mu", "0.3"),
        ("a.csv", "--block", "mine.toml", "--mu", "0.3"),
        ("a.NS", "b.NS", *sizes, "--mu", "0.3"),
    ):
        assert python_lines(("respond", *line)) == "", line


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    [
        ("hanmer_springs_2016", "--width", "40cm", "--height", "180cm", "--kind", "gravestone", "--mu", "0.3"),
        ("hanmer_springs_2016", "--width", "30cm", "--height", "150cm", "--surface", "wood/wood", "--no-vertical"),
        ("hanmer_springs_2016", "--block", "bookcase", "--mu", "0.25"),
        ("synthetic_knet.EW", "synthetic_knet.NS", "--width", "80cm", "--height", "200cm", "--mu", "0.6"),
    ],
)
def test_python_lines_print_the_probability_of_the_command(capsys, line):
    exec(python_lines(("respond", *line)), {})
    printed = float(capsys.readouterr().out)
    result = CliRunner().invoke(main, ["respond", *line, "--json", "--quiet"])
    assert printed == json.loads(result.stdout)["object"]["overturning_probability"] > 0.0


def test_record_options_are_those_that_were_filled_in():
    assert forms.record_options({"station": " AOM008 ", "units": "gal", "dt": ""}) == ("--station", "AOM008", "--units", "gal")


def test_scenario_of_a_collection_is_an_intensity_a_peak_or_the_record_of_the_first_tab():
    assert forms.scenario_arguments({}, ()) == ("--jma", "6+")
    assert forms.scenario_arguments({"scenario": "5-", "pga": "300", "pgv": "20", "floor": "1"}, ()) == (
        "--pga", "300", "--pgv", "20", "--floor", "T=0.5,height=1",
    )  # fmt: skip
    assert forms.scenario_arguments({"scenario": "record"}, ("a.csv",)) == ("a.csv",)
    with pytest.raises(ParameterError, match="no record in the first tab"):
        forms.scenario_arguments({"scenario": "record"}, ())


def test_friction_that_the_map_assumes_is_that_of_a_scenario():
    assert forms.UNKNOWN_FRICTION == UNKNOWN_FRICTION


def test_stations_get_a_body_with_its_friction_or_a_cemetery():
    assert forms.event_arguments({"event-object": "bookcase"}, None) == ("--block", "bookcase")
    assert forms.event_arguments({"event-object": "bookcase", "event-mu": "0.2"}, None) == ("--block", "bookcase", "--mu", "0.2")
    assert forms.event_arguments({"event-object": "survey"}, "mine.csv") == ("--cemetery", "mine.csv")
    with pytest.raises(ParameterError, match="no sheet in the tab of the survey"):
        forms.event_arguments({"event-object": "survey"}, None)
