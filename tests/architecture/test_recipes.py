"""The recipes of the documentation run: a copy of the package with the files of a recipe has its command, schema and batch."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
RECIPE = ROOT / "docs" / "developers" / "recipes" / "a_model.md"
FILE = re.compile(r"^```python\n# (seisblock/\S+\.py)\n(.*?)^```", re.MULTILINE | re.DOTALL)
LINE = re.compile(r"^\$ seisblock (.+)$", re.MULTILINE)

SCRIPT = """
import json, sys
from click.testing import CliRunner
from seisblock.cli import main
answers = [CliRunner().invoke(main, words) for words in json.loads(sys.argv[1])]
assert not any(answer.exit_code for answer in answers), [answer.output for answer in answers if answer.exit_code]
print(json.dumps([answer.stdout for answer in answers]))
"""
"""Commands in one process, as each would load its packages anew."""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return a function that runs command lines in a copy of the package with the files of the recipe, in one process."""
    tree = tmp_path_factory.mktemp("recipe")
    # compiled modules come along, but not those that another process is writing
    shutil.copytree(ROOT / "seisblock", tree / "seisblock", ignore=shutil.ignore_patterns("*.pyc.*"))
    shutil.copytree(ROOT / "sample_records", tree / "sample_records")
    files = FILE.findall(RECIPE.read_text(encoding="utf-8"))
    assert len({Path(name).parent for name, _ in files}) == 1, "a recipe of one folder"
    for name, text in files:
        (tree / name).parent.mkdir(exist_ok=True)
        (tree / name).write_text(text, encoding="utf-8")

    def run(*lines):
        words = [line.split() for line in lines]
        command = [sys.executable, "-c", SCRIPT, json.dumps(words)]
        environment = {**os.environ, "PYTHONPATH": str(tree)}
        result = subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, timeout=300, check=False)
        assert result.returncode == 0, result.stderr
        return json.loads(result.stdout)

    return run


def test_command_of_a_recipe_runs(run):
    """The line of the recipe answers with a table, a document that its schema describes, and a figure."""
    (line,) = LINE.findall(RECIPE.read_text(encoding="utf-8"))
    table, answer, schema, _ = run(line, f"{line} --json", "schema west", f"{line} --plot west.png --csv west.csv --quiet")
    assert "threshold (m/s^2)" in table
    document, schema = json.loads(answer), json.loads(schema)
    assert (document["schema"], document["parameters"]["safety"]) == ("seisblock/west/1", 1.2)
    assert {result["rocks"] for result in document["results"]} == {True}
    assert set(schema["$defs"]["WestParameters"]["properties"]) == set(document["parameters"])
    assert set(schema["$defs"]["WestResult"]["properties"]) - {"record_index"} == set(document["results"][0])


def test_model_of_a_recipe_is_found_by_every_command(run):
    """Help, options, citations, batch and map list the model without another edit."""
    commands, options, papers, solvers, *_ = run(
        "--help",
        "west --help",
        "cite west",
        "batch --help",
        "batch synthetic_jma.csv --bodies gravestone --solver west --out table.csv",
        "map synthetic_jma.csv --width 24cm --height 72cm --solver west",
    )
    assert re.search(r"^  west +Quasi-static rocking", commands, re.MULTILINE)
    assert "--safety FACTOR" in options
    assert "Housner" in papers
    assert "west" in solvers
