"""Text report of a mode map: shares of modes, closed-form limits, letter map and CSV of all cells."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from rich.text import Text

from seisblock.core.i18n import N_, format_share, gettext, join_list, join_sentences
from seisblock.criteria.initiation import Mode
from seisblock.output.io.history_csv import CsvTable, table_by_record
from seisblock.output.text.tables import Part, details, group_answers, styled_line, table
from seisblock.records import Motion
from seisblock.report.text.spectrum import rows_per_table, shorten, thin_indices
from seisblock.studies.respond.mode_map import MODES_BY_SEVERITY, NO_ANSWER, ModeMap

Maps = Sequence[tuple[Motion, ModeMap]]

MAX_ROWS, MAX_COLUMNS = 20, 60
LETTERS = {Mode.REST: ".", Mode.SLIDE: "s", Mode.ROCK: "r", Mode.SLIDE_ROCK: "b", Mode.FLIGHT: "f", Mode.OVERTURNED: "#", NO_ANSWER: "?"}
"""Letter of each mode on the map."""

SHARES = {
    Mode.REST: N_("{share} at rest"), Mode.SLIDE: N_("{share} slide"), Mode.ROCK: N_("{share} rock"),
    Mode.SLIDE_ROCK: N_("{share} slide-rock"), Mode.FLIGHT: N_("{share} in flight"), Mode.OVERTURNED: N_("{share} overturn"),
    NO_ANSWER: N_("{share} without result"),
}  # fmt: skip


def tables(maps: Maps, wear_text: str = "") -> Iterator[Any]:
    """Yield, per component, the shares of modes, the limits of initiation and a map of at most 20 bodies and 60 frictions."""
    is_thinned = any(min(mode_map.size_m.size, MAX_ROWS) > rows_per_table(len(maps)) for _, mode_map in maps)
    for heading, part in group_answers(maps, lambda pair: pair[0].record, lambda pair: _summary(*pair, is_thinned=is_thinned)):
        yield from heading
        for index, pair in enumerate(part):
            yield from shorten(pair[1].size_m.size, MAX_ROWS, len(maps), partial(_map_table, *pair, wear_text))
            legend = (*_legend(pair[1]), styled_line())
            yield from [details(*legend)] if is_thinned and index < len(part) - 1 else legend


def _summary(motion: Motion, mode_map: ModeMap, *, is_thinned: bool) -> Iterator[Any]:
    yield styled_line(verdict(motion, mode_map), "bold")
    loading, *rules = _limits(mode_map)
    full = styled_line("  " + limits_text(mode_map))
    yield Part((full,), (styled_line("  " + loading),)) if rules and is_thinned else full


def _map_table(motion: Motion, mode_map: ModeMap, wear_text: str, max_rows: int) -> Iterator[Any]:
    """Yield the map of one component."""
    rows, columns = thin_indices(mode_map.size_m.size, max_rows)[::-1], thin_indices(mode_map.mu.size, MAX_COLUMNS)
    cells = [[row_label(mode_map, i), "".join(LETTERS[MODES_BY_SEVERITY[mode_map.governing[i, j]]] for j in columns)] for i in rows]
    first, last = f"{mode_map.mu[0]:.3g}", f"{mode_map.mu[-1]:.3g}"
    axis_text = f"{first} {last:>{max(columns.size - len(first) - 1, 1)}}" if columns.size > 1 else first
    yield table(_title(motion, mode_map) + gettext(wear_text), [f"{row_symbol(mode_map)} \\ μ", axis_text], cells)


def _legend(mode_map: ModeMap) -> Iterator[Text]:
    yield styled_line(gettext(". rest, s sliding, r rocking, b slide-rocking, f flight, # overturning"), "dim")
    if mode_map.share(NO_ANSWER) > 0.0:
        yield styled_line(gettext("? no result: analysis stopped at the limit of impacts (endless small bounces)"), "dim")


def verdict(motion: Motion, mode_map: ModeMap) -> str:
    """Return the shares of the modes."""
    shares = [(mode, mode_map.share(mode)) for mode in MODES_BY_SEVERITY]
    parts = [gettext(SHARES[mode], share=format_share(share)) for mode, share in shares if share > 0.0]
    return gettext("{name}: of {all} bodies {parts}.", name=motion.name or "x", all=mode_map.governing.size, parts=join_list(parts))


def limits_text(mode_map: ModeMap) -> str:
    """Return the closed-form limits of initiation of motion."""
    return join_sentences(_limits(mode_map))


def _limits(mode_map: ModeMap) -> list[str]:
    """Return the largest loading and the rules that follow from it."""
    if math.isinf(mode_map.loading):
        text = N_("The downward ground acceleration exceeds gravity at {time:.2f} s; no body remains at rest.")
        return [gettext(text, time=mode_map.loading_time_s)]
    return [
        gettext(
            "Largest horizontal force {ratio:.3f} of the effective weight, at {time:.2f} s.",
            time=mode_map.loading_time_s,
            ratio=mode_map.loading,
        ),
        gettext("Bodies with mu and b/h above this ratio remain at rest; the others slide if mu < b/h and rock if mu > b/h."),
    ]


def rows_are_sizes(mode_map: ModeMap) -> bool:
    """Return whether the rows are sizes of one shape; otherwise they are shapes."""
    return bool(mode_map.b_over_h.size > 1 and mode_map.b_over_h.max() - mode_map.b_over_h.min() < 1e-9 * mode_map.b_over_h.max())


def row_symbol(mode_map: ModeMap) -> str:
    """Return the symbol of the row variable."""
    return "2R" if rows_are_sizes(mode_map) else "b/h"


def row_label(mode_map: ModeMap, i: int) -> str:
    """Return the value of the row variable."""
    return f"{mode_map.size_m[i]:.3g}" if rows_are_sizes(mode_map) else f"{mode_map.b_over_h[i]:.3f}"


def _title(motion: Motion, mode_map: ModeMap) -> str:
    if rows_are_sizes(mode_map):
        text = N_("{name}: 2R (m, rows) against friction (columns), b/h {ratio:.3g}")
    else:
        text = N_("{name}: b/h (rows) against friction (columns), 2R {size:.3g} m")
    return gettext(text, name=motion.name, size=mode_map.size_m[0], ratio=mode_map.b_over_h[0])


def csv_columns(maps: Maps) -> CsvTable:
    """Return a row for every cell, SI; with the record index for several records."""
    header = ["component", "size_m", "b_over_h", "mu", "mode", "max_rotation_ratio", "slip_path_m", "final_displacement_m"]
    return table_by_record(header, maps, lambda pair: pair[0].record, lambda pair: _rows(*pair))


def _rows(motion: Motion, mode_map: ModeMap) -> Iterator[list[Any]]:
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
