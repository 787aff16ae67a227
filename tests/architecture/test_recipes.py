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


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return a function that runs a command line in a copy of the package with the files of the recipe."""
    tree = tmp_path_factory.mktemp("recipe")
    # compiled modules come along, but not those that another process is writing
    shutil.copytree(ROOT / "seisblock", tree / "seisblock", ignore=shutil.ignore_patterns("*.pyc.*"))
    shutil.copytree(ROOT / "sample_records", tree / "sample_records")
    files = FILE.findall(RECIPE.read_text(encoding="utf-8"))
    assert len({Path(name).parent for name, _ in files}) == 1, "a recipe of one folder"
    for name, text in files:
        (tree / name).parent.mkdir(exist_ok=True)
        (tree / name).write_text(text, encoding="utf-8")

    def run(*words):
        environment = {**os.environ, "PYTHONPATH": str(tree)}
        line = [sys.executable, "-m", "seisblock", *words]
        result = subprocess.run(line, cwd=tree, env=environment, capture_output=True, text=True, timeout=300, check=False)
        assert result.returncode == 0, result.stderr
        return result.stdout

    return run


def test_command_of_a_recipe_runs(run):
    """The line of the recipe answers with a table, a document that its schema describes, and a figure."""
    (line,) = LINE.findall(RECIPE.read_text(encoding="utf-8"))
    words = line.split()
    assert "threshold (m/s^2)" in run(*words)
    document = json.loads(run(*words, "--json"))
    assert (document["schema"], document["parameters"]["safety"]) == ("seisblock/west/1", 1.2)
    assert {result["rocks"] for result in document["results"]} == {True}
    schema = json.loads(run("schema", "west"))
    assert set(schema["$defs"]["WestParameters"]["properties"]) == set(document["parameters"])
    assert set(schema["$defs"]["WestResult"]["properties"]) - {"record_index"} == set(document["results"][0])
    run(*words, "--plot", "west.png", "--csv", "west.csv", "--quiet")


def test_model_of_a_recipe_is_found_by_every_command(run):
    """Help, options, citations, batch and map list the model without another edit."""
    assert re.search(r"^  west +Quasi-static rocking", run("--help"), re.MULTILINE)
    assert "--safety FACTOR" in run("west", "--help")
    assert "Housner" in run("cite", "west")
    assert "west" in run("batch", "--help")
    run("batch", "synthetic_jma.csv", "--bodies", "gravestone", "--solver", "west", "--out", "table.csv")
    run("map", "synthetic_jma.csv", "--width", "24cm", "--height", "72cm", "--solver", "west")
