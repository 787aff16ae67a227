"""Azimuth sweep (``--component all-azimuths``): all azimuths of a record and the worst of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from seisblock.cli.console import info
from seisblock.cli.load_records import iter_motions, load_records
from seisblock.cli.options import Source
from seisblock.cli.output import OutputOptions
from seisblock.cli.progress import progress
from seisblock.cli.write_results import write_results
from seisblock.core.i18n import N_
from seisblock.records.motion import ALL_AZIMUTHS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.bodies.block import Block
    from seisblock.cli.bodies.block import BodyChoice
    from seisblock.core.results import Response
    from seisblock.output.json.schema import Document
    from seisblock.records import Motion, Record
    from seisblock.studies.sampling import ParameterVariation


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
    from seisblock.records.motion import motion_toward

    if not is_azimuth_sweep(source):
        yield from ((motion, ()) for motion in iter_motions(source))
        return
    for record in load_records(replace(source, component=())):
        results = solve(record)
        text = N_("worst of {count} azimuths: {azimuth:g}°")
        if not any(result.moves for result in results):
            # no worst one: the first azimuth stands for all, the one with the largest peak
            results = sorted(results, key=lambda result: -_peak(record, result.azimuth_deg))
            text = N_("no motion in any of {count} azimuths; largest PGA at {azimuth:g}°")
        info(text, count=len(results), azimuth=results[0].azimuth_deg)
        yield motion_toward(record, results[0].azimuth_deg), results


def ranked_sweep(
    solver: str, body: Any, options: Any, runs: int, variation: ParameterVariation, seed: int, known: Sequence[str] = ()
) -> Callable[[Record], Sequence[Any]]:
    """Return a function that solves all azimuths of a record, with samples in each if there are any."""

    def solve(record: Record) -> Sequence[Any]:
        from seisblock.studies.azimuth_probability import solve_azimuths

        with progress("azimuths") as advance:
            return solve_azimuths(solver, body, record, options, runs, priors=variation, seed=seed, known=known, progress=advance)

    return solve


def _peak(record: Record, azimuth: float) -> float:
    """Return the PGA in an azimuth, m/s^2."""
    from seisblock.records.motion import motion_toward

    return float(abs(motion_toward(record, azimuth).horizontal).max())


def sweep_block(choice: BodyChoice, motion: Motion, directions: Sequence[Any]) -> Block:
    """Return the block of a motion; in a sweep its base is projected on the worst azimuth."""
    return choice.body.block_toward(directions[0].azimuth_deg) if directions else choice.block_for_motion(motion)


def write_assessed(
    document: Document,
    output: OutputOptions,
    responses: Sequence[Response[Any]],
    extras: Sequence[Mapping[str, Any]],
    tables: Callable[[], Iterable[Any]],
) -> None:
    """Print responses with their assessments and write the requested files, see :func:`seisblock.cli.write_results.write_results`."""
    from seisblock.report.text.assessment import first_probability

    figure = _assessed_figure(responses, extras, gal=output.gal)
    write_results(document, output, responses=responses, figure=figure, tables=tables, probability=first_probability(extras))


def _assessed_figure(responses: Sequence[Response[Any]], extras: Sequence[Mapping[str, Any]], *, gal: bool) -> Callable[[], Figure]:
    """Return a function that draws the azimuth sweep, or the time histories with the overturning probabilities."""

    def draw() -> Figure:
        if not any("directions" in extra for extra in extras):
            from seisblock.output.figures.solver import response_figure

            assessments = [extra.get("assessment") for extra in extras]
            probabilities = [None if item is None else item.assessment.overturning_probability for item in assessments]
            samples = [extra.get("probability") for extra in extras]
            falls = {"falls": samples} if any(hasattr(item, "fell_azimuths_deg") for item in samples) else {}
            return response_figure(responses, gal=gal, probabilities=probabilities, **falls)
        from seisblock.report.figures.azimuths import figure

        return figure(responses, [extra["directions"] for extra in extras], gal=gal)

    return draw
