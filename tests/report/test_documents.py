"""JSON documents satisfy their schema, every number names its unit, and keys change only with the version."""

import json
import re
from contextlib import nullcontext
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import COMMANDS, main
from seisblock.core.i18n import lazy_gettext
from seisblock.output.json.encode import to_builtins
from seisblock.output.json.units import split_unit
from seisblock.references import REFERENCES, cited_commands, command_papers
from seisblock.report.json.registry import document_commands, document_schemas, json_schema
from tests.lengths import short_studies
from tests.readers.data_center import data_center
from tests.report.document_keys import lines, missing_lines, stored_lines

WITHOUT_DOCUMENT = {"app", "completion", "schema"}
"""Commands that serve a page, or write a script, a schema or a folder of records."""

EVERY = (
    "measure",
    "respond --width 45cm --height 180cm --mu 0.3 --runs 5",
    "respond --block gravestone --runs 0 --component all-azimuths",
    "respond --block boulder --mu 0.4 --runs 0",
    "measure synthetic_knet.EW synthetic_jma --width 24cm --height 72cm",
    "slide --mu 0.2",
    "slide --mu 0.2 synthetic_knet.EW synthetic_jma --component EW",
    "slide --mu 0.3 --component all-azimuths --vertical",
    "slide --mu 0.1,0.2 --slope 0,20 --vertical-scale 0,1",
    "rock --width 24cm --height 72cm",
    "rock --block gravestone --component EW --margin --margin-limit 1.1 --perturb 5 --restitution 0.8",
    "rock --block boulder --component all-azimuths",
    "rock --block gravestone --pga 400 --pgv 40",
    "body boulder.ply --inset 0.1",
    "jump",
    "jump --target-pga 20",
    "jump --as-printed --side short,long --drop 0,0.3",
    "uplift --width 1.2 --height 3 --frequency-vertical 8 --component NS",
    "uplift --harmonic --frequency-ratio 0.5,1",
    "uplift --harmonic --damping 0,0.05 --frequency-ratio 0.5,1 --corner 4",
    "rigid3d --width 24cm --height 72cm --mu 0.5 --window 24:30",
    "stack --window 24:25 --runs 2",
    "stack --criterion --grid 14 --contact edges --without mizubachi",
    "criteria --block gravestone",
    "criteria --block gravestone --pga 400 --frequency 1.6",
    "spectrum --steps 3",
    "spectrum --steps 2 --component all-azimuths",
    "spectrum --kind sliding --mu 0.1,0.2 --vertical --component EW",
    "spectrum --kind modes --mu 0.2,0.5 --height-over-width 1,4 --component EW",
    "overturn-rate --cemetery aoyama.csv",
    "overturn-rate --cemetery aoyama.csv --pga 400 --frequency 1,2",
    "overturn-rate --cemetery aoyama.csv synthetic_jma --both",
    "infer --rate 35/100 --cemetery aoyama.csv --frequency 1,2",
    "infer --rate 0/100 --cemetery aoyama.csv --frequency 1",
    "infer --slid 5cm --mu 0.3 --steps 3 --component EW",
    "infer --jumped 5cm --steps 2 --component EW",
    "infer --twist 1 --width 24cm --height 60cm --mu 0.5 --window 24:28 --runs 20",
    "batch --bodies gravestone --component EW --force --out FOLDER/table.csv",
    "map synthetic_knet.EW --block gravestone --mu 0.5 --runs 3",
    "map shafter_1989 --cemetery aoyama.csv",
    "fragility synthetic_jma elcentro_1940_ns.csv --width 30cm --height 1.2 --solver rock --im pgv,pga --limit rock,overturn --levels "
    "10,20,30,40,50,60,80,160 --perturb 4 --bootstrap 20 --compare 50,0.4",
    "fragility synthetic_jma elcentro_1940_ns.csv synthetic_knet.EW --mu 0.1 --solver slide --steps 16 --method ida --bootstrap 20",
    "fit shaken_block.csv --width 227mm --height 891mm --free alpha --scatter 0.05 --lapse 0.02 --runs 4",
    "paper",
    "paper tsutsui table1",
    "paper fujino1978 fig7 elcentro_1940_ns.csv",
    "validate --paper Tsutsui",
    "scenario synthetic_jma elcentro_1940_ns.csv --bodies statue --bodies gravestone --pga 400",
    "secure synthetic_jma --width 24cm --height 72cm --mu 0.5 --pga 400",
    "risk --median 60cm/s --beta 0.4 --hazard synthetic_hazard.csv --stood 1000",
    "report --body gravestone --body 60cmx100cm --window 22:29",
    "cite jump",
    "cite",
    "samples",
    "fetch --station XX.NEAR --time 2024-01-01T07:10:20 --data-center CENTER -o FOLDER/fetched",
)
"""Command lines that answer with every kind of document, and with the keys that may be missing."""

PURE_NUMBERS = re.compile(
    r"""^(
      .*_?(ratio|ratios|magnitude|count|counts|rate|interval|probability|confidence|scale|limit|steps?|index|corners?|changes|stones|points|friction_demand|friction_to_rock|friction_needed_at_landing)
    | (ratio|rate|probability|threshold_ratio|jma_intensity)_(interval|range|reinforced)
    | (first|last|nearest_flip|flips|flips_at_factor|first_fall|falls_above_first|largest_at_scale|factor|spread)  # factors on a record
    | (least|greatest|onset)_factor | factor_to_overturn
    | (size|slenderness|amplitude|inset|share|(rocking_)?restitution(_[xy])?)  # shares, and ratios of velocities
    | (alpha|beta|gamma|kappa|mu|mu_kinetic|damping|r|over_omega_v|height_over_width|b_over_h)
    | (common_error|stone_error|bias)_ln_pga | frequency_error_ln_f | momentum_error | (target_)?jma_intensity
    | share_on_corners | counts_by_kind
    | (expected|residual)_jma_intensity | both | neither | (computed|observed)_only  # numbers of stones
    | (latitude|longitude)  # degrees, under the names that maps and surveys have
    | (falls|models|(effective_)?runs|samples|seed|impacts|reversals|flights|jams|ratios_lowered|initial|year)
    | im | ((non_monotone|censored)_)?(records|motions) | exceeding | versions | without_curve  # of a fragility; the unit is its result's
    | no_answer
    | beta_(interval|alone|record_to_record|parameter|sum) | perturb | bootstrap
    | (fallen|standing|stones_saved|overturned|moved|agreement|grid)
    | years | value | weight(_after)? | levels | median | im_(from|to) | annual_rate(s|_after)? | beyond_levels_share  # units beside
    | (.*accuracy|.*brier|log_score|coefficient|weight|scatter|low|high|folds|outcomes|effective_blocks)
    )$""",
    re.VERBOSE,
)
"""Keys of numbers that have no unit."""


@pytest.fixture(scope="module")
def documents(tmp_path_factory):
    """Return a function that runs a command line once and returns its document."""
    expected, folder = {}, str(tmp_path_factory.mktemp("written"))

    def run(line):
        if line not in expected:
            with data_center() if "CENTER" in line else nullcontext() as center:
                words = line.replace("FOLDER", folder).replace("CENTER", center.url if center else "").split()
                answer = CliRunner().invoke(main, [*words, "--json"])
            assert answer.exit_code == 0, answer.stderr
            expected[line] = json.loads(answer.stdout)
        return expected[line]

    # keys and types are the point here, not how well the probabilities of `secure` are known
    with short_studies():
        yield run


@pytest.mark.parametrize("line", EVERY)
def test_documents_validate_against_their_schema(line, documents):
    """Types, required keys, and the name of the schema; null only where the schema admits it; and no key that the schema does not know."""
    schema = json_schema(line.split()[0])
    jsonschema.Draft202012Validator.check_schema(schema)
    for definition in schema["$defs"].values():
        if "properties" in definition:
            definition["additionalProperties"] = False
    invalid = jsonschema.exceptions.best_match(jsonschema.Draft202012Validator(schema).iter_errors(documents(line)))
    assert invalid is None, f"{invalid.json_path}: {invalid.message}"


@pytest.mark.parametrize("line", EVERY)
def test_citations_of_document_are_listed_by_cite(line, documents):
    """The papers of a document are among those that `cite COMMAND` prints; ``validate`` those of its cases."""
    command, cited = line.split()[0], documents(line)["citations"]
    assert len(set(cited)) == len(cited)
    assert set(cited) <= set(command_papers(command) if command in cited_commands() else REFERENCES)
    assert bool(cited) is (command not in {"samples", "fetch"})


def test_every_document_kind_has_schema_and_example(documents):
    """A command without schema writes no document; each kind of document is among those validated."""
    assert set(COMMANDS) - WITHOUT_DOCUMENT == set(document_commands())
    for command in document_commands():
        answer = [set(documents(line)["parameters"]) for line in EVERY if line.split()[0] == command]
        for kind in document_schemas(command):
            assert set(kind.parameters.__struct_fields__) in answer, f"{command}: no example of {kind.name or 'its document'}"


@pytest.mark.parametrize("command", document_commands())
def test_document_keys_equal_stored_keys(command):
    """Keys of documents equal the stored ones, or the version was increased."""
    assert missing_lines(command) == [], f"{command}: keys went or changed; raise the `version` of its DocumentSchema"
    assert stored_lines(command) == lines(command), "write the keys down: python -m tests.report.document_keys"


def test_changed_keys_are_detected(monkeypatch):
    """A renamed key, a changed type and a key that may now be missing are named; with another version they are not."""
    before = ["seisblock/slide/1", "SlideDocument.results[].slips boolean", "SlideDocument.results[].way_m number"]
    monkeypatch.setattr("tests.report.document_keys.stored_lines", lambda command: before)
    monkeypatch.setattr(
        "tests.report.document_keys.lines",
        lambda command: ["seisblock/slide/1", "SlideDocument.results[].slips? boolean", "SlideDocument.results[].way_m integer"],
    )
    assert missing_lines("slide") == before[1:]
    monkeypatch.setattr("tests.report.document_keys.lines", lambda command: ["seisblock/slide/2"])
    assert missing_lines("slide") == []


@pytest.mark.parametrize("command", document_commands())
def test_numeric_keys_name_their_unit(command):
    """In its own key, in a key above it, in a key ``unit`` beside it; or it is a pure number."""
    paths = dict(line.rsplit(" ", 1) for line in lines(command)[1:])
    silent = []
    for path, kind in paths.items():
        names = re.sub(r"\[\]|\{\}|\?", "", path).split(".")[1:]
        beside = path.rpartition(".")[0] + ".unit" in paths
        if {"number", "integer"} & set(kind.split("|")) and not (beside or any(split_unit(name)[1] for name in names)):
            silent += [] if PURE_NUMBERS.match(names[-1]) else [path]
    assert silent == []


@pytest.mark.parametrize("command", ["rock", "slide", "jump", "uplift", "stack", "measure"])
def test_schema_keys_have_descriptions(command):
    """Results carry the docstrings of the library: most keys have a description, none is left as markup."""
    definitions = json_schema(command)["$defs"]
    shapes = [shape for definition in definitions.values() for shape in definition.get("properties", {}).values()]
    rows = [shape["description"] for shape in shapes if "description" in shape]
    assert len(rows) > 0.4 * len(shapes)
    assert not [text for text in rows if ("``" in text and text.count("``") % 2) or ":class:" in text or "]_" in text]
    keys = definitions[f"{command.capitalize()}Result"]["properties"]
    assert {shape.get("unit") for key, shape in keys.items() if key.endswith("_s")} <= {"s", "m/s", "rad/s"}


def test_schema_command_prints_schema_and_list():
    """`seisblock schema rock` prints JSON; without a command the names and versions; an unknown command is a usage error."""
    printed = CliRunner().invoke(main, ["schema", "rock"])
    assert json.loads(printed.stdout) == json_schema("rock")
    assert CliRunner().invoke(main, ["schema"]).stdout.split() == [document_schemas(name)[0].schema for name in document_commands()]
    assert CliRunner().invoke(main, ["schema", "completion"]).exit_code == 2


def test_encode_handles_numpy_paths_messages_and_nan():
    """Messages, paths and numpy values are encoded; NaN is null; any other type raises."""
    values = {
        "text": lazy_gettext("{name} falls", name="A"),
        "path": Path("a/b"),
        "numbers": np.array([1.5, np.nan]),
        "flag": np.bool_(True),
    }
    assert to_builtins(values) == {"text": "A falls", "path": "a/b", "numbers": [1.5, None], "flag": True}
    with pytest.raises(NotImplementedError, match="no JSON form for complex"):
        to_builtins(1j)


def test_documents_of_several_records_index_each_result(documents):
    """One record stands by itself; of several, `record_index` is the place in the list."""
    first, two = documents("slide --mu 0.2"), documents("slide --mu 0.2 synthetic_knet.EW synthetic_jma --component EW")
    assert isinstance(first["record"], dict) and "record_index" not in first["results"][0]
    assert [record["format"] for record in two["record"]] == ["knet", "jma-csv"] or len(two["record"]) == 2
    assert [result["record_index"] for result in two["results"]] == [0, 1]
    assert list(two["results"][0])[:2] == ["record_index", "component"]
