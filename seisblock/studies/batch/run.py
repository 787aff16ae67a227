"""Running a batch: one record after another on all cores, or as tasks of a cluster that is there already."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from functools import partial
from itertools import groupby
from os import PathLike
from typing import TYPE_CHECKING, Any, TypeAlias

from seisblock import checks
from seisblock.bodies.roster import ListedBody, read_bodies
from seisblock.errors import KindError, ParameterError
from seisblock.readers.dispatch import Options
from seisblock.readers.gather import Recording, gather
from seisblock.readers.source import Location
from seisblock.records import Preparation, Record
from seisblock.studies.batch.azimuths import around, check_around
from seisblock.studies.batch.models import BatchModel, Placed, batch_model
from seisblock.studies.batch.table import BatchTable, Row, columns_of
from seisblock.studies.batch.task import Plan, placed, row_without_answer, rows_of
from seisblock.studies.runs import RECORDS, in_threads
from seisblock.typing import Progress
from seisblock.words import said

if TYPE_CHECKING:
    from distributed import Client

AS_READ = Preparation()
"""Nothing is done to a record but what its format needs."""

Bodies: TypeAlias = "Location | Mapping[str, Any] | Iterable[Any]"


def run_batch(
    records: Location | Record | Iterable[Location | Record],
    bodies: Bodies,
    solver: str,
    *,
    components: str | Sequence[str] = (),
    preparation: Preparation = AS_READ,
    runs: int = 0,
    seed: int = 0,
    workers: int | None = None,
    client: Client | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> BatchTable:
    """Return what many records do to many bodies: a row for each record, component and body.

    A record that cannot be read, a component that it lacks and a body that the solver refuses are rows with a reason.

    Parameters
    ----------
    records : path or Record, or several
        Files, folders, patterns, ``@list.txt`` and bundles, see :func:`~seisblock.readers.gather.gather`; or records as they were read.
    bodies : path, bodies, or mapping of names to bodies
        Tables and files, see :func:`~seisblock.bodies.roster.read_bodies`; or bodies of the kind that the solver takes.
    solver : str
        ``respond``, ``rock``, ``slide``, ``jump``, ``uplift`` or ``stack``.
    components : str, or sequence of str
        Codes or azimuths; all horizontals of each record when left out. ``all-azimuths`` looks in every direction, in steps of 5 degrees,
        and answers for the one that is worst for each body (``respond``, ``rock``, ``slide``).
    preparation : Preparation
        What is done to each record before.
    runs, seed : int
        Perturbed runs behind a probability (``respond``, ``rock``), 0 for none, and their seed.
    workers : int
        Threads; as many as there are cores when left out.
    client : distributed.Client
        Of a Dask scheduler: each record is a task. The table is the same.
    progress : callable
        Told the number of records done and the number in all.
    options
        Of the solver, for every body whose row says nothing else: ``mu``, ``vertical``, ``gravity``, ...

    Raises
    ------
    ParameterError
        If there is no such solver, it can take none of the bodies, or it has no such option.
    BodyError, RecordNotFoundError
        If a list of bodies or of records cannot be read.

    Examples
    --------
    >>> table = run_batch("synthetic_jma.csv", "gravestone", "respond", components="EW")
    >>> table["body"], table["overturned"]
    (['gravestone'], [True])
    """
    plan, notes = make_plan(
        bodies, solver, components=components, preparation=preparation, runs=runs, seed=seed, options=options, reading=Options()
    )
    tasks = list(_tasks(records, plan.reading))
    found = each_record(tasks, plan, total=len(tasks), workers=workers, client=client, progress=progress)
    rows = [row for some in found for row in some]
    return BatchTable(columns_of(plan.model, runs=runs, around=around(plan.components)), rows, notes)


def make_plan(
    bodies: Bodies,
    solver: str,
    *,
    options: Mapping[str, Any],
    components: str | Sequence[str] = (),
    preparation: Preparation = AS_READ,
    reading: Options,
    runs: int = 0,
    seed: int = 0,
    strict: bool = False,
) -> tuple[Plan, tuple[str, ...]]:
    """Return what is done with each record of a batch, and what is to be known of it; see :func:`run_batch`."""
    model = batch_model(solver)
    checks.instance(preparation, Preparation)
    if not (isinstance(runs, int) and runs >= 0):
        raise ParameterError("the number of runs must be a whole number, 0 for none; found {runs}", runs=runs)
    if runs and model.chance is None:
        raise ParameterError("{solver} has no perturbed versions: leave the runs out, or take respond or rock", solver=solver)
    model.refuse_unknown(options)
    listed = named(bodies, model)
    names = (components,) if isinstance(components, str) else tuple(components)
    check_around(solver, names, options)
    plan = Plan(solver, placed(model, listed, options), names, preparation, reading, runs, checks.seed(seed), strict)
    return plan, unheard(model, listed)


def each_record(
    tasks: Iterable[Recording | Record],
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
    tasks : iterable of Recording or Record
        Taken as they are needed: a bundle's members are not held longer than they are.
    plan : Plan
    total : int
        How many there are, for the progress.
    workers, client, progress
        As in :func:`run_batch`.
    """
    work = partial(rows_of, plan=plan)
    answers: Generator[list[Row], None, None]
    if client is None:
        answers = in_threads(work, tasks, workers=workers, ahead=RECORDS)
    else:
        from seisblock.studies.batch.cluster import on_cluster

        answers = on_cluster(client, work, tasks, lost=partial(row_without_answer, plan))
    with closing(answers):
        for done, rows in enumerate(answers, start=1):
            yield rows
            if progress is not None:
                progress(done, total)


def _tasks(records: Location | Record | Iterable[Location | Record], reading: Options) -> Iterator[Recording | Record]:
    """Yield the records of a batch: those that were read already, and those that names stand for."""
    given: Iterable[Location | Record] = [records] if isinstance(records, (str, PathLike, Record)) else records
    for kind, some in groupby(given, key=lambda each: isinstance(each, Record)):
        if kind:
            yield from some  # type: ignore[misc]
        else:
            yield from gather([str(each) for each in some], reading)


def named(bodies: Bodies, model: BatchModel) -> list[ListedBody | Placed]:
    """Return the bodies of a batch with their names; those that are given as they are take every option as it is given."""
    if isinstance(bodies, (str, PathLike)):
        return list(read_bodies(str(bodies)))
    if isinstance(bodies, model.kinds):
        bodies = [bodies]
    if isinstance(bodies, Mapping):
        pairs = [(str(name), body) for name, body in bodies.items()]
    elif isinstance(bodies, Iterable):
        pairs = [(getattr(body, "name", "") or said("body {number}", number=n), body) for n, body in enumerate(bodies, start=1)]
    else:
        raise KindError("bodies are needed: a table, files, or bodies; found {found}", found=checks.kind_of(bodies))
    if not pairs:
        raise ParameterError("no body was named: give at least one")
    found: list[ListedBody | Placed] = []
    for name, body in pairs:
        if isinstance(body, (str, PathLike)):
            found += read_bodies(str(body))
        elif isinstance(body, ListedBody):
            found.append(body)
        elif isinstance(body, model.kinds):
            found.append(Placed(name, body, {}))
        else:
            raise KindError(
                "{solver} takes {kinds}, found {found}",
                solver=model.name,
                kinds=[kind.__name__ for kind in model.kinds],
                found=checks.kind_of(body),
            )
    return found


def unheard(model: BatchModel, bodies: Sequence[ListedBody | Placed]) -> tuple[str, ...]:
    """Return what is to be known of a list of bodies that says more than a solver hears."""
    unheard = dict.fromkeys(key for body in bodies if isinstance(body, ListedBody) for key in model.unheard(body))
    return (said("{solver} takes no notice of {columns}", columns=list(unheard), solver=model.name),) if unheard else ()
