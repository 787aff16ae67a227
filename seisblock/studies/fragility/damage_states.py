"""What counts as having happened: a state of the object that a run passes or does not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.core.units import parse_length

ROCK, LEAN, SLIP, OVERTURN = "rock", "lean", "slip", "overturn"

SUPPORTED_LIMITS = {"rock": (ROCK, LEAN, OVERTURN), "respond": (ROCK, LEAN, SLIP, OVERTURN), "slide": (SLIP,), "stack": (SLIP, OVERTURN)}
"""The limits that each solver knows an answer to."""


@dataclass(frozen=True, eq=False)
class EndStates:
    """What some runs came to, (m,) each; None where the solver does not say.

    Parameters
    ----------
    overturned : bool
    tilt_ratio : float, 1
        Largest lean over the slenderness alpha of its side.
    slip_m : float, m
        How far the object was moved; infinite where it fell.
    gave_up : bool
        Runs without an answer; None where there is none of them.
    """

    overturned: BoolArray | None = None
    tilt_ratio: FloatArray | None = None
    slip_m: FloatArray | None = None
    gave_up: BoolArray | None = None


@dataclass(frozen=True)
class LimitState:
    """A limit that an object passes, or does not.

    Parameters
    ----------
    kind : str
        ``overturn``; ``rock``, it leaves its rest; ``lean``, it leans by more than a share of its slenderness; ``slip``, it is moved by
        more than a length, or falls.
    threshold : float or None
        The share, 1, or the length, m.

    Raises
    ------
    ParameterError
        If there is no such limit, or its threshold is missing or of no use.
    """

    kind: str
    threshold: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in (ROCK, LEAN, SLIP, OVERTURN):
            raise ParameterError(
                "there is no limit {name!r}; there are {known}",
                name=str(self.kind)[:100],
                known=[OVERTURN, ROCK, f"{SLIP}=5cm", f"{LEAN}=0.5"],
            )
        if (self.kind in (LEAN, SLIP)) != (self.threshold is not None):
            raise ParameterError("a limit of slip or lean needs a number, slip=5cm or lean=0.5, and no other has one")
        if self.threshold is not None:
            checks.positive("the threshold of a limit", self.threshold)

    @property
    def name(self) -> str:
        """As it is asked for: ``overturn``, ``slip=0.05m``, ``lean=0.5``."""
        if self.threshold is None:
            return self.kind
        return f"{self.kind}={self.threshold:g}{'m' if self.kind == SLIP else ''}"

    def exceeded(self, ends: EndStates) -> BoolArray:
        """Return which runs passed it."""
        values = {OVERTURN: ends.overturned, ROCK: ends.tilt_ratio, LEAN: ends.tilt_ratio, SLIP: ends.slip_m}[self.kind]
        assert values is not None
        return np.asarray(values > (self.threshold or 0.0))


def limit_state(text: str | LimitState) -> LimitState:
    """Return the limit that a text names.

    Parameters
    ----------
    text : str
        ``overturn``, ``rock``, ``slip=5cm`` (a length with its unit, or in m), or ``lean=0.5`` (a share of the slenderness).

    Raises
    ------
    ParameterError, UnitError
        If it names none.

    Examples
    --------
    >>> limit_state("slip=5cm").threshold
    0.05
    """
    if isinstance(text, LimitState):
        return text
    kind, equals, number = str(text).strip().partition("=")
    if not equals:
        return LimitState(kind)
    if kind == SLIP:
        return LimitState(kind, parse_length(number, quantity="slip"))
    try:
        return LimitState(kind, float(number))
    except ValueError:
        raise ParameterError("the threshold of {text!r} is no number: write lean=0.5", text=str(text)[:100]) from None


def describe_limit(name: str) -> Message:
    """Return what it means to pass a limit, as a value of what is said.

    Parameters
    ----------
    name : str
        As of :attr:`LimitState.name`.

    Examples
    --------
    >>> print(describe_limit("overturn"), describe_limit("slip=0.05m"), describe_limit("lean=0.5"), sep=", ")
    overturns, moved 0.05 m, leans 0.5 alpha
    """
    limit = limit_state(name)
    if limit.kind == LEAN:
        return lazy_gettext("leans {share} alpha", share=f"{limit.threshold:g}")
    if limit.kind == SLIP:
        return lazy_gettext("moved {length}", length=f"{limit.threshold:g} m")
    return lazy_gettext("overturns") if limit.kind == OVERTURN else lazy_gettext("rocks")


def limit_states(texts: str | LimitState | Sequence[str | LimitState], solver: str) -> tuple[LimitState, ...]:
    """Return the limits that a solver is asked about, in the order in which they are passed.

    Raises
    ------
    ParameterError
        If there is none, two are the same, or the solver knows no answer to one.
    """
    items = [texts] if isinstance(texts, (str, LimitState)) else list(texts)
    states = tuple(limit_state(state) for state in items)
    if not states:
        raise ParameterError("no limit is given: say overturn, rock, slip=5cm or lean=0.5")
    for state in states:
        if state.kind not in SUPPORTED_LIMITS[solver]:
            raise ParameterError(
                "{solver} knows no answer to the limit {name!r}; it knows {known}",
                solver=solver,
                name=state.name,
                known=list(SUPPORTED_LIMITS[solver]),
            )
    if len(set(states)) < len(states):
        raise ParameterError("a limit is given twice: name each once")
    order = (ROCK, LEAN, SLIP, OVERTURN)
    return tuple(sorted(states, key=lambda state: (order.index(state.kind), state.threshold or 0.0)))


def cumulative_exceedance(exceeded: BoolArray) -> BoolArray:
    """Return which runs came to each limit or beyond it: one that passed a later limit is past those before it.

    Parameters
    ----------
    exceeded : (..., k) array of bool
        Limits in their order along the last axis.
    """
    return np.asarray(np.logical_or.accumulate(exceeded[..., ::-1], axis=-1)[..., ::-1])
