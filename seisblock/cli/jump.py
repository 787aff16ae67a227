"""``seisblock jump``: jump of a two-layer block."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from itertools import chain
from typing import TYPE_CHECKING, Any

import click

from seisblock.bodies.body_name import body_name
from seisblock.bodies.two_layer import Contact
from seisblock.cli.bodies.options import DEFAULT_TWO_LAYER, block_option
from seisblock.cli.build import solver_options
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.load_records import iter_motions
from seisblock.cli.option_checks import given_flags, reject_with, reject_without
from seisblock.cli.options import Source, check_callback, output_options, record_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.types import FLOATS, LENGTH, LENGTHS, MASSES, SIDES
from seisblock.cli.write_results import write_results
from seisblock.core import checks
from seisblock.core.errors import OutputError
from seisblock.core.i18n import gettext
from seisblock.models.jump.options import JumpOptions

if TYPE_CHECKING:
    from seisblock.cli.bodies.two_layer import TwoLayerChoice


@click.command(
    cls=Command,
    essential=("--block", "--width", "--heights", "--masses", "--mu", "--drop", "--landing", "--tenon", "--window"),
    examples=("seisblock jump", "seisblock jump record.csv --component EW --drop 0.3 --tenon 2cm --plot jump.png"),
)
@record_options
@block_option(f"Bundled body or TOML file. [default: {DEFAULT_TWO_LAYER}]", "two-layer")
@option(
    "--side",
    type=SIDES,
    metavar="short|long|short,long",
    default="short",
    show_default=True,
    section="Body",
    help="Side of the block in plan along the motion, or both as a list; lists of --side, --drop and --restitution-y are combined.",
)
@option("--width", type=LENGTH, section="Body", help="Width B along the motion, m or with a unit; needs --heights and --masses.")
@option(
    "--depth",
    type=LENGTH,
    callback=check_callback(checks.positive),
    section="Body",
    help="Width across the motion, m; without effect on plane motion. [default: --width]",
)
@option("--heights", type=LENGTHS, metavar="H1,H2", section="Body", help="Heights of the upper and the lower layer, m or with units.")
@option("--masses", type=MASSES, metavar="M1,M2", section="Body", help="Masses of the upper and the lower layer, kg or with units.")
@solver_options(Contact, exclude=("restitution_y",))
@option(
    "--restitution-y",
    type=FLOATS,
    section="Body",
    help="Ratio of vertical velocities at the impact, 0 to 1; number, list or range. [default: value of the body, else 0.85]",
)
@option(
    "--drop",
    type=LENGTHS,
    section="Body",
    help="Height of the floor above the landing ground, m or with a unit; number, list or range. [default: value of the body, else 0]",
)
@solver_options(JumpOptions, exclude=("gravity", "drop"))
@option(
    "--as-printed",
    is_flag=True,
    help="Show also the result of the paper's scheme: --landing printed --spin tables --first, without tenons.",
)
@option("--repeat", is_flag=True, hidden=True, help="All chains of motion; the default since 0.2.0.")
@solver_options(JumpOptions, "gravity")
@output_options()
def jump(source: Source, output: OutputOptions, repeat: bool, as_printed: bool, **params: Any) -> None:
    """Rocking, impact, jump, landing and slide-rocking of a two-layer block (Sugimoto et al. 2017).

    Each horizontal component is solved separately, as a sequence of chains of motion; a motion under way at the end of the record
    continues on still ground. --window limits the start of rocking, not the ground motion. Tilt is positive towards the component's
    positive direction; displacements of the centroid are relative to the ground. The model of the paper has no vertical ground
    motion: the vertical component of the record does not act.
    """
    from seisblock.cli.hints import jump_hint
    from seisblock.models.jump import describe as text_output
    from seisblock.models.jump.solve import solve_jump
    from seisblock.report.json.jump import document

    if repeat and params["first"]:
        raise click.UsageError(gettext("--first and --repeat (the default) exclude each other: give only one of them"))
    if params["width"] is None:
        reject_without("--width", ["depth"])
    else:
        reject_with("--width", ["side"])
    if as_printed:
        reject_with("--as-printed", ["landing"])
    combinations = itertools.product(params["side"], params["drop"] or (None,), params["restitution_y"] or (None,))
    runs = [_Run.from_options(params, side, drop, restitution, source.window) for side, drop, restitution in combinations]
    if len(runs) > 1 and output.plot is not None:
        raise OutputError("--plot draws one side, drop and restitution: give one of each, or omit --plot")
    first = runs[0]
    info("body: {name}; {says}", name=body_name(first.choice.block.name), says=first.choice.description)
    motions = list(iter_motions(source, keep_whole=True))
    responses = [solve_jump(run.choice.block, motion, **run.options.keywords()) for run in runs for motion in motions]
    printed = [solve_jump(run.choice.block, motion, **run.printed(params).keywords()) for run in runs if as_printed for motion in motions]
    write_results(
        document(responses, printed=printed),
        output,
        responses=responses,
        tables=lambda: chain(
            text_output.tables(responses, gal=output.gal, printed=printed, combinations=len(runs)),
            jump_hint(source, {**params, "side": first.side}, first.choice.block, first.choice.contact, first.options.tenon),
        ),
    )


@dataclass(frozen=True)
class _Run:
    """One combination of side, drop and restitution: body and options of the solver."""

    side: str
    choice: TwoLayerChoice
    options: JumpOptions

    @classmethod
    def from_options(cls, params: dict[str, Any], side: str, drop: float | None, restitution: float | None, windows: Any) -> _Run:
        """Return the run of one combination; what is not given comes from the body."""
        from seisblock.cli.bodies.two_layer import two_layer_choice

        choice = two_layer_choice({**params, "side": side, "restitution_y": restitution})
        given_options = {"drop": drop, "tenon": params["tenon"] if _is_given("tenon") else None}
        base: dict[str, Any] = {**choice.base, **{key: value for key, value in given_options.items() if value is not None}}
        solver_options = {key: params[key] for key in ("spin", "direction", "landing", "first", "gravity")}
        return cls(side, choice, JumpOptions(contact=choice.contact, windows=windows, **base, **solver_options))

    def printed(self, params: dict[str, Any]) -> JumpOptions:
        """Return the options of the paper's own scheme."""
        spin = params["spin"] if _is_given("spin") else "tables"
        return replace(self.options, landing="printed", spin=spin, first=True, tenon=0.0)


def _is_given(name: str) -> bool:
    """Return True if the user gave an option."""
    return bool(given_flags([name]))
