"""Reader of tables of outcomes: records and falls of shaking tests in a CSV file."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, ComponentError, ParameterError, SeisblockError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.io.csv_table import FALSE_WORDS, TRUE_WORDS, parse_heading, parse_number_cell
from seisblock.core.io.spreadsheet import Sheet, read_sheet
from seisblock.core.typing import Progress
from seisblock.readers.discover import RecordSource, group_files
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read, read_source
from seisblock.readers.source import Location
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.qc_report import require_clean
from seisblock.samples import resolve_file_or_sample, sample_names
from seisblock.studies.fit.dataset import FELL, MOVED, Observation


@dataclass(eq=False)
class RecordCache:
    """Records of a table, each read once, and their motions.

    Parameters
    ----------
    folder : Path
        Folder of the table.
    preparation : Preparation
    read_options : ReadOptions
    strict : bool
        True to reject a doubtful record.
    """

    folder: Path
    preparation: Preparation
    read_options: ReadOptions
    strict: bool
    records_by_name: dict[str, Record | SeisblockError] = field(default_factory=dict)
    motions: dict[tuple[str, str], Motion] = field(default_factory=dict)
    bundles: dict[Path, dict[str, RecordSource]] = field(default_factory=dict)

    @property
    def records(self) -> tuple[Record, ...]:
        """Readable records."""
        return tuple(entry for entry in self.records_by_name.values() if isinstance(entry, Record))

    def motion(self, name: str, component: str) -> Motion:
        """Return one component of a record; the same object for the same names."""
        record = self._record(name)
        if not component:
            codes = [horizontal.code for horizontal in record.horizontals]
            if len(codes) != 1:
                text = "{name} has the horizontal components {codes}; give the component of the shaking in a column `component`, or for all"
                raise ComponentError(text, name=name, codes=codes or lazy_gettext("none"))
            component = codes[0]
        if (name, component) not in self.motions:
            self.motions[name, component] = motion_of(record, component)
        return self.motions[name, component]

    def _record(self, name: str) -> Record:
        """Return a processed record, from the cache; a failure is cached, too."""
        if name not in self.records_by_name:
            try:
                record = self._read(name)
                if self.strict:
                    require_clean(record)
                self.records_by_name[name] = self.preparation.apply(record)
            except SeisblockError as error:
                self.records_by_name[name] = error
        entry = self.records_by_name[name]
        if isinstance(entry, SeisblockError):
            raise entry
        return entry

    def _read(self, name: str) -> Record:
        """Return the record of a file beside the table, of another path, a sample, or a bundle (``bundle.zip/member.csv``)."""
        local_path = self.folder / name
        bundle = next((item for item in local_path.parents if item.is_file()), None)
        if bundle is not None:
            if bundle not in self.bundles:
                self.bundles[bundle] = {item.path: item for item in group_files([str(bundle)], self.read_options)}
            if str(local_path) in self.bundles[bundle]:
                return read_source(self.bundles[bundle][str(local_path)], self.read_options)
        return read(str(local_path) if os.path.lexists(local_path) else name, **self.read_options.keywords)

    def doubts(self) -> list[str]:
        """Return the warnings about the records, the first of each kind with a count."""
        groups: dict[str, tuple[str, int]] = {}
        for record in self.records:
            for kind, message in {doubt.kind: doubt.message for doubt in record.doubts}.items():
                first, count = groups.get(kind, (message, 0))
                groups[kind] = first, count + 1
        template = "{doubt} (likewise {count} other records)"
        return [first if count == 1 else lazy_gettext(template, doubt=first, count=count - 1) for first, count in groups.values()]


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
_EVENT_WORDS = TRUE_WORDS | {"fell", "fallen", "overturned", "toppled", "moved", "rocked", "転倒"}
_NO_EVENT_WORDS = FALSE_WORDS | {"stood", "stands", "standing", "stable", "still", "rested", "残存"}

MAX_REASONS = 3
"""Largest number of excluded rows with a reason."""

NO_PROCESSING = Preparation()
"""Default processing: none beyond that required by the format."""


@dataclass(frozen=True, eq=False, repr=False)
class OutcomeTable(DisplayMixin):
    """Rows of a table of outcomes with a readable record.

    Parameters
    ----------
    observed : tuple of Observation
    lines : tuple of int
        Line of each row.
    kind : str
        ``fell`` or ``moved``.
    notes : tuple of str
        Notes on the table, and on excluded rows.
    records : tuple of Record
        Each once, with its processing applied.
    """

    observed: tuple[Observation, ...]
    lines: tuple[int, ...]
    kind: str
    notes: tuple[str, ...]
    records: tuple[Record, ...]

    def __len__(self) -> int:
        return len(self.observed)

    def __iter__(self) -> Iterator[Observation]:
        return iter(self.observed)


@dataclass(frozen=True)
class _Row:
    """One row of the table; `event` is None if unknown."""

    line: int
    record: str
    event: bool | None
    weight: float = 1.0
    component: str = ""
    scale: float = 1.0


def read_outcomes(
    name: Location,
    *,
    kind: str | None = None,
    component: str | None = None,
    preparation: Preparation = NO_PROCESSING,
    read_options: ReadOptions | None = None,
    strict: bool = False,
    progress: Progress | None = None,
) -> OutcomeTable:
    """Return the outcomes of a table, with their records.

    The header names the columns: ``record``, a file beside the table, another path, or a bundled sample; ``fell`` or ``moved``
    (1, yes, true, 転倒; 0, no, false, 残存; empty if unknown); optional ``weight``, ``component`` and ``scale``, a factor on the
    record. Japanese names (記録, 転倒, 重み, 成分, 倍率) are equivalent; other columns are ignored.

    Parameters
    ----------
    name : path
        A CSV file, or the name of a bundled one.
    kind : "fell", "moved" or None
        Column in use if there are both; None: the only one, else ``fell``.
    component : str or None
        Component or azimuth of rows without one; None: the only horizontal.
    preparation : Preparation
        Processing of each record.
    read_options : ReadOptions
        Format, units and other properties missing in the files.
    strict : bool
        True to reject a table with an unreadable or doubtful record, instead of excluding the row.
    progress : callable
        Called with the number of rows read and the total.

    Returns
    -------
    OutcomeTable

    Raises
    ------
    ParameterError
        If the table cannot be read, a column is missing, a cell is wrong (with its line), or no record can be read.

    Examples
    --------
    >>> from seisblock.studies import read_outcomes
    >>> outcomes = read_outcomes("shaken_block.csv")
    >>> len(outcomes), outcomes.kind, outcomes.observed[0].happened
    (60, 'fell', False)
    """
    path, source = _path(name), str(name)
    try:
        outcome_kind, rows, notes = _rows(read_sheet(path, source), kind)
    except BodyError as error:  # raised by the table reader shared with bodies
        raise ParameterError(error.message) from error
    files = RecordCache(path.parent, preparation, read_options or ReadOptions(), strict)
    observations, lines, skipped = [], [], []
    for count, row in enumerate(rows, start=1):
        try:
            motion = files.motion(row.record, row.component or component or "")
            observations.append(Observation(motion, bool(row.event), row.weight, row.scale, row.record))
            lines.append(row.line)
        except SeisblockError as error:
            if strict:
                raise ParameterError("{source}, line {line}: {why}", source=source, line=row.line, why=error.message) from error
            skipped.append((row.line, error.message))
        if progress is not None:
            progress(count, len(rows))
    if not observations:
        line, reason = skipped[0]
        text = "{source}: none of its records can be read; line {line}: {why}"
        raise ParameterError(text, source=source, line=line, why=reason)
    return OutcomeTable(
        tuple(observations), tuple(lines), outcome_kind, (*notes, *_skipped_row_notes(skipped, len(rows)), *files.doubts()), files.records
    )


def _path(name: Location) -> Path:
    path = Path(checks.path(name))
    if path.is_dir():
        raise ParameterError("{name} is a folder; expected a CSV file of outcomes", name=str(name))
    file = resolve_file_or_sample(path, "outcomes")
    if file is None:
        text = "no file of outcomes {name}, and no bundled file of that name; bundled: {known}"
        raise ParameterError(text, name=str(name), known=sample_names("outcomes"))
    return file


def _rows(sheet: Sheet, kind: str | None) -> tuple[str, list[_Row], list[str]]:
    """Return the column in use, the rows with an outcome, and notes on the table."""
    source = sheet.source
    if len(sheet.rows) < 2:
        raise ParameterError("{source}: no outcome found; expected a header line, then one outcome per line", source=source)
    (header_line, cells), body = sheet.rows[0], sheet.rows[1:]
    columns = [parse_heading(cell, _COLUMNS)[0] for cell in cells]
    outcome_kind = _outcome_column(columns, cells, source, header_line, kind)
    rows = sheet.parse_rows(columns, body, lambda row, line: _row(row, outcome_kind, line))
    known_rows = [row for row in rows if row.event is not None]
    if not known_rows:
        raise ParameterError("{source}: no outcome found; every cell of the column {column} is empty", source=source, column=outcome_kind)
    notes: list[str] = []
    if len(known_rows) < len(rows):
        notes.append(lazy_gettext("{count} rows without an outcome ignored", count=len(rows) - len(known_rows)))
    if kind is None and {FELL, MOVED} <= set(columns):
        notes.append(lazy_gettext("column {column} used; the other outcome column ignored", column=outcome_kind))
    return outcome_kind, known_rows, notes


def _outcome_column(columns: Sequence[str], cells: Sequence[str], source: str, line: int, kind: str | None) -> str:
    """Return the outcome column in use after a check of the header."""
    for name in _NAMES:
        if columns.count(name) > 1:
            raise ParameterError(
                "{source}, line {line}: two columns mean {name}: rename or remove one", source=source, line=line, name=name
            )
    available = [name for name in (FELL, MOVED) if name in columns]
    column = kind or (available[0] if available else FELL)
    missing = [name for name in ("record", column) if name not in columns]
    if missing:
        expected = lazy_gettext("fell or moved") if not available and kind is None else column
        raise ParameterError(
            "{source}, line {line}: expected the columns record and {wanted}; found {found}",
            source=source,
            line=line,
            wanted=expected,
            found=list(cells),
        )
    return column


def _row(row: Mapping[str, str], kind: str, line: int) -> _Row:
    if not row.get("record"):
        raise ParameterError("outcome without a record; fill in the cell")
    text = row.get(kind, "")
    if text and text.casefold() not in _EVENT_WORDS | _NO_EVENT_WORDS:
        raise ParameterError("{key} must be 0, 1, yes, no, true, false, 転倒 or 残存, found {text!r}", key=kind, text=text[:100])
    result = _Row(line, row["record"], text.casefold() in _EVENT_WORDS if text else None, component=row.get("component", ""))
    if row.get("weight"):
        result = replace(result, weight=checks.non_negative("weight", parse_number_cell(row["weight"], "weight")))
    if row.get("scale"):
        result = replace(result, scale=checks.finite("scale", parse_number_cell(row["scale"], "scale")))
    return result


def _skipped_row_notes(skipped: Sequence[tuple[int, str]], rows: int) -> list[str]:
    """Return notes on excluded rows: their number, and the first reasons."""
    if not skipped:
        return []
    summary = lazy_gettext("{count} of {rows} rows excluded: record not usable", count=len(skipped), rows=rows)
    return [summary, *(lazy_gettext("line {line}: {why}", line=line, why=reason) for line, reason in skipped[:MAX_REASONS])]
