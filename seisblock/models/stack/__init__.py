"""Three-dimensional discrete-element model of a pile of stones: rigid contact, or springs and dashpots."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
