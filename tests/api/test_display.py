"""Every public object is shown in at most ten lines, and in a notebook as a table."""

import dataclasses
import inspect

import numpy as np
import pytest

import seisblock as sb
from seisblock.core._display import DisplayMixin, exact_repr
from tests.public_names import PUBLIC

RECORD = sb.read("synthetic_jma.csv")
MOTION = sb.motion_of(RECORD, "EW")
BLOCK = sb.Block(0.3, 0.9)
PULSE = sb.Motion.from_arrays(4.0 * np.sin(2.0 * np.pi * np.arange(301) * 0.01), 0.01)

VALUES = {
    "Record": lambda: RECORD,
    "Motion": lambda: MOTION,
    "Block": lambda: sb.load_block("gravestone"),
    "Cemetery": lambda: sb.read_cemetery("aoyama.csv"),
    "Pile": lambda: sb.load_pile("wagata"),
    "TwoLayerBlock": lambda: sb.load_two_layer("chozusha"),
    "ScannedBody": lambda: sb.load_scan("boulder"),
    "RecordMeasures": lambda: sb.measure(RECORD),
    "Response": lambda: sb.solve_rock(BLOCK, PULSE),
    "RespondOutcome": lambda: sb.solve_respond(sb.load_block("gravestone"), MOTION, mu=0.4, sensitivity=False).outcome,
    "SlideOutcome": lambda: sb.solve_slide(0.2, MOTION).outcome,
    "Margin": lambda: sb.studies.find_margin(BLOCK, PULSE),
    "Perturbation": lambda: sb.uncertainty.perturb(BLOCK, PULSE, 5),
    "Probability": lambda: sb.uncertainty.respond_probability(BLOCK, PULSE, options=sb.RespondOptions(mu=0.3), runs=5),
    "RespondOptions": lambda: sb.RespondOptions(mu=0.3),
    "OutcomeTable": lambda: sb.studies.read_outcomes("shaken_block.csv"),
    "Hazard": lambda: sb.fragility.read_hazard("synthetic_hazard.csv"),
    "OverturningRate": lambda: sb.survey.overturning_rate(sb.read_cemetery("aoyama.csv"), 5.0, 2.0),
}


@pytest.mark.parametrize("name", [name for name, value in PUBLIC.items() if inspect.isclass(value) and dataclasses.is_dataclass(value)])
def test_public_dataclasses_have_the_displays(name):
    """No public dataclass falls back on the generated representation, which has no limit."""
    kind = PUBLIC[name]
    assert issubclass(kind, DisplayMixin)
    assert kind.__repr__ is DisplayMixin.__repr__ or kind.__repr__.__doc__, "a representation of its own has a docstring"


@pytest.mark.parametrize("name", VALUES)
def test_values_are_shown_in_ten_lines_and_as_html(name):
    """Ten lines of 80 letters, with the name of the class; the table holds the same fields."""
    value = VALUES[name]()
    assert type(value).__name__ == name
    text = repr(value)
    assert len(text) <= 800 and text.count("\n") < 10
    assert name in text
    html = value._repr_html_()
    assert "<table" in html
    assert html.count("<td") >= 2


def test_exact_repr_differs_where_the_short_one_does_not():
    """Keys and digests see every sample."""
    first = sb.Record.from_arrays({"NS": np.zeros(1000)}, 0.01)
    second = sb.Record.from_arrays({"NS": np.eye(1, 1000, 500)[0]}, 0.01)
    assert repr(first) == repr(second)
    assert exact_repr(first) != exact_repr(second)
