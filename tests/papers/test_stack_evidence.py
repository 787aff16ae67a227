"""Why eq. (10) of [Furukawa2009]_ does not come out, and what the steps of a pile are worth: each case reads as the program claims."""

import pytest

from seisblock.validation import furukawa_dowel, stack_round, stack_steps


@pytest.mark.parametrize("case", (*furukawa_dowel.CASES, *stack_steps.CASES, *stack_round.CASES), ids=lambda case: case.key)
def test_case(case):
    """What holds holds, what differs does by as much as its note explains."""
    result = case.run()
    assert result.verdict == case.status, f"{case.where}: expected {result.expected}, computed {result.computed}"
