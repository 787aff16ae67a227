"""Public functions reject arguments of a wrong type in one sentence, never with an AttributeError from inside."""

import pickle

import numpy as np
import pytest

import seisblock as sb
from seisblock.core._display import exact_repr
from seisblock.models.jump.options import JumpOptions
from seisblock.models.respond.options import RespondOptions

RECORD = sb.read("synthetic_jma.csv")
LEVEL = sb.read("elcentro_1940_ns.csv")
MOTION = sb.motion_of(sb.records.crop(RECORD, 24.0, 26.0), "EW")
BLOCK, LAYERS, PILE = sb.load_block("gravestone"), sb.load_two_layer("chozusha"), sb.load_pile("wagata")
SPRINGS = sb.SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707)
CEMETERY = sb.read_cemetery("aoyama.csv")
PARAMS = sb.models.respond_params(BLOCK, options=RespondOptions(mu=0.3))

OF_MOTIONS = {
    "mode_map": lambda motion: sb.studies.mode_map([0.3], [1.0], [0.2], motion),
    "slide_study": lambda motion: sb.studies.slide_study(0.2, motion),
    "respond_probability": lambda motion: sb.uncertainty.respond_probability(BLOCK, motion, options=RespondOptions(mu=0.3), runs=2),
    "stack_probability": lambda motion: sb.uncertainty.stack_probability(PILE, motion, runs=2),
    "respond_many": lambda motion: sb.models.respond_many([PARAMS], motion),
    "jump_many": lambda motion: sb.models.jump_many([LAYERS], motion, contacts=[sb.load_contact("chozusha")]),
    "uplift_many": lambda motion: sb.models.uplift_many([SPRINGS], motion),
    "scale_factors": lambda motion: sb.survey.scale_factors(lambda factor: factor, 0.05, motion),
    "rock_verdict": lambda motion: sb.models.rock_verdict(BLOCK, motion),
    "perturb": lambda motion: sb.uncertainty.perturb(BLOCK, motion, 2),
    "find_margin": lambda motion: sb.studies.find_margin(BLOCK, motion),
    "rocking_spectrum": lambda motion: sb.studies.rocking_spectrum([1.0], [0.2], motion),
    "slid": lambda motion: sb.survey.slide_displacement(0.2, motion),
    "jumped": lambda motion: sb.survey.jump_displacement(LAYERS, motion, options=JumpOptions(contact=sb.load_contact("chozusha"))),
}
OF_RECORDS = {
    "demean": sb.records.demean,
    "crop": lambda record: sb.records.crop(record, 1.0, 2.0),
    "scale": lambda record: sb.records.scale(record, 2.0),
    "scale_to_pga": lambda record: sb.records.scale_to_pga(record, 3.0),
    "highpass": lambda record: sb.records.highpass(record, 0.1),
    "rotate": lambda record: sb.records.rotate(record, 30.0),
    "towards": lambda record: sb.records.component_at_azimuth(record, 30.0),
    "measure": sb.measure,
    "jma_intensity": sb.measures.jma_intensity,
    "motion_of": lambda record: sb.motion_of(record, "EW"),
    "Preparation": lambda record: sb.records.Preparation(window=(1.0, 2.0)).apply(record),
    "respond_directions": lambda record: sb.studies.respond_directions(BLOCK, record, options=RespondOptions(mu=0.3)),
}
OF_BODIES = {
    "make_setting": (lambda body: sb.models.respond_params(body, options=RespondOptions(mu=0.3)), "Block"),
    "respond_probability": (lambda body: sb.uncertainty.respond_probability(body, MOTION, options=RespondOptions(mu=0.3), runs=2), "Block"),
    "stack_probability": (lambda body: sb.uncertainty.stack_probability(body, MOTION, runs=2), "Pile"),
    "respond_directions": (lambda body: sb.studies.respond_directions(body, RECORD, options=RespondOptions(mu=0.3)), "Block"),
    "overturning_card": (lambda body: sb.criteria.overturning_card(body, 3.0, 0.4, {}), "Block"),
    "natural_modes": (sb.models.natural_modes, "SpringBlock"),
    "uplift_thresholds": (lambda body: sb.models.uplift_thresholds(body, [1.0]), "SpringBlock"),
    "uplift_minima": (sb.models.uplift_minima, "SpringBlock"),
    "criterion_study": (sb.survey.criterion_study, "Pile"),
    "overturning_rate": (lambda body: sb.survey.overturning_rate(body, 5.0, 2.0), "Cemetery"),
    "rate_curve": (lambda body: sb.survey.rate_curve(body, [5.0], [2.0]), "Cemetery"),
    "marked_survey": (sb.survey.marked_survey, "Cemetery"),
    "counted_survey": (lambda body: sb.survey.counted_survey(body, 3, 10), "Cemetery"),
    "estimate_shaking": (lambda body: sb.survey.estimate_shaking(body, 2.75), "Survey"),
    "contact of solve_jump": (lambda body: sb.solve_jump(LAYERS, MOTION, contact=body), "Contact"),
    "contact of solve_stack": (lambda body: sb.solve_stack(PILE, MOTION, contact=body), "PileContact"),
    "spread of perturb": (lambda body: sb.uncertainty.perturb(BLOCK, MOTION, 2, spread=body), "ParameterVariation"),
    "blocks of jump_many": (lambda body: sb.models.jump_many([body], MOTION, contacts=[sb.load_contact("chozusha")]), "TwoLayerBlock"),
    "contacts of jump_many": (lambda body: sb.models.jump_many([LAYERS], MOTION, contacts=[body]), "Contact"),
    "bodies of uplift_many": (lambda body: sb.models.uplift_many([body], MOTION), "SpringBlock"),
    "settings of respond_many": (lambda body: sb.models.respond_many([body], MOTION), "RespondParams"),
}


@pytest.mark.parametrize("name", OF_MOTIONS)
def test_studies_require_a_motion(name):
    """A record has several components and an array no time step: studies reject both as the solvers do."""
    with pytest.raises(sb.errors.KindError, match=r"found a Record .*: select a component with motion_of\(record, 'NS'\)"):
        OF_MOTIONS[name](RECORD)
    for invalid in (np.zeros(100), "record.csv", None):
        with pytest.raises(sb.errors.KindError, match=r"expected a Motion, found (ndarray|str|None)"):
            OF_MOTIONS[name](invalid)


@pytest.mark.parametrize("name", OF_RECORDS)
def test_record_functions_require_a_record(name):
    """Functions of records name the type that was passed instead."""
    for invalid in (MOTION, "record.csv", None):
        with pytest.raises(sb.errors.KindError, match=r"(a|expected) Record( is needed)?, found (Motion|str|None)"):
            OF_RECORDS[name](invalid)


@pytest.mark.parametrize("name", OF_BODIES)
def test_functions_require_a_body(name):
    """So does what needs a body, a survey, or a contact; a motion in its place is such a thing, too."""
    call, kind = OF_BODIES[name]
    for invalid in (MOTION, 0.3, "gravestone"):
        with pytest.raises(
            sb.errors.KindError, match=rf"(a|expected) {kind}( is needed)?, found (Motion|float|str)|expected the body first"
        ):
            call(invalid)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (
            lambda: sb.measures.response_spectrum(MOTION, 0.01),
            "expected an array of accelerations, found Motion: pass motion.horizontal and motion.dt",
        ),
        (lambda: sb.measures.response_spectrum(MOTION.horizontal, 0.0), "the sampling interval must be positive, found 0 s"),
        (lambda: sb.models.uplift_thresholds(SPRINGS, [1.0], damping="modl"), "`damping` must be one of modal, dashpots, found 'modl'"),
        (
            lambda: sb.survey.counted_survey(CEMETERY, 3.5, 10),
            "whole numbers with 0 <= fallen <= stones and at least one stone, found 3.5/10",
        ),
        (lambda: sb.solve_slide(0.2, MOTION, vertical="yes"), "the vertical gain must be a number, found 'yes'"),
        (lambda: sb.models.rock_verdict(BLOCK, MOTION, scale="2"), "the scale factor must be a number, found '2'"),
        (
            lambda: sb.studies.respond_directions(BLOCK, RECORD, options=RespondOptions(mu=0.3), step_deg=0.0),
            "the azimuth step must be positive",
        ),
        (lambda: sb.Record.from_arrays(np.zeros((3, 9)), dt=0.01), r'expected components by code, \{"NS": array\}, found ndarray'),
        (lambda: sb.records.rotate(RECORD, "NS"), "azimuth must be a finite number of degrees, found NS"),
        (lambda: sb.motion_of(RECORD, None), "no component 'None'; available: NS, EW, UD"),
        (lambda: sb.measures.jma_class("5+"), "the intensity must be a number, found '5\\+'"),
        (lambda: sb.records.crop(RECORD, "a", 2.0), "the start of the window must be a number, found 'a'"),
        (
            lambda: sb.models.uplift_many([SPRINGS] * 2, MOTION, gains=np.ones((3, 3))),
            r"`gains` must have shape \(3,\) or \(2, 3\), one row per run, found \(3, 3\)",
        ),
        (lambda: sb.models.uplift_many([SPRINGS], MOTION, gains=1.0), r"`gains` must have shape .*, found \(\)"),
        (lambda: sb.models.respond_many([PARAMS] * 2, MOTION, gains=np.ones((3, 3))), r"\(2, 3\), one row per run, found \(3, 3\)"),
        (lambda: sb.models.respond_many([PARAMS], MOTION, gains="abc"), "`gains` must be numbers, found 'abc'"),
        (
            lambda: sb.Record.from_arrays({"EW": np.ma.masked_greater(np.arange(9.0), 6.0)}, dt=0.01),
            "the accelerations: 2 of 9 values are masked; fill the gaps",
        ),
        (lambda: sb.Motion.from_arrays(np.ma.masked_greater(np.arange(9.0), 6.0), 0.01), "2 of 9 values are masked"),
        (lambda: sb.solve_rock(BLOCK, MOTION, restitution="0.9"), r"`restitution` .* must lie in \[0, 1\], found '0.9'"),
        (lambda: sb.load_block(None), "expected a path or a name, found None"),
        (lambda: sb.load_two_layer(3), "expected a path or a name, found int"),
        (lambda: sb.read_cemetery(b"aoyama.csv"), "expected a path or a name, found bytes"),
        (lambda: sb.Motion.from_arrays("a", 0.01), "the horizontal acceleration must be numbers, found 'a'"),
        (lambda: sb.Motion.from_arrays([[1.0], [1.0, 2.0]], 0.01), "the horizontal acceleration must be numbers"),
        (lambda: sb.Motion.from_arrays([0.0, 1.0], 0.01, vertical=[None, 1.0]), "the vertical acceleration must be numbers"),
        (lambda: sb.measures.response_spectrum(["1", "2"], 0.01), "the accelerations must be numbers, found \\['1', '2'\\]"),
        (lambda: sb.survey.rate_curve(CEMETERY, ["a"]), "the peak ground accelerations must be numbers, found \\['a'\\]"),
        (lambda: sb.survey.rate_curve(CEMETERY, [3.0], [None]), "the frequencies must be numbers, found \\[None\\]"),
        (lambda: sb.survey.rate_curve(CEMETERY, limits="rigid"), "the criterion must be a function, found str"),
        (lambda: sb.survey.overturning_rate(CEMETERY, 3.0, 1.0, limits=3), "the criterion must be a function, found int"),
        (lambda: sb.survey.overturning_rate(CEMETERY, 3.0, "2 Hz"), "the frequency must be a number, found '2 Hz'"),
        (lambda: sb.survey.scale_factors(3.0, 0.05, MOTION), "the displacement must be a function, found float"),
        (lambda: sb.survey.scale_factors(lambda factor: factor, 0.05, MOTION, steps=2.5), "the number of steps must be an integer"),
        (lambda: sb.uncertainty.perturb(BLOCK, MOTION, runs=2.5), "the number of runs must be an integer of at least 1, found 2.5"),
        (lambda: sb.uncertainty.perturb(BLOCK, MOTION, runs=True), "the number of runs must be an integer of at least 1, found True"),
        (
            lambda: sb.uncertainty.respond_probability(BLOCK, MOTION, options=RespondOptions(mu=0.3), runs="2"),
            "the number of runs must be an integer",
        ),
        (
            lambda: sb.solve_stack(PILE, MOTION, points=2.5),
            "the number of points along each side of a joint must be an integer of at least 2",
        ),
        (lambda: sb.models.uplift_thresholds(SPRINGS, "a"), "`frequency_ratio` must be numbers, found 'a'"),
        (lambda: sb.studies.mode_map([0.3], None, [0.2], MOTION), "sizes and slendernesses must be numbers, found None"),
        (lambda: sb.studies.rocking_spectrum(["a"], [0.2], MOTION), "sizes and slendernesses must be numbers, found \\['a'\\]"),
        (lambda: sb.read(3), "expected a path or a list of paths, found int"),
        (lambda: sb.read(np.zeros(3)), "expected a path or a list of paths, found ndarray; for arrays use Record.from_arrays"),
        (lambda: sb.read(b"time,NS (gal)"), "expected a path or a list of paths, found bytes"),
        (lambda: sb.readers.read_all(None), "expected a path or a list of paths, found None"),
    ],
)
def test_functions_reject_wrong_values(call, says):
    """Neither taken in silence nor left to numpy."""
    with pytest.raises(sb.InputError, match=says):
        call()


def test_read_all_accepts_single_path():
    """`read_all` takes a path for what it is, not for a list of letters."""
    assert [record.codes for record in sb.readers.read_all("synthetic_jma.csv")] == [("NS", "EW", "UD")]


VERTICAL = {
    "slide": lambda motion, vertical: sb.solve_slide(0.2, motion, vertical=vertical),
    "rock": lambda motion, vertical: sb.solve_rock(BLOCK, motion, vertical=vertical),
    "uplift": lambda motion, vertical: sb.solve_uplift(SPRINGS, motion, vertical=vertical),
    "respond": lambda motion, vertical: sb.solve_respond(BLOCK, motion, mu=0.3, vertical=vertical, sensitivity=False),
    "stack": lambda motion, vertical: sb.solve_stack(PILE, motion, points=2, vertical=vertical),
    "respond_probability": lambda motion, vertical: sb.uncertainty.respond_probability(
        BLOCK, motion, options=RespondOptions(mu=0.3, vertical=vertical), runs=2
    ),
    "mode_map": lambda motion, vertical: sb.studies.mode_map([0.3], [1.0], [0.2], motion, vertical=vertical),
    "respond_directions": lambda motion, vertical: sb.studies.respond_directions(
        BLOCK, motion.record, options=RespondOptions(mu=0.3, vertical=vertical), step_deg=90.0
    ),
}


@pytest.mark.parametrize("name", VERTICAL)
def test_vertical_has_same_meaning_everywhere(name):
    """Asked for, it is refused where the record has none; None takes what there is; a factor scales it."""
    solve = VERTICAL[name]
    flat = sb.Record(tuple(RECORD.horizontals), RECORD.dt, source="level.csv")
    level = sb.motion_of(sb.records.crop(flat, 24.0, 24.5), "EW")
    for flag in (True, 0.5):
        with pytest.raises(sb.errors.ComponentError, match=r"level.csv: no vertical component \(components: NS, EW\)"):
            solve(level, flag)
    assert outcome_text(solve(level, None)) == outcome_text(solve(level, False))
    shaken = sb.motion_of(sb.records.crop(RECORD, 24.0, 24.5), "EW")
    assert outcome_text(solve(shaken, None)) == outcome_text(solve(shaken, True)) == outcome_text(solve(shaken, 1.0))
    assert outcome_text(solve(shaken, 0.5))


def outcome_text(answer):
    """Return the text of a result to the last digit."""
    return exact_repr(getattr(answer, "outcome", answer))


@pytest.mark.parametrize(
    "answer",
    [
        lambda: sb.solve_slide(0.2, MOTION),
        lambda: sb.solve_rock(BLOCK, MOTION),
        lambda: sb.solve_jump(LAYERS, MOTION, contact=sb.load_contact("chozusha")),
        lambda: sb.solve_uplift(SPRINGS, MOTION),
        lambda: sb.solve_respond(BLOCK, MOTION, mu=0.3),
        lambda: sb.solve_stack(PILE, sb.motion_of(sb.records.crop(RECORD, 24.0, 24.2), "EW"), points=2),
    ],
    ids=["slide", "rock", "jump", "uplift", "respond", "stack"],
)
def test_response_survives_pickling(answer):
    """Pickled, a response brings its outcome and its curves along, and shows itself as before; so does its copy's copy."""
    content = answer()
    came = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(content))))
    assert came.outcome == content.outcome
    assert [event.time_s for event in came.events] == [event.time_s for event in content.events]
    np.testing.assert_array_equal(came.time, content.time)
    assert [channel.name for channel in came.channels] == [channel.name for channel in content.channels]
    for first, second in zip(came.channels, content.channels, strict=True):
        np.testing.assert_array_equal(first.values, second.values)
    assert came.summary() == content.summary()


@pytest.mark.parametrize(
    ("keywords", "says"), [({}, "missing .* 'mu'"), ({"mu": 0.5, "restitutoin": 0.1}, "unexpected keyword .* 'restitutoin'")]
)
def test_keyword_errors_name_the_function_called(keywords, says):
    """A missing friction was an error of `RespondOptions.__init__`, a class that the caller had never seen."""
    with pytest.raises(TypeError, match=rf"^solve_respond\(\) .*{says}"):
        sb.solve_respond(BLOCK, MOTION, **keywords)


def test_read_of_a_table_in_memory_points_to_from_arrays():
    """The names of the columns of a DataFrame were taken for files."""
    frame = type("DataFrame", (list,), {"columns": ["EW"]})(["EW"])
    with pytest.raises(sb.errors.KindError, match=r"found DataFrame; for arrays use Record\.from_arrays"):
        sb.read(frame)


def test_friction_of_any_real_type_is_accepted():
    """A float32 was refused as no SlidingBase."""
    expected = sb.solve_slide(0.25, MOTION).outcome
    assert sb.solve_slide(np.float32(0.25), MOTION).outcome == expected
