"""Draw architecture.svg and conventions.svg: ``python docs/figures/draw.py``."""

import math
from pathlib import Path

HERE = Path(__file__).parent
INK, SOFT, ACCENT, PAPER = "#222", "#6b6b6b", "#c0392b", "#ffffff"

LAYERS = (
    ("cli", "options, one library call, one presentation"),
    ("report", "documents, text and figures of studies, HTML pages"),
    ("validation", "evidence: cases by paper, exporting CASES"),
    ("studies", "many runs: respond, rocking, survey, fragility, hazard, map, batch, fit"),
    ("models", "one folder per model: equations, outcome, text, figure, document"),
    ("output", "toolkit of presentation, which knows no model"),
    ("criteria", "closed forms"),
    ("bodies | measures | readers", "body descriptions | one number per record | file formats"),
    ("dynamics", "event-driven engine"),
    ("records", "records, motions, processing, quality control"),
    ("samples | references | _jit", "bundled files | bibliography | compiled kernels"),
    ("core", "errors, units, messages, results, limits, safe input and output"),
)


def text(x, y, content, *, size=15, weight="normal", fill=INK, anchor="start", style=""):
    """Return one line of text."""
    return (
        f'<text x="{x:.6g}" y="{y:.6g}" font-size="{size}" font-weight="{weight}" fill="{fill}" text-anchor="{anchor}" {style}>'
        + content.replace("&", "&amp;").replace("<", "&lt;")
        + "</text>"
    )


def page(width, height, parts, title):
    """Return a drawing on white paper."""
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-family="Helvetica, Arial, sans-serif" role="img"><title>{title}</title>',
            '<defs><marker id="tip" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
            f'<path d="M0 0 10 5 0 10z" fill="{INK}"/></marker>'
            '<marker id="red" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
            f'<path d="M0 0 10 5 0 10z" fill="{ACCENT}"/></marker></defs>',
            f'<rect width="{width}" height="{height}" fill="{PAPER}"/>',
            *parts,
            "</svg>\n",
        ]
    )


def architecture():
    """Return the layers, top first, and the path of the data."""
    parts = []
    for k, (name, contents) in enumerate(LAYERS):
        y = 20 + 58 * k
        shade = "#f3efe8" if k % 2 else "#faf7f2"
        parts.append(f'<rect x="20" y="{y}" width="640" height="50" rx="4" fill="{shade}" stroke="#bdb4a4"/>')
        parts.append(text(36, y + 21, name, weight="bold"))
        parts.append(text(36, y + 40, contents, size=12.5, fill=SOFT))
    bottom = 20 + 58 * len(LAYERS)
    parts.append(f'<line x1="690" y1="40" x2="690" y2="{bottom - 24}" stroke="{INK}" stroke-width="1.5" marker-end="url(#tip)"/>')
    parts.append(text(704, 290, "imports", size=13, style='transform="rotate(90 704 290)"', anchor="middle"))
    parts.append(text(20, bottom + 24, "data:", size=13, weight="bold"))
    steps = ("file", "readers", "Record", "Motion + body", "models", "Response", "studies", "report", "cli")
    x = 66
    for k, step in enumerate(steps):
        wide = 7.4 * len(step)
        parts.append(text(x, bottom + 24, step, size=13))
        x += wide + 4
        if k < len(steps) - 1:
            parts.append(f'<line x1="{x}" y1="{bottom + 20}" x2="{x + 17}" y2="{bottom + 20}" stroke="{ACCENT}" marker-end="url(#red)"/>')
            x += 23
    return page(730, bottom + 44, parts, "Layers of seisblock")


def tilted(x, y, width, height, degrees):
    """Return the corners of a rectangle turned clockwise about its lower right corner at (x, y)."""
    angle = math.radians(degrees)
    c, s = math.cos(angle), math.sin(angle)
    corners = ((0, 0), (-width, 0), (-width, height), (0, height))
    return [(x + u * c + v * s, y + u * s - v * c) for u, v in corners]


def arrow(x1, y1, x2, y2, *, colour=INK, tip="tip", both=False):
    """Return an arrow."""
    start = f' marker-start="url(#{tip})"' if both else ""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" stroke-width="1.5" '
        f'marker-end="url(#{tip})"{start}/>'
    )


def conventions():
    """Return a tilted block with axes, and the compass with an azimuth."""
    ground, corner = 330, 250
    body = tilted(corner, ground, 110, 220, 14)
    outline = " ".join(f"{x:.1f},{y:.1f}" for x, y in body)
    upright = tilted(corner, ground, 110, 220, 0)
    ghost = " ".join(f"{x:.1f},{y:.1f}" for x, y in upright)
    centre = sum(x for x, _ in body) / 4, sum(y for _, y in body) / 4
    parts = [
        f'<line x1="40" y1="{ground}" x2="470" y2="{ground}" stroke="{INK}" stroke-width="2"/>',
        f'<polygon points="{ghost}" fill="none" stroke="#aaa" stroke-dasharray="5 4"/>',
        f'<polygon points="{outline}" fill="#f4d9c6" stroke="{ACCENT}" stroke-width="2"/>',
        f'<circle cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="4" fill="{INK}"/>',
        text(centre[0] + 9, centre[1] + 5, "G"),
        arrow(60, ground + 52, 180, ground + 44, colour=ACCENT, tip="red"),
        text(60, ground + 76, "ground acceleration a, + along the component (north, east)", size=13, fill=ACCENT),
        arrow(400, ground, 400, ground - 80),
        text(408, ground - 70, "z, + up"),
        arrow(400, ground, 480, ground),
        text(468, ground - 10, "+x", anchor="middle"),
        f'<path d="M{corner - 55} {ground - 236} A240 240 0 0 1 {corner + 48} {ground - 228}" fill="none" stroke="{INK}" '
        'stroke-width="1.5" marker-end="url(#tip)"/>',
        text(corner + 62, ground - 222, "rotation +"),
        text(corner + 62, ground - 203, "tilt to +x", size=13, fill=SOFT),
        text(corner + 8, ground + 18, "pivot: right corner", size=12.5, fill=SOFT),
        arrow(140, ground + 14, 250, ground + 14, both=True),
        text(195, ground + 30, "width B", size=12.5, anchor="middle"),
        '<circle cx="640" cy="190" r="95" fill="none" stroke="#bbb"/>',
        arrow(640, 190, 640, 80),
        text(640, 70, "N (NS +), 0°", anchor="middle"),
        arrow(640, 190, 752, 190),
        text(758, 195, "E (EW +), 90°"),
        arrow(640, 190, 640 + 105 * math.sin(math.radians(37)), 190 - 105 * math.cos(math.radians(37)), colour=ACCENT, tip="red"),
        text(706, 94, "--component 37", fill=ACCENT, size=13),
        text(640, 312, "azimuths: degrees clockwise from north;", size=13, fill=SOFT, anchor="middle"),
        text(640, 330, "the third component is U, positive upwards", size=13, fill=SOFT, anchor="middle"),
    ]
    return page(880, 420, parts, "Axes and signs of seisblock")


if __name__ == "__main__":
    (HERE / "architecture.svg").write_text(architecture(), encoding="utf-8")
    (HERE / "conventions.svg").write_text(conventions(), encoding="utf-8")
