"""Probabilities over plausible bodies and motions: Monte Carlo runs of a block or a pile, and perturbation of one rocking block."""

from seisblock.studies.respond.pile_probability import PileProbability, PileVariation, StoneProbability, stack_probability
from seisblock.studies.respond.probability import ParameterVariation, Probability, respond_probability
from seisblock.studies.rocking.perturb import Perturbation, Spread, perturb

__all__ = [
    "ParameterVariation",
    "Perturbation",
    "PileProbability",
    "PileVariation",
    "Probability",
    "Spread",
    "StoneProbability",
    "perturb",
    "respond_probability",
    "stack_probability",
]
