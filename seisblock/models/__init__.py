"""Mechanical models: the response of a body to a ground motion, one subpackage per model."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
