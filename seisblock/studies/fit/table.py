"""A table of outcomes: which record shook, and whether the block fell, as somebody keeps it in a spreadsheet."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from seisblock import checks
from seisblock.bodies.sheet import NO, YES, also_bad, cells_of, heading, number_of, row_of, rows_of, separator_of, sheet_text
from seisblock.errors import BodyError, InputError, ParameterError, SeisblockError
from seisblock.readers.dispatch import Options
from seisblock.readers.source import Location
from seisblock.records import Preparation, Record
from seisblock.samples import file_or_sample, samples_of
from seisblock.studies.fit.experiment import FELL, MOVED, Observed
from seisblock.studies.fit.files import Files
from seisblock.typing import Progress
from seisblock.words import said

_NAMES = {
    "record": ("record", "file", "motion", "記録", "波形", "ファイル", "記録名"),
    FELL: ("fell", "fallen", "fall", "overturned", "toppled", "転倒", "転倒の有無"),
    MOVED: ("moved", "rocked", "ロッキング", "動いた", "ロッキングの有無"),
    "weight": ("weight", "重み"),
    "component": ("component", "成分"),
    "scale": ("scale", "factor", "倍率"),
}
"""Columns, by their headings without case, blanks and underscores."""

_COLUMNS = {spelling: name for name, spellings in _NAMES.items() for spelling in spellings}
_DID = YES | {"fell", "fallen", "overturned", "toppled", "moved", "rocked", "転倒"}
_DID_NOT = NO | {"stood", "stands", "standing", "stable", "still", "rested", "残存"}

MOST_REASONS = 3
"""Rows left out of which the reason is told."""

ALONE = Preparation()
"""Nothing is done to a record but what its format needs."""


@dataclass(frozen=True, eq=False)
class Outcomes:
    """The rows of a table of outcomes whose records could be read.

    Parameters
    ----------
    observed : tuple of Observed
    lines : tuple of int
        The line of each.
    kind : str
        ``fell`` or ``moved``.
    notes : tuple of str
        What is to be known of the table, and of the rows that are left out.
    records : tuple of Record
        Each once, as they were prepared.
    """

    observed: tuple[Observed, ...]
    lines: tuple[int, ...]
    kind: str
    notes: tuple[str, ...]
    records: tuple[Record, ...]

    def __len__(self) -> int:
        return len(self.observed)

    def __iter__(self) -> Iterator[Observed]:
        return iter(self.observed)


@dataclass(frozen=True)
class _Row:
    """What one row says."""

    line: int
    record: str
    happened: bool | None
    weight: float = 1.0
    component: str = ""
    scale: float = 1.0


def read_outcomes(
    name: Location,
    *,
    kind: str | None = None,
    component: str | None = None,
    preparation: Preparation = ALONE,
    reading: Options | None = None,
    strict: bool = False,
    progress: Progress | None = None,
) -> Outcomes:
    """Return the outcomes of a table, with their records.

    The header names the columns: ``record``, a file beside the table, or as it is found otherwise, or a bundled sample; ``fell`` or
    ``moved`` (1, yes, true, 転倒; 0, no, false, 残存; an empty cell: nobody knows); and where needed ``weight``, ``component`` and
    ``scale``, a factor on the record. Japanese names (記録, 転倒, 重み, 成分, 倍率) do as well; other columns are passed over.

    Parameters
    ----------
    name : path
        A CSV file, or the name of a bundled one.
    kind : "fell", "moved" or None
        Which column counts, where there are both; None: the one there is, else ``fell``.
    component : str or None
        Component or azimuth of rows that name none; None: the only horizontal there is.
    preparation : Preparation
        What is done to each record before.
    reading : Options
        What is said of files that do not say it themselves.
    strict : bool
        Whether a row whose record cannot be read, or is doubtful, refuses the table, instead of being left out.
    progress : callable
        Told the number of rows read and the number in all.

    Raises
    ------
    ParameterError
        If the table cannot be read, a column is missing, a cell is wrong (rows are named by their lines), or no record can be read.

    Examples
    --------
    >>> outcomes = read_outcomes("shaken_block.csv")
    >>> len(outcomes), outcomes.kind, outcomes.observed[0].happened
    (60, 'fell', False)
    """
    path, source = _path(name), str(name)
    try:
        chosen, rows, notes = _rows(sheet_text(path, source), source, kind)
    except BodyError as error:  # what all tables share is said of bodies
        raise ParameterError(error.said) from error
    files = Files(path.parent, preparation, reading or Options(), strict)
    observed, lines, gone = [], [], []
    for done, row in enumerate(rows, start=1):
        try:
            motion = files.motion(row.record, row.component or component or "")
            observed.append(Observed(motion, bool(row.happened), row.weight, row.scale, row.record))
            lines.append(row.line)
        except SeisblockError as error:
            if strict:
                raise ParameterError("{source}, line {line}: {why}", source=source, line=row.line, why=error.said) from error
            gone.append((row.line, error.said))
        if progress is not None:
            progress(done, len(rows))
    if not observed:
        line, why = gone[0]
        text = "{source}: no record of it can be read; line {line}: {why}"
        raise ParameterError(text, source=source, line=line, why=why)
    return Outcomes(tuple(observed), tuple(lines), chosen, (*notes, *_left_out(gone, len(rows)), *files.doubts()), files.records)


def _path(name: Location) -> Path:
    """Return the file that a name means: a path, else a bundled table of outcomes."""
    path = Path(checks.path(name))
    if path.is_dir():
        raise ParameterError("{name} is a directory: give the CSV file of outcomes", name=str(name))
    found = file_or_sample(path, "outcomes")
    if found is None:
        text = "no file of outcomes {name}, and no bundled one of that name; bundled are {known}"
        raise ParameterError(text, name=str(name), known=samples_of("outcomes"))
    return found


def _rows(text: str, source: str, kind: str | None) -> tuple[str, list[_Row], list[str]]:
    """Return which column counts, the rows of which the outcome is known, and what is to be known of the table."""
    lines = rows_of(text)
    if len(lines) < 2:
        raise ParameterError("{source}: there is no outcome in it: expected a header, and one outcome on each line below it", source=source)
    (header_line, header), body = lines[0], lines[1:]
    separator = separator_of(header)
    cells = cells_of(header, separator)
    columns = [heading(cell, _COLUMNS)[0] for cell in cells]
    chosen = _kind(columns, cells, source, header_line, kind)
    rows, wrong = [], []
    for number, line in body:
        try:
            rows.append(_row(row_of(columns, cells_of(line, separator)), chosen, number))
        except InputError as error:
            wrong.append((number, error.said))
    if wrong:
        (at, what), others = wrong[0], also_bad([number for number, _ in wrong[1:]])
        raise ParameterError("{source}, line {line}: {what}{others}", source=source, line=at, what=what, others=others)
    known = [row for row in rows if row.happened is not None]
    if not known:
        raise ParameterError("{source}: no outcome is known: every cell of the column {column} is empty", source=source, column=chosen)
    notes: list[str] = []
    if len(known) < len(rows):
        notes.append(said("{count} rows without an outcome are passed over", count=len(rows) - len(known)))
    if kind is None and {FELL, MOVED} <= set(columns):
        notes.append(said("the column {column} counts; the other one is passed over", column=chosen))
    return chosen, known, notes


def _kind(columns: Sequence[str], cells: Sequence[str], source: str, line: int, kind: str | None) -> str:
    """Return the column that counts, or refuse a header."""
    for name in _NAMES:
        if columns.count(name) > 1:
            raise ParameterError(
                "{source}, line {line}: two columns mean {name}: rename or remove one", source=source, line=line, name=name
            )
    there = [name for name in (FELL, MOVED) if name in columns]
    chosen = kind or (there[0] if there else FELL)
    missing = [name for name in ("record", chosen) if name not in columns]
    if missing:
        wanted = said("fell or moved") if not there and kind is None else chosen
        raise ParameterError(
            "{source}, line {line}: expected the columns record and {wanted}; found {found}",
            source=source,
            line=line,
            wanted=wanted,
            found=list(cells),
        )
    return chosen


def _row(row: Mapping[str, str], kind: str, line: int) -> _Row:
    """Return what one row says."""
    if not row.get("record"):
        raise ParameterError("an outcome without a record: fill the cell")
    told = row.get(kind, "")
    if told and told.casefold() not in _DID | _DID_NOT:
        raise ParameterError("{key} must be 0, 1, yes, no, true, false, 転倒 or 残存, found {text!r}", key=kind, text=told[:100])
    found = _Row(line, row["record"], told.casefold() in _DID if told else None, component=row.get("component", ""))
    if row.get("weight"):
        found = replace(found, weight=checks.not_negative("weight", number_of(row["weight"], "weight")))
    if row.get("scale"):
        found = replace(found, scale=checks.finite("scale", number_of(row["scale"], "scale")))
    return found


def _left_out(gone: Sequence[tuple[int, str]], rows: int) -> list[str]:
    """Return why rows are left out: the first reasons, and how many there are."""
    if not gone:
        return []
    whole = said("{count} of {rows} rows are left out, because their records cannot be used", count=len(gone), rows=rows)
    return [whole, *(said("line {line}: {why}", line=line, why=why) for line, why in gone[:MOST_REASONS])]
