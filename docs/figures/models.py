"""Draw the assumptions of each model, slide.svg to stack.svg: ``python docs/figures/models.py``."""

import math
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

from draw import ACCENT, INK, SOFT, arrow, page, text, tilted  # noqa: E402

WIDE, TALL = 620, 330
FLOOR = 262
CURVED = 'fill="none" stroke-width="1.5"'


def ground(left=30, right=330, y=FLOOR):
    """Return the ground, hatched below."""
    ticks = "".join(f"M{x} {y}l-9 9" for x in range(left + 12, right + 1, 14))
    return f'<path d="M{left} {y}H{right}" stroke="{INK}" stroke-width="2"/><path d="{ticks}" stroke="{SOFT}" stroke-width="1"/>'


def ground_motion(x=60, y=FLOOR + 40):
    """Return the arrow of the ground's acceleration."""
    return arrow(x, y, x + 90, y, colour=ACCENT, tip="red") + text(x + 98, y + 5, "a", fill=ACCENT, style='font-style="italic"')


def block(points, *, ghost=False):
    """Return a block by its corners, dashed for its initial position."""
    outline = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    look = 'fill="none" stroke="#999" stroke-dasharray="5 4"' if ghost else f'fill="#f4d9c6" stroke="{ACCENT}" stroke-width="2"'
    return f'<polygon points="{outline}" {look}/>'


def centre(points, name="G"):
    """Return the centre of gravity of a block."""
    x, y = (sum(point[axis] for point in points) / len(points) for axis in (0, 1))
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{INK}"/>' + text(x + 8, y + 5, name)


def dashed(x1, y1, x2, y2):
    """Return a construction line."""
    return f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" stroke="{SOFT}" stroke-width="1" stroke-dasharray="4 3"/>'


def assumptions(*lines, x=360, y=64):
    """Return the assumptions of a model, one per line, next to the drawing."""
    rows = (text(x, y + 25 * k, line, size=14, fill=INK if k else ACCENT, weight="normal" if k else "bold") for k, line in enumerate(lines))
    return "".join(rows)


def italic(x, y, symbol, anchor="start"):
    """Return a symbol."""
    return text(x, y, symbol, anchor=anchor, style='font-style="italic"')


def slide():
    """Return a block on a slope, with friction and sliding displacement."""
    angle = math.radians(12)

    def down(u, w):
        return 60 + u * math.cos(angle) + w * math.sin(angle), 170 + u * math.sin(angle) - w * math.cos(angle)

    def box(u):
        return [down(u, 0), down(u + 80, 0), down(u + 80, 60), down(u, 60)]

    ends = (*down(-20, 0), *down(280, 0))
    parts = [
        f'<path d="M{ends[0]:.1f} {ends[1]:.1f}L{ends[2]:.1f} {ends[3]:.1f}" stroke="{INK}" stroke-width="2"/>',
        dashed(*down(280, 0), down(280, 0)[0] - 120, down(280, 0)[1]),
        italic(down(280, 0)[0] - 92, down(280, 0)[1] - 6, "θ"),
        block(box(10), ghost=True),
        block(box(110)),
        centre(box(110)),
        arrow(*down(50, 76), *down(150, 76), colour=ACCENT, tip="red"),
        italic(*down(95, 84), "u"),
        arrow(*down(150, -4), *down(84, -4)),
        italic(*down(96, -24), "μN"),
        ground_motion(60, 290),
        assumptions(
            "slide",
            "rigid body, rigid base",
            "Coulomb friction, static and kinetic",
            "no rocking: μ below b/h",
            "level, slope, or slope with level end",
            "flight where N is zero",
        ),
    ]
    return page(WIDE, TALL, parts, "Assumptions of the model slide")


def rock():
    """Return a block tilted about its corner, with b, h, R and alpha."""
    pivot = 215
    body, initial = tilted(pivot, FLOOR, 90, 190, 11), tilted(pivot, FLOOR, 90, 190, 0)
    x, y = (sum(point[axis] for point in body) / 4 for axis in (0, 1))
    parts = [
        ground(),
        block(initial, ghost=True),
        block(body),
        centre(body),
        dashed(pivot, FLOOR, x, y),
        dashed(pivot, FLOOR, pivot, FLOOR - 200),
        italic(pivot - 34, FLOOR - 52, "R"),
        arrow(pivot - 45, FLOOR + 16, pivot, FLOOR + 16, both=True),
        italic(pivot - 22, FLOOR + 34, "b", "middle"),
        arrow(pivot - 110, FLOOR, pivot - 110, FLOOR - 95, both=True),
        italic(pivot - 124, FLOOR - 44, "h"),
        f'<path d="M{pivot - 4} {FLOOR - 204} A204 204 0 0 1 {pivot + 38} {FLOOR - 200}" {CURVED} stroke="{INK}" marker-end="url(#tip)"/>',
        italic(pivot + 46, FLOOR - 196, "θ"),
        ground_motion(60, FLOOR + 50),
        assumptions(
            "rock",
            "rigid block, rigid ground, in a plane",
            "rotation about one corner at a time",
            "no sliding, no flight",
            "restitution: ratio of θ' at an impact",
            "worn edges: inset",
        ),
    ]
    return page(WIDE, TALL, parts, "Assumptions of the model rock")


def jump():
    """Return a pavilion of two layers before and during its jump."""

    def pavilion(x, y, degrees):
        posts = tilted(x, y, 84, 92, degrees)
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

        def at(u, v):
            return x + u * c + v * s, y + u * s - v * c

        roof = [at(-102, 92), at(18, 92), at(18, 140), at(-102, 140)]
        return posts, roof

    initial, jumping = pavilion(140, FLOOR, 0), pavilion(250, FLOOR - 40, 6)
    parts = [
        ground(),
        *(block(corners, ghost=True) for corners in initial),
        *(block(corners) for corners in jumping),
        centre([(208, 118)]),
        f'<path d="M98 140 Q150 70 196 112" {CURVED} stroke="{ACCENT}" stroke-dasharray="6 4" marker-end="url(#red)"/>',
        ground_motion(60, FLOOR + 50),
        assumptions(
            "jump",
            "two rigid layers, one body",
            "no sliding during rocking",
            "one impact, two ratios e_x, e_y",
            "free flight, landing on one corner",
            "no vertical ground motion",
            "end when the tilt is back at zero",
        ),
    ]
    return page(WIDE, TALL, parts, "Assumptions of the model jump")


def respond():
    """Return the five modes of a block, side by side."""
    parts = [f'<path d="M20 150H600" stroke="{INK}" stroke-width="2"/>']
    spots = (("rest", 84, 150, 0), ("slide", 196, 150, 0), ("rock", 308, 150, 13), ("slide-rock", 420, 150, 13), ("flight", 536, 128, 16))
    for name, x, y, degrees in spots:
        body = tilted(x, y, 40, 88, degrees)
        parts += [block(tilted(x - (24 if "slide" in name else 0), 150, 40, 88, 0), ghost=True)] if name != "rest" else []
        parts += [block(body), text(x - 20, 178, name, size=14, anchor="middle", weight="bold")]
        parts += [arrow(x - 40, 158, x - 4, 158, colour=ACCENT, tip="red")] if "slide" in name else []
    rules = (
        "A mode lasts while its conditions hold: N ≥ 0, |T| ≤ μN, feet above the ground.",
        "At its end the first consistent mode in a fixed order follows. Impacts: Poisson's",
        "restitution along Routh's path at one corner, plastic at both corners.",
    )
    parts += [text(20, 214 + 24 * k, line, size=13.5, fill=SOFT) for k, line in enumerate(rules)]
    return page(WIDE, 286, parts, "The five modes of respond")


def spring(x, y, *, stretched=False):
    """Return a spring below a corner."""
    step = 7 if stretched else 5
    path = "".join(f"l{8 if k % 2 else -8} {step}" for k in range(6))
    return f'<path d="M{x} {y}v4{path}v4" fill="none" stroke="{SOFT}" stroke-width="1.6"/>'


def uplift():
    """Return a block on springs, one of them out of contact."""
    body = tilted(250, FLOOR - 42, 150, 150, 6)
    parts = [
        ground(),
        block(body),
        centre(body),
        spring(246, FLOOR - 42),
        spring(104, FLOOR - 38),
        arrow(100, FLOOR - 38, 100, FLOOR - 58, colour=ACCENT, tip="red"),
        text(60, FLOOR - 62, "lifts", size=13, fill=ACCENT),
        text(258, FLOOR - 10, "kₓ, k_y, k_z", size=13, fill=SOFT),
        ground_motion(60, FLOOR + 46),
        assumptions(
            "uplift",
            "rigid cuboid on four corner springs",
            "vertical springs in compression only",
            "horizontal springs always attached",
            "small rotations, no P-delta:",
            "no overturning",
        ),
    ]
    return page(WIDE, TALL, parts, "Assumptions of the model uplift")


def stack():
    """Return a gravestone of several stones, the top one tilted."""
    sizes = ((190, 34), (140, 34), (104, 38))
    parts, y = [ground()], FLOOR
    for wide, high in sizes:
        parts.append(block([(180 - wide / 2, y), (180 + wide / 2, y), (180 + wide / 2, y - high), (180 - wide / 2, y - high)]))
        y -= high
    top = tilted(206, y, 52, 120, 9)
    dots = [(206, y)] + [(180 + s * 52, FLOOR - 68) for s in (-1, 1)] + [(180 + s * 70, FLOOR - 34) for s in (-1, 1)]
    parts += [
        block(top),
        centre(top),
        *(f'<circle cx="{px}" cy="{py}" r="3.5" fill="{ACCENT}"/>' for px, py in dots),
        ground_motion(60, FLOOR + 46),
        assumptions(
            "stack",
            "rigid stones, in three dimensions",
            "rigid contacts with Coulomb friction,",
            "or springs and dashpots at points",
            "arbitrary tilts and falls",
            "leapfrog; steps end at impacts",
        ),
    ]
    return page(WIDE, TALL, parts, "Assumptions of the model stack")


DRAWN = (slide, rock, jump, respond, uplift, stack)

if __name__ == "__main__":
    for draw in DRAWN:
        (HERE / f"{draw.__name__}.svg").write_text(draw(), encoding="utf-8")
