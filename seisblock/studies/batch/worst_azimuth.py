"""``all-azimuths`` in a batch: worst azimuth of each body and record, as in the single commands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any

from seisblock.core.errors import ParameterError
from seisblock.core.registry import get_solver
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.studies.solvers import solver_studies, solvers_with


def is_all_azimuths(components: Sequence[str]) -> bool:
    """Return whether all azimuths are requested."""
    return any(name.lower() == ALL_AZIMUTHS for name in components)


def check_all_azimuths(solver: str, components: Sequence[str], options: Mapping[str, Any]) -> None:
    """Raise for components and options incompatible with all azimuths.

    Raises
    ------
    ParameterError
        If other components are given, or the solver or an option does not support all azimuths.
    """
    if not is_all_azimuths(components):
        return
    if len(components) > 1:
        raise ParameterError("{name} covers all azimuths: give no other component", name=ALL_AZIMUTHS)
    ability = solver_studies(solver)
    if ability.worst_azimuth is None:
        raise ParameterError(
            "{solver} does not support all azimuths; available: {known}", solver=solver, known=solvers_with("worst_azimuth")
        )
    defaults = {field.name: field.default for field in fields(get_solver(solver).options)}
    unknown = [f"`{name}`" for name in ability.single_direction_options if options.get(name, defaults[name]) != defaults[name]]
    if unknown:
        raise ParameterError("{solver} in all azimuths has no option {names}: omit it", solver=solver, names=unknown)
