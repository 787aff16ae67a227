"""Probabilities over plausible bodies and motions: samples of a block or a pile, their summaries, and the assessment of an object."""

from seisblock.studies.assessment import Assessment, ModelVerdict, assess
from seisblock.studies.respond.pile_probability import PileProbability, StoneProbability, stack_probability
from seisblock.studies.respond.probability import Probability, respond_probability
from seisblock.studies.rocking.perturb import Perturbation, perturb
from seisblock.studies.sampling import ParameterVariation, Samples, sample

__all__ = [
    "Assessment",
    "ModelVerdict",
    "ParameterVariation",
    "Perturbation",
    "PileProbability",
    "Probability",
    "Samples",
    "StoneProbability",
    "assess",
    "perturb",
    "respond_probability",
    "sample",
    "stack_probability",
]
