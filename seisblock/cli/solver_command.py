"""Command of a registered solver without a module of its own, built from its registration."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

import click

from seisblock.bodies.block import Block
from seisblock.cli.bodies.options import block_options
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, docstring
from seisblock.cli.options import Source, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.core.errors import BodyError
from seisblock.core.registry import Solver, get_solver


def solver_command(name: str) -> click.Command:
    """Return the command of a solver: record, body, options and output.

    Raises
    ------
    ParameterError
        If there is no solver of that name.
    BodyError
        If the solver takes no block; it then needs a command of its own.
    """
    solver = get_solver(name)
    if Block not in solver.bodies:
        raise BodyError("{solver} does not accept a rigid block: write a separate command for it", solver=name)
    help_text = docstring(import_module(f"seisblock.models.{name}"))
    function: Callable[..., Any] = output_options()(_run(solver))
    for decorate in (solver_options(solver.options), block_options, record_options):
        function = decorate(function)
    command = click.command(name, cls=Command, help=help_text, examples=(f"seisblock {name} --width 24cm --height 72cm",))
    return command(function)


def _run(solver: Solver) -> Callable[..., None]:
    """Return the function that solves each record and direction."""
    names = list(solver.options.__dataclass_fields__)

    def run(source: Source, output: OutputOptions, **params: Any) -> None:
        from seisblock.cli.bodies.block import choose_block
        from seisblock.cli.console import info
        from seisblock.cli.load_records import iter_motions
        from seisblock.cli.write_results import write_results
        from seisblock.output.json.solver import document
        from seisblock.output.text.solver import tables

        options = solver.make_options({field: params.pop(field) for field in names if field in params})
        choice = choose_block({**params, "restitution": None, "gal": output.gal})
        info("body: {says}", says=choice.description)
        responses = [solver.solve(choice.block_for_motion(motion), motion, **options.keywords()) for motion in iter_motions(source)]
        write_results(document(responses), output, responses=responses, tables=lambda: tables(responses, gal=output.gal))

    return run
