"""How a map of modes is told: what happens to how many, the limits in closed form, a map in letters, and all cells as CSV."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.text import Text

from seisblock.present.histories import write_by_record
from seisblock.present.text.spectrum import thinned
from seisblock.present.text.tables import answered, line, table
from seisblock.records import Motion
from seisblock.solvers.respond.tale import FLIGHT, OVERTURNED, REST, ROCK, SLIDE, SLIDE_ROCK
from seisblock.studies.standing.mode_map import GOVERNING, NO_ANSWER, ModeMap
from seisblock.words import listed, noted, roughly, strung, tell

Maps = Sequence[tuple[Motion, ModeMap]]

MOST_ROWS, MOST_COLUMNS = 20, 60
LETTERS = {REST: ".", SLIDE: "s", ROCK: "r", SLIDE_ROCK: "b", FLIGHT: "f", OVERTURNED: "#", NO_ANSWER: "?"}
"""What stands for a mode on the map."""

SHARES = {
    REST: noted("{share} stand still"), SLIDE: noted("{share} slide"), ROCK: noted("{share} rock"),
    SLIDE_ROCK: noted("{share} slide and rock"), FLIGHT: noted("{share} leave the ground"), OVERTURNED: noted("{share} fall"),
    NO_ANSWER: noted("{share} have no answer"),
}  # fmt: skip


def tables(maps: Maps, worn: str = "") -> Iterator[Any]:
    """Yield, per component, what happens to how many, the limits of initiation, and a map of at most 20 bodies and 60 frictions."""
    for opening, part in answered(maps, lambda each: each[0].record, lambda each: _happens(*each)):
        yield from opening
        yield from (shown for each in part for shown in _drawn(*each, worn))


def _happens(motion: Motion, found: ModeMap) -> Iterator[Text]:
    """Yield what happens to how many, and below which limits nothing does."""
    yield line(verdict(motion, found), "bold")
    yield line("  " + limits(found))


def _drawn(motion: Motion, found: ModeMap, worn: str) -> Iterator[Any]:
    """Yield the map of one component, and what its letters mean."""
    rows, columns = thinned(found.size_m.size, MOST_ROWS)[::-1], thinned(found.mu.size, MOST_COLUMNS)
    cells = [[told(found, i), "".join(LETTERS[GOVERNING[found.governing[i, j]]] for j in columns)] for i in rows]
    first, last = f"{found.mu[0]:.3g}", f"{found.mu[-1]:.3g}"
    across = f"{first}{last:>{max(columns.size - len(first), 1)}}" if columns.size > 1 else first
    yield table(_title(motion, found) + tell(worn), [f"{symbol(found)} \\ μ", across], cells)
    yield line(tell(". stands still, s slides, r rocks, b slides and rocks, f leaves the ground, # falls"), "dim")
    if found.share(NO_ANSWER) > 0.0:
        yield line(tell("? no answer: the run was given up; it hops without end"), "dim")
    yield line()


def verdict(motion: Motion, found: ModeMap) -> str:
    """Return what happens to how many of the bodies."""
    shares = [(mode, found.share(mode)) for mode in GOVERNING]
    parts = [tell(SHARES[mode], share=roughly(share)) for mode, share in shares if share > 0.0]
    return tell("{name}: of {all} bodies {parts}.", name=motion.name or "x", all=found.governing.size, parts=listed(parts))


def limits(found: ModeMap) -> str:
    """Return below which friction and slenderness something moves, and what begins."""
    if math.isinf(found.loading):
        return tell("The ground falls faster than gravity at {time:.2f} s: nothing stays where it is.", time=found.loading_time_s)
    parts = [
        tell("At {time:.2f} s the ground pushes with {ratio:.3f} of the weight.", time=found.loading_time_s, ratio=found.loading),
        tell("What has more friction and a larger b/h rests; else it slides where mu is below b/h, and rocks where not."),
    ]
    return strung(parts)


def by_size(found: ModeMap) -> bool:
    """Whether the rows are sizes of one shape, rather than shapes."""
    return bool(found.b_over_h.size > 1 and found.b_over_h.max() - found.b_over_h.min() < 1e-9 * found.b_over_h.max())


def symbol(found: ModeMap) -> str:
    """Return what the rows differ in."""
    return "2R" if by_size(found) else "b/h"


def told(found: ModeMap, i: int) -> str:
    """Return what tells a row from the others."""
    return f"{found.size_m[i]:.3g}" if by_size(found) else f"{found.b_over_h[i]:.3f}"


def _title(motion: Motion, found: ModeMap) -> str:
    """Return what the table shows."""
    if by_size(found):
        text = noted("{name}: down 2R (m) of blocks with b/h {ratio:.3g}, across the friction")
    else:
        text = noted("{name}: down b/h of blocks with 2R {size:.3g} m, across the friction")
    return tell(text, name=motion.name, size=found.size_m[0], ratio=found.b_over_h[0])


def write(path: Path, maps: Maps) -> None:
    """Write every cell as a row of CSV, SI; of several records with their index."""
    header = ["component", "size_m", "b_over_h", "mu", "mode", "max_rotation_ratio", "slip_path_m", "final_displacement_m"]
    write_by_record(path, header, maps, lambda each: each[0].record, lambda each: _rows(*each))


def _rows(motion: Motion, found: ModeMap) -> Iterator[list[Any]]:
    """Yield the row of each cell."""
    for i in range(found.size_m.size):
        for j, mu in enumerate(found.mu):
            yield [
                motion.name,
                float(found.size_m[i]),
                float(found.b_over_h[i]),
                float(mu),
                GOVERNING[found.governing[i, j]],
                float(found.max_rotation_ratio[i, j]),
                float(found.slip_path_m[i, j]),
                float(found.final_displacement_m[i, j]),
            ]
