"""Validation against Fujino, Sasaki and Hakuno (1978): sliding of a rigid mass with friction."""

from __future__ import annotations

from seisblock.validation.fujino_equations import EQUATIONS
from seisblock.validation.fujino_figures import FIGURES

CASES = (*EQUATIONS, *FIGURES)
"""All cases of this paper."""
