"""Registration of the sliding solver."""

from __future__ import annotations

from seisblock.bodies.from_spec import friction_from_spec, spec_values, without_friction
from seisblock.bodies.sliding_base import SlidingBase, sliding_base
from seisblock.bodies.table import BodySpec
from seisblock.core.registry import Solver, SolverBody, ValueMap, register
from seisblock.models.slide.options import SlideOptions
from seisblock.models.slide.solve import SlideOutcome, solve_slide


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    friction = friction_from_spec(spec, values)
    if "kappa" in spec.parameters and "mu_kinetic" not in spec.parameters:
        friction["mu_kinetic"] = None
    base = sliding_base(**friction, **spec_values(spec, "kappa", "slope_deg", "slope_length"))  # type: ignore[arg-type]
    return SolverBody(spec.name, base, SlideOptions(**without_friction(values)))


SOLVER = register(
    Solver(
        name="slide",
        options=SlideOptions,
        outcome=SlideOutcome,
        solve=solve_slide,
        bodies=(SlidingBase, float, int),
        columns=("mu", "mu_kinetic", "surface", "kappa", "slope_deg", "slope_length"),
        build_body=_build_body,
        event="slips",
        displacement="max_slip_m",
        topics=("sliding", "one-way sliding"),
    )
)
