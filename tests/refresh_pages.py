"""Write down anew what the lines of pages print and draw: ``python -m tests.refresh_pages [PAGE]...``, all pages without one.

What is printed is written in full where it is not what stands there; shorten it with a line ``...``.
"""

import contextlib
import os
import re
import sys
import tempfile
from pathlib import Path

from tests.pages import FENCED, PAGES, ROOT, figures_of, lines_of, matches, run_command, run_session, save_figure


def console(block: str) -> str:
    """Return a console block with what its commands print now."""
    told = []
    for line in lines_of(block):
        said = run_command(line.command)
        told += [f"$ {line.command}", *filter(None, [line.shown if matches(line.shown, said) else said])]
    return "\n".join(told) + "\n"


def python(block: str, names: dict[str, object]) -> str:
    """Return a Python session with what it answers now."""
    told = []
    for example, said in run_session(block, names):
        first, *more = example.source.rstrip("\n").split("\n")
        told += [f">>> {first}", *(f"... {line}".rstrip() for line in more), *said.rstrip("\n").split("\n")]
    return "\n".join(filter(None, told)) + "\n"


def refresh(page: Path) -> None:
    """Refresh one page and its figures."""
    names: dict[str, object] = {}

    def refreshed(found: re.Match[str]) -> str:
        made = {"console": console, "python": lambda block: python(block, names)}.get(found[1], str)
        return f"```{found[1]}\n{made(found[2])}```"

    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        page.write_text(FENCED.sub(refreshed, page.read_text(encoding="utf-8")), encoding="utf-8")
        for figure in figures_of(page):
            if Path(figure.name).exists():
                save_figure(Path(figure.name), figure)


if __name__ == "__main__":
    os.environ |= {"COLUMNS": "80", "NO_COLOR": "1", "LC_ALL": "C.UTF-8"}
    for asked in [Path(name).resolve() for name in sys.argv[1:]] or PAGES.values():
        print(asked.relative_to(ROOT))
        refresh(asked)
