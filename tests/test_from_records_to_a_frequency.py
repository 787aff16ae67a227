"""Every line of docs/tutorials/from_records_to_a_frequency.md runs in order and gives the printed results."""

import json

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from tests.pages import PAGES, changed_figures, page_differences

PAGE = PAGES["docs/tutorials/from_records_to_a_frequency.md"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder in which the lines were run; answers that go into a file are there."""
    second = tmp_path_factory.mktemp("frequency")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(second)
        patch.setenv("COLUMNS", "80")
        assert page_differences(PAGE) == []
        assert changed_figures(PAGE, second) == []
        for name in ("bookcase", "floor"):
            answer = CliRunner().invoke(main, ["risk", "--fragility", f"{name}.json", "--hazard", "synthetic_hazard.csv", "--json"])
            (second / f"{name}_risk.json").write_text(answer.stdout, encoding="utf-8")
    return second


def first_result(folder, name):
    """Return the first result of a document."""
    return json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))["results"][0]


@pytest.mark.slow
def test_tutorial_commands_give_frequency(folder):
    """On an upper floor the bookcase overturns under weaker ground motion, and more often; its warnings name the ground motion."""
    first, floor = first_result(folder, "bookcase"), first_result(folder, "floor")
    assert first["im"] == floor["im"] == "pgv" and first["records"] == 12
    assert floor["median"] < first["median"]
    assert first_result(folder, "floor_risk")["annual_rate"] > first_result(folder, "bookcase_risk")["annual_rate"] > 0.0
    document = json.loads((folder / "floor.json").read_text(encoding="utf-8"))
    assert "floor motion T 0.6 s" in document["record"][0]["history"][-1]
    assert any("intensities of the ground motion" in text for text in document["warnings"])


@pytest.mark.slow
def test_tutorial_files_exist(folder):
    """Thirty-six of K-NET, two figures, and those of other programs."""
    assert len(list((folder / "knet").iterdir())) == 36
    assert all((folder / name).stat().st_size > 0 for name in ("bookcase.png", "risk.png", "shelf.csv", "shelf.json", "shelf.xml"))
