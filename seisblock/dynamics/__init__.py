"""Event-driven integration of hybrid systems by Taylor series, used by all models except stack and rigid3d."""

import lazy_loader

# lazy loading: importing a status or an array type does not load the engine
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
