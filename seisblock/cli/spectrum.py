"""``seisblock spectrum``: one record, and blocks of all sizes, slendernesses and frictions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from seisblock.bodies.inset import SHARP, Inset
from seisblock.cli.bodies.options import rocking_options
from seisblock.cli.command import Command, option
from seisblock.cli.meant import OneOf
from seisblock.cli.options import Source, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.rock import along, need_vertical
from seisblock.cli.sweeping import sweeps
from seisblock.cli.types import FLOATS, INSET, LENGTHS, MUS, Count
from seisblock.errors import ParameterError
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.words import noted, said

if TYPE_CHECKING:
    from seisblock.records import Motion
    from seisblock.studies.rocking.spectra import RockingSpectrum

KINDS = ("rocking", "overturning", "sliding", "modes")
AROUND = KINDS[:2]
"""Kinds that look in every direction when they are asked to."""

SMALLEST_REACH, LARGEST_REACH = 0.2, 1.5
"""Friction and b/h to which a map reaches that is not told how far, at least and at most."""


@click.command(
    cls=Command,
    examples=(
        "seisblock spectrum --component NS --plot spectrum.png",
        "seisblock spectrum record.csv --kind overturning --sizes 0.2:4:0.1 --height-over-width 2:8:0.25 --csv falls.csv",
        "seisblock spectrum record.csv --kind sliding --mu 0.05:0.6:0.01 --plot sliding.png",
        "seisblock spectrum record.csv --kind modes --sizes 1m --plot modes.png",
    ),
)
@record_options
@option(
    "--kind",
    type=OneOf(KINDS),
    default="rocking",
    show_default=True,
    help="Largest lean over alpha; overturning alone; the largest slip against friction; or which mode governs, over friction and shape "
    "or size.",
)
@option(
    "--mu",
    type=MUS,
    section="Body",
    metavar="LIST|RANGE",
    help="Friction, 1, for --kind sliding and modes. [default: 0.02 to 0.8; or what the record can move]",
)
@option(
    "--sizes",
    type=LENGTHS,
    section="Body",
    metavar="LIST|RANGE",
    help="Diagonals 2R, m or with units. [default: 0.2 to 8, geometric; for modes 1]",
)
@option("--frequency-parameter", type=FLOATS, section="Body", metavar="LIST|RANGE", help="p = sqrt(3g/4R), rad/s, instead of --sizes.")
@option(
    "--height-over-width",
    type=FLOATS,
    section="Body",
    metavar="LIST|RANGE",
    help="H/B of the blocks, 1. [default: 1.5 to 10; for modes what the record can move]",
)
@option(
    "--slenderness-rad", type=FLOATS, section="Body", metavar="LIST|RANGE", help="alpha = atan(B/H), rad, instead of --height-over-width."
)
@option(
    "--inset",
    type=INSET,
    metavar="SHARE|M",
    section="Body",
    help="How far in from each side the blocks' worn edges lie: a share of the width (0.1, 10%), or m with a unit (1cm). [default: 0]",
)
@option(
    "--steps",
    type=Count(noted("cells"), "SEISBLOCK_CELLS", least=2, power=2),
    default=40,
    show_default=True,
    help="Points of each axis that is left to its default.",
)
@rocking_options
@gravity_option
@output_options(histories=False, film=False, accelerations=False)
def spectrum(
    source: Source,
    output: Output,
    gravity: float,
    kind: str,
    mu: tuple[float, ...] | None,
    sizes: tuple[float, ...] | None,
    frequency_parameter: tuple[float, ...] | None,
    height_over_width: tuple[float, ...] | None,
    slenderness_rad: tuple[float, ...] | None,
    inset: Inset | None,
    steps: int,
    restitution: float | None,
    linear: bool,
    vertical: bool,
    azimuth: tuple[str, ...],
) -> None:
    """Largest lean of rectangular blocks over their alpha, against size and slenderness, for each component.

    Overturning is not monotone: look for islands in the figure. With --component all-azimuths leans are those of the worst of 18
    directions, and --kind overturning tells in how many of them each block falls. With --kind sliding, the largest slip against
    friction. With --kind modes, what a free-standing block does, as respond tells it, over its friction and its shape, or over its
    friction and its size for one shape; the vertical component acts where there is one, and --restitution is Poisson's, 0 unless given.
    """
    source = along(source, azimuth)
    if sweeps(source) and kind not in AROUND:
        raise ParameterError("--component {name} goes with --kind {kinds}", name=ALL_AZIMUTHS, kinds=list(AROUND))
    _one_of(sizes, "--sizes", frequency_parameter, "--frequency-parameter")
    _one_of(height_over_width, "--height-over-width", slenderness_rad, "--slenderness-rad")
    if kind == "sliding":
        given = {
            "sizes": sizes,
            "frequency-parameter": frequency_parameter,
            "height-over-width": height_over_width,
            "slenderness-rad": slenderness_rad,
            "inset": inset,
            "restitution": restitution,
            "linear": linear,
        }
        _refuse(kind, given)
        _sliding(source, output, gravity, mu, vertical)
        return
    from seisblock.studies.rocking.spectra import default_sizes, default_slendernesses, size_of, slenderness_of

    diagonals = sizes or (size_of(frequency_parameter, gravity) if frequency_parameter else None)
    alphas = slenderness_rad or (slenderness_of(height_over_width) if height_over_width else None)
    if kind == "modes":
        _refuse(kind, {"linear": linear})
        asked = click.get_current_context().get_parameter_source("vertical") is not ParameterSource.DEFAULT
        _modes(source, output, gravity, (mu, diagonals, alphas, steps), restitution or 0.0, inset or SHARP, vertical if asked else None)
        return
    _refuse(kind, {"mu": mu})
    from seisblock.cli.emit import emit
    from seisblock.present.documents.spectrum import document
    from seisblock.present.text import spectrum as shown

    diagonals = default_sizes(steps) if diagonals is None else diagonals
    alphas = default_slendernesses(steps) if alphas is None else alphas
    options: dict[str, Any] = {"restitution": restitution, "linear": linear, "vertical": vertical, "inset": inset or SHARP}
    found = list(_spectra(source, diagonals, alphas, {**options, "gravity": gravity}))
    emit(
        document(found, kind, options, gravity=gravity),
        output,
        tables=lambda: shown.tables(found, kind, _worn(inset)),
        csv=lambda path: shown.write(path, found),
        figure=lambda: _draw(found, kind, gravity),
    )


def _spectra(source: Source, sizes: Any, alphas: Any, options: dict[str, Any]) -> Iterator[tuple[Motion, RockingSpectrum]]:
    """Yield the spectrum of each motion asked for; that of all directions, with the motion of the largest PGA, where they are."""
    from seisblock.cli.inputs import load, motions
    from seisblock.cli.progress import progress
    from seisblock.records import motion_of
    from seisblock.studies.rocking.spectra import rocking_spectrum, rocking_spectrum_around

    if not sweeps(source):
        for motion in (motion for record in load(source) for motion in motions(record, source)):
            need_vertical(motion, options["vertical"])
            with progress("spectrum {name}", name=motion.name) as advance:
                yield motion, rocking_spectrum(sizes, alphas, motion, progress=advance, **options)
        return
    for record in load(replace(source, component=())):
        with progress("spectrum {name}", name=ALL_AZIMUTHS) as advance:
            found = rocking_spectrum_around(sizes, alphas, record, progress=advance, **options)
        assert found.azimuths_deg is not None
        strongest = max((motion_of(record, f"{azimuth:g}") for azimuth in found.azimuths_deg), key=lambda each: abs(each.horizontal).max())
        yield replace(strongest, name=ALL_AZIMUTHS), found


def _refuse(kind: str, given: dict[str, Any]) -> None:
    """Refuse options that mean nothing to a kind of spectrum."""
    for name, value in given.items():
        if value:
            raise ParameterError("--{name} means nothing to --kind {kind}: leave it out", name=name, kind=kind)


def _sliding(source: Source, output: Output, gravity: float, mu: tuple[float, ...] | None, vertical: bool) -> None:
    """Answer ``--kind sliding``."""
    from seisblock.cli.emit import emit
    from seisblock.cli.inputs import load, motions
    from seisblock.cli.progress import progress
    from seisblock.present.documents.spectrum import sliding_document
    from seisblock.present.text import sliding_spectrum as shown
    from seisblock.studies.sliding import slide_study

    frictions = mu or tuple(round(0.02 * i, 2) for i in range(1, 41))
    found = []
    for motion in (motion for record in load(source) for motion in motions(record, source)):
        need_vertical(motion, vertical)
        with progress("sliding {name}", name=motion.name) as advance:
            found.append((motion, slide_study(frictions, motion, vertical=vertical, gravity=gravity, progress=advance)))
    emit(
        sliding_document(found, gravity=gravity, vertical=vertical),
        output,
        tables=lambda: shown.tables(found),
        csv=lambda path: shown.write(path, found),
        figure=lambda: _draw_sliding(found),
    )


def _modes(
    source: Source, output: Output, gravity: float, grid: tuple[Any, Any, Any, int], restitution: float, inset: Inset, vertical: bool | None
) -> None:
    """Answer ``--kind modes``; `grid` holds frictions, diagonals and slendernesses, None where not given, and the steps of an axis."""
    from seisblock.cli.emit import emit
    from seisblock.cli.inputs import load, motions
    from seisblock.cli.progress import progress
    from seisblock.present.documents.spectrum import modes_document
    from seisblock.present.text import mode_map as shown
    from seisblock.studies.standing.mode_map import mode_map

    shaken = [motion for record in load(source) for motion in motions(record, source)]
    for motion in shaken:
        need_vertical(motion, bool(vertical))
    axes = _axes(shaken, grid, gravity, vertical=vertical)
    found = []
    for motion in shaken:
        with progress("modes {name}", name=motion.name) as advance:
            each = mode_map(*axes, motion, inset=inset, restitution=restitution, vertical=vertical, gravity=gravity, progress=advance)
            found.append((motion, each))
    emit(
        modes_document(found, gravity=gravity, restitution=restitution, inset=inset, vertical=vertical is not False),
        output,
        tables=lambda: shown.tables(found, _worn(inset)),
        csv=lambda path: shown.write(path, found),
        figure=lambda: _draw_modes(found),
    )


def _axes(shaken: Sequence[Any], grid: tuple[Any, Any, Any, int], gravity: float, *, vertical: bool | None) -> tuple[Any, Any, Any]:
    """Return frictions, diagonals and slendernesses; those not given reach to what the motions can move, no two of them equal."""
    from seisblock.criteria.initiation import loading

    mu, diagonals, alphas, steps = grid
    push = max(loading(motion, vertical=vertical, gravity=gravity)[0] for motion in shaken)
    reach = min(max(math.ceil(12.5 * push) / 10.0, SMALLEST_REACH), LARGEST_REACH) if push < LARGEST_REACH else LARGEST_REACH
    if mu is None:
        mu = [round(reach * (i + 0.5) / steps, 12) for i in range(steps)]
    if alphas is None:
        if diagonals is not None and len(diagonals) > 1:
            raise ParameterError("--kind modes over several sizes is of one shape: give one --height-over-width or --slenderness-rad")
        alphas = [math.atan(round(reach * (i + 1) / steps, 12)) for i in range(steps)]
    return mu, (1.0,) if diagonals is None else diagonals, alphas


def _worn(inset: Inset | None) -> str:
    """Return a remark on worn edges, empty where there are none."""
    if not inset or inset == SHARP:
        return ""
    return said("; edges worn by {share:g} B + {length:g} m per side", share=inset.share, length=inset.length_m)


def _one_of(first: Any, name: str, second: Any, other: str) -> None:
    """Refuse two ways of saying the same."""
    if first and second:
        raise ParameterError("give either {name} or {other}, not both", name=name, other=other)


def _draw(*shown: Any) -> Any:
    """Return the figure of rocking spectra; matplotlib is loaded only for it."""
    from seisblock.present.figures.spectrum import figure

    return figure(*shown)


def _draw_modes(found: Any) -> Any:
    """Return the figure of maps of modes; matplotlib is loaded only for it."""
    from seisblock.present.figures.mode_map import figure

    return figure(found)


def _draw_sliding(found: Any) -> Any:
    """Return the figure of sliding spectra; matplotlib is loaded only for it."""
    from seisblock.present.figures.sliding_spectrum import figure

    return figure(found)
