"""How it is told that models disagree, and of what a share of runs is the share."""

from __future__ import annotations

from seisblock.bodies.block import Block
from seisblock.present.edges import sampled_edges
from seisblock.studies.agreement import GRAVESTONES, Agreement, Opinion
from seisblock.studies.cemetery.models import RateOpinion
from seisblock.studies.rocking.perturb import Perturbation
from seisblock.studies.runs import left_out_versions
from seisblock.words import noted, roughly, said, strung, tell

LEAST, MOST = 0.03, 0.98
"""Shares of perturbed runs beyond which no share is a chance: of fitted real rocks 3 % fell where no version did, and 2 % stood where
all of them fell."""


def agreement_line(name: str, found: Agreement) -> str:
    """Return in a sentence how many models let an object fall, which, and how far apart they are.

    Parameters
    ----------
    name : str
        Direction of the record.
    found : Agreement
    """
    factors = [opinion.factor for opinion in found.opinions if opinion.factor is not None]
    if not found.opinions or found.spread is None:
        return tell("{name}: falls in {falls} of {models} models.", name=name, falls=found.falls, models=found.models)
    values = {"name": name, "models": found.models, "spread": found.spread}
    if found.unanimous:
        ends = {"low": min(factors), "high": max(factors)}
        if found.falls:
            text = noted(
                "{name}: falls in all {models} models; {low:.2f} to {high:.2f} times this record is enough, depending on the model "
                "(a factor of {spread:.1f})."
            )
        else:
            text = noted(
                "{name}: stands in all {models} models; to fall it takes {low:.2f} to {high:.2f} times this record, depending on the model "
                "(a factor of {spread:.1f})."
            )
        return tell(text, **values, **ends)
    text = noted(
        "{name}: falls in {falls} of {models} models: {falling}; stands in the others: {standing}. In brackets: how many times this "
        "record each takes to let it fall; the largest is {spread:.1f} times the smallest."
    )
    falling, standing = ([_opinion(o) for o in found.opinions if o.falls is falls] for falls in (True, False))
    told = tell(text, **values, falls=found.falls, falling=falling, standing=standing)
    made = next((opinion for opinion in found.opinions if opinion.made_for_it), None)
    return told if made is None else strung([told, _made_for_it(made)])


def _opinion(opinion: Opinion) -> str:
    """Return a model with the factor from which on it lets the object fall."""
    if opinion.factor is None:
        return called(opinion)
    return tell("{model} ({factor:.2f})", model=called(opinion), factor=opinion.factor)


def called(opinion: Opinion | RateOpinion) -> str:
    """Return the name of a model, with the frequency and the edges that it was asked about.

    Parameters
    ----------
    opinion : Opinion or RateOpinion

    Examples
    --------
    >>> called(Opinion("half sine of that frequency", True, 0.9, frequency_hz=0.75, worn=True))
    'half sine of 0.75 Hz with worn edges'
    """
    name = tell(opinion.model)
    if opinion.frequency_hz is not None:
        name = tell("half sine of {frequency:.3g} Hz", frequency=opinion.frequency_hz)
    if opinion.worn is None:
        return name
    return tell("{model} with worn edges", model=name) if opinion.worn else tell("{model} with sharp edges", model=name)


def _made_for_it(opinion: Opinion) -> str:
    """Return what the model says that was made for such objects."""
    if opinion.falls:
        return tell("The {model}, made for this, says that it falls.", model=tell(opinion.model))
    return tell("The {model}, made for this, says that it stands.", model=tell(opinion.model))


def rates_line(name: str, rates: tuple[RateOpinion, ...]) -> str:
    """Return in a sentence which share of a cemetery falls by each model, empty where only one was asked.

    Parameters
    ----------
    name : str
        Direction of the record; empty for bare numbers.
    rates : tuple of RateOpinion
    """
    if len(rates) < 2:
        return ""
    told = [tell("{rate:.0%} by the {model}", rate=each.rate, model=called(each)) for each in rates]
    low, high = min(each.rate for each in rates), max(each.rate for each in rates)
    values = {"rates": told, "made": tell(GRAVESTONES)}
    if low > 0.0:
        text = noted(
            "share of the stones that falls: {rates}, {spread:.1f} times as many in one model as in another; the {made} is made for them."
        )
        sentence = tell(text, **values, spread=high / low)
    else:
        sentence = tell("share of the stones that falls: {rates}; the {made} is made for them.", **values)
    return tell("{name}: {text}", name=name, text=sentence) if name else sentence


def chance(share: float) -> str:
    """Return a share of perturbed runs as what can be said of it.

    Examples
    --------
    >>> chance(0.0), chance(0.5), chance(1.0)
    ('below 0.03', '0.50', 'above 0.98')
    """
    if share < LEAST:
        return tell("below {share}", share=LEAST)
    return tell("above {share}", share=MOST) if share > MOST else f"{share:.2f}"


def chance_lines(found: Perturbation, block: Block) -> tuple[str, str]:
    """Return how often a perturbed block fell, of what that is the share, and what was varied.

    Parameters
    ----------
    found : Perturbation
    block : Block
        The median of the samples.
    """
    values = {"fallen": found.overturned, "runs": found.runs, "share": chance(found.probability), "of": tell(found.interval_of)}
    low, high = found.probability_interval
    if found.probability < LEAST:
        text = noted("falls in {fallen} of {runs} versions of body and shaking: {share}; of real rocks 3 % fell where no version did.")
    elif found.probability > MOST:
        text = noted("falls in {fallen} of {runs} versions of body and shaking: {share}; of real rocks 2 % stood where every version fell.")
    else:
        text = noted(
            "falls in {fallen} of {runs} versions of body and shaking: {share}; {low} to {high} is the 95 % interval of {of}, no more."
        )
    s = found.spread
    sizes = said("size ±{size}, slenderness ±{slenderness}", size=roughly(s.size), slenderness=roughly(s.slenderness))
    varied = tell(
        "varied: {sizes}, {edges}, restitution ±{restitution}, amplitude ±{amplitude}, azimuth ±{azimuth:g} deg.",
        sizes=sizes,
        edges=sampled_edges(block, found.ranges, s.inset),
        restitution=roughly(s.restitution),
        amplitude=roughly(s.amplitude),
        azimuth=s.azimuth_deg,
    )
    whole, left_out = tell(text, **values, low=chance(low), high=chance(high)), left_out_versions(found.no_answer, found.runs)
    return whole if left_out is None else strung([whole, f"{tell(left_out)}."]), varied
