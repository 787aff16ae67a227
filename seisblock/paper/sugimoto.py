"""Items of [Sugimoto2017]_: tables 1 and 2, figs. 12 to 14."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from seisblock.bodies.toml import check_kind, read_body_toml
from seisblock.bodies.two_layer import Contact, TwoLayerBlock, base_from_table, load_contact, two_layer_from_table
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.units import GAL
from seisblock.models.jump.chain import Chain
from seisblock.models.jump.solve import solve_jump
from seisblock.paper.item import Answer, Inputs, Item, ItemColumn, Panel, Paper, Series, Value
from seisblock.records import Motion, motion_of
from seisblock.validation.sugimoto import COLUMNS, GRAVITY, PRINTED_CASES, motion_part, table_chain

BODY = "chozusha"

REBUILT = N_("ground acceleration reconstructed from table 1, bundled in synthetic_jma.csv; the recorded motion may not be passed on")

SIDES = N_("long"), N_("short")
"""Sides of the block in plan."""

PRINTED, TABLES, CORRECTED = N_("printed"), N_("paper's scheme"), N_("corrected")

TABLE_COLUMNS = (
    ItemColumn("case", N_("case")),
    ItemColumn("part", N_("part")),
    ItemColumn("side", N_("side")),
    ItemColumn("drop_m", N_("drop (m)")),
    ItemColumn("values", N_("kind of value")),
    ItemColumn("rocking_start_s", N_("rocking start (s)")),
    ItemColumn("impact_s", N_("impact (s)")),
    ItemColumn("landing_s", N_("landing (s)")),
    ItemColumn("end_s", N_("end (s)")),
    ItemColumn("rocking_duration_s", N_("rocking (s)")),
    ItemColumn("jump_duration_s", N_("jump (s)")),
    ItemColumn("max_rise_m", N_("rise (mm)"), 1e-3),
    ItemColumn("rock_slide_duration_s", N_("slide-rock (s)")),
    ItemColumn("jump_displacement_m", N_("jump distance (mm)"), 1e-3),
    ItemColumn("rock_slide_displacement_m", N_("slide-rock distance (mm)"), 1e-3),
    ItemColumn("total_displacement_m", N_("total distance (mm)"), 1e-3),
)


def _chain_cells(chain: Chain | None) -> tuple[Value, ...]:
    """Return the cells of a chain in the order of the tables."""
    return tuple(None if chain is None else getattr(chain, key) for key in COLUMNS)


def _table(numbers: tuple[str, ...], inputs: Inputs) -> Answer:
    """Return table 1 or 2: printed, by the paper's scheme, and corrected; or the first chains of the user's record."""
    if inputs.records or inputs.body:
        return Answer(TABLE_COLUMNS, list(_own_rows(inputs)), (_distances(list(_own_rows(inputs))),), N_("own record or body"))
    rows: list[tuple[Value, ...]] = []
    for number in numbers:
        case = PRINTED_CASES[number]
        head = (number, case.part, case.side, case.drop)
        rows.append((*head, PRINTED, *case.values))
        rows.append((*head, TABLES, *_chain_cells(table_chain(number, "printed"))))
        rows.append((*head, CORRECTED, *_chain_cells(table_chain(number, "corrected"))))
    return Answer(TABLE_COLUMNS, rows, (_distances(rows),), REBUILT)


def _distances(rows: list[tuple[Value, ...]]) -> Panel:
    """Return total displacements of the rows, side by side."""
    names = list(dict.fromkeys(row[0] for row in rows))
    kinds = list(dict.fromkeys(row[4] for row in rows))
    width = 0.8 / len(kinds)
    series = []
    for index, kind in enumerate(kinds):
        points = [(names.index(row[0]) + (index - (len(kinds) - 1) / 2) * width, row[-1]) for row in rows if row[4] == kind]
        values = [(x, 1e3 * float(y)) for x, y in points if y is not None]
        series.append(Series(str(kind), [x for x, _ in values], [y for _, y in values], "bars"))
    ticks = tuple((float(index), str(name)) for index, name in enumerate(names))
    return Panel(N_("case"), N_("total displacement (mm)"), tuple(series), ticks=ticks)


def _bodies(inputs: Inputs) -> Iterator[tuple[str, TwoLayerBlock, Contact, float]]:
    """Yield side, block, contact and drop of the user's body, or the Chozu-sha."""
    table = read_body_toml(inputs.body or BODY)
    check_kind(table, "two-layer")
    contact = load_contact(inputs.body or BODY)
    drops = (0.0, base_from_table(table)["drop"]) if base_from_table(table).get("drop") else (0.0,)
    for side in SIDES if "short" in table else ("",):
        block = two_layer_from_table(table, side or "short")
        for drop in drops:
            yield side, block, contact, drop


def _motions(inputs: Inputs) -> list[Motion]:
    """Return the motions of the user's records, or the bundled record."""
    from seisblock.readers import read

    records = inputs.records or (read("synthetic_jma.csv"),)
    return [motion_of(record, name) for record in records for name in inputs.component or [c.code for c in record.horizontals]]


def _own_rows(inputs: Inputs) -> Iterator[tuple[Value, ...]]:
    """Yield the first chain of each motion, side and drop, by both schemes."""
    for motion in _motions(inputs):
        for number, (side, block, contact, drop) in enumerate(_bodies(inputs), start=1):
            for words, landing, spin in ((TABLES, "printed", "tables"), (CORRECTED, "paper", "momentum")):
                outcome = solve_jump(block, motion, contact=contact, drop=drop, spin=spin, landing=landing, first=True).outcome
                chain = outcome.chains[0] if outcome.chains else None
                yield (f"{motion.name} {number}", "", side, drop, words, *_chain_cells(chain))


def _parts(component: str, parts: tuple[str, ...], inputs: Inputs) -> Answer:
    """Return figs. 12 and 13: acceleration around the onset of rocking with both thresholds."""
    columns = (
        ItemColumn("part", N_("part")),
        ItemColumn("side", N_("side")),
        ItemColumn("threshold_m_s2", N_("threshold (gal)"), GAL),
        ItemColumn("peak_m_s2", N_("peak (gal)"), GAL),
        ItemColumn("above_threshold_s", N_("above threshold (s)")),
        ItemColumn("printed_start_s", N_("printed rocking start (s)")),
        ItemColumn("rocking_start_s", N_("rocking start (s)")),
    )
    motions = [("", motion) for motion in _motions(inputs)] if inputs.records else [(part, motion_part(part)) for part in parts]
    blocks = {side: block for side, block, _, _ in _bodies(inputs)}
    contact = next(_bodies(inputs))[2]
    rows: list[tuple[Value, ...]] = []
    for part, motion in motions:
        for side, block in blocks.items():
            outcome = solve_jump(block, motion, contact=contact, first=True, gravity=GRAVITY).outcome
            chain = outcome.chains[0] if outcome.chains else None
            printed = next(
                (c.printed("rocking_start_s") for c in PRINTED_CASES.values() if part and (c.part, c.side) == (part, side)), None
            )
            cells = (None, None) if chain is None else (chain.time_above_threshold_s, chain.rocking_start_s)
            peak = float(np.abs(motion.horizontal).max())
            rows.append((part or motion.name, side, block.rocking_threshold(GRAVITY), peak, cells[0], printed, cells[1]))
    levels = [
        (block.rocking_threshold(GRAVITY) / GAL, lazy_gettext("{side} side", side=lazy_gettext(side)) if side else "")
        for side, block in blocks.items()
    ]
    panels = tuple(
        Panel(
            N_("t (s)"),
            N_("z'' (gal)"),
            (Series("", motion.time, motion.horizontal / GAL),),
            title=lazy_gettext("{component}, part {part}", component=component, part=part) if part else motion.name,
            levels=tuple(levels),
        )
        for part, motion in motions
    )
    return Answer(columns, rows, panels, N_("own record or body") if inputs.records else REBUILT)


def _histories(inputs: Inputs) -> Answer:
    """Return fig. 14: tilt, rise and displacement of cases 7 and 16."""
    columns = (
        ItemColumn("case", N_("case")),
        ItemColumn("quantity", N_("quantity")),
        ItemColumn("printed", N_("printed")),
        ItemColumn("computed", N_("computed")),
    )
    rows: list[tuple[Value, ...]] = []
    panels = []
    for number, tilt, rise in (("7", 1.46, 4.0), ("16", 3.30, 16.0)):
        case = PRINTED_CASES[number]
        chain = table_chain(number, "printed")
        rows += [
            (number, N_("peak tilt (deg)"), tilt, math.degrees(chain.max_rotation_rad)),
            (number, N_("rise (mm)"), rise, 1e3 * (chain.max_rise_m or 0.0)),
        ]
        block = two_layer_from_table(read_body_toml(BODY), case.side)
        response = solve_jump(
            block, motion_part(case.part), contact=case.contact, drop=case.drop, spin=case.table_spin, landing="printed", first=True,
            gravity=GRAVITY,
        )  # fmt: skip
        inside = (response.time >= chain.rocking_start_s - 0.1) & (response.time <= (chain.end_s or math.inf) + 0.1)
        time = response.time[inside]
        for label, values in (
            (N_("tilt (deg)"), np.degrees(np.abs(response["rotation"]))),
            (N_("rise of G (m)"), response["height"] - block.centroid_height),
            (N_("displacement of G (m)"), response["displacement"]),
        ):
            panels.append(
                Panel(N_("t (s)"), label, (Series("", time, values[inside]),), title=lazy_gettext("case {number}", number=number))
            )
    return Answer(columns, rows, tuple(panels), REBUILT)


TABLE_1, TABLE_2 = tuple(map(str, range(1, 17))), ("10'", "16'")
"""Cases of the tables."""

OWN_DATA, EQ_2 = ("record", "body"), ("eq. (2)",)

PAPER = Paper(
    "[Sugimoto2017]_",
    "sugimoto",
    (
        Item("table1", N_("Times and displacements of the Chozu-sha, cases 1 to 16"), partial(_table, TABLE_1), OWN_DATA),
        Item("table2", N_("Cases 10' and 16' with friction and restitution of wood"), partial(_table, TABLE_2), OWN_DATA),
        Item("fig12", N_("EW acceleration at the onset of rocking, parts b and d"), partial(_parts, "EW", ("b", "d")), OWN_DATA, EQ_2),
        Item("fig13", N_("NS acceleration at the onset of rocking, parts a and c"), partial(_parts, "NS", ("a", "c")), OWN_DATA, EQ_2),
        Item("fig14", N_("Tilt, rise and displacement of cases 7 and 16"), _histories, (), ("section 4.2",)),
    ),
)  # fmt: skip
"""Items of the paper."""
