"""Definition of a hybrid model: names of states, guards and modes, and compiled functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

from seisblock._jit import function_pointer
from seisblock.dynamics import hybrid
from seisblock.dynamics.buffers import Shape
from seisblock.dynamics.model_api import STRIDE

ORDER = 12
"""Order of the power series; at 100 Hz the next term is below round-off."""


@cache
def loop_pointer(advance: Callable[..., Any]) -> Any:
    """Return the function pointer of a loop of one trajectory."""
    return function_pointer(advance, hybrid.ADVANCE)


@dataclass(frozen=True)
class Model:
    """Hybrid model for the engine.

    Parameters
    ----------
    name : str
    series, reset : compiled functions
        Functions with the signatures ``SERIES`` and ``RESET`` of :mod:`seisblock.dynamics.model_api`.
    states, guards, modes : tuple of str
        Names, in the order of the model's integer constants. Negative modes end the integration and are counted from the end:
        mode -1 is ``modes[-1]``.
    scratch : int
        Number of work rows of ``series`` beside the states.
    tracked : int
        Number of leading states whose exact extrema are recorded.
    order : int
        Order of infinite series.
    skip : compiled function
        Function with the signature ``SKIP`` that passes over samples without motion or events.
    sharp : int
        Number of leading guards that are states set to exact values; small initial values of these are not treated as round-off.
    stride : compiled function or None
        Function with the signature ``STRIDE`` that advances many trajectories in parallel between events.
    advance : compiled function
        Loop of one trajectory with the signature ``ADVANCE`` of :mod:`seisblock.dynamics.hybrid`; one of the model's own calls `series`,
        `reset` and `skip` by rules of its own.
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
    sharp: int = 0
    stride: Callable[..., Any] | None = None
    advance: Callable[..., Any] = hybrid.advance

    @cached_property
    def pointers(self) -> tuple[Any, Any, Any, Any]:
        """Function pointers of the engine's step loop, series, reset and skip."""
        return (
            loop_pointer(self.advance),
            function_pointer(self.series, hybrid.SERIES),
            function_pointer(self.reset, hybrid.RESET),
            function_pointer(self.skip, hybrid.SKIP),
        )

    @cached_property
    def stride_pointer(self) -> Any:
        """Function pointer of the stride."""
        assert self.stride is not None
        return function_pointer(self.stride, STRIDE)

    @cached_property
    def shape(self) -> Shape:
        """Sizes of the model for the engine."""
        return Shape(self.scratch, len(self.guards), self.tracked, self.order, self.sharp)
