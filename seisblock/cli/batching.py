"""How ``seisblock batch`` goes about it: what is finished is kept in a journal, and the table is written from that."""

from __future__ import annotations

import hashlib
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import groupby, tee
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock import __version__
from seisblock.bodies.roster import read_bodies
from seisblock.cli.inputs import preparation_of, refuse_windows
from seisblock.cli.options import Source
from seisblock.cli.progress import progress
from seisblock.cli.talk import answer, say, show, warn
from seisblock.errors import OutputError, ParameterError, RecordError, SeisblockError
from seisblock.present.documents.batch import document
from seisblock.present.documents.write import to_json
from seisblock.present.files import checked_target, read_table, write_table
from seisblock.present.journal import Journal, Key, alone_with, journal_path
from seisblock.present.parquet import check_parquet, read_parquet, write_parquet
from seisblock.present.text import batch as shown
from seisblock.readers import DEFAULT_SAMPLE
from seisblock.readers.dispatch import Options
from seisblock.readers.gather import expand, recordings
from seisblock.studies.batch.azimuths import around
from seisblock.studies.batch.cluster import connected
from seisblock.studies.batch.run import each_record, make_plan
from seisblock.studies.batch.table import REASON, Row, cells_of, columns_of
from seisblock.studies.batch.tally import Tally
from seisblock.studies.batch.task import Plan, rows_of

if TYPE_CHECKING:
    from distributed import Client

CSV, PARQUET = ".csv", ".parquet"


@dataclass(frozen=True)
class Asked:
    """What a batch is of, as the command line says it."""

    bodies: tuple[str, ...]
    solver: str
    runs: int
    seed: int
    options: Mapping[str, Any]


def run(
    source: Source,
    asked: Asked,
    out: Path,
    *,
    resume: bool,
    force: bool,
    workers: int | None,
    cluster: str | None,
    as_json: bool,
) -> None:
    """Run a batch, write its table, and say what it comes to."""
    _check_target(out, resume=resume, force=force)
    plan, notes = _plan(source, asked)
    names = source.record or (_default(),)
    with progress("finding the records"):
        files = expand(names, plan.reading)
        keys = list(dict.fromkeys(recording.key for recording in recordings(files, plan.reading)))
    _check_files(out)  # once more: now it is known what was read
    tally, columns, reasons = Tally(plan.model), _columns(plan), dict[str, str]()
    if resume and out.exists() and not journal_path(out).exists():
        for rows in _whole(out, columns, plan, files, {path for path, _ in keys}):
            tally.counted(rows)
        say("{path} is whole: nothing is left to do; --force makes it anew", path=out)
    else:
        with ExitStack() as stack:
            client = None if cluster is None else stack.enter_context(connected(cluster))
            journal = stack.enter_context(_journal(journal_path(out), plan, resume=resume))
            reasons = _solve(files, plan, journal, keys, workers=workers, client=client)
            rows_of_all = (row for rows in map(journal.rows, keys) for row in tally.counted(rows))
            kept = any(not row.get(REASON) for key in keys for row in journal.rows(key))
            if kept:
                write = write_parquet if out.suffix.lower() == PARQUET else _write_csv
                with progress("writing {file}", file=str(out)):
                    write(out, columns, (cells_of(columns, row) for row in rows_of_all))
            else:
                deque(rows_of_all, maxlen=0)  # counted alone: a table of failures would stand in the way of the line put right
            journal.remove()
        if kept:
            say("wrote {path}", path=out)
    if as_json:
        answer(to_json(document(tally, plan, str(out), notes)))
    else:
        show(shown.tables(tally, reasons))
    if not tally.answers:
        if out.exists():
            raise RecordError("no row has an answer: {path} is left as it was", path=out)
        raise RecordError("no row has an answer: {path} is not written", path=out)


def _whole(out: Path, columns: Mapping[str, type], plan: Plan, files: Sequence[str], paths: set[str]) -> Iterator[list[Row]]:
    """Yield the rows of a table that is whole, record by record, if it is of the same records, bodies, solver and options.

    What was done to the records a table does not say: the record under which most happened is followed anew.
    """
    rows = list((read_parquet if out.suffix.lower() == PARQUET else read_table)(out, columns))
    tables: dict[str, list[Row]] = {path: list(some) for path, some in groupby(rows, key=lambda row: row["path"])}
    same = tables.keys() == paths or (plan.reading.station is not None and tables.keys() <= paths)
    if same and tables:
        telling = max(tables, key=lambda path: sum(_eventful(row, plan) for row in tables[path]))
        recording = next(each for each in recordings(files, plan.reading) if each.path == telling)
        anew = [cells_of(columns, row) for row in rows_of(recording, plan)]
        same = _written(anew) == _written([cells_of(columns, row) for row in tables[telling]])
    if not same:
        raise OutputError("{path} is whole, and of other records, bodies, options or another solver: --force makes it anew", path=out)
    yield from tables.values()


def _eventful(row: Row, plan: Plan) -> int:
    """Return how much a row tells: nothing without an answer, more where what is asked about happened."""
    return 0 if row.get(REASON) else 1 + bool(row[plan.model.happens])


def _written(rows: Iterable[Sequence[Any]]) -> list[list[str]]:
    """Return rows as their cells are written."""
    return [["" if cell is None else str(cell) for cell in row] for row in rows]


def _solve(
    files: Sequence[str], plan: Plan, journal: Journal, keys: Sequence[Key], *, workers: int | None, client: Client | None
) -> dict[str, str]:
    """Follow the bodies through the records that are missing, and write each record's rows down as soon as they are there.

    The journal keeps reasons in English; what is returned can be told in any language.
    """
    missing = {key for key in keys if key not in journal.places}
    if len(missing) < len(keys):
        say("{done} of {count} records are finished", done=len(keys) - len(missing), count=len(keys))
    tasks, kept = tee(recording for recording in (recordings(files, plan.reading) if missing else ()) if recording.key in missing)
    reasons: dict[str, str] = {}
    with progress("records") as advance:
        found = each_record(tasks, plan, total=len(missing), workers=workers, client=client, progress=advance)
        try:
            for rows, recording in zip(found, kept, strict=False):
                journal.keep(recording.key, rows)
                reasons |= {str(row[REASON]): row[REASON] for row in rows if row.get(REASON)}
        except (KeyboardInterrupt, SeisblockError):
            say("{done} of {count} records are finished and kept: --resume goes on", done=len(journal.places), count=len(keys))
            raise
    return reasons


def _plan(source: Source, asked: Asked) -> tuple[Plan, tuple[str, ...]]:
    """Return what is done with each record, and say what is to be known of it."""
    refuse_windows(source)
    components = tuple(name for name in source.component if name.lower() != "all")
    plan, notes = make_plan(
        read_bodies(asked.bodies),
        asked.solver,
        components=components,
        preparation=preparation_of(source, () if around(components) else components),
        reading=Options(source.format, source.units, source.dt, None if source.station == "all" else source.station, source.level),
        runs=asked.runs,
        seed=asked.seed,
        strict=source.strict,
        options={key: value for key, value in asked.options.items() if value is not None},
    )
    for note in notes:
        warn(note)
    return plan, notes


def _columns(plan: Plan) -> dict[str, type]:
    """Return the columns of the table."""
    return columns_of(plan.model, runs=plan.runs, around=around(plan.components))


def _default() -> str:
    """Return the bundled record that stands for none, and say so."""
    say("no RECORD given: using the bundled sample {name} (synthetic)", name=DEFAULT_SAMPLE)
    return DEFAULT_SAMPLE


def _check_target(out: Path, *, resume: bool, force: bool) -> None:
    """Refuse, before anything is read, a table that may not be written there."""
    if resume and force:
        raise ParameterError("give either --resume or --force, not both")
    if out.suffix.lower() not in (CSV, PARQUET):
        raise OutputError("{path}: a batch writes .csv or .parquet", path=out)
    if out.suffix.lower() == PARQUET:
        check_parquet()
    journal = journal_path(out)
    _check_files(out)
    if resume and any(path.exists() and not path.is_file() for path in (out, journal)):
        raise OutputError("{path} is no table that was begun: leave --resume out", path=out)
    if not (resume or force) and out.exists():
        raise OutputError("{path} is there already: --force makes it anew, or give another name", path=out)
    if not (resume or force) and journal.exists():
        raise OutputError("{path} was interrupted: --resume goes on, --force begins anew", path=out)


def _check_files(out: Path) -> None:
    """Refuse a table, or a journal beside it, that may not be written there."""
    checked_target(out)
    checked_target(journal_path(out))


@contextmanager
def _journal(path: Path, plan: Plan, *, resume: bool) -> Iterator[Journal]:
    """Give the journal of a batch, which no other run writes meanwhile: the one that was interrupted, or a new one."""
    told = repr((__version__, plan.solver, plan.bodies, plan.components, plan.preparation, plan.runs, plan.seed, plan.strict))
    reading = repr([getattr(plan.reading, key) for key in ("format", "units", "dt", "station", "level")])
    purpose = {"seisblock": "batch", "of": hashlib.sha256((told + reading).encode(errors="surrogatepass")).hexdigest()}
    interrupted = resume and path.exists()
    with alone_with(path):
        journal = Journal.resume(path, purpose) if interrupted else Journal.begin(path, purpose)
        if journal.damaged:
            warn("{path}: {count} line(s) are damaged: the records they held are followed anew", path=path, count=journal.damaged)
        yield journal


def _write_csv(path: Path, columns: Mapping[str, type], rows: Iterable[Sequence[Any]]) -> None:
    """Write rows as CSV."""
    write_table(path, list(columns), rows)
