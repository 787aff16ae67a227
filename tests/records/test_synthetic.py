"""Synthetic records have the spectrum, peaks and duration of an earthquake of their magnitude and distance."""

from __future__ import annotations

import json
from itertools import pairwise

import numpy as np
import obspy
import pytest
from click.testing import CliRunner

import seisblock
from seisblock.cli import main
from seisblock.core.errors import InputError, ParameterError
from seisblock.measures.spectra import response_spectrum
from seisblock.records import process
from seisblock.records.synthetic.suite import PointSource, parse_suite, synthetic_suite
from seisblock.report.exports.knet import write_knet

INDEPENDENT = 1e-5
"""Two codes of one formula, whose constants agree to six digits."""

FOUR_ERRORS = 4.0
"""Standard errors of a mean that chance hardly ever brings: once in 16 000."""

RANDOM_VIBRATION = 0.15
"""Random vibration theory takes the shaking for stationary over its duration; simulations differ from it by so much."""

PYRVT = {
    (5.0, 20.0): ((0.000371608, 0.00352133, 0.0256824, 0.0489685, 0.0246637, 0.00355332), 0.35508, 0.016387),
    (6.0, 20.0): ((0.010658, 0.0676133, 0.158186, 0.168333, 0.0758519, 0.0107502), 0.93776, 0.069914),
    (7.0, 20.0): ((0.192369, 0.426506, 0.524947, 0.506129, 0.223276, 0.031197), 1.97967, 0.237903),
    (7.0, 50.0): ((0.0914895, 0.196183, 0.225333, 0.192983, 0.0666135, 0.0066785), 0.67872, 0.099903),
}
"""pyrvt 0.8.1, SourceTheoryMotion("wna") with depth 10^(0.15 M - 0.05) km and peak calculator V75: Fourier amplitudes, m/s, at 0.1, 0.3, 1,
3, 10 and 25 Hz, PGA and PGV, m/s^2 and m/s."""

PYRVT_SA = (3.37430, 4.85259, 4.47299)
"""The same for magnitude 7 at 20 km: response spectra at 2, 5 and 10 Hz, 5 % damped, m/s^2."""


@pytest.fixture(scope="module")
def suite():
    """Forty records of magnitude 7 at 20 km."""
    return synthetic_suite(7.0, 20.0, 40, seed=17)


def samples(suite, *codes):
    """Return the samples of some components, (records, components, n), m/s^2."""
    return np.array([[record.component(code).acceleration for code in codes] for record in suite])


def geometric_mean(values):
    return np.exp(np.log(values).mean())


class TestTarget:
    @pytest.mark.parametrize("case", PYRVT)
    def test_target_spectrum_equals_pyrvt(self, case):
        """Source, path and site multiply to the Fourier amplitudes of pyrvt."""
        result = PointSource(case[0], 1e3 * case[1]).spectrum(np.array([0.1, 0.3, 1.0, 3.0, 10.0, 25.0]))
        assert result == pytest.approx(PYRVT[case][0], rel=INDEPENDENT)

    def test_target_spectrum_falls_with_frequency_squared(self):
        """Towards zero the ground neither moves on nor is displaced for ever."""
        low, lower = PointSource(7.0, 20e3).spectrum(np.array([2e-3, 1e-3]))
        assert low / lower == pytest.approx(4.0, rel=0.01)


class TestSuite:
    def test_mean_spectrum_equals_target(self, suite):
        """In bands from 0.05 to 40 Hz the power is the target's, within the error of a mean over the records, which is small."""
        spectra = np.abs(np.fft.rfft(samples(suite, "NS", "EW"))) * suite[0].dt
        f = np.fft.rfftfreq(suite[0].samples, suite[0].dt)
        power = (spectra[..., 1:] / PointSource(7.0, 20e3).spectrum(f[1:])) ** 2
        edges = np.geomspace(0.05, 40.0, 11)
        for low, high in pairwise(edges):
            of_records = power[..., (f[1:] >= low) & (f[1:] < high)].mean(axis=(1, 2))
            error = of_records.std(ddof=1) / np.sqrt(of_records.size)
            assert error < 0.15
            assert abs(of_records.mean() - 1.0) < FOUR_ERRORS * error

    @pytest.mark.parametrize("case", PYRVT)
    def test_peaks_equal_random_vibration_theory(self, case):
        """PGA and PGV of magnitudes 5 to 7 near and far, which span a factor of fifteen."""
        shaken = samples(synthetic_suite(*case, 20, seed=4), "NS", "EW")
        assert geometric_mean(np.abs(shaken).max(axis=-1)) == pytest.approx(PYRVT[case][1], rel=RANDOM_VIBRATION)
        assert geometric_mean(np.abs(shaken.cumsum(axis=-1) * 0.01).max(axis=-1)) == pytest.approx(PYRVT[case][2], rel=RANDOM_VIBRATION)

    def test_response_spectra_equal_random_vibration_theory(self, suite):
        """At 2, 5 and 10 Hz, of half of the suite."""
        result = [response_spectrum(a, 0.01, [0.5, 0.2, 0.1]).sa_m_s2 for a in samples(suite[:20], "NS", "EW").reshape(40, -1)]
        assert np.exp(np.log(result).mean(axis=0)) == pytest.approx(PYRVT_SA, rel=RANDOM_VIBRATION)

    @pytest.mark.parametrize(("magnitude", "distance"), [(5.0, 20.0), (7.0, 20.0), (7.0, 100.0)])
    def test_significant_duration_equals_target(self, magnitude, distance):
        """Most of the energy, 5 to 95 %, comes within the duration of source and path."""
        energy = (samples(synthetic_suite(magnitude, distance, 20, seed=2), "NS") ** 2).cumsum(axis=-1)[:, 0]
        share = energy / energy[:, -1:]
        lasted = 0.01 * ((share < 0.95).sum(axis=1) - (share < 0.05).sum(axis=1))
        assert lasted.mean() == pytest.approx(PointSource(magnitude, 1e3 * distance).duration_s, rel=0.15)

    def test_components_are_uncorrelated(self, suite):
        """Correlations of the components scatter about zero."""
        shaken = samples(suite, "NS", "EW", "UD")
        r = np.array([np.corrcoef(record)[np.triu_indices(3, 1)] for record in shaken])
        assert (np.abs(r.mean(axis=0)) < FOUR_ERRORS * r.std(axis=0, ddof=1) / np.sqrt(len(r))).all()
        assert np.abs(r).max() < 0.4

    def test_vertical_has_two_thirds_of_horizontal(self, suite):
        """In the mean square over the records, within its error."""
        power = (samples(suite, "NS", "EW", "UD") ** 2).mean(axis=-1)
        ratio = power[:, 2] / power[:, :2].mean(axis=1).mean()
        assert abs(ratio.mean() - 4.0 / 9.0) < FOUR_ERRORS * ratio.std(ddof=1) / np.sqrt(ratio.size) < 0.1

    def test_synthetic_ground_ends_at_rest(self, suite):
        """The last velocity is zero within the digits, the last displacement small beside the largest."""
        velocity = samples(suite, "NS", "EW", "UD").cumsum(axis=-1) * 0.01
        displacement = velocity.cumsum(axis=-1) * 0.01
        assert np.abs(velocity[..., -1]).max() < 2e-6
        assert (np.abs(displacement[..., -1]) < 0.1 * np.abs(displacement).max(axis=-1)).all()

    def test_suite_is_reproducible_by_seed(self, suite):
        """The same seed gives the same bits, a longer suite begins with a shorter one, another seed is another suite."""
        repeated, second = synthetic_suite(7.0, 20.0, 3, seed=17), synthetic_suite(7.0, 20.0, 3, seed=18)
        assert np.array_equal(samples(repeated, "NS", "EW", "UD"), samples(suite[:3], "NS", "EW", "UD"))
        assert not np.array_equal(samples(second, "NS"), samples(repeated, "NS"))
        assert not np.array_equal(samples(repeated[:1], "NS"), samples(repeated[1:2], "NS"))

    def test_records_are_marked_synthetic(self, suite):
        """Station, name, format, history and magnitude."""
        record = suite[6]
        assert (record.station, record.source, record.format) == ("SYN007", "synthetic_M7_R20_007", "synthetic")
        assert record.history[0].startswith("synthetic (not recorded)") and "seed 17" in record.history[0]
        assert record.metadata["magnitude"] == 7.0 and record.codes == ("NS", "EW", "UD")


@pytest.mark.parametrize(
    "text",
    ["synthetic", "synthetic:M7:R20", "synthetic:M7:R20:0", "synthetic:M7:R20:2.5", "synthetic:M9:R20:4", "synthetic:M7:R0.5:4",
     "synthetic:Mnan:R20:4", "synthetic:M7:R20:4:5", "real:M7:R20:4", "synthetic:M7:Rfar:4", "synthetic:M7:R20:99999999"],
)  # fmt: skip
def test_suite_rejects_invalid_options(text):
    """In a sentence, and before anything large is made."""
    with pytest.raises(InputError):
        parse_suite(text)


def test_suite_requires_integer_seed():
    """No dice without one."""
    with pytest.raises(ParameterError, match="seed"):
        synthetic_suite(7.0, 20.0, 2, seed=-1)


class TestCommand:
    LINE = ("fragility", "--width", "30cm", "--height", "1.2", "--solver", "rock", "--im", "pgv", "--steps", "8", "--bootstrap", "20")

    @pytest.fixture
    def run(self, tmp_path, monkeypatch):
        """Return a function that runs the command in an empty directory."""
        monkeypatch.chdir(tmp_path)
        return lambda *words: CliRunner().invoke(main, [*self.LINE, *map(str, words)])

    def test_written_suite_round_trips(self, run, tmp_path):
        """The records written are read back to the last bit, so that the study of the folder is that of the suite."""
        result = run("--suite", "synthetic:M6.5:R15:4", "--suite-out", "made", "--seed", 3, "--json")
        assert result.exit_code == 0, result.stderr
        files = sorted((tmp_path / "made").iterdir())
        assert [path.name for path in files] == [f"synthetic_M6.5_R15_{n:03d}.csv" for n in range(1, 5)]
        for path, record in zip(files, synthetic_suite(6.5, 15.0, 4, seed=3), strict=True):
            back = seisblock.read(path)
            assert back.dt == record.dt and back.codes == record.codes
            assert all(np.array_equal(back.component(c.code).acceleration, c.acceleration) for c in record.components)
        document, read = json.loads(result.stdout), json.loads(run("made", "--seed", 3, "--json").stdout)
        assert [{**r, "efficiency": None} for r in document["results"]] == [{**r, "efficiency": None} for r in read["results"]]
        assert document["parameters"]["suite"] == "synthetic:M6.5:R15:4" and read["parameters"]["suite"] is None
        assert any("Boore" in text for text in document["citations"]) and not any("Boore" in text for text in read["citations"])

    def test_written_knet_files_round_trip(self, run, tmp_path):
        """Three to a record, to the last bit, by our reader without a doubt and by ObsPy; the study of the folder is that of the suite."""
        completed = run("--suite", "synthetic:M6.5:R15:4", "--suite-out", "made", "--suite-format", "knet", "--seed", 3, "--json")
        assert completed.exit_code == 0, completed.stderr
        files = sorted((tmp_path / "made").iterdir())
        assert [path.name for path in files[:3]] == [f"SYN0010001010000.{code}" for code in ("EW", "NS", "UD")] and len(files) == 12
        for number, record in enumerate(synthetic_suite(6.5, 15.0, 4, seed=3), start=1):
            path = tmp_path / "made" / f"SYN{number:03d}0001010000.EW"
            back = seisblock.read(path)
            assert back.format == "KNET" and not back.doubts and back.metadata["memo"] == "synthetic, no recording"
            assert {c.code: c.acceleration.tolist() for c in back.components} == {
                c.code: c.acceleration.tolist() for c in record.components
            }
            trace = obspy.read(path, format="KNET")[0]
            result = trace.data * trace.stats.calib
            assert np.allclose(result, record.component("EW").acceleration, rtol=0, atol=1e-9)
        document, read = (json.loads(item.stdout)["results"] for item in (completed, run("made", "--seed", 3, "--no-demean", "--json")))
        assert [{**r, "efficiency": None} for r in document] == [{**r, "efficiency": None} for r in read]

    def test_knet_counts_are_coarser_above_999_gal(self, tmp_path):
        """Beyond 999 gal a count is a thousandth: within half of it, and in its column."""
        (record,) = synthetic_suite(7.0, 20.0, 1)
        strong = process.scale(record, 20.0 / np.abs(record.component("NS").acceleration).max())
        for path in write_knet(tmp_path, [strong]):
            lines = path.read_text().splitlines()
            assert max(map(len, lines[17:])) == 72
        back = seisblock.read(tmp_path / "SYN0010001010000.NS")
        for c in strong.components:
            quantum = 1e-5 if np.abs(c.acceleration).max() > 9.999 else 1e-6
            assert np.abs(back.component(c.code).acceleration - c.acceleration).max() <= quantum * 0.5001

    def test_output_states_that_records_are_synthetic(self, run, monkeypatch):
        """Without RECORD the first line names the records in use and that they are synthetic."""
        monkeypatch.setattr("seisblock.cli.run_fragility.DEFAULT_SUITE", "synthetic:M7:R20:3")
        result = run("--json")
        assert result.exit_code == 0 and "using synthetic:M7:R20:3" in result.stderr and "synthetic records of one source" in result.stderr
        assert "synthetic (not recorded)" in json.loads(result.stdout)["record"][0]["history"][0]

    @pytest.mark.parametrize("words", [("--suite", "synthetic:M7:R20:3"), ("--suite-out", "there")])
    def test_records_and_suite_are_exclusive(self, run, words):
        """Not both; nothing is written."""
        refused = run("synthetic_jma.csv", *words)
        assert refused.exit_code == 3 and words[0] in refused.stderr

    def test_suite_refuses_to_write_over_file(self, run, tmp_path):
        """An existing file is not overwritten."""
        (tmp_path / "notes").write_text("mine")
        assert run("--suite", "synthetic:M7:R20:3", "--suite-out", "notes").exit_code in (2, 3)
        assert (tmp_path / "notes").read_text() == "mine"
