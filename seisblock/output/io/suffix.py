"""File name suffixes of text outputs."""

from __future__ import annotations

from pathlib import Path

from seisblock.core.errors import OutputError
from seisblock.core.i18n import join_alternatives
from seisblock.output.io.atomic import ANIMATION_SUFFIXES, FIGURE_SUFFIXES

TEXT_SUFFIXES = {"CSV": (".csv", ".txt"), "HTML": (".html", ".htm"), "GeoJSON": (".geojson", ".json")}
"""Suffixes of each text format; unknown suffixes, or none, are accepted as well."""

OTHER_SUFFIXES = frozenset(
    {*(".tsv", ".xlsx", ".xls", ".xlsm", ".ods", ".parquet", ".feather", ".hdf5", ".h5", ".nc", ".npy", ".npz", ".mat", ".sqlite")}
    | {*(".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".eps", ".ps", ".bmp", ".avi", ".mov", ".webm")}
    | {*(".doc", ".docx", ".odt", ".rtf", ".tex", ".md", ".ppt", ".pptx", ".xml", ".toml", ".yaml", ".yml", ".kml", ".shp", ".gpkg")}
    | {*(".zip", ".gz", ".bz2", ".xz", ".tar", ".7z", ".tgz", ".py", ".mseed", ".sac")}
)
"""Suffixes of other formats, rejected for text outputs."""


def check_text_suffix(path: Path | str, form: str) -> None:
    """Raise OutputError if a text output has the suffix of another format; devices and pipes may have any name.

    Parameters
    ----------
    path : Path or str
    form : str
        Format written, a key of :data:`TEXT_SUFFIXES`.

    Raises
    ------
    OutputError
        If the suffix is that of another format.

    Examples
    --------
    >>> check_text_suffix("table.xlsx", "CSV")
    Traceback (most recent call last):
    seisblock.core.errors.OutputError: cannot write CSV to table.xlsx: the name must end in .csv or .txt
    """
    target, fitting = Path(path), TEXT_SUFFIXES[form]
    foreign_suffixes = OTHER_SUFFIXES.union(FIGURE_SUFFIXES, ANIMATION_SUFFIXES, *TEXT_SUFFIXES.values()).difference(fitting)
    if target.suffix.lower() in foreign_suffixes and (target.is_file() or not target.exists()):
        text = "cannot write {form} to {target}: the name must end in {suffixes}"
        raise OutputError(text, target=target, form=form, suffixes=join_alternatives(fitting))
