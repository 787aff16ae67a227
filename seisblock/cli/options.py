"""Options shared by all commands: records, output and gravity."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from seisblock.cli import shell_completion
from seisblock.cli.command import Decorator, add_options, argument, option
from seisblock.cli.console import warning
from seisblock.cli.output import DPI, SLOW, OutputOptions
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import JMA, PEAK_UNITS, SIZE, STOREY, WINDOW, FormatType
from seisblock.cli.verbosity import quiet_output
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.records.floor import Storey

if TYPE_CHECKING:
    from seisblock.readers.options import ReadOptions

Function = Callable[..., Any]


@dataclass(frozen=True)
class Source:
    """Record and its preparation, from the record options."""

    record: tuple[str, ...]
    component: tuple[str, ...]
    scale: float | None
    target_pga: float | None
    target_jma: float | None
    window: tuple[tuple[float | None, float | None], ...]
    highpass: float | None
    floor: Storey | None
    demean: bool | None
    format: str | None
    units: str | None
    dt: float | None
    station: str | None
    level: str | None
    strict: bool
    location: str | None = None
    inventory: str | None = None
    event: str | None = None
    differentiate: bool = False
    response: str = "sensitivity"

    def read_options(self, *, single_station: bool = False) -> ReadOptions:
        """Return the options of reading; with `single_station`, the station name ``all`` selects none."""
        from seisblock.readers.options import ReadOptions

        values = {field.name: getattr(self, field.name) for field in fields(ReadOptions) if hasattr(self, field.name)}
        if single_station and self.station == "all":
            values["station"] = None
        return ReadOptions(**values)


def check_callback(check: Callable[[str, float], float]) -> Callable[[click.Context, click.Parameter, float | None], float | None]:
    """Return a click callback for a check of :mod:`seisblock.core.checks`."""

    def refuse(ctx: click.Context, param: click.Parameter, value: float | None) -> float | None:
        try:
            return None if value is None else check(N_("the value"), value)
        except ParameterError as error:
            raise click.BadParameter(gettext(error.message), ctx, param) from None

    return refuse


_positive, _nonzero = check_callback(checks.positive), check_callback(checks.nonzero)

LEAST_PGA_GAL = 3.0
"""PGA below which a warning asks for the unit, gal: no object moves, and the number was probably meant in g or m/s^2."""


def _peak(ctx: click.Context, param: click.Parameter, value: float | None) -> float | None:
    """Return a positive peak or frequency; warn of a PGA that is probably not in gal."""
    value = _positive(ctx, param, value)
    if value is not None and param.metavar == "GAL" and value < LEAST_PGA_GAL:
        warning("{flag}: {value:.4g} gal moves no object: check the unit (400gal, 4m/s2 or 0.4g)", flag=param.opts[0], value=value)
    return value


def _split_components(ctx: click.Context, param: click.Parameter, value: tuple[str, ...]) -> tuple[str, ...]:
    """Split repeated and comma-separated components; raise an error for an empty list."""
    names = [[part.strip() for part in text.split(",") if part.strip()] for text in value]
    if not all(names):
        raise click.BadParameter(gettext("the list is empty: name a component, or degrees clockwise from north"), ctx, param)
    return tuple(name for group in names for name in group)


_RECORD_OPTIONS = (
    option(
        "--component",
        multiple=True,
        callback=_split_components,
        shell_complete=shell_completion.complete_components,
        metavar="NS|EW|UD|all|DEGREES",
        section="Record",
        help="Component, or azimuth in degrees clockwise from north; may be repeated. [default: all that apply]",
    ),
    option("--scale", type=float, callback=_nonzero, section="Record", help="Scale factor on all components. [default: 1]"),
    option(
        "--target-pga",
        type=PEAK_UNITS["GAL"],
        callback=_peak,
        metavar="GAL",
        section="Record",
        help="Largest PGA of the components under analysis after scaling, gal; taken over the whole record, before --floor and --window.",
    ),
    option(
        "--target-jma",
        type=JMA,
        metavar="5-|5+|6-|6+|7|NUMBER",
        section="Record",
        help="JMA intensity after scaling, of the whole record with three components, before --floor and --window: a number, or the "
        "middle of a half class (6+ is 6.25; 5弱 and 6強 are understood).",
    ),
    option(
        "--window",
        type=WINDOW,
        multiple=True,
        section="Record",
        help="Time window, s from the first sample of the record; either end may be omitted.",
    ),
    option(
        "--highpass",
        type=float,
        callback=_positive,
        metavar="HZ",
        section="Record",
        help="Corner of a zero-phase high-pass (4th-order Butterworth), Hz; after --demean, before --scale. [default: none]",
    ),
    option(
        "--floor",
        type=STOREY,
        metavar="T=S[,zeta=0.05][,height=0.8]",
        section="Record",
        help="Floor motion: oscillator of period T, s, and damping ratio zeta, at this share of the building height (first mode, "
        "1 roof). After --scale, before --window; not the vertical component. [default: ground motion]",
    ),
    option(
        "--demean/--no-demean",
        default=None,
        section="Record",
        help="Remove the mean of each component. [default: only for K-NET/KiK-net, whose counts carry an offset]",
    ),
    option("--format", type=FormatType(), section="Record", help="File format [default: recognised from the content]:"),
    option("--units", section="Record", metavar="gal|m/s2|g", help="Unit of the values, where the file states none."),
    option("--dt", type=float, callback=_positive, section="Record", metavar="S", help="Sampling interval, where the file states none, s."),
    option(
        "--station",
        section="Record",
        help="Station code in an archive of several, or location in a structure; all: each station separately.",
    ),
    option(
        "--level", type=SuggestingChoice(["surface", "borehole"]), section="Record", help="Sensor of a KiK-net station. [default: surface]"
    ),
    option(
        "--location",
        section="Record",
        metavar="CODE",
        help="Sensor of a station with several: SEED location code, -- for the empty one, or with the channel letters, 00.HN.",
    ),
    option(
        "--inventory",
        section="Record",
        metavar="FILE",
        help="StationXML with the instrument response of counts. [default: a StationXML beside the record or in its archive]",
    ),
    option(
        "--response",
        type=SuggestingChoice(["sensitivity", "full"]),
        default="sensitivity",
        show_default=True,
        section="Record",
        help="Divide counts by the sensitivity, or remove the full response.",
    ),
    option(
        "--differentiate", is_flag=True, section="Record", help="Differentiate velocities of a seismometer, which are rejected otherwise."
    ),
    option("--event", section="Record", metavar="FILE", help="Earthquake of the record: QuakeML, or JSON. [default: from the record]"),
    option("--strict", is_flag=True, section="Record", help="Reject records with quality warnings instead of printing the warnings."),
)

_JSON = option("--json", is_flag=True, section="Output", help="Print one JSON document on stdout, SI units.")


def _csv_option(text: str) -> Any:
    """Return ``--csv`` with its help text."""
    return option("--csv", type=click.Path(path_type=Path, allow_dash=True), section="Output", metavar="FILE", help=text)


_CSV_HISTORIES = _csv_option("Write the time histories as CSV, SI units; - writes them alone to stdout.")
_CSV_ROWS = _csv_option("Write the table as CSV, SI units; - writes it alone to stdout.")

excel_option = option(
    "--excel", "--bom", "excel", is_flag=True, section="Output", help="Begin the CSV with a byte order mark, so that Excel reads UTF-8."
)
"""Option ``--excel`` of commands that write CSV."""

_FIGURE_OPTIONS = (
    option(
        "--plot",
        type=click.Path(path_type=Path, allow_dash=True),
        section="Output",
        metavar="FILE",
        help="Write the figure: .png, .svg or .pdf; - writes a .png alone to stdout.",
    ),
    option(
        "--size",
        type=SIZE,
        metavar="WxH",
        section="Output",
        help="Width and height of the figure, 18x12, cm; or with units, 85x120mm. [default: from the content]",
    ),
    option("--dpi", type=click.IntRange(30, 1200), default=DPI, show_default=True, section="Output", help="Resolution of a .png, 1/inch."),
    option("--title", section="Output", metavar="TEXT", help="Title of the figure; empty for none. [default: station, time, processing]"),
)

_ANIMATION_OPTIONS = (
    option(
        "--animate", type=click.Path(path_type=Path), section="Output", metavar="FILE", help="Write the animation: .gif, .mp4 or .html."
    ),
    option(
        "--slow",
        type=float,
        default=SLOW,
        callback=_positive,
        metavar="FACTOR",
        section="Output",
        help="Slow-motion factor of the animation, a ratio to real time. [default: 1]",
    ),
)

_GAL = option(
    "--gal/--si",
    "gal",
    default=True,
    section="Output",
    help="Units of tables, figures and animations: gal, kine and cm, or m/s², m/s and m. [default: gal]",
)

_DETAILS = option("--details", is_flag=True, section="Output", help="Print the whole result: all tables and columns.")

_QUIET = option("--quiet", is_flag=True, section="Output", help="Print only errors and one line of quality warnings on stderr.")


def _record_options(default: str) -> Callable[[Function], Function]:
    """Return a decorator that adds RECORD, with its default, and the record options to a command."""
    help_text = lazy_gettext(
        "Files, names of bundled samples, or analytic motions (sine:300gal@1.5Hz,10s); - is stdin. [default: {default}]",
        default=lazy_gettext(default),
    )
    complete = shell_completion.complete_bundled("record", from_first_letter=True)
    record = argument("record", nargs=-1, metavar="[RECORD]...", section="Record", shell_complete=complete, help=help_text)
    return lambda function: _collect_options(function, (record, *_RECORD_OPTIONS), Source, "source")


record_options = _record_options(N_("synthetic_jma.csv, bundled"))
"""RECORD and the options of its selection and preparation, as one ``source``."""

curve_record_options = _record_options(N_("none, curve of the rate"))
"""Record options of ``overturn-rate``, which gives a curve without a record."""

displaced_record_options = _record_options(N_("synthetic_jma.csv, bundled, with --slid or --jumped; else none"))
"""Record options of ``infer``, which has a default record for displaced objects only."""

harmonic_record_options = _record_options(N_("synthetic_jma.csv, bundled; none with --harmonic"))
"""Record options of ``uplift``, which has no record under harmonic motion."""

criterion_record_options = _record_options(N_("synthetic_jma.csv, bundled; none with --criterion"))
"""Record options of ``stack``, which has no default record in a criterion study."""

real_record_options = _record_options(N_("hanmer_springs_2016, bundled"))
"""Record options with a recorded motion as default."""

suite_record_options = _record_options(N_("records of --suite"))
"""Record options with a synthetic suite as default."""

item_record_options = _record_options(N_("data of the paper"))
"""Record options of ``paper``, whose items have data of their own."""

scenario_record_options = _record_options(N_("suite scaled to the scenario"))
"""Record options of a scenario, whose default records are a suite scaled to its intensity."""


def preparation_options(function: Function) -> Function:
    """Add only the preparation options to a command, as one ``source`` without record."""
    return _collect_options(function, _RECORD_OPTIONS, Source, "source", record=())


def peak_option(flag: str, metavar: str, text: str) -> Decorator:
    """Return the option of a positive peak, or frequency, of the motion, with the given help text."""
    return option(flag, type=PEAK_UNITS[metavar], callback=_peak, metavar=metavar, section="Record", help=text)


peak_options = add_options(
    peak_option("--pga", "GAL", "Instead of RECORD, with --pgv or --frequency: PGA, gal."),
    peak_option("--pgv", "KINE", "Instead of RECORD, with --pga: PGV, kine."),
    peak_option("--frequency", "HZ", "Instead of RECORD, with --pga: equivalent frequency PGA/(2 pi PGV), Hz."),
)
"""Options of the peaks of a motion that stand in place of a record."""


def output_options(
    *, histories: bool = True, film: bool = True, accelerations: bool = True, excel: bool = True
) -> Callable[[Function], Function]:
    """Return a decorator that adds the output options to a command, as one ``output``.

    Parameters
    ----------
    histories : bool
        Whether ``--csv`` holds time histories; else it holds the numbers of the table.
    film : bool
        Whether there is an animation.
    accelerations : bool
        Whether ``--units`` of accelerations applies.
    excel : bool
        Whether the byte order mark of CSV is on request; else the command always writes it.
    """
    texts = (
        _CSV_HISTORIES if histories else _CSV_ROWS,
        *((excel_option,) if excel else ()),
        *_FIGURE_OPTIONS,
        *(_ANIMATION_OPTIONS if film else ()),
    )
    declarations = (_JSON, *texts, *((_GAL,) if accelerations else ()), _DETAILS, _QUIET)
    return lambda function: _collect_options(function, declarations, OutputOptions, "output")


def _collect_options(function: Function, declarations: tuple[Any, ...], kind: Any, name: str, **constants: Any) -> Function:
    """Collect a family of options and fixed values into one argument."""
    names = [field.name for field in fields(kind)]

    @functools.wraps(function)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        collected = kind(**{key: kwargs.pop(key) for key in names if key in kwargs}, **constants)
        with quiet_output(getattr(collected, "quiet", None)):
            return function(*args, **{name: collected}, **kwargs)

    return add_options(*declarations)(wrapper)
