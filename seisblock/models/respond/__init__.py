"""What a free-standing rigid block does: it rests, slides, rocks, slides while rocking, flies and falls, whichever comes."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
