"""Tables of cemeteries (CSV, .xlsx), with English or Japanese column names."""

from __future__ import annotations

from pathlib import Path

from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.bodies.edge_wear import SHARP_EDGES
from seisblock.bodies.kinds import GRAVESTONE
from seisblock.bodies.table import TableRow, parse_table
from seisblock.core import checks
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_
from seisblock.core.io.spreadsheet import Sheet, first_note, read_sheet, text_sheet
from seisblock.core.limits import MAX_STONES, check_limit
from seisblock.samples import resolve_file_or_sample, sample_names


def read_cemetery(name: str | Path) -> Cemetery:
    """Return a cemetery from a table (CSV, .xlsx) or a bundled one.

    The header names the columns: ``height_over_width``, or ``height`` and ``width`` (a unit in the name, ``height (cm)``,
    or in the cell, ``8sun``; metres without); and, where known, ``name``, ``reinforced``, ``fallen``, ``azimuth_deg``, ``count``,
    ``inset``. Japanese names (高さ幅比, 高さ, 幅, 番号, 補強, 転倒, 方位, 個数) are accepted, too. A title above the header is skipped;
    lines that begin with # are comments, and those before the header are kept as notes. UTF-8 with or without a byte order mark,
    Shift-JIS and UTF-16 are recognised; other columns are ignored. Of an .xlsx workbook the first worksheet is read.

    Parameters
    ----------
    name : str or Path
        File, or name of a bundled cemetery such as ``aoyama.csv``.

    Returns
    -------
    Cemetery

    Raises
    ------
    BodyError
        If there is no such file or bundled cemetery, a column is missing, or a row is invalid; the message gives the line.

    Examples
    --------
    >>> read_cemetery("aoyama.csv").size
    100
    """
    return _cemetery(read_sheet(_resolve_path(name), str(name)))


def parse_cemetery(text: str, *, source: str = "table") -> Cemetery:
    """Return a cemetery from the text of a table, see :func:`read_cemetery`."""
    return _cemetery(text_sheet(text, source))


def _cemetery(sheet: Sheet) -> Cemetery:
    """Return the cemetery of a sheet of gravestones."""
    source = sheet.source
    if not sheet.rows:
        raise BodyError("{source} contains no gravestones: a header and one line per stone are required", source=source)
    table = parse_table(sheet, stones=True)
    if not table.rows:
        template = "{source}, line {line}: no gravestone below the header; add one line per stone"
        raise BodyError(template, source=source, line=table.header_line)
    size = sum(row.count for row in table.rows)
    check_limit(N_("gravestones"), size, MAX_STONES, source=source, error=BodyError)
    return Cemetery(tuple(map(_stone, table.rows)), Path(source).stem, source, first_note(sheet, table.header_line))


def _resolve_path(name: str | Path) -> Path:
    """Return the path of a file, or of a bundled cemetery."""
    path = Path(checks.path(name))
    if path.is_dir():
        raise BodyError("{name} is a folder: give the CSV file of a cemetery", name=name)
    resolved = resolve_file_or_sample(path, "cemetery")
    if resolved is None:
        raise BodyError(
            "no cemetery file {name}, and no bundled cemetery of that name; bundled: {known}", name=name, known=sample_names("cemetery")
        )
    return resolved


def _stone(row: TableRow) -> Stone:
    """Return the stone of a row; a body of another kind than gravestone has sharp edges."""
    values = row.values
    is_sharp = values.get("kind", GRAVESTONE) != GRAVESTONE
    return Stone(
        values["height_over_width"],
        values.get("width"),
        reinforced=bool(values.get("reinforced")),
        fallen=values.get("fallen"),
        azimuth_deg=values.get("azimuth_deg"),
        count=row.count,
        line=row.line,
        name=row.name,
        inset=values.get("inset", SHARP_EDGES if is_sharp else None),
    )
