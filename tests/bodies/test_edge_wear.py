"""Worn edges: a block turns about points in from its sides, and stays the same body otherwise."""

import json
import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import DEFAULT_WEAR, SHARP_EDGES, EdgeWear, parse_edge_wear
from seisblock.bodies.factory import block_from_table, load_block
from seisblock.cli import main
from seisblock.core.errors import BodyError, InputError, ParameterError
from seisblock.models.rock.solve import solve_rock
from seisblock.records import Motion
from seisblock.studies.rocking.spectrum import rocking_spectrum
from seisblock.studies.survey import estimate

STONE = Block(0.24, 0.72, 0.3, centroid_height=0.3, centroid_offset=0.01)


def test_edge_wear_changes_arms_only():
    """Mass, centre and inertia stay those of the whole body; arms, alpha, R and the threshold are those of the worn corners."""
    worn = STONE.with_wear(0.1)
    assert worn.inset == pytest.approx(0.024, rel=1e-15)
    assert (worn.total_mass, worn.centre, worn.gyration_squared) == (STONE.total_mass, STONE.centre, STONE.gyration_squared)
    assert worn.arms == pytest.approx((0.24 * 0.4 - 0.01, 0.24 * 0.4 + 0.01))
    assert worn.slendernesses[0] == pytest.approx(math.atan2(0.086, 0.3))
    assert worn.corner_inertias[0] == pytest.approx(worn.total_mass * (worn.gyration_squared + 0.086**2 + 0.3**2))
    assert worn.rocking_threshold(9.8) == pytest.approx(9.8 * 0.086 / 0.3)


@given(st.just(0.0) | st.floats(1e-6, 0.45), st.floats(0.05, 2.0), st.floats(1.2, 6.0))
def test_worn_block_rocks_like_narrower_block(share, width, ratio):
    """The equations know the base by its arms alone: a narrower block of the same mass, centre and inertia answers alike."""
    full = Block(width, width * ratio, mass=100.0)
    worn = full.with_wear(share)
    narrow = Block(width * (1 - 2 * share), width * ratio, mass=100.0, centroid_inertia=100.0 * full.gyration_squared)
    assert worn.slendernesses == pytest.approx(narrow.slendernesses, rel=1e-12)
    assert worn.lever_ratios == pytest.approx(narrow.lever_ratios, rel=1e-12)
    assert worn.restitutions == pytest.approx(narrow.restitutions, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(
    ("text", "inset"),
    [
        ("0.05", DEFAULT_WEAR),
        ("5%", DEFAULT_WEAR),
        (" 5 % ", DEFAULT_WEAR),
        (0.05, DEFAULT_WEAR),
        ("1cm", EdgeWear(0.01)),
        ("0.5sun", EdgeWear(0.01515)),
        ("0", SHARP_EDGES),
    ],
)
def test_inset_is_share_or_length(text, inset):
    """A bare number or a percentage is a share of the width per side, a number with a unit a length."""
    assert parse_edge_wear(text) == inset


@pytest.mark.parametrize("text", ["-0.1", "-1cm", "nan", "wide", "1 parsec"])
def test_inset_rejects_invalid_values(text):
    """One sentence each."""
    with pytest.raises(InputError):
        parse_edge_wear(text)


def test_inset_must_leave_a_base():
    """Half the width per side, and a centre of gravity beyond the worn edge, are refused."""
    with pytest.raises(ParameterError, match=r"inset of 0\.12 m per side is too large"):
        Block(0.24, 0.72).with_wear(0.5)
    with pytest.raises(BodyError, match="inset must lie between 0 and half the width"):
        Block(0.24, 0.72, inset=0.12)
    with pytest.raises(BodyError, match=r"within 0\.096 m of its middle"):
        Block(0.24, 0.72, centroid_offset=0.1, inset=0.024)


def test_only_bundled_gravestones_are_worn():
    """The bundled gravestone has 0.05 of its width per side; a file may say its own, as a share or a length."""
    assert load_block("gravestone").inset == pytest.approx(0.05 * 0.2424)
    assert load_block("chozusha").inset == 0.0
    table = {"kind": "block", "width": 0.4, "height": 1.0}
    assert block_from_table(table).inset == 0.0
    assert [block_from_table({**table, "inset": arguments}).inset for arguments in (0.05, "2cm", "5%")] == pytest.approx([0.02, 0.02, 0.02])
    with pytest.raises(BodyError, match="inset must be a number"):
        block_from_table({**table, "inset": [1]})


def test_spectrum_of_worn_blocks_equals_solve_rock():
    """rocking_spectrum gives the tilt over the remaining alpha, as solve_rock does."""
    motion = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, 6 * np.pi, 301)), 0.01)
    spectrum = rocking_spectrum([1.0], [0.3], motion, inset=DEFAULT_WEAR)
    single = solve_rock(Block(math.sin(0.3), math.cos(0.3)).with_wear(DEFAULT_WEAR), motion).outcome
    assert spectrum.max_rotation_ratio[0, 0] == single.max_rotation_ratio
    assert single.max_rotation_ratio != solve_rock(Block(math.sin(0.3), math.cos(0.3)), motion).outcome.max_rotation_ratio


@pytest.fixture
def run(capsys):
    """Run a command; return the document and stderr."""

    def call(*words):
        code = main([*map(str, words), "--json"], standalone_mode=False) or 0
        output = capsys.readouterr()
        assert code == 0, output.err
        return json.loads(output.out), output.err

    return call


@pytest.mark.parametrize("command", ["rock", "criteria"])
def test_inset_option_is_equal_in_every_command(run, command):
    """--inset as a share, a percentage and a length give the same stone; the output states the wear."""
    words = (command, "elcentro_1940_ns.csv", "--width", "24cm", "--height", "72cm", "--inset")
    items = [run(*words, text) for text in ("0.1", "10%", "24mm")]
    assert items[0][0]["results"] == items[1][0]["results"] == items[2][0]["results"]
    assert items[0][0]["parameters"]["block"]["inset_m"] == pytest.approx(0.024)
    assert items[0][0]["parameters"]["block"]["slenderness_right_rad"] == pytest.approx(math.atan(0.8 / 3))
    assert "edge wear 2.4 cm (0.1 of the width)" in items[0][1]


def test_overturn_rate_converts_old_inset_and_warns(run):
    """`overturn-rate --inset 0.8` of 0.1.0, pivots over half width, is 0.1 per side, as stderr and document state."""
    words = ("overturn-rate", "--cemetery", "aoyama.csv", "--pga", 400, "--frequency", 1, "--criterion", "simulate", "--inset")
    (old, message), (new, _) = run(*words, "0.8"), run(*words, "0.1")
    assert old["results"] == new["results"]
    assert old["parameters"]["inset"] == new["parameters"]["inset"] == {"length_m": 0.0, "share": 0.1}
    assert any("0.1 of the width per side" in text for text in old["warnings"])
    assert "0.1 of the width per side" in message
    assert new["warnings"] == []


def test_inset_has_no_effect_on_eq_9_and_says_so(run):
    """--inset has no effect on eq. (9), which a message states."""
    words = ("overturn-rate", "--cemetery", "aoyama.csv", "--pga", 400, "--frequency", 1)
    plain, message = run(*words)[0], run(*words, "--inset", "0.05")[0]
    assert plain["results"] == message["results"]
    assert any("has no effect" in text for text in message["warnings"])


def test_infer_of_worn_rigid_stones_gives_smaller_pga(run, monkeypatch):
    """`infer --criterion rigid`: stones that turn about worn edges fell at a smaller PGA, by the rule of their limits."""
    monkeypatch.setattr(
        estimate, "frequency_contour", partial(estimate.frequency_contour, frequencies=[1.0])
    )  # which stands beside the estimate
    words = ("infer", "--cemetery", "aoyama.csv", "--rate", "35/100", "--frequency", 1, "--criterion", "rigid", "--inset")
    sharp, worn = (run(*words, text)[0]["results"][0]["pga_m_s2"] for text in ("0", "0.1"))
    assert 0.75 < worn / sharp < 0.95
