"""``seisblock samples``: list or copy of the bundled files."""

from __future__ import annotations

from pathlib import Path

import click

from seisblock.cli import shell_completion
from seisblock.cli.command import Command, argument, option
from seisblock.cli.console import info, print_result, print_tables
from seisblock.cli.verbosity import quiet_output


@click.command(cls=Command, examples=("seisblock samples", "seisblock samples --copy synthetic_knet"))
@argument(
    "name", nargs=-1, metavar="[NAME]...", shell_complete=shell_completion.complete_samples, help="Names of bundled files. [default: all]"
)
@option(
    "--copy",
    "target",
    metavar="DIR|NAME",
    section="Output",
    help="Folder to copy to; a sample's name copies that sample to the current folder.",
)
@option("--overwrite", is_flag=True, section="Output", help="Replace existing files of other content.")
@option("--json", "as_json", is_flag=True, section="Output", help="Print one JSON document on stdout, SI units.")
@option("--quiet", is_flag=True, section="Output", help="Print only errors on stderr.")
def samples(name: tuple[str, ...], target: str | None, overwrite: bool, as_json: bool, quiet: bool) -> None:
    """List of the bundled records, bodies and cemeteries with licence and origin, or copies of them.

    NAME is a file name, or its beginning up to the first dot. All commands accept the name of a sample in place of a file.
    """
    from seisblock.report.text import samples as text_output

    directory = None
    if target is not None:
        directory, name = _destination(target, name)
    selection = text_output.select_samples(name)
    with quiet_output(quiet):
        if directory is not None:
            paths = text_output.copy_samples(selection, directory, overwrite=overwrite)
            for path in paths:
                info("wrote {path}", path=path)
            if not paths:
                info("{directory} already contains these files", directory=directory)
    if as_json:
        from seisblock.output.json.encode import to_json
        from seisblock.report.json.citations import samples_document

        print_result(to_json(samples_document(selection, directory)))
    elif directory is None:
        print_tables(text_output.sample_lines(selection))


def _destination(target: str, names: tuple[str, ...]) -> tuple[Path, tuple[str, ...]]:
    """Return folder and names; a sample's name means the current folder, unless a folder has that name."""
    from seisblock.samples import find_sample

    if not names and not Path(target).is_dir() and find_sample(target) is not None:
        return Path(), (target,)
    return Path(target), names
