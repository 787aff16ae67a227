"""Where an answer goes, and whether it can: looked at before anything is computed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from seisblock.core.errors import OutputError
from seisblock.core.units import FigureSize
from seisblock.report.io.atomic import check_animation, check_distinct_outputs, check_figure
from seisblock.report.io.suffix import check_text_suffix

STDOUT = Path("-")
"""The name that stands for stdout."""

DPI, SLOW = 200, 1.0
"""Dots per inch of a figure, and how many times slower than it was a film runs, of which nothing else is said."""


@dataclass(frozen=True)
class Output:
    """Where the answer goes, and in which form."""

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


def check_output(output: Output) -> None:
    """Refuse what cannot be written: before anything is read, and again when it is known what was read.

    Raises
    ------
    OutputError
        If a name does not say a format, leads nowhere, or stands for two outputs, or if an option has no figure or film to change.
    """
    if output.plot is None and (output.size is not None or output.title is not None or output.dpi != DPI):
        raise OutputError("--size, --dpi and --title require --plot")
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


def _check_stdout(output: Output) -> None:
    """Refuse two things that both go to stdout, and a name beside ``-`` that would be left unwritten."""
    if STDOUT not in (output.csv, output.plot):
        return
    destinations = {"--csv": output.csv, "--plot": output.plot, "--json": output.json or None, "--animate": output.animate}
    requested = [name for name, value in destinations.items() if value is not None]
    first = "--csv" if output.csv == STDOUT else "--plot"
    conflicting = [name for name in requested if name != first and (first == "--csv" or destinations[name] in (STDOUT, True))]
    if conflicting:
        raise OutputError("{first} - writes to stdout, which takes one output: omit {others}", first=first, others=conflicting)
