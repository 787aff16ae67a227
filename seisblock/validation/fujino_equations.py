"""Validation of sliding: closed forms of [Fujino1978]_ eqs. (1)-(15) and its sine example against the solver."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase, sliding_base
from seisblock.core.results import Response
from seisblock.criteria.sliding import min_friction_to_hold, min_friction_to_stop, pulse_slip, slip_acceleration, slip_limits, steady_slip
from seisblock.models.slide.solve import SlideOutcome, solve_slide
from seisblock.records import Motion
from seisblock.validation.bisection import bisect_threshold
from seisblock.validation.case import CONVERGED, EXACT, Case

G = 9.8
"""Gravity in the paper, m/s^2."""

MU, KAPPA, TH = 0.3, 0.5, 8.0
UP = 2.0
"""Constant vertical ground acceleration of the cases of (5)-(8), m/s^2."""


def ramp(sign: float = 1.0, up: float = 0.0) -> Motion:
    """Return a ground acceleration that rises by 1 m/s^2 per second."""
    a = sign * np.linspace(0.0, 12.0, 25)
    return Motion.from_arrays(a, 0.5, vertical=np.full(25, up))


def constant(horizontal: float, up: float = 0.0, duration: float = 1.0) -> Motion:
    """Return a constant ground acceleration."""
    return Motion.from_arrays(np.full(5, horizontal), duration / 4.0, vertical=np.full(5, up))


def sine(displacement_cm: float | None, acceleration_gal: float | None = None) -> Motion:
    """Return the ground motion of the sine example, 4 s, from the amplitude of its displacement or of its acceleration."""
    t = 1e-4 * np.arange(40001)
    amplitude = acceleration_gal if displacement_cm is None else -4.0 * displacement_cm
    return Motion.from_arrays(0.01 * (amplitude or 0.0) * np.sin(2.0 * t), 1e-4)


def _slip_start(motion: Motion, *, vertical: float = 0.0, slope_deg: float = 0.0) -> Callable[[], float]:
    """Return a function that computes the onset of sliding, s."""
    base = SlidingBase(MU, slope_deg=slope_deg)
    return lambda: solve_slide(base, motion, vertical=vertical, gravity=G).outcome.slip_start_s or math.nan


def _last_value(motion: Motion, channel: str, *, vertical: float = 0.0, slope_deg: float = 0.0) -> Callable[[], float]:
    """Return a function that computes the last value of a channel."""
    base = SlidingBase(MU, KAPPA * MU, slope_deg)
    return lambda: float(solve_slide(base, motion, vertical=vertical, gravity=G)[channel][-1])


def _final_slip(motion: Motion) -> Callable[[], float]:
    """Return a function that computes the final displacement of one-way sliding, m."""
    return lambda: solve_slide(SlidingBase(MU, one_way=True), motion, gravity=G).outcome.final_slip_m or math.nan


def _sine_response() -> Response[SlideOutcome]:
    """Return the response of the sine example, read such that it fits the figure."""
    return solve_slide(SlidingBase(0.2, 0.175), sine(60.0), gravity=G)


def _event_time(number: int) -> Callable[[], float]:
    """Return a function that computes the time of an event of the sine example, s."""
    return lambda: _sine_response().events[number].time_s


def _stopping_friction() -> float:
    """Return the static friction at which sliding just stops, by bisection."""

    def stops(mu: float) -> bool:
        return solve_slide(sliding_base(mu, kappa=KAPPA, slope_deg=TH), constant(-9.0), gravity=G).outcome.final_slip_m is not None

    return bisect_threshold(stops, math.tan(math.radians(TH)), 1.0)


def _holding_friction(horizontal: float, up: float, slope: float) -> float:
    """Return the static friction at which a triangular pulse just causes no sliding, by bisection."""
    pulse = np.array([0.0, 1.0, 0.0])
    motion = Motion.from_arrays(horizontal * G * pulse, 0.1, vertical=up * G * pulse)

    def slips(mu: float) -> bool:
        return solve_slide(sliding_base(mu, slope_deg=slope), motion, vertical=1.0, gravity=G).outcome.slips

    return bisect_threshold(slips, math.tan(math.radians(slope)), 5.0)


def _equation_15(alpha: float, ratio: float, slope: float) -> float:
    """Return [Fujino1978]_ eq. (15) as printed."""
    s, c = math.sin(math.radians(slope)), math.cos(math.radians(slope))
    return (s + alpha * (ratio * s - c)) / (c + alpha * (ratio * c + s))


def _steady_swing() -> float:
    """Return the simulated peak-to-peak displacement after the transient on a harmonic base, m."""
    t = 2e-4 * np.arange(250001)
    u = solve_slide(sliding_base(0.1, kappa=0.9), Motion.from_arrays(4.0 * np.sin(2.0 * math.pi * t), 2e-4), gravity=G)["displacement"]
    tail = u[u.size * 49 // 50 :]
    return float(tail.max() - tail.min())


TAN = math.tan(math.radians(TH))
COS, SIN = math.cos(math.radians(TH)), math.sin(math.radians(TH))
PHI = math.atan(MU)
HACHINOHE = (-169.75 / 980.0, 60.98 / 169.75)
"""The paper's alpha and mu of fig. 16."""

# relative acceleration of a slide that has started, from the corrected equations
LEVEL_PULL = -4.0 + KAPPA * MU * (G + UP)
SLOPE_PULL = G * SIN + 4.0 * COS - KAPPA * MU * (G * COS - 4.0 * SIN)
CITATION = "[Fujino1978]_ "

EQUATIONS = (
    Case("fujino-1", CITATION + "eq. (1)", "onset of sliding under an acceleration rising at 1 m/s^3: mu g", "s", float(slip_acceleration(MU, gravity=G)),
         1e-12, _slip_start(ramp()), note="no sliding at equality; sliding starts once the acceleration exceeds mu g"),
    Case("fujino-1-equal", CITATION + "eq. (1) against (5)", "displacement under an acceleration of exactly mu g", "m", 0.0, 0.0,
         lambda: solve_slide(sliding_base(MU, kappa=KAPPA), constant(MU * G), gravity=G).outcome.max_slip_m,
         note="eq. (1) has <=, eq. (5) has <; no sliding at equality here"),
    Case("fujino-2", CITATION + "eq. (2)", "relative acceleration, level base, no vertical motion", "m/s^2", -4.0 + KAPPA * MU * G, EXACT,
         _last_value(constant(4.0), "acceleration")),
    Case("fujino-3", CITATION + "eq. (3)", "relative velocity after 1 s", "m/s", -4.0 + KAPPA * MU * G, EXACT,
         _last_value(constant(4.0), "velocity")),
    Case("fujino-4", CITATION + "eq. (4)", "relative displacement after 1 s", "m", 0.5 * (-4.0 + KAPPA * MU * G), EXACT,
         _last_value(constant(4.0), "displacement"), note="the dot of z' in eq. (4) is missing in the scan"),
    Case("fujino-5", CITATION + "eq. (5)", "onset of sliding under rising acceleration with vertical motion: mu (g + y'')", "s", MU * (G - UP), 1e-12,
         _slip_start(ramp(up=-UP), vertical=1.0)),
    Case("fujino-6", CITATION + "eq. (6)", "relative acceleration with vertical motion", "m/s^2", LEVEL_PULL, EXACT,
         _last_value(constant(4.0, UP), "acceleration", vertical=1.0)),
    Case("fujino-7", CITATION + "eq. (7)", "relative velocity after 1 s with vertical motion", "m/s", LEVEL_PULL, EXACT,
         _last_value(constant(4.0, UP), "velocity", vertical=1.0)),
    Case("fujino-8", CITATION + "eq. (8)", "relative displacement after 1 s with vertical motion", "m", 0.5 * LEVEL_PULL, EXACT,
         _last_value(constant(4.0, UP), "displacement", vertical=1.0),
         note="the last term of eq. (8) must read -/+ rho_d y'_t0 (t - t0), as in eq. (13)"),
    Case("fujino-9", CITATION + "eq. (9)", "onset of uphill sliding under rising acceleration: g tan(th + atan mu)", "s",
         G * math.tan(math.radians(TH) + PHI), 1e-11, _slip_start(ramp(), slope_deg=TH), note="both components resolved along the slope"),
    Case("fujino-10", CITATION + "eq. (10)", "onset of downhill sliding under rising acceleration: g tan(atan mu - th)", "s",
         G * math.tan(PHI - math.radians(TH)), 1e-11, _slip_start(ramp(-1.0), slope_deg=TH)),
    Case("fujino-9-10", CITATION + "eqs. (9), (10)", "width of the acceleration band without sliding: 2 mu g cos th", "m/s^2",
         2.0 * MU * G * COS, EXACT, lambda: float(np.diff(slip_limits(TH, MU, gravity=G))[0])),
    Case("fujino-11", CITATION + "eq. (11)", "relative acceleration downhill", "m/s^2", SLOPE_PULL, EXACT,
         _last_value(constant(-4.0), "acceleration", slope_deg=TH),
         note="rho_s in eqs. (11)-(13) must be rho_d; its sign depends on which of eqs. (9), (10) was met"),
    Case("fujino-12", CITATION + "eq. (12)", "relative velocity downhill after 1 s", "m/s", SLOPE_PULL, EXACT,
         _last_value(constant(-4.0), "velocity", slope_deg=TH), note="eq. (12) lacks the initial velocity z'_t0"),
    Case("fujino-13", CITATION + "eq. (13)", "relative displacement downhill after 1 s", "m", 0.5 * SLOPE_PULL, EXACT,
         _last_value(constant(-4.0), "displacement", slope_deg=TH)),
    Case("fujino-14", CITATION + "eq. (14)", "static friction coefficient above which sliding stops: tan th / kappa", "1",
         min_friction_to_stop(TH, KAPPA), 1e-12, _stopping_friction),
    Case("fujino-15", CITATION + "eq. (15)", "eq. (15) as printed at 30 degrees with fig. 16's alpha and mu", "1",
         _equation_15(*HACHINOHE, 30.0), EXACT, lambda: float(min_friction_to_hold(30.0, HACHINOHE[0], HACHINOHE[0] * HACHINOHE[1])),
         note="computed as tan(th - atan(alpha/(1 + alpha mu)))"),
    Case("fujino-15-simulated", CITATION + "eq. (15)", "smallest friction coefficient without sliding under a pulse, alpha and mu of fig. 16, 30 degrees", "1",
         _equation_15(*HACHINOHE, 30.0), 1e-12, lambda: _holding_friction(HACHINOHE[0], HACHINOHE[0] * HACHINOHE[1], 30.0)),
    Case("fujino-sine-printed", CITATION + "sec. 2.2.2", "displacement under 60 sin 2t, taken as an acceleration in gal", "m", 0.0, 0.0,
         lambda: solve_slide(SlidingBase(0.2, 0.175), sine(None, 60.0), gravity=G).outcome.max_slip_m,
         note="the example as printed never slides: 60 gal is below 0.2 g"),
    Case("fujino-sine-printed-slides", CITATION + "fig. 4", "displacement of the example as printed, against fig. 4", "m", 0.2226306,
         0.01, lambda: solve_slide(SlidingBase(0.2, 0.175), sine(None, 60.0), gravity=G).outcome.max_slip_m, status="differs", today=(0.0, 0.0),
         note="misprint: fig. 4 shows sliding although 60 gal is below 0.2 g; a ground displacement of 60 sin 2t cm (240 gal) fits it"),
    *(
        Case(f"fujino-sine-{name}", CITATION + "fig. 4", f"sine example, {label}", "s", expected, 5e-6, _event_time(number),
             note="ground displacement 60 sin 2t cm; expected value: closed form", kind="derived")
        for number, (name, label, expected) in enumerate((
            ("start", "onset of first sliding", 0.47781), ("stop", "end of first sliding", 1.58117),
            ("start-2", "onset of second sliding", 2.04860), ("stop-2", "end of second sliding", 3.15197),
        ))
    ),
    Case("fujino-sine-slip", CITATION + "fig. 4", "sine example, displacement after the first sliding", "m", 0.2226306, 5e-8,
         lambda: float(_sine_response().events[1].after[0]), kind="derived", note="expected value: closed form"),
    Case("fujino-sine-back", CITATION + "sec. 2.2.2", "sine example, displacement after the second sliding: no ratcheting", "m", 0.0, CONVERGED,
         lambda: float(_sine_response().events[3].after[0])),
    Case("newmark-pulse", "[Newmark1965]_ rectangular pulse", "one-way displacement under 6 m/s^2 for 1 s", "m",
         pulse_slip(6.0, 1.0, MU * G), 1e-12, _final_slip(constant(-6.0))),
    Case("westermo-steady", "[WestermoUdwadia1983]_ steady sliding", "peak-to-peak displacement on a harmonic base, 4 m/s^2 at 1 Hz", "m",
         steady_slip(4.0, 1.0, 0.1, kappa=0.9, gravity=G) or math.nan, 2e-7, _steady_swing),
)  # fmt: skip
"""Cases on equations (1) to (15), the sine example, and two closed forms of other papers."""
