"""Presentation of a model by its registration: sentence, figure, animation and document."""

from dataclasses import replace

import pytest

from seisblock.core import registry
from seisblock.core.i18n import use_locale
from seisblock.core.registry import get_solver, solver_names
from seisblock.measures.shaking import response_shaking
from seisblock.output.figures import solver as figures
from seisblock.output.json.solver import ANY_BODY, model_document
from seisblock.output.text.shaking import shaking_text
from seisblock.output.text.solver import describe
from tests.report.long_record import response

PRESENTERS = ("describe", "plot", "animate", "document")


@pytest.mark.parametrize("name", solver_names())
@pytest.mark.parametrize("kind", PRESENTERS)
def test_reference_of_a_presenter_is_in_the_folder_of_its_model(name, kind):
    """Each reference can be imported, and leads to the folder of the model."""
    reference = getattr(get_solver(name), kind)
    if reference is not None:
        assert get_solver(name).presenter(kind) is not None
        assert reference.startswith(f"seisblock.models.{name}.")


@pytest.mark.parametrize("gal", [True, False])
@pytest.mark.parametrize("name", solver_names())
def test_describe_begins_with_the_direction_or_the_outcome_in_either_unit(name, gal):
    """One call serves every model: sentence of one response, in gal or m/s^2."""
    sentence = describe(response(name), gal=gal)
    assert sentence.endswith(".")
    assert sentence.startswith(f"{response(name).motion.name}: ") or name == "stack"


def test_solver_without_presenters_is_described_by_its_event(monkeypatch):
    """A model that registers none has sentence, figure and document from its registration alone."""
    plain = replace(get_solver("slide"), describe=None, plot=None, document=None)
    monkeypatch.setitem(registry._SOLVERS, "slide", plain)
    assert describe(response("slide")) == f"{response('slide').motion.name}: slips: yes."
    fig = figures.response_figure([response("slide")])
    assert len(fig.axes) == len(figures.figure([response("slide")]).axes) > 0
    assert model_document("slide") is ANY_BODY


def test_presenter_may_be_a_function(monkeypatch):
    """A small model registers the function itself."""
    monkeypatch.setitem(registry._SOLVERS, "slide", replace(get_solver("slide"), describe=lambda response, *, gal: f"{gal}."))
    assert describe(response("slide"), gal=False) == "False."


@pytest.mark.parametrize(("lang", "words"), [("en", ("PGV", "equivalent frequency", "threshold")), ("ja", ("等価振動数", "開始加速度"))])
def test_figure_states_shaking_below_the_panels(lang, words):
    """Peaks, frequency and threshold of the text stand in the figure, and in its narrow layout."""
    with use_locale(lang):
        fig = figures.response_figure([response("slide")])
        text = shaking_text("EW", response_shaking(response("slide")))
    assert fig.footer.get_text().partition("PGA")[2] == text.partition("PGA")[2]
    assert all(word in fig.footer.get_text() for word in words)
    assert fig.build_narrow(fig.narrow_layout, None).footer.get_text() == fig.footer.get_text()


def test_uplift_below_its_static_threshold_is_not_called_below_the_threshold():
    """A record of 320 gal lifted a corner and was "below the threshold of 1307.6 gal (static)": the springs amplify the motion."""
    item = response("uplift")
    text = shaking_text("EW", response_shaking(item), static=True)
    assert "static threshold of uplift" in text and "without amplification by the springs" in text and "below" not in text
