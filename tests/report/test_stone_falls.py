"""The falls of a pile's stones are one short sentence: what fell, when, and to which side; the table has the rest."""

import numpy as np
import pytest
from rich.cells import cell_len

from seisblock import Motion, load_pile
from seisblock.core.i18n import use_locale
from seisblock.core.results import Response
from seisblock.models.stack.options import StackOptions
from seisblock.models.stack.outcome import StackOutcome, StoneOutcome
from seisblock.models.stack.stone_falls import describe_falls
from seisblock.output.directions import direction_with_compass
from seisblock.output.text.tables import console
from seisblock.report.text.stack import tables

STILL = np.zeros((3, 200))
RIGID = StackOptions(law="rigid")


def motion_towards(azimuth):
    """Return a motion whose +x is an azimuth; None: unknown."""
    return Motion(STILL, 0.01, name="" if azimuth is None else f"{azimuth:g}")


def make_response(pile, *falls, azimuth=0.0):
    """Return the answer that stones of a bundled pile fell: each by name, time, s, and azimuth of the fall."""
    body, motion = load_pile(pile), motion_towards(azimuth)
    mapping = {name: (at, (azimuth or 0.0) - to) for name, at, to in falls}
    stones = []
    for name in body.names:
        at, to = mapping.get(name, (None, None))
        side = None if to is None or azimuth is None else (azimuth - to) % 360.0
        state = "standing" if at is None else "fallen"
        stones.append(StoneOutcome(name, state, 1.0, 1.0, 0.01, 0.01, 0.0, 0.0, at, to, side, None if at is None else "ground"))
    names = tuple(stone.name for stone in stones if stone.state == "fallen")
    first = min((at for _, at, _ in falls), default=None)
    outcome = StackOutcome(names, bool(names), first, {}, {}, tuple(stones), 0.0, 0.0, 0.0, 0.0, 1e-3)
    return Response("stack", outcome, motion, body, options=RIGID)


LANTERN = ("hoju", "kasa", "hibukuro", "chudai", "sao", "kiso")


def lantern(*names, each=0.05, azimuth=0.0):
    """Return that stones of the lantern fell one after the other, to the south-west and a little less so each."""
    return make_response("lantern", *((name, 3.2 + each * rank, 214.0 - 4.0 * rank) for rank, name in enumerate(names)), azimuth=azimuth)


@pytest.mark.parametrize(
    ("answer", "sentence"),
    [
        (lantern(), ""),
        (lantern("hoju"), "hoju falls to azimuth 214 (SW) at 3.20 s, onto the ground."),
        (lantern(*LANTERN), "All 6 stones fall together at 3.20 s, approximately to azimuth 204 (SSW)."),
        (lantern(*LANTERN[:5]), "All stones above kiso fall together at 3.20 s, approximately to azimuth 206 (SSW)."),
        (lantern("kasa", "hoju"), "All stones above hibukuro fall together at 3.20 s, approximately to azimuth 212 (SSW)."),
        (lantern("hoju", "hibukuro"), "hoju, hibukuro fall together at 3.20 s, approximately to azimuth 212 (SSW)."),
        (lantern("hoju", "kasa", each=0.6), "hoju falls first, to azimuth 214 (SW) at 3.20 s; then kasa, to azimuth 210 (SSW) at 3.80 s."),
        (
            lantern(*LANTERN[:5], each=0.13),
            "hoju falls first, to azimuth 214 (SW) at 3.20 s; then kasa, hibukuro, chudai, sao, the last at 3.72 s.",
        ),
        (
            make_response("lantern", ("hoju", 3.2, 10.0), ("kasa", 3.3, 190.0)),
            "hoju falls first, to azimuth 10 (N) at 3.20 s; then kasa, to azimuth 190 (S) at 3.30 s.",
        ),
        (lantern("hoju", "kasa", azimuth=None), "All stones above hibukuro fall together at 3.20 s, approximately to -x+y."),
    ],
)
def test_falls_are_described_in_one_sentence(answer, sentence):
    """Together within half a second and to one side, or one after the other in the order of time."""
    assert describe_falls(answer) == sentence


def test_falls_of_many_stones_are_counted(tmp_path):
    """Nobody reads twenty names: they are counted."""
    file = tmp_path / "tower.toml"
    stone = '[[stone]]\nname = "s{}"\nwidth = 0.5\ndepth = 0.5\nheight = 0.1\n'
    file.write_text('kind = "pile"\n' + "".join(stone.format(rank) for rank in range(20)))
    answer = make_response(file, *((f"s{rank}", 4.0 - 0.1 * rank, 90.0) for rank in range(20)))
    assert describe_falls(answer) == "s19 falls first, to azimuth 90 (E) at 2.10 s; then 19 stones, the last at 4.00 s."


@pytest.mark.parametrize(
    ("azimuth", "point"), [(0, "N"), (11, "N"), (12, "NNE"), (34, "NE"), (180, "S"), (214, "SW"), (348, "NNW"), (349, "N")]
)
def test_azimuth_maps_to_nearest_compass_point(azimuth, point):
    """The nearest of sixteen, whatever +x is; in Japanese, too."""
    assert [direction_with_compass(plus_x - azimuth, motion_towards(plus_x)) for plus_x in (0.0, 117.0)] == [
        f"azimuth {azimuth} ({point})"
    ] * 2
    with use_locale("ja"):
        kanji = point.translate(str.maketrans("NESW", "北東南西"))
        assert direction_with_compass(-azimuth, motion_towards(0.0)) == f"方位 {azimuth}°（{kanji}）"


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("pile", ["wagata", "lantern", "column"])
def test_fall_table_has_side_within_80_columns(pile, lang, monkeypatch):
    """Of a record of more than 100 s, too; where north is not known the side is one of the axes."""
    monkeypatch.setenv("COLUMNS", "80")
    names = load_pile(pile).names[1:]
    falls = [(name, 1000.0 + rank, 260.0 + rank) for rank, name in enumerate(names)]
    for azimuth, side in ((0.0, "260"), (None, "+y")):
        with use_locale(lang):
            screen = console()
            with screen.capture() as output:
                screen.print(*tables([make_response(pile, *falls, azimuth=azimuth)], [{"agreement": None}]))
        rows = [row for row in output.get().splitlines() if "100" in row and " 57.30" in row]
        assert len(rows) == len(names)
        assert rows[-1].split()[3] == side
        assert max(cell_len(row.rstrip()) for row in output.get().splitlines()) <= 80
