"""What would take hours or gigabytes is refused, with the number and what is allowed (FINDINGS R9, R14)."""

from __future__ import annotations

import time

import pytest
from click.testing import CliRunner

from seisblock.cli import main

SOON_S = 90.0
"""Processor time, s, within which anything is refused, a compilation of the kernels included."""

ASKED = {
    "factors of a margin": (["rock", "--block", "gravestone", "--margin", "--margin-limit", "1e9"], 3, "tries 5e+11 factors, and 100000"),
    "versions of a stone": (["rock", "--block", "gravestone", "--perturb", "1000000000"], 2, "not in the range 1<=x<=100000"),
    "versions of a body": (["respond", "--block", "gravestone", "--runs", "1000000000"], 2, "not in the range 0<=x<=100000"),
    "steps of a scan": (["infer", "--slid", "5cm", "--mu", "0.2", "--steps", "1000000000"], 2, "not in the range 1<=x<=100000"),
    "values of a list": (["slide", "--mu", "0.1:0.5:1e-7"], 2, "has 4000001 values; at most 1000000"),
    "points of a spectrum": (["spectrum", "--steps", "100000"], 2, "not in the range 2<=x<=1000"),
    "points of a pile": (["stack", "--points", "100000"], 2, "not in the range 2<=x<=25"),
    "steps of a pile": (["stack", "--step", "1e-12"], 3, "finer than does any good"),
    "time to settle": (["respond", "--block", "gravestone", "--settle", "1e9"], 3, "between 0 and 3600 s"),
    "padding of a filter": (["measure", "--highpass", "1e-6"], 3, "samples of padding"),
    "stones of a cemetery": (["overturn-rate", "--cemetery", "huge.csv"], 3, "200000000 gravestones, and at most 1000000"),
    "bytes of a device": (["measure", "/dev/zero"], 3, "is a device"),
}


@pytest.mark.parametrize("what", ASKED)
def test_too_much_is_refused(what, tmp_path, monkeypatch):
    """One sentence, long before the end of what was asked."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "huge.csv").write_text("height_over_width,count\n" + "2.5,100000\n" * 2000)
    words, code, told = ASKED[what]
    start = time.process_time()
    done = CliRunner().invoke(main, words)
    assert (done.exit_code, done.stdout) == (code, ""), done.stderr
    assert told in " ".join(done.stderr.split())
    assert time.process_time() - start < SOON_S


def test_curves_of_a_day_are_refused_with_what_lifts_the_limit(tmp_path, monkeypatch):
    """A figure and a table of curves name the memory they would take; the verdict alone is given."""
    monkeypatch.setenv("SEISBLOCK_CURVES_MIB", "1")
    monkeypatch.chdir(tmp_path)
    lines = ("time,NS (gal)\n", *(f"{0.01 * k:.2f},{100 * (k % 7 - 3)}\n" for k in range(20_000)))
    (tmp_path / "long.csv").write_text("".join(lines))
    words = ["slide", "long.csv", "--mu", "0.2", "--quiet"]
    done = CliRunner().invoke(main, [*words, "--csv", "out.csv"])
    assert done.exit_code == 3 and not (tmp_path / "out.csv").exists(), done.stderr
    told = " ".join(done.stderr.split())
    assert "would take 2 MiB, and 1 may be taken" in told and "set SEISBLOCK_CURVES_MIB to take more" in told
    assert CliRunner().invoke(main, words).exit_code == 0
    monkeypatch.setenv("SEISBLOCK_CURVES_MIB", "100")
    assert CliRunner().invoke(main, [*words, "--csv", "out.csv"]).exit_code == 0
    assert len((tmp_path / "out.csv").read_text().splitlines()) > 20_000
