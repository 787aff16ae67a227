"""From a document to stdout and files, as the output options ask."""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock.cli.output import STDOUT, Output, check_output
from seisblock.cli.progress import at_work, end, progress
from seisblock.cli.talk import answer, say, show, warn
from seisblock.errors import OutputError
from seisblock.present.documents.kind import Document
from seisblock.present.documents.write import to_json
from seisblock.present.faces import figure_of, film_of
from seisblock.results import Response
from seisblock.words import language, plain_text, speaking

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seisblock.present.films.animation import Filming


def emit(
    document: Document,
    output: Output,
    *,
    tables: Callable[[], Iterable[Any]],
    responses: Sequence[Response[Any]] = (),
    csv: Callable[[Path], None] | None = None,
    figure: Callable[[], Figure] | None = None,
    animation: Callable[[Path, Filming], None] | None = None,
) -> None:
    """Show an answer, or print its document, and write the files asked for.

    Parameters
    ----------
    document : Document
    output : Output
        The output options.
    tables : callable
        Returns what rich prints when no JSON is asked for.
    responses : sequence of Response
        Time histories for ``--csv``.
    csv : callable
        Writes the file of ``--csv`` where time histories are not what it holds.
    figure : callable
        Returns the matplotlib Figure of ``--plot``; left out, the responses' own.
    animation : callable
        Writes the file of ``--animate``; left out, the responses' own film, at the speed, in the language and with the progress it is told.
    """
    at_work("preparing the answer")
    if responses:
        figure = figure or (lambda: figure_of(responses, gal=output.gal))
        animation = animation or film_of(responses)
    for message in document.warnings:
        warn(message)
    if output.plot is not None and figure is None:
        raise OutputError("{command} has no figure here: leave --plot out", command=document.command)
    if output.animate is not None and animation is None:
        raise OutputError("{command} has no animation here: leave --animate out", command=document.command)
    check_output(output)
    if output.csv is not None:
        from seisblock.present.histories import write_histories

        write = csv or (lambda path: write_histories(path, responses))
        if output.csv == STDOUT:
            _to_stdout(write)
            return
        with progress("writing {file}", file=str(output.csv)):
            write(output.csv)
        say("wrote {file}", file=str(output.csv))
    if output.animate is not None and animation is not None:
        _animate(animation, output)
        say("wrote {path}", path=output.animate)
    if output.plot is not None and figure is not None:
        _draw(figure, output.plot, output)
        if output.plot == STDOUT:
            return
        say("wrote {path}", path=output.plot)
    # stdout comes last: a reader that goes away (| head) takes no file with it
    if output.json:
        answer(to_json(document))
    else:
        show(tables())


def _to_stdout(write: Callable[[Path], None]) -> None:
    """Write a table to stdout."""
    with tempfile.TemporaryDirectory(prefix="seisblock-") as directory:
        path = Path(directory) / "table.csv"
        write(path)
        end()
        with path.open(encoding="utf-8", newline="") as stream:
            if sys.stdout.isatty():  # which would obey what stands in names of stations and bodies
                sys.stdout.writelines(map(plain_text, stream))
            else:
                shutil.copyfileobj(stream, sys.stdout)


def _draw(figure: Callable[[], Figure], target: Path, output: Output) -> None:
    """Write a figure to a file, or its .png to stdout, of the size and under the title asked for."""
    from seisblock.present.figures.canvas import save, save_png
    from seisblock.present.figures.fonts import BOXES, MISSING, drawable, drawn, has_boxes
    from seisblock.present.figures.size import fitted

    if target == STDOUT and sys.stdout.isatty():
        raise OutputError("--plot - writes a .png to stdout, which is a terminal: send it to a file or a viewer, or give a file name")
    if drawable() != language():
        say(MISSING)
    with progress("drawing"):
        made = fitted(drawn(figure), size=output.size, dpi=output.dpi, title=output.title)
        if target != STDOUT:
            save(made, target)
    if has_boxes(made):
        say(BOXES)
    if target == STDOUT:
        end()
        save_png(made, sys.stdout.buffer)


def _animate(animation: Callable[[Path, Filming], None], output: Output) -> None:
    """Write an animation, with a bar while its pictures are drawn."""
    from seisblock.present.figures.fonts import MISSING, drawable
    from seisblock.present.films.animation import Filming

    assert output.animate is not None
    spoken = language()
    if output.animate.suffix.lower() != ".html" and spoken != drawable():
        say(MISSING)
        spoken = drawable()
    with progress("drawing") as advance, speaking(spoken):
        animation(output.animate, Filming(output.slow, advance, output.gal))
