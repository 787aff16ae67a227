"""Sentences of the HTML report on the response of one model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from seisblock.core.i18n import N_, gettext
from seisblock.core.registry import get_solver
from seisblock.models.respond.describe import describe as respond_verdict
from seisblock.output.text.section import Section
from seisblock.report.text.assessment import headline
from seisblock.report.text.respond import probability_sentence, variation_text
from seisblock.studies.assessment import severity_key
from seisblock.studies.report.responses import ModelResponse
from seisblock.studies.rocking.margin import Margin

LIMITS = N_(
    "All models are rigid and plane, except uplift. The full response combines rest, sliding, rocking and flight; the idealised models "
    "have one mode of motion each. Rocking is sensitive to small changes of the input: rely on probabilities and margins rather than on "
    "a single result."
)


def section(effect: ModelResponse) -> Section:
    """Return the section of a model, of its registration."""
    value: Section = get_solver(effect.response.model).presenter("section")
    return value


def rank(effect: ModelResponse) -> tuple[float, ...]:
    """Return the sort key of severity of a direction: that of the worst direction of an object, then severity of the nominal body."""
    key = (_overturned_share(effect), 0.0, 0.0) if effect.assessment is None else severity_key(effect.assessment.assessment)
    return *key, severity(effect)


def _overturned_share(effect: ModelResponse) -> float:
    """Return the overturning probability, 0 without samples."""
    return 0.0 if effect.probability is None else effect.probability.overturned


def severity(effect: ModelResponse) -> float:
    """Return the severity of a response: 0 no motion, below :data:`SEVERE` motion, from there on overturning or a jump."""
    return section(effect).severity(effect.response.outcome)


def verdict(effect: ModelResponse) -> str:
    """Return the result of one model in one direction as a short text."""
    return section(effect).verdict(effect.response)


def sentences(effect: ModelResponse) -> Iterator[str]:
    """Yield sentences on the response, its margin and its sensitivity."""
    if effect.probability is not None:
        yield from governing_text(effect)
        return
    first, *remaining = section(effect).sentences(effect.response)
    yield gettext("{name}: {text}", name=effect.response.motion.name, text=decapitalize(first))
    if effect.margin is not None:
        yield from _margin_sentences(effect.margin)
    yield from remaining
    if effect.onset is not None and math.isfinite(effect.onset):
        yield gettext(section(effect).onset, factor=effect.onset)


def governing_text(effect: ModelResponse) -> Iterator[str]:
    """Yield sentences on the full response: assessment, single run, probability, and an assumed friction."""
    assert effect.probability is not None
    if effect.assessment is not None:
        yield gettext("{text}.", text=headline(effect.assessment.assessment))
    yield respond_verdict(effect.response)
    yield capitalize(probability_sentence(effect.probability))
    if not effect.friction_known:
        yield gettext("Friction coefficient assumed: {mu:.2f} (none given; almost no sliding).", mu=effect.response.options.mu)


def card_text(effects: Sequence[ModelResponse]) -> list[str]:
    """Return the text of the card of a body: worst direction, other directions with possible overturning, caveats."""
    worst, *remaining = sorted(effects, key=rank, reverse=True)
    text = [*governing_text(worst), *share_caveat(worst)]
    for effect in remaining:
        if effect.response.outcome.overturned or _overturned_share(effect) > 0.0:
            text += [*governing_text(effect), *share_caveat(effect)]
    # the head of the card is the assessment in the only direction
    return list(dict.fromkeys(text if remaining or worst.assessment is None else text[1:]))


def share_caveat(effect: ModelResponse) -> Iterator[str]:
    """Yield the observed error rate of predictions with no or all samples overturned."""
    if _overturned_share(effect) == 0.0:
        yield gettext("In shaking-table runs of two granite rocks, the rock overturned in 3 % of those for which no computed sample did.")
    elif _overturned_share(effect) == 1.0:
        yield gettext(
            "In shaking-table runs of two granite rocks, the rock stood in 2 % of those for which all computed samples overturned."
        )


def scatter_text(effects: Sequence[ModelResponse]) -> str:
    """Return the varied parameters of the samples as a sentence, empty without samples."""
    for effect in effects:
        if effect.probability is not None:
            return variation_text(effect.probability, effect.response.body)
    return ""


def decapitalize(text: str) -> str:
    """Return a text with an initial small letter, for use after a colon."""
    return text[:1].lower() + text[1:]


def capitalize(text: str) -> str:
    """Return a text with an initial capital."""
    return text[:1].upper() + text[1:]


def _margin_sentences(margin: Margin) -> Iterator[str]:
    if margin.nearest_flip is None:
        yield gettext("Same result at all scale factors up to {limit:g}.", limit=margin.limit)
    else:
        yield gettext("Nearest scale factor at which the result changes: {factor:.3f}.", factor=margin.nearest_flip)
    first = next((window for window in margin.windows if window.overturned), None)
    if first is not None:
        yield gettext("Smallest scale factor to overturning: {factor:.3f} (of those examined).", factor=first.first)
