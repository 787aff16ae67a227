"""Command lines as dice would type them: options drawn from what each command declares, with values that fit and values that do not."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import click
import numpy as np

from seisblock.cli import main
from tests.bodies.meshes import box, write_obj, write_stl

SAMPLES = 150
RECORDS = ("small.csv", "offset.csv", "counts.knt", "late.NS", "cut.csv", "empty.csv", "stones.csv", "wide.toml", "nowhere.csv", ".", "-")
"""Names that a command line may give for a record; the first are records."""

STRANGE = (
    "",
    "x",
    "nan",
    "inf",
    "-1",
    "0",
    "1e-320",
    "1e308",
    "-1e9",
    "24",
    "1,2,3",
    "1:2",
    "1:0:1",
    "0:1:1e-9",
    "٣",
    "\x1b[31mred",
    "$x_{$",
    "9" * 400,
)
SIZES = ("0.2", "24cm", "8sun", "0.63", "1")
"""Lengths that fit."""

FITTING: dict[str, Sequence[str]] = {
    "component": ("NS", "EW", "UD", "all", "37", "NS,EW", "400", "-20"),
    "scale": ("1", "3", "-1", "0"),
    "target_pga": ("700", "100"),
    "jma": ("6+", "5弱", "4.2", "9", "x"),
    "target_jma": ("6+", "5弱", "4.2", "9", "x"),
    "window": ("0.2:1", ":1", "0.5:", "0.3:0.31", "5:9"),
    "floor": ("T=0.6", "T=0.3,zeta=0.1,height=1", "T=0.001", "T=0", "height=0.5", "T=5,zeta=1e-9"),
    "highpass": ("0.5", "5", "49", "51"),
    "format": ("CSV", "KNET", "JMA-CSV", "OBSPY:MSEED", "OBSPY:PICKLE"),
    "units": ("gal", "m/s2", "g", "furlong"),
    "dt": ("0.01", "0.02"),
    "station": ("NIG019", "all"),
    "csv": ("out.csv", "-", "small.csv", "nowhere/out.csv", "."),
    "plot": ("out.png", "out.svg", "out.xyz", "small.csv", "/dev/null"),
    "animate": ("out.xyz", "small.csv"),
    "slow": ("1", "2"),
    "grid": ("13", "29"),
    "block": ("gravestone", "chozusha", "wagata", "body.toml", "wide.toml", "small.csv", "nobody"),
    "stones": ("wagata", "lantern", "column", "body.toml", "pile.toml"),
    "body": ("gravestone", "chozusha", "24cm x 72cm", "24x72", "body.toml", "wide.toml"),
    "cemetery": ("aoyama.csv", "stones.csv", "small.csv"),
    "mu": ("0.2", "0.18", "0.5", "0.1:0.4:0.1"),
    "mu_kinetic": ("0.1", "0.5"),
    "kappa": ("0.1", "0.1,0.3"),
    "masses": ("1000,100", "1t,100kg"),
    "heights": ("1,2", "1m,200cm"),
    "stiffness": ("1e6,1e6,1e6", "1e6"),
    "frequency_vertical": ("8", "0.1"),
    "frequency_ratio": ("0.5:1:0.25", "0.8"),
    "frequency": ("1", "0.5,1,2"),
    "sizes": ("0.2:0.6:0.2", "0.3"),
    "frequency_parameter": ("2:6:2",),
    "height_over_width": ("2:4:1",),
    "slenderness_rad": ("0.2:0.4:0.1",),
    "pga": ("100:500:200", "3"),
    "inset": ("0.1", "10%", "1cm", "0.6", "0.8"),
    "rate": ("3/10", "30%", "11/10", "1/0"),
    "surface": ("granite/granite", "ice/ice"),
    "threshold": ("100gal", "0.1g", "100"),
    "spin": ("up", "none", "1"),
    "azimuth": ("0,90", "37", "north"),
    "without": ("sao", "nothing"),
    "fix": ("gedai",),
    "runs": ("2", "5"),
    "perturb": ("2", "5"),
    "steps": ("3", "5"),
    "contact": ("edges", "grid=3"),
    "step": ("1e-4", "1e-3", "1"),
    "seed": ("1", "-1", "99999999999999999999"),
    "paper": ("Tsutsui", "Nobody"),
    "name": ("synthetic_jma.csv", "nothing"),
    "copy": ("nothing",),
    "resume": ("small.csv", "nowhere"),
    "o": ("out.html", "small.csv", "."),
    "html": ("out.html", "small.csv"),
    "margin_limit": ("1.2", "2"),
    "settle": ("1", "0", "1e9"),
    "limit": ("1.5",),
    "confidence": ("0.9", "1", "90"),
    "outcomes": ("outcomes.csv", "outcomes.csv", "stones.csv", "small.csv", "empty.csv"),
    "free": ("alpha", "p", "inset", "alpha,p", "none", "mu"),
    "bodies": ("gravestone", "gravestone,chozusha", "list.csv", "body.toml", "wide.toml", "small.csv"),
    "out": ("table.csv", "table.parquet", "small.csv", "nowhere/table.csv", ".", "/dev/null"),
    "cluster": ("local:0", "local:x", "local:"),
    "workers": ("1", "2"),
    "geojson": ("map.geojson", "small.csv", "/dev/full"),
    "survey": ("places.csv", "stones.csv", "empty.csv"),
    "suite": ("synthetic:M6.5:R15:2", "synthetic:M99:R15:2", "synthetic:M6:R0:2", "nothing"),
    "suite_out": ("records", "small.csv", "nowhere/records"),
    "pelicun": ("curves.csv", "curves.xml", "small.csv"),
    "nrml": ("curves.xml", "small.csv"),
    "im": ("pga", "pgv", "sa=0.5", "arias", "p*pgv", "pgx", "pga,pgv", "sa=1e-9"),
    "levels": ("0.1:0.5:0.2", "1"),
    "compare": ("nobody",),
    "bootstrap": ("2", "20"),
    "hazard": ("synthetic_hazard.csv", "synthetic_hazard.csv", "hazard.csv", "small.csv", "empty.csv"),
    "fragility": ("curves.json", "curves.json", "small.csv", "empty.csv"),
    "median": ("60cm/s", "0.6", "0.4g", "100gal"),
    "scan": ("boulder.ply", "box.stl", "box.obj", "small.csv", "body.toml"),
    "tolerance": ("1mm", "0.5", "9"),
    "facing": ("0", "37", "400"),
    "size": ("18x12", "7inx5in", "0x0", "1e9x1"),
    "dpi": ("72", "29"),
    "title": ("", "$x_{$", "[bold]red", "long " * 300),
    "bounds": ("alpha=0.1:0.5", "p=2:8", "alpha=1", "inset=0:0.6"),
    "scatter": ("0.05", "0"),
    "folds": ("2", "3", "9"),
}
"""By the name of the option; others are lengths, shares or whole numbers, by their kind."""

ALWAYS = {
    "validate": ["--quick"],
    "respond": ["--runs", "2"],
    "map": ["--runs", "2", "--workers", "1"],
    "batch": ["--workers", "1"],
    "fragility": ["--steps", "3", "--bootstrap", "20"],
    "stack": ["--contact", "edges", "--grid", "13"],
    "spectrum": ["--steps", "3"],
    "rigid3d": ["--runs", "2"],
}
"""Words that keep a command short, unless the dice say otherwise later on the line."""

COMMONLY = {
    "rock": ["--block", "gravestone"],
    "respond": ["--block", "gravestone"],
    "rigid3d": ["--block", "gravestone", "--mu", "0.5"],
    "scenario": ["--bodies", "list.csv", "--mu", "0.5"],
    "secure": ["--width", "0.3", "--height", "0.9", "--mu", "0.5"],
    "slide": ["--mu", "0.2"],
    "uplift": ["--width", "1", "--height", "3", "--frequency-vertical", "8"],
    "criteria": ["--block", "gravestone"],
    "infer": ["--slid", "5cm", "--mu", "0.2"],
    "overturn-rate": ["--cemetery", "aoyama.csv"],
    "report": ["-o", "out.html"],
    "batch": ["--bodies", "gravestone", "--solver", "rock", "--force", "--out", "table.csv"],
    "map": ["--block", "gravestone", "--mu", "0.5"],
    "fragility": ["offset.csv", "--block", "gravestone", "--solver", "rock", "--im", "pga"],
    "risk": ["--hazard", "synthetic_hazard.csv", "--median", "60cm/s", "--beta", "0.4"],
    "fit": ["--block", "gravestone", "--free", "alpha", "--runs", "1", "--component", "NS"],
}
"""Words that most lines have, so that the dice come past the first question."""

ELSEWHERE = {"cluster"}
"""Options whose strange values would be looked for in the network."""

SLOW = {"validate", "report", "fit", "secure"}
"""Commands that take a second or more, drawn rarely."""


def write_files(folder: Path, knet: str) -> None:
    """Write the files that the lines name; several contradict themselves."""
    t = np.arange(SAMPLES) * 0.01
    rows = [400 * np.sin(2 * np.pi * f * t) * np.exp(-(((t - 0.7) / 0.3) ** 2)) for f in (2.0, 3.0, 5.0)]
    table = "time,NS (gal),EW (gal),UD (gal)\n" + "".join(f"{x:.2f},{a:.3f},{b:.3f},{c:.3f}\n" for x, a, b, c in zip(t, *rows, strict=True))
    (folder / "small.csv").write_text(table)
    (folder / "offset.csv").write_text("NS (g)\n" + "".join(f"{0.3 + a / 980:.4f}\n" for a in rows[0]))
    (folder / "counts.knt").write_text(knet)
    (folder / "late.NS").write_text(knet.replace("Memo.", "Memo. \x1b[31m$x_{$[bold]"))
    (folder / "cut.csv").write_text(table[: len(table) // 2])
    (folder / "empty.csv").write_text("")
    (folder / "stones.csv").write_text("height (cm),width (cm),fallen,count\n" + "".join(f"{40 + 4 * i},22,{i % 2},2\n" for i in range(12)))
    shaken = (f"{name},{scale},{scale // 2}\n" for name in ("small.csv", "counts.knt", "nowhere.csv") for scale in range(4))
    (folder / "list.csv").write_text("name,width (cm),height\nslender,20,1\n=2+2,12,40cm\n[bold]$x_{$,80cm,1.2\n")
    (folder / "places.csv").write_text("place,latitude,longitude,stones,fallen\n<b>=cmd()</b>,37.3,138.9,20,4\nB,37,138,30,0\n")
    (folder / "hazard.csv").write_text("pga_g,annual_rate\n0.1,0.1\n0.4,0.01\n0.8,0.02\n")
    curve = {"body": "<b>", "limit": "overturn", "im": "pgv", "unit": "m/s", "median": 0.6, "beta": 0.4}
    (folder / "curves.json").write_text(json.dumps({"schema": "seisblock/fragility/1", "results": [curve]}))
    write_stl(folder / "box.stl", *box(0.4, 0.3, 1.1))
    write_obj(folder / "box.obj", *box(0.4, 0.3, 1.1))
    (folder / "outcomes.csv").write_text("record,scale,fell\n" + "".join(shaken))
    (folder / "body.toml").write_text(
        'kind = "block"\nname = "\x24x_{\x24 [bold]"\nwidth = "24cm"\nheight = 0.7\nmu = 0.4\nrestitution = 0.9\n'
    )
    (folder / "wide.toml").write_text('kind = "block"\nwidth = true\nheight = [1]\nmu = "x"\n')
    (folder / "pile.toml").write_text(
        'kind = "pile"\n' + "".join(f'[[stone]]\nname = "s{i}"\nwidth = {0.5 - 0.1 * i}\ndepth = 0.4\nheight = 0.2\n' for i in range(2))
    )


def line(command: str, rng: np.random.Generator) -> list[str]:
    """Return the words after ``seisblock``."""
    declared = main.get_command(click.Context(main), command)
    assert declared is not None
    words = [command, *ALWAYS.get(command, ())]
    if rng.random() < 0.75:
        words += COMMONLY.get(command, ())
    options = [p for p in declared.params if isinstance(p, click.Option)]
    arguments = [p for p in declared.params if isinstance(p, click.Argument)]
    for argument in arguments:
        if argument.name == "record":
            count = int(rng.choice([0, 1, 1, 1, 1, 1, 1, 2]))
            good = rng.random(count) < 0.8
            words += [str(rng.choice(RECORDS[:4] if g else RECORDS)) for g in good] or (["small.csv"] if rng.random() < 0.97 else [])
        else:
            words.append(_value(argument, rng))
    for option in rng.choice(np.array(options, dtype=object), size=int(rng.integers(0, 5))):
        name = str(rng.choice([*option.opts, *option.secondary_opts]))
        words += [name] if option.is_flag else [name, _value(option, rng)]
    if rng.random() < 0.03:
        words.insert(int(rng.integers(len(words) + 1)), str(rng.choice(["--no-such", "-x", "--", "--json=1", "\udcff"])))
    return [word.replace("\0", "") for word in words]


def _value(parameter: click.Parameter, rng: np.random.Generator) -> str:
    """Return a value for an option: one that fits, more often than not."""
    if rng.random() < 0.3 and parameter.name not in ELSEWHERE:
        return str(rng.choice(STRANGE))
    if isinstance(parameter.type, click.Choice):
        return str(rng.choice(list(parameter.type.choices)))
    fitting = FITTING.get(str(parameter.name))
    if fitting is None:
        fitting = SIZES if parameter.type.name == "length" else ("1", "2", "3") if "integer" in parameter.type.name else ("0.1", "0.5", "1")
    return str(rng.choice(list(fitting)))
