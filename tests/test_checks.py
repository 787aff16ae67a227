"""Checks of numbers."""

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
    """Numbers of Python and NumPy are accepted; the result is a float of the same value."""
    result = check("the width", value, "m")
    assert result == value and isinstance(result, float)


@pytest.mark.parametrize("check", [checks.finite, checks.positive, checks.non_negative, checks.fraction])
@pytest.mark.parametrize("value", NO_NUMBERS, ids=repr)
def test_checks_reject_bool_and_text(check, value):
    """``width = true`` is not one metre."""
    with pytest.raises(ParameterError, match=r"the width must be a number, found "):
        check("the width", value)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
@pytest.mark.parametrize("check", [checks.finite, checks.positive, checks.non_negative, checks.fraction])
def test_checks_reject_non_finite(check, value):
    """NaN and infinity are rejected by every check."""
    with pytest.raises(ParameterError):
        check("the width", value)


def test_checks_respect_interval_ends():
    """Zero is not positive; brackets tell whether an end belongs to the interval."""
    assert checks.non_negative("x", 0) == 0.0
    assert checks.in_interval("x", 1, "(0, 1]") == checks.in_interval("x", 1.0, "[0, 1]") == 1.0
    for call in (
        lambda: checks.positive("x", 0),
        lambda: checks.in_interval("x", 0, "(0, 1]"),
        lambda: checks.in_interval("x", 1, "[0, 1)"),
    ):
        with pytest.raises(ParameterError):
            call()


def test_check_message_names_quantity_value_and_unit():
    """The message is English with a Japanese translation; bodies raise their own class."""
    with pytest.raises(BodyError, match=r"^stone: width must be positive, found -0.2 m$") as error:
        Block(-0.2, 0.6, name="stone")
    with use_locale("ja"):
        assert "{" not in gettext(error.value.message)


def test_contact_requires_friction_only():
    """Defaults: kinetic as static friction, restitutions of the paper; values out of range raise an error that names them."""
    assert (Contact(0.18).kinetic, Contact(0.18).restitution_x, Contact(0.18).restitution_y) == (0.18, 0.95, 0.85)
    for options, message in (
        ({"mu": -0.1}, "the static friction coefficient `mu` must be zero or more, found -0.1"),
        ({"mu": 0.1, "mu_kinetic": 0.2}, "kinetic friction 0.2 must not exceed static friction 0.1"),
        ({"mu": 0.1, "restitution_y": 1.1}, r"restitution y must lie in \[0, 1\], found 1.1"),
    ):
        with pytest.raises(ParameterError, match=message):
            Contact(**options)
