"""Slow parameters of a test, left to ``-m slow``."""

from collections.abc import Iterable, Set

import pytest


def all_but_slow(values: Iterable, quick: Set) -> list:
    """Return parameters of a test; those that are not among the quick ones are marked slow."""
    return [value if value in quick else pytest.param(value, marks=pytest.mark.slow) for value in values]
