"""What the wheel holds and the tree does not: the compiled catalogues of translations."""

from pathlib import Path
from typing import Any

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class Catalogues(BuildHookInterface):
    """Compiles every catalogue beside its source, for a wheel and for an editable installation alike."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile before the files are gathered."""
        for written in sorted(Path(self.root, "seisblock", "locale").rglob("*.po")):
            with written.open("rb") as source, written.with_suffix(".mo").open("wb") as target:
                write_mo(target, read_po(source))
