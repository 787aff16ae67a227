"""Pages for developers are true: versions agree, lower bounds are those of the package, named files exist."""

import functools
import os
import re
import runpy
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import seisblock
from seisblock.bodies.friction import SURFACES
from seisblock.cli import COMMANDS
from tests.public_names import PUBLIC, PUBLIC_PACKAGES

ROOT = Path(seisblock.__file__).parents[1]
PAGES = [ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PLACEHOLDERS = ("NAME", "Key")


def test_versions_agree():
    """The package, the citation and the newest entry of the changelog are of one version."""
    citation = re.search(r"^version: (.+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.M)[1]
    newest = re.search(r"^## ([\d.]+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.M)[1]
    assert seisblock.__version__ == citation == newest


def test_release_dates_agree():
    """The citation and the newest entry of the changelog have one date."""
    released = re.search(r'^date-released: "(.+)"$', (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.M)[1]
    newest = re.search(r"^## [\d.]+ \((.+)\)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.M)[1]
    assert newest in (released, "unreleased")


def test_conda_recipe_matches_project():
    """Version, Python, dependencies and the entry point of the recipe are those of the project."""
    recipe = (ROOT / "docs" / "developers" / "release.md").read_text(encoding="utf-8")
    project = PROJECT["project"]
    run = re.search(r"^  run:\n((?:    - .+\n)+)", recipe, re.M)[1]
    required = {line.removeprefix("    - ").replace("matplotlib-base", "matplotlib").replace(" ", "") for line in run.splitlines()}
    assert required == {f"python{project['requires-python']}", *project["dependencies"]}
    assert re.search(r'set version = "(.+)"', recipe)[1] == seisblock.__version__
    assert f"seisblock = {project['scripts']['seisblock']}" in recipe


def test_source_archive_contains_all_top_level_files():
    """The source archive contains every tracked file of the top level, so that the tests pass from it."""
    included = set(PROJECT["tool"]["hatch"]["build"]["targets"]["sdist"]["include"])
    looked_for = set(re.findall(r'ROOT / "([\w.-]+)"', Path(__file__).read_text(encoding="utf-8"))) - {"pyproject.toml"}
    assert looked_for | {"tests", "sample_records", ".ci", "hatch_build.py"} <= included


def test_every_version_of_the_changelog_is_dated():
    """Each heading has a date, or is marked as unreleased."""
    headings = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.M)
    assert headings
    assert [h for h in headings if not re.fullmatch(r"\d+\.\d+\.\d+ \((\d{4}-\d\d-\d\d|unreleased)\)", h)] == []


def test_layer_table_of_the_architecture_page_matches_the_import_contract():
    """The rows of the table are the layers of the contract, top first."""
    text = (ROOT / "docs" / "developers" / "architecture.md").read_text(encoding="utf-8")
    rows = [set(re.findall(r"`(\w+)`", line.split("|")[1])) for line in text.splitlines() if re.match(r"\| `\w+`", line)]
    contract = next(c for c in PROJECT["tool"]["importlinter"]["contracts"] if c["name"] == "data moves one way")
    assert rows == [{name.strip() for name in layer.split("|")} for layer in contract["layers"]]


def test_benchmarks_can_be_measured_alone():
    """The command of CONTRIBUTING without workers, since pytest-benchmark rejects parallel runs."""
    words = re.search(r"python -m (pytest tests/benchmarks \S+)", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"))[1].split()
    words[1] = "tests/benchmarks/test_animation_speed.py"
    env = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST_")}
    result = subprocess.run(
        [sys.executable, "-m", *words, "--collect-only", "-p", "no:cacheprovider"],
        cwd=ROOT,
        env=env,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stdout + result.stderr


def test_ci_runs_suite_and_slow_tests():
    """The definition of green runs the suite as in the README and the slow tests, together: files compute what both need once."""
    readme, definition = ((ROOT / name).read_text(encoding="utf-8") for name in ("README.md", ".ci/run"))
    text = re.search(r"python -m (pytest .+)", readme)[1]
    run = re.findall(r"-m (pytest -n 2 --benchmark-disable.*?)(?: --durations.*)?$", definition, re.M)
    assert run == [f'{text} -m "slow or not slow"']


@functools.cache
def repository_paths():
    """Return the files and folders of the repository, each after a slash, folders before one."""
    folders = ("seisblock", "tests", "docs", "sample_records", "paper", ".ci", ".github")
    paths = [*ROOT.glob("*"), *(path for folder in folders for path in (ROOT / folder).rglob("*"))]
    return ["/" + path.relative_to(ROOT).as_posix() + "/" * path.is_dir() for path in paths]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_paths_in_pages_exist(page):
    """Every path in a page leads to a file or folder of the repository."""
    text = set(re.findall(r"`((?:[\w.]+/)+[\w.]*|\w+\.(?:py|md|toml|pyi|cff))`", page.read_text(encoding="utf-8")))
    text -= {name for name in text if any(word in name for word in PLACEHOLDERS)} | set(SURFACES)
    assert sorted(name for name in text if name != "utils.py" and not any(path.endswith("/" + name) for path in repository_paths())) == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_in_pages_exist(page):
    """Every picture and every link to a file is there."""
    links = [link for link in re.findall(r"\]\(([^)#]+)\)", page.read_text(encoding="utf-8")) if "://" not in link]
    assert [link for link in links if not (page.parent / link).exists()] == []


def test_drawings_equal_script_output():
    """The drawings were made by the scripts beside them as they stand."""
    folder = ROOT / "docs" / "figures"
    target = {name: runpy.run_path(str(folder / f"{name}.py")) for name in ("draw", "models")}
    items = [(name, target["draw"][name]) for name in ("architecture", "conventions")]
    items += [(draw.__name__, draw) for draw in target["models"]["DRAWN"]]
    assert sorted(name for name, _ in items) == sorted(path.stem for path in folder.glob("*.svg"))
    for name, draw in items:
        assert (folder / f"{name}.svg").read_text(encoding="utf-8") == draw(), name


def test_reference_lists_every_public_name():
    """Each public name stands on one page of the library's reference; commands, documents and papers are taken from the program."""
    pages = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "docs" / "reference").rglob("*.md")}
    listed = [name for text in pages.values() for block in re.findall(r"```\{names\}\n(.*?)```", text, re.S) for name in block.split()]
    assert sorted(listed) == sorted([*PUBLIC, *PUBLIC_PACKAGES])
    for kind in ("commands", "documents", "literature"):
        assert f"```{{{kind}}}" in pages[kind]


def test_tables_of_contents_list_every_page():
    """A page of docs/ stands in the table of contents of one index, which is how a reader of the site comes to it."""
    docs = ROOT / "docs"
    pages = {path.relative_to(docs).with_suffix("").as_posix() for path in docs.rglob("*.md")} - {"index"}
    listed = []
    for index in docs.rglob("index.md"):
        for block in re.findall(r"```\{toctree\}\n(.*?)```", index.read_text(encoding="utf-8"), re.S):
            lines = [line for line in block.split() if line and not line.startswith(":")]
            listed += [(index.parent / line).relative_to(docs).as_posix() for line in lines if (index.parent / f"{line}.md").exists()]
    assert sorted(listed) == sorted(pages)


def test_commands_named_in_pages_exist():
    """Commands that the pages name are commands."""
    pages = [page for page in PAGES if "```python\n# seisblock/" not in page.read_text(encoding="utf-8")]
    text = {name for page in pages for name in re.findall(r"`seisblock ([a-z][a-z0-9-]*)", page.read_text(encoding="utf-8"))}
    assert text <= set(COMMANDS)


def test_glossary_names_modules_that_exist_and_both_languages():
    """Each term has a module of the package, a known group, and texts in English and Japanese."""
    terms = tomllib.loads((ROOT / "docs" / "glossary.toml").read_text(encoding="utf-8"))["term"]
    assert len(terms) > 25
    for term in terms:
        assert all(term[key] for key in ("group", "en", "ja", "text", "text_ja")), term
        path = ROOT / Path(*term["module"].split("."))
        assert path.with_suffix(".py").exists() or (path / "__init__.py").exists(), term["module"]
