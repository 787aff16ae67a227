"""One task of a batch: a record with all its rows. It travels to other processes, so it holds nothing but data."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from seisblock.bodies.library import along
from seisblock.bodies.roster import ListedBody
from seisblock.errors import ParameterError, SeisblockError
from seisblock.readers.dispatch import Options
from seisblock.readers.gather import Recording
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.doubtful import refuse_doubtful, sentences
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.records.site import is_of_station
from seisblock.results import Status
from seisblock.studies.batch.azimuths import around, worst_azimuth
from seisblock.studies.batch.models import BATCH_MODELS, LEFT_OUT, BatchModel, Placed
from seisblock.studies.batch.table import REASON, WARNINGS, Row
from seisblock.studies.batch.together import answers_together
from seisblock.words import said

ALL = "all"


@dataclass(frozen=True)
class Unplaced:
    """A body that a solver cannot take, and why: the reason stands in each of its rows."""

    name: str
    reason: str


@dataclass(frozen=True)
class Plan:
    """What is done with each record of a batch.

    Parameters
    ----------
    solver : str
    bodies : tuple of Placed or Unplaced
    components : tuple of str
        Codes or azimuths; all horizontals when empty; ``all-azimuths`` for the worst of all directions.
    preparation : Preparation
    reading : Options
        What the caller says of files that do not say it themselves.
    runs, seed : int
        Perturbed runs behind a probability, 0 for none, and their seed.
    strict : bool
        Whether a record about which there is any doubt fails.
    """

    solver: str
    bodies: tuple[Placed | Unplaced, ...]
    components: tuple[str, ...] = ()
    preparation: Preparation = field(default_factory=Preparation)
    reading: Options = field(default_factory=Options)
    runs: int = 0
    seed: int = 0
    strict: bool = False

    @property
    def model(self) -> BatchModel:
        """The solver's entry."""
        return BATCH_MODELS[self.solver]


def placed(model: BatchModel, bodies: Sequence[ListedBody | Placed], options: Mapping[str, Any]) -> tuple[Placed | Unplaced, ...]:
    """Return bodies as a solver takes them, and those that it cannot take.

    Raises
    ------
    ParameterError
        If it can take none of them, or two share a name.
    """
    found: list[Placed | Unplaced] = []
    for body in bodies:
        try:
            found.append(model.place(body, options) if isinstance(body, ListedBody) else replace(body, options={**options, **body.options}))
        except SeisblockError as error:
            found.append(Unplaced(body.name, error.said))
    wrong = [each for each in found if isinstance(each, Unplaced)]
    if wrong and len(wrong) == len(found):
        raise ParameterError("{solver} can take none of the bodies: {reason}", solver=model.name, reason=wrong[0].reason)
    twice = [name for name, count in Counter(each.name for each in found).items() if count > 1]
    if twice:
        raise ParameterError("two bodies are called {name!r}, and a row of the answer could be either: rename one", name=twice[0][:100])
    return tuple(found)


def rows_of(recording: Recording | Record, plan: Plan) -> list[Row]:
    """Return the rows of one record: each component with each body; one with the reason where the record cannot be read.

    A station of a bundle that is not the one asked for has none.

    Parameters
    ----------
    recording : Recording or Record
    plan : Plan
    """
    known = _known(recording, plan)
    try:
        record = recording if isinstance(recording, Record) else recording.read(plan.reading)
        if plan.reading.station is not None and not is_of_station(record, plan.reading.station):
            return []
        known |= {"station": record.station or None, "start": record.start.isoformat() if record.start else None}
        if plan.strict:
            refuse_doubtful(record)
        doubts = sentences([record])
        prepared = plan.preparation.apply(record)
    except SeisblockError as error:
        return [{**known, REASON: error.said}]
    return rows_under(prepared, plan, known, doubts)


def rows_under(record: Record, plan: Plan, known: Row | None = None, doubts: Sequence[str] = ()) -> list[Row]:
    """Return the rows of a record to which nothing is done any more: each component, or the worst of all directions, with each body.

    Parameters
    ----------
    record : Record
    plan : Plan
    known : mapping
        What each row says beside.
    doubts : sequence of str
        The warnings with which each begins.
    """
    known = known or {}
    if around(plan.components):
        return [{**known, **_of_the_worst(record, body, plan, doubts)} for body in plan.bodies]
    names = _components(record, plan.components)
    return [row for name in names for row in _of_component(record, name, plan, known, doubts)]


def row_without_answer(plan: Plan, recording: Recording | Record, reason: str) -> list[Row]:
    """Return the row of a record that no worker of a cluster survived."""
    return [{**_known(recording, plan), REASON: said("every worker that took this record died: {reason}", reason=reason)}]


def _known(recording: Recording | Record, plan: Plan) -> dict[str, Any]:
    """Return what a row says of a record before it is read."""
    if isinstance(recording, Recording):
        return {"record": recording.name, "path": recording.path, "solver": plan.solver}
    return {"record": recording.source.rsplit("/", 1)[-1], "path": recording.source, "solver": plan.solver}


def _components(record: Record, asked: tuple[str, ...]) -> tuple[str, ...]:
    """Return the components, or azimuths, of a record that are looked at."""
    if asked and not any(name.lower() == ALL for name in asked):
        return asked
    return tuple(component.code for component in record.horizontals) or asked or (ALL,)


def _of_component(record: Record, name: str, plan: Plan, known: Row, doubts: Sequence[str]) -> Iterator[Row]:
    """Yield the rows of one component."""
    try:
        motion = motion_of(record, name)
    except SeisblockError as error:
        yield {**known, "component": name, REASON: error.said}
        return
    together = answers_together(plan.solver, [body for body in plan.bodies if isinstance(body, Placed)], motion)
    for body in plan.bodies:
        row = {**known, "component": motion.name, "body": body.name}
        if isinstance(body, Unplaced):
            yield {**row, REASON: body.reason}
        elif body.name in together:
            found, told = together[body.name]
            yield {**row, **found, WARNINGS: "; ".join([*doubts, *told]) or None}
        else:
            yield {**row, **_answer(motion, body, plan, doubts)}


def _of_the_worst(record: Record, body: Placed | Unplaced, plan: Plan, doubts: Sequence[str]) -> Row:
    """Return what a solver says of one body in the worst of all directions."""
    row: Row = {"component": ALL_AZIMUTHS, "body": body.name}
    if isinstance(body, Unplaced):
        return {**row, REASON: body.reason}
    try:
        worst, seen, remarks = worst_azimuth(plan.solver, body, record)
        motion = motion_of(record, worst)
    except SeisblockError as error:
        return {**row, REASON: error.said}
    return {**row, "component": motion.name, **seen, **_answer(motion, body, plan, [*doubts, *remarks])}


def _answer(motion: Motion, body: Placed, plan: Plan, doubts: Sequence[str]) -> Row:
    """Return what a solver says of one body alone under one motion, or why it does not."""
    model = plan.model
    try:
        there = replace(body, body=along(body.body, motion))
        response = model.solve(there.body, motion, **body.options)
        chance = model.chance(there, motion, plan.runs, plan.seed, body.options) if plan.runs and model.chance is not None else {}
    except SeisblockError as error:
        return {REASON: error.said}
    if response.status == Status.TOO_MANY_EVENTS:
        return {REASON: response.warnings[0]}
    told = [*doubts, *response.warnings, *([chance[LEFT_OUT]] if LEFT_OUT in chance else ())]
    found = {name: _plain(getattr(response.outcome, name), kind) for name, kind in model.scalars.items()}
    return {**found, **{key: value for key, value in chance.items() if key != LEFT_OUT}, WARNINGS: "; ".join(told) or None}


def _plain(value: Any, kind: type) -> Any:
    """Return a value of a plain Python type."""
    return None if value is None else kind(value)
