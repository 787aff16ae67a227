"""Full response of a free-standing rigid block in five modes: rest, sliding, rocking, slide-rocking and flight."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
