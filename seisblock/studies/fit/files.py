"""The records that a table of outcomes names."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

from seisblock.errors import ComponentError, SeisblockError
from seisblock.readers.dispatch import Options
from seisblock.readers.gather import Recording, recordings
from seisblock.readers.read import read
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.doubtful import refuse_doubtful
from seisblock.words import said


@dataclass(eq=False)
class Files:
    """The records of a table, each read once, and the motions in them.

    Parameters
    ----------
    folder : Path
        Where the table is.
    preparation : Preparation
    reading : Options
    strict : bool
        Whether a doubtful record is refused.
    """

    folder: Path
    preparation: Preparation
    reading: Options
    strict: bool
    found: dict[str, Record | SeisblockError] = field(default_factory=dict)
    motions: dict[tuple[str, str], Motion] = field(default_factory=dict)
    bundles: dict[Path, dict[str, Recording]] = field(default_factory=dict)

    @property
    def records(self) -> tuple[Record, ...]:
        """The records that could be read."""
        return tuple(each for each in self.found.values() if isinstance(each, Record))

    def motion(self, name: str, component: str) -> Motion:
        """Return one component of a record; the same one for the same names."""
        record = self._record(name)
        if not component:
            codes = [each.code for each in record.horizontals]
            if len(codes) != 1:
                text = "{name} has the horizontal components {codes}: say which acted, in a column `component` or for all"
                raise ComponentError(text, name=name, codes=codes or said("none"))
            component = codes[0]
        if (name, component) not in self.motions:
            self.motions[name, component] = motion_of(record, component)
        return self.motions[name, component]

    def _record(self, name: str) -> Record:
        """Return a record as it is prepared; one that cannot be read is not tried again."""
        if name not in self.found:
            try:
                record = self._read(name)
                if self.strict:
                    refuse_doubtful(record)
                self.found[name] = self.preparation.apply(record)
            except SeisblockError as error:
                self.found[name] = error
        found = self.found[name]
        if isinstance(found, SeisblockError):
            raise found
        return found

    def _read(self, name: str) -> Record:
        """Return the record in a file beside the table, elsewhere, among the samples, or in a bundle (``bundle.zip/member.csv``)."""
        beside = self.folder / name
        bundle = next((each for each in beside.parents if each.is_file()), None)
        if bundle is not None:
            if bundle not in self.bundles:
                self.bundles[bundle] = {each.path: each for each in recordings([str(bundle)], self.reading)}
            if str(beside) in self.bundles[bundle]:
                return self.bundles[bundle][str(beside)].read(self.reading)
        told = {key: getattr(self.reading, key) for key in ("format", "units", "dt", "station", "level")}
        return read(str(beside) if os.path.lexists(beside) else name, **told)

    def doubts(self) -> list[str]:
        """Return what is doubtful about the records, of each kind of doubt one."""
        told: dict[str, tuple[str, int]] = {}
        for record in self.records:
            for kind, message in {doubt.kind: doubt.message for doubt in record.doubts}.items():
                first, count = told.get(kind, (message, 0))
                told[kind] = first, count + 1
        more = "{doubt} (and {count} more records alike)"
        return [first if count == 1 else said(more, doubt=first, count=count - 1) for first, count in told.values()]
