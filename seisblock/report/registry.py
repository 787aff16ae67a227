"""How each model is shown: its verdict in words, its figure and its film, in one table for commands, notebook and report alike.

Rooms load when they are asked for: a table needs no drawing, a figure no film.
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
    """What one sees of one model.

    Parameters
    ----------
    verdict : callable
        ``verdict(response) -> str``: the sentence that answers the user's question, in the language spoken.
    figure : callable
        ``figure(responses, gal) -> Figure``.
    film : callable or None
        ``film(response, path, filming)`` writes the animation of one response; None where there is none.
    """

    verdict: Callable[[Response[Any]], str]
    figure: Callable[[Responses, bool], Figure]
    film: Callable[[Response[Any], Path, AnimationOptions], None] | None = None


def get_presenter(model: str) -> Presenter:
    """Return the face of a model, by the name that its responses bear.

    Raises
    ------
    ParameterError
        If no such model is shown.
    """
    if model not in PRESENTERS:
        raise ParameterError("there is no figure of the model {model!r}; there are {known}", model=model, known=list(PRESENTERS))
    return PRESENTERS[model]


def verdict_text(response: Response[Any]) -> str:
    """Return what happened, in a sentence."""
    return get_presenter(response.model).verdict(response)


def response_figure(responses: Responses, *, gal: bool = True) -> Figure:
    """Return the figure of the responses of one model."""
    return get_presenter(responses[0].model).figure(responses, gal)


def animation_writer(responses: Responses) -> Callable[[Path, AnimationOptions], None] | None:
    """Return what writes the animation of the first of some responses, or None where the model has none."""
    film = get_presenter(responses[0].model).film
    return None if film is None else lambda path, options: film(responses[0], path, options)


def _describe_respond(response: Response[Any]) -> str:
    """Tell what a free-standing object did."""
    from seisblock.report.text.respond import verdict

    return verdict(response)


def _describe_rock(response: Response[Any]) -> str:
    """Tell what became of a block that rocks."""
    from seisblock.report.text.rock import first_line

    return first_line(response)


def _describe_slide(response: Response[Any]) -> str:
    """Tell what a slide came to."""
    from seisblock.report.text.slide import sentence

    return sentence(response)


def _describe_jump(response: Response[Any]) -> str:
    """Tell what became of a body that jumps."""
    from seisblock.report.text.jump import verdict

    return verdict(response)


def _describe_uplift(response: Response[Any]) -> str:
    """Tell what lifted."""
    from seisblock.report.text.uplift import sentence

    return sentence(response)


def _describe_stack(response: Response[Any]) -> str:
    """Tell what became of a pile."""
    from seisblock.report.text.stack import verdict

    return verdict(response)


def _plot_respond(responses: Responses, gal: bool) -> Figure:
    """Draw a free-standing object."""
    from seisblock.report.figures.respond import figure

    return figure(responses, gal=gal)


def _plot_rock(responses: Responses, gal: bool) -> Figure:
    """Draw rocking."""
    from seisblock.report.figures.rock import figure

    return figure(responses, gal=gal)


def _plot_slide(responses: Responses, gal: bool) -> Figure:
    """Draw sliding."""
    from seisblock.report.figures.slide import figure

    return figure(responses, gal=gal)


def _plot_jump(responses: Responses, gal: bool) -> Figure:
    """Draw jumps."""
    from seisblock.report.figures.jump import figure

    return figure(responses, gal=gal)


def _plot_uplift(responses: Responses, gal: bool) -> Figure:
    """Draw uplift under a record."""
    from seisblock.report.figures.uplift import record_figure

    return record_figure(responses, gal=gal)


def _plot_stack(responses: Responses, gal: bool) -> Figure:
    """Draw a pile."""
    from seisblock.report.figures.stack import figure

    return figure(responses, gal=gal)


def _animate_respond(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    """Film a free-standing object."""
    from seisblock.report.animation.respond import animate_respond

    animate_respond(response, path, options)


def _animate_rock(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    """Film rocking."""
    from seisblock.report.animation.rock import animate_rocking

    animate_rocking(response, path, options)


def _animate_slide(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    """Film a slide."""
    from seisblock.report.animation.slide import animate_slide

    animate_slide(response, path, options)


def _animate_jump(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    """Film a jump."""
    from seisblock.report.animation.jump import animate_jump

    animate_jump(response, path, options)


def _animate_uplift(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    """Film a block on its springs."""
    from seisblock.report.animation.uplift import animate_uplift

    animate_uplift(response, path, options)


def _animate_stack(response: Response[Any], path: Path, options: AnimationOptions) -> None:
    """Film a pile."""
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
"""Models in the order in which a user meets them."""
