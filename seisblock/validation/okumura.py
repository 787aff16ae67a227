"""Okumura et al. (1987), uplift of a block on corner springs: the evidence, section by section."""

from __future__ import annotations

from seisblock.validation.okumura_harmonic import HARMONIC
from seisblock.validation.okumura_modes import MODES

CASES = (*MODES, *HARMONIC)
"""Every case of this paper."""
