"""seisblock: seismic response of unanchored objects (sliding, rocking, jumping, uplift, overturning)."""

from __future__ import annotations

import lazy_loader

from seisblock.core.backends import register_backends

__version__ = "0.3.0"

# public names and their types: __init__.pyi; each is imported on first access
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

register_backends(display="seisblock.report.html.notebook", obspy="seisblock.readers.streams")
