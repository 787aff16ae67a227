"""The models of one object disagree, and say so: by how much, which of them, and which was made for it (N15)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.edge_wear import DEFAULT_WEAR
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.core.results import Response
from seisblock.criteria.gravestones import DOWELLED, overturning_pga
from seisblock.measures import measure
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.models.stack.options import StackOptions
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from seisblock.report.text.model_comparison import agreement_line, rates_line
from seisblock.studies.model_comparison import (
    GRAVESTONES,
    ISHIYAMA,
    PILE,
    PULSE,
    SHARP_BLOCK,
    WORN_BLOCK,
    ModelResult,
    compare_models,
    compare_pile_models,
)
from seisblock.studies.survey.model_rates import rates_by_model

RECORD = read("elcentro_1940_ns.csv")
MOTION = motion_of(RECORD, "NS")
STONE = Block(0.2424, 0.8)


def opinions(result):
    """Return the opinions of an agreement by model."""
    return {opinion.model: opinion for opinion in result.opinions}


def test_models_of_gravestone_differ_by_factor_two():
    """A gravestone under El Centro falls by two of five models, whose factors lie a factor of 1.98 apart."""
    comparison = compare_models(STONE, MOTION)
    assert (comparison.falls, comparison.models, comparison.unanimous) == (2, 5, False)
    assert list(opinions(comparison)) == [SHARP_BLOCK, WORN_BLOCK, GRAVESTONES, PULSE, ISHIYAMA]
    assert [opinion.model for opinion in comparison.opinions if opinion.falls] == [GRAVESTONES, ISHIYAMA]
    factors = [opinion.factor for opinion in comparison.opinions]
    assert comparison.spread == pytest.approx(max(factors) / min(factors))
    assert comparison.spread == pytest.approx(1.98, abs=0.01)


def test_closed_form_factor_is_threshold_over_peak():
    """The factor of eq. (9) is its PGA over the record's, at the record's own PGA/(2 pi PGV)."""
    measured = measure(RECORD, ("NS",)).components[0]
    level = float(overturning_pga(STONE.height / STONE.width, measured.equivalent_frequency_hz.pga_pgv))
    assert opinions(compare_models(STONE, MOTION))[GRAVESTONES].factor == pytest.approx(level / measured.pga_m_s2, rel=1e-9)


def test_simulated_factor_is_first_overturning_factor():
    """At the factor the block falls, a little below it stands, and no factor that was looked at below it lets it fall."""
    comparison = opinions(compare_models(STONE, MOTION))
    for model, block in ((SHARP_BLOCK, STONE), (WORN_BLOCK, STONE.with_wear(DEFAULT_WEAR))):
        factor = comparison[model].factor
        assert rock_verdict(block, MOTION, scale=factor).overturned
        assert not rock_verdict(block, MOTION, scale=factor * 0.999).overturned
        assert comparison[model].falls == rock_verdict(block, MOTION).overturned
    assert comparison[WORN_BLOCK].factor < comparison[SHARP_BLOCK].factor


def test_given_inset_is_compared_with_sharp_edges():
    """A block with edge wear is compared with the same block with sharp edges."""
    comparison = opinions(compare_models(STONE.with_wear(0.2), MOTION))
    assert comparison[SHARP_BLOCK] == opinions(compare_models(STONE, MOTION))[SHARP_BLOCK]
    assert comparison[WORN_BLOCK].factor < opinions(compare_models(STONE, MOTION))[WORN_BLOCK].factor


def test_gravestone_criterion_applies_to_gravestones_only():
    """A cabinet and a slab have four models; a stone of the criterion's width and proportions has the one made for it."""
    assert opinions(compare_models(STONE, MOTION))[GRAVESTONES].made_for_it
    for second in (Block(0.8, 1.9), Block(0.25, 0.25), Block(0.25, 2.0)):
        comparison = compare_models(second, MOTION)
        assert GRAVESTONES not in opinions(comparison)
        assert comparison.models == 4


def test_further_models_are_counted():
    """Results of further models, such as a pile, are counted; a factor only if one is known."""
    single, extra = compare_models(STONE, MOTION), compare_models(STONE, MOTION, extra_results=[ModelResult("pile", True, None)])
    assert (extra.falls, extra.models, extra.spread) == (single.falls + 1, single.models + 1, single.spread)


def test_fixed_top_stone_is_not_compared():
    """A pile whose top stone is fixed is not compared."""
    pile = load_pile("wagata")
    holding = replace(pile, fixed=(pile.names[-1],))
    assert compare_pile_models(Response("stack", None, MOTION, holding)) is None


def test_zero_motion_overturns_in_no_model():
    """A motion of zeros overturns nothing in any model."""
    comparison = compare_models(STONE, Motion.from_arrays(np.zeros(100), 0.01))
    assert (comparison.falls, comparison.spread, comparison.unanimous) == (0, None, True)


def test_cemetery_rates_differ_by_model():
    """By each model another share of Aoyama's stones falls; worn blocks fall more than sharp ones."""
    cemetery = read_cemetery("aoyama.csv")
    motion = motion_of(read("synthetic_jma.csv"), "NS")
    weak = Motion(0.45 * motion.acceleration, motion.dt)
    rates = {item.model: item.rate for item in rates_by_model(cemetery, 4.2, 1.2, weak)}
    assert list(rates) == [GRAVESTONES, PULSE, WORN_BLOCK, SHARP_BLOCK]
    assert rates[SHARP_BLOCK] < rates[WORN_BLOCK] < rates[GRAVESTONES]
    assert [item.model for item in rates_by_model(cemetery, 4.2, 1.2)] == [GRAVESTONES, PULSE]
    assert [item.model for item in rates_by_model(cemetery.with_dowels(), 4.2, 1.2, weak)] == [GRAVESTONES]


def test_closed_form_states_frequency_and_edges():
    """The half sine names the motion's PGA/(2 pi PGV); worn edges and those of the drawing have factors of their own, and say which."""
    frequency = measure(RECORD, ("NS",)).components[0].equivalent_frequency_hz.pga_pgv
    sharp, worn = (opinions(compare_models(stone, MOTION)) for stone in (STONE, STONE.with_wear(0.1)))
    for model in (PULSE, ISHIYAMA):
        assert (sharp[model].worn, worn[model].worn) == (False, True)
        assert worn[model].factor < sharp[model].factor
    assert sharp[PULSE].frequency_hz == pytest.approx(frequency)
    for stone, edges in ((STONE, "sharp"), (STONE.with_wear(0.1), "worn")):
        comparison = agreement_line("NS", compare_models(stone, MOTION))
        assert f"half-sine pulse of {frequency:.3g} Hz with {edges} edges (" in comparison
        assert f"Ishiyama's limits of acceleration and velocity with {edges} edges (" in comparison
    rates = rates_by_model(read_cemetery("aoyama.csv"), 4.2, 1.2)
    assert "(half-sine pulse of 1.2 Hz with worn edges)" in rates_line("NS", rates)


def test_pile_is_compared_by_its_top_stone_alone():
    """Stones below the top one change none of its models' factors, which are those of a pile of this stone only."""
    sao, dai = PileStone("sao", 0.24, 0.24, 0.7, on="base"), PileStone("base", 0.6, 0.5, 0.25)

    def models(pile):
        response = Response("stack", None, MOTION, pile, options=StackOptions())
        return opinions(compare_pile_models(response, ModelResult(PILE, False, None)))

    two, alone = models(Pile("two", (dai, sao))), models(Pile("alone", (replace(sao, on="ground"),)))
    assert two == alone
    assert list(two) == [SHARP_BLOCK, WORN_BLOCK, GRAVESTONES, PULSE, ISHIYAMA, PILE]
    # a dowel doubles what a gravestone withstands, and is part of no criterion of other stones
    dowelled = models(Pile("dowelled", (dai, sao), dowels=(("base", "sao"),)))
    measured = measure(RECORD, ("NS",)).components[0]
    level = float(overturning_pga(0.7 / 0.24, measured.equivalent_frequency_hz.pga_pgv, DOWELLED))
    assert dowelled[GRAVESTONES].factor == pytest.approx(level / measured.pga_m_s2, rel=1e-9)
    assert GRAVESTONES not in models(Pile("cap", (dai, replace(sao, name="cap"))))
