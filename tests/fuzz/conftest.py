"""Duration and seed of the fuzzing."""

import pytest


@pytest.fixture
def seeds(request):
    """Return the seeds of a test that meets so many accidents in a run of usual length."""
    times, first = request.config.getoption("--fuzz"), request.config.getoption("--fuzz-from")
    return lambda usual: range(first, first + usual * times)
