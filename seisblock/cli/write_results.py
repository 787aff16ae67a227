"""Output of a document to stdout and files."""

from __future__ import annotations

import pkgutil
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock.cli.console import info, print_default_record, print_result, print_tables, warning
from seisblock.cli.output import STDOUT, OutputOptions, check_output
from seisblock.cli.progress import close_line, progress, set_task
from seisblock.core.errors import OutputError
from seisblock.core.i18n import escape_control, format_share, get_locale, gettext, use_locale
from seisblock.core.registry import get_solver
from seisblock.core.results import Response
from seisblock.output.json.encode import to_json
from seisblock.output.json.schema import Document

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.output.animation.render import AnimationOptions
    from seisblock.output.io.history_csv import CsvTable


AT_REST = ("rest", "stick")
"""Phases without motion relative to the ground."""


def figure_of(reference: str, *args: Any, **keywords: Any) -> Callable[[], Figure]:
    """Return a function that draws a figure, ``module:name`` in :mod:`seisblock.report.figures`, which is imported then."""

    def draw() -> Figure:
        return pkgutil.resolve_name(f"seisblock.report.figures.{reference}")(*args, **keywords)  # type: ignore[no-any-return]

    return draw


def write_results(
    document: Document,
    output: OutputOptions,
    *,
    tables: Callable[[], Iterable[Any]],
    responses: Sequence[Response[Any]] = (),
    csv: Callable[[], CsvTable] | None = None,
    bom: bool = False,
    figure: Callable[[], Figure] | None = None,
    probability: float | None = None,
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
        Returns the table of ``--csv`` if it does not hold time histories.
    bom : bool
        Whether that table begins with a byte order mark without ``--excel``, too.
    figure : callable
        Returns the matplotlib Figure of ``--plot``, default that of the responses.
    probability : float or None
        Overturning probability of the first response, for the title of the animation.
    """
    set_task("preparing the results")
    solver = get_solver(responses[0].model) if responses else None
    if responses:
        figure = figure or (lambda: _response_figure(responses, gal=output.gal))
    for message in document.warnings:
        warning(message)
    if output.plot is not None and figure is None:
        raise OutputError("{command} has no figure here: omit --plot", command=document.command)
    if output.animate is not None and (solver is None or solver.animate is None):
        raise OutputError("{command} has no animation here: omit --animate", command=document.command)
    check_output(output)
    if STDOUT in (output.csv, output.plot):
        print_default_record(err=True)
    if output.csv is not None:
        from seisblock.output.io.atomic import write_table
        from seisblock.output.io.history_csv import history_table

        if csv is None and not responses:
            raise OutputError("cannot write {path}: no time history available", path=output.csv)
        table = history_table(responses) if csv is None else csv()
        if output.csv == STDOUT:
            _to_stdout(partial(write_table, header=table[0], rows=table[1], bom=bom or output.excel))
            return
        with progress("writing {file}", file=str(output.csv)):
            write_table(output.csv, *table, bom=bom or output.excel)
        info("wrote {file}", file=str(output.csv))
    if output.animate is not None and solver is not None:
        phases = responses[0].phases
        # a model without phases tells by its outcome
        if (phases and all(phase.name in AT_REST for phase in phases)) or not getattr(responses[0].outcome, "moved", True):
            warning("the object remains at rest: no animation written")
        else:
            _write_animation(partial(solver.presenter("animate"), responses[0]), output, probability)
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


def write_page(path: Path, page: Callable[[], str]) -> None:
    """Draw an HTML page and write it to a file."""
    from seisblock.output.io.atomic import write_text

    with progress("drawing"):
        text = page()
    write_text(path, text)
    info("wrote {path}", path=path)


def _response_figure(responses: Sequence[Response[Any]], *, gal: bool) -> Figure:
    from seisblock.output.figures.solver import response_figure

    return response_figure(responses, gal=gal)


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
    from seisblock.output.figures.fit_size import fit_figure_size
    from seisblock.output.figures.fonts import MISSING_GLYPHS, NO_FONT, build_localized, drawable_locale, has_missing_glyphs
    from seisblock.output.figures.style import save, save_png

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


def _write_animation(animation: Callable[[Path, AnimationOptions], None], output: OutputOptions, probability: float | None) -> None:
    from seisblock.output.animation.render import AnimationOptions
    from seisblock.output.figures.fonts import NO_FONT, drawable_locale

    assert output.animate is not None
    locale = get_locale()
    if output.animate.suffix.lower() != ".html" and locale != drawable_locale():
        info(NO_FONT)
        locale = drawable_locale()
    with progress("drawing") as advance, use_locale(locale):
        text = "" if probability is None else gettext("overturning probability {share}", share=format_share(probability))
        animation(output.animate, AnimationOptions(output.slow, advance, output.gal, text))
