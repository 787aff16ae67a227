"""The recipe of a format runs: a copy of the package with its file reads the sample, alone and in an archive, and lists the format."""

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
RECIPE = (ROOT / "docs" / "developers" / "recipes" / "a_format.md").read_text(encoding="utf-8")
FORMAT_FILE = re.compile(r"^```python\n# (seisblock/readers/formats/\S+\.py)\n(.*?)^```", re.MULTILINE | re.DOTALL)
SAMPLE_FILE = re.compile(r"^```\{code-block\} text\n:caption: (\S+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
LINE = re.compile(r"^\$ seisblock (.+)$", re.MULTILINE)


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """Return a copy of the package with the format file of the recipe, and its sample beside it."""
    folder = tmp_path_factory.mktemp("recipe")
    # compiled modules come along, but not those that another process is writing
    shutil.copytree(ROOT / "seisblock", folder / "seisblock", ignore=shutil.ignore_patterns("*.pyc.*"))
    shutil.copytree(ROOT / "sample_records", folder / "sample_records")
    for pattern in (FORMAT_FILE, SAMPLE_FILE):
        ((name, text),) = pattern.findall(RECIPE)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def run(tree, *words, exit_code=0):
    """Return output and messages of Python in the copy."""
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    process = subprocess.run([sys.executable, *words], cwd=tree, env=environment, capture_output=True, text=True, timeout=300, check=False)
    assert process.returncode == exit_code, process.stderr
    return process.stdout, process.stderr


def test_line_of_the_recipe_reads_the_sample(tree):
    """The document states the format, and the peaks of the sample."""
    (line,) = LINE.findall(RECIPE)
    output, _ = run(tree, "-m", "seisblock", *line.split(), "--json")
    document = json.loads(output)
    assert document["record"]["format"] == "TABLE-LOG"
    assert {row["component"]: row["pga_m_s2"] for row in document["results"]} == {"NS": 2.951, "EW": 0.322, "UD": 0.24}


def test_format_of_the_recipe_is_listed_and_found_in_archives(tree):
    """Help, errors and archives know the format; a wrong count in the header is a quality flag; ObsPy has a plug-in."""
    ((name, text),) = SAMPLE_FILE.findall(RECIPE)
    measure = ("-m", "seisblock", "measure")
    assert "TABLE-LOG" in run(tree, *measure, "--help-all")[0]
    (tree / "note.txt").write_text("abc def\n-\n")
    assert "a log of a shaking table" in run(tree, *measure, "note.txt", exit_code=3)[1]
    with zipfile.ZipFile(tree / "runs.zip", "w") as archive:
        archive.writestr("note.txt", "abc def\n-\n")
        archive.writestr(name, text.replace("SAMPLES 8", "SAMPLES 9"))
    assert "header states 9 samples, file contains 8" in run(tree, *measure, "runs.zip")[1]
    (tree / "damaged.log").write_text(text.replace("100 Hz", "fast"))
    assert "damaged.log, line 2: expected a rate such as RATE 100 Hz" in run(tree, *measure, "damaged.log", exit_code=3)[1]
    program = "from seisblock.readers.obspy_plugins import is_table_log as i, read_table_log as r; print(i('{0}'), len(r('{0}')))"
    assert run(tree, "-c", program.format(name))[0].split() == ["True", "3"]
