"""Jump of a two-layer block: rocking, impact, flight, landing and rocking-sliding ([Sugimoto2017]_)."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
