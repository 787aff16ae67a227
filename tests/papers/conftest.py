"""Slow cases of the papers: those that ``validate --quick`` omits."""

import pytest

from seisblock.validation.case import Case


def pytest_collection_modifyitems(items):
    """Mark them as slow."""
    for item in items:
        case = getattr(item, "callspec", None) and item.callspec.params.get("case")
        if isinstance(case, Case) and not case.quick:
            item.add_marker(pytest.mark.slow)
