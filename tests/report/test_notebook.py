"""A response shows itself in a notebook: a table, a figure, a data frame."""

import contextlib
import html
import re
import warnings

import numpy as np
import pytest
from matplotlib.figure import Figure

import seisblock
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.factory import load_block
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.scan.toml import load_scan
from seisblock.bodies.spring_factory import load_springs
from seisblock.bodies.two_layer import load_contact, load_two_layer
from seisblock.core.errors import ParameterError
from seisblock.core.registry import solver_names
from seisblock.core.results import Response
from seisblock.output.text.solver import describe as verdict_text
from seisblock.records import Motion
from seisblock.samples import list_samples

MOTION = Motion.from_arrays(5.5 * np.sin(2 * np.pi * 1.2 * np.arange(401) * 0.01), 0.01, name="EW")
BLOCK, SPRINGS = seisblock.Block(0.3, 0.9), seisblock.SpringBlock.from_frequency(1.2, 1.2, 3.0, frequency_vertical=8.0, beta=0.7)

SOLVED = {
    "respond": lambda: seisblock.solve_respond(BLOCK, MOTION, mu=0.5),
    "rock": lambda: seisblock.solve_rock(BLOCK, MOTION),
    "slide": lambda: seisblock.solve_slide(0.2, MOTION),
    "jump": lambda: seisblock.solve_jump(seisblock.load_two_layer("chozusha"), MOTION, contact=seisblock.load_contact("chozusha")),
    "uplift": lambda: seisblock.solve_uplift(SPRINGS, MOTION),
}
"""One short response of each planar model and of uplift; solved when it is looked at, not when tests are collected."""


@pytest.fixture(scope="module", params=SOLVED)
def response(request):
    """One of them."""
    return SOLVED[request.param]()


def test_repr_html_has_outcome_table_and_figure(response):
    """The table holds every number with its unit in words, and the figure is data."""
    text = response._repr_html_()
    assert "data:image/" in text and "<script" not in text
    # the sentence with which the command begins, too
    assert verdict_text(response) in html.unescape(text).replace("\xa0", " ") and verdict_text(response).startswith("EW: ")
    rows = re.findall(r"<tr><td[^>]*>([^<]*)</td>", text)
    plain = [key for key, value in vars(response.outcome).items() if isinstance(value, (int, float, str, type(None)))]
    assert len(rows) >= len(plain)
    assert not any(row.endswith(("_m", "_s")) for row in rows)


def test_figure_of_rock_has_room_in_a_notebook():
    """Histories beside the phase plane collapsed in the width of a notebook, and the legend was cut off."""
    response = seisblock.solve_rock(seisblock.Block(0.45, 1.8), seisblock.motion_of(seisblock.read("synthetic_jma.csv"), "NS"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert "data:image/" in response._repr_html_()


def test_plot_returns_figure_with_png_repr(response):
    """A Figure, not pyplot's, that gives its own .png."""
    figure = response.plot()
    assert isinstance(figure, Figure)
    assert figure._repr_png_().startswith(b"\x89PNG")


def test_to_dataframe_has_column_per_channel(response):
    """Time first, then channels with their unit, as many rows as times."""
    pytest.importorskip("pandas")
    frame = response.to_dataframe()
    assert frame.columns[0] == "time_s" and len(frame) == response.time.size
    assert len(frame.columns) == 1 + len(response.channels)


def test_plot_of_unsupported_model_lists_supported_models():
    """The message lists those that have one."""
    unknown = Response("knit", None, Motion.from_arrays(np.zeros(3), 0.01), None)
    with pytest.raises(ParameterError, match=f"available: {', '.join(sorted(solver_names()))}$"):
        unknown.plot()


VALUES = {
    "Record": lambda motion: motion.record,
    "Motion": lambda motion: motion,
    "ResponseSpectrum": lambda motion: seisblock.measures.response_spectrum(motion.horizontal, motion.dt),
    "RockingSpectrum": lambda motion: seisblock.studies.rocking_spectrum([0.5, 1.0], [0.2, 0.3], motion),
    "FragilityStudy": lambda motion: seisblock.fragility.run_fragility(
        [motion.record, seisblock.read("elcentro_1940_ns.csv")], seisblock.Block(0.3, 1.2), "rock", im="pgv", steps=8, bootstrap=10
    ),
}
"""Display of a record and of results derived from it without a run."""


@pytest.mark.parametrize("kind", VALUES)
def test_records_motions_and_spectra_have_repr_html(kind):
    """A record, a motion and spectra have a title, numbers with units in words, and a figure."""
    value = VALUES[kind](seisblock.motion_of(seisblock.read("synthetic_jma.csv"), "EW"))
    assert type(value).__name__ == kind
    text = value._repr_html_()
    assert "data:image/" in text and "<script" not in text and "<b></b>" not in text
    assert len(re.findall(r"<tr>", text)) >= 2
    assert value.plot()._repr_png_().startswith(b"\x89PNG")


def test_measures_repr_html_is_a_table():
    """A column per component, and the intensity; they hold no samples, so there is no figure."""
    record = seisblock.read("synthetic_jma.csv")
    answer = seisblock.measure(record)
    text = answer._repr_html_()
    assert (
        "<img" not in text and "pga (gal)" in text and "pgv (kine)" in text and "arias (m/s)" in text and f"JMA {answer.jma_class}" in text
    )
    assert all(f">{part.code}</td>" in text for part in record.components)


def test_assessment_repr_html_begins_with_headline():
    """Class and probability come first, then the models as a table; a single run is marked as one."""
    assessment = seisblock.assess(BLOCK, MOTION, mu=0.5, runs=10)
    text = assessment._repr_html_().replace("\xa0", " ")
    assert re.search(r"<b[^>]*border-left:.8em solid #[0-9a-f]{6}[^>]*>EW: (likely overturns|may overturn|moves|stays) \(\d+ %", text)
    assert "full response" in text and "class_" not in text
    assert "assess(body, record) gives" in SOLVED["rock"]()._repr_html_() and "assess(" not in SOLVED["slide"]()._repr_html_()


@pytest.mark.parametrize("name", [sample.name for sample in list_samples() if sample.kind == "record"])
def test_measures_of_every_bundled_record_have_repr_html(name):
    """A column per component, vertical-only and horizontal-only values included."""
    record = seisblock.read(name)
    text = seisblock.measure(record)._repr_html_()
    assert all(f">{code}</td>" in text for code in record.codes)


@pytest.mark.parametrize("name", [sample.name for sample in list_samples() if sample.kind in ("body", "scan", "cemetery")])
def test_every_bundled_object_has_repr_html(name):
    """Bodies in every form that their file allows, scans and cemeteries show themselves."""
    values = 0
    for load in (load_block, load_two_layer, load_contact, load_pile, load_springs, load_scan, read_cemetery):
        with contextlib.suppress(seisblock.errors.SeisblockError):
            values += "<table" in load(name)._repr_html_()
    assert values or name.endswith(".ply")
