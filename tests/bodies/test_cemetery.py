"""Cemeteries are read from tables of survey teams; errors name the line."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.bodies.cemetery.table import parse_cemetery, read_cemetery
from seisblock.core.errors import BodyError
from seisblock.core.i18n import gettext, use_locale
from seisblock.output.text.tables import format_number
from seisblock.samples import sample_path
from tests import make_aoyama

SURVEY = """\
# 墓地の調査
# 2024-01-01
竿高さ（cm）,竿幅（cm）,補強,転倒,方位,個数
62.4,24,無,転倒,90,1
６３,24,有,残存,,2
# 欠番
50,25,,,,
"""


@pytest.mark.parametrize(
    ("numbers", "stones", "names"),
    [
        (("1", "2", "3"), 3, ["1", "2", "3"]),
        (("101", "105", "230"), 3, ["101", "105", "230"]),
        (("A-1", "A-2", "B-1"), 3, ["A-1", "A-2", "B-1"]),
        (("12", "4", "4"), 20, None),
    ],
)
def test_numbers_of_stones_are_no_counts(numbers, stones, names):
    """The sheet of the guide on Excel, number 1 to n, was read as 1 + 2 + ... + n stones, without a word."""
    rows = "".join(f"{number},24,{height},{height > 60:d}\n" for number, height in zip(numbers, (60, 66, 72), strict=True))
    cemetery = parse_cemetery(f"number,width (cm),height (cm),overturned\n{rows}")
    assert cemetery.size == stones
    assert names is None or [stone.name for stone in cemetery.stones] == names


def test_cemetery_accepts_english_columns_with_ratio():
    """height_over_width is enough; the other columns are optional and unknown ones passed over."""
    cemetery = parse_cemetery("block,Height over width,fallen,count\nA,2.6,yes,\nB,3.1,0,4\n")
    assert [s.height_over_width for s in cemetery.stones] == [2.6, 3.1]
    assert [s.fallen for s in cemetery.stones] == [True, False]
    assert (cemetery.size, cemetery.ratios.tolist()) == (5, [2.6, 3.1, 3.1, 3.1, 3.1])
    assert [s.line for s in cemetery.stones] == [2, 3]
    assert cemetery.has_survey


def test_cemetery_accepts_japanese_columns_with_sizes():
    """Japanese headings, full-width digits and brackets, comments and empty cells."""
    cemetery = parse_cemetery(SURVEY)
    assert cemetery.ratios.tolist() == [2.6, 2.625, 2.625, 2.0]
    assert [s.reinforced for s in cemetery.stones] == [False, True, False]
    assert [s.fallen for s in cemetery.stones] == [True, False, None]
    assert cemetery.stones[0].azimuth_deg == 90.0
    assert cemetery.stones[0].width == 0.24
    assert cemetery.notes == ("墓地の調査", "2024-01-01")


@pytest.mark.parametrize("word", ["棹", "棹石", "棹石の", "墓石", "石塔の", "竿石の"])
def test_cemetery_accepts_words_of_surveyors(word):
    """Headings begin with the word for the stone; the damage column says fallen, shifted or unknown."""
    table = f"番号,{word}幅,{word}高さ,被害\nA,24cm,72cm,倒\nB,24cm,60cm,ずれ\nC,24cm,60cm,無被害\nD,24cm,60cm,不明\n"
    cemetery = parse_cemetery(table)
    assert cemetery.ratios.tolist() == [3.0, 2.5, 2.5, 2.5]
    assert [s.fallen for s in cemetery.stones] == [True, False, False, None]


def test_missing_columns_are_named_in_japanese():
    """The headings that a Japanese table has, not the English ones."""
    with pytest.raises(BodyError) as failure:
        parse_cemetery("番号,幅,転倒\n1,24cm,1\n")
    with use_locale("ja"):
        assert "列「高さ」と「幅」、または「高さ幅比」が必要です" in gettext(failure.value.message)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp932", "utf-16"])
@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_cemetery_accepts_encodings_and_line_ends(tmp_path, encoding, ending):
    """UTF-8 with and without a byte order mark, Shift-JIS and what Excel calls Unicode, with either line ending."""
    path = tmp_path / "墓地.csv"
    path.write_bytes(SURVEY.replace("\n", ending).encode(encoding))
    assert read_cemetery(path).ratios.tolist() == [2.6, 2.625, 2.625, 2.0]


@pytest.mark.parametrize(
    ("table", "height"),
    [
        ("height,width\n0.6,0.24\n", 0.6),
        ("height (cm),width [cm]\n60,24\n", 0.6),
        ("height_mm;width_mm\n600;240\n", 0.6),
        ("height (sun)\twidth (sun)\n20\t8\n", 0.606),
        ("高さ,幅\n60cm,8寸\n", 0.6),
        ("H/B,B (m)\n2.5,0.24\n", 0.6),
        ("H/B,高さ\n2.5,0.6\n", 0.6),
    ],
)
def test_cemetery_accepts_units_in_heading_or_cell(table, height):
    """A unit stands in the heading or in the cell; a ratio with one size gives the other."""
    assert parse_cemetery(table).stones[0].height == pytest.approx(height)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("", "contains no gravestones"),
        ("# only\n\n# comments\n", "contains no gravestones: a header and one line per stone are required"),
        ("height_over_width\n", "line 1: no gravestone below the header"),
        ("height,fallen\n1,0\n", "line 1: columns required: height_over_width, or height and width; found height, fallen"),
        ("2.5,1\n2.6,0\n", "line 1: columns required: height_over_width"),
        ("H/B,height over width\n1,2\n", "line 1: two columns mean height_over_width"),
        ("H/B\n2.5\n0\n", "line 3: height_over_width must be positive, found 0"),
        ("H/B\n2.5\n-1\n2\n-2\nx\n", r"line 3: height_over_width must be positive, found -1 \(2 more invalid rows: lines 5, 6\)"),
        ("# c\nH/B\nnan\n", "line 3: height_over_width must be positive, found nan"),
        ("H/B\ntall\n", "line 2: height_over_width must be a number, found 'tall'"),
        ("H/B,fallen\n2.5,maybe\n", "line 2: fallen must be 0, 1, yes, no, 転倒 or 残存, found 'maybe'"),
        ("H/B,reinforced\n2.5,steel\n", "line 2: reinforced must be 0, 1, yes or no, found 'steel'"),
        ("H/B,count\n2.5,0\n", "line 2: count must be an integer, 1 or more; found 0"),
        ("H/B,count\n2.5,1.5\n", "line 2: count must be an integer"),
        ("H/B,count\n2.5,inf\n", "line 2: count must be an integer"),
        ("H/B,azimuth\n2.5,NE\n", "line 2: azimuth_deg must be a number, found 'NE'"),
        ("H/B,azimuth\n2.5,nan\n", "line 2: azimuth_deg must be a finite number"),
        ("height,width\n60,24\n", r"line 2: height of 60 m is not plausible \(read as metres without a unit"),
        ("height (cm),width (cm)\n60,\n", "line 2: dimensions missing: height over width, or height and width, required; empty: width"),
        ("height (cm),width (cm)\n60,-24\n", "line 2: width must be positive, found -0.24 m"),
        ("height (yards),width (cm)\n60,24\n", "line 2: height '60yards': unknown unit 'yards'"),
        ("H/B,height (cm),width (cm)\n3,60,24\n", "line 2: height over width is 3, but height and width give 2.5"),
        ("H/B\n2,6\n", "line 2: expected 1 cells as in the header, found 2"),
    ],
)
def test_cemetery_error_names_its_line(table, message):
    """Empty tables, missing columns, sizes that are none, words that mean nothing."""
    with pytest.raises(BodyError, match=message) as caught:
        parse_cemetery(table, source="survey.csv")
    assert str(caught.value).startswith("survey.csv")
    assert "\n" not in str(caught.value)


def test_cemetery_rejects_other_files(tmp_path, monkeypatch):
    """A missing file, a directory, a binary file and another bundled file are one sentence each."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "binary.csv").write_bytes(b"\x00\x01\x02")
    (tmp_path / "latin.csv").write_bytes(b"h\xfcgel,H/B\n\xff\xff\x80,2\n")
    for name, message in {
        "nothing.csv": "no cemetery file nothing.csv, and no bundled cemetery of that name; bundled: aoyama.csv",
        "synthetic_jma.csv": "no cemetery file synthetic_jma.csv",
        str(tmp_path): "is a folder: give the CSV file of a cemetery",
        "binary.csv": "not a text table",
        "latin.csv": "neither UTF-8 nor Shift-JIS",
    }.items():
        with pytest.raises(BodyError, match=message):
            read_cemetery(name)


def test_cemetery_rejects_invalid_stones():
    """A stone or a cemetery made in memory is checked, too."""
    with pytest.raises(BodyError, match="height over width of a gravestone must be positive"):
        Stone(0.0)
    with pytest.raises(BodyError, match="width of a gravestone must be positive"):
        Stone(2.0, width=-1.0)
    with pytest.raises(BodyError, match="contains no gravestones"):
        Cemetery(())


def test_aoyama_has_printed_shares_and_states_reconstruction():
    """100 stones with the shares that [Furukawa2009]_ table 6 pins, inside the fitted range; also by its stem."""
    aoyama = read_cemetery("aoyama")
    assert aoyama.size == 100
    for ratio, above in make_aoyama.PINNED.items():
        for rounding in (-0.02, 0.0, 0.02):
            assert aoyama.share_above(ratio + rounding) == above / 100
    assert aoyama.ratios.min() >= 1.25
    assert aoyama.ratios.max() <= 6.5
    assert "RECONSTRUCTED" in aoyama.notes[0]
    assert not aoyama.has_survey
    assert not aoyama.reinforced.any()
    assert np.all(aoyama.widths() < 0.31)


def test_bundled_aoyama_equals_script_output():
    """The script gives the bundled bytes."""
    assert make_aoyama.make().encode() == sample_path("aoyama.csv").read_bytes()


@pytest.mark.parametrize("lang", ["en", "ja"])
def test_cemetery_reads_printed_yes_and_no(lang):
    """Yes and no as tables print them, in either language, and as surveys mark them."""
    with use_locale(lang):
        yes, no = format_number(True), format_number(False)
    for fell, stood in ((yes, no), ("○", "×"), ("◯", "✕"), ("有", "無"), ("転倒", "残存")):
        cemetery = parse_cemetery(f"H/B,転倒,補強\n2.6,{fell},{no}\n3.1,{stood},{yes}\n")
        assert [stone.fallen for stone in cemetery.stones] == [True, False]
        assert cemetery.reinforced.tolist() == [False, True]
