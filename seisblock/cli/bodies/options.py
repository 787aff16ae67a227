"""Options that describe one rigid block, shared by several commands."""

from __future__ import annotations

from typing import Any

from seisblock.bodies.kinds import KINDS
from seisblock.cli import shell_completion
from seisblock.cli.command import Decorator, add_options, option
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import INSET, LENGTH, LENGTHS, MASS, OutputFile

DEFAULT_TWO_LAYER = "chozusha"
"""Bundled two-layer block of commands without a block or sizes."""


def inset_option(text: str, *, section: str = "Body") -> Decorator:
    """Return ``--inset`` with the given help text."""
    return option("--inset", type=INSET, metavar="SHARE|M", section=section, help=text)


def bodies_option(text: str, *, required: bool = True) -> Decorator:
    """Return ``--bodies`` with the given help text: tables, files and names of bodies."""
    complete = shell_completion.complete_bodies()
    return option("--bodies", multiple=True, required=required, metavar="FILE|NAME", shell_complete=complete, section="Body", help=text)


def cemetery_option(text: str, **attributes: Any) -> Decorator:
    """Return ``--cemetery`` with the given help text."""
    complete = shell_completion.complete_bundled("cemetery")
    return option("--cemetery", metavar="FILE|NAME", shell_complete=complete, section="Body", help=text, **attributes)


def block_option(text: str, *kinds: str, name: str = "block") -> Decorator:
    """Return ``--block`` with the given help text: a file or a bundled body of the given kinds (default: all)."""
    complete = shell_completion.complete_bodies(*kinds)
    return option("--block", "--body", name, metavar="NAME|FILE", shell_complete=complete, section="Body", help=text)


stones_option = option(
    "--stones",
    type=OutputFile("CSV"),
    metavar="FILE.csv",
    section="Output",
    help="Write the result of each stone: threshold, probability, computed and observed overturning (CSV that Excel opens).",
)
"""Option ``--stones`` of surveys, the file of their stones."""

_SIZES = (
    option("--width", type=LENGTH, section="Body", help="Width B along the motion, m or with a unit (24cm, 8sun)."),
    option("--height", type=LENGTH, section="Body", help="Height H, m or with a unit."),
)

_SIZE_LISTS = (
    option("--width", type=LENGTHS, section="Body", help="Width B along the motion, m or with a unit (24cm, 8sun); number, list or range."),
    option(
        "--height",
        type=LENGTHS,
        section="Body",
        help="Height H, m or with a unit; number, list or range. Lists of --width, --height and --mu are combined.",
    ),
)

_OPTIONAL_SIZES = (
    option(
        "--depth",
        type=LENGTH,
        section="Body",
        help="Width across the motion, m or with a unit; affects mass and azimuths only.",
    ),
    option("--mass", type=MASS, section="Body", help="Mass, kg or with a unit; affects the motion only with --inertia."),
    option("--centroid-height", type=LENGTH, section="Body", help="Height of the centre of gravity, m. [default: half the height]"),
    option(
        "--centroid-offset",
        type=LENGTH,
        section="Body",
        help="Offset of the centre of gravity to +x from the middle of the base, m. [default: 0]",
    ),
    option(
        "--inertia",
        "centroid_inertia",
        type=float,
        metavar="KG.M2",
        section="Body",
        help="Moment of inertia about the centre of gravity, kg m^2. [default: m (B^2 + H^2)/12]",
    ),
    inset_option(
        "Inset of worn edges from each side: share of the width (0.1, 10%), or m with a unit (1cm). [default: value of the body, "
        "0.05 for gravestones, else 0]"
    ),
    option(
        "--kind",
        type=SuggestingChoice(KINDS),
        section="Body",
        help="Kind of a body given by its sizes; gravestones have edges worn by 0 to 0.1 of the width, others sharp ones. [default: block]",
    ),
    block_option("Bundled body (gravestone) or TOML file, instead of sizes."),
    option(
        "--side",
        type=SuggestingChoice(["short", "long"]),
        section="Body",
        help="Side of a two-layer --block along the motion. [default: short]",
    ),
)


def side_option(text: str) -> Decorator:
    """Return ``--side`` for a two-layer block, default short."""
    return option("--side", type=SuggestingChoice(["short", "long"]), default="short", show_default=True, section="Body", help=text)


block_options = add_options(*_SIZES, *_OPTIONAL_SIZES)
"""Options of one rigid block, for ``choose_block``."""

block_list_options = add_options(*_SIZE_LISTS, *_OPTIONAL_SIZES)
"""The same with lists of width and height."""


azimuth_option = option(
    "--azimuth",
    multiple=True,
    metavar="DEG[,DEG...]",
    section="Record",
    help="Azimuth of +x, degrees clockwise from north; same as --component DEG.",
)
"""Option ``--azimuth``."""
