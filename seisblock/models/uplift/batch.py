"""Batch solver of uplift: many blocks on corner springs, or one block at many gains, under one motion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.typing import ArrayLike
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.dynamics import integrate_many
from seisblock.models.uplift.batch_results import CHANGE_FACTOR, UpliftBatchResult, batch_end_states, batch_result
from seisblock.models.uplift.constants import ALL_CORNERS, FIRST, GLUED
from seisblock.models.uplift.model import UPLIFT, parameters, static_state
from seisblock.records._validation import gain_rows, validate_motion
from seisblock.records.motion import Motion


def uplift_many(
    bodies: Sequence[SpringBlock], motion: Motion, *, gains: ArrayLike = (1.0, 1.0, 1.0), gravity: float = STANDARD_GRAVITY
) -> UpliftBatchResult:
    """Solve many blocks on corner springs under one motion, bit by bit as single runs ([Okumura1987]_).

    An abandoned run is marked in `gave_up` of the result.

    Parameters
    ----------
    bodies : sequence of SpringBlock
        One per row, or a single one for all.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows along, across and up.
    gravity : float, m/s^2

    Returns
    -------
    UpliftBatchResult

    Examples
    --------
    >>> from seisblock.models import uplift_many
    >>> import numpy as np
    >>> shaking = 4.0 * np.sin(2 * np.pi * 1.5 * 0.01 * np.arange(400))
    >>> block = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707)
    >>> uplift_many([block], Motion.from_arrays(shaking, 0.01), gains=[(0.2, 0.0, 0.0), (1.0, 0.0, 0.0)]).uplifts.tolist()
    [False, True]
    """
    validate_motion(motion)
    checks.gravity(gravity)
    if not len(bodies):
        raise ParameterError("`bodies` is empty: at least one body is required")
    for body in bodies:
        checks.instance(body, SpringBlock)
    rows = gain_rows(gains, None if len(bodies) == 1 else len(bodies))
    runs = max(len(bodies), len(rows))
    all_bodies = list(bodies) * runs if len(bodies) == 1 else list(bodies)
    p, initial_states = parameters(bodies, gravity, motion.dt), np.array([static_state(body, gravity) for body in all_bodies])
    p = np.repeat(p, runs, axis=0) if len(bodies) == 1 else p
    ensemble = integrate_many(UPLIFT, motion, p, initial_states, ALL_CORNERS, gains=rows, allow_failures=True)
    gave_up, linear = ensemble.failed.copy(), ensemble.extrema.copy()
    changed_extrema, changed_final = ensemble.extrema.copy(), ensemble.final.copy()
    lifted = np.flatnonzero(ensemble.final[:, FIRST] > 0.0)
    if len(lifted):
        # without uplift a run is the linear one, in which changes do not grow
        gains_lifted = rows if len(rows) == 1 else rows[lifted]
        changed, bonded = (
            integrate_many(UPLIFT, motion, p[lifted], initial_states[lifted], mode, gains=factor * gains_lifted, allow_failures=True)
            for factor, mode in ((CHANGE_FACTOR, ALL_CORNERS), (1.0, GLUED))
        )
        changed_extrema[lifted], changed_final[lifted], linear[lifted] = changed.extrema, changed.final, bonded.extrema
        gave_up[lifted] |= changed.failed | bonded.failed
    return batch_result(all_bodies, batch_end_states(ensemble), linear, changed_extrema, changed_final, gravity, gave_up)
