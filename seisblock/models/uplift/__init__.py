"""Uplift of a rigid block on corner springs: natural modes, harmonic thresholds, response to a record ([Okumura1987]_)."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
