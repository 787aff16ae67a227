"""JMA's explanatory table of furniture: shares of unfastened furniture that fall or move, by intensity.

The table says in words what happens to furniture that is not fastened ([JMA2009]_ table of effects indoors, paraphrased): at 5 lower some
may move; at 5 upper some falls; at 6 lower most of it moves and some falls; at 6 upper most of it moves and much falls; at 7 nearly all
of it moves or falls. Words are taken as shares: some is up to a half, most and much are at least a half, nearly all is at least 0.9, and
none at most 0.05. The bodies are the six bundled pieces of furniture. Nothing is fitted: 24 synthetic records of four earthquakes are
scaled to the middle of each class, and a piece falls or moves if either horizontal component, across its depth, makes it do so.

Two pieces are also compared, component by component, with an independent suite of synthetic motions: :data:`INDEPENDENT`. As objects, which
fall under either horizontal, more of them fall (bookcase at 6 lower: 0.96 instead of 0.79). The share depends on the earthquakes of the
suite: motions of long period overturn tall pieces at the same intensity (the same bookcase: 0.58 at magnitudes 6 and 6.5, 1 at 7 and 7.5).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from seisblock.bodies.factory import load_block, table_friction
from seisblock.bodies.toml import read_body_toml
from seisblock.core.i18n import N_
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import respond_params
from seisblock.records.motion import motion_of
from seisblock.records.process import scale_to_jma
from seisblock.records.synthetic.suite import synthetic_suite
from seisblock.validation.case import Case, expected_difference

CLASSES = {"5-lower": 4.75, "5-upper": 5.25, "6-lower": 5.75, "6-upper": 6.25, "7": 7.0}
"""Classes and the intensity to which the records are scaled."""

EARTHQUAKES = ((6.0, 10.0), (6.5, 15.0), (7.0, 20.0), (7.5, 30.0))
"""Magnitude and distance, km, of six records each."""

FURNITURE = ("bookcase", "filing_cabinet", "lateral_filing_cabinet", "refrigerator", "server_rack", "display_case")

MOVED_M = 0.01
"""Residual displacement above which a piece has moved."""

FALLS, MOVES = range(2)

WORDS = {"none": (0.0, 0.05), "some": (0.0, 0.5), "most": (0.5, 1.0), "nearly all": (0.9, 1.0)}
"""Range of the share that a word stands for."""

STATEMENTS = (
    ("5-lower", FALLS, "none"),
    ("5-upper", FALLS, "some"),
    ("6-lower", FALLS, "some"),
    ("6-lower", MOVES, "most"),
    ("6-upper", FALLS, "most"),
    ("6-upper", MOVES, "most"),
    ("7", MOVES, "nearly all"),
)
"""Class, what the furniture does, and the word of the table."""

DIFFERS = ("6-lower", MOVES)
"""Statement that does not hold."""


INDEPENDENT = {"bookcase": (0.0, 0.21, 0.85, 1.0, 1.0), "filing_cabinet": (0.0, 0.0, 0.15, 0.85, 1.0)}
"""Shares of the horizontal components that overturn a piece in another synthetic suite of the same method, by class."""

RECORDS_PER_EARTHQUAKE = 6

LEAST_TOLERANCE = 0.142
"""Width of the 95 % interval (Clopper-Pearson) of a share of 0 or 1 in 24 records."""


def shares(body: str) -> FloatArray:
    """Return the shares of the records in which a body falls, and moves or falls, at each class, (2, 5)."""
    return np.asarray(_ends(body).any(axis=2).mean(axis=1))


def component_shares(body: str) -> FloatArray:
    """Return the shares of the horizontal components that overturn a body at each class, (5,)."""
    return np.asarray(_ends(body)[FALLS].mean(axis=(0, 1)))


@cache
def _ends(body: str) -> BoolArray:
    """Return whether a body falls, and moves or falls, (2, records, components, classes)."""
    mu, kinetic = table_friction(read_body_toml(body), body)
    params = respond_params(load_block(body), options=RespondOptions(mu=mu or 0.0, mu_kinetic=kinetic))
    suite = [
        scale_to_jma(record, 5.0)
        for seed, (magnitude, distance_km) in enumerate(EARTHQUAKES, start=1)
        for record in synthetic_suite(magnitude, distance_km, RECORDS_PER_EARTHQUAKE, seed=seed)
    ]
    gains = [10.0 ** ((level - 5.0) / 2.0) for level in CLASSES.values()]
    results = np.zeros((2, len(suite), 2, len(gains)), dtype=bool)
    for row, record in enumerate(suite):
        for side, code in enumerate(("NS", "EW")):
            ends = respond_many([params] * len(gains), motion_of(record, code), gains=[(gain, 0.0, gain) for gain in gains])
            results[FALLS, row, side] = ends.overturned
            results[MOVES, row, side] = ends.overturned | (np.abs(ends.final_displacement_m) > MOVED_M)
    return results


def _furniture_share(name: str, effect: int) -> Callable[[], float]:
    return lambda: float(np.mean([shares(body)[effect, list(CLASSES).index(name)] for body in FURNITURE]))


def _component_share(body: str, index: int) -> Callable[[], float]:
    return lambda: float(component_shares(body)[index])


def _independent_case(body: str, index: int) -> Case:
    """Return the case of one piece at one class, within two standard errors of a share in the records."""
    share, records = INDEPENDENT[body][index], RECORDS_PER_EARTHQUAKE * len(EARTHQUAKES)
    return Case(
        f"jma-furniture-{body.replace('_', '-')}-{list(CLASSES)[index]}",
        "[JMA2009]_ table of effects indoors",
        N_("share of the horizontal components that overturn a bundled piece"),
        "1",
        share,
        max(2.0 * math.sqrt(share * (1.0 - share) / records), LEAST_TOLERANCE),
        _component_share(body, index),
        kind="rebuilt",
        note=N_(
            "expected: another suite of synthetic motions, components one by one; tolerance: sampling error; as an object, which falls "
            "under either horizontal, a piece falls more often"
        ),
        quick=False,
    )


CASES = (
    *(_independent_case(body, index) for body in INDEPENDENT for index in range(len(CLASSES))),
    *(
        Case(
            f"jma-furniture-{name}-{'moves' if effect else 'falls'}",
            "[JMA2009]_ table of effects indoors",
            N_("share of unfastened furniture that moves or falls") if effect else N_("share of unfastened furniture that falls"),
            "1",
            sum(WORDS[word]) / 2,
            (WORDS[word][1] - WORDS[word][0]) / 2 + 1e-9,
            _furniture_share(name, effect),
            status="differs" if (name, effect) == DIFFERS else "holds",
            kind="rebuilt",
            note=N_(
                "words of the table as ranges; six bundled pieces, 24 synthetic records scaled to the middle of the class, nothing fitted; a "
                "third moves by more than 1 cm at 6 lower, where the table says most; cause unknown: it does not state floors, contents or storeys"
            )
            if (name, effect) == DIFFERS
            else N_(
                "words of the table as ranges; six bundled pieces, 24 synthetic records scaled to the middle of the class, nothing fitted"
            ),
            today=expected_difference(51 / 144) if (name, effect) == DIFFERS else None,
            quick=False,
        )
        for name, effect, word in STATEMENTS
    ),
)
"""Cases of the shares that fall and that move at five classes."""
