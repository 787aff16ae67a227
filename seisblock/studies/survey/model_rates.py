"""Overturning rate of a cemetery by each model of its stones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.edge_wear import DEFAULT_WEAR, SHARP_EDGES
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records import Motion
from seisblock.records._validation import Gain
from seisblock.studies.model_comparison import GRAVESTONES, PULSE, SHARP_BLOCK, WORN_BLOCK
from seisblock.studies.survey.limits import fitted_limits, rigid_limits
from seisblock.studies.survey.simulation import simulated_overturns


@dataclass(frozen=True)
class ModelRate:
    """Overturning rate by one model; the half sine with its frequency, Hz, and with worn or sharp edges."""

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
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> tuple[ModelRate, ...]:
    """Return the overturning rate of a cemetery by each model of its stones ([Furukawa2009]_ eq. (9), [Housner1963]_).

    Parameters
    ----------
    cemetery : Cemetery
        With reinforced stones only the gravestone criterion applies: a rigid block does not model dowels.
    pga, frequency : float, m/s^2 and Hz
        The shaking, for models in closed form.
    motion : Motion or None
        The shaking, for simulated models.
    width : float, m
        Width of stones of unknown width.
    vertical : bool, float or None
        True or a factor to apply the vertical component to simulated stones; None: where the record has one.
    gravity : float, m/s^2
    """
    rates = [ModelRate(GRAVESTONES, float(np.mean(pga > fitted_limits(cemetery, frequency))))]
    if cemetery.reinforced.any():
        return tuple(rates)
    share = float(np.mean(pga > rigid_limits(cemetery, frequency, inset=DEFAULT_WEAR, width=width, gravity=gravity)))
    rates.append(ModelRate(PULSE, share, frequency, worn=True))
    if motion is not None:
        for model, inset in ((WORN_BLOCK, DEFAULT_WEAR), (SHARP_BLOCK, SHARP_EDGES)):
            falls = simulated_overturns(cemetery, motion, inset=inset, width=width, vertical=vertical, gravity=gravity)
            rates.append(ModelRate(model, float(falls.mean())))
    return tuple(rates)
