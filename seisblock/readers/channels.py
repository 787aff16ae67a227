"""Channels of one file: a component each; of a structure that has many, those of one place are a station of their own."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers.directions import Direction
from seisblock.records import Component, Record

MAX_CHANNELS = 3
"""Channels of one place on the ground: two horizontals and the vertical."""

_LABEL = re.compile(r"^(?:location)?[\s:,;-]*", re.IGNORECASE)


def make_component(direction: Direction, values: FloatArray, name: str) -> tuple[Component, tuple[str, ...]]:
    """Return a component, a vertical one positive up, and what the history says of it.

    Parameters
    ----------
    direction : Direction
    values : (n,) array, m/s^2
    name : str
        Of the direction, as the file has it.
    """
    if direction.sign > 0:
        return Component(direction.code, values, direction.azimuth_deg), ()
    history = (lazy_gettext("sign of {name!r} (positive down) reversed to UD (positive up)", name=name.strip()),)
    return Component(direction.code, -values, direction.azimuth_deg), history


def split_by_location(parts: Sequence[Record], *, structure: bool = False) -> list[Record]:
    """Return the channels of a file, each a record of one component; where they are a structure's, named after their places.

    Up to three channels of different directions are one station. More, or one direction twice, stand at several places: each place is then
    called as a station of its own, so that one of them is chosen as a station of a bundle is, and its name tells where it is.

    Parameters
    ----------
    parts : sequence of Record
        ``metadata["channels"]`` numbers them, ``metadata["place"]`` says where they are.
    structure : bool
        Whether they are known to be a structure's, of which this file may hold a part.
    """
    codes = [part.codes[0] for part in parts]
    is_one_station = len(parts) <= MAX_CHANNELS and len(set(codes)) == len(parts)
    if is_one_station and not (structure and all(part.metadata.get("place") for part in parts)):
        return list(parts)
    places = [str(part.metadata.get("place", "")) for part in parts]
    counts = Counter(zip(places, codes, strict=True))
    result = []
    for part, place, code in zip(parts, places, codes, strict=True):
        needs_number = not place or counts[place, code] > 1
        channels = part.metadata.get("channels")
        number = channels.get(code, "") if isinstance(channels, dict) else ""
        location = f"{place} channel {number}".strip() if needs_number else place
        site = str(part.metadata.get("station_name", ""))
        metadata = {**part.metadata, "station_name": f"{site}, {location}" if site else location}
        result.append(replace(part, station=f"{part.station} {location}".strip(), metadata=metadata))
    return result


def parse_location(text: str) -> str:
    """Return where a channel is, from what follows its direction in a header.

    Examples
    --------
    >>> parse_location("  Location: Roof, SE corner     "), parse_location("   (Rcrdr Chan  1) Location: Ground floor"), parse_location("")
    ('Roof, SE corner', 'Ground floor', '')
    """
    return _LABEL.sub("", re.sub(r"\([^)]*\)", " ", text).strip()).strip()
