"""A suite of records as the bodies feel them: the motions of their components, and how strong each is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike

import numpy as np

from seisblock.core.errors import ParameterError, SeisblockError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray, IntArray
from seisblock.readers.discover import iter_records
from seisblock.readers.dispatch import ReadOptions
from seisblock.readers.source import Location
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.motion import ALL_AZIMUTHS
from seisblock.records.rotation import oriented_pair
from seisblock.records.site import get_earthquake
from seisblock.studies.azimuths import sweep_azimuths
from seisblock.studies.fragility.intensity import IntensityMeasure

ALL, NORTH = "all", "0"


@dataclass(frozen=True, eq=False)
class Suite:
    """The motions of some records.

    Parameters
    ----------
    records : tuple of Record
    motions : tuple of Motion
    owner : (m,) array of int
        Which record each motion is of.
    magnitudes : (m,) array
        Of the earthquakes, NaN where the file does not say.
    all_azimuths : bool
        Whether each record counts once, in the worst of its directions: then a motion is that to north, and the others are
        :meth:`directions`.
    ground : Suite or None
        Of the same records under the storey on which the bodies stand, where they do: its intensities count.
    """

    records: tuple[Record, ...]
    motions: tuple[Motion, ...]
    owner: IntArray
    magnitudes: FloatArray
    all_azimuths: bool = False
    ground: Suite | None = None

    def intensities(self, measure: IntensityMeasure) -> FloatArray:
        """Return the intensity of each motion as it is, (m,), without the share of a body; the largest of all directions where they count.

        Raises
        ------
        ParameterError
            If there is no shaking in one of them.
        """
        values = self._measured(measure)
        for row in np.flatnonzero(~(values > 0.0))[:1]:
            raise ParameterError(
                "{record}, {name}: there is no shaking in it, so that no factor brings it to a level: leave it out",
                record=self.records[self.owner[row]].source or lazy_gettext("record"),
                name=self.motions[row].name,
            )
        return values

    @cached_property
    def shapes(self) -> FloatArray:
        """Logarithm of PGV over PGA of each motion, (m,), s: how slowly it shakes."""
        pgv, pga = IntensityMeasure("pgv"), IntensityMeasure("pga")
        return np.log(self._measured(pgv) / self._measured(pga))

    def directions(self, motion: int, body: object) -> Iterator[Motion]:
        """Yield a motion in the directions in which a body has to pass a limit, one after another: its own, or all."""
        if not self.all_azimuths:
            yield self.motions[motion]
            return
        for azimuth in sweep_azimuths(body).tolist():
            yield motion_of(self.records[self.owner[motion]], f"{azimuth:g}")

    def _measured(self, measure: IntensityMeasure) -> FloatArray:
        """Return the intensity of each motion, (m,): where all directions count that of the largest; on a storey that of the ground."""
        if self.ground is not None:
            return self.ground._measured(measure)
        return np.array([max(map(measure.of, self.directions(row, None))) for row in range(len(self.motions))])

    def weights(self, samples: int, rng: np.random.Generator) -> FloatArray:
        """Return how often each motion counts in samples that draw whole records, (samples, m)."""
        count = len(self.records)
        return np.asarray(rng.multinomial(count, np.full(count, 1.0 / count), samples)[:, self.owner], dtype=np.float64)


def make_suite(records: Sequence[Record], components: tuple[str, ...], preparation: Preparation) -> Suite:
    """Return the motions of some records: of each component asked for, or of all horizontals.

    Parameters
    ----------
    records : sequence of Record
        As they were read.
    components : tuple of str
        Codes or azimuths; all horizontals when empty; ``all-azimuths`` for every direction of each record.
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
            "one record says nothing of how records differ: give several, ten or more, a folder or a list (@records.txt); found {count}",
            count=len(records),
        )
    prepared = tuple(preparation.apply(record) for record in records)
    motions, owner, magnitudes = [], [], []
    requested, all_azimuths = components, any(name.lower() == ALL_AZIMUTHS for name in components)
    if all_azimuths:
        components = (NORTH,)
    for index, record in enumerate(prepared):
        if all_azimuths:
            oriented_pair(record)
        is_explicit = components and not any(name.lower() == ALL for name in components)
        for name in components if is_explicit else tuple(component.code for component in record.horizontals) or (ALL,):
            motions.append(motion_of(record, name))
            owner.append(index)
            earthquake = get_earthquake(record)
            magnitudes.append(np.nan if earthquake is None or earthquake.magnitude is None else earthquake.magnitude)
    # a storey is linear: a factor on the ground is one on it
    ground = None if preparation.floor is None else make_suite(records, requested, replace(preparation, floor=None))
    return Suite(prepared, tuple(motions), np.array(owner, dtype=np.int64), np.array(magnitudes, dtype=np.float64), all_azimuths, ground)


def read_suite(
    records: Location | Record | Sequence[Location | Record], read_options: ReadOptions | None = None, *, strict: bool = False
) -> tuple[list[Record], tuple[str, ...]]:
    """Return the records that some names stand for, and a sentence for each file that could not be read.

    Parameters
    ----------
    records : path or Record, or several
    read_options : Options
        What the caller says of files that do not say it themselves.
    strict : bool
        Whether a file that cannot be read is refused.

    Raises
    ------
    RecordError
        If none can be read, or one cannot and all must.
    """
    options = read_options or ReadOptions()
    sources = [records] if isinstance(records, (str, PathLike, Record)) else list(records)
    loaded: list[Record] = []
    left_out: list[str] = []
    failure: SeisblockError | None = None
    for source in sources:
        for recording in [source] if isinstance(source, Record) else iter_records([str(source)], options):
            try:
                loaded.append(recording if isinstance(recording, Record) else recording.read(options))
            except SeisblockError as error:
                failure = error
                if strict:
                    raise
                left_out.append(lazy_gettext("left out: {why}", why=error.message))
    if failure is not None and not loaded:
        raise failure
    selected = [record for record in loaded if options.station in (None, record.station)]
    return selected, tuple(left_out)
