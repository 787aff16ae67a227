"""Damaged lists, surveys, hazards, fragilities, outcomes and scans give sensible values, or one sentence with the reason."""

from __future__ import annotations

import json

import numpy as np
import pytest

from seisblock.bodies.scan.azimuths import scan_azimuths
from seisblock.bodies.scan.scan import scan_body
from seisblock.bodies.table import read_bodies
from seisblock.samples import sample_path
from seisblock.studies.fit.outcome_table import read_outcomes
from seisblock.studies.fragility.io import read_fragility
from seisblock.studies.hazard.table import read_hazard
from seisblock.studies.map.surveyed_places import read_surveys
from tests.bodies.meshes import box, write_obj, write_ply, write_stl
from tests.fuzz.accidents import spoil
from tests.fuzz.test_batch import LIST
from tests.fuzz.test_bodies import refused_or

pytestmark = pytest.mark.slow

VALUES = 60

SURVEYS = "place,latitude,longitude,stones,fallen\n" + "".join(
    f"{name},{35 + 0.1 * i},{139 - 0.1 * i},{40 + i},{3 * i}\n" for i, name in enumerate(("寺", "A", "B"))
)
OUTCOMES = "record,scale,fell,weight\n" + "".join(f"elcentro_1940_ns.csv,{scale},{scale // 5},{1 + scale % 2}\n" for scale in range(1, 9))
CURVES = json.dumps(
    {
        "schema": "seisblock/fragility/1",
        "results": [
            {"body": "a", "limit": "overturn", "im": "pgv", "unit": "m/s", "median": 0.63, "beta": 0.41},
            {"body": "b", "limit": "slide", "im": "pga", "unit": "m/s^2", "median": None, "beta": None},
        ],
    }
)


def all_finite(*values):
    """Return whether all numbers are finite."""
    return bool(np.isfinite(np.concatenate([np.ravel(np.asarray(value, dtype=float)) for value in values])).all())


def valid_scan(path):
    """Return whether a scan makes a body with a mass and with angles."""
    scan = scan_body(path)
    towards = [(azimuth.slenderness_rad, azimuth.radius_m) for azimuth in scan_azimuths(scan.body, step_deg=90.0)]
    return scan.volume > 0.0 and all_finite(scan.volume, scan.body.mass, *towards)


def valid_body_list(path):
    """Return whether a list holds bodies given by numbers; values that no solver accepts, such as height 0, fail in their row."""
    return all(all_finite(value) for body in read_bodies(path) for value in body.parameters.values() if isinstance(value, float))


def valid_surveys(path):
    """Return whether no more stones fell at a place than stood there, and whether it is on the earth."""
    places = read_surveys(path)
    return all(0 <= place.fallen <= place.stones > 0 and abs(place.latitude) <= 90.0 and abs(place.longitude) <= 360.0 for place in places)


def valid_hazard(path):
    """Return whether the curves of a hazard fall, and their weights are a whole."""
    branches = read_hazard(path).branches
    falling = all((np.diff(branch.rates) <= 0.0).all() and (np.diff(branch.levels) > 0.0).all() for branch in branches)
    return falling and sum(branch.weight for branch in branches) == pytest.approx(1.0)


def valid_fragility(path):
    """Return whether curves have a middle and a spread."""
    return all(item.curve.median > 0.0 and item.curve.beta > 0.0 and all_finite(item.curve.median) for item in read_fragility(path))


def valid_outcomes(path):
    """Return whether outcomes have weights, and factors that are numbers."""
    return all(
        outcome.weight >= 0.0 and all_finite(outcome.weight, outcome.scale) for outcome in read_outcomes(path, component="NS").observed
    )


def mesh(write, suffix):
    """Make what writes a box of some triangles as a file."""

    def written(folder):
        path = folder / f"whole{suffix}"
        write(path, *box(0.4, 0.3, 1.1))
        return path.read_bytes()

    return written


FULL = {
    "bodies.csv": (lambda folder: LIST.encode("cp932"), valid_body_list),
    "surveys.csv": (lambda folder: SURVEYS.encode(), valid_surveys),
    "hazard.csv": (lambda folder: sample_path("synthetic_hazard.csv").read_bytes(), valid_hazard),
    "fragility.json": (lambda folder: CURVES.encode(), valid_fragility),
    "outcomes.csv": (lambda folder: OUTCOMES.encode(), valid_outcomes),
    "scan.stl": (mesh(write_stl, ".stl"), valid_scan),
    "scan.ply": (mesh(write_ply, ".ply"), valid_scan),
    "scan.obj": (mesh(write_obj, ".obj"), valid_scan),
}


@pytest.mark.parametrize("name", FULL)
def test_damaged_table_gives_valid_data_or_one_error(name, seeds, tmp_path):
    """Bytes lost, cut, repeated and changed, lines swapped."""
    make, makes_sense = FULL[name]
    full = make(tmp_path)
    path = tmp_path / name
    met = {True: 0, None: 0}
    for seed in (None, *seeds(VALUES)):
        path.write_bytes(full if seed is None else spoil(full, np.random.default_rng((seed, len(name)))))
        result = refused_or(makes_sense, path, seed)
        assert result is not False, seed
        assert result or seed is not None
        met[result] += 1
    assert met[True] > 1 and met[None] > 0, met
