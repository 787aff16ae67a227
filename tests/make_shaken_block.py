"""Make sample_records/shaken_block.csv and its pulses again: ``python -m tests.make_shaken_block``.

A shaking-table experiment that never took place: twelve pulses, each at five strengths, and a block of which it is known what it is. Every
run has a version of the block of its own, as `seisblock fit` takes for granted.
"""

from __future__ import annotations

import hashlib
import io
import math
import tomllib
import zipfile

import numpy as np

from seisblock.bodies.block import from_slenderness, scale_block
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion
from seisblock.samples import MANIFEST, sample_directory
from tests.make_sample_records import manifest

TABLE, PULSES = "shaken_block.csv", "pulses.zip"
ALPHA, P, SCATTER = 0.25, 4.0, 0.05
"""The truth: slenderness, rad; frequency parameter, rad/s; half width of the changes."""

DT = 0.01
FREQUENCIES = tuple(float(f) for f in np.round(np.geomspace(0.5, 5.0, 12), 2))
STRENGTHS = (2.0, 3.0, 4.5, 7.0, 11.0)
"""PGA of each pulse, m/s^2, times a number between 0.8 and 1.25 that is drawn."""

SEED = 20160416
EPOCH = (1980, 1, 1, 0, 0, 0)


def samples(frequency: float) -> np.ndarray:
    """Return one cycle of a sine of 1 m/s^2 at about so many Hz: a pulse of velocity to one side."""
    count = round(1.0 / frequency / DT)
    return np.round(np.sin(2.0 * math.pi * np.arange(count + 1) / count), 5)


def version_falls(motion: Motion, scale: float, rng: np.random.Generator) -> bool:
    """Return what a version of the block does that differs a little from the others."""
    size, slenderness, bounce, amplitude = 1.0 + SCATTER * rng.uniform(-1.0, 1.0, 4)
    version = scale_block(from_slenderness(ALPHA, P), size=size, slenderness=slenderness)
    return rock_verdict(
        version, motion, scale=scale * amplitude, options=RockOptions(restitution=min(version.restitution * bounce, 1.0))
    ).overturned


def make() -> tuple[bytes, bytes]:
    """Return the bundle of the pulses and the table of outcomes."""
    rng = np.random.default_rng(SEED)
    holding, rows = io.BytesIO(), []
    with zipfile.ZipFile(holding, "w", zipfile.ZIP_DEFLATED) as bundle:
        for number, frequency in enumerate(FREQUENCIES, start=1):
            pulse = samples(frequency)
            name = f"pulse_{number:02d}.csv"
            lines = [f"{k * DT:.2f},{value:.5f}" for k, value in enumerate(pulse)]
            text = f"# synthetic: one cycle of a sine, {frequency} Hz\ntime,EW (m/s2)\n" + "\n".join(lines) + "\n"
            bundle.writestr(zipfile.ZipInfo(name, EPOCH), text, zipfile.ZIP_DEFLATED)
            motion = Motion.from_arrays(pulse, DT)
            for strength in STRENGTHS:
                scale = round(float(strength * np.exp(rng.uniform(-0.223, 0.223))), 2)
                rows.append((f"{PULSES}/{name}", scale, int(version_falls(motion, scale, rng))))
    head = (
        "# A shaking-table experiment that never took place: 12 pulses of 1 m/s^2, each at five strengths (scale). SYNTHETIC.\n"
        f"# The truth: a rectangular block of alpha {ALPHA} rad and p {P} rad/s ({2 * _side(0):.3f} m wide, {2 * _side(1):.3f} m high),\n"
        f"# sharp edges, restitution of its angular momentum ({from_slenderness(ALPHA, P).restitution:.3f}), changes of up to\n"
        f"# {100 * SCATTER:g} % from run to run. Made by tests/make_shaken_block.py.\n"
    )
    table = head + "record,scale,fell\n" + "".join(f"{record},{scale:.2f},{outcome}\n" for record, scale, outcome in rows)
    return holding.getvalue(), table.encode()


def _side(kind: int) -> float:
    """Return half the width (0) or half the height (1) of the true block, m."""
    block = from_slenderness(ALPHA, P)
    return (block.width, block.height)[kind] / 2


def main() -> None:
    """Write the files and their entries in the manifest."""
    pulses, table = make()
    about = {
        PULSES: (pulses, {"kind": "motions", "description": "Twelve synthetic pulses, 1 m/s^2, 0.5 to 5 Hz, for shaken_block.csv"}),
        TABLE: (
            table,
            {"kind": "outcomes", "description": "Responses of a block to these pulses: synthetic experiment with known parameters"},
        ),
    }
    common = {"origin": "tests/make_shaken_block.py: computed, NOT an experiment", "licence": "MIT, as seisblock"}
    path = sample_directory() / MANIFEST
    before = path.read_text(encoding="utf-8")
    for name, (data, _) in about.items():
        (sample_directory() / name).write_bytes(data)
    text = manifest({name: (data, {**message, **common}) for name, (data, message) in about.items()}, before)
    remaining = [entry["name"] for entry in tomllib.loads(before)["sample"] if entry["name"] not in about]
    head, *entries = text.split("\n[[sample]]\n")
    mapping = {tomllib.loads(entry)["name"]: entry for entry in entries}
    path.write_text("\n[[sample]]\n".join([head, *(mapping[name].rstrip("\n") + "\n" for name in (*remaining, *about))]), encoding="utf-8")
    for name, (data, _) in about.items():
        print(f"{name}: {len(data)} bytes, {hashlib.sha256(data).hexdigest()}")


if __name__ == "__main__":
    main()
