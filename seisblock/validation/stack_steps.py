"""Validation of the integration of `stack`: restitution of a rocking block at several steps, and energy balance of a collapsing pile."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.stack.options import RIGID, SPRINGS
from seisblock.models.stack.solve import solve_stack
from seisblock.records.motion import Motion
from seisblock.validation.case import Case
from seisblock.validation.furukawa_pile import kobe_like

ALPHA = math.atan(0.25)
START_LEAN = 0.6
"""Lean at release over the overturning angle."""

STIFF_CONTACT = PileContact(stiffness=1e10)
BLOCK = Pile("block", (PileStone("block", 0.24, 0.24, 0.96),), mu=5.0)


def lean_after_impact() -> float:
    """Return the lean after one impact over the overturning angle, in closed form ([Housner1963]_)."""
    energy_ratio = (1.0 - 1.5 * math.sin(ALPHA) ** 2) ** 2
    rise = math.cos(ALPHA * (1.0 - START_LEAN)) - math.cos(ALPHA)
    return 1.0 - math.acos(math.cos(ALPHA) + energy_ratio * rise) / ALPHA


def simulated_lean_after_impact(law: str, step: float) -> float:
    """Return the simulated lean after one impact over the overturning angle."""
    ground = Motion.from_arrays(np.zeros(161), 0.005)
    contact = STIFF_CONTACT if law == SPRINGS else None
    response = solve_stack(BLOCK, ground, law=law, contact=contact, step=step, tilts={"block": START_LEAN * ALPHA})
    lean = 2.0 * np.arctan2(response["block_qy"], response["block_qw"]) / ALPHA
    return float(-lean.min())


def energy_created(law: str, points: int) -> float:
    """Return the energy created by the integration of a collapsing pile of five stones, over its weight times height."""
    pile = load_pile("wagata")
    outcome = solve_stack(pile, kobe_like("7", 0), law=law, points=points).outcome
    weight = STANDARD_GRAVITY * sum(stone.mass for stone in pile.stones)
    return outcome.created_j / (weight * pile.as_block().height)


def _impact_case(law: str, step: float, tolerance: float) -> Case:
    """Return the case of one impact at one step."""
    laws = "rigid contact" if law == RIGID else "springs of 1e10 N/m^3"
    return Case(
        f"stack-steps-{law}-{step * 1e3:g}-ms",
        "[Housner1963]_ rocking",
        f"tilt after one impact over alpha, H/B 4, released at 0.6 alpha; {laws}, steps of {step * 1e3:g} ms",
        "1",
        lean_after_impact,
        tolerance,
        partial(simulated_lean_after_impact, law, step),
        note="expected: closed form of the rigid block",
        kind="derived",
        quick=False,
    )


def _energy_case(law: str, points: int) -> Case:
    """Return the case of the energy balance with one contact law."""
    laws = "rigid contact at the edges" if law == RIGID else "springs at 5 x 5 points"
    return Case(
        f"stack-energy-{law}",
        "[Jean1999]_ section 3" if law == RIGID else "[Furukawa2009]_ section 3(1)",
        f"created energy over weight times height, collapse of a gravestone at JMA 7; {laws}",
        "1",
        0.0,
        1e-5 if law == RIGID else 1e-4,
        partial(energy_created, law, points),
        note="friction, dashpots and impacts only dissipate energy",
        kind="derived",
        quick=False,
    )


CASES = (
    _impact_case(RIGID, 5e-3, 5e-5),
    _impact_case(RIGID, 1e-3, 2e-5),
    _impact_case(RIGID, 2e-4, 5e-6),
    _impact_case(SPRINGS, 2e-4, 3e-3),
    _impact_case(SPRINGS, 1e-4, 3e-3),
    _energy_case(RIGID, 2),
    _energy_case(SPRINGS, 5),
)
"""Cases on the integration of piles."""
