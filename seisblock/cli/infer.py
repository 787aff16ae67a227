"""``seisblock infer``: what fallen stones or a displaced object say of the shaking."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path
from typing import Any

import click

from seisblock.bodies.inset import WORN
from seisblock.cli import offered
from seisblock.cli.bodies.options import landing_option, side_option, two_layer_option
from seisblock.cli.command import Command, option
from seisblock.cli.emit import emit
from seisblock.cli.idle import RECORD_OPTIONS, refuse_beside
from seisblock.cli.meant import OneOf
from seisblock.cli.options import Source, gravity_option, output_options, record_options
from seisblock.cli.output import Output
from seisblock.cli.talk import say
from seisblock.cli.types import FLOATS, INSET, LENGTH, MU, Count
from seisblock.words import noted, said, tell

DEFAULT_BLOCK = "chozusha"
FORMS = noted("--cemetery (with --rate, or with a column fallen), --slid or --jumped")

STONES = ("frequency", "criterion", "inset", "confidence", "common_error", "stone_error", "bias", "frequency_error")
SLID = ("mu", "mu_kinetic", "largest", "vertical", "limit", "steps", "gravity")
JUMPED = (
    *("block", "side", "mu", "mu_kinetic", "restitution_x", "restitution_y", "drop", "flight_only", "first", "repeat", "landing", "spin"),
    *("limit", "steps", "gravity"),
)
"""Options that each form reads."""


@click.command(
    cls=Command,
    examples=(
        "seisblock infer --rate 35/100 --cemetery aoyama.csv --plot shaking.png",
        "seisblock infer --slid 5cm --mu 0.3 record.csv",
    ),
)
@record_options
@option(
    "--cemetery",
    multiple=True,
    metavar="FILE|NAME",
    shell_complete=offered.cemeteries,
    section="Body",
    help="CSV of gravestones; a column fallen says which fell (1, yes, 転倒) and which stand (0, no, 残存); several: all of one shaking.",
)
@option("--rate", metavar="K/N", section="Body", help="K of N stones fell, in a place whose stones are proportioned as in --cemetery.")
@option("--slid", type=LENGTH, metavar="M", section="Body", help="How far an object slid, m or with a unit; needs --mu.")
@option("--jumped", type=LENGTH, metavar="M", section="Body", help="How far a two-layer block was displaced, m or with a unit.")
@two_layer_option(f"jumped: bundled body or TOML file. [default: {DEFAULT_BLOCK}]")
@side_option("jumped: which side of the block in plan lies along the motion.")
@option("--mu", type=MU, section="Body", help="slid: static friction, 1. jumped: of the landed foot. [default: jumped: the body's own]")
@option("--mu-kinetic", type=MU, section="Body", help="Kinetic friction, 1. [default: slid: as --mu; jumped: the body's own]")
@option("--restitution-x", type=float, section="Body", help="jumped: ratio of horizontal velocities at the impact. [default: the body's]")
@option("--restitution-y", type=float, section="Body", help="jumped: ratio of vertical velocities at the impact. [default: the body's]")
@option(
    "--drop", type=LENGTH, default=0.0, section="Body", help="jumped: height of the floor above the ground, m or with a unit. [default: 0]"
)
@option(
    "--frequency",
    type=FLOATS,
    metavar="HZ",
    help="Stones: equivalent frequency, Hz, or a list or range. [default: averaged over 0.5-3 Hz, and at 0.5, 1 ... 3]",
)
@option(
    "--criterion",
    type=OneOf(["furukawa", "rigid"]),
    default="furukawa",
    show_default=True,
    help="Stones: fit to whole stones (9), (10), or one rigid block under a half sine.",
)
@option(
    "--inset",
    type=INSET,
    metavar="SHARE|M",
    help="Stones, rigid: how far in from each side worn edges lie, a share of the width (0.1, 10%), or m with a unit (1cm). "
    "[default: 0.05]",
)
@option("--confidence", type=float, default=0.9, show_default=True, help="Stones: level of the intervals, 0 to 1.")
@option(
    "--common-error",
    type=float,
    help="Stones: standard deviation of ln PGA that all stones share (criterion, ground, record). [default: 0.3; 0.29 with --inset]",
)
@option("--stone-error", type=float, default=0.2, show_default=True, help="Stones: standard deviation of ln PGA of each stone by itself.")
@option(
    "--bias",
    type=float,
    help="Stones: how much more PGA records need than the criterion says, in ln PGA. [default: 0.33; 0.52 - 2.9 --inset; rigid: 0]",
)
@option("--frequency-error", type=float, default=0.1, show_default=True, help="Stones: standard deviation of ln f of a given frequency, 1.")
@option("--largest", is_flag=True, help="slid: the largest slip was observed, not the one left at the end.")
@option("--vertical", is_flag=True, help="slid: let the vertical component act too.")
@option("--flight-only", is_flag=True, help="jumped: the jump alone was observed, not the rocking-sliding after it.")
@option("--first", is_flag=True, help="jumped: the first chain of motion in the record counts. [default: all, added up]")
@option("--repeat", is_flag=True, hidden=True, help="jumped: all chains; since 0.2.0 the default.")
@landing_option("jumped: how a foot that lands is stopped, whatever friction that takes, or by what friction can bear.")
@option("--spin", default="momentum", show_default=True, metavar="momentum|printed|ratio=Q", help="jumped: spin after the impact.")
@option("--limit", type=float, default=3.0, show_default=True, help="slid, jumped: largest factor on a record.")
@option(
    "--steps",
    type=Count(noted("factors"), "SEISBLOCK_RUNS"),
    default=300,
    show_default=True,
    help="slid, jumped: steps of the scan up to it.",
)
@gravity_option
@output_options(histories=False, film=False)
def infer(source: Source, output: Output, cemetery: tuple[str, ...], rate: str | None, **asked: Any) -> None:
    """Read shaking back from what it did.

    From gravestones: PGA, PGV and JMA intensity with their intervals, for an equivalent frequency or over 0.5 to 3 Hz
    (Furukawa et al. 2009 read backwards). From a displacement: every factor on each candidate RECORD that gives it.
    """
    forms = {"--cemetery": cemetery or None, "--slid": asked["slid"], "--jumped": asked["jumped"]}
    asks = [name for name, value in forms.items() if value is not None]
    if len(asks) != 1:
        raise click.UsageError(tell("give one of {forms}; found {asks}", forms=said(FORMS), asks=asks or said("none")))
    refuse_beside(asks[0], _idle(asks[0], rigid=asked["criterion"] == "rigid"))
    if not cemetery:
        if rate is not None:
            raise click.UsageError(tell("--rate needs --cemetery, the proportions of the stones: for example aoyama.csv"))
        return _displacement(source, output, asked)
    if source.record:
        raise click.UsageError(
            tell("stones need no RECORD, found {record}; give its equivalent frequency with --frequency", record=source.record[0])
        )
    if len(cemetery) > 1 and rate is not None:
        raise click.UsageError(tell("--rate is of one place: several cemeteries need a column fallen each"))
    if twice := [name for name, count in Counter(os.path.realpath(name) for name in cemetery).items() if count > 1]:
        raise click.UsageError(tell("--cemetery names {name} twice: its stones would count double", name=Path(twice[0]).name))
    return _stones(output, cemetery, rate, asked)


def _idle(form: str, *, rigid: bool) -> list[str]:
    """Return the options that belong to other forms than that which was given; with rigid stones gravity has a say."""
    own = {"--cemetery": (*STONES, *(["gravity"] if rigid else [])), "--slid": SLID, "--jumped": JUMPED}
    of_forms = dict.fromkeys(name for names in (STONES, SLID, JUMPED) for name in names)
    return [name for name in of_forms if name not in own[form]] + (list(RECORD_OPTIONS) if form == "--cemetery" else [])


def _stones(output: Output, cemetery: tuple[str, ...], rate: str | None, asked: dict[str, Any]) -> None:
    """Answer from fallen stones."""
    from seisblock.bodies.cemetery.table import read_cemetery
    from seisblock.present.documents.infer import StonesParameters, stones_document
    from seisblock.studies.cemetery.rate import FREQUENCIES
    from seisblock.studies.inverse.estimate import contour, estimate_shaking, groups_of, remarks_of
    from seisblock.studies.inverse.joint import joint_estimate, remarks_of_joint
    from seisblock.studies.inverse.plausible import remark_on_plausibility
    from seisblock.studies.inverse.survey import counted_survey, marked_survey, parse_rate

    places = [read_cemetery(name) for name in cemetery]
    for name, place in zip(cemetery, places, strict=True):
        for note in place.notes[:1]:
            say("{cemetery}: {note}", cemetery=name, note=said(note))
    surveys = [(p.name, marked_survey(p) if rate is None else counted_survey(p, *parse_rate(rate))) for p in places]
    assumptions = _assumptions(asked)
    frequencies = asked["frequency"] or (None, *FREQUENCIES)
    several = len(surveys) > 1
    estimates = [
        estimate_shaking(part, f, assumptions, stones=f"{place}, {kind}" if several else kind)
        for place, survey in surveys
        for kind, part in groups_of(survey)
        for f in frequencies
    ]
    joint = [joint_estimate(surveys, f, assumptions) for f in frequencies] if several else []
    line = contour(surveys[0][1], assumptions)
    warnings = list(dict.fromkeys(text for each in estimates for text in remarks_of(each)))
    warnings += [text for name, survey in surveys if (text := remark_on_plausibility(name, survey, assumptions))]
    warnings += remarks_of_joint(joint[0]) if joint else []
    parameters = StonesParameters(
        cemetery=", ".join(cemetery),
        stones=sum(place.size for place in places),
        rate=rate,
        unknown_stones=0 if rate else sum(p.size - s.judged for p, (_, s) in zip(places, surveys, strict=True)),
        confidence=assumptions.level,
        common_error_ln_pga=assumptions.common_error,
        stone_error_ln_pga=assumptions.stone_error,
        bias_ln_pga=assumptions.bias,
        frequency_error_ln_f=assumptions.frequency_error,
        criterion=asked["criterion"],
        inset=asked["inset"] if asked["criterion"] != "rigid" else asked["inset"] or WORN,
    )
    answer = stones_document(estimates, line, parameters, warnings, joint)
    whole, name = surveys[0][1], ", ".join(place.name for place in places)

    def tables() -> Any:
        from seisblock.present.text.infer import estimate_tables

        return estimate_tables(name, estimates, joint, assumptions, gal=output.gal)

    def figure() -> Any:
        from seisblock.present.figures.infer import estimate_figure

        shown = [each for each in estimates if not several or each.stones.startswith(surveys[0][0])]
        return estimate_figure(surveys[0][0], whole, assumptions, shown, gal=output.gal)

    def csv(path: Path) -> None:
        from seisblock.present.files import write_table
        from seisblock.present.text.infer import estimate_columns

        write_table(path, *estimate_columns(line))

    emit(answer, output, tables=tables, figure=figure, csv=csv)


def _assumptions(asked: dict[str, Any]) -> Any:
    """Return what an estimate rests on: the criterion, and how far it and the stones are to be trusted."""
    from functools import partial

    from seisblock.studies.cemetery.limits import rigid_limits
    from seisblock.studies.inverse.assumptions import assumptions_for

    given = {name: asked[name] for name in ("common_error", "stone_error", "bias", "frequency_error")}
    given["level"] = asked["confidence"]
    if asked["criterion"] != "rigid":
        return assumptions_for(asked["inset"], **given)
    given["bias"] = 0.0 if given["bias"] is None else given["bias"]
    return assumptions_for(None, limits=partial(rigid_limits, inset=asked["inset"] or WORN, gravity=asked["gravity"]), **given)


def _displacement(source: Source, output: Output, asked: dict[str, Any]) -> None:
    """Answer from a displacement: every factor on each record."""
    from seisblock.cli.inputs import load, motions
    from seisblock.cli.progress import progress
    from seisblock.studies.inverse.factors import scale_factors

    if asked["slid"] is not None and asked["mu"] is None:
        raise click.UsageError(tell("--slid needs --mu, the static friction coefficient, for example --mu 0.3"))
    observed = asked["jumped"] if asked["slid"] is None else asked["slid"]
    moves, document = _moving_object(source, asked)
    curves: list[tuple[Any, Any]] = []
    # a jump goes on beyond the window in which it may start
    for record in load(source, whole=asked["jumped"] is not None):
        for motion in motions(record, source):
            displacement = moves(motion)
            with progress("{name}: factors up to {limit:g}", name=motion.name, limit=asked["limit"]) as advance:
                found = scale_factors(displacement, observed, motion, limit=asked["limit"], steps=asked["steps"], progress=advance)
            curves.append((record, found))
    answer = document(curves, observed_m=observed, limit=asked["limit"], steps=asked["steps"])

    def tables() -> Any:
        from seisblock.present.text.infer import factor_tables

        return factor_tables(curves, gal=output.gal, moved=noted("displacement") if asked["slid"] is None else noted("slip"))

    def figure() -> Any:
        from seisblock.present.figures.infer import factor_figure

        return factor_figure(curves, gal=output.gal)

    def csv(path: Path) -> None:
        from seisblock.present.files import write_table
        from seisblock.present.text.infer import factor_columns

        write_table(path, *factor_columns(curves))

    emit(answer, output, tables=tables, figure=figure, csv=csv)


def _moving_object(source: Source, asked: dict[str, Any]) -> tuple[Any, Any]:
    """Return what gives the displacement under a motion, and what makes a document of the factors."""
    from functools import partial

    from seisblock.bodies.sliding_base import SlidingBase
    from seisblock.present.documents.infer import jumped_document, slid_document
    from seisblock.studies.inverse import factors as study

    gravity = asked["gravity"]
    if asked["slid"] is not None:
        base = SlidingBase(asked["mu"], asked["mu_kinetic"])
        moves = partial(study.slid, base, vertical=asked["vertical"], gravity=gravity, largest=asked["largest"])
        rubs = {"mu": asked["mu"], "mu_kinetic": asked["mu_kinetic"]}
        return moves, partial(slid_document, largest=asked["largest"], vertical=asked["vertical"], gravity_m_s2=gravity, **rubs)
    from seisblock.cli.bodies.two_layer import two_layer_choice

    chosen = two_layer_choice(asked, default=DEFAULT_BLOCK)
    say("body: {name}; {says}", name=said(chosen.block.name), says=chosen.says)
    if asked["first"]:
        say("the first chain of motion in each record counts; without --first all are added up, as in seisblock jump")
    body: dict[str, Any] = {"contact": chosen.contact, "flight_only": asked["flight_only"]}
    body |= {key: asked[key] for key in ("spin", "landing", "first")}
    moves = partial(study.jumped, chosen.block, drop=asked["drop"], gravity=gravity, windows=source.window, **body)
    return moves, partial(jumped_document, block=chosen.block, drop_m=asked["drop"], gravity_m_s2=gravity, windows_s=source.window, **body)
