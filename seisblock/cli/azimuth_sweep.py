"""Azimuth sweep (``--component all-azimuths``): all azimuths of a record and the worst of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from seisblock.cli.console import info
from seisblock.cli.load_records import load_records, selected_motions
from seisblock.cli.options import Source
from seisblock.records.motion import ALL_AZIMUTHS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.core.results import Response
    from seisblock.records import Motion, Record


def is_azimuth_sweep(source: Source) -> bool:
    """Return whether ``--component all-azimuths`` was given."""
    return [name.lower() for name in source.component] == [ALL_AZIMUTHS]


def sweep_motions(source: Source, solve: Callable[[Record], Sequence[Any]]) -> Iterator[tuple[Motion, Sequence[Any]]]:
    """Yield each selected motion; in a sweep, the motion of the worst azimuth with the results of all azimuths.

    Parameters
    ----------
    source : Source
    solve : callable
        Returns the results of all azimuths of a record, the worst first.
    """
    from seisblock.records import motion_of

    if not is_azimuth_sweep(source):
        yield from ((motion, ()) for record in load_records(source) for motion in selected_motions(record, source))
        return
    for record in load_records(replace(source, component=())):
        results = solve(record)
        info("worst of {count} azimuths: {azimuth:g} degrees", count=len(results), azimuth=results[0].azimuth_deg)
        yield motion_of(record, f"{results[0].azimuth_deg:g}"), results


def azimuth_figure(responses: Sequence[Response[Any]], extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Callable[[], Figure] | None:
    """Return a function that draws the azimuth sweep, None without a sweep."""
    if not any("directions" in extra for extra in extras):
        return None

    def draw() -> Figure:
        from seisblock.report.figures.azimuths import figure

        return figure(responses, [extra["directions"] for extra in extras], gal=gal)

    return draw
