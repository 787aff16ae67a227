"""Response of a body or a cemetery to the record of one station, in the worst direction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.registry import Solver, SolverBody, get_solver, solver_names
from seisblock.measures.baseline import ground_history
from seisblock.measures.frequency import pga_pgv_frequency
from seisblock.records import Component, Record
from seisblock.records.motion import ALL_AZIMUTHS, motion_of
from seisblock.records.process import component_at_azimuth
from seisblock.references import papers
from seisblock.studies.assessment import LIKELY, Assessment, assess_record
from seisblock.studies.azimuth_probability import rank_by_probability
from seisblock.studies.azimuths import STEP_DEG
from seisblock.studies.batch.table import REASON, Row
from seisblock.studies.batch.task import Plan, component_rows
from seisblock.studies.respond.azimuths import left_out_directions
from seisblock.studies.solvers import SolverStudies, solver_studies
from seisblock.studies.survey.assessment import AssessmentMethod, assess_stones
from seisblock.studies.survey.overturning_rate import rate_from_stones
from seisblock.studies.survey.shaking import Shaking
from seisblock.studies.survey.stones import either

RANKED_STEP_DEG, RANKED_RUNS = 15.0, 20
"""Step between the azimuths whose probability is computed, degrees, and the largest number of samples of each."""

RISE = "max_uplift_m"
"""Displacement field of a solver whose displacement is a rise."""


@dataclass(frozen=True)
class StationResult:
    """Response at a station; a body has no rate, a cemetery nothing else.

    Parameters
    ----------
    azimuth_deg : float or None
        The worst direction, clockwise from north; with samples the one of the largest overturning probability.
    rate : float or None
        Share of the stones that fall.
    happened : bool or None
        Whether the event of the solver occurred: overturning, sliding, jump, uplift.
    overturned : bool or None
        None for solvers without overturning.
    probability : float or None
        Overturning probability under any horizontal component; None if not requested.
    max_slip_m : float or None
        Maximum displacement of the body; for a jump the sum over all chains.
    max_uplift_m : float or None
        Maximum uplift of a corner of a body on springs.
    remarks : tuple of str
        Directions and samples without a result.
    assessment : Assessment or None
        Of the object under any horizontal component; None if not requested.
    """

    azimuth_deg: float | None = None
    rate: float | None = None
    happened: bool | None = None
    overturned: bool | None = None
    probability: float | None = None
    max_slip_m: float | None = None
    max_uplift_m: float | None = None
    remarks: tuple[str, ...] = ()
    assessment: Assessment | None = None

    @property
    def likely_overturns(self) -> bool:
        """True if at least half of the samples overturn."""
        return self.assessment is not None and self.assessment.class_ == LIKELY

    @property
    def severity(self) -> tuple[float, ...]:
        """Sort key, larger is worse: overturning share, verdict, displacement or rise."""
        share = self.rate if self.probability is None else self.probability
        verdict = float(self.overturned or False), float(self.happened or False)
        return (-1.0 if share is None else share, *verdict, self.max_slip_m or self.max_uplift_m or 0.0)


class StationModel(Protocol):
    """Body or cemetery evaluated at each station."""

    @property
    def name(self) -> str:
        """Name of the body or cemetery."""

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the cited papers."""

    def evaluate(self, record: Record) -> StationResult:
        """Return the response to a record."""


@dataclass(frozen=True, repr=False)
class StationBody(DisplayMixin):
    """A body, evaluated in all azimuths if its solver supports them, else along the horizontal components; the worst counts.

    Parameters
    ----------
    body : Block, ScannedBody, SlidingBase, TwoLayerBlock or SpringBlock
        Of the kind that the solver takes.
    options : SolverOptions
        Of the solver.
    runs, seed : int
        Number of samples of the probability, 0 for none, and their seed.
    step_deg : float
        Azimuth step of a solver that sweeps all azimuths in one batch, degrees; others use their own.
    solver : str
        One of :func:`station_solvers`.
    label : str
        Name of a body without a name.

    Raises
    ------
    ParameterError
        If the solver is unknown, or does not support samples.

    Examples
    --------
    >>> from seisblock.models.slide.options import SlideOptions
    >>> from seisblock.readers import read
    >>> effect = StationBody(0.1, SlideOptions(), solver="slide", label="vase").evaluate(read("hanmer_springs_2016"))
    >>> effect.happened, effect.overturned, round(1000 * effect.max_slip_m)
    (True, None, 48)
    """

    body: Any
    options: Any
    runs: int = 0
    seed: int = 0
    step_deg: float = STEP_DEG
    solver: str = "respond"
    label: str = ""

    def __post_init__(self) -> None:
        if self.solver not in solver_names() or not _takes_station(self.solver):
            raise ParameterError(
                "{solver!r} is not available for stations; use {known}", solver=str(self.solver)[:100], known=station_solvers()
            )
        if self.runs and not self._studies.samples_in_rows:
            raise ParameterError("{solver} does not support samples: omit `runs`, or use respond or rock", solver=self.solver)

    @property
    def name(self) -> str:
        """Name of the body."""
        return self.label or getattr(self.body, "name", "") or lazy_gettext("object")

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the cited papers."""
        has_two_layers = isinstance(self.body, TwoLayerBlock)
        return papers(*(topic for topic in get_solver(self.solver).topics if has_two_layers or topic != "two-layer body"))

    @property
    def _studies(self) -> SolverStudies:
        return solver_studies(self.solver)

    @property
    def is_directional(self) -> bool:
        """True if the solver covers all azimuths."""
        return self._studies.worst_azimuth is not None

    @property
    def event(self) -> str:
        """Field of the outcome for the event of the solver."""
        return get_solver(self.solver).event

    @property
    def columns(self) -> tuple[str, ...]:
        """Fields of a result that the solver fills."""
        solver = get_solver(self.solver)
        filled = {
            "happened": solver.event != solver.overturned or solver.event_values != solver.overturned_values,
            "overturned": solver.overturned is not None,
            "probability": self._studies.samples_in_rows,
            "max_slip_m": solver.displacement is not None and solver.displacement != RISE,
            "max_uplift_m": solver.displacement == RISE,
        }
        return tuple(name for name, is_filled in filled.items() if is_filled)

    def check_options(self) -> None:
        """Raise for invalid solver options, tested once on a motion of 4 zero samples.

        Raises
        ------
        InputError
            The solver's own.
        """
        zeros = np.zeros(4)
        rows = (Component("NS", zeros, 0.0), Component("EW", zeros, 90.0), Component("UD", zeros))
        self.evaluate(Record(rows, 0.01))

    def evaluate(self, record: Record) -> StationResult:
        """Return the response to a record in the worst direction."""
        if self._studies.directions is not None:
            return self._swept_result(record)
        components = (ALL_AZIMUTHS,) if self.is_directional else ()
        plan = Plan(self.solver, (SolverBody(self.name, self.body, self.options),), components)
        rows = component_rows(record, plan)
        results = [_result_from_row(row, plan.model, record) for row in rows if not row.get(REASON)]
        if not results:
            raise ParameterError("{why}", why=rows[0][REASON])
        worst = max(results, key=lambda effect: effect.severity)
        return self._with_assessment(worst, record) if self.runs else worst

    def _swept_result(self, record: Record) -> StationResult:
        """Return the result of a sweep in the worst direction, with the probability of the object."""
        assert self._studies.directions is not None
        results = self._studies.directions(self.body, record, self.options, step_deg=self.step_deg)
        worst, remarks = self._worst_direction(results, record), left_out_directions(results)
        result = StationResult(
            worst.azimuth_deg if worst.moves else None,
            happened=worst.overturned,
            overturned=worst.overturned,
            max_slip_m=getattr(worst, "max_displacement_m", None),
            remarks=tuple(remarks),
        )
        return self._with_assessment(result, record) if self.runs else result

    def _worst_direction(self, results: Sequence[Any], record: Record) -> Any:
        """Return the direction of the largest probability among those in steps of 15 degrees; without samples the first."""
        moving = [result for result in results if result.moves and not result.gave_up]
        if not self.runs or not moving:
            return results[0]
        # near a threshold the single runs of neighbouring azimuths alternate: the worst of many is no worst azimuth
        coarse = [result for result in moving if result.azimuth_deg % RANKED_STEP_DEG == 0.0] or moving
        runs = min(self.runs, RANKED_RUNS)
        return rank_by_probability(self.solver, self.body, record, coarse, self.options, runs, seed=self.seed)[0]

    def _with_assessment(self, result: StationResult, record: Record) -> StationResult:
        """Return a result with the assessment of the object."""
        assessment = assess_record(self.solver, self.body, record, self.options, self.runs, seed=self.seed)
        remarks = result.remarks
        if assessment.runs < self.runs:
            text = lazy_gettext("{count} of {all} samples stopped without a result", count=self.runs - assessment.runs, all=self.runs)
            remarks = (*remarks, text)
        return replace(result, probability=assessment.overturning_probability, assessment=assessment, remarks=remarks)


def station_solvers() -> list[str]:
    """Return the names of the solvers available for stations: all but those of a pile."""
    return [name for name in solver_names() if _takes_station(name)]


def _takes_station(solver: str) -> bool:
    """Return whether a solver is available for stations."""
    return Pile not in get_solver(solver).bodies


def _result_from_row(row: Row, model: Solver, record: Record) -> StationResult:
    name, column = str(row["component"]), model.displacement
    distance = None if column is None or row[column] is None else abs(row[column])
    azimuths = {component.code: component.azimuth_deg for component in record.components}
    return StationResult(
        azimuths[name] if name in azimuths else float(name),
        happened=model.event_occurred(row),
        overturned=model.overturns(row),
        max_slip_m=None if column == RISE else distance,
        max_uplift_m=distance if column == RISE else None,
    )


@dataclass(frozen=True, repr=False)
class StationCemetery(DisplayMixin):
    """A cemetery: stones that either horizontal component overturns, or by PGA and equivalent frequency in every direction.

    Parameters
    ----------
    cemetery : Cemetery
    method : AssessmentMethod or None
        None: simulated stones as in ``overturn-rate``; the fitted criterion for stones with dowels.
    step_deg : float
        Degrees between directions; criteria in closed form only.
    """

    cemetery: Cemetery
    method: AssessmentMethod | None = None
    step_deg: float = STEP_DEG

    @property
    def assessment(self) -> AssessmentMethod:
        """The method in use."""
        return self.method or AssessmentMethod("furukawa" if self.cemetery.reinforced.any() else "simulate")

    @property
    def name(self) -> str:
        """Name of the cemetery."""
        return self.cemetery.name

    @property
    def citations(self) -> tuple[str, ...]:
        """Keys of the cited papers."""
        return self.assessment.citations

    def evaluate(self, record: Record) -> StationResult:
        """Return the rate under both horizontals, or in the direction with the largest one; among equal rates, that of the larger PGA."""
        if self.assessment.criterion == "simulate":
            return self._simulated(record)
        rows = [component_at_azimuth(record, azimuth).acceleration for azimuth in (0.0, 90.0)]
        north, east = (ground_history(row, record.dt) for row in rows)
        worst = (-1.0, 0.0, 0.0)
        for azimuth in np.arange(0.0, 180.0, self.step_deg).tolist():
            cosine, sine = np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))
            pga = float(np.abs(cosine * rows[0] + sine * rows[1]).max())
            pgv = float(np.abs(cosine * north.velocity + sine * east.velocity).max())
            frequency = pga_pgv_frequency(pga, pgv)
            if frequency is not None and pga > 0.0:
                falls = assess_stones(self.cemetery, Shaking(pga, frequency), self.assessment)
                worst = max(worst, (rate_from_stones(falls).rate, pga, azimuth))
        return StationResult(worst[2] if worst[0] >= 0.0 else None, max(worst[0], 0.0))

    def _simulated(self, record: Record) -> StationResult:
        """Return the share of stones that either horizontal component overturns, with the azimuth of the one that overturns more."""
        motions = [motion_of(record, component.code) for component in record.horizontals]
        falls = [
            assess_stones(self.cemetery, Shaking(float(np.abs(motion.horizontal).max()), 1.0, motion=motion), self.assessment)
            for motion in motions
        ]
        worst = max(range(len(motions)), key=lambda index: (falls[index].mean(), np.abs(motions[index].horizontal).max()))
        return StationResult(motions[worst].azimuth_deg, rate_from_stones(either(falls)).rate)
