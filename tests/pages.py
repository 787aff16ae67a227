"""Code blocks of README.md and of docs/, executed from top to bottom in an empty folder and compared with the shown output.

``console``  lines after ``$`` are commands of the program, followed by their output at 80 columns; a line ``...`` matches any lines
``python``   a doctest session; names last to the end of the page
``sh``       not executed, as the files are the reader's; commands and options have to exist

A figure that a page shows from a folder ``figures/`` is drawn by a line of that page.
``python -m tests.refresh_pages [PAGE]...`` updates outputs and figures.
"""

import contextlib
import doctest
import io
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from click.testing import CliRunner
from PIL import Image

from seisblock.cli import main

ROOT = Path(__file__).parents[1]
PAGES = {path.relative_to(ROOT).as_posix(): path for path in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))}
FENCED = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)
FIGURE_LINK = re.compile(r"!\[[^\]]*\]\(([^)]*figures/[\w.]+\.png)\)")
ANYTHING = "..."
GRID, COLOURS = 48, 64
"""Tiles along each side for the comparison of figures by brightness, and number of colours of a stored figure."""

SAME_BRIGHTNESS = 0.02
"""Largest mean difference of the tiles of a figure: fonts differ between machines; another language differs as much."""


@dataclass(frozen=True)
class Line:
    """Command of a page and its shown output."""

    command: str
    output: str


def lines_of(block: str) -> list[Line]:
    """Return the commands of a console block."""
    parts = (part.partition("\n") for part in re.split(r"^\$ ", block, flags=re.M)[1:])
    return [Line(command, trim_lines(output)) for command, _, output in parts]


def trim_lines(text: str) -> str:
    """Return a text without blanks at the ends of its lines, and without empty lines around it."""
    return "\n".join(line.rstrip() for line in text.splitlines()).strip("\n")


def run_command(command: str) -> str:
    """Return the output of a command; empty with ``> FILE``, which is written."""
    words, _, into = command.partition(" > ")
    program, *arguments = shlex.split(words)
    assert program == "seisblock", command
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 0, (command, result.stderr)
    if into:
        Path(into).write_text(result.stdout, encoding="utf-8")
        return ""
    return trim_lines(result.stdout)


def matches(pattern: str, output: str) -> bool:
    """Return whether the output shown by a page, with ``...`` for any lines, is that of the command."""
    parts = [re.escape(line) if line != ANYTHING else "(?:.*\n)*?.*" for line in pattern.split("\n")]
    return re.fullmatch("\n".join(parts), output) is not None


def run_session(block: str, names: dict[str, object]) -> list[tuple[doctest.Example, str]]:
    """Run a Python session in a namespace; return its examples with their outputs."""
    outputs: list[tuple[doctest.Example, str]] = []
    for example in doctest.DocTestParser().get_examples(block):
        with contextlib.redirect_stdout(io.StringIO()) as stream:
            exec(compile(example.source, "<page>", "single"), names)
        outputs.append((example, stream.getvalue()))
    return outputs


def page_differences(page: Path) -> list[str]:
    """Run a page in the current folder; return the commands whose output differs from the shown one."""
    differences: list[str] = []
    names: dict[str, object] = {}
    for language, block in FENCED.findall(page.read_text(encoding="utf-8")):
        if language == "console":
            pairs = [(line, run_command(line.command)) for line in lines_of(block)]
            differences += [f"$ {line.command}\n{output}" for line, output in pairs if not matches(line.output, output)]
        if language == "python":
            differences += [f">>> {example.source}{output}" for example, output in run_session(block, names) if output != example.want]
    return differences


def figures_of(page: Path) -> list[Path]:
    """Return the figures that a page shows."""
    return [page.parent / link for link in FIGURE_LINK.findall(page.read_text(encoding="utf-8"))]


def tiles(figure: Path) -> np.ndarray:
    """Return the brightness of a figure's tiles, 0 black to 1 white."""
    with Image.open(figure) as image:
        return np.asarray(image.convert("L").resize((GRID, GRID), Image.Resampling.BOX), dtype=float) / 255.0


def changed_figures(page: Path, folder: Path) -> list[str]:
    """Return the figures of a page that are missing in a folder of new figures, or differ from them."""
    pairs = [(figure, folder / figure.name) for figure in figures_of(page) if figure.parent.parent == page.parent]
    return [figure.name for figure, new in pairs if not new.exists() or np.abs(tiles(figure) - tiles(new)).mean() > SAME_BRIGHTNESS]


def save_figure(source: Path, target: Path) -> None:
    """Copy a figure with a reduced number of colours."""
    target.parent.mkdir(exist_ok=True)
    with Image.open(source) as image:
        image.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(target, optimize=True)
