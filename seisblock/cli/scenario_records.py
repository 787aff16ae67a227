"""Records of a scenario, from its intensity, from RECORD, or from both."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seisblock.cli.load_records import check_single_window, load_records, make_preparation
from seisblock.cli.option_checks import reject_with
from seisblock.cli.options import Source
from seisblock.cli.progress import progress
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.units import GAL, KINE

if TYPE_CHECKING:
    from seisblock.records import Record, Storey
    from seisblock.studies.scenario.hazard import RecordFrequencies
    from seisblock.studies.scenario.motions import ScenarioTarget


@dataclass(frozen=True)
class ScenarioMotions:
    """Records of a scenario.

    Parameters
    ----------
    records : list of Record
        Scaled and processed.
    label : Message
        Intensity, or names of the records.
    notes : tuple of Message
        Origin of a suite.
    target : ScenarioTarget or None
    is_suite : bool
        True for the suite of the program.
    """

    records: list[Record]
    label: Message
    notes: tuple[Message, ...]
    target: ScenarioTarget | None
    is_suite: bool


def resolve_pgv(params: Mapping[str, Any]) -> float | None:
    """Return the PGV, kine, of the options ``--pga``, ``--pgv`` and ``--frequency``; None if it is not given."""
    pga, pgv, frequency = params["pga"], params["pgv"], params["frequency"]
    if frequency is None:
        return None if pgv is None else float(pgv)
    if pga is None or pgv is not None:
        raise ParameterError("--frequency requires --pga, and excludes --pgv: PGV = PGA/(2 pi f)")
    return float(pga * GAL / (2.0 * math.pi * frequency) / KINE)


def parse_target(params: Mapping[str, Any]) -> ScenarioTarget | None:
    """Return the intensity of the options ``--jma``, ``--pga``, ``--pgv``, ``--frequency`` and ``--sa``; None without them."""
    from seisblock.studies.scenario.motions import ScenarioTarget

    pga, pgv = params["pga"], resolve_pgv(params)
    period = sa = None
    if params["sa"] is not None:
        first, _, second = params["sa"].partition("=")
        try:
            period, sa = float(first), float(second) * GAL
        except ValueError:
            raise ParameterError(
                "--sa requires a period in s and an acceleration in gal, 0.5=600; found {text!r}", text=params["sa"][:40]
            ) from None
    if all(value is None for value in (params["jma"], pga, pgv, sa)):
        return None
    return ScenarioTarget(params["jma"], None if pga is None else pga * GAL, None if pgv is None else pgv * KINE, sa, period)


def load_scenario(source: Source, params: Mapping[str, Any], *, seed: int) -> ScenarioMotions:
    """Return the records of a scenario.

    Raises
    ------
    ParameterError
        If there is neither an intensity nor a record, or two targets.
    """
    from seisblock.studies.scenario.motions import DEFAULT_RECORDS, scale_to_target, scenario_suite

    check_single_window(source)
    target = parse_target(params)
    if target is not None and (source.target_pga is not None or source.target_jma is not None or source.scale is not None):
        raise ParameterError("--scale, --target-pga and --target-jma have no effect with the intensity of a scenario: omit them")
    if source.record:
        if params["records"] is not None:
            raise ParameterError("RECORD and --records exclude each other: give only one of them")
        records = load_records(source) if target is None else _scaled_records(source, target, scale_to_target)
        names = [record.station or record.source for record in records]
        label = lazy_gettext("{names}", names=names[:3]) if len(names) <= 3 else lazy_gettext("{count} records", count=len(names))
        if target is not None:
            label = lazy_gettext("{names}, scaled to {target}", names=label, target=target.label)
        return ScenarioMotions(records, _on_floor(label, source.floor), (_variation_note(is_scaled=target is not None),), target, False)
    if target is None:
        raise ParameterError("scenario required: give --jma, --pga (with or without --pgv), --pgv or --sa, or a RECORD")
    reject_with(
        lazy_gettext("the built-in suite of motions"),
        ["format", "units", "dt", "station", "level", "strict", "component", "window", "demean", "highpass"],
    )
    with progress("generating the records"):
        records, notes = scenario_suite(target, params["records"] or DEFAULT_RECORDS, seed=seed)
        preparation = make_preparation(source, ())
        records = [preparation.apply(record) for record in records]
    label, notes = _on_floor(target.label, source.floor), (*notes, _variation_note(is_scaled=True))
    if source.floor is not None:
        notes = (*notes, lazy_gettext("{scenario}: the intensity is that of the ground", scenario=label))
    return ScenarioMotions(records, label, notes, target, True)


def _variation_note(*, is_scaled: bool) -> Message:
    """Return what varies from run to run: under an intensity less than in ``respond``, whose probabilities are others."""
    from seisblock.studies.sampling import ParameterVariation

    variation = ParameterVariation()
    values = {"size": 100 * variation.size, "amplitude": 100 * variation.amplitude, "azimuth": variation.azimuth_deg}
    if is_scaled:
        text = N_(
            "runs vary the object (width and height ±{size:g} %, edges, friction, restitution), not the shaking; those of respond also "
            "vary amplitude ±{amplitude:g} % and azimuth ±{azimuth:g}°"
        )
    else:
        text = N_(
            "runs vary the object (width and height ±{size:g} %, edges, friction, restitution) and the shaking (amplitude "
            "±{amplitude:g} %, azimuth ±{azimuth:g}°), as those of respond"
        )
    return lazy_gettext(text, **values)


def _on_floor(label: Message, floor: Storey | None) -> Message:
    """Return the label of a scenario with its floor, on which it otherwise looks like one on the ground."""
    if floor is None:
        return label
    height = "" if floor.height is None else lazy_gettext(", height ratio {height:g}", height=floor.height)
    return lazy_gettext(
        "{scenario}, floor motion T {period:g} s, damping {damping:g}{height}",
        scenario=label,
        period=floor.period_s,
        damping=floor.damping,
        height=height,
    )


def load_hazard(path: Path, *, years: float, target: float, seed: int) -> tuple[ScenarioMotions, RecordFrequencies]:
    """Return the records that stand for a site hazard, and their annual frequencies."""
    from seisblock.studies.hazard.table import read_hazard
    from seisblock.studies.scenario.hazard import hazard_suite

    hazard = read_hazard(path)
    with progress("generating the records"):
        records, frequencies, notes = hazard_suite(hazard, years=years, target=target, seed=seed)
    label = lazy_gettext("hazard {file}, {years:g} years", file=path.name, years=years)
    return ScenarioMotions(records, label, (*notes, _variation_note(is_scaled=True)), None, True), frequencies


def _scaled_records(source: Source, target: ScenarioTarget, scale: Any) -> list[Record]:
    """Return records scaled to an intensity on the ground, before the floor motion and the window."""
    from dataclasses import replace

    ground = load_records(replace(source, floor=None, window=()))
    after = make_preparation(replace(source, demean=False, highpass=None), ())
    return [after.apply(scale(record, target)) for record in ground]
