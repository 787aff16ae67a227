"""One assessment of an object: classes, union of directions, range of the models, predictability."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock import Block, Motion, RespondOptions, assess, load_block, load_pile, motion_of, read, solve_respond, solve_rock
from seisblock.cli import main
from seisblock.core.errors import ParameterError
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.solve import respond_params
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_params
from seisblock.models.rock.verdicts import rock_verdicts
from seisblock.report.text.assessment import headline, object_headline
from seisblock.studies.assessment import LIKELY, MAY, MOVES, STAYS, classify
from seisblock.studies.predictability import respond_predictable_until, rock_predictable_until
from seisblock.studies.sampling import ParameterVariation, draw_samples, sample_gains, sample_respond_params

NOTHING_VARIES = ParameterVariation(size=0.0, inset=0.0, mu=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)
KEYS = [
    "overturning_probability",
    "interval",
    "runs",
    "moved_probability",
    "models",
    "least_factor",
    "greatest_factor",
    "predictable_until_s",
    "direction",
    "class",
]


def scaled(record, code, factor):
    """Return a component of a bundled record with all its motions scaled."""
    motion = motion_of(read(record), code)
    return replace(motion, rows=factor * motion.rows)


@pytest.mark.parametrize(
    ("overturning", "moved", "name"),
    [(0.5, 0.5, LIKELY), (0.4999, 0.9, MAY), (0.05, 0.05, MAY), (0.0499, 0.05, MOVES), (0.0499, 0.0499, STAYS), (1.0, 1.0, LIKELY)],
)
def test_classify_changes_at_its_limits(overturning, moved, name):
    """A half, a twentieth, and a twentieth of those that move."""
    assert classify(overturning, moved) == name


def test_object_headline_names_no_direction_where_nothing_moves():
    """The direction of an object at rest is the nearer to overturning, and stands in the document alone."""
    assessment = assess(load_block("gravestone"), read("hanmer_springs_2016"), mu=0.438, runs=50)
    assert object_headline(assessment) == "object: stays (overturning 0 %)"
    assert assessment.direction == "280"


def test_object_overturns_where_a_sample_does_in_any_direction():
    """The union of both horizontals, sample by sample: each solved here on its own with the draws of the same seed."""
    record, body, options = read("hanmer_springs_2016"), load_block("gravestone"), RespondOptions(mu=0.6)
    record = replace(record, components=tuple(replace(part, acceleration=1.9 * part.acceleration) for part in record.components))
    draws = draw_samples(200, 0)
    falls = []
    for code in ("10", "280"):
        motion = motion_of(record, code)
        params = sample_respond_params(body.without_ranges("mu"), ParameterVariation(), draws, options)
        falls.append(respond_many(params, motion, gains=sample_gains(motion, ParameterVariation(), draws, None)).overturned)
    shares = [float(row.mean()) for row in falls]
    assessment = assess(body, record, mu=0.6)
    assert assessment.overturning_probability == pytest.approx(np.mean(falls[0] | falls[1]))
    assert assessment.overturning_probability > max(shares) > min(shares) > 0.0
    assert assessment.direction == ("10", "280")[int(np.argmax(shares))]
    single = [assess(body, record, mu=0.6, components=(code,)) for code in ("10", "280")]
    assert [part.overturning_probability for part in single] == pytest.approx(shares)
    assert assessment.least_factor == min(part.least_factor for part in single)
    assert assessment.models[0].factor_to_overturn == min(part.models[0].factor_to_overturn for part in single)


@pytest.mark.parametrize("factor", [0.5, 3.0])
def test_assessment_without_variation_is_the_verdict(factor):
    """0 or 1, and of the class of the single run."""
    motion = scaled("hanmer_springs_2016", "280", factor)
    fell = solve_respond(load_block("gravestone"), motion, mu=0.6).outcome.overturned
    assessment = assess(load_block("gravestone"), motion, mu=0.6, runs=3, priors=NOTHING_VARIES)
    assert assessment.overturning_probability == float(fell)
    assert assessment.class_ == (LIKELY if fell else STAYS)


def test_full_response_factor_is_where_the_run_overturns_first():
    """Just above it the run overturns, and at none of 40 smaller factors."""
    body, motion = Block(0.2424, 0.72), scaled("elcentro_1940_ns.csv", "NS", 1.0)
    factor = next(model.factor_to_overturn for model in assess(body, motion, mu=0.6, runs=2).models if model.name == "full response")
    unit = np.array([1.0, 0.0, 1.0])
    params = [respond_params(body, RespondOptions(mu=0.6))]
    gains = np.append(np.linspace(0.3, 0.95, 40), 1.0) * factor
    assert respond_many(params * 41, motion, gains=gains[:, None] * unit).overturned.tolist() == [False] * 40 + [True]


def test_pile_factor_is_among_its_models():
    """A pulse that overturns one stone: the factor of the pile is between a standing and a falling run."""
    pile = load_pile("wagata").without("sao")
    pulse = Motion.from_arrays(6.0 * np.sin(np.linspace(0.0, 2 * np.pi, 101)), 0.01, name="NS")
    assessment = assess(pile, pulse, runs=2)
    body_value = next(model for model in assessment.models if model.name == "pile of stones")
    factors = [model.factor_to_overturn for model in assessment.models if model.factor_to_overturn is not None]
    assert (assessment.least_factor, assessment.greatest_factor) == (min(factors), max(factors))
    assert body_value.factor_to_overturn is None or (body_value.factor_to_overturn <= 1.0) == body_value.overturns


@pytest.mark.parametrize("command", [("respond", "--mu", "0.6", "--runs", "20"), ("rock", "--perturb", "20")])
def test_documents_hold_assessment_and_object(command):
    """An assessment has exactly its keys, `object` only with several horizontals; the first line agrees."""
    line = [command[0], "hanmer_springs_2016", "--block", "gravestone", "--scale", "1.5", *command[1:]]
    document = json.loads(CliRunner().invoke(main, [*line, "--json"]).stdout)
    entries = [result["assessment"] for result in document["results"]]
    assert [list(entry) for entry in (*entries, document["object"])] == [KEYS] * 3
    assert document["object"]["overturning_probability"] >= max(entry["overturning_probability"] for entry in entries)
    assert "object" not in json.loads(CliRunner().invoke(main, [*line, "--component", "280", "--json"]).stdout)
    lines = CliRunner().invoke(main, [*line, "--component", "280"]).stdout.splitlines()
    entry = entries[1]
    assert lines[0].startswith(f"280: {entry['class']} (") and f"{entry['least_factor']:.2f}-{entry['greatest_factor']:.2f}" in lines[0]


def test_headline_of_weak_shaking_prints_no_huge_factor():
    """A closed form gives factors of thousands for an imperceptible motion."""
    assessment = assess(Block(0.3, 0.9), scaled("hanmer_springs_2016", "280", 1e-3), mu=0.6, runs=2)
    assert assessment.least_factor > 100.0
    assert headline(assessment) == "280: stays (overturning 0 %; factor to overturning >10)"


def test_assess_rejects_options_without_effect():
    """A pile has its own friction, kinetic friction needs the static one, a motion has no components."""
    motion = scaled("elcentro_1940_ns.csv", "NS", 1.0)
    for body, options in (
        (load_pile("wagata"), {"mu": 0.5}),
        (Block(0.2, 0.6), {"mu_kinetic": 0.5}),
        (Block(0.2, 0.6), {"components": ["NS"]}),
    ):
        with pytest.raises(ParameterError):
            assess(body, motion, **options)


def _flip(falls, low, high, width):
    """Return a factor next to which the verdict changes, to a relative `width`."""
    while high - low > width * low:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    return high


def _rock_falls(params, motion, factors):
    return rock_verdicts([params], motion, np.asarray(factors)[:, None] * np.array(params.gains())).overturned


def test_predictable_runs_keep_their_verdict_under_input_changes():
    """Of 40 cases next to a flip, at most one that claims to be predictable changes under 2e-6; most within 1e-6 of it claim nothing."""
    claims = broken = 0
    changes = 2e-6 * np.linspace(-1.0, 1.0, 23)
    for record, code in (
        ("shafter_1989", "NS"),
        ("hanmer_springs_2016", "280"),
        ("elcentro_1940_ns.csv", "NS"),
        ("synthetic_jma.csv", "EW"),
    ):
        block, motion = Block(0.2424, 0.8), motion_of(read(record), code)
        params = rock_params(block, motion, RockOptions())
        grid = np.geomspace(0.2, 12.0, 200)
        fallen = _rock_falls(params, motion, grid)
        first = int(np.argmax(fallen))
        flip = _flip(lambda f, p=params, m=motion: _rock_falls(p, m, [f])[0], grid[first - 1], grid[first], 1e-8)
        for offset in (-1e-3, -1e-4, -1e-5, -4e-6, -1e-6, 1e-6, 4e-6, 1e-5, 1e-4, 1e-3):
            factor = flip * (1.0 + offset)
            nearby = replace(motion, rows=factor * motion.rows)
            until = rock_predictable_until(block, nearby)
            verdicts = _rock_falls(params, motion, factor * (1.0 + changes))
            is_broken = bool(verdicts.any() and not verdicts.all())
            if until is None:
                claims += 1
                broken += is_broken
            else:
                assert 0.0 <= until <= motion.time[-1] + 1.0
            assert not (abs(offset) == 1e-6 and until is None)
    assert broken <= 1 <= claims


def test_full_response_is_predictable_far_from_a_flip():
    """A body that rests, and one that a pulse overturns at once, are predictable to the end; the single run is the same."""
    pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    for factor in (0.1, 1.0, 2.0):
        motion = replace(pulse, rows=factor * pulse.rows)
        assert respond_predictable_until(Block(0.24, 0.8), motion, RespondOptions(mu=0.5)) is None
        assert solve_rock(Block(0.24, 0.8), motion).outcome.overturned == (factor >= 1.0)
