"""A pile's course through a motion: followed once for its fate, and once more for its curves where the motion is long."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from seisblock.dynamics.halt import heed
from seisblock.errors import ParameterError
from seisblock.limits import check_curves
from seisblock.records.motion import ACROSS, UP, Motion
from seisblock.results import Status
from seisblock.solvers.stack.arguments import BASE, KEPT_ROWS, PLACE, SAMPLE, STEPS_LEFT, PileCursor, PileKept, PileMemory, PileSettings
from seisblock.solvers.stack.arrays import PileArrays
from seisblock.solvers.stack.books import BOOKS, FALL_TIME, FATE, FLOOR, LEAN, LEAST_COSINE
from seisblock.solvers.stack.frames import Q, X, orient
from seisblock.solvers.stack.outcome import End, Track, stone_track
from seisblock.solvers.stack.rest import sink
from seisblock.solvers.stack.rigid_run import run_rigid
from seisblock.solvers.stack.round import RADIUS
from seisblock.solvers.stack.run import run_springs
from seisblock.typing import FloatArray

FALLEN_TILT = math.radians(60.0)
"""A stone that leans more than this, and more than its own critical angle, has fallen."""

FALLEN_DROP = 0.5
"""A stone whose centre has sunk by this part of its smallest size has fallen."""

AFTERWARDS = 10.0
"""Seconds that the ground may stand still after the record, until every stone is still."""

MOVED = 1e-5
LONGEST_GAP = 0.1
"""Movement, m and rad, and time, s, after which a row is kept."""

ENDS = 2
"""Rows of a course of which only the first and the last are kept."""

CURVES = 17
"""Numbers of each stone in a row of the curves, and of what they are made of."""

POINTS_AT_ONCE = 2_500_000
"""Contact points that are looked at before Python may be interrupted: 0.05 s or so."""


@dataclass(frozen=True, eq=False)
class Course:
    """What determines how a pile moves.

    Parameters
    ----------
    pile : PileArrays
    motion : Motion
    factors : (float, float)
        On the rows across and up.
    gravity : float, m/s^2
    steps : int
        Of a sampling interval.
    rigid : bool
        Whether contacts are rigid, or springs.
    stop_at_fall : bool
    tilts : mapping of str to float, rad
        Stones let go from a lean about y.
    """

    pile: PileArrays
    motion: Motion
    factors: tuple[float, float]
    gravity: float
    steps: int
    rigid: bool
    stop_at_fall: bool
    tilts: Mapping[str, float]

    @property
    def settings(self) -> PileSettings:
        """How the loop goes."""
        motion, quiet = self.motion, math.ceil(AFTERWARDS / self.motion.dt)
        gap, last = max(1, round(LONGEST_GAP / motion.dt)), motion.samples - 1
        return PileSettings(self.gravity, motion.dt, self.steps, self.stop_at_fall, MOVED, gap, last, last + quiet)

    def follow(self, rows: int | None = None, *, progress: Callable[[int, int], None] | None = None) -> End:
        """Follow the pile to the end.

        Parameters
        ----------
        rows : int or None
            How many are kept; None: all of a short motion, the first and the last of a long one.
        progress : callable
            Told now and then how many samples are done, and how many there are.

        Raises
        ------
        ParameterError
            If a stone that leans is none of the pile.
        """
        pile, settings = self.pile, self.settings
        if rows is None:
            rows = ENDS if self.motion.is_long else settings.last + 1
        memory = pile.memory()
        cursor = PileCursor(np.zeros(PLACE, dtype=np.int64), pile.bodies.copy())
        if not self.rigid:
            sink(pile, self.gravity, cursor.bodies, memory.stretches)
        kept = PileKept(
            fates=_fates(pile, cursor.bodies),
            rows=np.zeros((rows, 1 + 7 * len(pile.members))),
            last_touch=np.full((len(cursor.bodies), len(cursor.bodies)), -1.0),
            books=np.zeros(BOOKS),
        )
        for name, angle in self.tilts.items():
            _lean(pile, cursor.bodies, name, angle)
        status = self._run(settings, memory, cursor, kept, progress)
        found = int(cursor.place[KEPT_ROWS])
        way = kept.rows[: min(found, rows)].copy()
        time = float(cursor.place[SAMPLE]) * self.motion.dt
        return End(status, time, cursor.bodies, kept._replace(rows=way), found, stone_track(pile, way))

    def track(self, end: End) -> Track:
        """Return the way of the stones: as it was kept, else as it is followed again, to the same bits.

        Raises
        ------
        ParameterError
            If its curves would take more memory than they may.
        """
        if end.rows <= len(end.track.time):
            return end.track
        check_curves(end.rows, CURVES * len(self.pile.body.stones))
        return self.follow(end.rows).track

    def _stretches(self) -> Iterator[tuple[int, FloatArray]]:
        """Yield the shaking piece by piece, each with the number of its first sample; after the last sample the ground stands still."""
        still = np.zeros((3, self.settings.last + 1 - self.motion.samples))
        for stretch in self.motion.stretches((True, *(factor != 0.0 for factor in self.factors))):
            shaking = np.array(stretch.acceleration) if stretch.beyond else np.concatenate([stretch.acceleration, still], axis=1)
            shaking[[ACROSS, UP]] *= np.array(self.factors)[:, None]
            shaking.flags.writeable = False
            yield stretch.first, shaking

    def _run(
        self,
        settings: PileSettings,
        memory: PileMemory,
        cursor: PileCursor,
        kept: PileKept,
        progress: Callable[[int, int], None] | None,
    ) -> Status:
        """Follow the pile to the end, in slices between which Python may be interrupted."""
        pile, layout = self.pile, self.pile.layout
        slice_ = max(1, POINTS_AT_ONCE // (pile.grids.shape[0] * pile.points**2 + pile.pairs.shape[0]))
        status, run = Status.PAUSED, run_rigid if self.rigid else run_springs
        for first, shaking in self._stretches():
            cursor.place[BASE] = first
            last = first + shaking.shape[1] - 1
            while status == Status.PAUSED and (cursor.place[SAMPLE] < last or last == settings.last):
                heed()
                cursor.place[STEPS_LEFT] = slice_
                status = Status(run(shaking, settings, layout, memory, cursor, kept))
                if progress is not None and status == Status.PAUSED:
                    progress(min(int(cursor.place[SAMPLE]), settings.quiet), settings.quiet)
            if status != Status.PAUSED:
                break
        return status


def _fates(pile: PileArrays, bodies: FloatArray) -> FloatArray:
    """Return the rows in which the kernel notes the fate of each body."""
    fates = np.zeros((len(pile.members), FATE))
    fates[:, LEAST_COSINE] = 1.0
    fates[:, FALL_TIME] = -1.0
    for b, group in enumerate(pile.members):
        boxes = pile.boxes[list(group), :3]
        foot, rise = boxes[0, :2].max(), bodies[b, X + 2] - (pile.boxes[group[0], 5] + bodies[b, X + 2] - boxes[0, 2])
        fates[b, LEAN] = math.cos(max(FALLEN_TILT, math.atan2(foot, rise) + 0.1))
        fates[b, FLOOR] = bodies[b, X + 2] - FALLEN_DROP * 2.0 * boxes.min()
    return fates


def _lean(pile: PileArrays, bodies: FloatArray, name: str, angle: float) -> None:
    """Lean a body about y, over the outermost point of its lower joint."""
    if name not in pile.body.names or pile.owner[pile.body.names.index(name)] == len(pile.members):
        raise ParameterError("no free stone is called {name!r}; there are {names}", name=name, names=list(pile.body.names))
    b = int(pile.owner[pile.body.names.index(name)])
    first = pile.members[b][0]
    box = pile.boxes[first]
    far = pile.rims[first, 0, RADIUS] if pile.body.stones[first].is_round else pile.corners[first, 1, 0]
    pivot = np.array([math.copysign(far, angle), 0.0, -box[2]]) + box[3:]
    turned = np.array([math.cos(angle), math.sin(angle)])
    moved = np.array([turned[0] * pivot[0] + turned[1] * pivot[2], 0.0, -turned[1] * pivot[0] + turned[0] * pivot[2]])
    bodies[b, X : X + 3] += pivot - moved
    bodies[b, Q : Q + 4] = (math.cos(0.5 * angle), 0.0, math.sin(0.5 * angle), 0.0)
    orient(bodies[b])
