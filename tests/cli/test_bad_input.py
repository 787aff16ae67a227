"""Meaningless input: one sentence and an exit code, no answer."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main

T = np.arange(300) * 0.01
SWING = np.sin(10.0 * T) * np.exp(-((T - 1.5) ** 2))


def table(path, header, *gal):
    """Write a table of time and some columns."""
    path.parent.mkdir(exist_ok=True)
    rows = zip(T, *(peak * SWING for peak in gal), strict=True)
    path.write_text(header + "\n" + "".join(",".join([f"{t:.2f}", *(f"{a:.3f}" for a in row)]) + "\n" for t, *row in rows))
    return path.name


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Run a command in its own directory; return exit code and stderr."""
    monkeypatch.chdir(tmp_path)

    def run(*words):
        result = CliRunner().invoke(main, [str(word) for word in words])
        assert result.exception is None or isinstance(result.exception, SystemExit)
        assert result.exit_code == 0 or result.stdout == ""
        return result.exit_code, result.stderr.strip()

    return run


@pytest.mark.parametrize("command", ["rock", "respond", "criteria", "measure", "uplift"])
def test_commands_reject_implausible_size_and_suggest_units(run, command):
    """A unit that was forgotten: refused by every command that takes sizes, with the ways to write it."""
    code, message = run(command, "--width", "24", "--height", "62")
    assert code == 2 and "width 24 has no unit and exceeds 20 m: write 24cm, 24mm or 24m" in message


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("rock --width 20cm,24 --height 1", "width 24 has no unit and exceeds 20 m: write 24cm, 24mm or 24m"),
        ("respond --width 1:24parsec:1 --height 1 --mu 0.5", "width '24parsec': unknown unit 'parsec'; use one of"),
        ("spectrum --sizes 24parsec --lang ja", "長さ '24parsec' の単位 'parsec' は使えません。"),
        ("respond --block gravestone --moved 24 --lang ja", "長さ 24 は単位がなく、20 m を超えています。"),
    ],
)
def test_length_of_any_option_or_list_is_rejected_in_the_language(run, words, says):
    """A value of a list as a single one; an option's own name is never translated as a term of something else."""
    code, message = run(*words.split())
    assert code == 2 and says in message


def test_files_with_implausible_size_are_rejected(run, tmp_path):
    """A body and a cemetery, too."""
    (tmp_path / "body.toml").write_text('kind = "block"\nwidth = 24\nheight = 62\n')
    (tmp_path / "stones.csv").write_text("height,width\n62,24\n")
    code, message = run("rock", "--block", "body.toml")
    assert code == 3 and message.startswith("seisblock: body.toml: width 24 has no unit and exceeds 20 m")
    code, message = run("overturn-rate", "--cemetery", "stones.csv")
    assert (
        code == 3
        and "height of 62 m is not plausible (read as metres without a unit: name the column, for example, height (cm))" in message
    )


def test_object_without_unit_above_20_m_is_rejected(run, tmp_path):
    """A case of 60 x 190 without a unit was 60 m wide and 190 m high, or 24 by 72 m, and stood."""
    (tmp_path / "objects.csv").write_text("name,width,height\ncase,24,72\n")
    code, message = run("scenario", "--jma", "6+", "--bodies", "objects.csv")
    assert code == 3 and "width of 24 m is not plausible (read as metres without a unit" in message
    (tmp_path / "objects.csv").write_text("name,width (m),height (m)\ntank,24,10\n")
    assert run("batch", "--bodies", "objects.csv", "--solver", "rock", "--out", "t.csv")[0] == 0


def test_body_file_without_kind_is_named(run, tmp_path):
    """A file of sizes alone: ``found None`` is a word of Python."""
    (tmp_path / "body.toml").write_text("width = 0.24\nheight = 0.72\n")
    assert run("rock", "--block", "body.toml")[1].endswith("found nothing")


def test_number_with_comma_is_named(run, tmp_path):
    """Decimal comma or thousands: not told apart; ``,900`` was called an unknown unit."""
    (tmp_path / "objects.csv").write_text('name,width (cm),height (mm),weight (kg)\ncase,60,"1,900",150\ncase,60,1900,"1,200"\n')
    code, message = run("batch", "--bodies", "objects.csv", "--solver", "rock", "--out", "t.csv")
    assert code == 3 and "line 2: height '1,900' contains a comma" in message


def test_ambiguous_column_t_is_rejected(run, tmp_path):
    """An ambiguous column T is reported, not guessed."""
    name = table(tmp_path / "ltv.csv", "t,L,T,V", 100, 200, 50)
    code, message = run("measure", name)
    assert code == 3 and "'T' may be time or the transverse direction" in message
    assert len(message.splitlines()) == 1


@pytest.mark.parametrize(
    "header", ["time,NS (gal),NS (gal),UD (gal)", "time,NS (gal),N (gal),UD (gal)", "time,N10E (gal),10° (gal),UD (gal)"]
)
def test_duplicate_columns_are_rejected(run, tmp_path, header):
    """Or of one meaning: keep one of them."""
    code, message = run("slide", table(tmp_path / "two.csv", header, *[100] * header.count("gal")), "--mu", "0.2")
    assert code == 3 and "several columns for" in message and message.endswith("keep one")


def test_one_way_sliding_with_contact_loss_is_rejected(run, tmp_path):
    """Not defined in the air: refused with its time, where the ground falls away at more than g."""
    name = table(tmp_path / "strong.csv", "time,NS (gal),EW (gal),UD (gal)", 1200, 2400, 3600)
    code, message = run("slide", name, "--mu", "0.2", "--one-way", "--quiet")
    assert code == 3 and "contact lost at 0.420 s (normal force zero)" in message.splitlines()[-1]
    assert run("slide", name, "--mu", "0.2", "--one-way", "--no-vertical", "--quiet")[0] == 0


def test_repeated_file_is_rejected_but_equal_names_are_not(run, tmp_path):
    """One file named twenty times is refused, however it is spelt; twenty files of that name in twenty folders are twenty records."""
    header = "time,NS (gal),EW (gal),UD (gal)"
    for i in range(20):
        table(tmp_path / f"d{i}" / "rec.csv", header, 100 + i, 50, 20)
    code, message = run("measure", *["d0/rec.csv"] * 20)
    assert (code, message) == (3, "seisblock: d0/rec.csv is given 20 times; give each record once")
    assert run("measure", "d0/rec.csv", "./d0/rec.csv")[0] == 3
    assert run("measure", "-", "-")[0] == 3
    result = CliRunner().invoke(main, ["measure", "--quiet", *(f"d{i}/rec.csv" for i in range(20))])
    assert result.exit_code == 0 and all(f"d{i}/rec.csv  start" in result.stdout for i in range(20))


FOREIGN = {
    "time,HNN (gal),HNE (gal),HNZ (gal)": {"NS": 0, "EW": 90, "UD": None},
    "time,N10E (gal),N80W (gal),UP (gal)": {"10": 10, "280": 280, "UD": None},
    "time,10 (gal),280 (gal),UD (gal)": {"10": 10, "280": 280, "UD": None},
    "time,S10W (gal),N80W (gal),Vertical (gal)": {"190": 190, "280": 280, "UD": None},
    "time,030 (gal),120 (gal),UP (gal)": {"30": 30, "120": 120, "UD": None},
    "Time(s),Acc. N-S [cm/s2],Acc. E-W [cm/s2],Acc. U-D [cm/s2]": {"NS": 0, "EW": 90, "UD": None},
    "時間(秒),南北(ガル),東西(ガル),上下(ガル)": {"NS": 0, "EW": 90, "UD": None},
    "time,X (gal),Y (gal),Z (gal)": {"X": None, "Y": None, "UD": None},
    "time,L (gal),T (gal),V (gal)": {"L": None, "T": None, "UD": None},
    "time,longitudinal (gal),transversal (gal),vertical (gal)": {"L": None, "T": None, "UD": None},
}


@pytest.mark.parametrize(("header", "azimuths"), FOREIGN.items(), ids=FOREIGN)
def test_component_azimuth_uses_azimuths_of_record(tmp_path, header, azimuths):
    """`--component 37` of foreign layouts: turned by the record's own azimuths, refused where there are none."""
    from seisblock.core.errors import ComponentError
    from seisblock.readers import read
    from seisblock.records import motion_of

    table(tmp_path / "rec.csv", header, 100, 60, 20)
    record = read(tmp_path / "rec.csv")
    assert {c.code: c.azimuth_deg for c in record.components} == azimuths
    reference = [(c.azimuth_deg, c.acceleration) for c in record.horizontals if c.azimuth_deg is not None]
    if not reference:
        with pytest.raises(ComponentError, match="of known azimuth"):
            motion_of(record, "37")
        return
    expected = sum(row * np.cos(np.radians(37.0 - azimuth)) for azimuth, row in reference)
    np.testing.assert_allclose(motion_of(record, "37").acceleration[0], expected, atol=1e-12)


def test_channels_without_vertical_are_rejected(tmp_path):
    """CH1, CH2, CH3 are accelerations by their unit; the unknown vertical is reported."""
    from seisblock.readers import read

    table(tmp_path / "rec.csv", "time,CH1 (gal),CH2 (gal),CH3 (gal)", 100, 60, 20)
    assert [doubt.message for doubt in read(tmp_path / "rec.csv").doubts] == [
        "no vertical component identified among CH1, CH2, CH3; all treated as horizontal"
    ]


def test_component_rejects_invalid_azimuth(run, tmp_path):
    """400 degrees, or a value where a name belongs."""
    code, message = run("measure", table(tmp_path / "rec.csv", "time,400 (gal),130 (gal),UD (gal)", 100, 60, 20))
    assert code == 3 and "column name '400 (gal)' is not an azimuth" in message
