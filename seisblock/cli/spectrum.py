"""``seisblock spectrum``: response of blocks of all sizes, slendernesses and frictions to one record."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.cli.azimuth_sweep import is_azimuth_sweep
from seisblock.cli.bodies.options import azimuth_option, inset_option
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.option_checks import given_flags
from seisblock.cli.options import Source, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.rock import require_vertical, with_azimuths
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import FLOATS, LENGTHS, MUS, Count
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import MAX_CELLS
from seisblock.models.rock.options import RockOptions
from seisblock.records.motion import ALL_AZIMUTHS

if TYPE_CHECKING:
    from seisblock.records import Motion
    from seisblock.studies.rocking.spectrum import RockingSpectrum

KINDS = ("rocking", "overturning", "sliding", "modes")
AZIMUTH_KINDS = KINDS[:2]
"""Kinds that accept ``--component all-azimuths``."""

EXCLUSIVE_OPTIONS = ("sizes", "frequency_parameter"), ("height_over_width", "slenderness_rad")
"""Pairs of options of which one may be given."""

_ROCKING_OPTIONS = ("sizes", "frequency_parameter", "height_over_width", "slenderness_rad", "inset", "restitution", "linear")
OPTIONS_WITHOUT_EFFECT = {"rocking": ("mu",), "overturning": ("mu",), "sliding": _ROCKING_OPTIONS, "modes": ("linear",)}
"""Options that a kind of spectrum does not use."""

MIN_SPAN, MAX_SPAN = 0.2, 1.5
"""Smallest and largest default range of friction and b/h."""


@click.command(
    cls=Command,
    essential=("--kind", "--mu", "--sizes", "--height-over-width", "--inset", "--vertical"),
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
    type=SuggestingChoice(KINDS),
    default="rocking",
    show_default=True,
    help="rocking: peak tilt over alpha; overturning: yes or no; sliding: maximum slip; modes: governing mode of motion.",
)
@option(
    "--mu",
    type=MUS,
    section="Body",
    metavar="LIST|RANGE",
    help="Friction coefficients, for --kind sliding and modes. [default: 0.02 to 0.8; modes: range in which the record moves the block]",
)
@option(
    "--sizes",
    type=LENGTHS,
    section="Body",
    metavar="LIST|RANGE",
    help="Diagonals 2R, m or with units. [default: 0.2 to 8, geometric; for modes 1]",
)
@option(
    "--frequency-parameter",
    type=FLOATS,
    section="Body",
    metavar="LIST|RANGE",
    help="Frequency parameter p = sqrt(3g/4R), rad/s, instead of --sizes.",
)
@option(
    "--height-over-width",
    type=FLOATS,
    section="Body",
    metavar="LIST|RANGE",
    help="Ratios H/B of the blocks. [default: 1.5 to 10; modes: range in which the record moves the block]",
)
@option(
    "--slenderness-rad",
    type=FLOATS,
    section="Body",
    metavar="LIST|RANGE",
    help="Slenderness alpha = atan(B/H), rad, instead of --height-over-width.",
)
@inset_option("Inset of worn edges from each side of the blocks: share of the width (0.1, 10%), or m with a unit (1cm). [default: 0]")
@option(
    "--steps",
    type=Count(N_("cells"), MAX_CELLS, minimum=2, power=2),
    default=40,
    show_default=True,
    help="Number of points on each axis left at its default.",
)
@solver_options(RockOptions, "restitution", "linear", "vertical")
@azimuth_option
@solver_options(RockOptions, "gravity")
@output_options(histories=False, film=False, accelerations=False)
def spectrum(
    source: Source,
    output: OutputOptions,
    gravity: float,
    kind: str,
    vertical: bool | None,
    azimuth: tuple[str, ...],
    **params: Any,
) -> None:
    """Rocking spectrum: peak tilt of rectangular blocks over alpha, against size and slenderness, for each component.

    Overturning is not monotone: the figure may show islands. With --component all-azimuths, tilts are those of the worst of 18
    azimuths; --kind overturning gives the number of azimuths in which each block overturns. --kind sliding: maximum slip against
    friction. --kind modes: response of a free-standing block as in respond, over friction and shape, or over friction and size for
    one shape; --restitution is Poisson's, default 0.
    """
    source = with_azimuths(source, azimuth)
    if is_azimuth_sweep(source) and kind not in AZIMUTH_KINDS:
        raise ParameterError("--component {name} requires --kind {kinds}", name=ALL_AZIMUTHS, kinds=list(AZIMUTH_KINDS))
    for pair in EXCLUSIVE_OPTIONS:
        if len(flags := given_flags(pair)) > 1:
            raise ParameterError("{name} and {other} exclude each other: give only one of them", name=flags[0], other=flags[1])
    for flag in given_flags(OPTIONS_WITHOUT_EFFECT[kind])[:1]:
        raise ParameterError("--{name} has no effect with --kind {kind}: omit it", name=flag.removeprefix("--"), kind=kind)
    if kind == "sliding":
        _run_sliding(source, output, gravity, params["mu"], vertical)
        return
    from seisblock.studies.rocking.spectrum import default_sizes, default_slendernesses, size_of, slenderness_of

    steps, inset = params["steps"], params["inset"] or SHARP_EDGES
    diagonals = params["sizes"] or (size_of(params["frequency_parameter"], gravity) if params["frequency_parameter"] else None)
    alphas = params["slenderness_rad"] or (slenderness_of(params["height_over_width"]) if params["height_over_width"] else None)
    if kind == "modes":
        _run_modes(source, output, gravity, (params["mu"], diagonals, alphas, steps), params["restitution"] or 0.0, inset, vertical)
        return
    from seisblock.cli.write_results import figure_of, write_results
    from seisblock.records._validation import vertical_acts
    from seisblock.report.json.spectrum import document
    from seisblock.report.text import spectrum as text_output

    diagonals = default_sizes(steps) if diagonals is None else diagonals
    alphas = default_slendernesses(steps) if alphas is None else alphas
    options = RockOptions(restitution=params["restitution"], linear=params["linear"], vertical=vertical, gravity=gravity)
    spectra = list(_spectra(source, diagonals, alphas, inset, options))
    applied_options = replace(options, vertical=vertical_acts((motion for motion, _ in spectra), vertical))
    write_results(
        document(spectra, kind, applied_options, inset),
        output,
        tables=lambda: text_output.tables(spectra, kind, _wear_note(inset)),
        csv=lambda: text_output.csv_columns(spectra),
        figure=figure_of("spectrum:figure", spectra, kind, gravity),
    )


def _spectra(source: Source, sizes: Any, alphas: Any, inset: EdgeWear, options: RockOptions) -> Iterator[tuple[Motion, RockingSpectrum]]:
    """Yield the spectrum of each selected motion; in a sweep, with the motion of the largest PGA."""
    from seisblock.cli.load_records import iter_motions, load_records
    from seisblock.cli.progress import progress
    from seisblock.records.motion import motion_toward
    from seisblock.studies.rocking.spectrum import rocking_spectrum, rocking_spectrum_all_azimuths

    if not is_azimuth_sweep(source):
        for motion in iter_motions(source):
            require_vertical(motion, options.vertical)
            with progress("spectrum {name}", name=motion.name) as advance:
                yield motion, rocking_spectrum(sizes, alphas, motion, inset=inset, progress=advance, options=options)
        return
    for record in load_records(replace(source, component=())):
        with progress("spectrum {name}", name=ALL_AZIMUTHS) as advance:
            spectrum = rocking_spectrum_all_azimuths(sizes, alphas, record, inset=inset, progress=advance, options=options)
        assert spectrum.azimuths_deg is not None
        strongest = max(
            (motion_toward(record, azimuth) for azimuth in spectrum.azimuths_deg),
            key=lambda candidate: abs(candidate.horizontal).max(),
        )
        yield replace(strongest, name=ALL_AZIMUTHS), spectrum


def _run_sliding(source: Source, output: OutputOptions, gravity: float, mu: tuple[float, ...] | None, vertical: bool | None) -> None:
    """Run ``--kind sliding``."""
    from seisblock.cli.load_records import iter_motions
    from seisblock.cli.progress import progress
    from seisblock.cli.write_results import figure_of, write_results
    from seisblock.records._validation import vertical_acts
    from seisblock.report.json.spectrum import sliding_document
    from seisblock.report.text import sliding_spectrum as text_output
    from seisblock.studies.sliding import slide_study

    frictions = mu or tuple(round(0.02 * i, 2) for i in range(1, 41))
    curves = []
    for motion in iter_motions(source):
        require_vertical(motion, vertical)
        with progress("sliding {name}", name=motion.name) as advance:
            curves.append((motion, slide_study(frictions, motion, vertical=vertical, gravity=gravity, progress=advance)))
    write_results(
        sliding_document(curves, gravity=gravity, vertical=vertical_acts((motion for motion, _ in curves), vertical)),
        output,
        tables=lambda: text_output.tables(curves),
        csv=lambda: text_output.csv_columns(curves),
        figure=figure_of("sliding_spectrum:figure", curves),
    )


def _run_modes(
    source: Source,
    output: OutputOptions,
    gravity: float,
    grid: tuple[Any, Any, Any, int],
    restitution: float,
    inset: EdgeWear,
    vertical: bool | None,
) -> None:
    """Run ``--kind modes``; `grid` holds frictions, diagonals and slendernesses (None: default) and steps."""
    from seisblock.cli.load_records import iter_motions
    from seisblock.cli.progress import progress
    from seisblock.cli.write_results import figure_of, write_results
    from seisblock.records._validation import vertical_acts
    from seisblock.report.json.spectrum import modes_document
    from seisblock.report.text import mode_map as text_output
    from seisblock.studies.respond.mode_map import mode_map

    all_motions = list(iter_motions(source))
    for motion in all_motions:
        require_vertical(motion, vertical)
    axes = _grid_axes(all_motions, grid, gravity, vertical=vertical)
    maps = []
    for motion in all_motions:
        with progress("modes {name}", name=motion.name) as advance:
            result = mode_map(*axes, motion, inset=inset, restitution=restitution, vertical=vertical, gravity=gravity, progress=advance)
            maps.append((motion, result))
    write_results(
        modes_document(maps, gravity=gravity, restitution=restitution, inset=inset, vertical=vertical_acts(all_motions, vertical)),
        output,
        tables=lambda: text_output.tables(maps, _wear_note(inset)),
        csv=lambda: text_output.csv_columns(maps),
        figure=figure_of("mode_map:figure", maps),
    )


def _grid_axes(
    all_motions: Sequence[Any], grid: tuple[Any, Any, Any, int], gravity: float, *, vertical: bool | None
) -> tuple[Any, Any, Any]:
    """Return frictions, diagonals and slendernesses; defaults cover the range that the motions can mobilise."""
    from seisblock.criteria.initiation import peak_loading_ratio

    mu, diagonals, alphas, steps = grid
    push = max(peak_loading_ratio(motion, vertical=vertical, gravity=gravity)[0] for motion in all_motions)
    span = min(max(math.ceil(12.5 * push) / 10.0, MIN_SPAN), MAX_SPAN) if push < MAX_SPAN else MAX_SPAN
    if mu is None:
        mu = [round(span * (i + 0.5) / steps, 12) for i in range(steps)]
    if alphas is None:
        if diagonals is not None and len(diagonals) > 1:
            raise ParameterError("--kind modes with several sizes requires one shape: give one --height-over-width or --slenderness-rad")
        alphas = [math.atan(round(span * (i + 1) / steps, 12)) for i in range(steps)]
    return mu, (1.0,) if diagonals is None else diagonals, alphas


def _wear_note(inset: EdgeWear) -> str:
    """Return a note on worn edges, empty for sharp edges."""
    if inset == SHARP_EDGES:
        return ""
    return lazy_gettext("; edges worn by {share:g} B + {length:g} m per side", share=inset.share, length=inset.length_m)
