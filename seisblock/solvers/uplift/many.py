"""Many blocks on corner springs, or one under many factors, side by side through one motion: no Python between the samples."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seisblock import checks
from seisblock.bodies.spring_block import SpringBlock
from seisblock.dynamics import follow_many
from seisblock.errors import ParameterError
from seisblock.records.given import check_motion
from seisblock.records.motion import Motion
from seisblock.solvers.uplift.fates import UpliftFates, ends_of_many, fates_of
from seisblock.solvers.uplift.model import GLUED, UPLIFT, UPLIFT_AGAIN, WHOLE_BASE, at_rest, parameters
from seisblock.typing import ArrayLike
from seisblock.units import STANDARD_GRAVITY


def uplift_many(
    bodies: Sequence[SpringBlock], motion: Motion, *, gains: ArrayLike = (1.0, 1.0, 1.0), gravity: float = STANDARD_GRAVITY
) -> UpliftFates:
    """Return the fates of many blocks on corner springs under one motion; bit by bit those of single runs ([Okumura1987]_).

    A run that has to be given up is marked in the fates.

    Parameters
    ----------
    bodies : sequence of SpringBlock
        One per row, or a single one for all.
    motion : Motion
    gains : (3,) or (m, 3) array
        Factors on the motion's rows along, across and up.
    gravity : float, m/s^2

    Examples
    --------
    >>> import numpy as np
    >>> shaking = 4.0 * np.sin(2 * np.pi * 1.5 * 0.01 * np.arange(400))
    >>> block = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707)
    >>> uplift_many([block], Motion.from_arrays(shaking, 0.01), gains=[(0.2, 0.0, 0.0), (1.0, 0.0, 0.0)]).uplifts.tolist()
    [False, True]
    """
    check_motion(motion)
    checks.gravity(gravity)
    if not len(bodies):
        raise ParameterError("an ensemble needs at least one row")
    for body in bodies:
        checks.instance(body, SpringBlock)
    rows = np.atleast_2d(np.asarray(gains, dtype=np.float64))
    runs = max(len(bodies), len(rows))
    each = list(bodies) * runs if len(bodies) == 1 else list(bodies)
    p, starts = np.array([parameters(body, gravity) for body in each]), np.array([at_rest(body, gravity) for body in each])
    shaken, again, glued = (
        follow_many(model, motion, p, starts, mode, gains=rows, allow_failures=True)
        for model, mode in ((UPLIFT, WHOLE_BASE), (UPLIFT_AGAIN, WHOLE_BASE), (UPLIFT, GLUED))
    )
    gave_up = shaken.failed | again.failed | glued.failed
    return fates_of(each, ends_of_many(shaken), glued.extrema, again.extrema, gravity, gave_up)
