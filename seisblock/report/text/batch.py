"""How a batch is told: how often it happened, body by body, and what has no answer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.report.text.tables import styled_line, table
from seisblock.studies.batch.tally import Tally

MAX_BODIES = 20
"""Bodies of which the table tells; the file tells of all."""

MAX_REASONS = 5
"""Reasons that are told for rows without an answer."""

_EVENT_COUNT_TEXTS = {
    "respond": N_("overturned in {happened} of {answers} runs"),
    "rock": N_("overturned in {happened} of {answers} runs"),
    "slide": N_("slipped in {happened} of {answers} runs"),
    "jump": N_("jumped in {happened} of {answers} runs"),
    "uplift": N_("lifted in {happened} of {answers} runs"),
    "stack": N_("a stone fell in {happened} of {answers} runs"),
}
_EVENT_HEADINGS = {
    "respond": N_("overturned"),
    "rock": N_("overturned"),
    "slide": N_("slipped"),
    "jump": N_("jumped"),
    "uplift": N_("lifted"),
    "stack": N_("a stone fell"),
}


def tables(tally: Tally, messages: Mapping[str, str]) -> Iterator[Any]:
    """Yield what is printed: the count of all, that of each body, and the reasons of the rows without an answer.

    Parameters
    ----------
    tally : Tally
    messages : mapping of str to str
        Reasons in English, and as they can be told.
    """
    solver = tally.model.name
    total = gettext(_EVENT_COUNT_TEXTS[solver], happened=tally.happened, answers=tally.answers)
    yield styled_line(
        gettext("{whole} (bodies: {bodies}, records: {records})", whole=total, bodies=len(tally.bodies), records=tally.records), "bold"
    )
    bodies = tally.ranked()
    if bodies and tally.answers:
        header = [gettext("body"), gettext("runs"), gettext(_EVENT_HEADINGS[solver]), gettext("share"), gettext("no answer")]
        rows = [
            [gettext(c.body), c.answers, c.happened, format_share(c.happened / c.answers) if c.answers else None, c.failures]
            for c in bodies[:MAX_BODIES]
        ]
        caption = gettext("and {count} more bodies, in the file", count=len(bodies) - MAX_BODIES) if len(bodies) > MAX_BODIES else ""
        yield table("", header, rows, caption=caption)
    if tally.failures:
        yield styled_line(gettext("rows without an answer: {count}", count=tally.failures), "yellow")
        reasons = sorted(tally.reasons.items(), key=lambda pair: -pair[1])
        max_reasons = MAX_REASONS if tally.answers else len(reasons)  # without an answer there is no file
        for reason, count in reasons[:max_reasons]:
            yield styled_line(f"  {count} x {gettext(messages.get(reason, reason))}")
        if len(reasons) > max_reasons:
            yield styled_line("  " + gettext("and {count} other reasons, in the file", count=len(reasons) - max_reasons))
