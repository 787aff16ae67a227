"""Registration of the sliding solver."""

from __future__ import annotations

import math

from seisblock.bodies.from_spec import friction_from_spec, spec_values, without_friction
from seisblock.bodies.sliding_base import SlidingBase, sliding_base
from seisblock.bodies.table import BodySpec
from seisblock.core.registry import Solver, SolverBody, ValueMap, register
from seisblock.models.slide.options import SlideOptions
from seisblock.models.slide.rows import solve_slide_rows
from seisblock.models.slide.solve import SlideOutcome, solve_slide


def _build_body(spec: BodySpec, values: ValueMap) -> SolverBody:
    friction = friction_from_spec(spec, values)
    if "kappa" in spec.parameters and "mu_kinetic" not in spec.parameters:
        friction["mu_kinetic"] = None
    base = sliding_base(**friction, **spec_values(spec, "kappa", "slope_deg", "slope_length"))  # type: ignore[arg-type]
    return SolverBody(spec.name, base, SlideOptions(**without_friction(values)))


def _threshold(base: SlidingBase | float, options: SlideOptions) -> tuple[float, float]:
    """Return the horizontal accelerations at which an object slips, from [Fujino1978]_ eqs. (5), (9) without vertical motion.

    On a level base both are mu g. On a slope th the object slips downhill at g (mu cos th - sin th)/(cos th + mu sin th) and uphill at
    g (mu cos th + sin th)/(cos th - mu sin th), which is infinite where the denominator is not positive (derived here).
    """
    if isinstance(base, (int, float)):
        return options.gravity * base, options.gravity * base
    forward, backward = (_slip_ratio(base.mu, slope) for slope in (base.angle, -base.angle))
    return options.gravity * forward, math.inf if base.one_way else options.gravity * backward


def _slip_ratio(mu: float, slope: float) -> float:
    """Return the acceleration over g at which an object slips down a slope, rad; negative up a slope."""
    sine, cosine = math.sin(slope), math.cos(slope)
    grip = cosine + mu * sine
    return (mu * cosine - sine) / grip if grip > 0.0 else math.inf


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
        solve_rows=solve_slide_rows,
        row_options=("vertical",),
        threshold=_threshold,
        describe="seisblock.models.slide.describe:describe",
        plot="seisblock.models.slide.plot:figure",
        animate="seisblock.models.slide.animate:animate",
        section="seisblock.models.slide.describe:SECTION",
        document="seisblock.models.slide.document:DOCUMENT",
        topics=("sliding", "one-way sliding"),
    )
)
