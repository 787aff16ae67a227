"""Items of [Okumura1987]_: mode shapes (fig. 2), frequencies (figs. 3, 4), uplift regions (figs. 6 to 11)."""

from __future__ import annotations

from functools import partial

import numpy as np

from seisblock.bodies.spring_block import CORNER_SIGNS, SpringBlock
from seisblock.bodies.spring_factory import load_springs
from seisblock.core.i18n import N_
from seisblock.models.uplift.modes import natural_modes
from seisblock.paper.item import Answer, Inputs, Item, ItemColumn, Panel, Paper, Series, Value
from seisblock.studies.uplift_regions import DEFAULT_RATIOS, PAPER_FIGURES, harmonic_blocks, modal_frequencies_against, uplift_regions

SOURCE = N_("block of the paper: square base, β 0.707, damping 0.05 unless varied; values of figs. 3, 4, 9 to 11 chosen here")

DRAWN = 0.25
"""Largest displacement of a drawn mode over the depth of the block."""


def _mode_shapes(inputs: Inputs) -> Answer:
    """Return fig. 2: shapes of the natural modes in the plane in which they move."""
    body = SpringBlock.from_ratios(1.0, 0.707) if inputs.body is None else load_springs(inputs.body)
    modes = natural_modes(body)
    columns = (
        ItemColumn("mode", N_("mode")),
        ItemColumn("frequency_ratio", "ωᵢ/ωᵥ"),
        *(
            ItemColumn(name, heading)
            for name, heading in zip(
                ("x", "y", "z", "b_theta_x", "b_theta_y", "b_theta_z"), ("x", "y", "z", "bθx", "bθy", "bθz"), strict=True
            )
        ),
    )
    rows: list[tuple[Value, ...]] = []
    panels = []
    for omega, shape, name in zip(modes.omega, modes.shapes.T, modes.names, strict=True):
        scaled = shape / np.abs(shape).max()
        # adding zero turns -0.0 into 0.0
        rows.append((name, float(omega / body.omega[2]), *(float(value) + 0.0 for value in scaled)))
        # the modes in y-z of a square base repeat those in x-z
        if not name.endswith("y-z"):
            panels.append(_mode_panel(body, scaled, name))
    return Answer(columns, rows, tuple(panels), SOURCE if inputs.body is None else N_("own record or body"))


def _mode_panel(body: SpringBlock, shape: np.ndarray, name: str) -> Panel:
    """Return the outline of the block at rest and displaced: elevation, or plan for torsion."""
    if name == "torsion":
        corners = np.array([CORNER_SIGNS[i] for i in (0, 1, 3, 2, 0)]) * [0.5 * body.gamma, 0.5]
        turn = DRAWN * shape[5]
        moved = corners @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        labels = ("x/b (1)", "y/b (1)")
    else:
        a, h = 0.5 * body.gamma, 0.5 * body.alpha
        corners = np.array([(-a, -h), (a, -h), (a, h), (-a, h), (-a, -h)])
        turn = DRAWN * shape[4]
        # a right-hand rotation about y turns z towards x
        rotated = corners @ np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        moved = rotated + DRAWN * np.array([shape[0], shape[2]])
        labels = ("x/b (1)", "z/b (1)")
    series = (
        Series(N_("at rest"), corners[:, 0], corners[:, 1], "dotted"),
        Series(N_("displaced"), moved[:, 0], moved[:, 1]),
        Series(N_("springs"), moved[:2, 0], moved[:2, 1], "points"),
    )
    return Panel(*labels, series if name != "torsion" else series[:2], title=name, equal=True)


def _frequencies(figure: int, inputs: Inputs) -> Answer:
    """Return figs. 3 and 4: natural frequencies against beta, or alpha."""
    against = "beta" if figure == 3 else "alpha"
    fixed = "alpha" if figure == 3 else "beta"
    values = PAPER_FIGURES[figure][fixed]
    if inputs.body is not None:
        values = (getattr(load_springs(inputs.body), fixed),)
    grid = np.linspace(0.25, 3.0, 12)
    symbols = {"alpha": "α", "beta": "β"}
    rows: list[tuple[Value, ...]] = []
    names: list[str] = []
    for value in values:
        curves = modal_frequencies_against(against, grid, **{"alpha": 1.0, "beta": 1.0, fixed: value})  # type: ignore[arg-type]
        names = list(curves)
        rows += [(value, float(x), *(float(curves[name][i]) for name in names)) for i, x in enumerate(grid)]
    columns = (
        ItemColumn(fixed, symbols[fixed]),
        ItemColumn(against, symbols[against]),
        *(ItemColumn(name.replace(" ", "_").replace("-", "_"), name) for name in names),
    )
    regions = _regions(figure, inputs, (1.0,))
    return Answer(columns, rows, source=SOURCE if inputs.body is None else N_("own record or body"), drawing=(regions, figure))


def _regions(figure: int, inputs: Inputs, ratios: tuple[float, ...] = DEFAULT_RATIOS):  # type: ignore[no-untyped-def]
    """Return the uplift regions of a figure: for the block of the paper, or the user's with the varied parameters of the figure."""
    if inputs.body is None:
        return uplift_regions(harmonic_blocks({}, figure=figure), ratios, corner=None)
    body = load_springs(inputs.body)
    body_values = {"alpha": (body.alpha,), "gamma": (body.gamma,), "beta": (body.beta,), "damping": (body.damping,)}
    varied = {name for name, values in PAPER_FIGURES[figure].items() if len(values) > 1}
    return uplift_regions(
        harmonic_blocks({name: values for name, values in body_values.items() if name not in varied}, figure=figure), ratios, corner=None
    )


def _uplift(figure: int, inputs: Inputs) -> Answer:
    """Return figs. 6 to 11: smallest A/g that lifts a corner, by the first corner to lift."""
    columns = (
        *(
            ItemColumn(name, heading)
            for name, heading in (("alpha", "α"), ("beta", "β"), ("damping", "h"), ("phi_deg", N_("φ (deg)")), ("rho_deg", N_("ρ (deg)")))
        ),
        ItemColumn("mode", N_("mode")),
        ItemColumn("frequency_ratio", "θ/ω₁"),
        ItemColumn("acceleration_ratio", "A/g"),
        ItemColumn("corners", N_("corners")),
    )
    regions = _regions(figure, inputs)
    rows = [
        (
            r.body.alpha,
            r.body.beta,
            r.body.damping,
            r.phi_deg,
            r.rho_deg,
            m.mode,
            m.frequency_ratio,
            m.acceleration_ratio,
            " ".join(map(str, m.corners)),
        )
        for r in regions
        for m in r.minima
    ]
    return Answer(columns, rows, source=SOURCE if inputs.body is None else N_("own record or body"), drawing=(regions, figure))


TITLES = {
    3: N_("Natural frequencies against the stiffness ratio"),
    4: N_("Natural frequencies against the slenderness"),
    6: N_("Uplift regions: damping"),
    7: N_("Uplift regions: slenderness"),
    8: N_("Uplift regions: stiffness ratio"),
    9: N_("Uplift regions: azimuth of the shaking"),
    10: N_("Uplift regions: vertical part of the shaking"),
    11: N_("Uplift regions: vertical part, azimuth 45 degrees"),
}

SECTIONS = {
    3: ("section 3",),
    4: ("section 3",),
    8: ("section 6, statement 3",),
    9: ("section 6, statement 4",),
    10: ("section 6, statement 5",),
}
"""Statements of the text on the figures."""

PAPER = Paper(
    "[Okumura1987]_",
    "okumura",
    (
        Item("fig2", N_("Shapes of the natural modes"), _mode_shapes, ("body",), ("eqs. (7), (8)",)),
        *(
            Item(
                f"fig{number}",
                TITLES[number],
                partial(_frequencies if number < 5 else _uplift, number),
                ("body",),
                SECTIONS.get(number, ()),
            )
            for number in PAPER_FIGURES
        ),
    ),
)
"""Items of the paper."""
