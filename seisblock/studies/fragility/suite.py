"""Suite of records: the motions of their components, and their intensities."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.factory import block_for_motion
from seisblock.core.errors import ParameterError, SeisblockError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray, IntArray
from seisblock.readers.discover import iter_records
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read_source
from seisblock.readers.source import Location
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.motion import ALL_AZIMUTHS, motion_toward
from seisblock.records.rotation import oriented_pair
from seisblock.records.site import get_earthquake
from seisblock.studies.azimuths import sweep_azimuths
from seisblock.studies.fragility.intensity import IntensityMeasure

ALL, NORTH = "all", "0"


@dataclass(frozen=True, eq=False)
class Suite:
    """Motions of a set of records.

    Parameters
    ----------
    records : tuple of Record
    motions : tuple of Motion
    owner : (m,) array of int
        Index of the record of each motion.
    magnitudes : (m,) array
        Of the earthquakes, NaN if unknown.
    all_azimuths : bool
        True if each record counts once, in its worst direction: a motion is then that to north, and the others are
        :meth:`directions`.
    ground : Suite or None
        Same records on the ground, for bodies on a floor: its intensities count.
    """

    records: tuple[Record, ...]
    motions: tuple[Motion, ...]
    owner: IntArray
    magnitudes: FloatArray
    all_azimuths: bool = False
    ground: Suite | None = None

    def intensities(self, measure: IntensityMeasure) -> FloatArray:
        """Return the intensity of each unscaled motion, (m,), without the factor of a body; with all azimuths, the largest.

        Raises
        ------
        ParameterError
            If a motion is zero.
        """
        values = self._intensities(measure)
        for row in np.flatnonzero(~(values > 0.0))[:1]:
            raise ParameterError(
                "{record}, {name}: the motion is zero and cannot be scaled to a level: omit this record",
                record=self.records[self.owner[row]].source or lazy_gettext("record"),
                name=self.motions[row].name,
            )
        return values

    @cached_property
    def shapes(self) -> FloatArray:
        """Logarithm of PGV over PGA of each motion, (m,), s: a measure of its period."""
        pgv, pga = IntensityMeasure("pgv"), IntensityMeasure("pga")
        return np.log(self._intensities(pgv) / self._intensities(pga))

    def directions(self, motion: int, body: object) -> Iterator[Motion]:
        """Yield a motion in the directions in which a body may exceed a limit: its own, or all."""
        if not self.all_azimuths:
            yield self.motions[motion]
            return
        record = self.records[self.owner[motion]]
        for azimuth in sweep_azimuths(body).tolist():
            yield motion_toward(record, azimuth)

    def cases(self, motion: int, body: Any, *, spatial: bool = False) -> Iterator[tuple[Any, Motion]]:
        """Yield the directions of a motion with the body in each: with all azimuths the base of a block is projected, as in a sweep.

        In three dimensions (`spatial`) the body keeps its orientation in the ground's.
        """
        if spatial:
            yield from ((body, shaking) for shaking in self.directions(motion, body))
            return
        if self.all_azimuths and isinstance(body, Block):
            blocks = [body.block_toward(azimuth) for azimuth in sweep_azimuths(body).tolist()]
            yield from zip(blocks, self.directions(motion, body), strict=True)
            return
        for shaking in self.directions(motion, body):
            yield block_for_motion(body, shaking), shaking

    def _intensities(self, measure: IntensityMeasure) -> FloatArray:
        """Return the intensity of each motion, (m,): with all azimuths the largest; on a floor that of the ground."""
        if self.ground is not None:
            return self.ground._intensities(measure)
        return np.array([max(map(measure.of, self.directions(row, None))) for row in range(len(self.motions))])

    def weights(self, samples: int, rng: np.random.Generator) -> FloatArray:
        """Return the weight of each motion in bootstrap samples of whole records, (samples, m)."""
        count = len(self.records)
        return np.asarray(rng.multinomial(count, np.full(count, 1.0 / count), samples)[:, self.owner], dtype=np.float64)


def make_suite(records: Sequence[Record], components: tuple[str, ...], preparation: Preparation) -> Suite:
    """Return the motions of some records: of the selected components, or of all horizontals.

    Parameters
    ----------
    records : sequence of Record
        Without processing.
    components : tuple of str
        Codes or azimuths; all horizontals if empty; ``all-azimuths`` for every direction of each record.
    preparation : Preparation

    Raises
    ------
    ParameterError
        If there are fewer than two records.
    ComponentError
        If a record lacks a component.
    """
    if len(records) < 2:
        raise ParameterError(
            "a fragility requires several records (at least 2, better 10), found {count}; give files, a folder or a list (@records.txt)",
            count=len(records),
        )
    processed = tuple(preparation.apply(record) for record in records)
    motions, owner, magnitudes = [], [], []
    requested, all_azimuths = components, any(name.lower() == ALL_AZIMUTHS for name in components)
    if all_azimuths:
        components = (NORTH,)
    for index, record in enumerate(processed):
        if all_azimuths:
            oriented_pair(record)
        is_explicit = components and not any(name.lower() == ALL for name in components)
        for name in components if is_explicit else tuple(component.code for component in record.horizontals) or (ALL,):
            motions.append(motion_of(record, name))
            owner.append(index)
            earthquake = get_earthquake(record)
            magnitudes.append(np.nan if earthquake is None or earthquake.magnitude is None else earthquake.magnitude)
    # the floor response is linear: a factor on the ground is the same factor on the floor
    ground = None if preparation.floor is None else make_suite(records, requested, replace(preparation, floor=None))
    return Suite(processed, tuple(motions), np.array(owner, dtype=np.int64), np.array(magnitudes, dtype=np.float64), all_azimuths, ground)


def read_suite(
    records: Location | Record | Sequence[Location | Record], read_options: ReadOptions | None = None, *, strict: bool = False
) -> tuple[list[Record], tuple[str, ...]]:
    """Return the records of some locations, and a note for each unreadable file.

    Parameters
    ----------
    records : path or Record, or several
    read_options : ReadOptions
        Format, units and other properties missing in the files.
    strict : bool
        True to raise for an unreadable file.

    Raises
    ------
    RecordError
        If no file is readable, or one is not and `strict` is set.
    """
    options = read_options or ReadOptions()
    sources = [records] if isinstance(records, (str, PathLike, Record)) else list(records)
    loaded: list[Record] = []
    left_out: list[str] = []
    failure: SeisblockError | None = None
    for source in sources:
        for recording in [source] if isinstance(source, Record) else iter_records([str(source)], options):
            try:
                loaded.append(recording if isinstance(recording, Record) else read_source(recording, options))
            except SeisblockError as error:
                failure = error
                if strict:
                    raise
                left_out.append(lazy_gettext("excluded: {why}", why=error.message))
    if failure is not None and not loaded:
        raise failure
    selected = [record for record in loaded if options.station in (None, record.station)]
    return selected, tuple(left_out)
