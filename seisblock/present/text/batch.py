"""How a batch is told: how often it happened, body by body, and what has no answer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from seisblock.present.text.tables import line, table
from seisblock.studies.batch.tally import Tally
from seisblock.words import noted, roughly, tell

MOST_BODIES = 20
"""Bodies of which the table tells; the file tells of all."""

MOST_REASONS = 5
"""Reasons that are told for rows without an answer."""

_HAPPENED = {
    "respond": noted("overturned in {happened} of {answers} runs"),
    "rock": noted("overturned in {happened} of {answers} runs"),
    "slide": noted("slipped in {happened} of {answers} runs"),
    "jump": noted("jumped in {happened} of {answers} runs"),
    "uplift": noted("lifted in {happened} of {answers} runs"),
    "stack": noted("a stone fell in {happened} of {answers} runs"),
}
_HEADING = {
    "respond": noted("overturned"),
    "rock": noted("overturned"),
    "slide": noted("slipped"),
    "jump": noted("jumped"),
    "uplift": noted("lifted"),
    "stack": noted("a stone fell"),
}


def tables(tally: Tally, said: Mapping[str, str]) -> Iterator[Any]:
    """Yield what is printed: the count of all, that of each body, and the reasons of the rows without an answer.

    Parameters
    ----------
    tally : Tally
    said : mapping of str to str
        Reasons in English, and as they can be told.
    """
    solver = tally.model.name
    whole = tell(_HAPPENED[solver], happened=tally.happened, answers=tally.answers)
    yield line(tell("{whole} (bodies: {bodies}, records: {records})", whole=whole, bodies=len(tally.bodies), records=tally.records), "bold")
    ranked = tally.ranked()
    if ranked and tally.answers:
        heads = [tell("body"), tell("runs"), tell(_HEADING[solver]), tell("share"), tell("no answer")]
        rows = [
            [tell(c.body), c.answers, c.happened, roughly(c.happened / c.answers) if c.answers else None, c.failures]
            for c in ranked[:MOST_BODIES]
        ]
        more = tell("and {count} more bodies, in the file", count=len(ranked) - MOST_BODIES) if len(ranked) > MOST_BODIES else ""
        yield table("", heads, rows, caption=more)
    if tally.failures:
        yield line(tell("rows without an answer: {count}", count=tally.failures), "yellow")
        reasons = sorted(tally.reasons.items(), key=lambda each: -each[1])
        most = MOST_REASONS if tally.answers else len(reasons)  # without an answer there is no file
        for why, count in reasons[:most]:
            yield line(f"  {count} x {tell(said.get(why, why))}")
        if len(reasons) > most:
            yield line("  " + tell("and {count} other reasons, in the file", count=len(reasons) - most))
