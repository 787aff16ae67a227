"""Update outputs and figures of pages: ``python -m tests.refresh_pages [PAGE]...``; all pages without one.

A changed output is written in full; shorten it with a line ``...``.
"""

import contextlib
import os
import re
import sys
import tempfile
from pathlib import Path

from tests.pages import FENCED, PAGES, ROOT, figures_of, lines_of, matches, run_command, run_session, save_figure


def console(block: str) -> str:
    """Return a console block with the current output of its commands."""
    lines = []
    for line in lines_of(block):
        output = run_command(line.command)
        lines += [f"$ {line.command}", *filter(None, [line.output if matches(line.output, output) else output])]
    return "\n".join(lines) + "\n"


def python(block: str, names: dict[str, object]) -> str:
    """Return a Python session with its current output."""
    lines = []
    for example, output in run_session(block, names):
        first, *continuation = example.source.rstrip("\n").split("\n")
        lines += [f">>> {first}", *(f"... {line}".rstrip() for line in continuation), *output.rstrip("\n").split("\n")]
    return "\n".join(filter(None, lines)) + "\n"


def refresh(page: Path) -> None:
    """Refresh one page and its figures."""
    names: dict[str, object] = {}

    def refresh_block(match: re.Match[str]) -> str:
        update = {"console": console, "python": lambda block: python(block, names)}.get(match[1], str)
        return f"```{match[1]}\n{update(match[2])}```"

    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        page.write_text(FENCED.sub(refresh_block, page.read_text(encoding="utf-8")), encoding="utf-8")
        for figure in figures_of(page):
            if Path(figure.name).exists():
                save_figure(Path(figure.name), figure)


if __name__ == "__main__":
    os.environ |= {"COLUMNS": "80", "NO_COLOR": "1", "LC_ALL": "C.UTF-8"}
    for page_path in [Path(name).resolve() for name in sys.argv[1:]] or PAGES.values():
        print(page_path.relative_to(ROOT))
        refresh(page_path)
