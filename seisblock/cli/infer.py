"""``seisblock infer``: ground motion estimated from fallen gravestones or displaced objects."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path
from typing import Any

import click

from seisblock.bodies.body_name import body_name
from seisblock.bodies.edge_wear import DEFAULT_WEAR
from seisblock.bodies.kinds import KINDS
from seisblock.cli.bodies.options import DEFAULT_TWO_LAYER, block_option, cemetery_option, inset_option, side_option, stones_option
from seisblock.cli.build import gravity_option
from seisblock.cli.command import Command, option
from seisblock.cli.console import info
from seisblock.cli.option_checks import RECORD_OPTIONS, reject_with
from seisblock.cli.options import Source, displaced_record_options, output_options
from seisblock.cli.output import OutputOptions
from seisblock.cli.suggest import SuggestingChoice
from seisblock.cli.types import ANGLE, LENGTH, MU, PEAK_UNITS, Count, Quantities
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.core.limits import MAX_RUNS
from seisblock.models.jump.options import LANDINGS

FORM_NAMES = N_("--cemetery (with --rate, or with a column fallen), --slid, --jumped or --twist")

STONE_OPTIONS = ("frequency", "criterion", "inset", "confidence", "common_error", "stone_error", "bias", "frequency_error", "stones")
SLID_OPTIONS = ("mu", "mu_kinetic", "largest", "vertical", "limit", "steps", "gravity")
JUMPED_OPTIONS = (
    *("block", "side", "mu", "mu_kinetic", "restitution_x", "restitution_y", "drop", "flight_only", "first", "repeat", "landing", "spin"),
    *("limit", "steps", "gravity"),
)
TWIST_OPTIONS = (
    *("block", "width", "height", "depth", "kind", "mu", "inset", "vertical", "displacement", "runs", "seed", "confidence"),
    *("limit", "gravity"),
)
"""Options of each form of the command."""


@click.command(
    cls=Command,
    essential=("--cemetery", "--rate", "--slid", "--jumped", "--twist", "--mu", "--frequency", "--criterion", "--inset"),
    examples=(
        "seisblock infer --rate 35/100 --cemetery aoyama.csv --plot shaking.png",
        "seisblock infer --slid 5cm --mu 0.3 record.csv",
        "seisblock infer --twist 3 --width 24cm --height 60cm --mu 0.5 record.csv",
    ),
)
@displaced_record_options
@cemetery_option(
    "Table of gravestones (.csv, .xlsx); column fallen: 1, yes, 転倒 (overturned) or 0, no, 残存 (standing). Several surveys of one "
    "earthquake: repeat the option.",
    multiple=True,
)
@stones_option
@option("--rate", metavar="K/N", section="Body", help="Count: K of N stones overturned; proportions of the stones as in --cemetery.")
@option("--slid", type=LENGTH, metavar="M", section="Body", help="Displacement of an object that slid, m or with a unit; needs --mu.")
@option("--jumped", type=LENGTH, metavar="M", section="Body", help="Displacement of a two-layer block that jumped, m or with a unit.")
@option("--twist", type=ANGLE, metavar="DEG", section="Body", help="Residual rotation of an object about the vertical, degrees.")
@option(
    "--displacement", type=LENGTH, metavar="M", section="Body", help="--twist: residual displacement of the same object, m or with a unit."
)
@block_option(f"--jumped, --twist: bundled body or TOML file. [default: --jumped: {DEFAULT_TWO_LAYER}]", "two-layer")
@option("--width", type=LENGTH, section="Body", help="--twist: width along the component, m or with a unit.")
@option("--height", type=LENGTH, section="Body", help="--twist: height, m or with a unit.")
@option("--depth", type=LENGTH, section="Body", help="--twist: depth, m or with a unit. [default: as the width]")
@option("--kind", type=SuggestingChoice(KINDS), section="Body", help="--twist: kind of a body given by its sizes. [default: block]")
@side_option("--jumped: side of the block in plan along the motion.")
@option(
    "--mu",
    type=MU,
    section="Body",
    help="Static friction coefficient (--jumped: of the foot that landed). [default: --jumped: value of the body]",
)
@option(
    "--mu-kinetic", type=MU, section="Body", help="Kinetic friction coefficient. [default: --slid: as --mu; --jumped: value of the body]"
)
@option(
    "--restitution-x",
    type=float,
    section="Body",
    help="--jumped: ratio of horizontal velocities at the impact. [default: value of the body]",
)
@option(
    "--restitution-y", type=float, section="Body", help="--jumped: ratio of vertical velocities at the impact. [default: value of the body]"
)
@option(
    "--drop",
    type=LENGTH,
    section="Body",
    help="--jumped: height of the floor above the ground, m or with a unit. [default: value of the body, else 0]",
)
@option(
    "--frequency",
    type=Quantities(PEAK_UNITS["HZ"]),
    metavar="HZ",
    help="Stones: equivalent frequency, Hz; number, list or range. [default: mean over 0.5-3 Hz, and 0.5, 1 ... 3]",
)
@option(
    "--criterion",
    type=SuggestingChoice(["furukawa", "rigid"]),
    default="furukawa",
    show_default=True,
    help="Stones: fitted criteria (9), (10) for whole gravestones, or one rigid block under a half sine.",
)
@inset_option(
    "Stones, rigid, --twist: inset of worn edges per side, share of the width (0.1, 10%), or m with a unit (1cm). [default: 0.05]",
    section="Solver",
)
@option("--confidence", type=float, default=0.9, show_default=True, help="Stones, --twist: confidence level of the intervals, 0 to 1.")
@option(
    "--common-error",
    type=float,
    help="Stones: standard deviation of ln PGA common to all stones (criterion, ground, record). [default: 0.24; 0.22 with --inset]",
)
@option("--stone-error", type=float, default=0.2, show_default=True, help="Stones: standard deviation of ln PGA of a single stone.")
@option(
    "--bias",
    type=float,
    help="Stones: bias of the criterion, ln PGA of records over ln PGA of the criterion. [default: 0.35; 0.51 - 3.2 --inset; rigid: 0]",
)
@option("--frequency-error", type=float, default=0.1, show_default=True, help="Stones: standard deviation of ln f of the given frequency.")
@option("--largest", is_flag=True, help="--slid: the maximum displacement was observed, not the residual.")
@option(
    "--vertical/--no-vertical",
    default=None,
    help="--slid, --twist: apply or omit the vertical component. [default: applied where the record has one]",
)
@option("--flight-only", is_flag=True, help="--jumped: the jump alone was observed, without the slide-rocking after it.")
@option("--first", is_flag=True, help="--jumped: use only the first chain of motion in the record. [default: sum of all]")
@option("--repeat", is_flag=True, hidden=True, help="--jumped: sum of all chains of motion; the default since 0.2.0.")
@option(
    "--landing",
    type=SuggestingChoice(LANDINGS),
    default="paper",
    show_default=True,
    help="--jumped: friction at the landing of the foot, unlimited (paper) or Coulomb friction (friction).",
)
@option(
    "--spin", default="momentum", show_default=True, metavar="momentum|printed|ratio=Q", help="--jumped: angular velocity after the impact."
)
@option("--limit", type=float, default=3.0, show_default=True, help="--slid, --jumped, --twist: largest scale factor on a record.")
@option(
    "--steps",
    type=Count(N_("factors"), MAX_RUNS),
    default=300,
    show_default=True,
    help="--slid, --jumped: number of factors in the scan.",
)
@option(
    "--runs",
    type=Count(N_("runs"), MAX_RUNS, minimum=1),
    default=600,
    show_default=True,
    help="--twist: runs per record, of factors and bodies drawn at random.",
)
@option("--seed", type=int, default=0, show_default=True, help="--twist: seed of the runs.")
@gravity_option
@output_options(histories=False, film=False)
def infer(source: Source, output: OutputOptions, cemetery: tuple[str, ...], rate: str | None, **params: Any) -> None:
    """Ground motion estimated from its effects: fallen gravestones or a displaced object.

    Gravestones give PGA, PGV and JMA intensity with their intervals, for one equivalent frequency or over 0.5 to 3 Hz (inverse of
    Furukawa et al. 2009). A displacement gives, for each candidate RECORD, all scale factors that reproduce it. A residual twist, with
    or without the displacement, gives the interval of factors from runs in three dimensions; several RECORDs are candidates of one
    station, whose PGA follows.
    """
    forms = {"--cemetery": cemetery or None, "--slid": params["slid"], "--jumped": params["jumped"], "--twist": params["twist"]}
    given_forms = [name for name, value in forms.items() if value is not None]
    if len(given_forms) != 1:
        raise click.UsageError(
            gettext(
                "exactly one of {forms} is required; found {asks}", forms=lazy_gettext(FORM_NAMES), asks=given_forms or lazy_gettext("none")
            )
        )
    reject_with(given_forms[0], _foreign_options(given_forms[0], rigid=params["criterion"] == "rigid"))
    if not cemetery:
        if rate is not None:
            raise click.UsageError(gettext("--rate requires --cemetery (proportions of the stones), for example aoyama.csv"))
        if params["twist"] is not None:
            return _infer_from_twist(source, output, params)
        return _infer_from_displacement(source, output, params)
    if source.record:
        raise click.UsageError(
            gettext("RECORD {record} has no effect with stones: give its equivalent frequency with --frequency", record=source.record[0])
        )
    if len(cemetery) > 1 and rate is not None:
        raise click.UsageError(gettext("--rate applies to one cemetery: several cemeteries require a column fallen each"))
    if repeated := [name for name, count in Counter(os.path.realpath(name) for name in cemetery).items() if count > 1]:
        raise click.UsageError(gettext("--cemetery contains {name} twice: give each cemetery only once", name=Path(repeated[0]).name))
    return _infer_from_stones(output, cemetery, rate, params)


def _foreign_options(form: str, *, rigid: bool) -> list[str]:
    """Return the options of the other forms; gravity acts on rigid stones."""
    form_options = {
        "--cemetery": (*STONE_OPTIONS, *(["gravity"] if rigid else [])),
        "--slid": SLID_OPTIONS,
        "--jumped": JUMPED_OPTIONS,
        "--twist": TWIST_OPTIONS,
    }
    all_options = dict.fromkeys(name for names in (STONE_OPTIONS, SLID_OPTIONS, JUMPED_OPTIONS, TWIST_OPTIONS) for name in names)
    return [name for name in all_options if name not in form_options[form]] + (list(RECORD_OPTIONS) if form == "--cemetery" else [])


def _infer_from_stones(output: OutputOptions, cemetery: tuple[str, ...], rate: str | None, params: dict[str, Any]) -> None:
    from seisblock.bodies.cemetery.table import read_cemetery
    from seisblock.report.json.infer import INTENSITY_OF_STONES, INTENSITY_OF_VELOCITY, StonesParameters, stones_document
    from seisblock.report.text import infer as text_output
    from seisblock.report.text.stones import PLACE_COLUMNS, write_stones
    from seisblock.studies.survey.consistency import consistency_warning
    from seisblock.studies.survey.estimate import estimate_shaking, estimate_warnings, fitted_stones, frequency_contour, stone_groups
    from seisblock.studies.survey.joint import joint_estimate, joint_warnings
    from seisblock.studies.survey.likelihood import counted_survey, marked_survey, parse_rate
    from seisblock.studies.survey.overturning_rate import FREQUENCIES

    places = [read_cemetery(name) for name in cemetery]
    for name, site in zip(cemetery, places, strict=True):
        for note in site.notes[:1]:
            info("{cemetery}: {note}", cemetery=name, note=lazy_gettext(note))
    surveys = [(p.name, marked_survey(p) if rate is None else counted_survey(p, *parse_rate(rate))) for p in places]
    assumptions = _assumptions(params)
    frequencies = params["frequency"] or (None, *FREQUENCIES)
    has_several = len(surveys) > 1
    answers = [
        (estimate_shaking(part, f, assumptions, stones=f"{site}, {kind}" if has_several else kind), fitted_stones(part, f, assumptions))
        for site, survey in surveys
        for kind, part in stone_groups(survey)
        for f in frequencies
    ]
    estimates = [estimate for estimate, _ in answers]
    joint = [joint_estimate(surveys, f, assumptions) for f in frequencies] if has_several else []
    line = frequency_contour(surveys[0][1], assumptions)
    warnings = list(dict.fromkeys(text for estimate in estimates for text in estimate_warnings(estimate)))
    warnings += [text for name, survey in surveys if (text := consistency_warning(name, survey, assumptions))]
    warnings += joint_warnings(joint[0]) if joint else []
    parameters = StonesParameters(
        cemetery=", ".join(cemetery),
        stones=sum(site.size for site in places),
        rate=rate,
        unknown_stones=0 if rate else sum(p.size - s.stone_count for p, (_, s) in zip(places, surveys, strict=True)),
        confidence=assumptions.level,
        common_error_ln_pga=assumptions.common_error,
        stone_error_ln_pga=assumptions.stone_error,
        bias_ln_pga=assumptions.bias,
        frequency_error_ln_f=assumptions.frequency_error,
        criterion=params["criterion"],
        inset=params["inset"] if params["criterion"] != "rigid" else params["inset"] or DEFAULT_WEAR,
        intensity=INTENSITY_OF_VELOCITY if params["criterion"] == "rigid" else INTENSITY_OF_STONES,
    )
    if parameters.unknown_stones:
        info("{count} of {stones} stones omitted: overturning unknown", count=parameters.unknown_stones, stones=parameters.stones)
    # all stones of each place, at the first frequency
    at_places = [(place, fitted_stones(survey, frequencies[0], assumptions)) for place, survey in surveys]
    answer = stones_document(answers, line, parameters, warnings, joint, at_places)
    if params["stones"] is not None:
        write_stones(params["stones"], PLACE_COLUMNS, [([place], stones) for place, stones in at_places])
        info("wrote {file}", file=str(params["stones"]))
    first_survey, name = surveys[0][1], ", ".join(site.name for site in places)

    def figure() -> Any:
        from seisblock.report.figures.infer import estimate_figure

        selection = [estimate for estimate in estimates if not has_several or estimate.stones.startswith(surveys[0][0])]
        return estimate_figure(surveys[0][0], first_survey, assumptions, selection, gal=output.gal)

    write_results(
        answer,
        output,
        tables=lambda: text_output.estimate_tables(name, estimates, joint, assumptions, gal=output.gal),
        figure=figure,
        csv=lambda: text_output.estimate_csv(line),
    )


def _assumptions(params: dict[str, Any]) -> Any:
    """Return the assumptions of an estimate: criterion, bias and standard deviations."""
    from functools import partial

    from seisblock.studies.survey.assumptions import make_assumptions
    from seisblock.studies.survey.limits import rigid_limits

    options = {name: params[name] for name in ("common_error", "stone_error", "bias", "frequency_error")}
    options["level"] = params["confidence"]
    if params["criterion"] != "rigid":
        return make_assumptions(params["inset"], **options)
    options["bias"] = 0.0 if options["bias"] is None else options["bias"]
    return make_assumptions(None, limits=partial(rigid_limits, inset=params["inset"] or DEFAULT_WEAR, gravity=params["gravity"]), **options)


def _infer_from_displacement(source: Source, output: OutputOptions, params: dict[str, Any]) -> None:
    from seisblock.cli.load_records import iter_motions
    from seisblock.cli.progress import progress
    from seisblock.records._validation import vertical_acts
    from seisblock.report.text import infer as text_output
    from seisblock.studies.survey.scale_search import scale_factors

    if params["slid"] is not None and params["mu"] is None:
        raise click.UsageError(gettext("friction required: --slid needs --mu (static coefficient), for example --mu 0.3"))
    observed = params["jumped"] if params["slid"] is None else params["slid"]
    displacement_function, document = _moving_object(source, params)
    curves: list[tuple[Any, Any]] = []
    motions = []
    # a jump continues beyond the window in which rocking may start
    for motion in iter_motions(source, keep_whole=params["jumped"] is not None):
        motions.append(motion)
        displacement = displacement_function(motion)
        with progress("{name}: factors up to {limit:g}", name=motion.name, limit=params["limit"]) as advance:
            factors = scale_factors(displacement, observed, motion, limit=params["limit"], steps=params["steps"], progress=advance)
        curves.append((motion.record, factors))
    options = {} if params["slid"] is None else {"vertical": vertical_acts(motions, params["vertical"])}
    answer = document(curves, observed_m=observed, limit=params["limit"], steps=params["steps"], **options)
    write_results(
        answer,
        output,
        tables=lambda: text_output.factor_tables(
            curves, gal=output.gal, displacement_kind=N_("displacement") if params["slid"] is None else N_("slip")
        ),
        figure=figure_of("infer:factor_figure", curves, gal=output.gal),
        csv=lambda: text_output.factor_csv(curves),
    )


def _infer_from_twist(source: Source, output: OutputOptions, params: dict[str, Any]) -> None:
    from itertools import islice

    from seisblock.cli.bodies.free_standing import choose_free_standing
    from seisblock.cli.load_records import load_records, selected_motions
    from seisblock.cli.progress import progress
    from seisblock.models.rigid3d.options import Rigid3dOptions
    from seisblock.records._validation import vertical_acts
    from seisblock.report.json.infer import twist_document
    from seisblock.report.text import infer as text_output
    from seisblock.studies.survey.twist import infer_twist, pooled_pga

    choice = choose_free_standing({**params, "side": None, "mu_kinetic": None, "gal": output.gal})
    info("body: {says}", says=choice.description)
    options = Rigid3dOptions(mu=choice.mu, vertical=params["vertical"], gravity=params["gravity"])
    results, motions = [], []
    for record in load_records(source):
        # all components act: without --component one direction of x suffices
        for motion in islice(selected_motions(record, source), None if source.component else 1):
            with progress("{name}: factors up to {limit:g}", name=motion.name, limit=params["limit"]) as advance:
                estimate = infer_twist(
                    choice.body,
                    motion,
                    options,
                    params["twist"],
                    displacement_m=params["displacement"],
                    limit=params["limit"],
                    runs=params["runs"],
                    level=params["confidence"],
                    seed=params["seed"],
                    progress=advance,
                )
            results.append((record, estimate))
            motions.append(motion)
    station = pooled_pga([estimate for _, estimate in results], params["confidence"]) if len(results) > 1 else None
    answer = twist_document(
        results,
        station,
        body=choice.body,
        twist_deg=params["twist"],
        displacement_m=params["displacement"],
        mu=choice.mu,
        vertical=vertical_acts(motions, params["vertical"]),
        gravity_m_s2=params["gravity"],
        limit=params["limit"],
        confidence=params["confidence"],
        seed=params["seed"],
    )
    write_results(
        answer,
        output,
        tables=lambda: text_output.twist_tables(results, station, level=params["confidence"], limit=params["limit"], gal=output.gal),
        figure=figure_of("infer:twist_figure", results, gal=output.gal),
        csv=lambda: text_output.twist_csv(results),
    )


def _moving_object(source: Source, params: dict[str, Any]) -> tuple[Any, Any]:
    """Return the displacement function of a motion and the document builder of the factors."""
    from functools import partial

    from seisblock.bodies.sliding_base import SlidingBase
    from seisblock.models.jump.options import JumpOptions
    from seisblock.models.slide.options import SlideOptions
    from seisblock.report.json.infer import jumped_document, slid_document
    from seisblock.studies.survey import scale_search as study

    gravity = params["gravity"]
    if params["slid"] is not None:
        base = SlidingBase(params["mu"], params["mu_kinetic"])
        options = SlideOptions(vertical=params["vertical"], gravity=gravity)
        displacement_function = partial(study.slide_displacement, base, options=options, largest=params["largest"])
        frictions = {"mu": params["mu"], "mu_kinetic": params["mu_kinetic"]}
        return displacement_function, partial(slid_document, largest=params["largest"], gravity_m_s2=gravity, **frictions)
    from seisblock.cli.bodies.two_layer import two_layer_choice

    choice = two_layer_choice(params)
    info("body: {name}; {says}", name=body_name(choice.block.name), says=choice.description)
    if params["first"]:
        info("--first: only the first chain of motion in each record counts; without --first all are added, as in seisblock jump")
    drop = choice.base.get("drop", 0.0) if params["drop"] is None else params["drop"]
    body: dict[str, Any] = {"contact": choice.contact, "flight_only": params["flight_only"]}
    body |= {key: params[key] for key in ("spin", "landing", "first")}
    jump_options = JumpOptions(
        contact=choice.contact,
        drop=drop,
        spin=params["spin"],
        landing=params["landing"],
        first=params["first"],
        windows=source.window,
        gravity=gravity,
    )
    displacement_function = partial(study.jump_displacement, choice.block, options=jump_options, flight_only=params["flight_only"])
    return displacement_function, partial(
        jumped_document, block=choice.block, drop_m=drop, gravity_m_s2=gravity, windows_s=source.window, **body
    )
