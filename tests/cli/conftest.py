"""Fixtures of commands."""

import pytest

from tests.lengths import short_scenarios


@pytest.fixture
def few_runs():
    """Take few records and few runs of each for `secure` and `scenario`."""
    with short_scenarios():
        yield
