"""Build hook of the wheel: compile the translation catalogues."""

from datetime import UTC, datetime
from io import BytesIO
from pathlib import Path
from typing import Any

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.builders.utils import get_reproducible_timestamp


class Catalogues(BuildHookInterface):
    """Compile each catalogue beside its source, for a wheel and for an editable installation."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile the catalogues before the files of the wheel are collected."""
        # SOURCE_DATE_EPOCH, else hatchling's fixed date: Babel would write the current minute into the header
        date = datetime.fromtimestamp(get_reproducible_timestamp(), UTC)
        for source in sorted(Path(self.root, "seisblock", "locale").rglob("*.po")):
            with source.open("rb") as stream:
                catalogue = read_po(stream)
            catalogue.creation_date = date
            compiled = BytesIO()
            write_mo(compiled, catalogue)
            target = source.with_suffix(".mo")
            # an identical file is kept: another build of the same tree may be reading it
            if not target.is_file() or target.read_bytes() != compiled.getvalue():
                target.write_bytes(compiled.getvalue())
            # the package reads the compiled catalogue only where it is newer than its source
            target.touch()
