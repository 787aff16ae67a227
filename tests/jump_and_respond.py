"""The table of docs/models/jump_and_respond.md: one pavilion under one record, by `jump` and by `respond`, step by step.

``python -m tests.jump_and_respond`` writes it down anew.
"""

import re
from pathlib import Path

from seisblock.bodies.toml import read_body_toml
from seisblock.bodies.two_layer import Contact, contact_from_table, two_layer_from_table
from seisblock.models.jump.solve import solve_jump
from seisblock.models.respond import solve_respond
from seisblock.readers import read
from seisblock.records import motion_of

PAGE = Path(__file__).parents[1] / "docs" / "models" / "jump_and_respond.md"
BEGIN, END = "<!-- computed -->", "<!-- end -->"
HEADINGS = ("step", "component", "rocking start (s)", "peak tilt (deg)", "flight (s)", "slip path (cm)", "residual (cm)")


def jump_numbers(motion, landing):
    """Return the numbers of the paper's jump: its first rocking, largest lean, time in the air, slip on landing, end."""
    block = two_layer_from_table(read_body_toml("chozusha"), "short")
    outcome = solve_jump(block, motion, contact=Contact(**contact_from_table(read_body_toml("chozusha"))), landing=landing).outcome
    lean = max(chain.max_rotation_rad for chain in outcome.chains)
    air = sum(chain.jump_duration_s or 0.0 for chain in outcome.chains)
    slid = sum(abs(chain.rock_slide_displacement_m or 0.0) for chain in outcome.chains)
    return outcome.chains[0].rocking_start_s, lean, air, slid, outcome.final_displacement_m


def respond_numbers(motion, **options):
    """Return the numbers of all motions together."""
    block = two_layer_from_table(read_body_toml("chozusha"), "short")
    outcome = solve_respond(block, motion, mu=0.18, mu_kinetic=0.17, sensitivity=False, **options).outcome
    starts = [event["time_s"] for event in outcome.events if event["mode"] in ("rock", "slide-rock")]
    air, end = outcome.time_in_mode_s["flight"], outcome.final_displacement_m
    return (starts[0] if starts else None), outcome.max_rotation_rad, air, outcome.slip_path_m, end


STEPS = (
    ("1 jump, as in the paper", lambda motion: jump_numbers(motion, "paper")),
    ("2 jump, landing with friction", lambda motion: jump_numbers(motion, "friction")),
    ("3 respond, no sliding, no restitution, no vertical motion", lambda motion: respond_numbers(motion, tenon=1e3, vertical=False)),
    ("4 as 3, with restitution 0.85", lambda motion: respond_numbers(motion, tenon=1e3, vertical=False, restitution=0.85)),
    ("5 as 4, with the vertical motion", lambda motion: respond_numbers(motion, tenon=1e3, restitution=0.85)),
    ("6 as 5, tenons 2 cm deep", lambda motion: respond_numbers(motion, tenon=0.02, restitution=0.85)),
    ("7 as 6, tenons 1 cm deep", lambda motion: respond_numbers(motion, tenon=0.01, restitution=0.85)),
    ("8 as 5, no tenons", lambda motion: respond_numbers(motion, restitution=0.85)),
)


def rows():
    """Return the table's rows, numbers as printed."""
    record = read("synthetic_jma.csv")
    collected = []
    for name, run in STEPS:
        for component in ("NS", "EW"):
            start, lean, air, slid, end = run(motion_of(record, component))
            message = "-" if start is None else f"{start:.3f}"
            numbers = (f"{57.29577951308232 * lean:.2f}", f"{air:.2f}", f"{100.0 * slid:.1f}", f"{round(100.0 * end, 1) + 0.0:+.1f}")
            collected.append((name, component, message, *numbers))
    return collected


def table():
    """Return the table in Markdown."""
    lines = [HEADINGS, tuple("---" for _ in HEADINGS), *rows()]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def page_table():
    """Return the table that the page holds."""
    return re.search(f"{BEGIN}\n(.*?)\n{END}", PAGE.read_text(encoding="utf-8"), re.DOTALL)[1]


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(text.replace(page_table(), table()), encoding="utf-8")
