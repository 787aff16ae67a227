"""Fujino, Sasaki and Hakuno (1978), sliding of a friction-controlled mass: the evidence."""

from __future__ import annotations

from seisblock.validation.fujino_equations import EQUATIONS
from seisblock.validation.fujino_figures import FIGURES

CASES = (*EQUATIONS, *FIGURES)
"""Every case of this paper."""
