"""JSON document of ``seisblock risk``: annual frequency at a site."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import numpy as np
from msgspec import Meta, Struct

from seisblock.core.i18n import lazy_gettext
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema
from seisblock.references import papers
from seisblock.studies.fragility.io import FragilityCurve
from seisblock.studies.hazard.curve import Hazard
from seisblock.studies.hazard.risk import Risk


class HazardBranch(Struct, frozen=True, kw_only=True):
    """One branch of the hazard.

    Parameters
    ----------
    branch : str
    weight : float
    levels : list of float
        In the unit of the measure.
    annual_rates : list of float
        Frequencies, 1/year, with which they are exceeded.
    """

    branch: str
    weight: float
    levels: tuple[float, ...]
    annual_rates: tuple[float, ...]


class RiskParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    im, unit : str
        Measure of intensity, and the unit of its values.
    hazard_source : str
    hazard : list of HazardBranch
    years : float
        Period of the probability.
    stood_years : float or None
        Observed period without occurrence.
    """

    im: str
    unit: str
    hazard_source: str
    hazard: tuple[HazardBranch, ...]
    years: float
    stood_years: float | None


LEADING_KEYS = {
    "body": Annotated[str, Meta(description="Body of the fragility; empty if unknown.")],
    "limit": Annotated[str, Meta(description="Limit state; empty if unknown.")],
}
RISK_RESULT = entry_type("RiskResult", Risk, leading=LEADING_KEYS, exclude=("hazard", "stood_years", "notes"))
RISK = DocumentSchema("risk", RiskParameters, RISK_RESULT)


def document(risks: Sequence[tuple[FragilityCurve, Risk]], hazard: Hazard, source: str) -> Document:
    """Return the document of risks at one site.

    Parameters
    ----------
    risks : sequence of (FragilityCurve, Risk)
    hazard : Hazard
    source : str
        Name of its file.
    """
    first_risk = risks[0][1]
    parameters = RiskParameters(
        im=hazard.im,
        unit=hazard.unit,
        hazard_source=source,
        hazard=tuple(_branch(i, risk_branch.weight, hazard) for i, risk_branch in enumerate(first_risk.branches)),
        years=first_risk.probability.years,
        stood_years=first_risk.stood_years,
    )
    entries = ((None, to_entry(RISK_RESULT, risk, body=fragility.body, limit=fragility.limit)) for fragility, risk in risks)
    notes = [
        (", ".join(filter(None, (fragility.body, fragility.limit))), note)
        for fragility, risk in risks
        for note in risk.notes[len(hazard.notes) :]
    ]
    warnings = [lazy_gettext("{name}: {text}", name=name, text=note) if name and len(risks) > 1 else note for name, note in notes]
    return RISK.document(parameters, entries, citations=papers("risk"), warnings=[*hazard.notes, *warnings])


def _branch(index: int, weight: float, hazard: Hazard) -> HazardBranch:
    curve = hazard.branches[index]
    levels, rates = (tuple(float(value) for value in row) for row in map(np.asarray, (curve.levels, curve.rates)))
    return HazardBranch(branch=curve.name, weight=weight, levels=levels, annual_rates=rates)
