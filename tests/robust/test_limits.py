"""Requests of hours or gigabytes are rejected, with the number and the limit (FINDINGS R9, R14)."""

from __future__ import annotations

import os
import subprocess
import time

import click
import pytest
from click.testing import CliRunner

import seisblock
from seisblock import Block, Motion
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.scan.mesh import read_mesh
from seisblock.bodies.table import read_bodies
from seisblock.bodies.toml import read_body_toml
from seisblock.cli import COMMANDS, main
from seisblock.cli.stack import MAX_GRID
from seisblock.cli.types import Count
from seisblock.core.errors import InputError, OutputError, ParameterError
from seisblock.core.io.checkpoint import Checkpoint
from seisblock.models.respond.options import RespondOptions
from seisblock.readers.discover import iter_records
from seisblock.readers.options import ReadOptions
from seisblock.studies.fit.outcome_table import read_outcomes
from seisblock.studies.fragility.io import read_fragility
from seisblock.studies.gravestone_criterion import PGAS, RATIOS
from seisblock.studies.hazard.table import read_hazard
from seisblock.studies.map.surveyed_places import read_surveys
from seisblock.studies.respond.azimuths import respond_directions
from seisblock.studies.survey.scale_search import scale_factors

SOON_S = 90.0
"""Processor time, s, within which anything is refused, a compilation of the kernels included."""

REFUSED_S = 10.0
"""Processor time, s, within which a number is refused before anything is computed: what the command imports, on any machine."""

REQUEST = {
    "factors of a margin": (
        ["rock", "--block", "gravestone", "--margin", "--margin-limit", "1e9"],
        3,
        "500000000000 factors",
    ),
    "values of a list": (["slide", "--mu", "0.1:0.5:1e-7"], 2, "4000001 values exceed the limit of 1000000"),
    "a list without end": (["slide", "--mu", "0:1e308:1e-308"], 2, "values exceed the limit of 1000000"),
    "blocks of a spectrum": (
        ["spectrum", "--sizes", "1:9:1e-3", "--height-over-width", "1:9:1e-3"],
        3,
        "64016001 cells exceed the limit of 1000000",
    ),
    "cells of a map": (["spectrum", "--kind", "modes", "--mu", "0.1:1:1e-4", "--height-over-width", "1:9:1e-3"], 3, "72017001 cells"),
    "bases of a study": (
        ["slide", "--mu", "0.1:0.9:1e-3", "--kappa", "0.1:0.9:1e-3", "--slope", "0:5:1"],
        3,
        "combinations exceed the limit of 1000000",
    ),
    "uplift regions": (
        ["uplift", "--harmonic", "--phi", "0:90:0.1", "--rho", "0:90:0.1", "--beta", "1,2"],
        3,
        "1623602 combinations",
    ),
    "points of regions": (
        ["uplift", "--harmonic", "--phi", "0:90:0.1", "--alpha", "1,2"],
        3,
        "1081200 curve points exceed the limit of 1000000",
    ),
    "shakings": (
        ["overturn-rate", "--cemetery", "aoyama.csv", "--pga", "1:1e5:1", "--frequency", "1:9:0.1"],
        3,
        "8100000 ground motions exceed the limit of 1000000",
    ),
    "points of a joint": (
        ["stack", "--contact", "grid=1000000000"],
        2,
        "1000000000 contact points along each side of a joint exceed the limit of 25",
    ),
    "steps of a pile": (
        ["stack", "--step", "1e-12"],
        3,
        "with rigid contact (rocking time scale of the smallest stone 0.17 s): omit it, or give",
    ),
    "settling time": (["respond", "--block", "gravestone", "--settle", "1e9"], 3, "between 0 and 3600 s"),
    "padding of a filter": (["measure", "--highpass", "1e-6"], 3, "samples of padding"),
    "stones of a cemetery": (["overturn-rate", "--cemetery", "huge.csv"], 3, "200000000 gravestones exceed the limit of 1000000"),
    "bytes of a device": (["measure", "/dev/zero"], 3, "is a device"),
}


COUNTED = {
    "measure": [],
    "respond": ["--block", "gravestone", "--mu", "0.5"],
    "rock": ["--block", "gravestone"],
    "infer": ["--slid", "5cm", "--mu", "0.2"],
    "overturn-rate": ["--cemetery", "aoyama.csv"],
    "uplift": ["--harmonic"],
    "slide": ["--mu", "0.2"],
}
"""What commands need besides."""

COSTS_NOTHING = {"--seed"}
"""Whole numbers that may be as large as they like."""

COUNTS = {
    f"{name} {option.opts[0]}": (name, option.opts[0])
    for name in COMMANDS
    for option in main.get_command(None, name).params
    if isinstance(option.type, (Count, click.types.IntParamType)) and option.opts[0] not in COSTS_NOTHING
}
"""Every whole number that a command takes."""


def test_count_options_are_all_covered():
    """Options known to be counts are among those found by the search."""
    assert {"respond --runs", "rock --perturb", "infer --steps", "spectrum --steps", "stack --grid"} <= set(COUNTS)
    assert {"overturn-rate --most-fragile", "uplift --corner", "measure --dpi"} <= set(COUNTS)


@pytest.mark.parametrize("quantity", COUNTS)
def test_count_options_reject_huge_values(quantity):
    """Before anything is read or computed: exit 2, the option and the number in one sentence."""
    name, option = COUNTS[quantity]
    start = time.process_time()
    result = CliRunner().invoke(main, [name, *COUNTED.get(name, []), option, "1000000000"])
    assert time.process_time() - start < REFUSED_S
    output = " ".join(result.stderr.split())
    assert (result.exit_code, result.stdout) == (2, ""), output
    assert option in output and "1000000000" in output


def test_environment_variable_raises_limit(monkeypatch):
    """The variable named in the message raises the limit, on the command line and in the library."""
    words = ["rock", "--block", "gravestone", "--perturb", "4"]
    monkeypatch.setattr("seisblock.studies.sampling.MAX_RUNS", 3)
    (count,) = (option.type for option in main.get_command(None, "rock").params if option.opts[0] == "--perturb")
    monkeypatch.setattr(count, "limit", 3)
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 2 and "4 samples exceed the limit of 3: reduce the number or raise SEISBLOCK_LIMIT_FACTOR" in " ".join(
        result.stderr.split()
    )
    monkeypatch.setenv("SEISBLOCK_LIMIT_FACTOR", "2")
    assert CliRunner().invoke(main, words).exit_code == 0


PULSE = Motion.from_arrays([0.0, 1.0, 0.0], 0.01)
TOO_MUCH = {
    "versions of a stone": lambda: seisblock.uncertainty.perturb(Block(0.2, 0.8), PULSE, 10**9),
    "versions of a body": lambda: seisblock.uncertainty.respond_probability(
        Block(0.2, 0.8), PULSE, options=RespondOptions(mu=0.5), runs=10**9
    ),
    "factors of a margin": lambda: seisblock.studies.find_margin(Block(0.2, 0.8), PULSE, step=1e-9),
    "factors of a scan": lambda: scale_factors(abs, 1.0, PULSE, steps=10**9),
    "points of a joint": lambda: seisblock.solve_stack(seisblock.load_pile("wagata"), PULSE, points=10**9),
    "directions": lambda: respond_directions(
        Block(0.2, 0.8), seisblock.read("synthetic_jma.csv"), options=RespondOptions(mu=0.5), step_deg=1e-9
    ),
}


@pytest.mark.parametrize("call", TOO_MUCH.values(), ids=TOO_MUCH)
def test_library_rejects_huge_counts(call):
    """Before it computes."""
    with pytest.raises(ParameterError, match=r"exceed the limit of .*: reduce the number or raise SEISBLOCK_"):
        call()


def test_memory_error_states_remedy(monkeypatch):
    """One sentence with a remedy, no traceback."""

    def too_much(*names, **options):
        raise MemoryError

    monkeypatch.setattr("seisblock.readers.read_all", too_much)
    result = CliRunner().invoke(main, ["measure"])
    assert (result.exit_code, result.stdout) == (3, "") and "shorten the record with --window" in " ".join(result.stderr.split())


def test_coarsest_criterion_grid_has_one_height():
    """The option's ceiling is that of the study."""
    assert len(RATIOS) == MAX_GRID >= len(PGAS)


@pytest.mark.parametrize("quantity", REQUEST)
def test_excessive_requests_are_rejected_early(quantity, tmp_path, monkeypatch):
    """One sentence, long before the end of what was asked."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "huge.csv").write_text("height_over_width,count\n" + "2.5,100000\n" * 2000)
    words, code, text = REQUEST[quantity]
    start = time.process_time()
    result = CliRunner().invoke(main, words)
    assert (result.exit_code, result.stdout) == (code, ""), result.stderr
    assert text in " ".join(result.stderr.split())
    assert time.process_time() - start < SOON_S


READ = {
    "a body": ("z.toml", read_body_toml),
    "a list of bodies": ("z.csv", read_bodies),
    "a cemetery": ("z.csv", read_cemetery),
    "a scan": ("z.stl", read_mesh),
    "a list of records": ("z.txt", lambda path: list(iter_records([f"@{path}"], ReadOptions()))),
    "outcomes": ("z.csv", read_outcomes),
    "a hazard": ("z.csv", read_hazard),
    "a fragility": ("z.json", read_fragility),
    "surveyed places": ("z.csv", read_surveys),
}
"""Everything that is read besides records."""


@pytest.mark.parametrize("quantity", READ)
def test_device_behind_link_is_rejected(quantity, tmp_path):
    """R9: /dev/zero has no end; a name that leads to it is refused, whatever it stands for."""
    name, use = READ[quantity]
    path = tmp_path / name
    path.symlink_to("/dev/zero")
    with pytest.raises(InputError, match=f"{name} is a device: give a regular file"):
        use(path)


def test_checkpoint_on_device_is_rejected(tmp_path):
    """A checkpoint that leads to a device is refused before a line is read."""
    path = tmp_path / "z.jsonl"
    path.symlink_to("/dev/zero")
    with pytest.raises(OutputError, match=r"^\S*z.jsonl is a device: give a regular file"):
        Checkpoint.open(path, {})


@pytest.mark.parametrize("quantity", READ)
def test_reading_stops_at_limit(quantity, tmp_path, monkeypatch):
    """R9: what lifts the limit is named; a pipe, which does not say how much comes, is read as far as it."""
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", "1")
    name, use = READ[quantity]
    path = tmp_path / name
    path.write_bytes(b"0" * (2**20 + 1))
    refused = pytest.raises(InputError, match=f"{name}: 2 MiB in a file exceed the limit of 1: .* raise SEISBLOCK_MEMORY_MIB")
    with refused:
        use(path)
    path.unlink()
    os.mkfifo(path)
    writing = subprocess.Popen(["sh", "-c", f"head -c 2000000 /dev/zero > {path}"], stderr=subprocess.DEVNULL)
    with writing, refused:
        use(path)


def test_curves_of_day_long_record_are_rejected_with_remedy(tmp_path, monkeypatch):
    """A figure and a table of curves name the memory they would take; the verdict alone is given."""
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", "1")
    monkeypatch.chdir(tmp_path)
    lines = ("time,NS (gal)\n", *(f"{0.01 * k:.2f},{50 * (k % 7 - 3)}\n" for k in range(20_000)))
    (tmp_path / "long.csv").write_text("".join(lines))
    words = ["slide", "long.csv", "--mu", "0.2", "--quiet"]
    result = CliRunner().invoke(main, [*words, "--csv", "out.csv"])
    assert result.exit_code == 3 and not (tmp_path / "out.csv").exists(), result.stderr
    output = " ".join(result.stderr.split())
    assert "need 3 MiB, more than the limit of 1 MiB" in output and "raise SEISBLOCK_MEMORY_MIB" in output
    assert CliRunner().invoke(main, words).exit_code == 0
    monkeypatch.setenv("SEISBLOCK_MEMORY_MIB", "100")
    assert CliRunner().invoke(main, [*words, "--csv", "out.csv"]).exit_code == 0
    assert len((tmp_path / "out.csv").read_text().splitlines()) > 20_000
