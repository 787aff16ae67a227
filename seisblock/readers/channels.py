"""Channels of one file: a component each; of a structure that has many, those of one place are a station of their own."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from seisblock.readers.directions import Direction
from seisblock.records import Component, Record
from seisblock.typing import FloatArray
from seisblock.words import said

MOST = 3
"""Channels of one place on the ground: two horizontals and the vertical."""

_LABEL = re.compile(r"^(?:location)?[\s:,;-]*", re.IGNORECASE)


def turned(direction: Direction, values: FloatArray, name: str) -> tuple[Component, tuple[str, ...]]:
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
    history = (said("turned the sign of {name!r}, which is positive down, to UD, positive up", name=name.strip()),)
    return Component(direction.code, -values, direction.azimuth_deg), history


def at_places(parts: Sequence[Record], *, structure: bool = False) -> list[Record]:
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
    few = len(parts) <= MOST and len(set(codes)) == len(parts)
    if few and not (structure and all(part.metadata.get("place") for part in parts)):
        return list(parts)
    places = [str(part.metadata.get("place", "")) for part in parts]
    held = Counter(zip(places, codes, strict=True))
    named = []
    for part, place, code in zip(parts, places, codes, strict=True):
        alone = not place or held[place, code] > 1
        channels = part.metadata.get("channels")
        number = channels.get(code, "") if isinstance(channels, dict) else ""
        where = f"{place} channel {number}".strip() if alone else place
        site = str(part.metadata.get("station_name", ""))
        metadata = {**part.metadata, "station_name": f"{site}, {where}" if site else where}
        named.append(replace(part, station=f"{part.station} {where}".strip(), metadata=metadata))
    return named


def place_in(text: str) -> str:
    """Return where a channel is, from what follows its direction in a header.

    Examples
    --------
    >>> place_in("  Location: Roof, SE corner     "), place_in("   (Rcrdr Chan  1) Location: Ground floor"), place_in("")
    ('Roof, SE corner', 'Ground floor', '')
    """
    return _LABEL.sub("", re.sub(r"\([^)]*\)", " ", text).strip()).strip()
