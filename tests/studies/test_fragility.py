"""Fragilities: fits against others' fits and closed forms, what the scatter comes from, and runs against single runs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import ndtr
from scipy.stats import CensoredData, linregress, norm

import seisblock
from seisblock.bodies.block import Block
from seisblock.core.errors import ParameterError
from seisblock.core.registry import get_solver
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.measures import rotated_spectrum
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.params import RespondParams, rigid_body
from seisblock.models.respond.solve import solve_respond
from seisblock.models.rock.solve import solve_rock
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.models.slide.solve import solve_slide
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Component, Motion, Preparation, Record, Storey, motion_of, process
from seisblock.records.floor import floor_motion
from seisblock.report.exports.pelicun import pelicun_rows
from seisblock.studies.fragility.capacities import capacities, moments
from seisblock.studies.fragility.damage_states import EndStates, limit_state, limit_states
from seisblock.studies.fragility.estimate import (
    Exceedances,
    FitOptions,
    efficiency_of_capacities,
    efficiency_of_cloud,
    estimate_curves,
    goodness_of_capacities,
    goodness_of_cloud,
    goodness_of_stripes,
)
from seisblock.studies.fragility.intensity import factors_for, intensity_measure
from seisblock.studies.fragility.lognormal import Lognormal, fit_fragility, fit_lognormals, fit_lognormals_shared_beta
from seisblock.studies.fragility.run import prepare_bodies, run_fragility
from seisblock.studies.fragility.runners import version_draws
from seisblock.studies.fragility.suite import make_suite
from seisblock.studies.solvers import solver_studies
from tests.motions import synthetic_suite
from tests.studies.batch.conftest import shaking

INDEPENDENT = 1e-3
"""Two optimisers of one likelihood; what the issue asks."""

ROUND_OFF = 1e-9
SHELF = Block(0.3, 1.2, name="shelf")
IM = {name: intensity_measure(name) for name in ("pga", "pgv", "pgd", "sa=0.5", "arias", "cav", "p*pgv")}
PGV = IM["pgv"]


@pytest.fixture(scope="module")
def records():
    """Twenty short records."""
    return synthetic_suite(20, seed=3, seconds=20.0)


def sample(count, *, median=0.7, beta=0.45, seed=0):
    """Return intensities at which it happens, drawn from a lognormal."""
    return median * np.exp(beta * np.random.default_rng(seed).normal(size=count))


def add_constant(values):
    """Return a column of ones beside another."""
    return np.column_stack([np.ones(len(values)), values])


def by_statsmodels(columns, happened, runs):
    """Return the coefficients of a probit regression as statsmodels fits it."""
    import statsmodels.api as sm  # takes longer to load than all tests here to run, and is wanted in few processes

    probit = sm.families.Binomial(sm.families.links.Probit())
    return sm.GLM(np.column_stack([happened, runs - happened]), columns, family=probit).fit(tol=1e-12).params


class TestFits:
    @pytest.mark.parametrize("seed", range(4))
    def test_stripes_fit_equals_statsmodels_probit(self, seed):
        """Median and beta are those of statsmodels' binomial GLM, at forty levels and at five."""
        levels = np.geomspace(0.1, 4.0, 40 if seed % 2 else 5)
        happened = (sample(44, seed=seed)[:, None] <= levels).sum(axis=0)
        a, b = by_statsmodels(add_constant(np.log(levels)), happened, 44)
        fit = fit_fragility(levels, happened, 44)
        assert fit.median == pytest.approx(np.exp(-a / b), rel=INDEPENDENT)
        assert fit.beta == pytest.approx(1.0 / b, rel=INDEPENDENT)

    def test_joint_fit_of_limits_equals_statsmodels(self):
        """One beta for three limits is the slope of statsmodels' regression with three constants; the medians rise."""
        levels = np.geomspace(0.1, 8.0, 30)
        happened = np.array([(factor * sample(40)[:, None] <= levels).sum(axis=0) for factor in (1.0, 1.3, 2.4)])
        design = np.column_stack([np.tile(np.log(levels), 3), np.repeat(np.eye(3), 30, axis=0)])
        b, *constants = by_statsmodels(design, happened.ravel(), 40)
        medians, beta = fit_lognormals_shared_beta(levels, happened[None].astype(float), np.full((1, 30), 40.0))
        assert medians[0] == pytest.approx(np.exp(-np.array(constants) / b), rel=INDEPENDENT)
        assert beta[0] == pytest.approx(1.0 / b, rel=INDEPENDENT)
        assert (np.diff(medians[0]) > 0.0).all()

    def test_bootstrap_fits_equal_separate_fits(self):
        """A bootstrap's samples, fitted together, are to 1e-8 what each is fitted by itself; the one without a curve is not a number."""
        levels = np.geomspace(0.1, 4.0, 25)
        counts = np.array([(sample(30, seed=seed)[:, None] <= levels).sum(axis=0) for seed in range(20)] + [np.zeros(25)], dtype=float)
        medians, betas = fit_lognormals(levels, counts, np.full((1, 25), 30.0))
        single = [fit_fragility(levels, row, 30) for row in counts[:-1]]
        assert medians[:-1] == pytest.approx([item.median for item in single], rel=1e-8)
        assert betas[:-1] == pytest.approx([item.beta for item in single], rel=1e-8)
        assert np.isnan([medians[-1], betas[-1]]).all()

    def test_ida_fit_equals_log_moments(self):
        """With every limit reached the fit is mean and standard deviation of the logarithms."""
        logs = np.log(sample(30))
        medians, betas = moments(logs, np.ones((1, 30)), 10.0)
        assert medians[0] == pytest.approx(np.exp(logs.mean()), rel=ROUND_OFF)
        assert betas[0] == pytest.approx(logs.std(ddof=1), rel=ROUND_OFF)

    def test_ida_fit_is_right_censored(self):
        """Censored at the top: scipy's fit of a normal sample censored on the right."""
        logs, top = np.log(sample(40)), np.log(0.9)
        observed = logs[logs <= top]
        mean, deviation = norm.fit(CensoredData.right_censored(np.minimum(logs, top), logs > top))
        medians, betas = moments(np.where(logs <= top, logs, np.inf), np.ones((1, 40)), top)
        assert 20 < observed.size < 35
        assert medians[0] == pytest.approx(np.exp(mean), rel=INDEPENDENT)
        assert betas[0] == pytest.approx(deviation, rel=INDEPENDENT)

    def test_fit_weight_equals_repeated_motion(self):
        """Samples of the bootstrap count motions; counting one twice is having it twice."""
        logs = np.log(sample(12))
        twice = moments(np.append(logs, logs[3]), np.ones((1, 13)), 10.0)
        weighted = moments(logs, np.where(np.arange(12) == 3, 2.0, 1.0)[None], 10.0)
        assert np.ravel(weighted) == pytest.approx(np.ravel(twice), rel=ROUND_OFF)

    def test_fragility_curve_equals_lognormal_distribution(self):
        """Probability and its inverse; nothing at zero."""
        curve = Lognormal(2.0, 0.5)
        assert curve.probability([0.0, 2.0, 2.0 * np.exp(0.5)]) == pytest.approx([0.0, 0.5, ndtr(1.0)])
        assert curve.probability(curve.quantile(0.1)) == pytest.approx(0.1)

    @pytest.mark.parametrize(
        ("happened", "says"),
        [
            ([0, 0, 0, 0], "not exceeded at any level up to 8; use higher"),
            ([10, 10, 10, 10], "at all levels from 1; use lower"),
            ([0, 0, 10, 10], "never exceeded up to 2, always exceeded from 4; add levels between"),
            ([0, 4, 10, 10], "never exceeded below 2, always exceeded above"),
            ([6, 5, 4, 3], "do not increase with the level"),
        ],
    )
    def test_fit_rejects_degenerate_counts(self, happened, says):
        """No exceedance, all, a jump between two levels, or none that increases: the message names useful levels."""
        with pytest.raises(ParameterError, match=says):
            fit_fragility([1.0, 2.0, 4.0, 8.0], happened, 10)

    @pytest.mark.parametrize(
        ("levels", "happened", "runs", "says"),
        [
            ([1.0], [1], 2, "at least two levels"),
            ([1.0, -2.0], [1, 1], 2, "must be positive"),
            ([1.0, 2.0], [1, 3], 2, "between 0 and the number of runs"),
            ([1.0, 2.0], [1], 2, "as many counts"),
        ],
    )
    def test_fit_rejects_invalid_counts(self, levels, happened, runs, says):
        """One level, a negative one, more than there were runs, counts that are missing."""
        with pytest.raises(ParameterError, match=says):
            fit_fragility(levels, happened, runs)


class TestIntensity:
    @pytest.mark.parametrize("name", list(IM))
    def test_scaled_motion_reaches_intensity_level(self, name, records):
        """A motion times its factor has the intensity of the level, in every measure: the Arias intensity grows with the square."""
        measure, motion = IM[name], motion_of(records[0], "EW")
        share = measure.share(SHELF, STANDARD_GRAVITY)
        level = 3.7 * measure.of(motion) * share
        factor = float(factors_for(np.array([level]), measure.of(motion) * share, measure)[0])
        scaled = Motion(motion.acceleration * factor, motion.dt)
        assert measure.of(scaled) * share == pytest.approx(level, rel=1e-9)
        assert factor == pytest.approx(3.7 ** (0.5 if name == "arias" else 1.0), rel=1e-12)

    def test_intensity_measures_equal_component_measures(self):
        """PGA, PGV and PGD equal those of `measure` for the component and for an azimuth."""
        record = seisblock.read("synthetic_jma.csv")
        for name in ("EW", "37"):
            measures = seisblock.measure(record, [name]).components[0]
            motion = motion_of(record, name)
            result = [IM[key].of(motion) for key in ("pga", "pgv", "pgd", "arias", "cav")]
            assert result == pytest.approx(
                [measures.pga_m_s2, measures.pgv_m_s, measures.pgd_m, measures.arias_m_s, measures.cav_m_s], rel=1e-12
            )

    def test_rotated_measures_are_those_of_the_record(self):
        """RotD50 and RotD100 of both horizontals, whatever the direction of the motion; they grow with the factor; sa:T is sa=T."""
        record = seisblock.read("synthetic_jma.csv")
        spectrum = rotated_spectrum(record, [0.5])
        for text, row in (("rotd50:0.5", spectrum.rotd50_m_s2), ("rotd100=0.5s", spectrum.rotd100_m_s2)):
            measure = intensity_measure(text)
            assert [measure.of(motion_of(record, name)) for name in ("EW", "37")] == [row[0]] * 2
            assert measure.of(motion_of(process.scale(record, 3.7), "EW")) == pytest.approx(3.7 * row[0], rel=1e-9)
            assert (measure.unit, measure.power) == ("m/s^2", 1)
            assert intensity_measure(measure.name) == measure
        assert intensity_measure("sa:0.5") == IM["sa=0.5"]
        assert intensity_measure("rotd50:0.5").label == "RotD50(0.5 s)"
        with pytest.raises(ParameterError, match=r"rotd50:0\.5 for the curve: a record with two horizontal components is required"):
            intensity_measure("rotd50:0.5").of(motion_of(seisblock.read("elcentro_1940_ns.csv"), "NS"))

    def test_p_pgv_measure_scales_with_body_size(self):
        """P PGV/g: twice the size, p over the root of two."""
        shares = [IM["p*pgv"].share(Block(0.3 * k, 1.2 * k), STANDARD_GRAVITY) for k in (1.0, 2.0)]
        assert shares[0] == pytest.approx(SHELF.frequency_parameter() / STANDARD_GRAVITY)
        assert shares[0] / shares[1] == pytest.approx(np.sqrt(2.0))
        with pytest.raises(ParameterError, match="use pgv"):
            IM["p*pgv"].share(0.3, STANDARD_GRAVITY)

    @pytest.mark.parametrize("text", ["pgx", "sa", "sa=x", "sa=-1", "pga=2", "rotd50", "rotd100:0", "cav:1"])
    def test_intensity_measure_rejects_invalid_name(self, text):
        """An unknown name, a period that is missing, none, or too many."""
        with pytest.raises(ParameterError):
            intensity_measure(text)

    @pytest.mark.parametrize(
        ("text", "solver"), [("fall", "rock"), ("lean", "rock"), ("rock=2", "rock"), ("slip=5cm", "rock"), ("overturn", "slide")]
    )
    def test_damage_state_rejects_invalid_name(self, text, solver):
        """An unknown name, a threshold that is missing or too many, and what a solver does not answer."""
        with pytest.raises(ParameterError):
            limit_states(text, solver, solver_studies(solver).limits)


class TestRuns:
    def test_fragility_rejects_negligible_records(self, records):
        """Records of a ten-thousandth of their strength, scaled back, are no records: what a body does under them is no fragility."""
        faint = [process.scale(record, 1e-4) for record in records]
        with pytest.raises(ParameterError, match="the median requires half of the records to be scaled by"):
            run_fragility(faint, SHELF, "rock", levels=np.linspace(1.0, 16.0, 12), bootstrap=2)

    def test_runs_at_factors_equal_single_runs(self, records):
        """Each solver's rows at once say what its single runs say, factor by factor."""
        motion = motion_of(records[1], "EW")
        factors = np.array([0.3, 0.7, 1.0, 1.4, 2.0, 3.0])
        scaled = [Motion(motion.acceleration * factor, motion.dt) for factor in factors]
        ends = {}
        for solver, body, options in (("rock", SHELF, {}), ("respond", SHELF, {"mu": 0.3}), ("slide", 0.2, {})):
            (placed,) = prepare_bodies([body], solver, options)
            ends[solver] = solver_studies(solver).end_states(placed, motion, factors, None)
        single = [solve_rock(SHELF, item).outcome for item in scaled]
        assert ends["rock"].overturned.tolist() == [item.overturned for item in single]
        assert ends["rock"].tilt_ratio == pytest.approx([item.max_rotation_ratio for item in single], rel=1e-9)
        assert 0 < ends["rock"].overturned.sum() < 6
        free = [solve_respond(SHELF, item, mu=0.3, sensitivity=False).outcome for item in scaled]
        assert ends["respond"].overturned.tolist() == [item.overturned for item in free]
        stood = ~ends["respond"].overturned
        assert ends["respond"].slip_m[stood] == pytest.approx(
            [abs(item.final_displacement_m) for item in free if not item.overturned], abs=1e-9
        )
        assert np.isinf(ends["respond"].slip_m[~stood]).all()
        slid = [solve_slide(0.2, item).outcome for item in scaled]
        assert ends["slide"].slip_m == pytest.approx([max(item.max_slip_m, abs(item.final_slip_m)) for item in slid], abs=1e-12)

    def test_tilt_of_sample_is_relative_to_its_slenderness(self, records):
        """A lean is over the slenderness of the version that leans, worn and resized as it is, not of the body in the middle."""
        motion, factors, draws = motion_of(records[1], "EW"), np.array([0.5, 1.0, 1.6]), version_draws(5, 4)
        shelf, (tall, worn, rough, bouncy, _, _, wide, _) = SHELF.with_wear(0.1), draws.T
        rocking = [min(0.9 * (1.0 + 0.1 * entry), 1.0) for entry in bouncy]
        blocks = [
            Block(0.3 * (1.0 + 0.05 * a), 1.2 * (1.0 + 0.05 * b)).with_wear(0.1 + 0.01 * c)
            for a, b, c in zip(wide, tall, worn, strict=True)
        ]
        assert bouncy.min() < 0.0 < bouncy.max()
        for solver, options in (("rock", {"restitution": 0.9}), ("respond", {"mu": 0.5})):
            (placed,) = prepare_bodies([shelf], solver, options)
            ends = solver_studies(solver).end_states(placed, motion, factors, draws)
            single = []
            for factor in factors:
                item = Motion(motion.acceleration * factor, motion.dt)
                for v, block in enumerate(blocks):
                    if solver == "rock":
                        outcome = solve_rock(block, item, restitution=rocking[v]).outcome
                        single.append((outcome.overturned, outcome.max_rotation_ratio))
                        continue
                    mu, bounce = 0.5 * (1.0 + 0.2 * rough[v]), 0.1 * bouncy[v]
                    setting = RespondParams(rigid_body(block), mu, mu, max(bounce, 0.0), rocking_share=1.0 + min(bounce, 0.0))
                    fates = respond_many([setting], item)
                    single.append((bool(fates.overturned[0]), fates.max_rotation_rad[0] / block.slenderness))
            stood = ~ends.overturned
            assert ends.overturned.tolist() == [fell for fell, _ in single]
            assert stood.sum() >= 5 and (ends.tilt_ratio[stood] > 0.1).any()
            assert ends.tilt_ratio[stood] == pytest.approx([lean for fell, lean in single if not fell], rel=1e-6, abs=1e-9)

    @pytest.mark.parametrize("solver", ["rock", "respond"])
    def test_tilt_of_asymmetric_block_refers_to_the_corner_concerned(self, solver):
        """The ratio of each run is that of the single answer, also where the block tilts further about its stronger corner."""
        block = seisblock.Block(0.25, 1.0, centroid_offset=-0.05)
        options = {"mu": 0.9} if solver == "respond" else {}
        time = np.arange(0.0, 3.0, 0.01)
        (placed,) = prepare_bodies([block], solver, options)
        about_stronger = 0
        for seed in range(12):
            row = np.random.default_rng(seed).normal(size=time.size)
            motion = Motion.from_arrays(60.0 * np.convolve(row, np.hanning(31), "same") / 15.0, 0.01)
            ratio = solver_studies(solver).end_states(placed, motion, np.array([0.05, 0.1, 0.15, 0.2]), None).tilt_ratio
            for k, factor in enumerate((0.05, 0.1, 0.15, 0.2)):
                outcome = get_solver(solver).solve(block, Motion(factor * motion.acceleration, 0.01), **options).outcome
                assert ratio[k] == pytest.approx(outcome.max_rotation_ratio, rel=1e-6, abs=1e-9)
                about_stronger += 0.0 < outcome.max_rotation_ratio < 0.999 * outcome.max_rotation_rad / block.slenderness
        assert about_stronger >= 2

    @pytest.mark.parametrize(
        ("solver", "options", "perturb"),
        [
            ("rock", {"initial": (0.05, 0.0)}, 0),
            ("respond", {"mu": 0.5, "initial": (0.0, 0.46, 0.05, 0.0, 0.0, 0.0)}, 0),
            ("respond", {"mu": 0.5, "further_points": ((0.3, -0.4),)}, 4),
        ],
    )
    def test_options_of_single_runs_are_rejected(self, solver, options, perturb):
        """An initial state, and further points of samples, would have no effect in rows."""
        motion = Motion.from_arrays(np.sin(np.arange(0.0, 3.0, 0.01)), 0.01)
        (placed,) = prepare_bodies([seisblock.Block(0.2, 0.9)], solver, options)
        with pytest.raises(ParameterError, match=r"have no option `(initial|further_points)`"):
            solver_studies(solver).end_states(placed, motion, np.array([1.0]), version_draws(perturb, 0))
        with pytest.raises(ParameterError, match=r"have no option `(initial|further_points)`"):
            seisblock.uncertainty.sample(solver, placed.body, motion, placed.options, 4)

    def test_pile_runs_equal_solve_stack(self):
        """Overturning of a stone at a factor agrees with the solver of piles."""
        (placed,) = prepare_bodies("lantern", "stack", {"points": 2})
        record = Preparation(window=(25.0, 26.0)).apply(seisblock.read("synthetic_jma.csv"))
        motion = motion_of(record, "EW")
        ends = solver_studies("stack").end_states(placed, motion, np.array([0.1]), None)
        outcome = solve_stack(placed.body, Motion(0.1 * motion.acceleration, motion.dt, record=record), points=2).outcome
        assert ends.overturned.tolist() == [outcome.overturned_any]
        assert ends.slip_m[0] == max(outcome.residual_slip_m.values())

    def test_rocking_initiation_fragility_has_closed_form(self, records):
        """A block leaves its rest at a PGA of g B/H: over PGV the first exceedances are g B/H times PGV/PGA, their moments the curve's."""
        levels = np.geomspace(0.02, 3.0, 800)
        (curve,) = run_fragility(records, SHELF, "rock", limits="rock", im="pgv", method="ida", levels=levels, bootstrap=20).curves
        motions = [motion_of(record, "EW") for record in records]
        exact = np.log([STANDARD_GRAVITY * 0.25 * PGV.of(m) / IM["pga"].of(m) for m in motions])
        half_a_step = np.log(levels[1] / levels[0]) / 2
        assert curve.median == pytest.approx(np.exp(exact.mean()), rel=half_a_step)
        assert curve.beta == pytest.approx(exact.std(ddof=1), abs=half_a_step)
        assert curve.non_monotone_records == 0
        # over PGA there is nothing but a step, and no curve
        with pytest.raises(ParameterError, match=r"never exceeded up to 2[34].* gal, always exceeded from 2[45]"):
            run_fragility(records, SHELF, "rock", limits="rock", im="pga", levels=[2.3, 2.4, 2.5, 2.6], bootstrap=2)

    def test_stripes_and_ida_agree_for_sliding(self, records):
        """Sliding farther than a length is monotone: stripes and first exceedances give one median and beta within their intervals."""
        fragility = {
            method: run_fragility(records, 0.1, "slide", limits="slip=5cm", im="pgv", method=method, bootstrap=200).curves[0]
            for method in ("stripes", "ida")
        }
        assert fragility["ida"].non_monotone_records == 0
        low, high = fragility["stripes"].median_interval
        assert low < fragility["ida"].median < high
        assert fragility["ida"].beta == pytest.approx(fragility["stripes"].beta, rel=0.15)

    def test_cloud_fit_equals_statsmodels(self, records):
        """The cloud fit on the logarithm of the intensity equals the regression of statsmodels."""
        factors = np.exp(np.random.default_rng(5).normal(0.4, 0.3, 20))
        uneven = [Preparation(scale=float(factor)).apply(record) for record, factor in zip(records, factors, strict=True)]
        (curve,) = run_fragility(uneven, SHELF, "rock", im="pgd", method="cloud", bootstrap=50).curves
        motions = [motion_of(record, "EW") for record in uneven]
        fell = np.array([float(solve_rock(SHELF, motion).outcome.overturned) for motion in motions])
        a, b = by_statsmodels(add_constant(np.log([IM["pgd"].of(motion) for motion in motions])), fell, 1)
        assert curve.median == pytest.approx(np.exp(-a / b), rel=INDEPENDENT)
        assert curve.beta == pytest.approx(1.0 / b, rel=INDEPENDENT)
        assert sum(level.exceeding for level in curve.levels) == fell.sum()

    def test_default_levels_span_the_transition(self, records):
        """Default levels: hardly any overturning at the lowest, nearly all at the highest."""
        (curve,) = run_fragility(records, SHELF, "rock", im="pgv", steps=15, bootstrap=2).curves
        shares = [level.exceeding / level.runs for level in curve.levels]
        assert len(shares) == 15 and shares[0] <= 0.02 and shares[-1] >= 0.95

    def test_nested_damage_states_share_beta(self, records):
        """Rocking, a lean and a fall share a beta; their medians rise, and so do the counts from state to state at every level."""
        study = run_fragility(records, SHELF, "rock", limits=("overturn", "rock", "lean=0.5"), im="pgv", steps=20, bootstrap=20)
        assert [curve.limit for curve in study.curves] == ["rock", "lean=0.5", "overturn"]
        medians, betas = zip(*((curve.median, curve.beta) for curve in study.curves), strict=True)
        assert medians[0] < medians[1] < medians[2] and len(set(betas)) == 1
        counts = np.array([[level.exceeding for level in curve.levels] for curve in study.curves])
        assert (np.diff(counts, axis=0) <= 0).all()
        assert len({curve.beta_alone for curve in study.curves}) == 3

    def test_fragility_is_reproducible_by_seed(self, records):
        """Versions and samples are seeded; another seed moves them."""

        def ask(seed):
            return run_fragility(records, SHELF, "rock", im="pgv", steps=12, bootstrap=50, perturb=3, seed=seed).curves[0]

        assert ask(1) == ask(1)
        assert ask(1).median_interval != ask(2).median_interval

    def test_bootstrap_draws_components_of_record_together(self, records):
        """The interval is over records: a duplicate of each record leaves it unchanged."""
        twice = [
            Record(station=r.station, start=None, dt=r.dt, components=(r.components[0], Component("NS", r.components[0].acceleration, 0.0)))
            for r in records
        ]
        first, two = (run_fragility(subset, SHELF, "rock", im="pgv", steps=15, bootstrap=100).curves[0] for subset in (records, twice))
        assert (two.records, two.motions) == (20, 40)
        assert two.median_interval == pytest.approx(first.median_interval, rel=ROUND_OFF)
        assert two.beta_interval == pytest.approx(first.beta_interval, rel=ROUND_OFF)

    @pytest.mark.parametrize(
        ("change", "says"),
        [
            ({"records": 1}, "requires several records"),
            ({"levels": [0.001, 0.002]}, "not exceeded at any level up to 0.2 kine; use higher"),
            ({"levels": [90.0, 100.0]}, "from 9000 kine; use lower"),
            ({"method": "ida", "levels": [1.0]}, "at least two levels"),
            ({"method": "cloud", "levels": [1.0, 2.0]}, "uses unscaled records"),
            ({"method": "mean"}, "unknown method 'mean'"),
            ({"solver": "jump"}, "unknown solver 'jump'"),
            ({"solver": "slide", "limits": "slip=1cm", "perturb": 3}, "has no effect with slide"),
            ({"limits": ()}, "no limit given"),
            ({"im": ()}, "no intensity measure"),
            ({"confidence": 1.5}, r"must lie in \(0, 1\)"),
        ],
    )
    def test_run_fragility_rejects_invalid_requests(self, change, says, records):
        """One record, levels that say nothing, and words that mean nothing."""
        keywords = {"im": "pgv", "bootstrap": 2, **change}
        subset = records[: keywords.pop("records", 20)]
        solver = keywords.pop("solver", "rock")
        with pytest.raises(ParameterError, match=says):
            run_fragility(subset, 0.2 if solver == "slide" else SHELF, solver, **keywords)

    def test_run_fragility_names_zero_record(self, records):
        """No factor brings stillness to a level."""
        still = Record(station="Q", start=None, dt=0.02, components=(Component("EW", np.zeros(100), 90.0),), source="still.csv")
        with pytest.raises(ParameterError, match=r"still.csv, EW: the motion is zero"):
            run_fragility([*records, still], SHELF, "rock")


def exceedances_from(log_capacities, levels):
    """Return runs, (m, n, v, 1), of motions and versions that happen from their own intensity on."""
    return (log_capacities[:, None, :] <= np.log(levels)[:, None])[..., None]


def one_curve(log_capacities, levels, *, method="stripes", measures=(PGV,), values=None):
    """Return the fragility of invented runs of one body and one limit."""
    count = len(log_capacities)
    suite = make_suite(synthetic_suite(count, seconds=3.0), (), Preparation())
    runs = Exceedances(
        "shelf",
        (limit_state("overturn"),),
        exceedances_from(log_capacities, levels),
        np.tile(levels, (count, 1)),
        values or [np.ones(count)],
    )
    ((curve, _),) = estimate_curves(runs, suite, FitOptions(method, measures, 0.95, 20, 0))
    return curve


class TestScatter:
    @pytest.mark.parametrize("method", ["stripes", "ida"])
    def test_scatter_obeys_law_of_total_variance(self, method):
        """Motions of beta 0.4, versions whose medians differ by 0.3: both are found, and their squares add up to that of all runs."""
        rng = np.random.default_rng(2)
        motions, versions = rng.normal(0.0, 0.4, 60), rng.normal(0.0, 0.3, 40)
        curve = one_curve(motions[:, None] + versions, np.geomspace(0.05, 20.0, 150), method=method)
        assert curve.dispersion.beta_record_to_record == pytest.approx(motions.std(ddof=1), rel=0.1)
        assert curve.dispersion.beta_parameter == pytest.approx(versions.std(ddof=1), rel=0.02)
        assert curve.beta == pytest.approx(curve.dispersion.beta_sum, rel=0.05)

    def test_fragility_samples_equal_perturb_samples(self, records):
        """The share of versions that fall at a factor of 1 is that of `perturb` with the shaking left alone."""
        motion = motion_of(records[4], "EW")
        (placed,) = prepare_bodies([SHELF], "rock", {})
        factor = 1.4
        ends = solver_studies("rock").end_states(placed, motion, np.array([factor]), version_draws(60, 7))
        scaled = Motion(motion.acceleration * factor, motion.dt)
        same = seisblock.uncertainty.perturb(
            SHELF, scaled, 60, spread=seisblock.uncertainty.ParameterVariation(amplitude=0.0, azimuth_deg=0.0), seed=7
        )
        assert int(ends.overturned.sum()) == same.overturned
        assert 0 < same.overturned < 60

    def test_non_monotone_motion_is_counted(self):
        """It falls at one level and stands at the next: counted, and its first exceedance is what `ida` takes."""
        passed = np.array([[False, True, False, True], [False, False, True, True], [False, False, False, False]])
        result = capacities(passed, np.log([1.0, 2.0, 4.0, 8.0]))
        assert result.monotone.tolist() == [False, True, True]
        assert np.exp(result.log_factor) == pytest.approx([np.sqrt(2.0), np.sqrt(8.0), np.inf])

    def test_efficiency_slope_equals_scipy_regression(self):
        """Capacities that depend on the shape of the motion: the slope that is left is that put in, as scipy's regression has it."""
        rng = np.random.default_rng(1)
        shape = rng.normal(0.0, 0.5, 40)
        logs = 0.8 * shape + rng.normal(0.0, 0.2, 40)
        result = efficiency_of_capacities(PGV, np.ones(40), logs[:, None], [("ln(pgv/pga)", shape), ("magnitude", np.full(40, np.nan))])
        second = linregress(shape, logs)
        (slope,) = result.sufficiency
        assert (slope.slope_ratio, slope.probability) == pytest.approx((second.slope, second.pvalue), rel=1e-6)
        better = efficiency_of_capacities(PGV, np.exp(-0.8 * shape), logs[:, None], [("ln(pgv/pga)", shape)])
        assert better.beta < 0.5 * result.beta and better.sufficiency[0].probability > 0.05

    def test_cloud_slope_equals_statsmodels(self):
        """A property that matters comes out of the ratio of the likelihoods as statsmodels has it."""
        rng = np.random.default_rng(4)
        x, z = rng.normal(0.0, 0.6, 120), rng.normal(0.0, 1.0, 120)
        fell = (x + 0.5 * z > rng.normal(0.0, 0.5, 120)).astype(float)
        result = efficiency_of_cloud(PGV, np.exp(x), fell, 1.0, [("magnitude", z)])
        a, b, c = by_statsmodels(np.column_stack([np.ones(120), x, z - z.mean()]), fell, 1)
        assert result.sufficiency[0].slope_ratio == pytest.approx(-c / b, rel=INDEPENDENT)
        assert result.sufficiency[0].probability < 1e-4 and a == a

    def test_goodness_of_fit_rejects_bimodal_data(self):
        """Forty draws of a lognormal pass, two humps far apart do not: in stripes, first exceedances and clouds."""
        levels = np.geomspace(0.02, 20.0, 60)
        first, two = np.log(sample(40)), np.log(np.concatenate([sample(30, median=0.1, beta=0.1), sample(10, median=3.0, beta=0.1)]))
        for logs, fits in ((first, True), (two, False)):
            counts = (np.exp(logs)[:, None] <= levels).sum(axis=0).astype(float)
            rng = np.random.default_rng(0)
            assert goodness_of_stripes(fit_fragility(levels, counts, 40), levels, counts, 40.0, 40, rng).fits is fits
            curve = Lognormal(float(np.exp(logs.mean())), float(logs.std(ddof=1)))
            assert goodness_of_capacities(curve, logs, np.log(20.0), rng).fits is fits
        rng = np.random.default_rng(8)
        x = np.exp(rng.uniform(-2.0, 2.0, 400))
        for chance, fits in ((ndtr(np.log(x) / 0.8), True), (np.where(np.abs(np.log(x)) < 1.0, 0.5, x > 1.0), False)):
            fell = (rng.uniform(size=400) < chance).astype(float)
            assert goodness_of_cloud(fit_fragility(x, fell, 1), x, fell, 1.0, rng).fits is fits


def test_all_azimuths_counts_any_direction():
    """Exceedance in any of 36 directions (two-sided: 72) counts, at the maximum intensity over them, with a note."""
    subset = [
        Record(tuple(Component(code, row) for code, row in zip(("NS", "EW", "UD"), shaking(seed)[1], strict=True)), 0.005 * (1 + seed))
        for seed in range(3)
    ]
    for body in (SHELF, Block(0.3, 1.2, centroid_offset=0.03, name="lopsided")):
        study = run_fragility(subset, body, "rock", im="pga", levels=[4.0, 8.0, 12.0, 18.0], components="all-azimuths", bootstrap=20)
        (curve,) = study.curves
        assert (curve.records, curve.motions) == (3, 3)
        assert any("all azimuths in steps of 5 degrees" in note for note in study.notes)
        for level in curve.levels:
            falls = 0
            for record in subset:
                largest = max(IM["pga"].of(motion_of(record, str(azimuth))) for azimuth in range(0, 180, 5))
                scaled = seisblock.records.scale(record, level.im / largest)
                falls += any(direction.overturned for direction in seisblock.studies.rock_directions(body, scaled))
            assert (level.exceeding, level.runs) == (falls, 3)
    counts = [level.exceeding for level in curve.levels]
    assert counts[0] < counts[-1]
    with pytest.raises(ParameterError, match="stack does not support all azimuths"):
        run_fragility(subset, seisblock.load_pile("wagata"), "stack", components="all-azimuths")


def test_floor_motion_intensity_is_that_of_ground():
    """Of what stands on a storey: each run is that of the storey's motion times the same factor, at a level of the ground."""
    storey = Storey(0.5, height=0.9)
    records = synthetic_suite(3)
    levels = np.geomspace(0.06, 0.4, 16)
    on_it = run_fragility(records, Block(0.3, 1.2), "rock", im="pgv", levels=levels, bootstrap=2, preparation=Preparation(floor=storey))
    for count, level in zip(on_it.curves[0].levels, levels, strict=True):
        fell = 0
        for record in records:
            for component in record.horizontals:
                factor = level / PGV.of(motion_of(record, component.code))
                fell += rock_verdict(
                    Block(0.3, 1.2), motion_of(floor_motion(process.scale(record, factor), storey), component.code)
                ).overturned
        assert count.exceeding == fell
    assert any("intensities of the ground motion" in note for note in on_it.notes)
    assert pelicun_rows(on_it)[1][0][2] == "Peak Ground Velocity"


@pytest.mark.parametrize("method", ["stripes", "ida"])
def test_run_fragility_leaves_out_and_names_a_run_without_an_answer(monkeypatch, records, method):
    """One run of one motion is given up: its level has one run less, the fit goes on, and a note names record and level."""
    levels = np.array([0.3, 0.36, 0.42, 0.5])

    def study():
        return run_fragility(records, SHELF, "respond", mu=0.7, im="pgv", levels=levels, method=method, bootstrap=20)

    full = study()
    follow, calls = solver_studies("respond").end_states, []

    def lossy(placed, motion, factors, draws):
        ends = follow(placed, motion, factors, draws)
        calls.append(motion)
        gave_up = np.zeros(factors.size, dtype=bool)
        gave_up[1] = len(calls) == 1
        return EndStates(ends.overturned & ~gave_up, ends.tilt_ratio, ends.slip_m, gave_up)

    studies = replace(solver_studies("respond"), end_states=lossy)
    monkeypatch.setattr("seisblock.studies.fragility.run.solver_studies", lambda name: studies)
    partial = study()
    curve = partial.curves[0]
    assert (full.curves[0].no_answer, curve.no_answer) == (0, 1)
    motions = curve.motions
    assert [level.runs for level in curve.levels] == [motions, motions - 1, motions, motions]
    assert curve.median == pytest.approx(full.curves[0].median, rel=0.1)
    assert any("1 of" in note and "stopped without a result" in note and calls[0].name in note for note in partial.notes)


def test_capacities_leave_out_levels_without_an_answer():
    """The level below the first one that is passed is the last of those that have an answer."""
    passed = np.array([[False, False, True, True], [False, False, False, False]])
    valid_mask = np.array([[True, False, True, True], [False, False, False, False]])
    result = capacities(passed, np.array([0.0, 1.0, 2.0, 3.0]), valid_mask)
    assert result.log_factor.tolist() == [1.0, np.inf]
    assert result.monotone.all()
