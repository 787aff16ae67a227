"""Whether a record holds the isolated jumps of overwritten pieces."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from seisblock.records import Component

REACH, GUARD = 10, 2
FLOOR = 0.05  # m/s^2 in one sample
RATIO = 25.0


def isolated_jumps(component: Component, dt: float) -> list[str]:
    """Return a sentence when a step between neighbouring samples stands out from the steps on either side.

    Notes
    -----
    JMA announced on 2015-12-04 that very short pieces of some published records were overwritten by what came 2 s later. An end of
    such a piece is a step that differs from the mean of its two neighbours by more than 5 gal and by 25 times the median such
    difference of the ten steps before it, and of the ten after it. Jumps are told, never repaired; in records rich in high
    frequencies they can hide.
    """
    step = np.diff(component.acceleration)
    if step.size < 2 * (REACH + GUARD) + 3:
        return []
    surprise = np.abs(step[1:-1] - 0.5 * (step[:-2] + step[2:]))
    margin = REACH + GUARD
    padded = np.pad(surprise, margin, mode="reflect")
    total = np.concatenate(([0.0], np.cumsum(padded)))
    mean = (total[2 * margin + 1 :] - total[: -2 * margin - 1]) / (2 * margin + 1)
    # a sieve: a lone jump, with half of it on either side, is 12 times its window's mean, one of three 4 times
    candidates = np.flatnonzero((surprise > FLOOR) & (surprise > 3.0 * mean))
    windows = sliding_window_view(padded, REACH)
    floor = np.zeros(candidates.size)
    if candidates.size:
        floor = np.maximum(np.median(windows[candidates], axis=1), np.median(windows[candidates + margin + GUARD + 1], axis=1))
    jumps = candidates[surprise[candidates] > RATIO * floor]
    if not jumps.size:
        return []
    times = ", ".join(f"{(i + 2) * dt:.2f}" for i in jumps[:5]) + (", ..." if jumps.size > 5 else "")
    return [
        f"{component.code} holds {jumps.size} isolated jump{'s' if jumps.size > 1 else ''} (at {times} s): "
        "possibly the overwritten pieces that JMA announced on 2015-12-04; the samples are kept as they are"
    ]
