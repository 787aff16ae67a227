"""Cache of the records named in a table of outcomes."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

from seisblock.core.errors import ComponentError, SeisblockError
from seisblock.core.i18n import lazy_gettext
from seisblock.readers.discover import RecordSource, group_files
from seisblock.readers.options import ReadOptions
from seisblock.readers.read import read, read_source
from seisblock.records import Motion, Preparation, Record, motion_of
from seisblock.records.qc_report import require_clean


@dataclass(eq=False)
class RecordCache:
    """Records of a table, each read once, and their motions.

    Parameters
    ----------
    folder : Path
        Folder of the table.
    preparation : Preparation
    read_options : ReadOptions
    strict : bool
        True to reject a doubtful record.
    """

    folder: Path
    preparation: Preparation
    read_options: ReadOptions
    strict: bool
    records_by_name: dict[str, Record | SeisblockError] = field(default_factory=dict)
    motions: dict[tuple[str, str], Motion] = field(default_factory=dict)
    bundles: dict[Path, dict[str, RecordSource]] = field(default_factory=dict)

    @property
    def records(self) -> tuple[Record, ...]:
        """Readable records."""
        return tuple(entry for entry in self.records_by_name.values() if isinstance(entry, Record))

    def motion(self, name: str, component: str) -> Motion:
        """Return one component of a record; the same object for the same names."""
        record = self._record(name)
        if not component:
            codes = [horizontal.code for horizontal in record.horizontals]
            if len(codes) != 1:
                text = "{name} has the horizontal components {codes}; give the component of the shaking in a column `component`, or for all"
                raise ComponentError(text, name=name, codes=codes or lazy_gettext("none"))
            component = codes[0]
        if (name, component) not in self.motions:
            self.motions[name, component] = motion_of(record, component)
        return self.motions[name, component]

    def _record(self, name: str) -> Record:
        """Return a processed record, from the cache; a failure is cached, too."""
        if name not in self.records_by_name:
            try:
                record = self._read(name)
                if self.strict:
                    require_clean(record)
                self.records_by_name[name] = self.preparation.apply(record)
            except SeisblockError as error:
                self.records_by_name[name] = error
        entry = self.records_by_name[name]
        if isinstance(entry, SeisblockError):
            raise entry
        return entry

    def _read(self, name: str) -> Record:
        """Return the record of a file beside the table, of another path, a sample, or a bundle (``bundle.zip/member.csv``)."""
        local_path = self.folder / name
        bundle = next((item for item in local_path.parents if item.is_file()), None)
        if bundle is not None:
            if bundle not in self.bundles:
                self.bundles[bundle] = {item.path: item for item in group_files([str(bundle)], self.read_options)}
            if str(local_path) in self.bundles[bundle]:
                return read_source(self.bundles[bundle][str(local_path)], self.read_options)
        return read(str(local_path) if os.path.lexists(local_path) else name, **self.read_options.keywords)

    def doubts(self) -> list[str]:
        """Return the warnings about the records, the first of each kind with a count."""
        groups: dict[str, tuple[str, int]] = {}
        for record in self.records:
            for kind, message in {doubt.kind: doubt.message for doubt in record.doubts}.items():
                first, count = groups.get(kind, (message, 0))
                groups[kind] = first, count + 1
        template = "{doubt} (likewise {count} other records)"
        return [first if count == 1 else lazy_gettext(template, doubt=first, count=count - 1) for first, count in groups.values()]
