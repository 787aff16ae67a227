"""seisblock: what ground motion does to objects that nobody bolted down."""

from __future__ import annotations

import importlib
from typing import Any

from seisblock import showing

__version__ = "0.2.0"

_HOME = {
    "Block": "seisblock.bodies.block",
    "Component": "seisblock.records",
    "Contact": "seisblock.bodies.two_layer",
    "Motion": "seisblock.records",
    "Record": "seisblock.records",
    "find_margin": "seisblock.studies.rocking.margin",
    "load_block": "seisblock.bodies.library",
    "Pile": "seisblock.bodies.pile.pile",
    "PileContact": "seisblock.bodies.pile.contact",
    "PileStone": "seisblock.bodies.pile.stone",
    "measure": "seisblock.measures",
    "motion_of": "seisblock.records",
    "read": "seisblock.readers",
    "Response": "seisblock.results",
    "TwoLayerBlock": "seisblock.bodies.two_layer",
    "list_samples": "seisblock.readers",
    "read_all": "seisblock.readers",
    "sample_path": "seisblock.readers",
    "solve_jump": "seisblock.solvers.jump.solve",
    "SlidingBase": "seisblock.bodies.sliding_base",
    "SpringBlock": "seisblock.bodies.spring_block",
    "slide_study": "seisblock.studies.sliding",
    "criterion_study": "seisblock.studies.gravestone_criterion",
    "read_pile": "seisblock.bodies.pile.toml",
    "solve_stack": "seisblock.solvers.stack.solve",
    "solve_slide": "seisblock.solvers.slide.solve",
    "natural_modes": "seisblock.solvers.uplift.modes",
    "rocking_spectrum": "seisblock.studies.rocking.spectra",
    "solve_rock": "seisblock.solvers.rock.solve",
    "solve_uplift": "seisblock.solvers.uplift.solve",
    "Cemetery": "seisblock.bodies.cemetery.cemetery",
    "Stone": "seisblock.bodies.cemetery.cemetery",
    "counted_survey": "seisblock.studies.inverse.survey",
    "estimate_shaking": "seisblock.studies.inverse.estimate",
    "marked_survey": "seisblock.studies.inverse.survey",
    "overturning_rate": "seisblock.studies.cemetery.rate",
    "rate_curve": "seisblock.studies.cemetery.rate",
    "read_cemetery": "seisblock.bodies.cemetery.table",
    "scale_factors": "seisblock.studies.inverse.factors",
    "uplift_minima": "seisblock.solvers.uplift.minima",
    "uplift_thresholds": "seisblock.solvers.uplift.harmonic",
}

__all__ = ["__version__", *_HOME]

showing.lend(lambda: importlib.import_module("seisblock.present.pages.notebook"))


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
