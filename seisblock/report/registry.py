"""Presenters of the models: sentence, figure and animation of a response, for commands, notebook and report.

A model is presented by the modules of its name in ``report/text``, ``report/figures`` and ``report/animation``; a model without a module
of its own by the general ones. Modules are imported on use, so that a text output loads neither matplotlib nor the animation code.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from seisblock.core.registry import get_solver
from seisblock.core.results import Response
from seisblock.report.json.schema import Document

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.report.animation.render import AnimationOptions

Responses = Sequence[Response[Any]]

GENERAL = "solver"
"""Name of the modules that present any model."""


def _module(kind: str, model: str) -> ModuleType:
    """Return the module of a model, or the general one."""
    own = f"seisblock.report.{kind}.{model}"
    if find_spec(own):
        return import_module(own)
    get_solver(model)  # an unknown model has no presentation
    return import_module(f"seisblock.report.{kind}.{GENERAL}")


def has_animation(model: str) -> bool:
    """Return whether a model has an animation."""
    return find_spec(f"seisblock.report.animation.{model}") is not None


def verdict_text(response: Response[Any]) -> str:
    """Return the result of a response as one sentence, in the language of the locale."""
    text: str = _module("text", response.model).describe(response)
    return text


def response_document(response: Response[Any]) -> Document:
    """Return the JSON document of one response."""
    document: Document = _module("json", response.model).response_document(response)
    return document


def response_figure(responses: Responses, *, gal: bool = True) -> Figure:
    """Return the figure of responses of one model."""
    figure: Figure = _module("figures", responses[0].model).figure(responses, gal=gal)
    return figure


def animation_writer(responses: Responses) -> Callable[[Path, AnimationOptions], None] | None:
    """Return the function that writes the animation of the first response, None if the model has no animation."""
    if not has_animation(responses[0].model):
        return None
    return lambda path, options: import_module(f"seisblock.report.animation.{responses[0].model}").animate(responses[0], path, options)
