"""Update outputs and figures of pages: ``python -m tests.refresh_pages [PAGE]...``; all pages without one.

A changed output keeps its omissions (lines ``...``): between them stand the lines that resemble the old ones most.
"""

import contextlib
import difflib
import os
import re
import sys
import tempfile
from pathlib import Path

from tests.pages import ANYTHING, FENCED, PAGES, ROOT, figures_of, lines_of, matches, run_command, run_session, save_figure


def shorten(shown: str, output: str) -> str:
    """Return an output with the omissions of the one shown before."""
    lines, parts, first = output.split("\n"), [part.strip("\n").split("\n") for part in f"\n{shown}\n".split(f"\n{ANYTHING}\n")], 0
    result: list[str] = []
    for number, part in enumerate(parts):
        if part == [""]:
            result.append("")
            continue
        last = len(lines) - len(part)
        starts = [0] if number == 0 else [last] if number == len(parts) - 1 else range(first, last + 1)
        first = max(starts, key=lambda start, part=part: sum(map(similarity, part, lines[start : start + len(part)])))
        result.append("\n".join(lines[first : first + len(part)]))
        first += len(part)
    return f"\n{ANYTHING}\n".join(result).strip("\n")


def similarity(one: str, other: str) -> float:
    """Return how alike two lines are, 0 to 1."""
    return difflib.SequenceMatcher(None, one, other).ratio()


def console(block: str) -> str:
    """Return a console block with the current output of its commands."""
    lines = []
    for line in lines_of(block):
        output = run_command(line.command)
        lines += [f"$ {line.command}", *filter(None, [line.output if matches(line.output, output) else shorten(line.output, output)])]
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
