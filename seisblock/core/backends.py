"""Modules of higher layers that values delegate to (figures, HTML and JSON; ObsPy), imported at first use.

Results and records lie below plotting and readers in the import order. ``seisblock/__init__.py`` registers the modules by name, so that
``import seisblock`` loads neither matplotlib nor ObsPy.
"""

from __future__ import annotations

import importlib
from typing import Any

_modules: dict[str, str] = {}


def register_backends(**modules: str) -> None:
    """Register modules by the names under which :func:`backend` returns them."""
    _modules.update(modules)


def backend(name: str) -> Any:
    """Return the module registered under a name: ``display`` (plot, html, json_text), ``obspy`` (record_from_obspy, record_to_obspy)."""
    return importlib.import_module(_modules[name])
