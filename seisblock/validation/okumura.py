"""Validation against Okumura et al. (1987): uplift of a block on corner springs."""

from __future__ import annotations

from seisblock.validation.okumura_harmonic import HARMONIC
from seisblock.validation.okumura_modes import MODES
from seisblock.validation.okumura_records import RECORDS

CASES = (*MODES, *HARMONIC, *RECORDS)
"""All cases of this paper."""
