"""Directions are named +EW, -EW or by azimuth in every output, never +x where the direction has a name."""

import re

import numpy as np
import pytest
from matplotlib.text import Text

from seisblock.core.i18n import use_locale
from seisblock.models.jump.animate import jump_animation
from seisblock.models.respond.animate import respond_animation
from seisblock.models.rock.animate import rocking_animation
from seisblock.models.slide.animate import slide_animation
from seisblock.models.stack.animate import stack_animation
from seisblock.models.uplift.animate import uplift_animation
from seisblock.output.animation.html import animation_html
from seisblock.output.animation.render import REAL_TIME
from seisblock.output.directions import direction_in_plane, direction_label, phase_label, transverse_component, with_direction
from seisblock.output.figures.solver import response_figure
from seisblock.output.text.solver import describe as verdict_text
from seisblock.records import Component, Motion, Record, motion_of
from seisblock.report.html.report_text import sentences, verdict
from seisblock.studies.report.responses import ModelResponse
from tests.lengths import all_but_slow
from tests.report.long_record import response

FILMS = {
    "respond": respond_animation, "rock": rocking_animation, "slide": slide_animation, "jump": jump_animation,
    "uplift": uplift_animation, "stack": stack_animation,
}  # fmt: skip

NAMELESS = re.compile(r"(?<![\w(（,=+-])[+-]x(?! = )|forward|backward|\+alpha|-alpha")
"""Sides of the body are no directions: ``+x = NS``, and the corners ``(+x,-y)`` that it explains."""


@pytest.mark.parametrize("lang", ["en", "ja"])
@pytest.mark.parametrize("model", all_but_slow(FILMS, set(FILMS) - {"stack"}))
def test_models_name_directions_after_record_components(model, lang):
    """Verdict, figure, film and report of each model; a document keeps its own words, which are data."""
    solution = response(model)
    with use_locale(lang):
        figure = response_figure([solution])
        film = FILMS[model](solution, np.linspace(52.0, 70.0, 50))
        page = animation_html(film, REAL_TIME)
        texts = [
            verdict_text(solution),
            *(text.get_text() for text in figure.findobj(Text)),
            *(film.phase_label(p.name) for p in film.visible_phases),
        ]
        texts += [film.title, film.note, film.heading, page.split("application/json")[0]]
        if model in ("rock", "slide", "jump", "uplift"):
            effect = ModelResponse(solution, None, None)
            texts += [verdict(effect), *sentences(effect)]
    assert not [text for text in texts if NAMELESS.search(text)]
    if model in ("rock", "slide", "jump"):
        assert re.search(r"[+-]NS\b", " ".join(texts))


def test_direction_name_is_component_or_azimuth():
    """The sign, or a document's word for it; an azimuth is turned round; nothing has no side."""
    assert [direction_label("EW", sign) for sign in (1.0, -1.0, "+x", "-x", "+", "-")] == ["+EW", "-EW"] * 3
    assert [direction_label("37", sign) for sign in (1, -1)] == ["azimuth 37", "azimuth 217"]
    assert [direction_label("", sign) for sign in (1, -1)] == ["+x", "-x"]
    assert with_direction("448 mm", "NS", -0.448) == "448 mm to -NS"
    assert with_direction("0.0 mm", "NS", -1e-6) == "0.0 mm"
    with use_locale("ja"):
        assert with_direction("448 mm", "NS", -0.448) == "448 mm（-NS 側）"
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


@pytest.mark.parametrize(("name", "expected"), [("EW", ("NS", 1)), ("NS", ("EW", -1)), ("X", ("y", 1))])
def test_transverse_component_is_90_degrees_counter_clockwise(name, expected):
    """+y of a pile under EW points north, under NS west; without azimuths it has no name."""
    rows = {"NS": np.arange(3.0), "EW": np.ones(3), "X": np.zeros(3)}
    components = tuple(
        Component(code, row, {"NS": 0.0, "EW": 90.0, "X": None}[code]) for code, row in rows.items() if (code == "X") == (name == "X")
    )
    assert transverse_component(motion_of(Record(components, 0.01), name)) == expected
