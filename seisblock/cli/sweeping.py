"""``--component all-azimuths``: every direction of a record, and the worst of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from seisblock.cli.inputs import load, motions
from seisblock.cli.options import Source
from seisblock.cli.talk import say
from seisblock.records.motion import ALL_AZIMUTHS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.records import Motion, Record
    from seisblock.results import Response


def sweeps(source: Source) -> bool:
    """Return whether every direction is asked for."""
    return [name.lower() for name in source.component] == [ALL_AZIMUTHS]


def swept(source: Source, look: Callable[[Record], Sequence[Any]]) -> Iterator[tuple[Motion, Sequence[Any]]]:
    """Yield each motion asked for; the worst direction, with all of them, where they are all asked for.

    Parameters
    ----------
    source : Source
    look : callable
        Returns what became of the body in each direction of a record, the worst first.
    """
    from seisblock.records import motion_of

    if not sweeps(source):
        yield from ((motion, ()) for record in load(source) for motion in motions(record, source))
        return
    for record in load(replace(source, component=())):
        found = look(record)
        say("worst of {count} directions: azimuth {azimuth:g} degrees", count=len(found), azimuth=found[0].azimuth_deg)
        yield motion_of(record, f"{found[0].azimuth_deg:g}"), found


def drawing(responses: Sequence[Response[Any]], extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Callable[[], Figure] | None:
    """Return what draws the directions, None where they were not looked in."""
    if not any("directions" in extra for extra in extras):
        return None

    def draw() -> Figure:
        from seisblock.present.figures.azimuths import figure

        return figure(responses, [extra["directions"] for extra in extras], gal=gal)

    return draw
