"""The command line that a model gives for what it cannot follow itself: the same record, prepared alike."""

import shlex

import pytest

from seisblock.cli import main
from seisblock.cli.hints import respond_command
from seisblock.cli.options import Source

VALUES = (
    "--scale 1.5 --highpass 0.1 --floor T=0.6,zeta=0.03,height=0.8 --window 20:30.5 --window :12 --demean --station X",
    "--target-jma 6+ --floor height=0.5,T=1",
    "--target-pga 400 --format csv --units gal --dt 0.01 --no-demean --level borehole --floor T=2 --window 5: --strict",
)


def preparation_options(line):
    """Return the record information that a line gives to `respond`."""
    texts = main.get_command(None, "respond").make_context("respond", shlex.split(line), resilient_parsing=False).params
    names = (
        "record",
        "component",
        "scale",
        "target_pga",
        "target_jma",
        "window",
        "highpass",
        "floor",
        "demean",
        "format",
        "units",
        "dt",
        "station",
        "level",
    )
    return {name: texts[name] for name in (*names, "strict")}


@pytest.mark.parametrize("arguments", VALUES)
def test_suggested_command_repeats_record_options(arguments):
    """Every option of the record is typed again: without the storey or the window it would be another answer."""
    preparation = preparation_options(f"synthetic_jma.csv --component NS --component 30 {arguments} --width 1 --height 2 --mu 0.5")
    line = respond_command(Source(**preparation), "--width", "1", "--height", "2", "--mu", "0.5")
    assert line.startswith("seisblock respond synthetic_jma.csv ")
    assert preparation_options(line.removeprefix("seisblock respond ")) == preparation
