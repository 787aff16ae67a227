"""Computations that tests repeat: of commands in both languages, with and without an option of the output, on pages and in examples."""

import functools
import hashlib
import importlib
import inspect
import io
import pickle
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

FUNCTIONS = (
    "models.respond.batch.respond_many",
    "models.rigid3d.solve.solve_rigid3d",
    "models.stack.solve.solve_stack",
    "measures.rotd.rotated_spectrum",
    "measures.summary.measure",
    "studies.assessment.assess_direction",
    "studies.criteria_comparison.compare_criteria",
    "studies.fit.fit.fit_block",
    "studies.fragility.run.run_fragility",
    "studies.model_comparison.compare_models",
    "studies.respond.azimuths.respond_directions",
    "studies.respond.mode_map.mode_map",
    "studies.respond.pile_probability.stack_probability",
    "studies.respond.probability.respond_probability",
    "studies.rocking.margin.find_margin",
    "studies.rocking.spectrum.rocking_spectrum",
    "studies.rocking.verdicts.parallel_verdicts",
    "studies.scenario.assess.assess_scenario",
    "studies.scenario.secure.find_measures",
    "studies.sliding.slide_study",
    "studies.survey.assessment.assess_cemetery",
    "studies.survey.assessment.assess_record",
    "studies.survey.estimate.estimate_shaking",
    "studies.survey.simulation.sampled_overturns",
    "studies.survey.simulation.simulated_overturns",
    "studies.survey.twist.infer_twist",
    "studies.uplift_regions.uplift_regions",
)
"""Functions whose results follow from their arguments; none of them prints or warns."""


def key_of(name: str, arguments: dict[str, object]) -> bytes | None:
    """Return a digest of a call without its callback for progress; None where an argument cannot be compared by value."""
    stream = io.BytesIO()
    pickler = pickle.Pickler(stream)
    pickler.fast = True  # without references to equal objects, which differ between equal calls
    try:
        pickler.dump((name, {parameter: value for parameter, value in arguments.items() if parameter != "progress"}))
    except (pickle.PicklingError, AttributeError, TypeError):
        return None
    return hashlib.sha256(stream.getvalue()).digest()


def remember(name: str, function: Callable, results: dict[bytes, object]) -> Callable:
    """Return a function that computes the result of equal calls once."""
    signature = inspect.signature(function)

    @functools.wraps(function)
    def call(*args, **kwargs):
        key = key_of(name, signature.bind(*args, **kwargs).arguments)
        if key is None:
            return function(*args, **kwargs)
        if key not in results:
            results[key] = function(*args, **kwargs)
        return results[key]

    return call


@contextmanager
def computing_once() -> Iterator[None]:
    """Compute the results of equal calls of the functions once, wherever these were imported; forget them in the end."""
    results: dict[bytes, object] = {}
    with pytest.MonkeyPatch.context() as patch:
        for name in FUNCTIONS:
            module, _, attribute = f"seisblock.{name}".rpartition(".")
            function = getattr(importlib.import_module(module), attribute)
            replacement = remember(name, function, results)
            for importer in [value for key, value in sys.modules.items() if key.startswith("seisblock.") and value is not None]:
                if vars(importer).get(attribute) is function:
                    patch.setattr(importer, attribute, replacement)
        yield
