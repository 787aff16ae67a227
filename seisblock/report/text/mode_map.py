"""How a map of modes is told: what happens to how many, the limits in closed form, a map in letters, and all cells as CSV."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rich.text import Text

from seisblock.core.i18n import N_, format_share, gettext, join_list, join_sentences
from seisblock.models.respond.describe import FLIGHT, OVERTURNED, REST, ROCK, SLIDE, SLIDE_ROCK
from seisblock.records import Motion
from seisblock.report.io.history_csv import write_by_record
from seisblock.report.text.spectrum import thin_indices
from seisblock.report.text.tables import group_answers, styled_line, table
from seisblock.studies.respond.mode_map import MODES_BY_SEVERITY, NO_ANSWER, ModeMap

Maps = Sequence[tuple[Motion, ModeMap]]

MAX_ROWS, MAX_COLUMNS = 20, 60
LETTERS = {REST: ".", SLIDE: "s", ROCK: "r", SLIDE_ROCK: "b", FLIGHT: "f", OVERTURNED: "#", NO_ANSWER: "?"}
"""What stands for a mode on the map."""

SHARES = {
    REST: N_("{share} stand still"), SLIDE: N_("{share} slide"), ROCK: N_("{share} rock"),
    SLIDE_ROCK: N_("{share} slide and rock"), FLIGHT: N_("{share} leave the ground"), OVERTURNED: N_("{share} fall"),
    NO_ANSWER: N_("{share} have no answer"),
}  # fmt: skip


def tables(maps: Maps, wear_text: str = "") -> Iterator[Any]:
    """Yield, per component, what happens to how many, the limits of initiation, and a map of at most 20 bodies and 60 frictions."""
    for heading, part in group_answers(maps, lambda pair: pair[0].record, lambda pair: _summary(*pair)):
        yield from heading
        yield from (block for pair in part for block in _map_table(*pair, wear_text))


def _summary(motion: Motion, mode_map: ModeMap) -> Iterator[Text]:
    """Yield what happens to how many, and below which limits nothing does."""
    yield styled_line(verdict(motion, mode_map), "bold")
    yield styled_line("  " + limits_text(mode_map))


def _map_table(motion: Motion, mode_map: ModeMap, wear_text: str) -> Iterator[Any]:
    """Yield the map of one component, and what its letters mean."""
    rows, columns = thin_indices(mode_map.size_m.size, MAX_ROWS)[::-1], thin_indices(mode_map.mu.size, MAX_COLUMNS)
    cells = [[row_label(mode_map, i), "".join(LETTERS[MODES_BY_SEVERITY[mode_map.governing[i, j]]] for j in columns)] for i in rows]
    first, last = f"{mode_map.mu[0]:.3g}", f"{mode_map.mu[-1]:.3g}"
    axis_text = f"{first}{last:>{max(columns.size - len(first), 1)}}" if columns.size > 1 else first
    yield table(_title(motion, mode_map) + gettext(wear_text), [f"{row_symbol(mode_map)} \\ μ", axis_text], cells)
    yield styled_line(gettext(". stands still, s slides, r rocks, b slides and rocks, f leaves the ground, # falls"), "dim")
    if mode_map.share(NO_ANSWER) > 0.0:
        yield styled_line(gettext("? no answer: the run was given up; it hops without end"), "dim")
    yield styled_line()


def verdict(motion: Motion, mode_map: ModeMap) -> str:
    """Return what happens to how many of the bodies."""
    shares = [(mode, mode_map.share(mode)) for mode in MODES_BY_SEVERITY]
    parts = [gettext(SHARES[mode], share=format_share(share)) for mode, share in shares if share > 0.0]
    return gettext("{name}: of {all} bodies {parts}.", name=motion.name or "x", all=mode_map.governing.size, parts=join_list(parts))


def limits_text(mode_map: ModeMap) -> str:
    """Return below which friction and slenderness something moves, and what begins."""
    if math.isinf(mode_map.loading):
        return gettext("The ground falls faster than gravity at {time:.2f} s: nothing stays where it is.", time=mode_map.loading_time_s)
    parts = [
        gettext("At {time:.2f} s the ground pushes with {ratio:.3f} of the weight.", time=mode_map.loading_time_s, ratio=mode_map.loading),
        gettext("What has more friction and a larger b/h rests; else it slides where mu is below b/h, and rocks where not."),
    ]
    return join_sentences(parts)


def rows_are_sizes(mode_map: ModeMap) -> bool:
    """Whether the rows are sizes of one shape, rather than shapes."""
    return bool(mode_map.b_over_h.size > 1 and mode_map.b_over_h.max() - mode_map.b_over_h.min() < 1e-9 * mode_map.b_over_h.max())


def row_symbol(mode_map: ModeMap) -> str:
    """Return what the rows differ in."""
    return "2R" if rows_are_sizes(mode_map) else "b/h"


def row_label(mode_map: ModeMap, i: int) -> str:
    """Return what tells a row from the others."""
    return f"{mode_map.size_m[i]:.3g}" if rows_are_sizes(mode_map) else f"{mode_map.b_over_h[i]:.3f}"


def _title(motion: Motion, mode_map: ModeMap) -> str:
    """Return what the table shows."""
    if rows_are_sizes(mode_map):
        text = N_("{name}: down 2R (m) of blocks with b/h {ratio:.3g}, across the friction")
    else:
        text = N_("{name}: down b/h of blocks with 2R {size:.3g} m, across the friction")
    return gettext(text, name=motion.name, size=mode_map.size_m[0], ratio=mode_map.b_over_h[0])


def write_csv(path: Path, maps: Maps) -> None:
    """Write every cell as a row of CSV, SI; of several records with their index."""
    header = ["component", "size_m", "b_over_h", "mu", "mode", "max_rotation_ratio", "slip_path_m", "final_displacement_m"]
    write_by_record(path, header, maps, lambda pair: pair[0].record, lambda pair: _rows(*pair))


def _rows(motion: Motion, mode_map: ModeMap) -> Iterator[list[Any]]:
    """Yield the row of each cell."""
    for i in range(mode_map.size_m.size):
        for j, mu in enumerate(mode_map.mu):
            yield [
                motion.name,
                float(mode_map.size_m[i]),
                float(mode_map.b_over_h[i]),
                float(mu),
                MODES_BY_SEVERITY[mode_map.governing[i, j]],
                float(mode_map.max_rotation_ratio[i, j]),
                float(mode_map.slip_path_m[i, j]),
                float(mode_map.final_displacement_m[i, j]),
            ]
