"""What a number must be is said once, for every floor."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.two_layer import Contact
from seisblock.core import checks
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.i18n import gettext, use_locale

NUMBERS = [2, 0.25, np.float64(0.5), np.float32(0.5), np.int64(1)]
NO_NUMBERS = [True, "0.2", None, [0.2], np.array(0.2), 1j, np.bool_(True)]


@pytest.mark.parametrize("check", [checks.finite, checks.positive, checks.non_negative])
@pytest.mark.parametrize("value", NUMBERS, ids=repr)
def test_checks_accept_python_and_numpy_numbers(check, value):
    """Python's and numpy's numbers are numbers; the answer is a float of the same value."""
    found = check("the width", value, "m")
    assert found == value and isinstance(found, float)


@pytest.mark.parametrize("check", [checks.finite, checks.positive, checks.non_negative, checks.fraction])
@pytest.mark.parametrize("value", NO_NUMBERS, ids=repr)
def test_checks_reject_bool_and_text(check, value):
    """``width = true`` is not one metre."""
    with pytest.raises(ParameterError, match=r"the width must be a number, found "):
        check("the width", value)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
@pytest.mark.parametrize("check", [checks.finite, checks.positive, checks.non_negative, checks.fraction])
def test_checks_reject_non_finite(check, value):
    """By every check."""
    with pytest.raises(ParameterError):
        check("the width", value)


def test_checks_respect_interval_ends():
    """Zero is not positive and not negative; an interval says which of its ends it holds."""
    assert checks.non_negative("x", 0) == 0.0
    assert checks.in_interval("x", 1, "(0, 1]") == checks.in_interval("x", 1.0, "[0, 1]") == 1.0
    for refused in (
        lambda: checks.positive("x", 0),
        lambda: checks.in_interval("x", 0, "(0, 1]"),
        lambda: checks.in_interval("x", 1, "[0, 1)"),
    ):
        with pytest.raises(ParameterError):
            refused()


def test_check_message_names_quantity_value_and_unit():
    """In English until it is told; bodies raise their own class, and nothing is worded for what passes."""
    with pytest.raises(BodyError, match=r"^stone: width must be positive, found -0.2 m$") as found:
        Block(-0.2, 0.6, name="stone")
    with use_locale("ja"):
        assert "{" not in gettext(found.value.message)


def test_contact_requires_friction_only():
    """The rest follows: kinetic as static friction, the restitutions of the paper; what cannot be is refused where it is said."""
    assert (Contact(0.18).kinetic, Contact(0.18).restitution_x, Contact(0.18).restitution_y) == (0.18, 0.95, 0.85)
    for wrong, says in (
        ({"mu": -0.1}, "the static friction coefficient `mu` must be zero or more, found -0.1"),
        ({"mu": 0.1, "mu_kinetic": 0.2}, "kinetic friction 0.2 must not exceed static friction 0.1"),
        ({"mu": 0.1, "restitution_y": 1.1}, r"restitution y must lie in \[0, 1\], found 1.1"),
    ):
        with pytest.raises(ParameterError, match=says):
            Contact(**wrong)
