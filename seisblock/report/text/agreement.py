"""How it is told that models disagree, and of what a share of runs is the share."""

from __future__ import annotations

from seisblock.bodies.block import Block
from seisblock.core.i18n import N_, format_share, gettext, join_sentences, lazy_gettext
from seisblock.report.describe_wear import sampled_edges
from seisblock.studies.model_comparison import GRAVESTONES, ModelComparison, ModelResult
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.rocking.perturb import Perturbation
from seisblock.studies.survey.model_rates import ModelRate

MIN_SHARE, MAX_SHARE = 0.03, 0.98
"""Shares of perturbed runs beyond which no share is a chance: of fitted real rocks 3 % fell where no version did, and 2 % stood where
all of them fell."""


def agreement_line(name: str, agreement: ModelComparison) -> str:
    """Return in a sentence how many models let an object fall, which, and how far apart they are.

    Parameters
    ----------
    name : str
        Direction of the record.
    agreement : Agreement
    """
    factors = [opinion.factor for opinion in agreement.opinions if opinion.factor is not None]
    if not agreement.opinions or agreement.spread is None:
        return gettext("{name}: falls in {falls} of {models} models.", name=name, falls=agreement.falls, models=agreement.models)
    values = {"name": name, "models": agreement.models, "spread": agreement.spread}
    if agreement.unanimous:
        ends = {"low": min(factors), "high": max(factors)}
        if agreement.falls:
            text = N_(
                "{name}: falls in all {models} models; {low:.2f} to {high:.2f} times this record is enough, depending on the model "
                "(a factor of {spread:.1f})."
            )
        else:
            text = N_(
                "{name}: stands in all {models} models; to fall it takes {low:.2f} to {high:.2f} times this record, depending on the model "
                "(a factor of {spread:.1f})."
            )
        return gettext(text, **values, **ends)
    text = N_(
        "{name}: falls in {falls} of {models} models: {falling}; stands in the others: {standing}. In brackets: how many times this "
        "record each takes to let it fall; the largest is {spread:.1f} times the smallest."
    )
    falling_models, stable_models = ([_opinion_text(o) for o in agreement.opinions if o.falls is falls] for falls in (True, False))
    sentence = gettext(text, **values, falls=agreement.falls, falling=falling_models, standing=stable_models)
    purpose_built = next((opinion for opinion in agreement.opinions if opinion.made_for_it), None)
    return sentence if purpose_built is None else join_sentences([sentence, _purpose_built_text(purpose_built)])


def _opinion_text(opinion: ModelResult) -> str:
    """Return a model with the factor from which on it lets the object fall."""
    if opinion.factor is None:
        return model_label(opinion)
    return gettext("{model} ({factor:.2f})", model=model_label(opinion), factor=opinion.factor)


def model_label(opinion: ModelResult | ModelRate) -> str:
    """Return the name of a model, with the frequency and the edges that it was asked about.

    Parameters
    ----------
    opinion : Opinion or RateOpinion

    Examples
    --------
    >>> model_label(ModelResult("half-sine pulse", True, 0.9, frequency_hz=0.75, worn=True))
    'half sine of 0.75 Hz with worn edges'
    """
    name = gettext(opinion.model)
    if opinion.frequency_hz is not None:
        name = gettext("half sine of {frequency:.3g} Hz", frequency=opinion.frequency_hz)
    if opinion.worn is None:
        return name
    return gettext("{model} with worn edges", model=name) if opinion.worn else gettext("{model} with sharp edges", model=name)


def _purpose_built_text(opinion: ModelResult) -> str:
    """Return what the model says that was made for such objects."""
    if opinion.falls:
        return gettext("The {model}, made for this, says that it falls.", model=gettext(opinion.model))
    return gettext("The {model}, made for this, says that it stands.", model=gettext(opinion.model))


def rates_line(name: str, rates: tuple[ModelRate, ...]) -> str:
    """Return in a sentence which share of a cemetery falls by each model, empty where only one was asked.

    Parameters
    ----------
    name : str
        Direction of the record; empty for bare numbers.
    rates : tuple of RateOpinion
    """
    if len(rates) < 2:
        return ""
    texts = [gettext("{rate:.0%} by the {model}", rate=opinion.rate, model=model_label(opinion)) for opinion in rates]
    low, high = min(opinion.rate for opinion in rates), max(opinion.rate for opinion in rates)
    values = {"rates": texts, "made": gettext(GRAVESTONES)}
    if low > 0.0:
        text = N_(
            "share of the stones that falls: {rates}, {spread:.1f} times as many in one model as in another; the {made} is made for them."
        )
        sentence = gettext(text, **values, spread=high / low)
    else:
        sentence = gettext("share of the stones that falls: {rates}; the {made} is made for them.", **values)
    return gettext("{name}: {text}", name=name, text=sentence) if name else sentence


def format_chance(share: float) -> str:
    """Return a share of perturbed runs as what can be said of it.

    Examples
    --------
    >>> format_chance(0.0), format_chance(0.5), format_chance(1.0)
    ('below 0.03', '0.50', 'above 0.98')
    """
    if share < MIN_SHARE:
        return gettext("below {share}", share=MIN_SHARE)
    return gettext("above {share}", share=MAX_SHARE) if share > MAX_SHARE else f"{share:.2f}"


def perturbation_lines(perturbation: Perturbation, block: Block) -> tuple[str, str]:
    """Return how often a perturbed block fell, of what that is the share, and what was varied.

    Parameters
    ----------
    perturbation : Perturbation
    block : Block
        The median of the samples.
    """
    values = {
        "fallen": perturbation.overturned,
        "runs": perturbation.runs,
        "share": format_chance(perturbation.probability),
        "of": gettext(perturbation.interval_of),
    }
    low, high = perturbation.probability_interval
    if perturbation.probability < MIN_SHARE:
        text = N_("falls in {fallen} of {runs} versions of body and shaking: {share}; of real rocks 3 % fell where no version did.")
    elif perturbation.probability > MAX_SHARE:
        text = N_("falls in {fallen} of {runs} versions of body and shaking: {share}; of real rocks 2 % stood where every version fell.")
    else:
        text = N_(
            "falls in {fallen} of {runs} versions of body and shaking: {share}; {low} to {high} is the 95 % interval of {of}, no more."
        )
    s = perturbation.spread
    sizes = lazy_gettext("size ±{size}, slenderness ±{slenderness}", size=format_share(s.size), slenderness=format_share(s.slenderness))
    variation = gettext(
        "varied: {sizes}, {edges}, restitution ±{restitution}, amplitude ±{amplitude}, azimuth ±{azimuth:g} deg.",
        sizes=sizes,
        edges=sampled_edges(block, perturbation.ranges, s.inset),
        restitution=format_share(s.restitution),
        amplitude=format_share(s.amplitude),
        azimuth=s.azimuth_deg,
    )
    whole, left_out = (
        gettext(text, **values, low=format_chance(low), high=format_chance(high)),
        left_out_versions(perturbation.no_answer, perturbation.runs),
    )
    return whole if left_out is None else join_sentences([whole, f"{gettext(left_out)}."]), variation
