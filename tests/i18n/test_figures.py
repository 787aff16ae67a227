"""Texts of figures are in the language of the call before they are drawn."""

import re

import pytest
from click.testing import CliRunner
from matplotlib.figure import Figure
from matplotlib.text import Text

from seisblock.cli import main
from tests.catalogue import message_key, read_catalogue
from tests.i18n.english import english_words
from tests.i18n.test_commands import BLOCK, SHORT
from tests.lengths import all_but_slow

FIGURES = (
    ("measure", *SHORT),
    ("respond", *SHORT, *BLOCK, "--mu", "0.3", "--runs", "0", "--component", "EW"),
    ("slide", *SHORT, "--mu", "0.2", "--slope", "5"),
    ("slide", *SHORT, "--mu", "0.1,0.2", "--component", "NS"),
    ("rock", *SHORT, "--block", "gravestone", "--component", "EW"),
    ("jump", *SHORT, "--component", "EW"),
    ("uplift", *SHORT, *BLOCK, "--frequency-vertical", "8", "--component", "EW"),
    ("uplift", "--harmonic", "--alpha", "1"),
    ("stack", "synthetic_jma.csv", "--window", "25.5:26.2", "--component", "NS"),
    ("criteria", *SHORT, "--block", "gravestone", "--component", "NS"),
    ("spectrum", *SHORT, "--component", "NS", "--sizes", "1:3:1", "--height-over-width", "2:4:1"),
    ("spectrum", *SHORT, "--kind", "sliding", "--mu", "0.1:0.3:0.1", "--component", "NS"),
    ("spectrum", *SHORT, "--kind", "modes", "--mu", "0.2,0.5", "--height-over-width", "1,4", "--component", "EW"),
    ("overturn-rate", "--cemetery", "aoyama.csv", "--both"),
    ("infer", "--rate", "35/100", "--cemetery", "aoyama.csv", "--frequency", "1"),
    ("infer", *SHORT, "--slid", "5cm", "--mu", "0.3", "--limit", "1", "--steps", "10", "--component", "EW"),
)


@pytest.fixture
def figure_texts(monkeypatch):
    """Every text of the figures that are saved."""
    texts = []
    save = Figure.savefig

    def saved(figure, *arguments, **options):
        texts.extend(text.get_text() for text in figure.findobj(Text))
        return save(figure, *arguments, **options)

    monkeypatch.setattr(Figure, "savefig", saved)
    return texts


@pytest.fixture(scope="module")
def translations():
    """Return the messages whose translation differs: their English should not be on a Japanese figure."""
    return {message_key(message) for message in read_catalogue("ja") if message.id and message.string != message.id}


@pytest.mark.parametrize("line", all_but_slow(FIGURES, {line for line in FIGURES if line[0] not in {"measure", "stack"}}), ids=" ".join)
def test_figures_are_fully_japanese(line, figure_texts, translations, tmp_path):
    """Titles, axes, legends and notes; no piece of a text is one that the catalogue has a Japanese word for."""
    answer = CliRunner().invoke(main, ["--lang", "ja", *line, "--plot", str(tmp_path / "figure.svg"), "--quiet"])
    assert answer.exit_code == 0, answer.output
    left = [text for text in figure_texts if english_words(text) or translations.intersection(re.split(r"\s{2,}|[:：、,;] *|\n", text))]
    assert len(figure_texts) > 20 and not left
