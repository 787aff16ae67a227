"""Limit states of a fragility: uplift, tilt, slip and overturning."""

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


@dataclass(frozen=True, eq=False)
class EndStates:
    """Outcomes of several runs, (m,) each; None for a quantity that the solver does not compute.

    Parameters
    ----------
    overturned : bool
    tilt_ratio : float, 1
        Peak tilt over the slenderness alpha of its side.
    slip_m : float, m
        Displacement of the object; infinite for an overturned one.
    gave_up : bool
        Runs stopped without a result; None if there are none.
    """

    overturned: BoolArray | None = None
    tilt_ratio: FloatArray | None = None
    slip_m: FloatArray | None = None
    gave_up: BoolArray | None = None


@dataclass(frozen=True)
class LimitState:
    """Limit state of an object, exceeded or not.

    Parameters
    ----------
    kind : str
        ``overturn``; ``rock``: uplift; ``lean``: peak tilt above a share of the slenderness; ``slip``: displacement above a length,
        or overturning.
    threshold : float or None
        The share, 1, or the length, m.

    Raises
    ------
    ParameterError
        If the limit is unknown, or its threshold is missing or out of range.
    """

    kind: str
    threshold: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in (ROCK, LEAN, SLIP, OVERTURN):
            raise ParameterError(
                "unknown limit {name!r}; available: {known}",
                name=str(self.kind)[:100],
                known=[OVERTURN, ROCK, f"{SLIP}=5cm", f"{LEAN}=0.5"],
            )
        if (self.kind in (LEAN, SLIP)) != (self.threshold is not None):
            raise ParameterError("the limits slip and lean require a threshold (slip=5cm, lean=0.5); rock and overturn take none")
        if self.threshold is not None:
            checks.positive("the threshold of a limit", self.threshold)

    @property
    def name(self) -> str:
        """Name in option syntax: ``overturn``, ``slip=0.05m``, ``lean=0.5``."""
        if self.threshold is None:
            return self.kind
        return f"{self.kind}={self.threshold:g}{'m' if self.kind == SLIP else ''}"

    def exceeded(self, ends: EndStates) -> BoolArray:
        """Return the runs that exceed the limit."""
        values = {OVERTURN: ends.overturned, ROCK: ends.tilt_ratio, LEAN: ends.tilt_ratio, SLIP: ends.slip_m}[self.kind]
        assert values is not None
        return np.asarray(values > (self.threshold or 0.0))


def limit_state(text: str | LimitState) -> LimitState:
    """Return the limit state of a text.

    Parameters
    ----------
    text : str
        ``overturn``, ``rock``, ``slip=5cm`` (a length with its unit, or in m), or ``lean=0.5`` (a share of the slenderness).

    Raises
    ------
    ParameterError, UnitError
        If the text names no limit state.

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
        raise ParameterError(
            "the threshold of {text!r} is not a number; expected a share of alpha such as lean=0.5", text=str(text)[:100]
        ) from None


def describe_limit(name: str) -> Message:
    """Return a label of a limit state.

    Parameters
    ----------
    name : str
        As in :attr:`LimitState.name`.

    Examples
    --------
    >>> print(describe_limit("overturn"), describe_limit("slip=0.05m"), describe_limit("lean=0.5"), sep=", ")
    overturning, slip 0.05 m, tilt 0.5 alpha
    """
    limit = limit_state(name)
    if limit.kind == LEAN:
        return lazy_gettext("tilt {share} alpha", share=f"{limit.threshold:g}")
    if limit.kind == SLIP:
        return lazy_gettext("slip {length}", length=f"{limit.threshold:g} m")
    return lazy_gettext("overturning") if limit.kind == OVERTURN else lazy_gettext("rocking")


def limit_states(texts: str | LimitState | Sequence[str | LimitState], solver: str, supported: Sequence[str]) -> tuple[LimitState, ...]:
    """Return the limit states of a study in order of severity.

    Raises
    ------
    ParameterError
        If there is none, two are the same, or the solver does not compute one.
    """
    items = [texts] if isinstance(texts, (str, LimitState)) else list(texts)
    states = tuple(limit_state(state) for state in items)
    if not states:
        raise ParameterError("no limit given; expected overturn, rock, slip=5cm or lean=0.5")
    for state in states:
        if state.kind not in supported:
            raise ParameterError(
                "{solver} does not compute the limit {name!r}; available: {known}",
                solver=solver,
                name=state.name,
                known=list(supported),
            )
    if len(set(states)) < len(states):
        raise ParameterError("duplicate limit; give each limit once")
    order = (ROCK, LEAN, SLIP, OVERTURN)
    return tuple(sorted(states, key=lambda state: (order.index(state.kind), state.threshold or 0.0)))


def cumulative_exceedance(exceeded: BoolArray) -> BoolArray:
    """Return exceedances of each limit or a more severe one.

    Parameters
    ----------
    exceeded : (..., k) array of bool
        Limits in order of severity along the last axis.
    """
    return np.asarray(np.logical_or.accumulate(exceeded[..., ::-1], axis=-1)[..., ::-1])
