"""A model is three tables of names and two functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from seisblock._jit import function_pointer
from seisblock.dynamics import hybrid
from seisblock.dynamics.buffers import Shape
from seisblock.dynamics.model_api import STRIDE

ORDER = 12
"""Terms of the power series; at 100 Hz the thirteenth is below round-off."""


@dataclass(frozen=True)
class Model:
    """What the engine needs to know of a model.

    Parameters
    ----------
    name : str
    series, reset : compiled functions
        Signatures ``SERIES`` and ``RESET`` of :mod:`seisblock.dynamics.hybrid`.
    states, guards, modes : tuple of str
        Names, in the order of the model's named integers. Negative modes end the integration and are named from the end:
        mode -1 is ``modes[-1]``.
    scratch : int
        Rows that ``series`` needs beside the states.
    tracked : int
        How many of the first states have their exact extrema kept.
    order : int
        Terms of a series that does not end by itself.
    skip : compiled function
        Signature ``SKIP``: the short cut through samples at which nothing happens.
    has_floors : bool
        Whether the parameters end in one size per state below which it counts as that large, for the step's length.
    sharp : int
        How many of the first guards are states set to exact values: however small they start, they are not taken for zero.
    stride : compiled function or None
        Signature ``STRIDE`` of :mod:`seisblock.dynamics.model_api`: moves many trajectories at once where nothing happens to them.
    """

    name: str
    series: Callable[..., Any]
    reset: Callable[..., Any]
    states: tuple[str, ...]
    guards: tuple[str, ...]
    modes: tuple[str, ...]
    scratch: int = 0
    tracked: int = 1
    order: int = ORDER
    skip: Callable[..., Any] = hybrid.no_skip
    has_floors: bool = False
    sharp: int = 0
    stride: Callable[..., Any] | None = None

    @cached_property
    def pointers(self) -> tuple[Any, Any, Any]:
        """Series, reset and skip, as compiled loops take them."""
        return (
            function_pointer(self.series, hybrid.SERIES),
            function_pointer(self.reset, hybrid.RESET),
            function_pointer(self.skip, hybrid.SKIP),
        )

    @cached_property
    def stride_pointer(self) -> Any:
        """The stride, as compiled loops take it."""
        assert self.stride is not None
        return function_pointer(self.stride, STRIDE)

    @cached_property
    def shape(self) -> Shape:
        """Sizes that the engine needs."""
        return Shape(self.scratch, len(self.guards), self.tracked, self.order, int(self.has_floors), self.sharp)
