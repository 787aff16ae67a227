"""How each model is shown: its verdict in words, its figure and its film, in one table for commands, notebook and report alike.

Rooms load when they are asked for: a table needs no drawing, a figure no film.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock.errors import ParameterError
from seisblock.results import Response

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.present.films.animation import Filming

Responses = Sequence[Response[Any]]


@dataclass(frozen=True)
class Face:
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
    film: Callable[[Response[Any], Path, Filming], None] | None = None


def face_of(model: str) -> Face:
    """Return the face of a model, by the name that its responses bear.

    Raises
    ------
    ParameterError
        If no such model is shown.
    """
    if model not in FACES:
        raise ParameterError("there is no figure of the model {model!r}; there are {known}", model=model, known=list(FACES))
    return FACES[model]


def verdict_of(response: Response[Any]) -> str:
    """Return what happened, in a sentence."""
    return face_of(response.model).verdict(response)


def figure_of(responses: Responses, *, gal: bool = True) -> Figure:
    """Return the figure of the responses of one model."""
    return face_of(responses[0].model).figure(responses, gal)


def film_of(responses: Responses) -> Callable[[Path, Filming], None] | None:
    """Return what writes the animation of the first of some responses, or None where the model has none."""
    film = face_of(responses[0].model).film
    return None if film is None else lambda path, filming: film(responses[0], path, filming)


def _tell_respond(response: Response[Any]) -> str:
    """Tell what a free-standing object did."""
    from seisblock.present.text.respond import verdict

    return verdict(response)


def _tell_rock(response: Response[Any]) -> str:
    """Tell what became of a block that rocks."""
    from seisblock.present.text.rock import first_line

    return first_line(response)


def _tell_slide(response: Response[Any]) -> str:
    """Tell what a slide came to."""
    from seisblock.present.text.slide import sentence

    return sentence(response)


def _tell_jump(response: Response[Any]) -> str:
    """Tell what became of a body that jumps."""
    from seisblock.present.text.jump import verdict

    return verdict(response)


def _tell_uplift(response: Response[Any]) -> str:
    """Tell what lifted."""
    from seisblock.present.text.uplift import sentence

    return sentence(response)


def _tell_stack(response: Response[Any]) -> str:
    """Tell what became of a pile."""
    from seisblock.present.text.stack import verdict

    return verdict(response)


def _respond(responses: Responses, gal: bool) -> Figure:
    """Draw a free-standing object."""
    from seisblock.present.figures.respond import figure

    return figure(responses, gal=gal)


def _rock(responses: Responses, gal: bool) -> Figure:
    """Draw rocking."""
    from seisblock.present.figures.rock import figure

    return figure(responses, gal=gal)


def _slide(responses: Responses, gal: bool) -> Figure:
    """Draw sliding."""
    from seisblock.present.figures.slide import figure

    return figure(responses, gal=gal)


def _jump(responses: Responses, gal: bool) -> Figure:
    """Draw jumps."""
    from seisblock.present.figures.jump import figure

    return figure(responses, gal=gal)


def _uplift(responses: Responses, gal: bool) -> Figure:
    """Draw uplift under a record."""
    from seisblock.present.figures.uplift import record_figure

    return record_figure(responses, gal=gal)


def _stack(responses: Responses, gal: bool) -> Figure:
    """Draw a pile."""
    from seisblock.present.figures.stack import figure

    return figure(responses, gal=gal)


def _film_respond(response: Response[Any], path: Path, filming: Filming) -> None:
    """Film a free-standing object."""
    from seisblock.present.films.respond import animate_respond

    animate_respond(response, path, filming)


def _film_rock(response: Response[Any], path: Path, filming: Filming) -> None:
    """Film rocking."""
    from seisblock.present.films.rock import animate_rocking

    animate_rocking(response, path, filming)


def _film_slide(response: Response[Any], path: Path, filming: Filming) -> None:
    """Film a slide."""
    from seisblock.present.films.slide import animate_slide

    animate_slide(response, path, filming)


def _film_jump(response: Response[Any], path: Path, filming: Filming) -> None:
    """Film a jump."""
    from seisblock.present.films.jump import animate_jump

    animate_jump(response, path, filming)


def _film_uplift(response: Response[Any], path: Path, filming: Filming) -> None:
    """Film a block on its springs."""
    from seisblock.present.films.uplift import animate_uplift

    animate_uplift(response, path, filming)


def _film_stack(response: Response[Any], path: Path, filming: Filming) -> None:
    """Film a pile."""
    from seisblock.present.films.stack import animate_stack

    animate_stack(response, path, filming)


FACES = {
    "respond": Face(_tell_respond, _respond, _film_respond),
    "rock": Face(_tell_rock, _rock, _film_rock),
    "slide": Face(_tell_slide, _slide, _film_slide),
    "jump": Face(_tell_jump, _jump, _film_jump),
    "uplift": Face(_tell_uplift, _uplift, _film_uplift),
    "stack": Face(_tell_stack, _stack, _film_stack),
}
"""Models in the order in which a user meets them."""
