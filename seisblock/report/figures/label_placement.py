"""Names beside places on a map: on the side where there is room, the first of them in any case."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

Box = tuple[float, float, float, float]
"""West, south, east and north end, shares of the map."""

SIDES = ((1, 1), (-1, 1), (1, -1), (-1, -1))
"""Where a name may stand: east or west of its place, above or below it; the first that is free."""

LETTER, LINE, LABEL_OFFSET = 0.034, 0.07, 0.03
"""Width of a letter (of two for one of a Japanese name), height of a line and distance from the place, shares of a small map, 35 mm
wide: on a larger one there is more room."""


DOT = 0.012
"""How far a point reaches, a share of the map."""


@dataclass(frozen=True)
class Place:
    """A place with its name, shares of the map."""

    name: str
    east: float
    north: float


def place_labels(places: Sequence[Place], occupied: Sequence[Box], dots: Sequence[Place] = ()) -> Iterator[tuple[Place, tuple[int, int]]]:
    """Yield the places whose names have room, and on which side; the first place also without room, where least is hidden.

    Parameters
    ----------
    places : sequence of Place
        Those that matter most first.
    occupied : sequence of Box
        Where no name may stand.
    dots : sequence of Place
        What a name rather leaves in sight.

    Examples
    --------
    >>> [side for _, side in place_labels([Place("A", 0.5, 0.5), Place("B", 0.505, 0.5), Place("C", 0.98, 0.2)], [])]
    [(1, 1), (-1, 1), (-1, 1)]
    """
    boxes_taken = list(occupied)
    dot_boxes = [(dot.east - DOT, dot.north - DOT, dot.east + DOT, dot.north + DOT) for dot in dots]
    for place in places:
        boxes = {side: label_box(place, side) for side in SIDES}
        hidden = {side: sum(overlap_area(box, obstacle) for obstacle in boxes_taken) + _area_off_map(box) for side, box in boxes.items()}
        covered = {side: sum(overlap_area(box, dot) for dot in dot_boxes) for side, box in boxes.items()}
        best = min(SIDES, key=lambda side: (hidden[side], covered[side]))
        if hidden[best] > 0.0 and place is not places[0]:
            continue
        boxes_taken.append(boxes[best])
        yield place, best


def label_box(place: Place, side: tuple[int, int]) -> Box:
    """Return where a name stands on one side of its place."""
    wide = LETTER * sum(2 if unicodedata.east_asian_width(letter) in "WF" else 1 for letter in place.name)
    west = place.east + LABEL_OFFSET if side[0] > 0 else place.east - LABEL_OFFSET - wide
    south = place.north if side[1] > 0 else place.north - LINE
    return west, south, west + wide, south + LINE


def overlap_area(a: Box, b: Box) -> float:
    """Return the area that two boxes share, 0 where they touch or are apart."""
    across, along = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    return max(across, 0.0) * max(along, 0.0)


def _area_off_map(box: Box) -> float:
    """Return the area of a box that is off the map."""
    return (box[2] - box[0]) * (box[3] - box[1]) - overlap_area(box, (0.0, 0.0, 1.0, 1.0))
