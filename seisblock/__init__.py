"""seisblock: what ground motion does to objects that nobody bolted down."""

from __future__ import annotations

import importlib

import lazy_loader

from seisblock.core import _display

__version__ = "0.3.0"

# the public names stand in __init__.pyi, with their types; each is imported when it is first asked for
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

_display.register_backend(lambda: importlib.import_module("seisblock.report.html.notebook"))
