"""Output options and their check before the computation."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from seisblock.core.errors import OutputError
from seisblock.core.units import FigureSize
from seisblock.output.io.atomic import check_animation, check_distinct_outputs, check_figure
from seisblock.output.io.suffix import check_text_suffix

STDOUT = Path("-")
"""Path that stands for stdout."""

DPI, SLOW = 200, 1.0
"""Default resolution of a figure, 1/inch, and default slow-motion factor of an animation."""


@dataclass(frozen=True)
class OutputOptions:
    """Values of the output options, checked before the command runs."""

    json: bool
    csv: Path | None
    plot: Path | None
    size: FigureSize | None
    dpi: int
    title: str | None
    quiet: bool
    gal: bool = True
    animate: Path | None = None
    slow: float = SLOW
    details: bool = False
    excel: bool = False

    def __post_init__(self) -> None:
        check_output(self)


def check_output(output: OutputOptions) -> None:
    """Raise an error for outputs that cannot be written.

    Raises
    ------
    OutputError
        If a file name has no known suffix, its folder does not exist, two outputs share a name, or an option lacks its figure or
        animation.
    """
    if output.plot is None and (output.size is not None or output.title is not None or output.dpi != DPI):
        raise OutputError("--size, --dpi and --title require --plot")
    if output.csv is None and output.excel:
        raise OutputError("--excel requires --csv")
    if output.animate is None and output.slow != SLOW:
        raise OutputError("--slow requires --animate")
    if output.plot is not None and output.plot != STDOUT:
        check_figure(output.plot)
    if output.animate is not None:
        check_animation(output.animate)
    _check_stdout(output)
    check_distinct_outputs(*(None if path == STDOUT else path for path in (output.csv, output.animate, output.plot)))
    if output.csv is not None and output.csv != STDOUT:
        check_text_suffix(output.csv, "CSV")


def _check_stdout(output: OutputOptions) -> None:
    """Raise an error for two outputs on stdout."""
    if STDOUT not in (output.csv, output.plot):
        return
    destinations = {"--csv": output.csv, "--plot": output.plot, "--json": output.json or None, "--animate": output.animate}
    requested = [name for name, value in destinations.items() if value is not None]
    first = "--csv" if output.csv == STDOUT else "--plot"
    conflicting = [name for name in requested if name != first and (first == "--csv" or destinations[name] in (STDOUT, True))]
    if conflicting:
        raise OutputError("{first} - writes to stdout, which takes one output: omit {others}", first=first, others=conflicting)
