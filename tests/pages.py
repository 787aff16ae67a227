"""What a page shows is what the program says: the lines of README.md and of docs/, run from top to bottom in an empty folder.

``console``  lines after ``$`` are commands of the program; what follows is what they print, at 80 columns, a line ``...`` any lines
``python``   lines after ``>>>`` and what they answer; names last to the end of the page
``sh``       shown only, for files that the reader has; commands and options have to exist

A figure that a line writes and the page shows from a folder ``figures/`` was drawn by that line.
``python -m tests.refresh_pages [PAGE]...`` writes down anew what lines print and draw.
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
SHOWN = re.compile(r"!\[[^\]]*\]\(([^)]*figures/[\w.]+\.png)\)")
ANYTHING = "..."
GRID, COLOURS = 48, 64
"""A figure is compared by the brightness of so many tiles by as many, and kept in so many colours."""

SAME_BRIGHTNESS = 0.02
"""Most that the tiles of a figure may differ in the mean, for it is drawn with other fonts elsewhere; in another language it is as much."""


@dataclass(frozen=True)
class Line:
    """A command of a page, and what the page says that it prints."""

    command: str
    shown: str


def lines_of(block: str) -> list[Line]:
    """Return the commands of a console block."""
    parts = (part.partition("\n") for part in re.split(r"^\$ ", block, flags=re.M)[1:])
    return [Line(command, trim_lines(output)) for command, _, output in parts]


def trim_lines(text: str) -> str:
    """Return a text without blanks at the ends of its lines, and without empty lines around it."""
    return "\n".join(line.rstrip() for line in text.splitlines()).strip("\n")


def run_command(command: str) -> str:
    """Return what a command prints; with ``> FILE`` it goes there."""
    words, _, into = command.partition(" > ")
    program, *arguments = shlex.split(words)
    assert program == "seisblock", command
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 0, (command, result.stderr)
    if into:
        Path(into).write_text(result.stdout, encoding="utf-8")
        return ""
    return trim_lines(result.stdout)


def matches(shown: str, said: str) -> bool:
    """Tell whether what a page shows is what a command says."""
    parts = [re.escape(line) if line != ANYTHING else "(?:.*\n)*?.*" for line in shown.split("\n")]
    return re.fullmatch("\n".join(parts), said) is not None


def run_session(block: str, names: dict[str, object]) -> list[tuple[doctest.Example, str]]:
    """Run a Python session; return its examples with what they answer, and keep their names."""
    said: list[tuple[doctest.Example, str]] = []
    for example in doctest.DocTestParser().get_examples(block):
        with contextlib.redirect_stdout(io.StringIO()) as told:
            exec(compile(example.source, "<page>", "single"), names)
        said.append((example, told.getvalue()))
    return said


def page_differences(page: Path) -> list[str]:
    """Run a page in the folder in which one stands; return where it says other than the program."""
    found: list[str] = []
    names: dict[str, object] = {}
    for language, block in FENCED.findall(page.read_text(encoding="utf-8")):
        if language == "console":
            found += [f"$ {line.command}\n{said}" for line in lines_of(block) if not matches(line.shown, said := run_command(line.command))]
        if language == "python":
            found += [f">>> {each.source}{said}" for each, said in run_session(block, names) if said != each.want]
    return found


def figures_of(page: Path) -> list[Path]:
    """Return the figures that a page shows."""
    return [page.parent / link for link in SHOWN.findall(page.read_text(encoding="utf-8"))]


def tiles(figure: Path) -> np.ndarray:
    """Return the brightness of a figure's tiles, 0 black to 1 white."""
    with Image.open(figure) as image:
        return np.asarray(image.convert("L").resize((GRID, GRID), Image.Resampling.BOX), dtype=float) / 255.0


def changed_figures(page: Path, folder: Path) -> list[str]:
    """Return the figures of a page that no line has drawn in a folder, or that look otherwise there."""
    pairs = [(figure, folder / figure.name) for figure in figures_of(page) if figure.parent.parent == page.parent]
    return [figure.name for figure, made in pairs if not made.exists() or np.abs(tiles(figure) - tiles(made)).mean() > SAME_BRIGHTNESS]


def save_figure(made: Path, kept: Path) -> None:
    """Keep a figure that a line has drawn, in few colours."""
    kept.parent.mkdir(exist_ok=True)
    with Image.open(made) as image:
        image.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(kept, optimize=True)
