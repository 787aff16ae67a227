"""Whether a record holds the isolated jumps of overwritten pieces."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from seisblock.records import Component

REACH = 10
FLOOR = 0.05  # m/s^2 in one sample
RATIO = 15.0


def isolated_jumps(component: Component, dt: float) -> list[str]:
    """Return a sentence when steps between neighbouring samples stand out from the ten steps on either side.

    Notes
    -----
    JMA announced on 2015-12-04 that very short pieces of some published records were overwritten by what came 2 s later. Both ends of such
    a piece are steps of more than 5 gal that are at least 15 times the median step before it and after it. They are told, never repaired.
    """
    step = np.abs(np.diff(component.acceleration))
    if step.size < 2 * REACH + 1:
        return []
    padded = np.pad(step, REACH, mode="reflect")
    total = np.concatenate(([0.0], np.cumsum(padded)))
    mean = (total[2 * REACH + 1 :] - total[: -2 * REACH - 1]) / (2 * REACH + 1)
    # a sieve: a lone step is 21 times its window's mean, one of three is 7 times
    candidates = np.flatnonzero((step > FLOOR) & (step > 4.0 * mean))
    if not candidates.size:
        return []
    windows = sliding_window_view(padded, REACH)
    before = np.median(windows[candidates], axis=1)
    after = np.median(windows[candidates + REACH + 1], axis=1)
    jumps = candidates[step[candidates] > RATIO * np.maximum(before, after)]
    if not jumps.size:
        return []
    times = ", ".join(f"{(i + 1) * dt:.2f}" for i in jumps[:5]) + (", ..." if jumps.size > 5 else "")
    return [
        f"{component.code} holds {jumps.size} isolated jump{'s' if jumps.size > 1 else ''} (at {times} s): "
        "possibly the overwritten pieces that JMA announced on 2015-12-04; the samples are kept as they are"
    ]
