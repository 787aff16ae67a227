"""A film as one page: its data and the script that draws them, so that it plays at any size and any speed."""

from __future__ import annotations

import json
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from seisblock.present.figures.canvas import thin
from seisblock.present.films.animation import Filming
from seisblock.present.films.film import Film, Strip
from seisblock.present.page import page
from seisblock.typing import FloatArray
from seisblock.words import language, tell

STYLE = """
canvas { display: block; width: 100%; } .scenes { display: grid; grid-template-columns: 1fr; gap: .6rem; }
.scenes.both { grid-template-columns: 3fr 2fr; align-items: end; } .scenes figure { margin: 0; }
.panel { display: flex; flex-wrap: wrap; align-items: center; gap: .6rem; margin: .6rem 0; position: sticky; bottom: 0;
  background: var(--paper); padding: .4rem 0; }
.panel input { flex: 1 1 5rem; min-width: 4rem; } .panel button { min-width: 4.5rem; }
.panel button, .panel select { font: inherit; padding: .2rem .5rem; } .panel select { max-width: 8rem; }
.clock { font-variant-numeric: tabular-nums; font-weight: 600; }
.trail i { display: inline-block; width: 1.2em; height: 3px; margin: 0 .3em; }
@media (max-width: 40rem) { .scenes.both { grid-template-columns: 1fr; } }
"""
PACES = (0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
METRES, RADIANS, SECONDS = 5, 6, 4
"""Decimals that are kept: 0.01 mm, 1e-6 rad, 0.1 ms."""


def film_page(film: Film, filming: Filming) -> str:
    """Return the page of a film.

    Parameters
    ----------
    film : Film
        For as many moments as slow motion needs.
    filming : Filming
        Speed at the start.
    """
    text = json.dumps(_data(film, filming), ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/")
    script = Path(__file__).with_name("film.js").read_text(encoding="utf-8")
    close = ""
    if film.close:
        named = ((trail.colour, escape(trail.name)) for trail in film.trails)
        key = "".join(f'<span class="trail"><i style="background:{colour}"></i>{name}</span>' for colour, name in named)
        close = f'<figure><figcaption>{tell("enlarged, seen from the ground")} {key}</figcaption><canvas id="close"></canvas></figure>'
    body = [
        f'<div class="scenes{" both" if film.close else ""}"><figure><figcaption><span class="clock" id="clock"></span> '
        f'<span id="phase"></span></figcaption><canvas id="scene"></canvas></figure>{close}</div>',
        '<div class="panel"><button id="play"></button><input id="at" type="range" min="0" max="1000" value="0" aria-label="time">'
        f'<select id="pace" aria-label="speed">{_paces(1.0 / filming.slow)}</select></div>',
        *(f'<canvas id="strip{index}"></canvas>' for index in range(len(film.strips))),
        f'<script type="application/json" id="film">{text}</script>',
        f"<script>{script}</script>",
    ]
    return page(film.title, body, lang=language(), style=STYLE)


def _paces(chosen: float) -> str:
    """Return the choices of speed, the chosen one among them."""
    options = sorted({*PACES, chosen})
    told = {value: f"× {value:g}" + (f" ({tell('real time')})" if value == 1.0 else "") for value in options}
    return "".join(f'<option value="{value!r}"{" selected" if value == chosen else ""}>{told[value]}</option>' for value in options)


def _data(film: Film, filming: Filming) -> dict[str, Any]:
    """Return everything the script draws."""
    return {
        "first": float(film.time[0]),
        "last": float(film.time[-1]),
        "pace": 1.0 / filming.slow,
        "extent": film.extent,
        "close": film.close,
        "shift": _numbers(film.shift, METRES),
        "floors": [_numbers(floor, METRES) for floor in film.floors],
        "bodies": [
            {
                "x": _numbers(body.x, METRES),
                "z": _numbers(body.z, METRES),
                "turn": _numbers(body.turn, RADIANS),
                "pieces": [{"corners": _numbers(piece.corners, METRES), "colour": piece.colour} for piece in body.pieces],
            }
            for body in film.bodies
        ],
        "trails": [{"x": _numbers(t.x, METRES), "z": _numbers(t.z, METRES), "colour": t.colour} for t in film.trails],
        "strips": [_strip(film, strip) for strip in film.strips],
        "phases": [[phase.start_s, phase.end_s, film.colours[phase.name]] for phase in film.seen if phase.name in film.colours],
        "names": [[phase.start_s, phase.end_s, tell(phase.name)] for phase in film.seen],
        "words": {"play": tell("play"), "pause": tell("pause")},
    }


def _strip(film: Film, strip: Strip) -> dict[str, Any]:
    """Return one curve over the time shown, with the range of its axis."""
    inside = (strip.time >= film.time[0]) & (strip.time <= film.time[-1])
    time, values = thin(strip.time[inside], strip.values[inside], 3000)
    low, high = float(np.min(values, initial=0.0)), float(np.max(values, initial=0.0))
    margin = 0.08 * (high - low) or 1.0
    return {
        "label": strip.label,
        "time": _numbers(time, SECONDS),
        "values": [float(f"{v:.5g}") for v in values],
        "levels": strip.levels,
        "colour": strip.colour,
        "inner": [low, high],
        "range": [low - margin, high + margin],
    }


def _numbers(values: FloatArray, decimals: int) -> Any:
    """Return rounded numbers; adding zero after rounding turns -0.0 into 0.0."""
    return (np.round(values, decimals) + 0.0).tolist()
