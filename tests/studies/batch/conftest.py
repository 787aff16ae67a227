"""Records and bodies that the tests of batches share."""

import csv
import json

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main

BODIES = "name,width (cm),height,mu,inset\nslender,20,1.0,0.6,\nsquat,80cm,1.2,0.25,5%\nvase,12,40cm,0.4,\n"


def shaking(seed, samples=1500, peak=4.0):
    """Return a burst of three components, m/s^2: filtered noise under an envelope, of no generator of the program's."""
    rng = np.random.default_rng(seed)
    time = np.arange(samples) * 0.01
    envelope = (time / 4.0) * np.exp(1.0 - time / 4.0)
    noise = np.cumsum(rng.normal(size=(3, samples)), axis=1)
    noise -= np.array([np.convolve(row, np.ones(41) / 41, mode="same") for row in noise])
    rows = noise * envelope
    return time, rows * peak / np.abs(rows).max() * np.array([[1.0], [0.8], [0.4]])


def write_record(path, seed, **how):
    """Write a burst as a plain table with a time column."""
    time, rows = shaking(seed, **how)
    with path.open("w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(["time", "NS (m/s2)", "EW (m/s2)", "UD (m/s2)"])
        writer.writerows([f"{t:.2f}", *map(repr, map(float, row))] for t, row in zip(time, rows.T, strict=True))
    return path


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Return a folder with four records and a table of bodies, in which the test stands."""
    (tmp_path / "records").mkdir()
    for seed in range(4):
        write_record(tmp_path / "records" / f"r{seed}.csv", seed, peak=2.0 + seed)
    (tmp_path / "bodies.csv").write_text(BODIES, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(line):
    """Return what a command line comes to."""
    return CliRunner().invoke(main, line.split())


def document(line):
    """Return the document of a command line."""
    answer = run(line + " --json")
    assert answer.exit_code == 0, answer.stderr
    return json.loads(answer.stdout)
