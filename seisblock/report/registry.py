"""Presenters of the models: verdict text, figure and animation of a response, for commands, notebook and report.

Every function imports its module when called, so that a text output loads neither matplotlib nor the animation code.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock.core.errors import ParameterError
from seisblock.core.results import Response

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.report.animation.render import AnimationOptions

Responses = Sequence[Response[Any]]


@dataclass(frozen=True)
class Presenter:
    """Text, figure and animation functions of one model.

    Parameters
    ----------
    verdict : callable
        ``verdict(response) -> str``: the result in one sentence, in the language of the locale.
    figure : callable
        ``figure(responses, gal) -> Figure``.
    film : callable or None
        ``film(response, path, options)`` writes the animation of one response; None if the model has no animation.
    """

    verdict: Callable[[Response[Any]], str]
    figure: Callable[[Responses, bool], Figure]
    film: Callable[[Response[Any], Path, AnimationOptions], None] | None = None


def get_presenter(model: str) -> Presenter:
    """Return the presenter of a model by name.

    Raises
    ------
    ParameterError
        If the model has no presenter.
    """
    if model not in PRESENTERS:
        raise ParameterError("no figure for the model {model!r}; models with a figure: {known}", model=model, known=list(PRESENTERS))
    return PRESENTERS[model]


def verdict_text(response: Response[Any]) -> str:
    """Return the result of a response as one sentence."""
    return get_presenter(response.model).verdict(response)


def response_figure(responses: Responses, *, gal: bool = True) -> Figure:
    """Return the figure of responses of one model."""
    return get_presenter(responses[0].model).figure(responses, gal)


def animation_writer(responses: Responses) -> Callable[[Path, AnimationOptions], None] | None:
    """Return the function that writes the animation of the first response, None if the model has no animation."""
    film = get_presenter(responses[0].model).film
    return None if film is None else lambda path, options: film(responses[0], path, options)


def _describe_respond(response: Response[Any]) -> str:
    from seisblock.report.text.respond import verdict

    return verdict(response)


def _describe_rock(response: Response[Any]) -> str:
    from seisblock.report.text.rock import first_line

    return first_line(response)


def _describe_slide(response: Response[Any]) -> str:
    from seisblock.report.text.slide import sentence

    return sentence(response)


def _describe_jump(response: Response[Any]) -> str:
    from seisblock.report.text.jump import verdict

    return verdict(response)


def _describe_uplift(response: Response[Any]) -> str:
    from seisblock.report.text.uplift import sentence

    return sentence(response)


def _describe_stack(response: Response[Any]) -> str:
    from seisblock.report.text.stack import verdict

    return verdict(response)


def _plot_respond(responses: Responses, gal: bool) -> Figure:
    from seisblock.report.figures.respond import figure

    return figure(responses, gal=gal)


def _plot_rock(responses: Responses, gal: bool) -> Figure:
    from seisblock.report.figures.rock import figure

    return figure(responses, gal=gal)


def _plot_slide(responses: Responses, gal: bool) -> Figure:
    from seisblock.report.figures.slide import figure

    return figure(responses, gal=gal)


def _plot_jump(responses: Responses, gal: bool) -> Figure:
    from seisblock.report.figures.jump import figure

    return figure(responses, gal=gal)


def _plot_uplift(responses: Responses, gal: bool) -> Figure:
    from seisblock.report.figures.uplift import record_figure

    return record_figure(responses, gal=gal)


def _plot_stack(responses: Responses, gal: bool) -> Figure:
    from seisblock.report.figures.stack import figure

    return figure(responses, gal=gal)


def _animate_respond(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    from seisblock.report.animation.respond import animate_respond

    animate_respond(response, path, options)


def _animate_rock(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    from seisblock.report.animation.rock import animate_rocking

    animate_rocking(response, path, options)


def _animate_slide(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    from seisblock.report.animation.slide import animate_slide

    animate_slide(response, path, options)


def _animate_jump(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    from seisblock.report.animation.jump import animate_jump

    animate_jump(response, path, options)


def _animate_uplift(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    from seisblock.report.animation.uplift import animate_uplift

    animate_uplift(response, path, options)


def _animate_stack(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    from seisblock.report.animation.stack import animate_stack

    animate_stack(response, path, options)


PRESENTERS = {
    "respond": Presenter(_describe_respond, _plot_respond, _animate_respond),
    "rock": Presenter(_describe_rock, _plot_rock, _animate_rock),
    "slide": Presenter(_describe_slide, _plot_slide, _animate_slide),
    "jump": Presenter(_describe_jump, _plot_jump, _animate_jump),
    "uplift": Presenter(_describe_uplift, _plot_uplift, _animate_uplift),
    "stack": Presenter(_describe_stack, _plot_stack, _animate_stack),
}
"""Presenter of each model, in the order of the documentation."""
