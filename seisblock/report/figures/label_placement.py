"""Greedy placement of labels beside points on a map."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

Box = tuple[float, float, float, float]
"""West, south, east and north limit, fractions of the map."""

SIDES = ((1, 1), (-1, 1), (1, -1), (-1, -1))
"""Candidate sides of a label (east, north), in order of preference."""

LETTER, LINE, LABEL_OFFSET = 0.034, 0.07, 0.03
"""Width of a Latin character (half a Japanese one), line height, and offset from the point, fractions of a 35 mm map."""

DOT = 0.012
"""Half width of a point, fraction of the map."""


@dataclass(frozen=True)
class Place:
    """A named point, fractions of the map."""

    name: str
    east: float
    north: float


def place_labels(places: Sequence[Place], occupied: Sequence[Box], dots: Sequence[Place] = ()) -> Iterator[tuple[Place, tuple[int, int]]]:
    """Yield the points whose labels fit, with the side; the first point always, on the side with least overlap.

    Parameters
    ----------
    places : sequence of Place
        In order of priority.
    occupied : sequence of Box
        Areas without labels.
    dots : sequence of Place
        Points that labels should not cover if avoidable.

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
        # labels and forbidden areas take precedence over points; ties keep the order of SIDES
        best = min(SIDES, key=lambda side: (hidden[side], covered[side]))
        if hidden[best] > 0.0 and place is not places[0]:
            continue
        boxes_taken.append(boxes[best])
        yield place, best


def label_box(place: Place, side: tuple[int, int]) -> Box:
    """Return the box of a label on one side of its point."""
    wide = LETTER * sum(2 if unicodedata.east_asian_width(letter) in "WF" else 1 for letter in place.name)
    west = place.east + LABEL_OFFSET if side[0] > 0 else place.east - LABEL_OFFSET - wide
    south = place.north if side[1] > 0 else place.north - LINE
    return west, south, west + wide, south + LINE


def overlap_area(a: Box, b: Box) -> float:
    """Return the overlap area of two boxes."""
    across, along = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    return max(across, 0.0) * max(along, 0.0)


def _area_off_map(box: Box) -> float:
    """Return the area of a box outside the map."""
    return (box[2] - box[0]) * (box[3] - box[1]) - overlap_area(box, (0.0, 0.0, 1.0, 1.0))
