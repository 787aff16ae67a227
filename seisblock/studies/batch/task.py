"""Batch task: one record with all its rows; plain data, since tasks are sent to other processes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from seisblock.bodies.factory import block_for_motion
from seisblock.bodies.table import BodySpec, resolve_kinds
from seisblock.core.errors import ParameterError, SeisblockError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.registry import RowResult, Solver, SolverBody, get_solver
from seisblock.core.results import Status
from seisblock.readers.discover import RecordSource
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read_source
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.records.qc_report import qc_summary, require_clean
from seisblock.records.site import matches_station
from seisblock.studies.batch.probability import LEFT_OUT, probability_columns
from seisblock.studies.batch.scalar_fields import scalar_fields
from seisblock.studies.batch.shaking import shaking_columns
from seisblock.studies.batch.table import REASON, WARNINGS, Row
from seisblock.studies.batch.worst_azimuth import is_all_azimuths
from seisblock.studies.solvers import solver_studies


def solve_vectorized(solver: Solver, bodies: Sequence[SolverBody], motion: Motion) -> dict[str, RowResult]:
    """Return results by body name for the bodies that a solver can vectorise; the others are solved one by one."""
    if solver.solve_rows is None:
        return {}
    groups: dict[tuple[str, ...], list[SolverBody]] = {}
    for body in bodies:
        shared = tuple(text for name, text in body.option_texts.items() if name not in solver.row_options)
        groups.setdefault(shared, []).append(body)
    results: dict[str, RowResult] = {}
    for group in groups.values():
        try:
            results |= solver.solve_rows(group, motion)
        except SeisblockError:
            # solved one by one, the failing body is identified with its reason
            continue
    return results


ALL = "all"


@dataclass(frozen=True)
class RejectedBody:
    """A body that a solver rejects, with the reason for its rows."""

    name: str
    reason: str


@dataclass(frozen=True)
class Plan:
    """Processing of each record of a batch.

    Parameters
    ----------
    solver : str
    bodies : tuple of SolverBody or RejectedBody
    components : tuple of str
        Codes or azimuths; all horizontals when empty; ``all-azimuths`` for the worst of all directions.
    preparation : Preparation
    read_options : ReadOptions
        Properties of files that lack them.
    runs, seed : int
        Number of samples of a probability, 0 for none, and their seed.
    strict : bool
        Whether records with quality flags fail.
    """

    solver: str
    bodies: tuple[SolverBody | RejectedBody, ...]
    components: tuple[str, ...] = ()
    preparation: Preparation = field(default_factory=Preparation)
    read_options: ReadOptions = field(default_factory=ReadOptions)
    runs: int = 0
    seed: int = 0
    strict: bool = False

    @property
    def model(self) -> Solver:
        """Registered solver."""
        return get_solver(self.solver)


def build_solver_bodies(
    solver: Solver, bodies: Sequence[BodySpec | SolverBody], options: Mapping[str, Any]
) -> tuple[SolverBody | RejectedBody, ...]:
    """Return accepted and rejected bodies of a solver.

    Raises
    ------
    ParameterError
        If it can take none of them, or two share a name.
    """
    result: list[SolverBody | RejectedBody] = []
    for item in bodies:
        body = resolve_kinds([item])[0][0] if isinstance(item, BodySpec) and "kind" in solver.columns else item
        if isinstance(body, BodySpec) and body.error is not None:
            result.append(RejectedBody(body.name, body.error))
            continue
        try:
            result.append(
                solver.build_body(body, options) if isinstance(body, BodySpec) else replace(body, options=solver.make_options(options))
            )
        except SeisblockError as error:
            result.append(RejectedBody(body.name, error.message))
    rejected = [item for item in result if isinstance(item, RejectedBody)]
    if rejected and len(rejected) == len(result):
        raise ParameterError("none of the bodies can be computed: {reason}", reason=rejected[0].reason)
    duplicates = [name for name, count in Counter(item.name for item in result).items() if count > 1]
    if duplicates:
        raise ParameterError("two bodies have the name {name!r}; rename one", name=duplicates[0][:100])
    return tuple(result)


def record_rows(recording: RecordSource | Record, plan: Plan) -> list[Row]:
    """Return the rows of one record: each component with each body; one row with the reason if it cannot be read.

    Stations of a bundle other than the requested one have no rows.

    Parameters
    ----------
    recording : RecordSource or Record
    plan : Plan
    """
    columns = _record_columns(recording, plan)
    try:
        record = recording if isinstance(recording, Record) else read_source(recording, plan.read_options)
        if plan.read_options.station is not None and not matches_station(record, plan.read_options.station):
            return []
        columns |= {
            "station": record.station or None,
            "seed_id": record.seed_id or None,
            "start": record.start.isoformat() if record.start else None,
        }
        if plan.strict:
            require_clean(record)
        doubts = qc_summary([record])
        processed_record = plan.preparation.apply(record)
    except SeisblockError as error:
        return [{**columns, REASON: error.message}]
    return component_rows(processed_record, plan, columns, doubts)


def component_rows(record: Record, plan: Plan, columns: Row | None = None, doubts: Sequence[str] = ()) -> list[Row]:
    """Return the rows of a processed record: each component, or the worst azimuth, with each body.

    Parameters
    ----------
    record : Record
    plan : Plan
    columns : mapping
        Further columns of each row.
    doubts : sequence of str
        First warnings of each row.
    """
    columns = columns or {}
    if is_all_azimuths(plan.components):
        return [{**columns, **_worst_azimuth_row(record, body, plan, doubts)} for body in plan.bodies]
    names = _selected_components(record, plan.components)
    return [row for name in names for row in _component_rows(record, name, plan, columns, doubts)]


def failure_row(plan: Plan, recording: RecordSource | Record, reason: str) -> list[Row]:
    """Return the row of a record whose workers all died."""
    return [
        {**_record_columns(recording, plan), REASON: lazy_gettext("all workers that computed this record failed: {reason}", reason=reason)}
    ]


def _record_columns(recording: RecordSource | Record, plan: Plan) -> dict[str, Any]:
    """Return the columns known before a record is read."""
    if isinstance(recording, RecordSource):
        return {"record": recording.name, "path": recording.path, "solver": plan.solver}
    return {"record": recording.source.rsplit("/", 1)[-1], "path": recording.source, "solver": plan.solver}


def _selected_components(record: Record, requested: tuple[str, ...]) -> tuple[str, ...]:
    if requested and not any(name.lower() == ALL for name in requested):
        return requested
    return tuple(component.code for component in record.horizontals) or requested or (ALL,)


def _component_rows(record: Record, name: str, plan: Plan, columns: Row, doubts: Sequence[str]) -> Iterator[Row]:
    try:
        motion = motion_of(record, name)
    except SeisblockError as error:
        yield {**columns, "component": name, REASON: error.message}
        return
    bodies = [_align(body, motion, plan.model) for body in plan.bodies]
    for body, row in zip(bodies, _result_rows(bodies, motion, plan, doubts), strict=True):
        yield {**columns, "component": motion.name, "body": body.name, **row}


def _result_rows(bodies: Sequence[SolverBody | RejectedBody], motion: Motion, plan: Plan, doubts: Sequence[str]) -> Iterator[Row]:
    """Yield the result of each body under one motion, or the reason of its failure."""
    vectorized = solve_vectorized(plan.model, [body for body in bodies if isinstance(body, SolverBody)], motion)
    rows = [
        {REASON: body.reason} if isinstance(body, RejectedBody) else _outcome_row(body, motion, plan, doubts, vectorized.get(body.name))
        for body in bodies
    ]
    solved = [body for body, row in zip(bodies, rows, strict=True) if isinstance(body, SolverBody) and REASON not in row]
    shaking = iter(shaking_columns(plan.solver, solved, motion))
    return (row if REASON in row else {**row, **next(shaking)} for row in rows)


def _align(body: SolverBody | RejectedBody, motion: Motion, solver: Solver) -> SolverBody | RejectedBody:
    """Return a body as it stands towards the motion, with its base projected, or the reason why it cannot."""
    if isinstance(body, RejectedBody) or solver.spatial:
        return body
    try:
        block = block_for_motion(body.body, motion)
    except SeisblockError as error:
        return RejectedBody(body.name, error.message)
    return body if block is body.body else replace(body, body=block)


def _worst_azimuth_row(record: Record, body: SolverBody | RejectedBody, plan: Plan, doubts: Sequence[str]) -> Row:
    row: Row = {"component": ALL_AZIMUTHS, "body": body.name}
    if isinstance(body, RejectedBody):
        return {**row, REASON: body.reason}
    sweep = solver_studies(plan.solver).worst_azimuth
    assert sweep is not None
    try:
        worst, direction_counts, remarks = sweep(body, record, plan.runs, plan.seed)
        motion = motion_of(record, worst)
    except SeisblockError as error:
        return {**row, REASON: error.message}
    aligned = _align(body, motion, plan.model)
    assert isinstance(aligned, SolverBody)
    return {
        **row,
        "component": motion.name,
        **direction_counts,
        **next(_result_rows([aligned], motion, plan, [*doubts, *remarks])),
    }


def _outcome_row(body: SolverBody, motion: Motion, plan: Plan, doubts: Sequence[str], result: RowResult | None) -> Row:
    """Return the outcome of one body under one motion, solved now unless it is given, or the reason of its failure."""
    model = plan.model
    try:
        if result is None:
            response = model.solve(body.body, motion, **body.options.keywords())
            if response.status == Status.TOO_MANY_EVENTS:
                return {REASON: response.warnings[0]}
            result = vars(response.outcome), response.warnings
        chance = probability_columns(plan.solver, body, motion, plan.runs, plan.seed) if plan.runs else {}
    except SeisblockError as error:
        return {REASON: error.message}
    outcome, warnings = result
    left_out = chance.pop(LEFT_OUT, None)
    messages = [*doubts, *warnings, *([] if left_out is None else [left_out])]
    scalars = {name: _to_plain(outcome[name], kind) for name, kind in scalar_fields(model.outcome).items()}
    return {**scalars, **chance, WARNINGS: "; ".join(messages) or None}


def _to_plain(value: Any, kind: type) -> Any:
    """Return a value of a plain Python type."""
    return None if value is None else kind(value)
