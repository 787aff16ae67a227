"""Fragilities in the formats of pelicun and OpenQuake: read back by their own readers, and by what their readers ask for.

The engines themselves ask for versions of packages that ours does not go with, so that they live in environments of their own:
``SEISBLOCK_PEERS`` names the interpreters, separated as paths are. The library of models behind pelicun (``simcenter-dlml``) is light.
"""

from __future__ import annotations

import csv
import io
import json
import os
import re
import subprocess
import sys
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from dlml import vocabulary
from dlml._tabular import convert_to_MultiIndex, load_tabular

from seisblock.bodies.block import Block
from seisblock.core.errors import OutputError
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.report.exports.identifiers import ascii_identifiers
from seisblock.report.exports.openquake import NAMESPACE, imt_of, lognormal_moments, nrml
from seisblock.report.exports.pelicun import demand_of, pelicun_metadata, pelicun_rows
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.fragility.run import run_fragility
from tests.motions import synthetic_suite

DIGITS = 1e-9
"""What the numbers of the files keep."""


@pytest.fixture(scope="module")
def study():
    """Two shelves and two limits over PGA, of twelve records; one name has a blank, one no Latin letter."""
    bodies = {"shelf, tall": Block(0.3, 1.5), "棚": Block(0.4, 1.2)}
    records = synthetic_suite(12, seconds=15.0)
    return run_fragility(records, bodies, "rock", limits=("lean=0.5", "overturn"), im="pga", levels=np.linspace(1, 16, 40), bootstrap=2)


def test_export_omits_limit_without_curve():
    """A limit reached at one intensity by every record has no curve and does not prevent the export of the others."""
    study = run_fragility(
        synthetic_suite(12, seconds=15.0),
        {"shelf": Block(0.3, 1.5)},
        "rock",
        limits=("rock", "overturn"),
        im="pga",
        levels=np.linspace(1, 16, 40),
        bootstrap=2,
    )
    model = ElementTree.fromstring(nrml(study))
    assert [curve.curve is None for curve in study.curves] == [True, False]
    assert [state.text for state in model.iter(f"{{{NAMESPACE}}}limitStates")] == ["overturn"]
    assert [params.get("ls") for params in model.iter(f"{{{NAMESPACE}}}params")] == ["overturn"]


@pytest.fixture(scope="module")
def files(study, tmp_path_factory):
    """The four files."""
    folder = tmp_path_factory.mktemp("exports")
    text = io.StringIO()
    header, rows = pelicun_rows(study)
    csv.writer(text).writerows([header, *rows])
    curves = {
        "fragility.csv": text.getvalue(),
        "fragility.json": pelicun_metadata(study),
        "continuous.xml": nrml(study),
        "discrete.xml": nrml(study, shape="discrete"),
    }
    for name, content in curves.items():
        (folder / name).write_text(content, encoding="utf-8")
    return folder


def peer(package, script, *words):
    """Return what a script prints in an interpreter that has a package."""
    for python in [*os.environ.get("SEISBLOCK_PEERS", "").split(os.pathsep), sys.executable]:
        if python and subprocess.run([python, "-c", f"import {package}"], capture_output=True, check=False).returncode == 0:
            result = subprocess.run([python, "-c", script, *map(str, words)], capture_output=True, text=True, check=False)
            assert result.returncode == 0, result.stderr
            return json.loads(result.stdout.splitlines()[-1])
    pytest.skip(f"no interpreter of SEISBLOCK_PEERS has {package}")


def of(study, body, limit):
    """Return one curve."""
    return next(curve for curve in study.curves if (curve.body, curve.limit) == (body, limit))


def rising(levels):
    """Return the isotonic fit to the fractions of some levels by its max-min formula."""
    runs, exceeding = ([getattr(level, name) for level in levels] for name in ("runs", "exceeding"))
    ends = range(1, len(levels) + 1)
    return [max(min(sum(exceeding[i:j]) / sum(runs[i:j]) for j in ends if j > k) for i in range(k + 1)) for k in range(len(levels))]


def test_discrete_shares_that_fall_are_pooled_with_their_runs(study):
    """Of 6 in 10 runs and 1 in 2, where the others were stopped, 7 in 12 remain, not the mean of .6 and .5."""
    curve = study.curves[0]
    levels = tuple(replace(level, runs=10, exceeding=9) for level in curve.levels)
    levels = tuple(replace(level, runs=r, exceeding=e) for level, r, e in zip(levels, (10, 10, 2), (0, 6, 1), strict=False)) + levels[3:]
    model = ElementTree.fromstring(nrml(replace(study, curves=(replace(curve, levels=levels),)), shape="discrete"))
    shares = [float(word) for word in model.find(f".//{{{NAMESPACE}}}poes").text.split()]
    assert shares == pytest.approx(rising(levels), abs=1e-9) and shares[:4] == pytest.approx([0.0, 7 / 12, 7 / 12, 0.9])


def test_dlml_reads_exported_rows(study, files):
    """DLML's own reader finds a component per body, a demand and families of its vocabulary, and medians in g that rise."""
    table = convert_to_MultiIndex(load_tabular(files / "fragility.csv"), axis=1)
    assert set(table.index) == {"shelf_tall", "body_2"}
    assert set(table["Demand"]["Type"]) <= vocabulary.DEMAND_TYPES
    assert {*table["LS1"]["Family"], *table["LS2"]["Family"]} <= vocabulary.DISTRIBUTION_FAMILIES
    for name, body in (("shelf_tall", "shelf, tall"), ("body_2", "棚")):
        for state, limit in (("LS1", "lean=0.5"), ("LS2", "overturn")):
            curve = of(study, body, limit)
            assert float(table.loc[name, (state, "Theta_0")]) * STANDARD_GRAVITY == pytest.approx(curve.median, rel=DIGITS)
            assert float(table.loc[name, (state, "Theta_1")]) == pytest.approx(curve.beta, rel=DIGITS)
    assert (table["LS1"]["Theta_0"].astype(float) < table["LS2"]["Theta_0"].astype(float)).all()


def test_exported_columns_equal_fema_p58(study):
    """The header is that of FEMA P-58 in DLML, as far as there are limit states."""
    from dlml import api

    (name,) = [item for item in api.list_datasets() if "P-58 2nd" in item]
    curves = {f"{a}-{b}" if b else a for a, b in api.get_fragility(name).columns}
    assert set(pelicun_rows(study)[0]) - {"ID"} <= curves
    answer = json.loads(pelicun_metadata(study))
    shelf = api.get_metadata(name, "fragility")["E.20.22.102a"]
    assert set(answer["shelf_tall"]) == set(shelf) and set(answer["body_2"]["LimitStates"]) == {"LS1", "LS2"}
    assert answer["body_2"]["Description"] == "棚"


PELICUN = """
import contextlib, io, json, sys, warnings
import numpy as np, pandas as pd
warnings.simplefilter("ignore")
from pelicun.assessment import Assessment
from pelicun.base import convert_to_MultiIndex
with contextlib.redirect_stdout(io.StringIO()):
    a = Assessment({"PrintLog": False, "Seed": 1})
    n = 40000
    demand = pd.DataFrame({("PFA", "0", "1"): np.full(n, float(sys.argv[2]))})
    demand.columns.names = ["type", "loc", "dir"]
    a.stories = 0
    marginals = pd.DataFrame(
        {"Units": ["ea"], "Location": ["1"], "Direction": ["1"], "Theta_0": [1.0], "Blocks": [1]}, index=[sys.argv[3]]
    )
    a.demand.load_sample(pd.concat([pd.DataFrame({("PFA", "0", "1"): ["mps2"]}, index=["Units"]), demand]))
    a.asset.load_cmp_model({"marginals": marginals})
    a.asset.generate_cmp_sample(n)
    a.damage.load_model_parameters([sys.argv[1]], {sys.argv[3]})
    a.damage.calculate()
    sample = a.damage.ds_model.sample
    states = {str(c[-1]): float(sample[c].mean()) for c in sample.columns}
print(json.dumps(states))
"""


def test_pelicun_samples_states_of_curves(study, files):
    """An assessment with one shelf on the first storey, at one acceleration of its floor: the shares that the two curves give."""
    body = "shelf, tall"
    lean, fall = (of(study, body, limit).curve for limit in ("lean=0.5", "overturn"))
    shaking = lean.median * 1.1
    states = peer("pelicun", PELICUN, files / "fragility.csv", shaking, "shelf_tall")
    at_least_lean, falls = float(lean.probability(shaking)), float(fall.probability(shaking))
    assert 0.05 < falls < at_least_lean < 0.95
    assert states["2"] == pytest.approx(falls, abs=3 * np.sqrt(0.25 / 40000))
    assert states["1"] == pytest.approx(at_least_lean - falls, abs=3 * np.sqrt(0.25 / 40000))


OPENQUAKE = """
import json, sys
import numpy as np
from openquake.risklib import read_nrml
from openquake.hazardlib import nrml
model = nrml.to_python(sys.argv[1])
levels = json.loads(sys.argv[2])
found = {}
for (imt, name), functions in model.items():
    built = functions.build(model.limitStates, 20, 1)
    found[name] = {"imt": imt, **{f.limit_state: f(np.array(levels)).tolist() for f in built}}
print(json.dumps(found))
"""


@pytest.mark.parametrize("shape", ["continuous", "discrete"])
def test_openquake_functions_equal_curves(shape, study, files):
    """Its own functions, evaluated at levels in g, are our lognormal, or our shares made to rise."""
    levels = [2.0, 4.0, 6.0, 9.0]
    result = peer(
        "openquake.risklib.read_nrml", OPENQUAKE, files / f"{shape}.xml", json.dumps([level / STANDARD_GRAVITY for level in levels])
    )
    for name, body in (("shelf_tall", "shelf, tall"), ("body_2", "棚")):
        assert result[name]["imt"] == "PGA"
        for state, limit in (("lean_0_5", "lean=0.5"), ("overturn", "overturn")):
            curve = of(study, body, limit)
            shares = np.interp(levels, [item.im for item in curve.levels], rising(curve.levels))
            expected = curve.curve.probability(levels) if shape == "continuous" else shares
            assert result[name][state] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("shape", ["continuous", "discrete"])
def test_exported_model_obeys_openquake_rules(shape, study, files):
    """The rules of its reader, written down: order of the elements, names, positive numbers, as many shares as levels, rising."""
    root = ElementTree.parse(files / f"{shape}.xml").getroot()
    space = f"{{{NAMESPACE}}}"
    (model,) = root
    assert root.tag == f"{space}nrml" and model.tag == f"{space}fragilityModel"
    assert set(model.attrib) == {"id", "assetCategory", "lossCategory"}
    assert [child.tag.removeprefix(space) for child in model] == ["description", "limitStates", "fragilityFunction", "fragilityFunction"]
    states = model[1].text.split()
    assert all(re.fullmatch(r"[A-Za-z]\w*", state) for state in states)
    for function in model[2:]:
        assert re.fullmatch(r"[\w.-]+", function.get("id")) and function.get("id").isascii()
        imls, *curves = function
        assert [curve.get("ls") for curve in curves] == states
        if shape == "continuous":
            assert 0.0 < float(imls.get("minIML")) < float(imls.get("maxIML"))
            assert all(float(curve.get(key)) > 0.0 for curve in curves for key in ("mean", "stddev"))
        else:
            levels = [float(item) for item in imls.text.split()]
            shares = [[float(item) for item in curve.text.split()] for curve in curves]
            assert levels == sorted(set(levels))
            assert all(row == sorted(row) and len(row) == len(levels) and row[0] >= 0.0 and row[-1] <= 1.0 for row in shares)
            assert all(beyond <= before for before, beyond in zip(*shares, strict=True))


def test_openquake_moments_are_of_lognormal_variable(study):
    """OpenQuake takes the moments of the lognormal variable: those of a large sample of it."""
    curve = study.curves[0].curve
    sample = curve.median * np.exp(curve.beta * np.random.default_rng(0).standard_normal(400_000))
    assert lognormal_moments(curve) == pytest.approx((sample.mean(), sample.std()), rel=0.01)


def test_exports_use_units_of_target():
    """G for accelerations; pelicun m/s and m, OpenQuake cm/s and cm."""
    assert demand_of(intensity_measure("sa=0.5")) == ("Spectral Acceleration|0.5", "g", STANDARD_GRAVITY)
    assert demand_of(intensity_measure("pgv")) == ("Peak Floor Velocity", "mps", 1.0)
    assert imt_of(intensity_measure("sa=0.5")) == ("SA(0.5)", STANDARD_GRAVITY)
    assert imt_of(intensity_measure("pgv")) == ("PGV", 0.01)
    assert imt_of(intensity_measure("arias")) == ("IA", 1.0)


def test_exports_reject_unsupported_measures():
    """P PGV/g is a measure of ours alone; pelicun has no Arias intensity."""
    for ask, name in ((demand_of, "arias"), (demand_of, "p*pgv"), (imt_of, "p*pgv")):
        with pytest.raises(OutputError, match="not supported by"):
            ask(intensity_measure(name))


def test_exported_names_are_unique_and_valid():
    """Two that become one, one that begins with a digit, one without a letter."""
    assert list(ascii_identifiers(["a b", "a-b", "3 shelves", "墓石"]).values()) == ["a_b", "a_b_2", "body_3_shelves", "body_4"]
