"""Sentences on model comparison and on the overturning probability of perturbed runs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from seisblock.bodies.block import Block
from seisblock.core.i18n import N_, format_share, gettext, lazy_gettext
from seisblock.output.describe_wear import sampled_edges
from seisblock.output.text.tables import Part, format_range, format_share_interval, styled_line, with_notes
from seisblock.report.text.assessment import factor_text
from seisblock.studies.model_comparison import ModelComparison, ModelResult
from seisblock.studies.parallel import left_out_versions
from seisblock.studies.rocking.perturb import Perturbation
from seisblock.studies.survey.model_rates import ModelRate


def agreement_line(name: str, agreement: ModelComparison) -> str:
    """Return a sentence on the models that predict overturning and the spread of their scale factors.

    Parameters
    ----------
    name : str
        Direction of the record.
    agreement : ModelComparison
    """
    factors = [opinion.factor for opinion in agreement.opinions if opinion.factor is not None]
    if not agreement.models:
        return gettext("{name}: no model comparison.", name=name)
    if not agreement.opinions or agreement.spread is None:
        return gettext("{name}: overturns in {falls} of {models} models.", name=name, falls=agreement.falls, models=agreement.models)
    values = {"name": name, "models": agreement.models, "spread": agreement.spread}
    if agreement.unanimous:
        if agreement.falls:
            text = N_(
                "{name}: overturns in all {models} models; scale factor to overturning {factors} (largest over smallest {spread:.1f})."
            )
        else:
            text = N_(
                "{name}: does not overturn in any of the {models} models; scale factor to overturning {factors} "
                "(largest over smallest {spread:.1f})."
            )
        return gettext(text, **values, factors=_factor_range(factors))
    text = N_(
        "{name}: overturns in {falls} of {models} models: {falling}; does not overturn in the others: {standing}. In brackets: "
        "scale factor to overturning, where computed (largest over smallest {spread:.1f})."
    )
    falling_models, stable_models = ([_opinion_text(o) for o in agreement.opinions if o.falls is falls] for falls in (True, False))
    sentence = gettext(text, **values, falls=agreement.falls, falling=falling_models, standing=stable_models)
    purpose_built = next((opinion for opinion in agreement.opinions if opinion.made_for_it), None)
    return sentence if purpose_built is None else with_notes(sentence, [_purpose_built_text(purpose_built)])


def agreement_part(name: str, agreement: ModelComparison, *, is_short: bool) -> Any:
    """Return the model comparison as a part of an answer; models that disagree are listed in the details.

    Parameters
    ----------
    name : str
        Direction of the record.
    agreement : ModelComparison
    is_short : bool
        Whether models that agree take one line, too.
    """
    full = styled_line(agreement_line(name, agreement))
    if not agreement.opinions or agreement.spread is None or (agreement.unanimous and not is_short):
        return full
    text = spread_line(name, agreement)
    purpose_built = None if agreement.unanimous else next((opinion for opinion in agreement.opinions if opinion.made_for_it), None)
    return Part((full,), (styled_line(text if purpose_built is None else with_notes(text, [_purpose_built_text(purpose_built)])),))


def spread_line(name: str, agreement: ModelComparison) -> str:
    """Return the number of models that predict overturning and the range of their scale factors, in one line.

    Parameters
    ----------
    name : str
        Direction of the record.
    agreement : ModelComparison
    """
    factors = [opinion.factor for opinion in agreement.opinions if opinion.factor is not None]
    if not factors:
        return agreement_line(name, agreement)
    return gettext(
        "{name}: overturns in {falls} of {models} models; scale factor to overturning {factors}.",
        name=name,
        falls=agreement.falls,
        models=agreement.models,
        factors=_factor_range(factors),
    )


def _factor_range(factors: Sequence[float]) -> str:
    """Return the smallest and the largest scale factor to overturning."""
    low, high = factor_text(min(factors)), factor_text(max(factors))
    return low if low == high else format_range(low, high)


def _opinion_text(opinion: ModelResult) -> str:
    """Return the label of a model with its scale factor to overturning."""
    if opinion.factor is None:
        return model_label(opinion)
    return gettext("{model} ({factor})", model=model_label(opinion), factor=factor_text(opinion.factor))


def model_label(opinion: ModelResult | ModelRate) -> str:
    """Return the name of a model with the pulse frequency and the edge wear it was evaluated for.

    Parameters
    ----------
    opinion : ModelResult or ModelRate

    Examples
    --------
    >>> model_label(ModelResult("half-sine pulse", True, 0.9, frequency_hz=0.75, worn=True))
    'half-sine pulse of 0.75 Hz with worn edges'
    """
    name = gettext(opinion.model)
    if opinion.frequency_hz is not None:
        name = gettext("half-sine pulse of {frequency:.3g} Hz", frequency=opinion.frequency_hz)
    if opinion.worn is None:
        return name
    return gettext("{model} with worn edges", model=name) if opinion.worn else gettext("{model} with sharp edges", model=name)


def _purpose_built_text(opinion: ModelResult) -> str:
    if opinion.falls:
        return gettext("The {model}, derived for such objects, predicts overturning.", model=gettext(opinion.model))
    return gettext("The {model}, derived for such objects, predicts no overturning.", model=gettext(opinion.model))


def rates_line(name: str, rates: tuple[ModelRate, ...]) -> str:
    """Return a sentence on the overturning rates of a cemetery by model; empty for a single model.

    Parameters
    ----------
    name : str
        Direction of the record; empty for bare numbers.
    rates : tuple of ModelRate
    """
    if len(rates) < 2:
        return ""
    head = gettext("{name}, overturning rate by model", name=name) if name else gettext("Overturning rate by model")
    texts = [gettext("{rate:.0%} ({model})", rate=opinion.rate, model=model_label(opinion)) for opinion in rates]
    low, high = min(opinion.rate for opinion in rates), max(opinion.rate for opinion in rates)
    if low > 0.0:
        return gettext("{head}: {rates} (largest over smallest {spread:.1f}).", head=head, rates=texts, spread=high / low)
    return gettext("{head}: {rates}.", head=head, rates=texts)


def perturbation_lines(perturbation: Perturbation, block: Block) -> tuple[str, str]:
    """Return a sentence on the overturning probability of a perturbed block, and one on the varied parameters.

    Parameters
    ----------
    perturbation : Perturbation
    block : Block
        The median of the samples.
    """
    overturned, runs = perturbation.overturned, perturbation.runs
    text = gettext(
        "overturning probability {share} ({fallen} of {runs} samples; 95 % CI {interval}, {of}).",
        share=format_share(perturbation.probability),
        fallen=overturned,
        runs=runs,
        interval=format_share_interval(perturbation.probability_interval),
        of=gettext(perturbation.interval_of),
    )
    notes = []
    # fitted real rocks: the ends of the range of shares are not certain
    if overturned == 0:
        notes.append(gettext("On shaking tables, 3 % overturned where no computed sample did."))
    elif overturned == runs:
        notes.append(gettext("On shaking tables, 2 % stood where all computed samples overturned."))
    if (left_out := left_out_versions(perturbation.no_answer, runs)) is not None:
        notes.append(gettext("{note}.", note=left_out))
    s = perturbation.spread
    sizes = lazy_gettext("width and height ±{share}", share=format_share(s.size))
    variation = gettext(
        "samples with {sizes}, {edges}, restitution ±{restitution}, amplitude ±{amplitude}, azimuth ±{azimuth:g}°.",
        sizes=sizes,
        edges=sampled_edges(block, perturbation.ranges, s.inset),
        restitution=format_share(s.restitution),
        amplitude=format_share(s.amplitude),
        azimuth=s.azimuth_deg,
    )
    return with_notes(text, notes), variation
