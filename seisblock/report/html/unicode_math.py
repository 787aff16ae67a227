"""Typesetting of plain-text formulas with Unicode: ``sqrt(theta_1^2)`` becomes √(θ₁²)."""

from __future__ import annotations

import re

_GREEK = dict(
    zip(
        [
            "alpha",
            "beta",
            "gamma",
            "delta",
            "epsilon",
            "zeta",
            "eta",
            "theta",
            "kappa",
            "lambda",
            "mu",
            "nu",
            "xi",
            "pi",
            "rho",
            "sigma",
            "tau",
            "phi",
            "psi",
            "omega",
        ],
        "αβγδεζηθκλμνξπρστφψω",
        strict=True,
    )
)
_LETTER = re.compile(rf"(?<![A-Za-z])({'|'.join(_GREEK)})(?![A-Za-z])")
_TIMES_PI = re.compile(r"(?<=\d) (?=π)")
_POWER = re.compile(r"(?<=[\w)\]])\^(-?\d+)(?![\d.])")
_INDEX = re.compile(r"(?<=[A-Za-zα-ω'])_(\d+)(?![\w.])")
_THETA_0 = re.compile(r"(?<=[α-ω])(\d)(?![\w.])")
_SYMBOLS = {"<=": "≤", ">=": "≥", "+/-": "±", "-/+": "∓", "sqrt(": "√("}
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def typeset_formulas(text: str) -> str:
    """Replace names of Greek letters, roots, powers, indices and relations in a text by Unicode characters.

    Examples
    --------
    >>> typeset_formulas("omega_1/omega_V <= sqrt(3), m/s^2"), typeset_formulas("2 pi theta0 of the mu_s that alphabets print, 1e-4 s")
    ('ω₁/ω_V ≤ √(3), m/s²', '2π θ₀ of the μ_s that alphabets print, 1e-4 s')
    """
    for source, symbol in _SYMBOLS.items():
        text = text.replace(source, symbol)
    text = _LETTER.sub(lambda match: _GREEK[match[1]], text)
    text = _TIMES_PI.sub("", text)
    text = _POWER.sub(lambda match: match[1].translate(_SUPERSCRIPTS), text)
    return _THETA_0.sub(lambda match: match[1].translate(_SUBSCRIPTS), _INDEX.sub(lambda match: match[1].translate(_SUBSCRIPTS), text))
