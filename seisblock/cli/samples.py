"""``seisblock samples``: the bundled files, listed and copied."""

from __future__ import annotations

from pathlib import Path

import click

from seisblock.cli import offered
from seisblock.cli.command import Command, argument, option
from seisblock.cli.quiet import quietly
from seisblock.cli.talk import answer, say, show


@click.command(cls=Command, examples=("seisblock samples", "seisblock samples --copy synthetic_knet"))
@argument("name", nargs=-1, metavar="[NAME]...", shell_complete=offered.samples, help="Names of bundled files. [default: all]")
@option(
    "--copy",
    "target",
    metavar="DIR|NAME",
    section="Output",
    help="Copy to this directory; or, given a sample's name, copy that sample to the present directory.",
)
@option("--overwrite", is_flag=True, section="Output", help="Replace files of other content that are in the way.")
@option("--json", "as_json", is_flag=True, section="Output", help="One JSON document on stdout, SI units.")
@option("--quiet", is_flag=True, section="Output", help="Nothing on stderr but errors.")
def samples(name: tuple[str, ...], target: str | None, overwrite: bool, as_json: bool, quiet: bool) -> None:
    """List the bundled records, bodies and cemeteries, with their licence and origin, or copy them.

    NAME is a file name, or its beginning up to the first dot. Any command takes a sample's name in place of a file.
    """
    from seisblock.present.text import samples as shown

    directory = None
    if target is not None:
        directory, name = _destination(target, name)
    chosen = shown.chosen(name)
    with quietly(quiet):
        if directory is not None:
            written = shown.copy_samples(chosen, directory, overwrite=overwrite)
            for path in written:
                say("wrote {path}", path=path)
            if not written:
                say("{directory} holds them already", directory=directory)
    if as_json:
        from seisblock.present.documents.library import samples_document
        from seisblock.present.documents.write import to_json

        answer(to_json(samples_document(chosen, directory)))
    elif directory is None:
        show(shown.listing(chosen))


def _destination(target: str, names: tuple[str, ...]) -> tuple[Path, tuple[str, ...]]:
    """Return the directory and the names: a sample's name in place of a directory means here, unless a directory is called so."""
    from seisblock.samples import find_sample

    if not names and not Path(target).is_dir() and find_sample(target) is not None:
        return Path(), (target,)
    return Path(target), names
