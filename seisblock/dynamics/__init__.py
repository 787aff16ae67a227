"""Time, state, modes: the engine that every trajectory but the stone pile's runs on."""

import lazy_loader

# what names a status or an array type does not load the engine
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
