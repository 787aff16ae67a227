"""One way to name a direction: whatever shows a response says +EW or -EW, or an azimuth, and never +x of what has a name."""

import re

import numpy as np
import pytest
from matplotlib.text import Text

from seisblock.core.i18n import use_locale
from seisblock.records import Component, Motion, Record, motion_of
from seisblock.report.animation.html import animation_html
from seisblock.report.animation.jump import jump_animation
from seisblock.report.animation.render import REAL_TIME
from seisblock.report.animation.respond import respond_animation
from seisblock.report.animation.rock import rocking_animation
from seisblock.report.animation.slide import slide_animation
from seisblock.report.animation.stack import stack_animation
from seisblock.report.animation.uplift import uplift_animation
from seisblock.report.directions import direction_in_plane, direction_label, phase_label, with_direction
from seisblock.report.html.report_text import sentences, verdict
from seisblock.report.registry import PRESENTERS, response_figure, verdict_text
from seisblock.studies.assessment import ModelResponse
from tests.lengths import all_but_slow
from tests.report.long_record import response

FILMS = {
    "respond": respond_animation, "rock": rocking_animation, "slide": slide_animation, "jump": jump_animation,
    "uplift": uplift_animation, "stack": stack_animation,
}  # fmt: skip

NAMELESS = re.compile(r"(?<![\w(（,=+-])[+-]x(?! = )|forward|backward|\+alpha|-alpha")
"""A side of a body that says no direction of the record; ``+x = NS``, and the corners ``(+x,-y)`` it explains, are none."""


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("model", all_but_slow(PRESENTERS, set(PRESENTERS) - {"stack"}))
def test_models_name_directions_after_record_components(model, lang):
    """Verdict, figure, film and report of each model; a document keeps its own words, which are data."""
    found = response(model)
    with use_locale(lang):
        figure = response_figure([found])
        film = FILMS[model](found, np.linspace(52.0, 70.0, 50))
        page = animation_html(film, REAL_TIME)
        told = [
            verdict_text(found),
            *(text.get_text() for text in figure.findobj(Text)),
            *(film.phase_label(p.name) for p in film.visible_phases),
        ]
        told += [film.title, film.note, film.heading, page.split("application/json")[0]]
        if model in ("rock", "slide", "jump", "uplift"):
            effect = ModelResponse(model, found, None, None)
            told += [verdict(effect), *sentences(effect)]
    assert not [text for text in told if NAMELESS.search(text)]
    if model in ("rock", "slide", "jump"):
        assert re.search(r"[+-]NS\b", " ".join(told))


def test_direction_name_is_component_or_azimuth():
    """The sign, or a document's word for it; an azimuth is turned round; nothing has no side."""
    assert [direction_label("EW", sign) for sign in (1.0, -1.0, "+x", "-x", "+", "-")] == ["+EW", "-EW"] * 3
    assert [direction_label("37", sign) for sign in (1, -1)] == ["azimuth 37", "azimuth 217"]
    assert [direction_label("", sign) for sign in (1, -1)] == ["+x", "-x"]
    assert with_direction("448 mm", "NS", -0.448) == "448 mm to -NS"
    assert with_direction("0.0 mm", "NS", -1e-6) == "0.0 mm"
    with use_locale("ja"):
        assert with_direction("448 mm", "NS", -0.448) == "-NS へ 448 mm"
        assert (phase_label("slip backward", "EW"), phase_label("rocks to +x", "127")) == ("-EW へ滑動", "方位 127° へロッキング")


def test_fall_direction_is_azimuth_or_axis():
    """+y is 90 degrees counter-clockwise of +x: west of north, north of east; the azimuth runs clockwise from north."""
    row = np.array([0.0, 1.0])
    record = Record((Component("NS", row, 0.0), Component("EW", row, 90.0), Component("UD", row)), 0.01)
    north, east = (motion_of(record, name) for name in ("NS", "EW"))
    assert [direction_in_plane(angle, north) for angle in (0.0, 50.0, 90.0, 180.0, -90.0)] == [
        f"azimuth {angle}" for angle in (0, 310, 270, 180, 90)
    ]
    assert [direction_in_plane(angle, east) for angle in (0.0, 90.0, -135.0)] == ["azimuth 90", "azimuth 0", "azimuth 225"]
    assert direction_in_plane(30.0, motion_of(record, "37")) == "azimuth 7"
    assert direction_in_plane(-45.0, Motion.from_arrays(row, 0.01)) == "+x-y"
