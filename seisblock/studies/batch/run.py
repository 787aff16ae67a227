"""Batch execution on local threads or on a Dask cluster."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from functools import partial
from itertools import groupby
from os import PathLike
from typing import TYPE_CHECKING, Any, TypeAlias

from seisblock.bodies.block import Block
from seisblock.bodies.body_name import body_name
from seisblock.bodies.table import BodySpec, pile_notes, read_bodies, resolve_kinds
from seisblock.core import checks
from seisblock.core.errors import KindError, ParameterError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.registry import Solver, SolverBody, get_solver
from seisblock.core.typing import Progress
from seisblock.readers.discover import RecordSource, iter_records
from seisblock.readers.options import ReadOptions
from seisblock.readers.source import Location
from seisblock.records import Preparation, Record
from seisblock.studies.batch.table import BatchTable, Row, batch_columns
from seisblock.studies.batch.task import Plan, RejectedBody, build_solver_bodies, failure_row, record_rows
from seisblock.studies.batch.worst_azimuth import check_all_azimuths, is_all_azimuths
from seisblock.studies.parallel import MAX_PENDING_RECORDS, map_threads
from seisblock.studies.solvers import solver_studies

if TYPE_CHECKING:
    from distributed import Client

MAX_NAMES = 3
"""Largest number of bodies named in a note."""

NO_PROCESSING = Preparation()
"""Default preparation: only the processing required by the format."""

Bodies: TypeAlias = "Location | Mapping[str, Any] | Iterable[Any]"


def run_batch(
    records: Location | Record | Iterable[Location | Record],
    bodies: Bodies,
    solver: str,
    *,
    components: str | Sequence[str] = (),
    preparation: Preparation = NO_PROCESSING,
    runs: int = 0,
    seed: int = 0,
    workers: int | None = None,
    client: Client | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> BatchTable:
    """Return the results of records and bodies: a row for each record, component and body.

    Unreadable records, missing components and rejected bodies give rows with a reason.

    Parameters
    ----------
    records : path or Record, or several
        Files, folders, patterns, ``@list.txt`` and bundles, see :func:`~seisblock.readers.discover.iter_records`; or records as they
        were read.
    bodies : path, bodies, or mapping of names to bodies
        Tables and files, see :func:`~seisblock.bodies.table.read_bodies`; or bodies of the kind that the solver takes.
    solver : str
        ``respond``, ``rock``, ``slide``, ``jump``, ``uplift`` or ``stack``.
    components : str, or sequence of str
        Codes or azimuths; default: all horizontals of each record. ``all-azimuths`` solves every direction in steps of 5 degrees and
        returns the worst one of each body (``respond``, ``rock``, ``slide``).
    preparation : Preparation
        Processing of each record.
    runs, seed : int
        Number of samples of a probability (``respond``, ``rock``), 0 for none, and their seed.
    workers : int
        Threads; default: number of cores.
    client : distributed.Client
        Client of a Dask scheduler: each record is a task. The table is the same.
    progress : callable
        Called with the number of finished records and their total.
    options
        Of the solver, for every body without own values: ``mu``, ``vertical``, ``gravity``, ...

    Returns
    -------
    BatchTable

    Raises
    ------
    ParameterError
        If solver or option is unknown, or the solver accepts none of the bodies.
    BodyError, RecordNotFoundError
        If a list of bodies or of records cannot be read.

    Examples
    --------
    >>> table = run_batch("synthetic_jma.csv", "gravestone", "respond", components="EW")
    >>> table["body"], table["overturned"]
    (['gravestone'], [True])
    """
    plan, notes = make_plan(
        bodies, solver, components=components, preparation=preparation, runs=runs, seed=seed, options=options, read_options=ReadOptions()
    )
    tasks = list(_tasks(records, plan.read_options))
    row_groups = iter_record_rows(tasks, plan, total=len(tasks), workers=workers, client=client, progress=progress)
    rows = [row for group in row_groups for row in group]
    return BatchTable(batch_columns(plan.model, runs=runs, all_azimuths=is_all_azimuths(plan.components)), rows, notes)


def make_plan(
    bodies: Bodies,
    solver: str,
    *,
    options: Mapping[str, Any],
    components: str | Sequence[str] = (),
    preparation: Preparation = NO_PROCESSING,
    read_options: ReadOptions,
    runs: int = 0,
    seed: int = 0,
    strict: bool = False,
) -> tuple[Plan, tuple[str, ...]]:
    """Return the plan of a batch and its warnings; see :func:`run_batch`."""
    model = get_solver(solver)
    checks.instance(preparation, Preparation)
    if not (isinstance(runs, int) and runs >= 0):
        raise ParameterError("the number of samples must be a whole number, 0 for none; found {runs}", runs=runs)
    if runs and not solver_studies(solver).samples_in_rows:
        raise ParameterError("{solver} does not support samples: omit `runs`, or use respond or rock", solver=solver)
    model.check_options(options)
    body_list = named_bodies(bodies, model)
    names = (components,) if isinstance(components, str) else tuple(components)
    check_all_azimuths(solver, names, options)
    solver_bodies = build_solver_bodies(model, body_list, options)
    plan = Plan(solver, solver_bodies, names, preparation, read_options, runs, checks.seed(seed), strict)
    return plan, (*ignored_column_notes(model, body_list), *narrow_depth_notes(model, solver_bodies, names))


def iter_record_rows(
    tasks: Iterable[RecordSource | Record],
    plan: Plan,
    *,
    total: int,
    workers: int | None = None,
    client: Client | None = None,
    progress: Progress | None = None,
) -> Iterator[list[Row]]:
    """Yield the rows of one record after another, in the order of the records.

    Parameters
    ----------
    tasks : iterable of RecordSource or Record
        Consumed lazily; members of a bundle are released after use.
    plan : Plan
    total : int
        Number of tasks, for the progress.
    workers, client, progress
        As in :func:`run_batch`.
    """
    work = partial(record_rows, plan=plan)
    results: Generator[list[Row], None, None]
    if client is None:
        results = map_threads(work, tasks, workers=workers, max_pending=MAX_PENDING_RECORDS)
    else:
        from seisblock.studies.batch.cluster import map_cluster

        results = map_cluster(client, work, tasks, on_lost=partial(failure_row, plan))
    with closing(results):
        for count, rows in enumerate(results, start=1):
            yield rows
            if progress is not None:
                progress(count, total)


def _tasks(records: Location | Record | Iterable[Location | Record], read_options: ReadOptions) -> Iterator[RecordSource | Record]:
    """Yield record sources and records of a batch."""
    sources: Iterable[Location | Record] = [records] if isinstance(records, (str, PathLike, Record)) else records
    for kind, group in groupby(sources, key=lambda source: isinstance(source, Record)):
        if kind:
            yield from group  # type: ignore[misc]
        else:
            yield from iter_records([str(source) for source in group], read_options)


def named_bodies(bodies: Bodies, model: Solver) -> list[BodySpec | SolverBody]:
    """Return the bodies of a batch with their names; given body objects take all options unchanged."""
    if isinstance(bodies, (str, PathLike)):
        return list(read_bodies(str(bodies)))
    if isinstance(bodies, model.bodies):
        bodies = [bodies]
    if isinstance(bodies, Mapping):
        pairs = [(str(name), body) for name, body in bodies.items()]
    elif isinstance(bodies, Iterable):
        pairs = [(getattr(body, "name", "") or lazy_gettext("body {number}", number=n), body) for n, body in enumerate(bodies, start=1)]
    else:
        raise KindError("bodies required (a table, files or body objects); found {found}", found=checks.type_name(bodies))
    if not pairs:
        raise ParameterError("no body given; give at least one")
    result: list[BodySpec | SolverBody] = []
    for name, body in pairs:
        if isinstance(body, (str, PathLike)):
            result += read_bodies(str(body))
        elif isinstance(body, BodySpec):
            result.append(body)
        elif isinstance(body, model.bodies):
            result.append(SolverBody(name, body, None))
        else:
            raise KindError(
                "{solver} requires {kinds}; found {found}",
                solver=model.name,
                kinds=[kind.__name__ for kind in model.bodies],
                found=checks.type_name(body),
            )
    return result


def narrow_depth_notes(model: Solver, bodies: Sequence[SolverBody | RejectedBody], components: Sequence[str]) -> tuple[Message, ...]:
    """Return a note on blocks with a depth below their width: in the plane of a component only the width counts."""
    blocks = [(item.name, item.body) for item in bodies if isinstance(item, SolverBody) and isinstance(item.body, Block)]
    names = [body_name(name) for name, block in blocks if block.depth is not None and block.depth < block.width]
    if not names or model.spatial or is_all_azimuths(components):
        return ()
    text = (
        "{names} ({count} of {all} bodies): depth smaller than the width, which alone lies along the motion; exchange width and depth "
        "for the weaker side"
    )
    return (lazy_gettext(text, names=names[:MAX_NAMES], count=len(names), all=len(bodies)),)


def ignored_column_notes(model: Solver, bodies: Sequence[BodySpec | SolverBody]) -> tuple[str, ...]:
    """Return warnings on columns and kinds of the list of bodies that the solver does not use."""
    specs = [body for body in bodies if isinstance(body, BodySpec)]
    ignored = dict.fromkeys(key for spec in specs for key in model.ignored_columns(spec.parameters))
    notes = [lazy_gettext("{solver} does not use {columns}", columns=list(ignored), solver=model.name)] if ignored else []
    piles = [] if model.spatial else pile_notes(specs)
    return (*notes, *piles, *(resolve_kinds(specs)[1] if "kind" in model.columns else ()))
