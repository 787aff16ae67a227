"""Rows of an ensemble are single runs: every model that the engine follows, on random bodies and records, to the last bit."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.two_layer import load_two_layer
from seisblock.dynamics import integrate, integrate_many
from seisblock.models.jump import rocking
from seisblock.models.rock import model as rock
from seisblock.models.rock.params import rock_params
from seisblock.models.rock.simd import ROCKING_SIMD_MODEL
from seisblock.models.slide import model as slide
from seisblock.models.slide.solve import solve_slide
from seisblock.models.uplift import model as uplift
from seisblock.models.uplift.constants import ALL_CORNERS
from seisblock.records import Motion
from seisblock.studies.sliding import slide_study

RNG = np.random.default_rng(23)
RUNS = 12
G = 9.80665
KEYS = "slips", "slip_start_s", "max_slip_m", "max_slip_time_s", "residual_slip_m", "final_slip_m", "slip_count", "slides_at_end"


def shaking(width, peak, seconds=8.0):
    """Return smooth noise in three directions."""
    t = np.arange(round(seconds / 0.01)) * 0.01
    rows = [np.convolve(RNG.normal(size=t.size), np.hanning(width), "same") * np.sin(np.pi * t / seconds) for _ in range(3)]
    return Motion(np.array([share * peak * row / np.abs(row).max() for row, share in zip(rows, (1.0, 0.7, 0.4), strict=True)]), 0.01)


def slopes():
    """Return objects on slopes of either sign, some of them with a foot."""
    numbers = zip(RNG.uniform(0.2, 0.5, RUNS), RNG.uniform(0.5, 1.0, RUNS), RNG.uniform(-8.0, 8.0, RUNS), range(RUNS), strict=True)
    return [SlidingBase(mu, mu * kappa, slope, 0.05 if i % 3 == 0 else None) for mu, kappa, slope, i in numbers]


def springs():
    """Return blocks on springs, slender and wide."""
    return [
        SpringBlock.from_frequency(0.6, 0.6, h, frequency_vertical=f, beta=0.7) for h, f in zip([0.8, 1.4, 2.0], [8, 12, 20], strict=True)
    ]


def rows_of(name):
    """Return the model of single runs, that of many, their parameters, the first states and the first mode."""
    if name == "rock":
        blocks = [Block(w, h, centroid_offset=0.1 * w * k) for w, h, k in RNG.uniform([0.15, 0.6, -1], [0.5, 2.0, 1], (RUNS, 3))]
        p = [rock.parameters(rock_params(block, shaking(20, 1.0)), 0.01) for block in blocks]
        return rock.ROCKING, ROCKING_SIMD_MODEL, p, np.zeros(2), rock.REST
    if name == "slide":
        return slide.SLIDE, slide.SLIDE, [slide.parameters(base, G) for base in slopes()], np.zeros(4), slide.STICK
    if name == "uplift":
        bodies = springs()
        starts = np.array([uplift.static_state(body, G) for body in bodies])
        return uplift.UPLIFT, uplift.UPLIFT, uplift.parameters(bodies, G, 0.01), starts, ALL_CORNERS
    stones = [load_two_layer("chozusha")] * 3
    p = [rocking.rocking_parameters(stone, G, "both") for stone in stones]
    return rocking.ROCKING_MODEL, rocking.ROCKING_MODEL, p, np.zeros(2), rocking.REST


@pytest.mark.parametrize("name", ["rock", "slide", "uplift", "jump"])
@pytest.mark.parametrize(("width", "peak"), [(12, 7.0), (40, 9.0)])
def test_ensemble_rows_equal_single_runs(name, width, peak):
    """Ends, extrema, first events and counts, each row with factors of its own."""
    single, rows, p, starts, mode = rows_of(name)
    motion = shaking(width, peak)
    gains = np.column_stack([RNG.uniform(0.4, 1.3, len(p)), RNG.uniform(-0.3, 0.3, len(p)), RNG.uniform(0.0, 1.0, len(p))])
    result = integrate_many(rows, motion, p, starts, mode, gains=gains)
    assert result.n_events.any()
    for row in range(len(p)):
        first = integrate(single, motion, p[row], np.broadcast_to(starts, (len(p), starts.shape[-1]))[row], mode, gains=gains[row])
        np.testing.assert_array_equal(result.final[row], first.final)
        np.testing.assert_array_equal(result.extrema[row], first.extrema)
        assert (result.final_mode[row], result.end_time[row], result.n_events[row]) == (first.final_mode, first.end_time, first.n_events)
        np.testing.assert_equal(result.first_event_time[row], first.events[0].time if first.events else np.nan)


def test_sliding_study_equals_solve_slide():
    """Slips, their times, counts and where the object comes to rest are those that `solve_slide` gives of each combination."""
    motion = shaking(25, 5.0)
    points = slide_study([0.1, 0.2, 0.35], motion, kappa=[0.6, 1.0], slope_deg=[-4.0, 0.0, 4.0], vertical=[0.0, 1.0])
    assert {point.slips for point in points} == {True}
    for point in points:
        base = SlidingBase(point.mu, point.mu_kinetic, point.slope_deg)
        first = solve_slide(base, motion, vertical=point.vertical).outcome
        for key in (
            "slips",
            "slip_start_s",
            "max_slip_m",
            "max_slip_time_s",
            "residual_slip_m",
            "final_slip_m",
            "slip_count",
            "slides_at_end",
        ):
            assert getattr(point, key) == getattr(first, key), key
