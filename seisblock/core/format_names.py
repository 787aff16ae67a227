"""Names of the record formats, one for each file in ``seisblock/readers/formats``, listed without importing the readers."""

from __future__ import annotations

from pathlib import Path

FORMAT_FOLDER = Path(__file__).parents[1] / "readers" / "formats"


def format_names() -> list[str]:
    """Return the names accepted as the format of a record, without aliases; ``OBSPY`` stands for ``OBSPY:`` and a name of ObsPy.

    Examples
    --------
    >>> format_names()[:3]
    ['AFAD', 'ASDF', 'AT2']
    """
    return sorted(file.stem.upper().replace("_", "-") for file in FORMAT_FOLDER.glob("[!_]*.py"))
