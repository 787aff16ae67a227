"""Text report of the shaking: peaks, equivalent frequency, and time above the threshold of the body, a line per direction."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rich.text import Text

from seisblock.core.i18n import N_, gettext
from seisblock.core.results import Response
from seisblock.measures.shaking import BodyShaking, response_shaking, transverse_shaking
from seisblock.output.text.tables import DASH, format_acceleration, format_number, format_seconds, styled_line
from seisblock.output.units_display import velocity_unit


def shaking_lines(responses: Sequence[Response[Any]], *, gal: bool, static: bool = False) -> Iterator[Text]:
    """Yield a line per direction, in three dimensions also of the motion across it; `static` for a body on springs."""
    for response in responses:
        name, across = response.motion.name or "x", transverse_shaking(response)
        yield styled_line(shaking_text(name, response_shaking(response), gal=gal, static=static), "dim")
        if across is not None:
            yield styled_line(shaking_text(gettext("transverse to {name}", name=name), across, gal=gal), "dim")


def shaking_text(name: str, shaking: BodyShaking, *, gal: bool = True, static: bool = False) -> str:
    """Return the peaks of a motion and the time above the threshold in a sentence.

    Parameters
    ----------
    name : str
        Direction.
    shaking : BodyShaking
    gal : bool
    static : bool
        The threshold is that of a slow acceleration: a body on springs may lift below it.

    Examples
    --------
    >>> shaking_text("EW", BodyShaking(1.0, 0.3, 1.59, 2.0, 0.0, 0.0))
    'EW: PGA 100.0 gal, PGV 30.00 kine, equivalent frequency 1.590 Hz; below the threshold of 200.0 gal.'
    >>> shaking_text("EW", BodyShaking(3.0, 0.3, 1.59, 2.0, 1.25, 0.25)).partition("; ")[2]
    'above the threshold of 200.0 gal for 1.250 s (longest interval 0.250 s).'
    >>> shaking_text("EW", BodyShaking(3.0, 0.3, 1.59, 2.0, 0.0, 0.0)).partition("; ")[2]  # the peak acts to the other side
    'below the threshold, 200.0 gal to the weaker side.'
    >>> shaking_text("EW", BodyShaking(0.0, 0.0, None, None, None, None))
    'EW: PGA 0.0 gal, PGV 0.0000 kine, equivalent frequency -.'
    """
    speed = velocity_unit(gal=gal)
    threshold = format_acceleration(shaking.threshold_m_s2, gal=gal)
    frequency = shaking.equivalent_frequency_hz
    if shaking.threshold_m_s2 is None:
        template = N_("{name}: PGA {pga}, PGV {pgv}, equivalent frequency {frequency}.")
    elif static:
        template = N_(
            "{name}: PGA {pga}, PGV {pgv}, equivalent frequency {frequency}; static threshold of uplift {threshold} (without "
            "amplification by the springs)."
        )
    elif not shaking.time_above_threshold_s and shaking.pga_m_s2 >= shaking.threshold_m_s2:
        template = N_(
            "{name}: PGA {pga}, PGV {pgv}, equivalent frequency {frequency}; below the threshold, {threshold} to the weaker side."
        )
    elif not shaking.time_above_threshold_s:
        template = N_("{name}: PGA {pga}, PGV {pgv}, equivalent frequency {frequency}; below the threshold of {threshold}.")
    else:
        template = N_(
            "{name}: PGA {pga}, PGV {pgv}, equivalent frequency {frequency}; above the threshold of {threshold} for {time} s "
            "(longest interval {longest} s)."
        )
    return gettext(
        template,
        name=name,
        pga=format_acceleration(shaking.pga_m_s2, gal=gal),
        pgv=f"{format_number(shaking.pgv_m_s / speed.size)} {speed.name}",
        frequency=DASH if frequency is None else f"{format_number(frequency)} Hz",
        threshold=threshold,
        time=format_seconds(shaking.time_above_threshold_s),
        longest=format_seconds(shaking.longest_above_threshold_s),
    )
