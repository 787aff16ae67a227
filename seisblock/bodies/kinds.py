"""Kinds of bodies and the default edge wear of each."""

from __future__ import annotations

from dataclasses import replace

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import DEFAULT_WEAR, WORN_RANGE
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.errors import BodyError
from seisblock.core.io.csv_table import normalize_heading

GRAVESTONE = "gravestone"

KINDS = (GRAVESTONE, "furniture", "statue", "block")
"""Kinds of a body given by its sizes.

The edge wear of gravestones has a prior that agrees with surveys (:data:`~seisblock.bodies.edge_wear.WORN_RANGE`). All other kinds are
sharp: JMA's table of furniture agrees with sharp furniture, no survey reports worn bases of statues, and a bare block has its given
sizes.
"""

_SPELLINGS = {
    GRAVESTONE: ("墓石",),
    "furniture": ("家具", "什器"),
    "statue": ("像", "立像", "座像", "坐像", "仏像", "石像", "彫像", "彫刻", "sculpture"),
    "bookcase": ("書棚", "本棚", "書架", "bookshelf"),
    "boulder": ("自然石",),
    "chozusha": ("手水舎",),
    "column": ("石柱",),
    "display_case": ("展示ケース", "陳列ケース", "showcase"),
    "filing_cabinet": ("ファイリングキャビネット",),
    "lantern": ("石灯籠", "灯籠", "石燈籠", "燈籠"),
    "lateral_filing_cabinet": ("横型キャビネット",),
    "refrigerator": ("冷蔵庫", "fridge"),
    "server_rack": ("サーバーラック", "サーバラック"),
    "wagata": ("和型墓石",),
}
"""Other words for a kind or a bundled body in a table."""

_NAMES = {normalize_heading(word): name for name, words in _SPELLINGS.items() for word in (name, *words)}


def normalize_kind(text: str) -> str:
    """Return the kind or bundled body that a word of a table stands for; the word itself if it is unknown.

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> normalize_kind("家具"), normalize_kind("Display case"), normalize_kind("vase")
    ('furniture', 'display_case', 'vase')
    """
    return _NAMES.get(normalize_heading(text), text)


def kind_to_toml(kind: str, width: float, height: float) -> str:
    """Return the file of a body of a kind, with the prior of its unmeasured edges: edit it to replace the prior.

    Read back unedited it gives the same numbers to the last bit.

    Parameters
    ----------
    kind : str
        One of :data:`KINDS`.
    width, height : float, m

    Examples
    --------
    >>> print(kind_to_toml("gravestone", 0.24, 0.72))
    kind = "block"
    name = "gravestone"
    width = 0.24  # m
    height = 0.72  # m
    inset = "5%"
    <BLANKLINE>
    [ranges]
    inset = ["0%", "10%"]
    <BLANKLINE>
    """
    block = of_kind(Block(width, height), kind)
    lines = ['kind = "block"', f'name = "{kind}"', f"width = {width!r}  # m", f"height = {height!r}  # m"]
    if block.ranges is not None and block.ranges.inset_m is not None:
        low, high = (f'"{100.0 * inset / width:.10g}%"' for inset in block.ranges.inset_m)
        lines += [f'inset = "{100.0 * block.inset / width:.10g}%"', "", "[ranges]", f"inset = [{low}, {high}]"]
    return "\n".join([*lines, ""])


def of_kind(block: Block, kind: str) -> Block:
    """Return a block with the edge wear of its kind: median and range of the prior.

    Parameters
    ----------
    block : Block
        Block given by its sizes, with sharp edges.
    kind : str
        One of :data:`KINDS`.

    Raises
    ------
    BodyError
        If the kind is unknown.

    Examples
    --------
    >>> stone = of_kind(Block(0.24, 0.72), "gravestone")
    >>> stone.inset, stone.ranges.inset_m
    (0.012, (0.0, 0.024))
    """
    from seisblock.bodies.block_array import wear_within  # imports numpy, which --help does not need

    if kind not in KINDS:
        raise BodyError("unknown kind of body {kind!r}; known: {known}", kind=str(kind)[:100], known=list(KINDS))
    if kind != GRAVESTONE:
        return block
    median = wear_within(block, DEFAULT_WEAR.share)
    low, high = (min(share, 2.0 * median) * block.width for share in WORN_RANGE)
    return replace(block.with_wear(median), ranges=ParameterRanges(inset_m=(low, high)))
