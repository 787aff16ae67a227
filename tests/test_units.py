"""Lengths as people write them: units that add up, and numbers whose unit was forgotten."""

import time

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.errors import InputError, UnitError
from seisblock.core.units import SHAKU, SUN, parse_acceleration, parse_length, parse_mass


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("0.24", 0.24),
        ("24cm", 0.24),
        ("2尺4寸", 2 * SHAKU + 4 * SUN),
        ("2 尺 4 寸 5 分", 2 * SHAKU + 4.5 * SUN),
        ("2shaku4sun", 2 * SHAKU + 4 * SUN),
        ("5ft 3in", 5 * 0.3048 + 3 * 0.0254),
        ("1m20cm", 1.2),
        ("24㎝", 0.24),
        ("240㎜", 0.24),
        ("２４ｃｍ", 0.24),
        ("１ｍ20㎝", 1.2),
        ("０．２４", 0.24),
        ("20", 20.0),
        ("24m", 24.0),
        (24e-2, 0.24),
    ],
)
def test_parse_length_accepts_units_that_add_up(text, metres):
    """One unit, or several that add up, the larger first."""
    assert parse_length(text) == pytest.approx(metres, rel=1e-14)


@pytest.mark.parametrize("text", ["4寸2尺", "2尺4", "2尺-4寸", "2尺4尺", "24 furlong", "2尺4furlong", "", "nan", "10²m", "1½m", "24㎠"])
def test_parse_length_rejects_invalid_units(text):
    """Units in the wrong order, twice, unknown, or none at all after a first."""
    with pytest.raises(InputError):
        parse_length(text)


@pytest.mark.parametrize("value", ["24", 24, 72.0, "-630"])
def test_length_without_unit_above_20_m_is_rejected(value):
    """A length above 20 m without a unit is rejected with the probable notation."""
    with pytest.raises(UnitError, match=r"width -?\d+ has no unit and exceeds 20 m: write -?\d+cm,"):
        parse_length(value, quantity="width")


@pytest.mark.parametrize("command", ["rock", "measure", "criteria", "slide", "uplift"])
def test_commands_reject_block_of_24_m(command):
    """``--width 24 --height 72`` is refused, whichever command is asked."""
    words = [command, "--width", "24", "--height", "72"]
    if command == "slide":
        words = ["infer", "--slid", "24", "--mu", "0.3"]
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 2
    assert "has no unit and exceeds 20 m: write 24cm, 24mm or 24m" in " ".join(result.stderr.split())


@pytest.mark.parametrize("text", ["1" * 100_000, "1.1" * 30_000, " " * 100_000, "1" + " " * 50_000 + "x", "10.7sun" + "9" * 400], ids=len)
@pytest.mark.parametrize("parse", [parse_length, parse_acceleration, parse_mass])
def test_overlong_cell_is_rejected_at_once(parse, text):
    """Damaged tables hold such cells; looking for a number in them took minutes, growing with the cube of their length."""
    start = time.process_time()
    with pytest.raises(InputError):
        parse(text)
    assert time.process_time() - start < 5.0
