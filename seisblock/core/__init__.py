"""Types and services shared by every subpackage: errors, units, results, messages, limits and file output."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
