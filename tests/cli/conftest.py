"""Fixtures of commands."""

import pytest

from tests.lengths import short_studies


@pytest.fixture
def few_runs():
    """Take few records and few runs of each for `secure` and `scenario`, and few blocks for `fit`."""
    with short_studies():
        yield
