"""Which share of a cemetery falls by each model of its stones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH, Cemetery
from seisblock.bodies.inset import SHARP, WORN
from seisblock.records import Motion
from seisblock.studies.agreement import GRAVESTONES, PULSE, SHARP_BLOCK, WORN_BLOCK
from seisblock.studies.cemetery.limits import fitted_limits, rigid_limits
from seisblock.studies.cemetery.simulated import simulated_overturns
from seisblock.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class RateOpinion:
    """Which share of a cemetery falls by one model: of the half sine with its frequency, Hz, on edges worn or not."""

    model: str
    rate: float
    frequency_hz: float | None = None
    worn: bool | None = None


def rates_by_model(
    cemetery: Cemetery,
    pga: float,
    frequency: float,
    motion: Motion | None = None,
    *,
    width: float = PAPER_WIDTH,
    gravity: float = STANDARD_GRAVITY,
) -> tuple[RateOpinion, ...]:
    """Return which share of a cemetery falls by each model of its stones ([Furukawa2009]_ eq. (9), [Housner1963]_).

    Parameters
    ----------
    cemetery : Cemetery
        With reinforced stones only the criterion made for them is asked: a rigid block knows no dowel.
    pga, frequency : float, m/s^2 and Hz
        The shaking, for the models that have a closed form.
    motion : Motion or None
        The shaking itself, for those that are simulated.
    width : float, m
        Of stones whose width is not known.
    gravity : float, m/s^2
    """
    found = [RateOpinion(GRAVESTONES, float(np.mean(pga > fitted_limits(cemetery, frequency))))]
    if cemetery.reinforced.any():
        return tuple(found)
    share = float(np.mean(pga > rigid_limits(cemetery, frequency, inset=WORN, width=width, gravity=gravity)))
    found.append(RateOpinion(PULSE, share, frequency, worn=True))
    if motion is not None:
        for model, inset in ((WORN_BLOCK, WORN), (SHARP_BLOCK, SHARP)):
            falls = simulated_overturns(cemetery, motion, inset=inset, width=width, gravity=gravity)
            found.append(RateOpinion(model, float(falls.mean())))
    return tuple(found)
