"""The card of a body on a report: the direction in which most versions fall is the worst, however soon another one falls."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from seisblock.report.html.report_text import card_text, rank, scatter_text, share_caveat
from seisblock.studies.report.responses import ModelResponse
from seisblock.studies.respond.probability import ParameterVariation, Probability
from tests.report.long_record import response

ENTIRE = {"overturning_probability": 1.0, "moved_probability": 1.0}
ENDS = dict.fromkeys(("q05", "q25", "q50", "q75", "q95"), 0.0)


def effect(name, fell_at, share):
    """One direction of the long record: when it falls, None where it stands, and in what share of 200 versions."""
    solution = response("respond")
    fell = {"overturned": fell_at is not None, "overturning_time_s": fell_at, "overturned_towards": None if fell_at is None else "+x"}
    outcome = replace(solution.outcome, outcome="moves" if fell_at is None else "overturns", sensitive=False, **fell)
    shaking = replace(solution, outcome=outcome, motion=replace(solution.motion, name=name))
    expected = Probability(200, share, share, (max(share - 0.1, 0.0), min(share + 0.1, 1.0)), 0.01, ENDS, ParameterVariation(), 1)
    return ModelResponse(shaking, None, None, expected)


def test_worst_direction_has_highest_probability():
    """NS falls later than EW and in half of the samples: the card begins with NS and states EW, too."""
    north, east = effect("NS", 49.66, 0.46), effect("EW", 47.52, 0.12)
    for pair in ([north, east], [east, north]):
        head, *text = card_text(pair)
        assert head.startswith("NS: overturns to +NS at 49.66 s")
        assert (
            text[0].startswith("Overturning probability 46 % (")
            and text[1].startswith("EW: overturns to +EW at 47.52 s")
            and text[2].startswith("Overturning probability 12 % (")
        )
        assert max(pair, key=rank) is north


def test_directions_sort_by_probability_before_nominal_outcome():
    """Directions sort by probability, then by the time of overturning; all that overturn are listed."""
    falls, stands, soon = effect("NS", 49.0, 0.1), effect("EW", None, 0.4), effect("UP", 40.0, 0.1)
    assert sorted([falls, soon, stands], key=rank, reverse=True) == [stands, soon, falls]
    head, *text = card_text([falls, stands])
    assert head.startswith("EW:") and text[0].startswith("Overturning probability 40 % (") and "NS: overturns" in " ".join(text)
    assert "UP:" not in " ".join(card_text([falls, effect("UP", None, 0.0)]))


def test_worst_direction_of_equal_probabilities_is_that_of_the_object():
    """The card named EW, of the smaller factor to overturning, and the figure below NS the worst component."""
    pair = [
        replace(effect(name, time, 1.0), assessment=SimpleNamespace(assessment=SimpleNamespace(**ENTIRE, least_factor=factor)))
        for name, time, factor in (("NS", 40.0, 0.17), ("EW", 41.0, 0.15))
    ]
    assert max(pair, key=rank).response.motion.name == "EW"


@pytest.mark.parametrize(
    ("share", "message"),
    [(0.0, "3 % of those for which no computed sample did"), (0.5, ""), (1.0, "2 % of those for which all computed samples overturned")],
)
def test_shares_of_zero_and_one_carry_interval(share, message):
    """No card has a share of 0 or 1 alone; the section states the population of the shares."""
    result = effect("NS", None if share == 0.0 else 40.0, share)
    assert message in "".join(share_caveat(result)) and bool(message) == any("shaking-table runs" in text for text in card_text([result]))
    assert scatter_text([result]).startswith("Parameter variation only (model error not included): ")
    assert "3 % overturned where no computed sample did" in scatter_text([result])


def test_scatter_text_of_idealised_model_is_empty():
    """It has no samples."""
    assert scatter_text([replace(effect("NS", 40.0, 0.0), probability=None)]) == ""
