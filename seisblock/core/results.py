"""Immutable result of a solver: outcome, phases, events and channels (time histories)."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property, partial
from operator import eq
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

import numpy as np

from seisblock.core._display import DisplayMixin, PlotMixin, summary_repr
from seisblock.core.arrays import readonly_view
from seisblock.core.backends import backend
from seisblock.core.status import Status
from seisblock.core.typing import FloatArray, IntArray
from seisblock.core.units import unit_suffix

if TYPE_CHECKING:
    from seisblock.dynamics.events import EventLog, GuardEvent
    from seisblock.records.motion import Motion

Outcome = TypeVar("Outcome", covariant=True)
Value = TypeVar("Value")


class LazySequence(Sequence[Value]):
    """Sequence whose items are built on access from columns of numbers, which need about a hundredth of the memory.

    Parameters
    ----------
    count : int
        Number of items.
    make : callable
        Function that builds the items of a slice.

    Examples
    --------
    >>> squares = LazySequence(1000, lambda part: [k * k for k in range(1000)[part]])
    >>> squares[-1], squares[2:4], sum(squares)
    (998001, (4, 9), 332833500)
    """

    CHUNK_SIZE = 2**12
    """Number of items built at a time during iteration."""

    def __init__(self, count: int, make: Callable[[slice], Sequence[Value]]) -> None:
        self._count, self._make = count, make

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Value: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Value]: ...
    def __getitem__(self, index: int | slice) -> Value | Sequence[Value]:
        if isinstance(index, slice):
            return tuple(self._make(index))
        place = range(self._count)[index]
        return self._make(slice(place, place + 1))[0]

    def __iter__(self) -> Iterator[Value]:
        for begin in range(0, self._count, self.CHUNK_SIZE):
            yield from self._make(slice(begin, min(begin + self.CHUNK_SIZE, self._count)))

    def __eq__(self, other: object) -> bool:
        """Return True if another sequence has equal items."""
        return isinstance(other, Sequence) and len(self) == len(other) and all(map(eq, self, other))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr(tuple(self))


@dataclass(frozen=True, slots=True, repr=False)
class Phase(DisplayMixin):
    """Time interval spent in one mode; times in s after the record's first sample."""

    name: str
    start_s: float
    end_s: float

    @property
    def duration_s(self) -> float:
        """Length of the phase, s."""
        return self.end_s - self.start_s


def make_phases(edges: FloatArray, modes: IntArray, name: Callable[[int], str]) -> Sequence[Phase]:
    """Return consecutive phases.

    Parameters
    ----------
    edges : (n + 1,) array, s
        Limits of the phases, after the record's first sample.
    modes : (n,) array of int
    name : callable
        Function that returns the name of a mode.
    """
    return LazySequence(modes.size, partial(_phases, edges, modes, name))


def _phases(edges: FloatArray, modes: IntArray, name: Callable[[int], str], part: slice) -> list[Phase]:
    return [
        Phase(name(mode), start, end)
        for mode, start, end in zip(modes[part].tolist(), edges[:-1][part].tolist(), edges[1:][part].tolist(), strict=True)
    ]


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Event(DisplayMixin):
    """Event at which the mode changes, with the state before and after it.

    Parameters
    ----------
    name : str
        Name of the event (``impact``, ``slip start``...).
    time_s : float, s
        Time after the record's first sample.
    before, after : (n_state,) array
        State just before and just after, in the model's order and units.
    """

    name: str
    time_s: float
    before: FloatArray
    after: FloatArray


def make_events(event_log: EventLog, start_s: float, name: Callable[[GuardEvent], str]) -> Sequence[Event]:
    """Return the events of a trajectory.

    Parameters
    ----------
    event_log : EventLog
    start_s : float, s
        Start of the motion after the record's first sample.
    name : callable
        Function that returns the name of an event.
    """
    return LazySequence(len(event_log), partial(_events, event_log, start_s, name))


def _events(event_log: EventLog, start_s: float, name: Callable[[GuardEvent], str], part: slice) -> list[Event]:
    return [Event(name(guard_event), start_s + guard_event.time, guard_event.before, guard_event.after) for guard_event in event_log[part]]


@dataclass(frozen=True, eq=False, repr=False)
class Channel(DisplayMixin):
    """Time history of one quantity.

    Parameters
    ----------
    name : str
        Identifier (``rotation``), also the column's name in files together with the unit.
    unit : str
        SI unit, ``1`` for a dimensionless quantity.
    values : (n,) array, in `unit`
        One value per entry of the response's time axis.
    symbol : str
        Symbol used in the paper, for axis labels.
    """

    name: str
    unit: str
    values: FloatArray
    symbol: str = ""


@dataclass(frozen=True, eq=False)
class Histories:
    """Time histories on one time axis.

    Parameters
    ----------
    time : (n,) array, s
        Times after the record's first sample.
    channels : tuple of Channel
    """

    time: FloatArray
    channels: tuple[Channel, ...] = ()


def constant_histories(histories: Histories) -> Histories:
    """Return the histories unchanged; replaces ``make_histories`` in a response pickled by another process."""
    return histories


def no_histories() -> Histories:
    """Return empty histories."""
    return Histories(np.empty(0))


@dataclass(frozen=True, eq=False, repr=False)
class Response(PlotMixin, Generic[Outcome]):
    """Response of a body to one motion, computed by one solver.

    Parameters
    ----------
    model : str
        Name of the solver.
    outcome : dataclass
        Scalar results; its fields are the keys of the JSON document.
    motion, body : Motion, object
        Input motion and model of the body.
    make_histories : callable
        Function that computes :attr:`time` and :attr:`channels` on first access; the outcome needs neither.
    phases, events : sequence
        In chronological order.
    options : SolverOptions
        Options of the solver as applied: with the factor on the vertical motion and defaults resolved.
    status : Status
        Status of the integration.
    warnings : tuple of str
        Limits of validity and doubts about the result.
    citations : tuple of str
        Keys of the papers used.
    """

    model: str
    outcome: Outcome
    motion: Motion
    body: Any
    make_histories: Callable[[], Histories] = no_histories
    phases: Sequence[Phase] = ()
    events: Sequence[Event] = ()
    options: Any = None
    status: Status = Status.RECORD_ENDED
    warnings: tuple[str, ...] = ()
    citations: tuple[str, ...] = ()

    @cached_property
    def histories(self) -> Histories:
        """Time axis and channels, read-only, computed on first access."""
        histories = self.make_histories()
        channels = (replace(channel, values=readonly_view(channel.values)) for channel in histories.channels)
        return Histories(readonly_view(histories.time), tuple(channels))

    @property
    def time(self) -> FloatArray:
        """Times after the record's first sample, (n,), s: samples and, where the model logs events, both sides of each event."""
        return self.histories.time

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Time histories on that axis; displacements are relative to the ground unless the name states otherwise."""
        return self.histories.channels

    def __repr__(self) -> str:
        """Return a one-line summary without time histories."""
        body = getattr(self.body, "name", "") or type(self.body).__name__
        label = f"Response {self.model} of {body} under {self.motion.name or 'x'}"
        return summary_repr(label, self.outcome, self.status.name.lower())

    def __getstate__(self) -> dict[str, Any]:
        """Return the state to pickle, with computed histories in place of the function that computes them."""
        state = {name: value for name, value in self.__dict__.items() if name != "histories"}
        return {**state, "make_histories": partial(constant_histories, self.histories)}

    def __getitem__(self, name: str) -> FloatArray:
        """Return the values of the channel of that name, (n,)."""
        for channel in self.channels:
            if channel.name == name:
                return channel.values
        raise KeyError(f"no channel {name!r}; there are {', '.join(c.name for c in self.channels)}")

    def phase_of_row(self) -> IntArray:
        """Return, for each entry of the time axis, the index of its phase, (n,).

        Of the two entries of an event, the first belongs to the phase that ends there.
        """
        if not self.phases:
            return np.zeros(self.time.size, dtype=np.int64)
        starts = np.array([phase.start_s for phase in self.phases])
        index = np.clip(np.searchsorted(starts, self.time, side="right") - 1, 0, None)
        # an event is logged twice at the same time, before and after
        first_of_pair = np.append(self.time[1:] == self.time[:-1], False)
        ends_one = first_of_pair & (self.time == starts[index]) & (index > 0)
        return (index - ends_one).astype(np.int64)

    def summary(self) -> dict[str, Any]:
        """Return the outcome as a dictionary that begins with the component."""
        return {"component": self.motion.name, **asdict(self.outcome)}  # type: ignore[call-overload]

    def to_json(self) -> str:
        """Return the JSON document of the response, as the command prints it for one direction without further studies."""
        return backend("display").json_text(self)  # type: ignore[no-any-return]

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON document of the response as a dictionary; numbers in SI with the unit in each key's name."""
        document: dict[str, Any] = json.loads(self.to_json())
        return document

    def to_columns(self) -> dict[str, FloatArray]:
        """Return the time axis and all channels as columns named ``name_unit``."""
        columns = {"time_s": self.time}
        for channel in self.channels:
            columns[channel.name + unit_suffix(channel.unit)] = np.asarray(channel.values)
        return columns

    def to_dataframe(self) -> Any:
        """Return the columns as a pandas DataFrame (pandas must be installed)."""
        import pandas as pd

        return pd.DataFrame(self.to_columns())


__all__ = ["Channel", "Histories", "Event", "LazySequence", "Phase", "Response", "Status", "make_events", "make_phases"]
