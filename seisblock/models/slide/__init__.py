"""Sliding with Coulomb friction on a level or sloping base."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
