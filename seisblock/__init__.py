"""seisblock: what ground motion does to objects that nobody bolted down."""

from __future__ import annotations

import importlib
from typing import Any

__version__ = "0.1.0"

_HOME = {
    "Block": "seisblock.bodies.block",
    "Component": "seisblock.records",
    "Contact": "seisblock.bodies.two_layer",
    "Motion": "seisblock.records",
    "Record": "seisblock.records",
    "find_margin": "seisblock.studies.margin",
    "load_block": "seisblock.bodies.library",
    "Gravestone": "seisblock.bodies.gravestone",
    "PileContact": "seisblock.bodies.pile",
    "PileStone": "seisblock.bodies.gravestone",
    "measure": "seisblock.measures",
    "motion_of": "seisblock.records",
    "read": "seisblock.readers",
    "Response": "seisblock.results",
    "TwoLayerBlock": "seisblock.bodies.two_layer",
    "list_samples": "seisblock.readers",
    "read_all": "seisblock.readers",
    "sample_path": "seisblock.readers",
    "solve_jump": "seisblock.solvers.jump",
    "SpringBlock": "seisblock.bodies.spring_block",
    "slide_study": "seisblock.studies.sliding",
    "criterion_study": "seisblock.studies.gravestone_criterion",
    "read_pile": "seisblock.bodies.pile",
    "solve_stack": "seisblock.solvers.stack",
    "solve_slide": "seisblock.solvers.slide",
    "natural_modes": "seisblock.solvers.uplift_modes",
    "rocking_spectrum": "seisblock.studies.spectra",
    "solve_rock": "seisblock.solvers.rock",
    "solve_uplift": "seisblock.solvers.uplift",
    "Cemetery": "seisblock.bodies.cemetery",
    "Stone": "seisblock.bodies.cemetery",
    "counted_survey": "seisblock.studies.survey",
    "estimate_shaking": "seisblock.studies.shaking_estimate",
    "marked_survey": "seisblock.studies.survey",
    "overturning_rate": "seisblock.studies.overturning_rate",
    "rate_curve": "seisblock.studies.overturning_rate",
    "read_cemetery": "seisblock.bodies.cemetery_csv",
    "scale_factors": "seisblock.studies.scale_factors",
    "uplift_minima": "seisblock.solvers.uplift_minima",
    "uplift_thresholds": "seisblock.solvers.uplift_harmonic",
}

__all__ = ["__version__", *_HOME]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for (PEP 562)."""
    if name not in _HOME:
        raise AttributeError(f"module 'seisblock' has no attribute {name!r}")
    value = getattr(importlib.import_module(_HOME[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)
