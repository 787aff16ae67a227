"""Files that a repository host, an archive or a container engine reads."""

import json
import re
import tomllib
from pathlib import Path

import yaml

import seisblock

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PLACEHOLDER = re.compile(r"PLACEHOLDER-[A-Z-]+")
FILES = [
    *sorted((ROOT / ".github").rglob("*.*")),
    *(
        ROOT / name
        for name in (
            ".pre-commit-config.yaml",
            ".readthedocs.yaml",
            "SECURITY.md",
            "CODE_OF_CONDUCT.md",
            "codemeta.json",
            "Dockerfile",
            "paper/paper.md",
        )
    ),
]


def load_yaml(path):
    """Return a YAML file."""
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def test_yaml_files_parse():
    """Every YAML file of the host is valid."""
    assert all(load_yaml(path) for path in FILES if path.suffix in (".yml", ".yaml"))


def test_workflow_tests_the_declared_python_versions_on_three_systems():
    """The matrix contains each classifier's version, and Linux, macOS and Windows."""
    matrix = load_yaml(ROOT / ".github" / "workflows" / "tests.yml")["jobs"]["suite"]["strategy"]["matrix"]
    declared = {c.rsplit(" ", 1)[1] for c in PROJECT["project"]["classifiers"] if re.search(r":: 3\.\d+$", c)}
    assert declared <= set(matrix["python"])
    assert {system.split("-")[0] for system in matrix["os"]} == {"ubuntu", "macos", "windows"}


def test_placeholders_of_the_owner_are_the_listed_ones():
    """No address is invented: what only the owner can fill in is a placeholder, and the release page lists each."""
    result = {match for path in FILES for match in PLACEHOLDER.findall(path.read_text(encoding="utf-8"))}
    page = (ROOT / "docs" / "developers" / "release.md").read_text(encoding="utf-8")
    assert result == set(PLACEHOLDER.findall(page)) != set()


def test_paper_has_the_sections_and_length_of_its_journal():
    """JOSS asks for 750 to 1750 words and for these sections; every citation is in the bibliography."""
    text, bibliography = ((ROOT / "paper" / name).read_text(encoding="utf-8") for name in ("paper.md", "paper.bib"))
    assert {"Summary", "Statement of need", "State of the field", "Software design", "Research impact statement", "AI usage disclosure",
            "Acknowledgements", "References"} <= set(re.findall(r"^# (.+)$", text, re.MULTILINE))  # fmt: skip
    assert 750 <= len(text.split()) <= 1750
    assert set(re.findall(r"@(\w+)", text)) == set(re.findall(r"^@\w+\{(\w+),", bibliography, re.MULTILINE))


def test_metadata_agrees_with_the_package():
    """Version, licence and keywords of codemeta.json are those of the project."""
    meta = json.loads((ROOT / "codemeta.json").read_text(encoding="utf-8"))
    assert meta["version"] == seisblock.__version__
    assert meta["license"].endswith(PROJECT["project"]["license"])
    assert meta["keywords"] == PROJECT["project"]["keywords"]


def test_source_archive_contains_the_hosting_files():
    """The source archive, from which the tests must pass too, includes the files checked here."""
    included = set(PROJECT["tool"]["hatch"]["build"]["targets"]["sdist"]["include"])
    assert {path.relative_to(ROOT).parts[0] for path in FILES} <= included
