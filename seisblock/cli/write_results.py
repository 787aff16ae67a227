"""Output of a document to stdout and files."""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock.cli.console import info, print_result, print_tables, warning
from seisblock.cli.output import STDOUT, OutputOptions, check_output
from seisblock.cli.progress import close_line, progress, set_task
from seisblock.core.errors import OutputError
from seisblock.core.i18n import escape_control, get_locale, use_locale
from seisblock.core.results import Response
from seisblock.report.json.encode import to_json
from seisblock.report.json.schema import Document
from seisblock.report.registry import animation_writer, response_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.report.animation.render import AnimationOptions


def write_results(
    document: Document,
    output: OutputOptions,
    *,
    tables: Callable[[], Iterable[Any]],
    responses: Sequence[Response[Any]] = (),
    csv: Callable[[Path], None] | None = None,
    figure: Callable[[], Figure] | None = None,
    animation: Callable[[Path, AnimationOptions], None] | None = None,
) -> None:
    """Print the results as tables or JSON and write the requested files.

    Parameters
    ----------
    document : Document
    output : OutputOptions
        The output options.
    tables : callable
        Returns the rich tables printed without ``--json``.
    responses : sequence of Response
        Time histories for ``--csv``.
    csv : callable
        Writes the file of ``--csv`` if it does not hold time histories.
    figure : callable
        Returns the matplotlib Figure of ``--plot``, default that of the responses.
    animation : callable
        Writes the file of ``--animate``, default the animation of the responses.
    """
    set_task("preparing the results")
    if responses:
        figure = figure or (lambda: response_figure(responses, gal=output.gal))
        animation = animation or animation_writer(responses)
    for message in document.warnings:
        warning(message)
    if output.plot is not None and figure is None:
        raise OutputError("{command} has no figure here: omit --plot", command=document.command)
    if output.animate is not None and animation is None:
        raise OutputError("{command} has no animation here: omit --animate", command=document.command)
    check_output(output)
    if output.csv is not None:
        from seisblock.report.io.history_csv import write_histories

        write = csv or (lambda path: write_histories(path, responses))
        if output.csv == STDOUT:
            _to_stdout(write)
            return
        with progress("writing {file}", file=str(output.csv)):
            write(output.csv)
        info("wrote {file}", file=str(output.csv))
    if output.animate is not None and animation is not None:
        _write_animation(animation, output)
        info("wrote {path}", path=output.animate)
    if output.plot is not None and figure is not None:
        _write_figure(figure, output.plot, output)
        if output.plot == STDOUT:
            return
        info("wrote {path}", path=output.plot)
    # stdout last: a closed pipe (| head) must not prevent the files
    if output.json:
        print_result(to_json(document))
    else:
        print_tables(tables(), details=output.details)


def _to_stdout(write: Callable[[Path], None]) -> None:
    with tempfile.TemporaryDirectory(prefix="seisblock-") as directory:
        path = Path(directory) / "table.csv"
        write(path)
        close_line()
        with path.open(encoding="utf-8", newline="") as stream:
            if sys.stdout.isatty():  # names may contain terminal control sequences
                sys.stdout.writelines(map(escape_control, stream))
            else:
                shutil.copyfileobj(stream, sys.stdout)


def _write_figure(figure: Callable[[], Figure], target: Path, output: OutputOptions) -> None:
    """Write the figure to a file, or as .png to stdout."""
    from seisblock.report.figures.fit_size import fit_figure_size
    from seisblock.report.figures.fonts import MISSING_GLYPHS, NO_FONT, build_localized, drawable_locale, has_missing_glyphs
    from seisblock.report.figures.style import save, save_png

    if target == STDOUT and sys.stdout.isatty():
        raise OutputError("--plot - writes a .png to stdout, which is a terminal: redirect it, or give a file name")
    if drawable_locale() != get_locale():
        info(NO_FONT)
    with progress("drawing"):
        fig = fit_figure_size(build_localized(figure), size=output.size, dpi=output.dpi, title=output.title)
        if target != STDOUT:
            save(fig, target)
    if has_missing_glyphs(fig):
        info(MISSING_GLYPHS)
    if target == STDOUT:
        close_line()
        save_png(fig, sys.stdout.buffer)


def _write_animation(animation: Callable[[Path, AnimationOptions], None], output: OutputOptions) -> None:
    from seisblock.report.animation.render import AnimationOptions
    from seisblock.report.figures.fonts import NO_FONT, drawable_locale

    assert output.animate is not None
    locale = get_locale()
    if output.animate.suffix.lower() != ".html" and locale != drawable_locale():
        info(NO_FONT)
        locale = drawable_locale()
    with progress("drawing") as advance, use_locale(locale):
        animation(output.animate, AnimationOptions(output.slow, advance, output.gal))
