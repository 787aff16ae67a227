"""Studies of many runs: probability, margin, spectrum, fragility, hazard, survey, fit, map and batch."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
