"""Blocks from sizes, TOML files and bundled bodies; faults are named in one sentence."""

import math

import pytest

from seisblock.bodies.block import Block, scale_block
from seisblock.bodies.factory import block_from_table, load_block
from seisblock.bodies.pile.toml import load_pile
from seisblock.cli.bodies.block import choose_block
from seisblock.core.errors import BodyError, InputError
from seisblock.output.json.bodies import block_entry


def test_bundled_gravestone_has_shaking_table_size():
    """8 sun wide, H/B 2.6, as on the shaking table of [Furukawa2009]_."""
    block = load_block("gravestone")
    assert block.width == pytest.approx(0.2424)
    assert block.height / block.width == pytest.approx(2.6)
    assert block.total_mass == pytest.approx(2650 * 0.2424**2 * 0.2424 * 2.6)


@pytest.mark.parametrize(
    ("name", "inches"), [("bookcase", (12.625, 71.0)), ("filing_cabinet", (15.0, 52.0)), ("lateral_filing_cabinet", (18.6, 52.5))]
)
def test_bundled_furniture_has_fema_p_58_sizes(name, inches):
    """Components E.20.22.105a, 114a and 124a, as their descriptions print them."""
    block = load_block(name)
    assert (block.width, block.height) == pytest.approx([0.0254 * size for size in inches])


@pytest.mark.parametrize("name", ["server_rack", "refrigerator", "display_case"])
def test_bundled_bodies_on_feet_pivot_at_feet(name):
    """Their feet stand within their sides, which makes them slenderer than their drawing."""
    block = load_block(name)
    assert 0.0 < block.inset < 0.1 * block.width
    assert 2.5 < block.height / (block.width - 2.0 * block.inset) < 5.0


def test_bundled_statue_is_pile_of_two_stones():
    """Two stones, one on the other, which other commands take as one block."""
    pile = load_pile("statue")
    assert [stone.name for stone in pile.stones] == ["pedestal", "figure"]
    assert load_block("statue").height == pytest.approx(1.9)


@pytest.mark.parametrize("side", ["short", "long"])
def test_two_layer_body_keeps_mass_centre_and_inertia(side):
    """I_O of the Chozu-sha as printed in [Sugimoto2017]_: 9736.24 and 10674.76 kg m^2."""
    block = load_block("chozusha", side=side)
    assert block.total_mass == pytest.approx(1463.7)
    assert block.corner_inertias[0] == pytest.approx({"short": 9736.24, "long": 10674.76}[side], abs=5e-3)


def test_toml_body_accepts_units_and_all_entries(tmp_path):
    """Sizes with units, mass, centre, offset, inertia and a name."""
    path = tmp_path / "statue.toml"
    path.write_text(
        'kind = "block"\nname = "statue"\nwidth = "40cm"\nheight = 1.6\ndepth = "1shaku"\nmass = "0.3t"\n'
        'centroid_height = "700mm"\ncentroid_offset = "-2cm"\ncentroid_inertia = 60\n'
    )
    block = load_block(path)
    assert block == Block(0.4, 1.6, 0.303, 300.0, centroid_height=0.7, centroid_offset=-0.02, centroid_inertia=60.0, name="statue")
    text = block_entry(block)
    assert text.mass_kg == 300.0
    assert text.slenderness_right_rad == pytest.approx(math.atan(0.22 / 0.7))


@pytest.mark.parametrize(
    ("table", "says"),
    [
        ({}, "kind must be"),
        ({"kind": "vase", "width": 1, "height": 1}, "kind must be"),
        ({"kind": "block", "height": 1}, "width is missing"),
        ({"kind": "block", "width": "wide", "height": 1}, "width"),
        ({"kind": "block", "width": 1, "height": -1}, "height must be positive"),
        ({"kind": "block", "width": 1, "height": 1, "colour": "grey"}, "unknown entries colour"),
        ({"kind": "block", "width": 1, "height": 1, "density": "heavy"}, "density must be a number"),
        ({"kind": "block", "width": 1, "height": 1, "centroid_inertia": True}, "centroid_inertia must be a number"),
    ],
)
def test_toml_body_rejects_invalid_tables(table, says):
    """One sentence each."""
    with pytest.raises(InputError, match=says):
        block_from_table(table)


def test_restitution_of_a_file_is_the_default_of_an_option(tmp_path):
    """A file may bring its restitution; the option overrides it; nonsense is refused."""
    path = tmp_path / "b.toml"
    path.write_text('kind = "block"\nwidth = 0.2\nheight = 1.0\nrestitution = 0.8\n')
    assert choose_block({"block": str(path)}).restitution == 0.8
    assert choose_block({"block": str(path), "restitution": 0.6}).restitution == 0.6
    path.write_text('kind = "block"\nwidth = 0.2\nheight = 1.0\nrestitution = "most"\n')
    with pytest.raises(BodyError, match="restitution must be a number"):
        choose_block({"block": str(path)})


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({}, "--width, --height missing"),
        ({"width": 0.2}, "--height missing"),
        ({"block": "gravestone", "mass": 3.0}, "exclude each other"),
        ({"block": "obelisk"}, "no body file obelisk"),
    ],
)
def test_body_options_report_missing_values(values, says):
    """The message names the missing entry."""
    with pytest.raises(BodyError, match=says):
        choose_block(values)


def test_resized_block_keeps_given_mass():
    """A mass that was given stays; its inertia scales with the square of the size."""
    block = scale_block(Block(0.4, 1.0, mass=100.0, centroid_inertia=9.0), size=2.0)
    assert (block.total_mass, block.centroid_inertia) == (100.0, 36.0)


@pytest.mark.parametrize("depth", [None, 0.3])
def test_resized_block_scales_radius_of_gyration(depth):
    """The radius of gyration doubles with the size where the mass follows from the volume (N6)."""
    block = Block(0.4, 1.0, depth, centroid_inertia=30.0)
    for slenderness in (1.0, 1.1):
        twice = scale_block(block, size=2.0, slenderness=slenderness)
        assert twice.gyration_squared == pytest.approx(4.0 * block.gyration_squared, rel=1e-12)
        assert twice.frequency_parameter(9.8) == pytest.approx(
            Block(0.8 * slenderness, 2.0, mass=1.0, centroid_inertia=4.0 * block.gyration_squared).frequency_parameter(9.8), rel=1e-12
        )
