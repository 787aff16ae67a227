"""Duration and seed of the fuzzing."""

import pytest


@pytest.fixture
def seeds(request):
    """Return the seeds of a fuzz test for the usual length of a run."""
    times, first = request.config.getoption("--fuzz"), request.config.getoption("--fuzz-from")
    return lambda usual: range(first, first + usual * times)
