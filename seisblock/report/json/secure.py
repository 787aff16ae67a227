"""JSON document of ``seisblock secure``: measures and the runs that verify them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import msgspec

from seisblock.models.respond.options import RespondOptions
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import NOTES_KEY, Document, DocumentSchema
from seisblock.references import command_papers
from seisblock.report.json.scenario import ScenarioParameters, scenario_parameters
from seisblock.studies.scenario.secure import Security


class SecureParameters(ScenarioParameters, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    hazard : str or None
        File of the hazard; null in a scenario.
    """

    hazard: str | None


SECURE_RESULT = entry_type("SecureResult", Security)
SECURE = DocumentSchema(
    "secure",
    SecureParameters,
    SECURE_RESULT,
    NOTES_KEY,
)


def document(
    result: Security,
    motions: Any,
    options: RespondOptions,
    *,
    mu: float | None,
    seed: int,
    hazard: str | None = None,
    notes: Sequence[str] = (),
) -> Document:
    """Return the document of the measures of one object.

    Parameters
    ----------
    result : Security
    motions : ScenarioMotions
        Records with their intensity.
    options : RespondOptions
    mu : float or None
        Friction; None where it is drawn.
    seed : int
    hazard : str or None
        File of the hazard.
    notes : sequence of str
        Origin of the motions, assumptions.
    """
    values = {"mu": mu, "vertical": options.vertical, "gravity_m_s2": options.gravity, "seed": seed}
    scenario = scenario_parameters(motions.target, motions.records, values, suite=motions.is_suite)
    return SECURE.document(
        SecureParameters(**msgspec.structs.asdict(scenario), hazard=hazard),
        [(None, to_entry(SECURE_RESULT, result))],
        records=() if motions.is_suite else motions.records,
        citations=command_papers("secure"),
        notes=[str(note) for note in notes],
    )
