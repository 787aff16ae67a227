"""Batch run: checkpoint journal of finished records, then the table."""

from __future__ import annotations

import hashlib
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from itertools import groupby, tee
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock import __version__
from seisblock.bodies.table import read_bodies
from seisblock.cli.console import info, note_default_record, print_result, print_tables, warning
from seisblock.cli.load_records import check_single_window, make_preparation
from seisblock.cli.options import Source
from seisblock.cli.progress import progress
from seisblock.core._display import exact_repr
from seisblock.core.errors import OutputError, ParameterError, RecordError, SeisblockError
from seisblock.core.io.checkpoint import Checkpoint, Key, checkpoint_path, lock_checkpoint
from seisblock.output.io.atomic import check_target, read_table, write_table
from seisblock.output.io.parquet import check_parquet, read_parquet, write_parquet
from seisblock.output.json.encode import to_json
from seisblock.readers.discover import expand_names, group_files
from seisblock.report.json.batch import document
from seisblock.report.text import batch as text_output
from seisblock.samples import DEFAULT_SAMPLE
from seisblock.studies.batch.cluster import connect
from seisblock.studies.batch.run import iter_record_rows, make_plan
from seisblock.studies.batch.table import REASON, Row, batch_columns, row_cells
from seisblock.studies.batch.tally import Tally
from seisblock.studies.batch.task import Plan, record_rows
from seisblock.studies.batch.worst_azimuth import is_all_azimuths

if TYPE_CHECKING:
    from distributed import Client

CSV, PARQUET = ".csv", ".parquet"


def run_batch(
    source: Source,
    *,
    out: Path,
    resume: bool,
    force: bool,
    workers: int | None,
    cluster: str | None,
    as_json: bool,
    excel: bool,
    **params: Any,
) -> None:
    """Run a batch, write its table and print a summary; `params` are bodies, solver, samples and options of the solver."""
    _check_target(out, resume=resume, force=force)
    if excel and out.suffix.lower() == PARQUET:
        raise OutputError("--excel has no effect on a .parquet: omit it, or write .csv")
    plan, notes = _make_plan(source, **params)
    names = source.record or (_default_record(),)
    with progress("searching for records"):
        files = expand_names(names, plan.read_options)
        keys = list(dict.fromkeys(recording.key for recording in group_files(files, plan.read_options)))
    _check_files(out)  # again, now that the inputs are known
    tally, columns, reasons = Tally(plan.model), _columns(plan), dict[str, str]()
    if resume and out.exists() and not checkpoint_path(out).exists():
        for rows in _finished_rows(out, columns, plan, files, {path for path, _ in keys}):
            tally.add_rows(rows)
        info("{path} is complete: nothing to compute; --force computes it again", path=out)
    else:
        with ExitStack() as stack:
            client = None if cluster is None else stack.enter_context(connect(cluster))
            journal = stack.enter_context(_open_checkpoint(checkpoint_path(out), plan, resume=resume))
            reasons = _solve(files, plan, journal, keys, workers=workers, client=client)
            rows_of_all = (row for rows in map(journal.rows, keys) for row in tally.add_rows(rows))
            has_answers = any(not row.get(REASON) for key in keys for row in journal.rows(key))
            if has_answers:
                write = write_parquet if out.suffix.lower() == PARQUET else partial(_write_csv, bom=excel)
                with progress("writing {file}", file=str(out)):
                    write(out, columns, (row_cells(columns, row) for row in rows_of_all))
            else:
                deque(rows_of_all, maxlen=0)  # count only: a table without results must not block the corrected call
            journal.remove()
        if has_answers:
            info("wrote {path}", path=out)
    if as_json:
        print_result(to_json(document(tally, plan, str(out), notes)))
    else:
        print_tables(text_output.tables(tally, reasons))
    if not tally.total("answers_count"):
        if out.exists():
            raise RecordError("no row has a result: {path} is unchanged", path=out)
        raise RecordError("no row has a result: {path} is not written", path=out)


def _finished_rows(out: Path, columns: Mapping[str, type], plan: Plan, files: Sequence[str], paths: set[str]) -> Iterator[list[Row]]:
    """Yield the rows of a complete table, record by record, if it matches records, bodies, solver and options.

    A table does not contain the preparation of the records, so the record with the most information is computed again and compared.
    """
    rows = list((read_parquet if out.suffix.lower() == PARQUET else read_table)(out, columns))
    tables: dict[str, list[Row]] = {path: list(group) for path, group in groupby(rows, key=lambda row: row["path"])}
    matches = tables.keys() == paths or (plan.read_options.station is not None and tables.keys() <= paths)
    if matches and tables:
        sample_path = max(tables, key=lambda path: sum((0 if row.get(REASON) else 1 + bool(row[plan.model.event])) for row in tables[path]))
        recording = next(candidate for candidate in group_files(files, plan.read_options) if candidate.path == sample_path)
        recomputed = [row_cells(columns, row) for row in record_rows(recording, plan)]
        matches = _cell_texts(recomputed) == _cell_texts([row_cells(columns, row) for row in tables[sample_path]])
    if not matches:
        raise OutputError("{path} is complete, but for other records, bodies, options or another solver: --force replaces it", path=out)
    yield from tables.values()


def _cell_texts(rows: Iterable[Sequence[Any]]) -> list[list[str]]:
    return [["" if cell is None else str(cell) for cell in row] for row in rows]


def _solve(
    files: Sequence[str], plan: Plan, journal: Checkpoint, keys: Sequence[Key], *, workers: int | None, client: Client | None
) -> dict[str, str]:
    """Solve the missing records and append each record's rows to the journal.

    The journal holds reasons in English; the returned messages are translatable.
    """
    missing = {key for key in keys if key not in journal.places}
    if len(missing) < len(keys):
        info("{done} of {count} records are finished", done=len(keys) - len(missing), count=len(keys))
    tasks, submitted = tee(
        recording for recording in (group_files(files, plan.read_options) if missing else ()) if recording.key in missing
    )
    reasons: dict[str, str] = {}
    with progress("records") as advance:
        results = iter_record_rows(tasks, plan, total=len(missing), workers=workers, client=client, progress=advance)
        try:
            for rows, recording in zip(results, submitted, strict=False):
                journal.append(recording.key, rows)
                reasons |= {str(row[REASON]): row[REASON] for row in rows if row.get(REASON)}
        except (KeyboardInterrupt, SeisblockError):
            info("{done} of {count} records are finished and kept: --resume continues", done=len(journal.places), count=len(keys))
            raise
    return reasons


def _make_plan(source: Source, *, bodies: Sequence[str], solver: str, runs: int, seed: int, **options: Any) -> tuple[Plan, tuple[str, ...]]:
    """Return the plan of a batch and its notes, which are also printed."""
    check_single_window(source)
    components = tuple(name for name in source.component if name.lower() != "all")
    plan, notes = make_plan(
        read_bodies(bodies),
        solver,
        components=components,
        preparation=make_preparation(source, () if is_all_azimuths(components) else components),
        read_options=source.read_options(single_station=True),
        runs=runs,
        seed=seed,
        strict=source.strict,
        options={key: value for key, value in options.items() if value is not None},
    )
    for note in notes:
        warning(note)
    return plan, notes


def _columns(plan: Plan) -> dict[str, type]:
    return batch_columns(plan.model, runs=plan.runs, all_azimuths=is_all_azimuths(plan.components))


def _default_record() -> str:
    """Return the default record; its name is the first line of the result."""
    note_default_record(DEFAULT_SAMPLE, synthetic=True)
    return DEFAULT_SAMPLE


def _check_target(out: Path, *, resume: bool, force: bool) -> None:
    """Raise an error, before any record is read, for a table that must not be written."""
    if resume and force:
        raise ParameterError("--resume and --force exclude each other: give only one of them")
    if out.suffix.lower() not in (CSV, PARQUET):
        raise OutputError("{path}: the file name of a batch table must end in .csv or .parquet", path=out)
    if out.suffix.lower() == PARQUET:
        check_parquet()
    journal = checkpoint_path(out)
    _check_files(out)
    if resume and any(path.exists() and not path.is_file() for path in (out, journal)):
        raise OutputError("{path} is not an interrupted table: omit --resume", path=out)
    if not (resume or force) and out.exists():
        raise OutputError("{path} exists: give --force to replace it, or another name", path=out)
    if not (resume or force) and journal.exists():
        raise OutputError("{path} was interrupted: --resume continues, --force starts again", path=out)


def _check_files(out: Path) -> None:
    """Raise an error for a table or journal that cannot be written."""
    check_target(out)
    check_target(checkpoint_path(out))


@contextmanager
def _open_checkpoint(path: Path, plan: Plan, *, resume: bool) -> Iterator[Checkpoint]:
    """Open the journal of a batch under a file lock: a resumed or a new one."""
    identity = exact_repr((__version__, plan.solver, plan.bodies, plan.components, plan.preparation, plan.runs, plan.seed, plan.strict))
    read_identity = repr([getattr(plan.read_options, key) for key in ("format", "units", "dt", "station", "level")])
    purpose = {"seisblock": "batch", "of": hashlib.sha256((identity + read_identity).encode(errors="surrogatepass")).hexdigest()}
    is_resumed = resume and path.exists()
    with lock_checkpoint(path):
        journal = Checkpoint.resume(path, purpose) if is_resumed else Checkpoint.begin(path, purpose)
        if journal.damaged:
            warning("{path}: {count} line(s) are damaged; their records are computed again", path=path, count=journal.damaged)
        yield journal


def _write_csv(path: Path, columns: Mapping[str, type], rows: Iterable[Sequence[Any]], *, bom: bool) -> None:
    write_table(path, list(columns), rows, bom=bom)
