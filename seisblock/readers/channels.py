"""Channels of a file as components; places in a structure as separate stations."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers.directions import Direction
from seisblock.readers.registry import FileSet
from seisblock.records import Component, Record

_Block = TypeVar("_Block")

MAX_CHANNELS = 3
"""Channels of one sensor: two horizontals and the vertical."""

# HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC, AKBMR--n.1000hyfh.BNZ.--.acc.V2c
_SEED_NAME = re.compile(r"(?P<before>.+\.[FGDCESHBML][NGHL])(?P<code>[ENZ123])(?P<after>\..+)\Z", re.IGNORECASE)
# NET.STA.LOC.CHA at the start, or a channel code before the suffix of a waveform file
_WAVEFORM_NAMES = (
    re.compile(
        r"(?P<before>[A-Z0-9]{1,2}\.[A-Z0-9]{1,5}\.[A-Z0-9-]{0,2}\.[FGDCESHBMLVUR][A-Z])(?P<code>[ENZ123])(?P<after>(?:[._-].*)?)\Z", re.I
    ),
    re.compile(
        r"(?P<before>(?:.*[._-])?[FGDCESHBMLVUR][NGHL])(?P<code>[ENZ123])(?P<after>(?:[._-].*)?\.(?:sac|mseed|miniseed|msd|ms|seed))\Z",
        re.I,
    ),
)
_LABEL = re.compile(r"^(?:location)?[\s:,;-]*", re.IGNORECASE)


def make_component(direction: Direction, values: FloatArray, name: str) -> tuple[Component, tuple[str, ...]]:
    """Return a component of samples in m/s^2, (n,), a vertical one positive up, and history entries; `name` is its direction as written."""
    if direction.sign > 0:
        return Component(direction.code, values, direction.azimuth_deg), ()
    history = (lazy_gettext("sign of {name!r} (positive down) reversed to UD (positive up)", name=name.strip()),)
    return Component(direction.code, -values, direction.azimuth_deg), history


def split_by_location(parts: Sequence[Record], *, structure: bool = False) -> list[Record]:
    """Return one single-component record per channel; channels of a structure are named by their place.

    Up to three channels of different directions are one station. More channels, or two with one direction, are at several places: each
    place becomes a station, named by the place and selected like a station of an archive. ``metadata["channels"]`` has the channel numbers,
    ``metadata["place"]`` the place. `structure` is True if the channels are known to be in a structure, possibly spread over several files.
    """
    codes = [part.codes[0] for part in parts]
    # two channels of one direction cannot be at one place of a free field
    is_one_station = len(parts) <= MAX_CHANNELS and len(set(codes)) == len(parts)
    if is_one_station and not (structure and all(part.metadata.get("place") for part in parts)):
        return list(parts)
    places = [str(part.metadata.get("place", "")) for part in parts]
    counts = Counter(zip(places, codes, strict=True))
    result = []
    for part, place, code in zip(parts, places, codes, strict=True):
        # two channels with one direction at one place are told apart by their number
        needs_number = not place or counts[place, code] > 1
        channels = part.metadata.get("channels")
        number = channels.get(code, "") if isinstance(channels, dict) else ""
        location = f"{place} channel {number}".strip() if needs_number else place
        site = str(part.metadata.get("station_name", ""))
        metadata = {**part.metadata, "station_name": f"{site}, {location}" if site else location}
        result.append(replace(part, station=f"{part.station} {location}".strip(), metadata=metadata))
    return result


def parse_blocks(lines: Sequence[str], parse_block: Callable[[int], tuple[_Block, int]]) -> list[_Block]:
    """Return the results of ``parse_block(begin) -> (result, index after the block)`` for all blocks, without blank lines between."""
    blocks, begin = [], 0
    while begin < len(lines):
        if lines[begin].strip():
            block, begin = parse_block(begin)
            blocks.append(block)
        else:
            begin += 1
    return blocks


def parse_location(text: str) -> str:
    """Return the location of a channel from the header text after its direction.

    Examples
    --------
    >>> parse_location("  Location: Roof, SE corner     "), parse_location("   (Rcrdr Chan  1) Location: Ground floor"), parse_location("")
    ('Roof, SE corner', 'Ground floor', '')
    """
    return _LABEL.sub("", re.sub(r"\([^)]*\)", " ", text).strip()).strip()


def seed_file_set(basename: str) -> FileSet | None:
    """Return the file set of a file with a SEED channel code in its name, None for other names.

    Examples
    --------
    >>> seed_file_set("HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC"), seed_file_set("CE36456.V2")
    (FileSet(key='hi.ars1..hn?.d.20190728.160908.c.acc.asc', size=3, component='E', level=''), None)
    """
    match = _SEED_NAME.match(basename)
    return match and FileSet(f"{match['before']}?{match['after']}".lower(), 3, match["code"])


def waveform_file_set(basename: str) -> FileSet | None:
    """Return the file set of a miniSEED or SAC file with a SEED channel code in its name, None for other names.

    Examples
    --------
    >>> waveform_file_set("BK.CMB.00.HNE__20140824T102014Z.mseed").key, waveform_file_set("kobe_HN1.sac").component
    ('bk.cmb.00.hn?__20140824t102014z.mseed', '1')
    >>> waveform_file_set("record.mseed") is None
    True
    """
    match = next((match for pattern in _WAVEFORM_NAMES if (match := pattern.match(basename))), None)
    return match and FileSet(f"{match['before']}?{match['after']}".lower(), 3, match["code"].upper())
