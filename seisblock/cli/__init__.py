"""Command-line entry point: a click group with lazily imported commands.

``main`` is a click group that imports the module of a command on use, so that ``seisblock --help`` starts fast. Only the group catches
:class:`SeisblockError`.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys
from collections.abc import Sequence
from typing import Any

import click
from click.shell_completion import CompletionItem

from seisblock import __version__
from seisblock.cli.command import docstring, english_help_option, lang_option
from seisblock.cli.console import kernel_messages, reset_warnings, with_option_names
from seisblock.cli.help import Context, help_rows
from seisblock.cli.locale import use_cli_locale
from seisblock.cli.process import TERMINATED, Terminated, discard_stdout, fast_exit, graceful_exit, safe_streams
from seisblock.cli.progress import progress
from seisblock.cli.suggest import add_suggestion, closest_name, did_you_mean, suggest_options
from seisblock.cli.verbosity import quiet_output
from seisblock.core.errors import OutputError, SeisblockError, os_error_text
from seisblock.core.i18n import N_, escape_control, gettext, lazy_gettext, truncate
from seisblock.core.io.overwrite import track_files
from seisblock.core.registry import solver_names

GROUPS: dict[str, dict[str, str]] = {
    N_("Answers"): {
        "respond": N_("Full response: rest, sliding, rocking, flight, overturning."),
        "scenario": N_("Objects that fall or move in a scenario: JMA intensity, PGA and PGV, or records."),
        "secure": N_("Width, height, ballast, friction or restraint that makes an object safe."),
        "report": N_("HTML report of a record and the response of bodies."),
        "app": N_("Local page in the browser: objects, surveys, collections, maps of stations."),
    },
    N_("Models"): {
        "slide": N_("Sliding on a level or sloping base, with Coulomb friction."),
        "rock": N_("Rocking and overturning of one block, with margins."),
        "jump": N_("Rocking, impact and jump of a two-layer block."),
        "uplift": N_("Uplift of a block on corner springs: records and harmonic motion."),
        "rigid3d": N_("One block or scan in three dimensions, with twist and direction of fall."),
        "stack": N_("Pile of stones in three dimensions: gravestones, lanterns, columns."),
    },
    N_("Records"): {
        "measure": N_("Intensity measures of a record: peaks, frequencies, durations, JMA intensity."),
        "fetch": N_("Records of an earthquake or a station from FDSN data centers."),
        "samples": N_("Bundled records and bodies: list or copy."),
    },
    N_("Surveys"): {
        "overturn-rate": N_("Overturning rate of the gravestones of a cemetery."),
        "infer": N_("Ground motion estimated from fallen gravestones or displaced objects."),
        "map": N_("Map of an earthquake's stations with the response of a body or a cemetery."),
        "fit": N_("Block parameters from observed overturning, with cross-validation."),
        "body": N_("Rigid-body properties of a 3-D scan: mass, inertia, base, slenderness."),
    },
    N_("Risk"): {
        "fragility": N_("Fragility curves: overturning, sliding or rocking against intensity."),
        "risk": N_("Annual frequency at a site: fragility and seismic hazard."),
        "batch": N_("Table of many records and many bodies, on all cores or a cluster."),
        "spectrum": N_("Rocking and overturning spectra over size and slenderness."),
    },
    N_("Evidence"): {
        "criteria": N_("Closed-form overturning criteria compared with the simulated outcome."),
        "paper": N_("Figures and tables of the papers, on their data or your own."),
        "validate": N_("Numbers printed in the papers compared with the computed ones."),
        "cite": N_("References of a command, as text or BibTeX."),
    },
    N_("Tools"): {
        "schema": N_("JSON Schema of a command's JSON document."),
        "completion": N_("Shell completion for bash, zsh and fish."),
    },
}
"""Commands by purpose with a one-line help. Kept here so that ``--help`` imports no command."""

MODELS = "Models"
"""Group of the solvers that are registered without a line here."""


def _command_groups() -> dict[str, dict[str, str]]:
    """Return the commands by purpose, with every registered solver."""
    listed = {name for commands in GROUPS.values() for name in commands}
    others = {name: _solver_summary(name) for name in solver_names() if name not in listed}
    return {group: {**commands, **(others if group == MODELS else {})} for group, commands in GROUPS.items()}


def _solver_summary(name: str) -> str:
    """Return the first line of the docstring of a solver's package."""
    return (docstring(importlib.import_module(f"seisblock.models.{name}")) or "").partition("\n")[0]


COMMAND_GROUPS = _command_groups()
COMMANDS = {name: text for commands in COMMAND_GROUPS.values() for name, text in commands.items()}
"""One-line help by command."""

EXAMPLES = ("seisblock respond --block gravestone", "seisblock jump", "seisblock slide record.csv --mu 0.2 --plot slide.png")
"""Example lines at the end of the help."""

COMPLETION_VARIABLE = "_SEISBLOCK_COMPLETE"
"""Environment variable that a shell sets to request completions."""

INTERRUPTED = 130
BROKEN_PIPE = 141


def _report_interrupt() -> None:
    click.echo(f"\nseisblock: {gettext('interrupted; no partially written file remains')}", err=True)


class SeisblockGroup(click.Group):
    """Click group that imports commands lazily and maps errors to a message and an exit code."""

    context_class = Context

    def get_help_option(self, ctx: click.Context) -> click.Option | None:
        """Return ``--help``, see :func:`english_help_option`."""
        return english_help_option(super().get_help_option(ctx))

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options, then the commands."""
        with formatter.section(gettext("Options")):
            formatter.write_dl([row for _, row in help_rows(self.get_params(ctx), ctx)])
        self.format_commands(ctx, formatter)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the command names in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import the module of a command and return the command."""
        if cmd_name not in COMMANDS:
            return None
        module = cmd_name.replace("-", "_")
        if importlib.util.find_spec(f"seisblock.cli.{module}") is None:
            from seisblock.cli.solver_command import solver_command

            return solver_command(cmd_name)
        command: click.Command = getattr(importlib.import_module(f"seisblock.cli.{module}"), module)
        return command

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the arguments; unknown options get a suggestion."""
        with suggest_options(self, ctx):
            return super().parse_args(ctx, args)

    def resolve_command(self, ctx: click.Context, args: list[str]) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command of a line; an unknown name gets a suggestion."""
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            raise click.UsageError(did_you_mean(error.message, closest_name(args[0], COMMANDS)), ctx) from None

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Complete command names without importing the commands."""
        names = [CompletionItem(name, help=gettext(text)) for name, text in COMMANDS.items() if name.startswith(incomplete)]
        return [*names, *click.Command.shell_complete(self, ctx, incomplete)]

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list of commands without importing them."""
        for group, commands in COMMAND_GROUPS.items():
            with formatter.section(gettext(group)):
                formatter.write_dl([(name, gettext(text)) for name, text in commands.items()], col_max=16)
        with formatter.section(gettext("Examples")):
            for line in EXAMPLES:
                formatter.write(f"  {line}\n")

    def main(self, args: Sequence[str] | None = None, prog_name: str | None = None, **extra: Any) -> Any:  # type: ignore[override]
        """Run the command; user errors become a message on stderr and an exit code."""
        # the largest matrix has twelve rows: BLAS threads would only add synchronization cost
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        if os.environ.get("NO_COLOR"):
            extra.setdefault("color", False)
        if os.environ.get(COMPLETION_VARIABLE):
            importlib.import_module("seisblock.cli.completion")
        line = sys.argv[1:] if args is None else list(args)
        with safe_streams(), use_cli_locale(line):
            try:
                return super().main(line, prog_name or "seisblock", obj=line, **extra)
            except SystemExit as end:
                if args is None and end.code in (INTERRUPTED, TERMINATED):
                    fast_exit(end.code)
                raise

    def make_context(self, *args: Any, **extra: Any) -> click.Context:
        """Parse the arguments; an interrupt during parsing exits as one during the run (click would print "Aborted!")."""
        try:
            return super().make_context(*args, **extra)
        except KeyboardInterrupt:
            _report_interrupt()
            raise click.exceptions.Exit(INTERRUPTED) from None

    def invoke(self, ctx: click.Context) -> Any:
        """Invoke the command and report user errors."""
        reset_warnings()
        quiet = quiet_output("--quiet" in ctx.obj or None)
        try:
            with graceful_exit(), track_files(sys.stdout), quiet, progress("working"), kernel_messages():
                result = super().invoke(ctx)
                sys.stdout.flush()
                return result
        except SeisblockError as error:
            command = main.get_command(ctx, ctx.invoked_subcommand) if ctx.invoked_subcommand else None
            text = add_suggestion(with_option_names(gettext(error.message), command), error.message)
            click.secho(f"seisblock: {truncate(escape_control(text))}", fg="red", err=True)
            ctx.exit(error.exit_code)
        except KeyboardInterrupt:
            _report_interrupt()
            ctx.exit(INTERRUPTED)
        except BrokenPipeError:
            # the reader closed the pipe (| head): no message, and no flush at exit
            discard_stdout()
            ctx.exit(BROKEN_PIPE)
        except Terminated:
            ctx.exit(TERMINATED)
        except MemoryError:
            text = gettext("not enough memory: shorten the record with --window, or reduce the number of samples, levels or bodies")
            click.secho(f"seisblock: {text}", fg="red", err=True)
            ctx.exit(SeisblockError.exit_code)
        except OSError as error:
            discard_stdout()
            write_error = gettext(
                "cannot write {file}: {error}", file=error.filename or lazy_gettext("the results"), error=os_error_text(error)
            )
            click.secho(f"seisblock: {write_error}", fg="red", err=True)
            ctx.exit(OutputError.exit_code)


@click.group(cls=SeisblockGroup, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(__version__, prog_name="seisblock", help=N_("Show the version and exit."))
def main() -> None:
    """Seismic response of unanchored objects: sliding, rocking, overturning.

    RECORD is a strong-motion file in a format that --format lists (K-NET and KiK-net: one file of the set, or the downloaded
    archive), a table, or a file in any format that ObsPy reads. Default: a bundled sample record.
    """


if main.help is None and main.callback is not None:
    main.help = docstring(main.callback)
main.params.append(lang_option())

__all__ = ["COMMANDS", "main"]
