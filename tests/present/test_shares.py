"""A share has one form: what is small and not nothing says so, wherever it is told."""

from dataclasses import replace

import pytest

from seisblock.present.faces import verdict_of
from seisblock.present.pages.report_words import sentences, verdict
from seisblock.studies.assessment import Effect
from seisblock.words import speaking
from tests.present.long_record import response

SMALL = {"en": "less than 1 % of the way to alpha", "ja": "転倒限界角 α の 1 % 未満"}


@pytest.mark.parametrize("lang", SMALL)
def test_a_lean_below_a_hundredth_is_told_alike_in_text_and_report(lang):
    """The line of the text, the line on the page's card and the sentence below it; none of them says 0 %."""
    found = response("rock")
    faint = replace(found, outcome=replace(found.outcome, overturned=False, overturned_towards=None, rocks=True, max_rotation_ratio=0.004))
    with speaking(lang):
        effect = Effect("rock", faint, None, None)
        told = [verdict_of(faint), verdict(effect), " ".join(sentences(effect))]
    assert [text for text in told if SMALL[lang] in text] == told
    assert not [text for text in told if " 0 %" in text]


def test_a_share_of_a_governing_answer_has_the_same_words():
    """What rocks a little while it slides."""
    found = response("respond")
    time = {**found.outcome.time_in_mode_s, "rock": 1.0}
    changed = replace(found.outcome, outcome="moves", overturned=False, time_in_mode_s=time, max_rotation_ratio=0.004)
    with speaking("en"):
        assert f"rocks to {SMALL['en']}" in verdict_of(replace(found, outcome=changed))
