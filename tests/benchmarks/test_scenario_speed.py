"""Speed of a scenario: records of its suite and runs of all objects."""

import numpy as np
import pytest

from seisblock.bodies.table import BodySpec
from seisblock.studies.scenario.assess import assess_scenario, scenario_bodies
from seisblock.studies.scenario.motions import ScenarioTarget, scenario_suite

OBJECTS, MOTIONS = 100, 40


def assess_collection():
    """Return the results of a hundred objects of many sizes in a scenario of 6 upper."""
    rng = np.random.default_rng(0)
    sizes = rng.uniform((0.15, 0.15, 0.3), (0.6, 0.6, 1.9), (OBJECTS, 3)).tolist()
    bodies, _ = scenario_bodies([BodySpec(str(i), {"width": w, "depth": d, "height": h}) for i, (w, d, h) in enumerate(sizes)])
    return assess_scenario(bodies, scenario_suite(ScenarioTarget(jma="6+"), MOTIONS)[0])


@pytest.mark.slow
def test_scenario_of_100_objects_under_40_motions(benchmark):
    """160 runs of each object along both horizontals, 32 000 runs with the records: at most 20 s of this process on all its cores."""
    results = benchmark.pedantic(assess_collection, rounds=1, warmup_rounds=0)
    assert len(results) == OBJECTS and all(result.runs == 160 for result in results)
    assert benchmark.stats is None or benchmark.stats.stats.min < 20.0
