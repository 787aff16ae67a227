"""Response in three dimensions of one rigid convex body: sliding, rocking, rolling, twisting, flight and overturning."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
