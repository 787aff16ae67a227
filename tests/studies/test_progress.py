"""Studies report how far they are: numbers that grow from 1 or more to the total, which is announced from the start."""

import math

import numpy as np
import pytest

from seisblock import Block, Motion, Record, RespondOptions, SpringBlock, read
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.records import motion_of
from seisblock.studies.batch.run import run_batch
from seisblock.studies.fragility.run import run_fragility
from seisblock.studies.map.stations import survey_stations
from seisblock.studies.respond.probability import respond_probability
from seisblock.studies.rocking.margin import find_margin
from seisblock.studies.rocking.perturb import perturb
from seisblock.studies.survey.scale_search import scale_factors
from seisblock.studies.survey.simulation import sampled_overturns, simulated_curve
from seisblock.studies.uplift_regions import uplift_regions

MOTION = motion_of(read("elcentro_1940_ns.csv"), "NS")
MOTION = Motion(MOTION.acceleration[:, :400], MOTION.dt)
RECORD = Record.from_arrays({"NS": MOTION.horizontal}, dt=MOTION.dt)
BLOCK, CEMETERY = Block(0.2, 0.8), read_cemetery("aoyama.csv")
SPRINGS = SpringBlock.from_frequency(0.6, 0.6, 1.2, frequency_vertical=12.0, beta=0.7)

STUDIES = {
    "batch": lambda progress: run_batch([RECORD] * 3, [0.1, 0.2], "slide", progress=progress),
    "fragility": lambda progress: run_fragility([RECORD] * 2, BLOCK, "rock", perturb=9, bootstrap=10, progress=progress),
    "margin": lambda progress: find_margin(BLOCK, MOTION, limit=3.0, step=0.1, progress=progress),
    "perturb": lambda progress: perturb(BLOCK, MOTION, 30, progress=progress),
    "respond": lambda progress: respond_probability(BLOCK, MOTION, RespondOptions(mu=0.5), runs=30, progress=progress),
    "rates of a scaled record": lambda progress: simulated_curve(CEMETERY, [((MOTION,), 4.0)] * 2, (2.0, 4.0), progress=progress),
    "samples of stones": lambda progress: sampled_overturns(CEMETERY, MOTION, 4, progress=progress),
    "scale factor": lambda progress: scale_factors(lambda factor: factor, 0.3, MOTION, steps=5, progress=progress),
    "stations": lambda progress: survey_stations([RECORD] * 3, progress=progress),
    "uplift regions": lambda progress: uplift_regions([(SPRINGS, 0.0, 90.0)] * 3, np.array([0.5, 1.5]), progress=progress),
}


@pytest.mark.parametrize("study", STUDIES)
def test_progress_ends_at_the_announced_total(study):
    """The first report follows the first piece of work, the last one all of it."""
    reports = []
    STUDIES[study](lambda completed, total: reports.append((completed, total)))
    completed, totals = zip(*reports, strict=True)
    assert completed[0] >= 1 and math.isfinite(totals[0])
    assert all(np.diff(completed) > 0)
    assert completed[-1] == totals[-1]
