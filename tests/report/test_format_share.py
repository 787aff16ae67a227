"""Shares have one format: a small non-zero share is not printed as zero."""

from dataclasses import replace

import pytest

from seisblock.core.i18n import use_locale
from seisblock.output.figures.solver import response_figure
from seisblock.output.text.solver import describe as verdict_text
from seisblock.report.html.report_text import sentences, verdict
from seisblock.studies.report.responses import ModelResponse
from tests.report.long_record import response

SMALL = {"en": "less than 1 % of the overturning angle", "ja": "転倒限界角の 1 % 未満"}


@pytest.mark.parametrize("lang", SMALL)
def test_tilt_below_one_percent_has_same_text_everywhere(lang):
    """Text, card and sentence of a small share do not print 0 %."""
    solution = response("rock")
    faint = replace(
        solution, outcome=replace(solution.outcome, overturned=False, overturned_towards=None, rocks=True, max_rotation_ratio=0.004)
    )
    with use_locale(lang):
        effect = ModelResponse(faint, None, None)
        output = [verdict_text(faint), verdict(effect), " ".join(sentences(effect))]
    assert [text for text in output if SMALL[lang] in text] == output
    assert not [text for text in output if " 0 %" in text]


def test_best_estimate_uses_same_share_text():
    """A slight rocking during sliding has the same text everywhere."""
    solution = response("respond")
    time = {**solution.outcome.time_in_mode_s, "rock": 1.0}
    changed = replace(solution.outcome, outcome="moves", overturned=False, time_in_mode_s=time, max_rotation_ratio=0.004)
    with use_locale("en"):
        assert "rocks slightly (peak tilt less than 1 % of the overturning angle)" in verdict_text(replace(solution, outcome=changed))


@pytest.mark.parametrize(("lang", "message"), [("en", "NS: slides less than 0.01 mm in total."), ("ja", "NS：滑動 合計 0.01 mm 未満")])
def test_tiny_slip_is_not_reported_as_zero(lang, message):
    """The sentence of ``slide``, as that of ``jump`` does; the card of a report does, too."""
    solution = response("slide")
    faint = dict.fromkeys(("max_slip_m", "path_m", "residual_slip_m", "final_slip_m"), 1e-6)
    outcome = replace(solution.outcome, slips=True, fell_off_slope=False, lifted_off=False, **faint)
    changed = replace(solution, outcome=outcome, motion=replace(solution.motion, name="NS"))
    with use_locale(lang):
        assert verdict_text(changed) == message
        assert "0.01 mm" in verdict(ModelResponse(changed, None, None))


def test_rock_figure_title_states_outcome():
    """As that of the governing answer does: above the ground motion."""
    solution = response("rock")
    for fell, text in ((True, ": overturned; "), (False, ": rocking; ")):
        outcome = replace(solution.outcome, rocks=True, overturned=fell, overturned_towards="+x" if fell else None)
        with use_locale("en"):
            titles = [axis.get_title(loc="left") for axis in response_figure([replace(solution, outcome=outcome)]).axes]
        assert any(text in title for title in titles), titles


def test_response_repr_is_one_line():
    """A display has model, body, direction, first facts and outcome; the page states how many items it omits."""
    solution = response("respond")
    assert len(repr(solution)) < 300 and repr(solution).startswith("<Response respond of ") and "overturned=" in repr(solution)
    with use_locale("en"):
        output = solution._repr_html_()
    count = len(solution.outcome.events)
    assert count > 8 and f"events (8 of {count})" in output
