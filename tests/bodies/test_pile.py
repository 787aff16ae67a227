"""A pile follows its file, and one that cannot stand is rejected in one sentence."""

import math
import re
from dataclasses import replace

import pytest

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.units import SUN

FOOT = PileStone("foot", 0.6, 0.6, 0.2)
HEAD = PileStone("head", 0.3, 0.3, 0.5, on="foot")


def pile(*stones, **extra):
    return Pile("pile", stones, **extra)


def test_bundled_wagata_has_sizes_of_paper():
    """The bundled gravestone has the sizes of table 1, H/B 2.6, and chudai 6 sun behind gedai's front edge."""
    wagata = load_pile("wagata")
    sizes = {stone.name: tuple(round(side / SUN, 9) for side in stone.size) for stone in wagata.stones}
    assert sizes == {"gedai": (28, 28, 5), "mizubachi": (16, 5, 9), "chudai": (20, 20, 10), "jodai": (14, 14, 9), "sao": (8, 8, 20.8)}
    place = dict(zip(wagata.names, wagata.centres(), strict=True))
    front_of_gedai, front_of_chudai = -14 * SUN, place["chudai"][1] - 10 * SUN
    assert front_of_chudai - front_of_gedai == pytest.approx(6 * SUN)
    assert place["sao"][2] == pytest.approx((5 + 10 + 9 + 10.4) * SUN)
    assert wagata.mu == 0.438


def test_dowels_join_two_stones():
    """Reinforced, jodai and sao move as one; plain, every stone moves by itself."""
    assert list(load_pile("wagata").bodies()) == [(0,), (1,), (2,), (3,), (4,)]
    assert list(load_pile("wagata", reinforced=True).bodies()) == [(0,), (1,), (2,), (3, 4)]


def test_pile_without_or_fixed_stone():
    """Without the mizubachi four stones are left; fixed, it is no body of its own."""
    assert load_pile("wagata").without("mizubachi").names == ("gedai", "chudai", "jodai", "sao")
    fixed = replace(load_pile("wagata"), fixed=("gedai", "mizubachi"))
    assert list(fixed.bodies()) == [(2,), (3,), (4,)]


def test_bundled_lantern_is_stable():
    """The bundled lantern is a pile that can stand, 2 m high."""
    lantern = load_pile("lantern.toml")
    assert lantern.centres()[-1][2] + 0.5 * lantern.stones[-1].height == pytest.approx(2.01)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: pile(FOOT, HEAD, PileStone("side", 0.3, 0.3, 0.5, on="foot", offset=(0.2, 0.0))), "head and side overlap by 0.1 m"),
        (lambda: pile(FOOT, replace(HEAD, bottom=0.15)), "foot and head overlap by 0.05 m"),
        (lambda: pile(replace(FOOT, bottom=-0.1)), "foot reaches 0.1 m into the ground"),
        (lambda: pile(FOOT, replace(HEAD, bottom=0.25)), "the stone head has no support"),
        (lambda: pile(FOOT, replace(HEAD, offset=(0.5, 0.0))), "the stone head has no support"),
        (lambda: pile(FOOT, replace(HEAD, offset=(0.31, 0.0))), "unstable at rest: the centre of gravity of the stone head"),
        (
            lambda: pile(
                PileStone("post", 0.2, 0.2, 0.5),
                PileStone("slab", 0.5, 0.5, 0.1, on="post"),
                PileStone("load", 0.2, 0.2, 0.9, on="slab", offset=(0.2, 0.0)),
            ),
            "unstable at rest: the centre of gravity of the stone slab",
        ),
        (
            lambda: pile(FOOT, replace(HEAD, offset=(0.25, 0.0))).with_wear(0.45),
            "unstable at rest: the centre of gravity of the stone foot",
        ),
        (lambda: pile(FOOT, replace(HEAD, density=0.0)), "density of the stone head must be positive"),
        (lambda: pile(FOOT, replace(HEAD, height=-1.0)), "height of the stone head must be positive"),
        (lambda: pile(FOOT, replace(HEAD, mu=-0.1)), "friction under the stone head must be zero or more"),
        (lambda: pile(FOOT, HEAD, PileStone("top", 0.2, 0.2, 0.2, on="head"), dowels=(("foot", "top"),)), "these stones do not touch"),
        (lambda: pile(FOOT, HEAD, dowels=(("foot", "nose"),)), "dowel: the pile pile has no stone 'nose'"),
        (lambda: pile(FOOT, HEAD, dowels=(("foot",),)), "at least two stones"),
        (lambda: pile(FOOT, HEAD, fixed=("foot", "head")), "leave at least one free"),
        (lambda: pile(FOOT, replace(HEAD, name="foot")), "the pile pile has two stones named foot"),
        (lambda: pile(FOOT, replace(HEAD, on="nose")), "stands on 'nose'"),
        (lambda: pile(), "has no stones"),
    ],
)
def test_pile_rejects_invalid_geometry(make, message):
    """Overlapping, floating, unstable, weightless, wrongly dowelled: one sentence that names the stone."""
    with pytest.raises(BodyError, match=message) as caught:
        make()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("kind = 'pile'", "at least one"),
        ("kind = 'block'", "kind must be"),
        ("kind = 'pile'\ncolour = 1\n[[stone]]\nname = 'a'", "unknown entries colour"),
        ("kind = 'pile'\n[[stone]]\nname = 'a'\nwidth = 1\ndepth = 1", "height is missing"),
        ("kind = 'pile'\n[[stone]]\nwidth = 1\ndepth = 1\nheight = 1", "name is missing"),
        ("kind = 'pile'\n[[stone]]\nname = 'a'\nwidth = 1\ndepth = 1\nheight = 1\noffset = 3", "offset must be a list of 2"),
        ("kind = 'pile'\nmu = 'much'\n[[stone]]\nname = 'a'\nwidth = 1\ndepth = 1\nheight = 1", "mu must be a number"),
        ("not toml", "is not valid TOML"),
    ],
)
def test_pile_rejects_other_files(text, message, tmp_path):
    """A file that describes no pile is one sentence."""
    path = tmp_path / "stones.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(BodyError, match=message):
        load_pile(path)


def test_reinforced_requires_dowels_in_file(tmp_path):
    """Asking for dowels that a file does not name is an error, not a plain pile."""
    path = tmp_path / "stones.toml"
    path.write_text("kind = 'pile'\n[[stone]]\nname = 'a'\nwidth = 1\ndepth = 1\nheight = 1", encoding="utf-8")
    with pytest.raises(BodyError, match="has no dowels"):
        load_pile(path, reinforced=True)


def test_pile_contact_is_per_mass_or_physical():
    """Table 2 is 10 Hz and critical damping per point; a joint of known stiffness shares it among its points."""
    normal, dashpot, shear, _ = PileContact().point_coefficients(100.0, 0.04, 0.3, 25)
    assert math.sqrt(normal / 100.0) / (2.0 * math.pi) == pytest.approx(10.0, rel=1e-4)
    assert dashpot / (2.0 * math.sqrt(normal * 100.0)) == pytest.approx(1.0, rel=1e-4)
    assert shear / normal == pytest.approx(0.4, rel=1e-4)
    normal, dashpot, _, _ = PileContact(stiffness=1e9, damping_ratio=0.5).point_coefficients(100.0, 0.04, 0.3, 4)
    assert normal == pytest.approx(1e7)
    assert 4 * dashpot == pytest.approx(2 * 0.5 * math.sqrt(4e7 * 100.0))
    assert PileContact(young=3e9).point_coefficients(100.0, 0.04, 0.3, 1)[0] == pytest.approx(3e9 * 0.04 / 0.3)
    with pytest.raises(ParameterError, match="exclude each other"):
        PileContact(young=1e9, stiffness=1e9)
    with pytest.raises(ParameterError, match="must be positive"):
        PileContact(stiffness=0.0)


def test_kinetic_friction_may_be_lower_than_static(tmp_path):
    """Of the pile or of a stone, in the file or set for all; `mu` from outside replaces both."""
    file = tmp_path / "own.toml"
    stones = '[[stone]]\nname = "foot"\nwidth = 1.0\ndepth = 1.0\nheight = 0.2\nmu = 0.4\nmu_kinetic = 0.1\n'
    stones += '[[stone]]\nname = "head"\nwidth = 0.5\ndepth = 0.5\nheight = 0.2\n'
    file.write_text(f'kind = "pile"\nmu = 0.7\nmu_kinetic = 0.5\n{stones}')
    body_value = load_pile(file)
    assert [body_value.friction(), *map(body_value.friction, body_value.stones)] == [(0.7, 0.5), (0.4, 0.1), (0.7, 0.5)]
    alike = body_value.with_kinetic_friction(0.3)
    assert [alike.friction(stone) for stone in alike.stones] == [(0.4, 0.3), (0.7, 0.3)]
    same = load_pile(file, mu=0.2)
    assert not same.has_lower_kinetic_friction and body_value.has_lower_kinetic_friction
    assert {same.friction(stone) for stone in same.stones} == {(0.2, 0.2)}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: pile(FOOT, mu_kinetic=0.5), "kinetic friction 0.5 must not exceed static friction 0.438"),
        (
            lambda: pile(replace(FOOT, mu=0.3), mu_kinetic=0.4),
            "kinetic friction under the stone foot, 0.4, must not exceed static friction, 0.3",
        ),
        (lambda: pile(replace(FOOT, mu_kinetic=0.5)), "kinetic friction under the stone foot, 0.5, must not exceed"),
        (lambda: replace(FOOT, mu_kinetic=-0.1), "kinetic friction under the stone foot"),
        (lambda: pile(FOOT, mu_kinetic=math.nan), "kinetic friction"),
    ],
)
def test_kinetic_friction_above_static_is_rejected(make, message):
    with pytest.raises(BodyError, match=message):
        make()


@pytest.mark.parametrize(
    ("head", "stone", "message"),
    [
        ("mu_kinetic = 0.5", "", "kinetic friction 0.5 must not exceed static friction 0.438"),
        ("", "mu_kinetic = 0.5", "kinetic friction under the stone head, 0.5, must not exceed"),
        ("", 'on = "roof"', "the stone head stands on 'roof'"),
        ("", 'offset = ["2m", 0]', "the stone head has no support"),
        ("", "density = 0", "density of the stone head must be positive"),
        ('fixed = ["roof"]', "", "fixed stone: the pile own has no stone 'roof'"),
    ],
)
def test_pile_error_names_its_file(tmp_path, head, stone, message):
    """A pile that cannot be names its file, whether the pile refuses it, or a stone does."""
    file = tmp_path / "own.toml"
    size = "width = 0.5\ndepth = 0.5\nheight = 0.2\n"
    file.write_text(f'kind = "pile"\n{head}\n[[stone]]\nname = "foot"\n{size}[[stone]]\nname = "head"\n{size}{stone}\n')
    with pytest.raises(BodyError, match=f"^{re.escape(str(file))}: {re.escape(message)}"):
        load_pile(file)
