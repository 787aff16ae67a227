"""Uplift solver of a rigid block on corner springs under a three-component motion: `solve_uplift`."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core.options import keywords_of
from seisblock.core.results import Channel, Histories, Response, Status
from seisblock.dynamics import Trajectory, integrate
from seisblock.models.uplift.batch_results import CHANGE_FACTOR, batch_result, end_states
from seisblock.models.uplift.constants import ALL_CORNERS, FIRST, GLUED, F, U, X, Y
from seisblock.models.uplift.model import UPLIFT, parameters, rotations, static_state
from seisblock.models.uplift.options import UpliftOptions
from seisblock.models.uplift.outcome import UpliftOutcome, build_outcome, events, phases, warnings
from seisblock.records._validation import validate_inputs, vertical_gain
from seisblock.records.motion import Motion
from seisblock.references import papers


@keywords_of(UpliftOptions)
def solve_uplift(body: SpringBlock, motion: Motion, options: UpliftOptions) -> Response[UpliftOutcome]:
    """Solve the response of a block on corner springs to a three-component motion, from static equilibrium.

    Extends [Okumura1987]_ eq. (1) to records: the vertical spring and dashpot of a corner act only in compression, horizontal ones stay
    attached. Small rotations, no P-delta effect: the model cannot overturn.

    Parameters
    ----------
    body : SpringBlock
        Its damping is the ratio zeta of the corner dashpots, c = 2 zeta k / omega by direction.
    motion : Motion
        Ground acceleration along +x, across (+y) and up.
    options : keyword arguments
        Fields of :class:`~seisblock.models.uplift.options.UpliftOptions`.

    Returns
    -------
    Response of UpliftOutcome
        Channels: corner displacements ``uplift_1`` to ``uplift_4`` (m, positive upwards), ``contact_force_1`` to ``_4`` (N),
        ``displacement``, ``displacement_across``, ``displacement_up`` of the centre of gravity (m, relative to the ground; up from the
        natural length of the springs), and ``rotation``, ``rotation_across`` (rad, positive for a tilt to +x, +y).

    Raises
    ------
    SolverError
        If the integration fails.

    Examples
    --------
    >>> import numpy as np
    >>> shaking = 4.0 * np.sin(2 * np.pi * 1.5 * 0.01 * np.arange(400))
    >>> block = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707)
    >>> solve_uplift(block, Motion.from_arrays(shaking, 0.01)).outcome.uplifts
    True
    """
    validate_inputs(body, SpringBlock, motion)
    gravity, gains = options.gravity, (1.0, 1.0, vertical_gain(motion, options.vertical))
    p, start = parameters([body], gravity, motion.dt)[0], static_state(body, gravity)
    trajectory = integrate(UPLIFT, motion, p, start, ALL_CORNERS, gains=gains)
    linear = repeat = trajectory
    if trajectory.final[FIRST] > 0.0:
        # without uplift the run is the linear one, in which changes do not grow
        linear = integrate(UPLIFT, motion, p, start, GLUED, gains=gains, keep_path=False, keep_events=False)
        along, across, up = (CHANGE_FACTOR * gain for gain in gains)
        repeat = integrate(UPLIFT, motion, p, start, ALL_CORNERS, gains=(along, across, up), keep_path=False, keep_events=False)
    changed = repeat.extrema[np.newaxis], repeat.final[np.newaxis]
    results = batch_result([body], end_states(trajectory), linear.extrema[np.newaxis], *changed, gravity)
    return Response(
        model="uplift",
        outcome=build_outcome(body, motion, trajectory, results),
        motion=motion,
        body=body,
        make_histories=partial(_curves, body, motion, trajectory),
        phases=phases(motion, trajectory),
        events=events(motion, trajectory.events),
        options=replace(options, vertical=gains[2]),
        status=Status(trajectory.status),
        warnings=warnings(motion, results, 0),
        citations=papers("uplift"),
    )


def _curves(body: SpringBlock, motion: Motion, trajectory: Trajectory) -> Histories:
    """Return the time histories at samples and at both limits of each event."""
    time, states, _ = trajectory.table()
    theta_x, theta_y = rotations(states, body)
    channels = (
        *(Channel(f"uplift_{i + 1}", "m", states[:, U + i], f"u_{i + 1}") for i in range(4)),
        *(Channel(f"contact_force_{i + 1}", "N", body.mass * states[:, F + i], f"N_{i + 1}") for i in range(4)),
        Channel("displacement", "m", states[:, X], "x"),
        Channel("displacement_across", "m", states[:, Y], "y"),
        Channel("displacement_up", "m", states[:, U : U + 4].mean(axis=1), "z"),
        Channel("rotation", "rad", theta_y, "θy"),
        Channel("rotation_across", "rad", -theta_x, "−θx"),
    )
    return Histories(motion.start_s + time, channels)
