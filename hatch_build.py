"""Build hooks: entry points of the formats as plug-ins of ObsPy, compiled translation catalogues."""

import ast
from collections.abc import Iterator
from datetime import UTC, datetime
from io import BytesIO
from pathlib import Path
from typing import Any

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.builders.utils import get_reproducible_timestamp
from hatchling.metadata.plugin.interface import MetadataHookInterface

PLUGIN_GROUP = "obspy.plugin.waveform"


class Plugins(MetadataHookInterface):
    """Declare an ObsPy plug-in for each file in ``seisblock/readers/formats`` that does not register ``plugin=False``."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Add the entry points; the files are parsed, not imported, as a build has no dependencies."""
        module = "seisblock.readers.obspy_plugins"
        stems = list(self._plugin_stems())
        entry_points = {PLUGIN_GROUP: {stem.replace("_", "").upper(): module for stem in stems}}
        for stem in stems:
            functions = {"isFormat": f"{module}:is_{stem}", "readFormat": f"{module}:read_{stem}"}
            entry_points[f"{PLUGIN_GROUP}.{stem.replace('_', '').upper()}"] = functions
        metadata["entry-points"] = entry_points

    def _plugin_stems(self) -> Iterator[str]:
        for file in sorted(Path(self.root, "seisblock", "readers", "formats").glob("[!_]*.py")):
            keywords = [word for node in ast.walk(ast.parse(file.read_bytes())) if isinstance(node, ast.Call) for word in node.keywords]
            if not any(word.arg == "plugin" and isinstance(word.value, ast.Constant) and word.value.value is False for word in keywords):
                yield file.stem


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
