"""JSON document of ``seisblock fragility``: curves and their basis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from msgspec import Struct

from seisblock.bodies.block import Block
from seisblock.core.registry import SolverBody, get_solver
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.output.json.bodies import BlockEntry, block_entry
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema
from seisblock.references import papers
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.fragility.results import Fragility, FragilityStudy


class FragilityBody(Struct, frozen=True, kw_only=True):
    """One body.

    Parameters
    ----------
    name : str
    block : BlockEntry or None
        Null for other bodies than blocks.
    mu, mu_kinetic : float or None
        Friction, if the solver uses it.
    """

    name: str
    block: BlockEntry | None
    mu: float | None
    mu_kinetic: float | None


class CurveEntry(Struct, frozen=True, kw_only=True):
    """A lognormal curve.

    Parameters
    ----------
    median : float
    beta : float
    unit : str
        Of the median.
    """

    median: float
    beta: float
    unit: str


class FragilityParameters(Struct, frozen=True, kw_only=True):
    """Parameters of the command.

    Parameters
    ----------
    solver, method : str
    bodies : list of FragilityBody
    limits, im : list of str
        Limit states in increasing order; intensity measures, that of the curves first.
    vertical : bool or None
        Whether the vertical component acts; null: where the record has one.
    gravity_m_s2 : float
    perturb, bootstrap, seed : int
        Samples of each body, bootstrap samples of the records, and the random seed.
    confidence : float
        Level of the intervals.
    least_scale, largest_scale : float
        Smallest and largest factor on a record.
    compare : CurveEntry or None
        Reference curve.
    suite : str or None
        Magnitude, distance and count of synthetic records, ``synthetic:M7:R20:40``; null where records were given.
    """

    solver: str
    method: str
    bodies: tuple[FragilityBody, ...]
    limits: tuple[str, ...]
    im: tuple[str, ...]
    vertical: bool | None
    gravity_m_s2: float
    perturb: int
    bootstrap: int
    seed: int
    confidence: float
    least_scale: float
    largest_scale: float
    compare: CurveEntry | None
    suite: str | None = None


FRAGILITY_RESULT = entry_type("FragilityResult", Fragility)
FRAGILITY = DocumentSchema("fragility", FragilityParameters, FRAGILITY_RESULT)


def document(
    study: FragilityStudy,
    bodies: Sequence[SolverBody],
    options: Mapping[str, Any],
    *,
    compare: Lognormal | None = None,
    notes: Sequence[str] = (),
) -> Document:
    """Return the document of fragility curves.

    Parameters
    ----------
    study : FragilityStudy
    bodies : sequence of SolverBody
    options : mapping
        ``im``, ``perturb``, ``bootstrap``, ``seed``, ``vertical``, ``gravity``, ``suite``.
    compare : Lognormal or None
    notes : sequence of str
        Warnings beside the study's own.
    """
    parameters = FragilityParameters(
        solver=study.solver,
        method=study.method,
        bodies=tuple(_body_entry(body) for body in bodies),
        limits=tuple(dict.fromkeys(curve.limit for curve in study.curves)),
        im=tuple(options["im"]),
        vertical=options.get("vertical"),
        gravity_m_s2=options.get("gravity", STANDARD_GRAVITY),
        perturb=options["perturb"],
        bootstrap=options["bootstrap"],
        seed=options["seed"],
        confidence=study.confidence,
        least_scale=study.factors[0],
        largest_scale=study.factors[1],
        compare=None if compare is None else CurveEntry(median=compare.median, beta=compare.beta, unit=study.measure.unit),
        suite=options.get("suite"),
    )
    entries = ((None, to_entry(FRAGILITY_RESULT, curve)) for curve in study.curves)
    citations = papers("fragility", *get_solver(study.solver).topics[:1], *(["synthetic records"] if options.get("suite") else []))
    return FRAGILITY.document(
        parameters,
        entries,
        records=study.records,
        citations=citations,
        warnings=[*notes, *study.notes],
        has_floor_motion=study.floor is not None,
    )


def _body_entry(body: SolverBody) -> FragilityBody:
    block = block_entry(body.body) if isinstance(body.body, Block) else None
    mu, kinetic = (getattr(body.options, key, getattr(body.body, key, None)) for key in ("mu", "mu_kinetic"))
    return FragilityBody(name=body.name, block=block, mu=mu, mu_kinetic=kinetic)
