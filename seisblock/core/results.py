"""What a solver answers: phases, events, channels and an outcome, in one immutable response."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property, partial
from operator import eq
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

import numpy as np

from seisblock.core._display import PlotMixin, summary_repr
from seisblock.core.status import Status
from seisblock.core.typing import FloatArray, IntArray

if TYPE_CHECKING:
    from seisblock.dynamics.events import EventLog, GuardEvent
    from seisblock.records.motion import Motion

Outcome = TypeVar("Outcome", covariant=True)
Value = TypeVar("Value")


class LazySequence(Sequence[Value]):
    """Values that are made when one looks at them: columns of numbers hold a million of them in the room of a hundredth.

    Parameters
    ----------
    count : int
        How many there are.
    make : callable
        Makes those of a slice.

    Examples
    --------
    >>> squares = LazySequence(1000, lambda part: [k * k for k in range(1000)[part]])
    >>> squares[-1], squares[2:4], sum(squares)
    (998001, (4, 9), 332833500)
    """

    CHUNK_SIZE = 2**12
    """How many are made at a time for whoever goes through them."""

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
        """Whether another sequence holds the same."""
        return isinstance(other, Sequence) and len(self) == len(other) and all(map(eq, self, other))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr(tuple(self))


@dataclass(frozen=True, slots=True)
class Phase:
    """A stretch of time spent in one mode, times in s from the record's first sample."""

    name: str
    start_s: float
    end_s: float

    @property
    def duration_s(self) -> float:
        """Length of the phase, s."""
        return self.end_s - self.start_s


def make_phases(edges: FloatArray, modes: IntArray, name: Callable[[int], str]) -> Sequence[Phase]:
    """Return stretches of time that follow each other.

    Parameters
    ----------
    edges : (n + 1,) array, s
        From the record's first sample.
    modes : (n,) array of int
    name : callable
        Of a mode.
    """
    return LazySequence(modes.size, partial(_phases, edges, modes, name))


def _phases(edges: FloatArray, modes: IntArray, name: Callable[[int], str], part: slice) -> list[Phase]:
    """Return some of the stretches."""
    return [
        Phase(name(mode), start, end)
        for mode, start, end in zip(modes[part].tolist(), edges[:-1][part].tolist(), edges[1:][part].tolist(), strict=True)
    ]


@dataclass(frozen=True, eq=False, slots=True)
class Event:
    """A change of mode, with the state on both sides of it.

    Parameters
    ----------
    name : str
        What happened (``impact``, ``slip start``...).
    time_s : float, s
        Time from the record's first sample.
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
    event_log : Changes
    start_s : float, s
        When the motion begins, from the record's first sample.
    name : callable
        Of a change.
    """
    return LazySequence(len(event_log), partial(_events, event_log, start_s, name))


def _events(event_log: EventLog, start_s: float, name: Callable[[GuardEvent], str], part: slice) -> list[Event]:
    """Return some of the events."""
    return [Event(name(guard_event), start_s + guard_event.time, guard_event.before, guard_event.after) for guard_event in event_log[part]]


@dataclass(frozen=True, eq=False)
class Channel:
    """One quantity against time.

    Parameters
    ----------
    name : str
        Identifier (``rotation``), also the column's name in files together with the unit.
    unit : str
        SI unit, ``1`` when it has none.
    values : (n,) array, in `unit`
        One value per entry of the response's time axis.
    symbol : str
        The paper's letter, for axis labels.
    """

    name: str
    unit: str
    values: FloatArray
    symbol: str = ""


@dataclass(frozen=True, eq=False)
class Histories:
    """Quantities on one time axis.

    Parameters
    ----------
    time : (n,) array, s
        From the record's first sample.
    channels : tuple of Channel
    """

    time: FloatArray
    channels: tuple[Channel, ...] = ()


def constant_histories(histories: Histories) -> Histories:
    """Return curves that were made already: those of an answer that came from another process."""
    return histories


def no_histories() -> Histories:
    """Return the curves of an answer that has none."""
    return Histories(np.empty(0))


@dataclass(frozen=True, eq=False, repr=False)
class Response(PlotMixin, Generic[Outcome]):
    """The answer of a solver to one motion.

    Parameters
    ----------
    model : str
        Name of the solver.
    outcome : dataclass
        The numbers a user asks for; its fields are the keys of the JSON document.
    motion, body : Motion, object
        What shook, and what stood there.
    make_histories : callable
        Makes :attr:`time` and :attr:`channels`, which are made when one of them is first asked for: a verdict needs neither.
    phases, events : sequence
        In the order of time.
    options : mapping
        Everything else that determines the answer, SI.
    status : Status
        How the integration ended.
    warnings : tuple of str
        What the user should know before believing the numbers.
    citations : tuple of str
        Keys of the papers relied on.
    """

    model: str
    outcome: Outcome
    motion: Motion
    body: Any
    make_histories: Callable[[], Histories] = no_histories
    phases: Sequence[Phase] = ()
    events: Sequence[Event] = ()
    options: Mapping[str, Any] = field(default_factory=dict)
    status: Status = Status.RECORD_ENDED
    warnings: tuple[str, ...] = ()
    citations: tuple[str, ...] = ()

    @cached_property
    def histories(self) -> Histories:
        """The time axis and the quantities on it."""
        return self.make_histories()

    @property
    def time(self) -> FloatArray:
        """Times from the record's first sample, (n,), s: the samples, and both sides of each event where the model logs them."""
        return self.histories.time

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Quantities on that axis; displacements are relative to the ground unless the name says otherwise."""
        return self.histories.channels

    def __repr__(self) -> str:
        """Return what it is in a line, without curves and lists."""
        body = getattr(self.body, "name", "") or type(self.body).__name__
        label = f"Response {self.model} of {body} under {self.motion.name or 'x'}"
        return summary_repr(label, self.outcome, self.status.name.lower())

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled: the curves themselves stand for what makes them, which belongs to this process."""
        state = {name: value for name, value in self.__dict__.items() if name != "histories"}
        return {**state, "make_histories": partial(constant_histories, self.histories)}

    def __getitem__(self, name: str) -> FloatArray:
        """Return the values of a channel by name."""
        for channel in self.channels:
            if channel.name == name:
                return channel.values
        raise KeyError(f"no channel {name!r}; there are {', '.join(c.name for c in self.channels)}")

    def phase_of_row(self) -> IntArray:
        """Return, for each entry of the time axis, the index of its phase, (n,).

        Where an event stands twice, the first of the pair belongs to the phase it ends.
        """
        if not self.phases:
            return np.zeros(self.time.size, dtype=np.int64)
        starts = np.array([phase.start_s for phase in self.phases])
        index = np.clip(np.searchsorted(starts, self.time, side="right") - 1, 0, None)
        first_of_pair = np.append(self.time[1:] == self.time[:-1], False)
        ends_one = first_of_pair & (self.time == starts[index]) & (index > 0)
        return (index - ends_one).astype(np.int64)

    def summary(self) -> dict[str, Any]:
        """Return the outcome as a plain dictionary, with the component first."""
        return {"component": self.motion.name, **asdict(self.outcome)}  # type: ignore[call-overload]

    def to_columns(self) -> dict[str, FloatArray]:
        """Return the time axis and every channel as columns named ``name_unit``, for tables and files."""
        columns = {"time_s": self.time}
        for channel in self.channels:
            suffix = "" if channel.unit == "1" else "_" + channel.unit.replace("/", "_").replace("^", "")
            columns[channel.name + suffix] = np.asarray(channel.values)
        return columns

    def to_dataframe(self) -> Any:
        """Return the columns as a pandas DataFrame (pandas must be installed)."""
        import pandas as pd

        return pd.DataFrame(self.to_columns())


__all__ = ["Channel", "Histories", "Event", "LazySequence", "Phase", "Response", "Status", "make_events", "make_phases"]
