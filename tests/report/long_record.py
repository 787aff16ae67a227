"""A record of 300 s, what each model makes of it, and every kind of figure that is drawn of it, each solved once."""

import functools
import inspect
import pkgutil
from dataclasses import replace
from datetime import UTC, datetime
from importlib import import_module
from types import SimpleNamespace

import numpy as np

from seisblock import (
    Block,
    Contact,
    Pile,
    PileStone,
    SlidingBase,
    SpringBlock,
    TwoLayerBlock,
    solve_jump,
    solve_respond,
    solve_rigid3d,
    solve_rock,
    solve_slide,
    solve_stack,
    solve_uplift,
)
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.scan.scan import scan_body
from seisblock.core.registry import solver_names
from seisblock.fragility import find_risk, read_hazard, run_fragility
from seisblock.measures import measure, response_spectrum
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d import plot as rigid3d_plot
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rock.options import RockOptions
from seisblock.output import figures as shared
from seisblock.output.figures import solver
from seisblock.output.figures.solver import response_figure
from seisblock.paper import Inputs, find_item, find_paper
from seisblock.records import Component, Preparation, Record, motion_of
from seisblock.records.process import scale
from seisblock.records.site import Earthquake
from seisblock.report import figures
from seisblock.report.figures import (
    azimuths,
    body,
    cemetery,
    criteria,
    field_test,
    fit,
    fragility,
    infer,
    input_panels,
    jma_evidence,
    mode_map,
    paper,
    risk,
    scenario,
    secure,
    slide_study,
    sliding_spectrum,
    spectrum,
    stack_criterion,
    uplift_harmonic,
    variants,
)
from seisblock.report.figures import stations as stations_figure
from seisblock.report.figures.measure import measure_figure
from seisblock.studies import fit_block
from seisblock.studies.assessment import assess_direction
from seisblock.studies.criteria_comparison import compare_criteria
from seisblock.studies.fragility.io import FragilityCurve
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.gravestone_criterion import CriterionStudy, GravestoneFit, Threshold
from seisblock.studies.map.station_response import StationCemetery, StationResult
from seisblock.studies.map.stations import StationReport, Stations
from seisblock.studies.respond.azimuths import respond_directions, rigid3d_directions
from seisblock.studies.respond.mode_map import mode_map as map_of_modes
from seisblock.studies.rocking.azimuths import rock_directions
from seisblock.studies.rocking.spectrum import default_sizes, default_slendernesses, rocking_spectrum, rocking_spectrum_all_azimuths
from seisblock.studies.scenario.assess import ObjectRisk
from seisblock.studies.scenario.peaks import assess_peaks
from seisblock.studies.scenario.secure import Measure, Security
from seisblock.studies.sliding import slide_study as study_of_sliding
from seisblock.studies.survey.assessment import AssessmentMethod, assess_cemetery, overturning_curve
from seisblock.studies.survey.assumptions import make_assumptions
from seisblock.studies.survey.estimate import estimate_shaking
from seisblock.studies.survey.likelihood import counted_survey
from seisblock.studies.survey.scale_search import scale_factors, slide_displacement
from seisblock.studies.survey.shaking import component_shakings
from seisblock.studies.survey.twist import FactorInterval, TwistEstimate, TwistRun
from seisblock.studies.uplift_regions import DEFAULT_RATIOS, harmonic_blocks, uplift_region
from tests.studies.fit.conftest import shaken

DT, SAMPLES = 0.01, 30_000


@functools.cache
def record():
    """Return 300 s at 100 Hz, three components, of which some twenty seconds shake."""
    rng = np.random.default_rng(11)
    time = DT * np.arange(SAMPLES)
    envelope = np.where(time < 50.0, 0.0, ((time - 50.0) / 4.0) ** 2 * np.exp(-(time - 50.0) / 3.0)) + 1e-4
    f = np.fft.rfftfreq(SAMPLES, DT)
    parts = []
    for code, peak, middle in (("NS", 4.5, 1.3), ("EW", 3.6, 1.0), ("UD", 1.4, 4.0)):
        shape = f**2 / ((f**2 - middle**2) ** 2 + (1.2 * middle * f) ** 2 + 1e-9)
        values = np.fft.irfft(np.fft.rfft(rng.standard_normal(SAMPLES)) * shape, SAMPLES) * envelope
        parts.append(Component(code, values * peak / np.abs(values).max()))
    mapping = {"clock": "JST", "station_name": "小さな町 $a_b$"}
    return Record(tuple(parts), DT, station="X012", start=datetime(2024, 1, 1, 7, 10, tzinfo=UTC), metadata=mapping)


def motion(component="NS", factor=1.0):
    return motion_of(scale(record(), factor), component)


PAVILION = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
STONES = Pile("two", (PileStone("base", 0.5, 0.5, 0.2), PileStone("sao", 0.25, 0.25, 0.7, on="base")))

SOLVED = {
    "respond": lambda c: solve_respond(Block(0.45, 1.8), motion(c), mu=0.3),
    "rock": lambda c: solve_rock(Block(0.3, 0.9), motion(c)),
    "slide": lambda c: solve_slide(SlidingBase(0.15), motion(c)),
    "jump": lambda c: solve_jump(PAVILION, motion(c, 1.6), contact=Contact(mu=0.18)),
    "uplift": lambda c: solve_uplift(SpringBlock.from_frequency(1.0, 1.0, 2.0, frequency_vertical=6.0, beta=0.7), motion(c)),
    "stack": lambda c: solve_stack(STONES, motion(c, 2.0)),
    "rigid3d": lambda c: solve_rigid3d(Block(0.3, 0.9), motion(c), mu=0.6),
}


@functools.cache
def response(model, component="NS"):
    return SOLVED[model](component)


@functools.cache
def every_azimuth(model):
    if model == "rock":
        return rock_directions(Block(0.3, 0.9), record(), step_deg=15.0)
    if model == "rigid3d":
        return rigid3d_directions(Block(0.24, 0.72, 0.3), record(), Rigid3dOptions(mu=0.6), step_deg=15.0)
    return respond_directions(Block(0.45, 1.8), scale(record(), 0.7), options=RespondOptions(mu=0.3), step_deg=15.0)


FALLS = SimpleNamespace(runs=50, fell_azimuths_deg=(3.0, 5.0, 20.0, 181.0))
AOYAMA = read_cemetery("aoyama.csv")
VALUES = ("NS", "EW")


def prepared_record():
    """Return the record, worked on, so that the title has something to say of it."""
    return Preparation(highpass_hz=0.1, scale=1.2).apply(record())


@functools.cache
def cards():
    return [compare_criteria(record(), motion(name), Block(0.3, 0.9), options=RockOptions(gravity=9.81)) for name in VALUES]


@functools.cache
def spectra():
    return [(motion(c), rocking_spectrum(default_sizes(12), default_slendernesses(12), motion(c))) for c in VALUES]


@functools.cache
def azimuth_spectra():
    directions = rocking_spectrum_all_azimuths(default_sizes(8), default_slendernesses(8), record(), step_deg=45.0)
    return [(replace(motion("NS"), name="all-azimuths"), directions)]


@functools.cache
def slides():
    return [(motion(c), study_of_sliding([0.05 * i for i in range(1, 11)], motion(c))) for c in VALUES]


@functools.cache
def study(**choice):
    return [study_of_sliding(motions=motion("NS"), **choice)]


@functools.cache
def maps(*, sizes=(1.0,), ratios=(0.1, 0.2, 0.3, 0.4, 0.5)):
    return [(motion(c), map_of_modes([0.1, 0.2, 0.4, 0.6], sizes, np.arctan(ratios), motion(c))) for c in VALUES]


@functools.cache
def rates(*, after=False):
    dowelled = AOYAMA.with_dowels() if after else None
    return [
        assess_cemetery(AOYAMA, shaking, AssessmentMethod(), reinforced_cemetery=dowelled)
        for shaking in component_shakings(record(), VALUES)
    ]


@functools.cache
def shaking_estimates():
    survey, assumptions = counted_survey(AOYAMA, 35, 100), make_assumptions(None)
    return "aoyama", survey, assumptions, [estimate_shaking(survey, f, assumptions) for f in (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)]


@functools.cache
def risks():
    hazard = read_hazard("synthetic_hazard.csv")
    curves = [FragilityCurve("stone", limit, "pgv", "m/s", Lognormal(median, 0.4)) for limit, median in (("rock", 0.3), ("overturn", 0.7))]
    return [(item, find_risk(item.curve, hazard)) for item in curves], hazard


NAMES = tuple(f"益城町宮園中央小学校の長い名前の墓石その{i}" for i in range(1, 10))


@functools.cache
def many_risks():
    """Return what becomes of nine bodies with long names."""
    hazard = read_hazard("synthetic_hazard.csv")
    curves = [FragilityCurve(name, "overturn", "pgv", "m/s", Lognormal(0.2 + 0.1 * i, 0.3)) for i, name in enumerate(NAMES)]
    return [(item, find_risk(item.curve, hazard)) for item in curves], hazard


@functools.cache
def fragilities(*, names=("stone",), limits=("rock", "overturn")):
    """Return the curves of some bodies, each wider than the one before, over the record and two others."""
    bodies = {name: Block(0.3 + 0.01 * i, 0.9) for i, name in enumerate(names)}
    suite = [record(), "elcentro_1940_ns.csv", "synthetic_jma.csv"]
    return run_fragility(suite, bodies, "rock", limits=limits, im="pgv", steps=10, bootstrap=20)


@functools.cache
def factors():
    base = SlidingBase(0.15)
    return [(record(), scale_factors(slide_displacement(base, motion(c)), 0.05, motion(c), limit=2.0, steps=20)) for c in VALUES]


def twists():
    """Return estimates from a twist as they come out, without their runs: of two directions, of which one has no interval."""
    rng = np.random.default_rng(5)
    scales = np.sort(np.exp(rng.uniform(np.log(0.3), np.log(3.0), 60)))
    runs = [
        TwistRun(s, t, 0.01 * s, s > 1.5 and t > 0.0, float(np.exp(-((abs(t) - 3.0) ** 2))))
        for s, t in zip(scales, scales * rng.normal(0.0, 3.0, 60), strict=True)
    ]
    interval = FactorInterval(1.1, 0.7, 1.6)
    estimate = TwistEstimate(
        "NS", 3.0, 0.02, interval, FactorInterval(5.0, 3.2, 7.2), FactorInterval(0.5, 0.3, 0.7), 21.0, 60, 8.0, tuple(runs)
    )
    return [
        (record(), estimate),
        (record(), replace(estimate, component="EW", scale=None, pga_m_s2=None, pgv_m_s=None, effective_runs=1.5)),
    ]


@functools.cache
def many_responses():
    """Return more responses of a model than stand side by side, of two strengths."""
    return [solve_rock(Block(0.3, 0.9), motion(c, factor)) for c in VALUES for factor in (1.0, 1.3)]


@functools.cache
def regions(figure=None, **ratios):
    names = dict.fromkeys(("alpha", "gamma", "phi", "rho", "beta", "damping")) | ratios
    return [uplift_region(body, DEFAULT_RATIOS, phi_deg=phi, rho_deg=rho) for body, phi, rho in harmonic_blocks(names, figure=figure)]


def criterion():
    """Return a criterion study as it comes out, without its hours of work: thresholds on the published level."""
    fit = GravestoneFit(8.0, 1.9, 4.6, "this")
    levels = {f: 8.0 * (1.0 + (f / 1.9) ** 4.6) for f in (0.5, 1.0, 2.0, 3.0)}
    thresholds = tuple(Threshold(f, a, level / a) for f, level in levels.items() for a in (3.0, 4.0, 6.0, 9.0) if 1.0 < level / a < 7.0)
    scaled = {"X012 NS": tuple(Threshold(1.4, a, 12.0 / a) for a in (3.0, 4.0, 6.0))}
    return CriterionStudy(thresholds, levels, fit), {f: 0.9 * level for f, level in levels.items()}, scaled


@functools.cache
def stations(subject=None):
    """Return a dozen stations of an earthquake around an epicentre, the worst first, two of them nowhere."""
    answers = []
    for number in range(12):
        north, east = 35.0 + 0.05 * np.sin(2.4 * number) * number, 139.0 + 0.4 * np.cos(2.4 * number)
        effect = StationResult(90.0, max(1.0 - 0.12 * number, 0.0))
        code, pga = f"X{number:03d}", 8.0 / (1 + number)
        answers.append(StationReport(f"{code}.NS", code, "小さな町", north, east, pga_m_s2=pga, effect=effect))
    nowhere = [StationReport("a.csv", pga_m_s2=1.0), StationReport("b.csv", failure="cut short")]
    return Stations((*answers, *nowhere), Earthquake(None, 35.0, 139.0, 10.0, 6.8, "test"), "2024-01-01 16:10:00 JST"), subject


@functools.cache
def fitted_block():
    """Return the block that explains what one did under twelve pulses."""
    return fit_block(shaken(12, 0), runs=1)


def model_figures():
    """Yield the figure of each model, of one direction and of two."""
    for model in solver_names():
        function = import_module(f"seisblock.models.{model}.plot").figure
        yield model, (function, lambda gal, model=model: response_figure([response(model)], gal=gal))
        if model != "stack":
            yield f"{model}, two", (function, lambda gal, model=model: response_figure([response(model, c) for c in VALUES], gal=gal))


PLANE = {"mu": tuple(np.linspace(0.1, 0.6, 9)), "slope_deg": tuple(np.linspace(0.0, 16.0, 9)), "kappa": (0.75, 1.0)}

OF_THE_RECORD = dict(model_figures()) | {
    "any model": (solver.figure, lambda gal: solver.figure([response("slide")], gal=gal)),
    "measure": (measure_figure, lambda gal: measure_figure(record(), measure(record()), gal=gal)),
    "criteria": (criteria.figure, lambda gal: criteria.figure(cards(), gal=gal)),
    "variants": (variants.figure, lambda gal: variants.figure(*friction_variants(), gal=gal)),
    "rocking": (spectrum.figure, lambda _: spectrum.figure(spectra(), "rocking", 9.81)),
    "overturning": (spectrum.figure, lambda _: spectrum.figure(spectra()[:1], "overturning", 9.81)),
    "overturning, all azimuths": (spectrum.figure, lambda _: spectrum.figure(azimuth_spectra(), "overturning", 9.81)),
    "sliding": (sliding_spectrum.figure, lambda _: sliding_spectrum.figure(slides())),
    "study": (
        slide_study.figure,
        lambda _: slide_study.figure([record()], study(mu=(0.1, 0.2, 0.3), kappa=(0.5, 1.0)), slope_length=None, gravity=9.81),
    ),
    "plane": (slide_study.figure, lambda _: slide_study.figure([record()], study(**PLANE), slope_length=None, gravity=9.81)),
    "modes": (mode_map.figure, lambda _: mode_map.figure(maps())),
    "modes of sizes": (mode_map.figure, lambda _: mode_map.figure(maps(sizes=(0.5, 1.0, 2.0), ratios=(1 / 3,)))),
    "rate": (
        cemetery.overturn_rate_figure,
        lambda gal: cemetery.overturn_rate_figure(AOYAMA, [(record(), rates())], overturning_curve(AOYAMA, AssessmentMethod()), gal=gal),
    ),
    "rate with dowels": (
        cemetery.overturn_rate_figure,
        lambda gal: cemetery.overturn_rate_figure(
            AOYAMA, [(record(), rates(after=True))], overturning_curve(AOYAMA, AssessmentMethod()), gal=gal
        ),
    ),
    "factors": (infer.factor_figure, lambda _: infer.factor_figure(factors())),
    "rock, all azimuths": (azimuths.figure, lambda _: azimuths.figure([response("rock")], [every_azimuth("rock")])),
    "rigid3d, all azimuths": (azimuths.figure, lambda _: azimuths.figure([response("rigid3d")], [every_azimuth("rigid3d")])),
    "rigid3d, falls": (
        rigid3d_plot.figure,
        lambda gal: rigid3d_plot.figure([response("rigid3d")], gal=gal, falls=[FALLS]),
    ),
    "respond, all azimuths": (azimuths.figure, lambda _: azimuths.figure([response("respond")], [every_azimuth("respond")])),
    "a record": (input_panels.record_figure, lambda _: input_panels.record_figure(record())),
    "a motion": (input_panels.motion_figure, lambda _: input_panels.motion_figure(motion())),
}
"""What is drawn of a record: by its name, the function and a call of it, given whether accelerations are in gal."""

OBJECTS = (
    ObjectRisk("bookcase of the reading room, north wall", 0.83, 0.95, (0.71, 0.91), 96, "likely overturns"),
    ObjectRisk("display case", 0.21, 0.4, (0.12, 0.33), 96, "may overturn"),
    ObjectRisk("壺", 0.0, 0.5, (0.0, 0.04), 96, "moves"),
    ObjectRisk("without result", failure="friction unknown"),
)

SECURITY = Security(
    "display case", 0.1, 0.42, 96,
    (
        Measure("width", 0.62, "m", 0.09, curve=((0.4, 0.42), (0.5, 0.22), (0.62, 0.09), (0.8, 0.0))),
        Measure("height", None, "m", 0.2, curve=((1.8, 0.42), (1.0, 0.2)), reason="not reached"),
        Measure("base_mass", 85.0, "kg", 0.1, curve=((0.0, 0.42), (40.0, 0.2), (85.0, 0.1))),
        Measure("friction", 0.21, "1", 0.08, curve=((0.4, 0.42), (0.21, 0.08), (0.1, 0.0))),
        Measure("restraint", 310.0, "N", 0.1, moment=420.0, height_m=1.8, curve=((0.0, 0.42), (150.0, 0.3), (310.0, 0.1))),
    ),
)  # fmt: skip
"""Results of a scenario and of its measures, as `scenario` and `secure` give them."""


@functools.cache
def friction_variants():
    """Return the results of two frictions in both directions, as `respond --mu 0.2,0.5` gives them."""
    block, responses, extras = Block(0.45, 1.5), [], []
    for mu in (0.2, 0.5):
        for code in ("NS", "EW"):
            options = RespondOptions(mu=mu)
            responses.append(solve_respond(block, motion(code), **options.keywords()))
            extras.append({"variant": {"mu": mu}, "assessment": assess_direction("respond", block, motion(code), options, 10)})
    return responses, extras


def paper_figure(key, name):
    """Return the figure of an item of a paper, on the paper's own data."""
    source = find_paper(key)
    item = find_item(source, name)
    return paper.figure(source, item, item.compute(Inputs()))


OF_NO_RECORD = {
    "a scan": (body.figure, lambda _: body.figure(scan_body("boulder.ply", inset=0.1))),
    "estimate": (infer.estimate_figure, lambda gal: infer.estimate_figure(*shaking_estimates(), gal=gal)),
    "rate, curves": (
        cemetery.overturn_rate_figure,
        lambda gal: cemetery.overturn_rate_figure(AOYAMA, [], overturning_curve(AOYAMA, AssessmentMethod()), gal=gal),
    ),
    "harmonic": (uplift_harmonic.harmonic_figure, lambda _: uplift_harmonic.harmonic_figure(regions(damping=(0.02, 0.05)))),
    **{
        f"as fig. {number} of Okumura": (
            uplift_harmonic.harmonic_figure,
            lambda _, number=number: uplift_harmonic.harmonic_figure(regions(number), number),
        )
        for number in (3, 4, 6, 8, 11)
    },
    "criterion": (
        stack_criterion.figure,
        lambda gal: stack_criterion.figure(*criterion(), reinforced=False, gal=gal),
    ),
    "risk of nine": (risk.figure, lambda gal: risk.figure(*many_risks(), gal=gal)),
    "fragility": (fragility.figure, lambda gal: fragility.figure(fragilities(), gal=gal)),
    "fragility of nine": (fragility.figure, lambda gal: fragility.figure(fragilities(names=NAMES, limits=("overturn",)), gal=gal)),
    "risk": (risk.figure, lambda gal: risk.figure(*risks(), gal=gal)),
    "fit": (fit.fit_figure, lambda gal: fit.fit_figure(fitted_block(), "shaken.csv", gal=gal)),
    "stations": (stations_figure.figure, lambda gal: stations_figure.figure(*stations(StationCemetery(AOYAMA)), gal=gal)),
    "stations, their shaking": (stations_figure.figure, lambda gal: stations_figure.figure(*stations(), gal=gal)),
    "criteria of peaks": (criteria.peaks_figure, lambda gal: criteria.peaks_figure(assess_peaks(Block(0.24, 0.72), 4.0, 0.4), gal=gal)),
    "JMA's table": (
        jma_evidence.figure,
        lambda _: jma_evidence.figure(
            {"bookcase": np.array([0, 0.2, 0.9, 1, 1]), "filing_cabinet": np.array([0, 0, 0.2, 0.9, 1])},
            {key: np.array([5.8, 6.2]) + 0.1 * i for i, key in enumerate(jma_evidence.WEAR)},
        ),
    ),
    "field test": (field_test.figure, lambda _: field_test.figure()),
    "response spectrum": (
        input_panels.response_spectrum_figure,
        lambda _: input_panels.response_spectrum_figure(response_spectrum(motion().horizontal, DT)),
    ),
    "paper, curves": (paper.figure, lambda _: paper_figure("tsutsui", "fig2")),
    "paper, rates": (paper.figure, lambda _: paper_figure("furukawa2009", "fig14")),
    "scenario": (scenario.figure, lambda _: scenario.figure(OBJECTS, "JMA 6 upper")),
    "secure": (secure.figure, lambda _: secure.figure(SECURITY, "JMA 6 upper")),
    "many histories": (
        solver.small_multiples,
        lambda gal: solver.small_multiples(many_responses(), gal=gal, probabilities=(0.0, 0.12, None, 0.4)),
    ),
    "twist": (infer.twist_figure, lambda gal: infer.twist_figure(twists(), gal=gal)),
    "rocking spectrum": (input_panels.rocking_spectrum_figure, lambda _: input_panels.rocking_spectrum_figure(spectra()[0][1])),
}
"""What is drawn of a paper, a cemetery or of numbers alone."""

EVERY = OF_THE_RECORD | OF_NO_RECORD

NOT_A_KIND = {"style", "svg", "fonts", "fit_size"}
"""Modules that help to draw, and draw nothing themselves."""


def drawing_functions():
    """Return every public function of the figures' modules that returns a figure."""
    modules = [
        import_module(f"{package.__name__}.{item.name}") for package in (figures, shared) for item in pkgutil.iter_modules(package.__path__)
    ]
    modules += [import_module(f"seisblock.models.{model}.plot") for model in solver_names()]
    return {
        function
        for module in modules
        if module.__name__.rsplit(".", 1)[1] not in NOT_A_KIND
        for name, function in inspect.getmembers(module, inspect.isfunction)
        if function.__module__ == module.__name__
        and not name.startswith("_")
        and function is not response_figure  # draws the figure that a model registers
        and function.__annotations__.get("return") in ("Figure", "StyledFigure", "style.StyledFigure")
    }
