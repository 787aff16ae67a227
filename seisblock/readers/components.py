"""Companion files of the other components beside a component file."""

from __future__ import annotations

import re
from pathlib import Path

from seisblock.core.errors import RecordError
from seisblock.readers.formats.at2 import is_at2, parse_orientation, split_direction
from seisblock.readers.formats.cosmos import is_cosmos
from seisblock.readers.formats.esm import is_esm
from seisblock.readers.formats.knet import is_knet
from seisblock.readers.formats.smc import is_smc
from seisblock.readers.limits import ReadBudget
from seisblock.readers.source import RawFile, read_bytes

_KNET_NAME = re.compile(r"^(?P<stem>.+)\.(?P<code>NS|EW|UD)(?P<sensor>[12]?)\Z", re.IGNORECASE)
_CHANNEL_NAMES = (
    # HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC, AKBMR--n.1000hyfh.BNZ.--.acc.V2c
    re.compile(r"^(?P<before>.+\.[FGDCESHBML][NGHL])(?P<code>[ENZ123])(?P<after>\..+)\Z", re.IGNORECASE),
    # 0111a.smc, np01002p_4225b_a.smc
    re.compile(r"^(?P<before>.*\d)(?P<code>[A-Z])(?P<after>(?:_[ACPU])?\.SMC)\Z", re.IGNORECASE),
)
"""Names of single-component files in which one letter gives the component."""

_SENSORS = {"borehole": "1", "surface": "2"}
_COMPONENT_ORDER = {"NS": 0, "EW": 1, "UD": 2}


def load_component_files(blob: RawFile, budget: ReadBudget, level: str | None = None) -> list[RawFile]:
    """Return a file and the other component files of its set in the same folder, in the order NS, EW, UD.

    For KiK-net, the files of the same sensor or of the sensor `level`.
    """
    if blob.path is None:
        return [blob]
    if is_knet(blob.content[:64]):
        return _load_knet_set(blob, blob.path, level, budget)
    if is_at2(blob.content[:4096]):
        return _load_at2_set(blob, blob.path, budget)
    if is_smc(blob.content[:4096]) or is_esm(blob.content[:4096]) or is_cosmos(blob.content[:4096]):
        return _load_channel_set(blob, blob.path, budget)
    return [blob]


def knet_file_set(basename: str) -> tuple[str, int] | None:
    """Return common name stem and number of files of a K-NET or KiK-net station, or None for other names.

    Examples
    --------
    >>> knet_file_set("AOM0012003011200.EW"), knet_file_set("AICH040010061330.NS2"), knet_file_set("record.csv")
    (('AOM0012003011200', 3), ('AICH040010061330', 6), None)
    """
    match = _KNET_NAME.match(basename)
    return None if match is None else (match["stem"], 6 if match["sensor"] else 3)


def channel_file_set(basename: str) -> str | None:
    """Return the common name pattern of the channel files of a station, or None for other names.

    Examples
    --------
    >>> channel_file_set("0111a.smc"), channel_file_set("HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC"), channel_file_set("CE36456.V2")
    ('0111?.smc', 'HI.ARS1..HN?.D.20190728.160908.C.ACC.ASC', None)
    """
    match = next((candidate for pattern in _CHANNEL_NAMES if (candidate := pattern.match(basename))), None)
    return None if match is None else f"{match['before']}?{match['after']}"


def _load_channel_set(blob: RawFile, path: Path, budget: ReadBudget) -> list[RawFile]:
    """Return the files whose names differ in the channel letter only and whose headers match."""
    own_set = channel_file_set(path.name)
    if own_set is None:
        return [blob]
    set_paths = [p for p in _directory_files(path) if (channel_file_set(p.name) or "").lower() == own_set.lower()]
    return [member for member in (_load_file(p, blob, budget) for p in set_paths) if _recording_key(member) == _recording_key(blob)]


def _recording_key(blob: RawFile) -> tuple[object, ...]:
    """Return the header entries common to the channels of a recording: format, station, place and time."""
    head = blob.content[:8192]
    text = head.decode("latin-1")
    if is_smc(head):
        lines = text.splitlines()
        # title, event, station, and start among the integers
        return ("SMC", lines[0].strip(), lines[3].split(), lines[5].lower().partition("component")[0].split(), lines[11].split()[1:7])
    if is_esm(head):
        keys = ("STATION_CODE", "LOCATION", "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS", "UNITS", "DATA_TYPE")
        return ("ESM", *(re.findall(rf"^{key}:(.*)$", text, re.MULTILINE) for key in keys))
    if is_cosmos(head):
        lines = [*text.splitlines(), *[""] * 9]
        start_text = re.sub(r"\s*RcrdId.*", "", lines[7])
        return ("COSMOS", lines[0][:40], lines[4], start_text, lines[8].partition("Location:")[2].strip())
    return (None,)


def _load_knet_set(blob: RawFile, path: Path, level: str | None, budget: ReadBudget) -> list[RawFile]:
    """Return the three files of a K-NET station, or of one sensor of a KiK-net station."""
    match = _KNET_NAME.match(path.name)
    if match is None:
        return [blob]
    # KiK-net suffixes: 1 borehole, 2 surface
    sensor = _SENSORS.get(level or "", match["sensor"]) if match["sensor"] else ""
    ranks = {f"{match['stem']}.{code}{sensor}".upper(): rank for code, rank in _COMPONENT_ORDER.items()}
    paths = {ranks[p.name.upper()]: p for p in _directory_files(path) if p.name.upper() in ranks and p.name.startswith(match["stem"])}
    if not paths:
        return [blob]
    return [_load_file(paths[rank], blob, budget) for rank in sorted(paths)]


def _load_at2_set(blob: RawFile, path: Path, budget: ReadBudget) -> list[RawFile]:
    """Return the files whose names differ in the direction only and whose headers have the same event and sampling."""
    own_parts = split_direction(path.name)
    if own_parts is None:
        return [blob]
    files_by_code: dict[str, RawFile] = {}
    for neighbour in _directory_files(path):
        other_parts = split_direction(neighbour.name) if neighbour.suffix.lower() == path.suffix.lower() else None
        if other_parts is None or other_parts[0].lower() != own_parts[0].lower():
            continue
        candidate = _load_file(neighbour, blob, budget)
        if _at2_key(candidate) == _at2_key(blob):
            # keyed by component: a duplicate direction replaces, the given file is checked below
            files_by_code[parse_orientation(other_parts[1])[0]] = blob if neighbour == path else candidate
    if not any(candidate.path == path for candidate in files_by_code.values()):
        return [blob]
    return [files_by_code[code] for code in sorted(files_by_code, key=lambda code: (_COMPONENT_ORDER.get(code, 1.5), code))]


def _at2_key(blob: RawFile) -> tuple[bytes, bytes | None]:
    """Return the header entries common to an AT2 set: title without direction, and DT."""
    lines = blob.content[:2000].splitlines()
    # .0200 and 0.02 are the same interval
    interval = re.search(rb"DT\s*=\s*0*([\d.]+)", blob.content[:2000])
    return (lines[1].rpartition(b",")[0] if len(lines) > 1 else b"", interval[1].rstrip(b"0") if interval else None)


def _directory_files(path: Path) -> list[Path]:
    try:
        return sorted(p for p in path.parent.iterdir() if p.is_file())
    except OSError:
        return [path]


def _load_file(path: Path, origin: RawFile, budget: ReadBudget) -> RawFile:
    if path == origin.path:
        return origin
    try:
        return RawFile(str(path), read_bytes(path, str(path), budget), path)
    except RecordError as error:
        raise RecordError("{error} (component file of the same set as {name})", error=error.message, name=origin.name) from error
