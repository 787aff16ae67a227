"""Validation against Fujino, Sasaki and Hakuno (1978): sliding of a rigid mass with friction."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from seisblock.bodies.sliding_base import SlidingBase, sliding_base
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.criteria.sliding import min_friction_to_hold, min_friction_to_stop, pulse_slip, slip_acceleration, slip_limits, steady_slip
from seisblock.measures import ground_history
from seisblock.models.slide.solve import SlideOutcome, solve_slide
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from seisblock.records.process import highpass, scale_to_pga
from seisblock.studies.sliding import SlidePoint, slide_study
from seisblock.validation.bisection import bisect_threshold
from seisblock.validation.case import CONVERGED, EXACT, Case

CITATION = "[Fujino1978]_ "
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


COS, SIN = math.cos(math.radians(TH)), math.sin(math.radians(TH))
PHI = math.atan(MU)
HACHINOHE = (-169.75 / 980.0, 60.98 / 169.75)
"""The paper's alpha and mu of fig. 16."""

# relative acceleration of a slide that has started, from the corrected equations
LEVEL_PULL = -4.0 + KAPPA * MU * (G + UP)
SLOPE_PULL = G * SIN + 4.0 * COS - KAPPA * MU * (G * COS - 4.0 * SIN)
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


PGA = 2.4527
FRICTION = np.round(np.arange(0.05, 0.2001, 0.005), 4)
RATIOS = (0.333, 0.5, 0.75, 1.0)
SLOPES = np.arange(0.0, 30.0, 0.25)
FIG_17_SLOPES = np.arange(0.0, 41.0, 1.0)
BASELINE_HZ = 0.15
"""Corner of the high-pass that gives PGV and PGD of El Centro in [Fujino1978]_ table 1."""

RECORD_NOTE = "bundled El Centro 1940 NS, 245.27 gal (paper: own digitisation)"
BASELINE_NOTE = "bundled El Centro 1940 NS, high-passed at 0.15 Hz, 245.27 gal (paper: own digitisation)"
TAFT_NOTE = "bundled El Centro 1940 NS, 245.27 gal (paper: Taft)"
HACHINOHE_NOTE = "bundled El Centro 1940 NS, 245.27 gal (paper: Hachinohe)"


@functools.cache
def el_centro() -> Motion:
    """Return the bundled record at the paper's peak acceleration."""
    return motion_of(scale_to_pga(read("elcentro_1940_ns"), PGA), "NS")


@functools.cache
def el_centro_baseline() -> Motion:
    """Return the bundled record with the paper's baseline: high-passed at 0.15 Hz, then scaled to its peak acceleration."""
    return motion_of(scale_to_pga(highpass(read("elcentro_1940_ns"), BASELINE_HZ), PGA), "NS")


def slip_curves(motion: Motion) -> FloatArray:
    """Return the largest displacement of fig. 7, (31 friction coefficients, 4 ratios), m."""
    points = slide_study(FRICTION.tolist(), motion, kappa=RATIOS, vertical=False, gravity=G)
    return np.array([point.max_slip_m for point in points]).reshape(FRICTION.size, len(RATIOS))


@functools.cache
def largest_slips() -> FloatArray:
    """Return the displacements of fig. 7 under the bundled record with the paper's baseline, m."""
    return slip_curves(el_centro_baseline())


def _ground_peak(quantity: str) -> float:
    """Return PGV, m/s, or PGD, m, of the record with the paper's baseline ([Fujino1978]_ table 1)."""
    motion = el_centro_baseline()
    return float(np.abs(getattr(ground_history(motion.horizontal, motion.dt), quantity)).max())


@functools.cache
def slope_points(mu: float) -> tuple[SlidePoint, ...]:
    """Return the points of fig. 15 under the bundled record for one friction coefficient."""
    return slope_curve(el_centro(), mu)


def slope_curve(motion: Motion, mu: float) -> tuple[SlidePoint, ...]:
    """Return the points of fig. 15 for one friction coefficient: a slope of 1 m, level ground beyond, kappa = 0.5."""
    points = slide_study(mu, motion, kappa=0.5, slope_deg=SLOPES.tolist(), slope_length=1.0, vertical=False, gravity=G)
    return tuple(point for point in points if point.holds_at_rest)


def _grows_with_smaller_ratio() -> float:
    """Return the share of neighbouring ratios for which the smaller one gives the larger displacement."""
    slip = largest_slips()
    return float((slip[:, :-1] > slip[:, 1:]).mean())


def _falls_with_friction(ratio: int) -> float:
    """Return the share of steps in friction over which the displacement decreases."""
    return float((np.diff(largest_slips()[:, ratio]) < 0.0).mean())


def _halfway(mu: float) -> float:
    """Return the share of slopes on which the object stops between 0.2 m and the foot at 1 m."""
    return float(np.mean([0.2 < (point.final_slip_m or 0.0) < 1.0 for point in slope_points(mu)]))


def _past_foot(mu: float) -> tuple[FloatArray, FloatArray]:
    """Return slopes and final displacements of the objects that passed the foot."""
    fallen = [(point.slope_deg, point.final_slip_m or math.nan) for point in slope_points(mu) if point.fell_off_slope]
    angle, slip = np.array(fallen).T
    return angle, slip


def _correlation(mu: float) -> float:
    """Return the correlation of final displacement and slope beyond the foot."""
    return float(np.corrcoef(*_past_foot(mu))[0, 1])


def _rate(mu: float) -> float:
    """Return the increase of the final displacement with the slope beyond the foot, m per degree."""
    return float(np.polyfit(*_past_foot(mu), 1)[0])


def _critical(slope: float) -> float:
    """Return the critical friction of fig. 16 under the bundled record."""
    return critical_friction(el_centro(), slope)


def critical_friction(motion: Motion, slope: float, *, vertical: bool = False) -> float:
    """Return the largest friction with which the object slides over 2 m down a slope of fig. 16, kappa = 0.5; NaN if none does."""
    points = slide_study(np.arange(0.05, 1.6, 0.005).tolist(), motion, kappa=0.5, slope_deg=slope, vertical=vertical, gravity=G)
    slides = [p.mu for p in points if p.holds_at_rest and (p.final_slip_m is None or (p.max_slip_m or 0.0) > 2.0)]
    return max(slides, default=math.nan)


def _criterion(slope: float) -> float:
    """Return the criterion of fig. 16 under the bundled record."""
    return slope_criterion(el_centro(), slope)


def slope_criterion(motion: Motion, slope: float) -> float:
    """Return the smaller of [Fujino1978]_ eqs. (14) and (15), the latter at the most unfavourable instant of the record."""
    return min(min_friction_to_stop(slope, 0.5), float(min_friction_to_hold(slope, motion.horizontal / G).max()))


def _width_ratio(slope: float) -> float:
    """Return the width between mu = +-0.5 at alpha 0.4 over that between mu = +-1 at alpha 0.2, both y'' = 0.2 g ([Fujino1978]_ fig. 17)."""
    widths = [np.ptp([float(min_friction_to_hold(slope, -alpha, sign * 0.2)) for sign in (-1.0, 1.0)]) for alpha in (0.4, 0.2)]
    return float(widths[0] / widths[1])


_shape = functools.partial(Case, kind="rebuilt")
"""Case on the trend of a figure, with another record than the paper's."""

FIGURES = (
    _shape("fujino-fig7-kappa", CITATION + "fig. 7", "share of neighbouring kappa for which the smaller one slides further", "1", 1.0, 0.1,
         _grows_with_smaller_ratio, note="paper: in general, the smaller kappa, the larger the displacement; " + BASELINE_NOTE),
    _shape("fujino-fig7-monotone", CITATION + "fig. 7", "share of steps in mu over which the displacement decreases, kappa = 1", "1", 1.0, 0.1,
         lambda: _falls_with_friction(3), note="paper: almost uniform increase with decreasing mu for kappa near 1; " + BASELINE_NOTE),
    _shape("fujino-fig7-uneven", CITATION + "fig. 7", "kappa = 0.333: displacement decreases in at least 90 % of the steps in mu (1: yes)", "1", 0.0,
         0.0, lambda: float(_falls_with_friction(0) >= 0.9), note="paper: not monotone for small kappa; " + BASELINE_NOTE),
    _shape("fujino-fig7-peak", CITATION + "fig. 7", "static friction coefficient of the largest displacement, kappa = 0.333, the paper's baseline",
         "1", 0.15, 0.02, lambda: float(FRICTION[largest_slips()[:, 0].argmax()]),
         note="bundled El Centro 1940 NS high-passed at 0.15 Hz, which gives PGV and PGD of table 1; 0.05 without this filter"),
    _shape("fujino-table1-pgv", CITATION + "table 1", "PGV of El Centro with the paper's baseline", "m/s", 0.2475, 0.01,
         functools.partial(_ground_peak, "velocity"), note="corner of 0.15 Hz chosen for PGV and PGD of this table"),
    _shape("fujino-table1-pgd", CITATION + "table 1", "PGD of El Centro with the paper's baseline", "m", 0.0713, 0.006,
         functools.partial(_ground_peak, "displacement"), note="corner of 0.15 Hz chosen for PGV and PGD of this table"),
    Case("fujino-fig17-width", CITATION + "fig. 17", "width of the critical friction at alpha 0.4 over that at alpha 0.2, y'' = 0.2 g, 30 degrees (1: larger)",
         "1", 1.0, 0.0, lambda: float(_width_ratio(30.0) > 1.0), note="paper: with the same y'' the larger alpha has the larger width"),
    Case("fujino-fig17-slope", CITATION + "fig. 17", "correlation of critical friction and slope, mu = 0, alpha 0.2", "1", 1.0, 0.01,
         lambda: float(np.corrcoef(FIG_17_SLOPES, [float(min_friction_to_hold(t, -0.2)) for t in FIG_17_SLOPES])[0, 1]),
         note="paper: nearly linear; tolerance chosen here"),
    *(
        _shape(f"fujino-fig15-either-or-{mu}", CITATION + "fig. 15", f"share of slopes with a final displacement of 0.2 to 1 m, mu = {mu}", "1", 0.0, 0.04,
             functools.partial(_halfway, mu), note="paper: either cracks or complete sliding; " + TAFT_NOTE)
        for mu in (0.3, 0.4, 0.5, 0.6)
    ),
    *(
        _shape(f"fujino-fig15-linear-{mu}", CITATION + "fig. 15", f"correlation of displacement and slope beyond the foot, mu = {mu}", "1", 1.0, 0.1,
             functools.partial(_correlation, mu), note="paper: nearly proportional to the slope; " + TAFT_NOTE)
        for mu in (0.2, 0.3, 0.4, 0.5, 0.6)
    ),
    _shape("fujino-fig15-rate", CITATION + "fig. 15", "rates of increase beyond the foot in decreasing order for mu = 0.2, 0.4, 0.6 (1: yes)", "1", 1.0,
         0.0, lambda: float(_rate(0.2) > _rate(0.4) > _rate(0.6)), note="paper: the smaller mu, the larger the rate; " + RECORD_NOTE),
    *(
        _shape(f"fujino-fig16-{slope}", CITATION + "fig. 16", f"critical friction over the smaller of eqs. (14), (15), {slope:g} degrees", "1", 1.0,
             tolerance, lambda slope=slope: _critical(slope) / _criterion(slope),  # type: ignore[misc]
             note="the simulation approaches both criteria from below, except near their crossing; " + HACHINOHE_NOTE)
        for slope, tolerance in ((4.0, 0.02), (8.0, 0.02), (28.0, 0.02), (36.0, 0.02))
    ),
    _shape("fujino-fig16-below", CITATION + "fig. 16", "critical friction below both criteria at 12, 16 and 20 degrees, near their crossing (1: yes)",
         "1", 1.0, 0.0, lambda: float(all(_critical(slope) < _criterion(slope) for slope in (12.0, 16.0, 20.0))),
         note="a single exceedance does not cause 2 m of sliding there; " + HACHINOHE_NOTE),
)  # fmt: skip
"""Cases on figures 7, 15 and 16."""


CASES = (*EQUATIONS, *FIGURES)
"""All cases of this paper."""
