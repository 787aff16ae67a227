"""Shaking of a cemetery: PGA and equivalent frequency, from a record or as numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from seisblock.core.errors import ParameterError
from seisblock.measures import FilterRange, measure
from seisblock.records import Motion, Record, motion_of

FrequencyKind = Literal["pga_pgv", "fourier", "pulse_width"]


@dataclass(frozen=True, eq=False)
class Shaking:
    """PGA and equivalent frequency of a criterion, and the motion behind them if there is one.

    Parameters
    ----------
    pga, frequency : float, m/s^2 and Hz
    component : str or None
        Direction of a record; None for bare numbers.
    motion : Motion or None
    usual_highpass : FilterRange or None
        Change of the frequency with the usual filters, if it depends on a PGV and changes by more than 5 %.
    """

    pga: float
    frequency: float
    component: str | None = None
    motion: Motion | None = None
    usual_highpass: FilterRange | None = None


def component_shakings(
    record: Record,
    components: Sequence[str],
    *,
    kind: FrequencyKind = "pga_pgv",
    frequency: float | None = None,
) -> list[Shaking]:
    """Return PGA and equivalent frequency of each component of a record ([Furukawa2009]_ section 3(5)e).

    Parameters
    ----------
    record : Record
        With its processing applied.
    components : sequence of str
        Horizontal codes, or azimuths.
    kind : "pga_pgv", "fourier" or "pulse_width"
        Definition of the equivalent frequency; the paper's choice is PGA/(2 pi PGV), both of one component.
    frequency : float, Hz
        Overrides the equivalent frequency of the record.

    Raises
    ------
    ParameterError
        If a component has no equivalent frequency of this kind.
    """
    shakings = []
    for m in measure(record, components).components:
        f = getattr(m.equivalent_frequency_hz, kind) if frequency is None else frequency
        if f is None or not m.pga_m_s2 > 0.0:
            raise ParameterError(
                "component {component} has no equivalent frequency of kind {kind}; choose another kind, or give a frequency",
                component=m.component,
                kind=kind,
            )
        highpass_range = m.usual_highpass if kind == "pga_pgv" and frequency is None else None
        shakings.append(Shaking(m.pga_m_s2, f, m.component, motion_of(record, m.component), highpass_range))
    return shakings
