"""Registry of file formats: each registers itself once, in ``seisblock/readers/formats/NAME.py``; readers and messages read it."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

from seisblock.core.errors import RecordFormatError
from seisblock.core.format_names import format_names
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.readers.lines import read_lines
from seisblock.readers.source import RawFile, normalize_text
from seisblock.records import Record

HEAD_BYTES = 4096
"""Bytes at the start of a file from which its format is recognised."""

FALLBACK = "OBSPY"
"""Name of the format of files that no other format recognises; ``OBSPY:NAME`` selects one of obspy's."""


class FileSet(NamedTuple):
    """Place of a component file among the files of its recording, from its name.

    Parameters
    ----------
    key : str
        Common to the names of all files of the recording.
    size : int
        Number of files of a complete recording.
    component : str
        Component of the file; files are read in the order NS, EW, others, UD.
    level : str
        Sensor of the file, ``surface`` or ``borehole``; empty for stations with one sensor.
    """

    key: str
    size: int
    component: str
    level: str = ""


@dataclass(frozen=True, kw_only=True)
class Format:
    """Everything that readers, messages and plug-ins need to know of one file format.

    Parameters
    ----------
    name : str
        Name in the option ``format``, that of its file in upper case with hyphens, and in :attr:`~seisblock.records.Record.format`.
    parse : callable
        ``parse(blob, **options)``: a record, or a list of records or of single components to be assembled.
    title : str
        Name in messages and in the documentation, if other than `name`; words of a language are marked for translation by ``N_``.
    matches : callable or None
        ``matches(head)``: whether the first 4096 bytes begin a file of this format.
    matches_text : callable or None
        ``matches_text(lines)``: the same from the lines, for text files that no test of the first bytes recognises.
    specificity : int
        Formats of higher specificity are tested first: 2 for a fixed start, 1 for a pattern anywhere in the header.
    aliases : tuple of str
        Further names in the option ``format``.
    options : tuple of str
        Read options passed to `parse`: those that a file of this format may lack.
    plugin : bool
        Whether ObsPy reads the format by a plug-in of this package; its name there is `obspy_name`.
    synchronous : bool
        Whether components have a common start but may differ in length.
    aligned : bool
        Whether components have absolute start times and are cut to their common window.
    proves : tuple of str
        What a file states or proves by a second statement, in the words of :func:`~seisblock.records.qc_report.record_checks`.
    is_derived : callable or None
        ``is_derived(head)``: whether a file has only data derived from a record, as spectra; skipped in archives and folders.
    file_set : callable or None
        ``file_set(basename)``: the :class:`FileSet` of a component file by its name, None for other names.
    recording_key : callable or None
        ``recording_key(head)``: header entries common to the component files of a recording, from the first 8192 bytes.
    """

    name: str
    parse: Callable[..., Record | list[Record]]
    title: str = ""
    matches: Callable[[bytes], bool] | None = None
    matches_text: Callable[[Sequence[str]], bool] | None = None
    specificity: int = 2
    aliases: tuple[str, ...] = ()
    options: tuple[str, ...] = ()
    plugin: bool = True
    synchronous: bool = False
    aligned: bool = False
    proves: tuple[str, ...] = ()
    is_derived: Callable[[bytes], bool] | None = None
    file_set: Callable[[str], FileSet | None] | None = None
    recording_key: Callable[[bytes], object] | None = None

    @property
    def obspy_name(self) -> str:
        """Name as a waveform format of ObsPy."""
        return self.name.replace("-", "")


_FORMATS: dict[str, Format] = {}


def register(file_format: Format) -> Format:
    """Add a format to the registry and return it."""
    _FORMATS[file_format.name] = file_format
    return file_format


@cache
def list_formats() -> tuple[Format, ...]:
    """Return all formats, the most specific first, then by name.

    Examples
    --------
    >>> [file_format.name for file_format in list_formats() if file_format.specificity < 2]
    ['AT2', 'CSV', 'OBSPY']
    """
    for name in format_names():
        importlib.import_module(f"seisblock.readers.formats.{name.lower().replace('-', '_')}")
    return tuple(sorted(_FORMATS.values(), key=lambda file_format: (-file_format.specificity, file_format.name)))


def format_titles() -> list[Message]:
    """Return the titles of the formats recognised by their first bytes, for messages."""
    return [lazy_gettext(f.title or f.name) for f in map(find_format, format_names()) if f.matches is not None and f.name != FALLBACK]


def find_format(name: str) -> Format:
    """Return a format by its name or an alias, in any case; that of ObsPy for other names.

    Examples
    --------
    >>> [find_format(name).name for name in ("k-net", "JMA", "OBSPY:MSEED")]
    ['KNET', 'JMA-CSV', 'MSEED']
    """
    key = name.upper()
    return next((f for f in list_formats() if key == f.name or key in f.aliases), None) or _FORMATS[FALLBACK]


def match_head(head: bytes) -> Format | None:
    """Return the format recognised from the first bytes of a file, or None."""
    head = normalize_text(RawFile("", head[:HEAD_BYTES])).data
    return next((f for f in list_formats() if f.matches is not None and f.matches(head)), None)


def detect_format(blob: RawFile) -> Format:
    """Return the format of a file by its content; that of ObsPy if no other matches."""
    file_format = match_head(blob.content[:HEAD_BYTES])
    if file_format is not None:
        return file_format
    try:
        lines = read_lines(blob)
    except RecordFormatError:
        return find_format(FALLBACK)
    return next((f for f in list_formats() if f.matches_text is not None and f.matches_text(lines)), None) or find_format(FALLBACK)
