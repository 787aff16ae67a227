"""JSON entries of the bodies."""

from __future__ import annotations

import math

from msgspec import Struct

from seisblock.bodies.block import Block
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.output.json.schema import fill


class BlockEntry(Struct, frozen=True, kw_only=True):
    """One rigid block.

    Parameters
    ----------
    name : str
    width_m, height_m, depth_m : float
    mass_kg : float
    centroid_height_m, centroid_offset_m : float
        Of the centre of gravity, above the base and towards +x from its middle.
    inset_m : float
        Inset of the rotation edges from each side.
    centroid_inertia_kg_m2 : float
        About the centre of gravity.
    slenderness_right_rad, slenderness_left_rad : float
        alpha of the corner at +x and at -x.
    stone_count : int
        Number of stones that it represents as one rigid block.
    """

    name: str
    width_m: float
    height_m: float
    depth_m: float
    mass_kg: float
    centroid_height_m: float
    centroid_offset_m: float
    inset_m: float
    centroid_inertia_kg_m2: float
    slenderness_right_rad: float
    slenderness_left_rad: float
    stone_count: int


def block_entry(block: Block) -> BlockEntry:
    """Return the entry of a block."""
    right, left = block.slendernesses
    return fill(
        BlockEntry,
        block,
        depth_m=block.width if block.depth is None else block.depth,
        mass_kg=block.total_mass,
        centroid_height_m=block.centre,
        centroid_inertia_kg_m2=block.gyration_squared * block.total_mass,
        slenderness_right_rad=right,
        slenderness_left_rad=left,
    )


class TwoLayerEntry(Struct, frozen=True, kw_only=True):
    """Two layers of one width, rigidly joined.

    Parameters
    ----------
    name : str
    width_m, depth_m : float
        Along the motion and across it.
    upper_height_m, lower_height_m : float
    upper_mass_kg, lower_mass_kg : float
    centroid_height_m : float
    """

    name: str
    width_m: float
    depth_m: float
    upper_height_m: float
    lower_height_m: float
    upper_mass_kg: float
    lower_mass_kg: float
    centroid_height_m: float


def two_layer_entry(block: TwoLayerBlock) -> TwoLayerEntry:
    """Return the entry of a two-layer block."""
    return fill(TwoLayerEntry, block)


class SpringBlockEntry(Struct, frozen=True, kw_only=True):
    """A block on four corner springs.

    Parameters
    ----------
    width_m, depth_m, height_m : float
        a, b and H.
    mass_kg : float
    stiffness_n_m : dict
        Of each corner along x, y and z.
    damping : float
        Damping ratio.
    alpha, gamma, beta : float
        H/b, a/b, and horizontal over vertical frequency.
    frequency_vertical_hz : float
    """

    width_m: float
    depth_m: float
    height_m: float
    mass_kg: float
    stiffness_n_m: dict[str, float]
    damping: float
    alpha: float
    gamma: float
    beta: float
    frequency_vertical_hz: float


def spring_block_entry(body: SpringBlock) -> SpringBlockEntry:
    """Return the entry of a block on corner springs."""
    stiffness = dict(zip("xyz", body.stiffness, strict=True))
    return fill(SpringBlockEntry, body, stiffness_n_m=stiffness, frequency_vertical_hz=body.omega[2] / (2.0 * math.pi))


class StoneEntry(Struct, frozen=True, kw_only=True):
    """One stone of a pile.

    Parameters
    ----------
    name, on : str
        Name, and name of the supporting stone or ground.
    width_m, depth_m, height_m : float
        Along x, y and z.
    offset_m : two floats
        From the centre of the support, along x and y.
    density_kg_m3 : float
    mu, mu_kinetic : float or None
        Static and kinetic friction of the joint below; null: those of the pile.
    bottom_m : float or None
        Height of its lower face above the ground; null: upper face of the support.
    shape : str
        In plan: rectangular or round.
    inset_m : two floats
        Inset of the rotation edges from the sides of the base, along x and y.
    """

    name: str
    on: str
    width_m: float
    depth_m: float
    height_m: float
    offset_m: tuple[float, float]
    density_kg_m3: float
    mu: float | None
    mu_kinetic: float | None
    bottom_m: float | None
    shape: str
    inset_m: tuple[float, float]


class PileEntry(Struct, frozen=True, kw_only=True):
    """A pile of stones.

    Parameters
    ----------
    name : str
    mu, mu_kinetic : float
        Static and kinetic friction of its joints.
    stones : list of StoneEntry
        From bottom to top.
    dowels : list of lists of str
        Stones connected by dowels.
    fixed : list of str
        Stones that move with the ground.
    """

    name: str
    mu: float
    mu_kinetic: float
    stones: tuple[StoneEntry, ...]
    dowels: tuple[tuple[str, ...], ...]
    fixed: tuple[str, ...]


def pile_entry(pile: Pile) -> PileEntry:
    """Return the entry of a pile."""
    stones = tuple(fill(StoneEntry, stone, inset_m=stone.insets()) for stone in pile.stones)
    return fill(PileEntry, pile, mu_kinetic=pile.friction()[1], stones=stones)


class PileContactEntry(Struct, frozen=True, kw_only=True):
    """Spring, dashpot and slider at each contact point of a pile.

    Parameters
    ----------
    normal_per_s2, shear_per_s2 : float
        Stiffness per point over the upper stone's mass.
    normal_damping_per_s, shear_damping_per_s : float
        Dashpots per point over the upper stone's mass.
    young_pa, stiffness_n_m3 : float or None
        Young's modulus, or the joints' stiffness per area, that replace the four above.
    damping_ratio, shear_ratio : float
        Damping ratio of a stone on its joint, and shear over normal stiffness, for these two.
    """

    normal_per_s2: float
    shear_per_s2: float
    normal_damping_per_s: float
    shear_damping_per_s: float
    young_pa: float | None
    stiffness_n_m3: float | None
    damping_ratio: float
    shear_ratio: float


def pile_contact_entry(contact: PileContact) -> PileContactEntry:
    """Return the entry of the spring contact of a pile."""
    return fill(PileContactEntry, contact)
