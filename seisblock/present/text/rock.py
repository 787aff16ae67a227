"""How rocking is told: a table with one column per component, and a sentence each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from seisblock.present.directions import side
from seisblock.present.edges import edges
from seisblock.present.scales import acceleration_unit
from seisblock.present.text.agreement import agreement_line, chance_lines
from seisblock.present.text.onset import ROCKS, onset
from seisblock.present.text.respond import around, falls_to
from seisblock.present.text.tables import acceleration, answered, line, number, seconds, side_by_side, table, told_acceleration
from seisblock.results import Response
from seisblock.solvers.rock.outcome import RockOutcome, friction_suffices
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.rocking.margin import Margin
from seisblock.words import noted, roughly, strung, tell

Rockings = Sequence[Response[RockOutcome]]


def tables(responses: Rockings, extras: Sequence[Mapping[str, Any]], *, gal: bool, mu: float | None = None) -> Iterator[Any]:
    """Yield, per record, its line, what becomes of the block in words, a table with a column per component, and how sure that is.

    Parameters
    ----------
    responses : sequence of Response
    extras : sequence of mapping
        What was found beside each: ``agreement``, ``margin``, ``perturbation``.
    gal : bool
    mu : float or None
        The friction there is, where it was said.
    """
    both = zip(responses, extras, strict=True)
    for opening, part in answered(both, lambda each: each[0].motion.record, lambda each: [line(first_line(each[0], mu, gal=gal))]):
        yield from opening
        yield _table([r for r, _ in part], gal=gal)
        for response, extra in part:
            for sentence in sentences(response, extra):
                yield line(sentence)
        yield line()
        for _, extra in part:
            if "directions" in extra:
                yield _directions(extra["directions"])


def _table(responses: Rockings, *, gal: bool) -> Any:
    """Return the table of the outcomes."""
    outcomes = [response.outcome for response in responses]
    first, body = outcomes[0], responses[0].body
    own = any(response.body != body for response in responses)
    title = tell(body.name)
    if not own:
        title = tell(
            "{body}: alpha {alpha:.4f} rad, p {p:.3f} rad/s\nrestitution {restitution:.4f}, rocks above {threshold}",
            body=tell(body.name),
            alpha=first.slenderness_rad,
            p=first.frequency_parameter_rad_s,
            restitution=first.restitution,
            threshold=told_acceleration(first.threshold_m_s2, gal=gal),
        ) + (f"\n{tell(worn)}" if (worn := edges(body, gal=gal)) else "")
    rows: list[tuple[str, list[Any]]] = _own(outcomes, gal=gal) if own else []
    rows += [
        (f"PGA ({acceleration_unit(gal=gal).name})", [acceleration(float(np.abs(r.motion.horizontal).max()), gal=gal) for r in responses]),
        (tell("rocking starts (s)"), [seconds(o.rocking_start_s) for o in outcomes]),
        (tell("largest lean (deg)"), [f"{math.degrees(o.max_rotation_rad):.3f}" for o in outcomes]),
        (tell("  over alpha"), [number(o.max_rotation_ratio) for o in outcomes]),
        (tell("  at (s)"), [seconds(o.max_rotation_s) for o in outcomes]),
        (tell("impacts"), [o.impacts for o in outcomes]),
        (tell("overturned"), [_fell(response) for response in responses]),
        (tell("  alpha passed (s)"), [seconds(o.alpha_passed_s) for o in outcomes]),
        (tell("  lies down (s)"), [seconds(o.overturning_time_s) for o in outcomes]),
        (tell("friction needed"), [number(o.max_friction_demand) for o in outcomes]),
        (tell("  at (s)"), [seconds(o.max_friction_demand_s) for o in outcomes]),
        (tell("contact lost (s)"), [seconds(o.contact_lost_s) for o in outcomes]),
    ]
    return side_by_side(title, ["", *(r.motion.name or "x" for r in responses)], [[heading, *cells] for heading, cells in rows])


def _own(outcomes: Sequence[RockOutcome], *, gal: bool) -> list[tuple[str, list[Any]]]:
    """Return the rows of a body that is another block in each direction."""
    unit = acceleration_unit(gal=gal).name
    return [
        (tell("alpha (rad)"), [f"{o.slenderness_rad:.4f}" for o in outcomes]),
        (tell("p (rad/s)"), [f"{o.frequency_parameter_rad_s:.3f}" for o in outcomes]),
        (tell("restitution"), [f"{o.restitution:.4f}" for o in outcomes]),
        (tell("rocks above ({unit})", unit=unit), [acceleration(o.threshold_m_s2, gal=gal) for o in outcomes]),
    ]


def _directions(found: Sequence[RockAzimuth]) -> Any:
    """Return the table of all directions, in their order; the slenderness where it is not the same in all."""
    own = len({each.slenderness_rad for each in found}) > 1
    rows = [
        [
            f"{each.azimuth_deg:g}",
            *([f"{math.degrees(each.slenderness_rad):.2f}"] if own else []),
            number(each.max_rotation_ratio),
            *_ends(each),
        ]
        for each in sorted(found, key=lambda each: each.azimuth_deg)
    ]
    headings = (
        noted("azimuth (deg)"),
        *((noted("alpha (deg)"),) if own else ()),
        noted("lean over alpha"),
        noted("falls to (deg)"),
        noted("lies down (s)"),
    )
    return table(tell("All azimuths"), [tell(heading) for heading in headings], rows)


def _ends(each: RockAzimuth) -> tuple[str, str]:
    """Return where to it falls in one direction, and when."""
    return falls_to(each.azimuth_deg, each.overturned_towards), seconds(each.overturning_time_s)


def _onset(response: Response[RockOutcome], *, gal: bool) -> str:
    """Return from where on a block that stands still rocks."""
    options, arms = response.options, response.body.arms
    weakest = response.outcome.threshold_m_s2 / options["gravity_m_s2"] / min(arms)
    towards = (arms[0] * weakest, arms[1] * weakest)
    return onset(ROCKS, towards, response.motion, gravity=options["gravity_m_s2"], vertical=options["vertical"], gal=gal)


def first_line(response: Response[RockOutcome], mu: float | None = None, *, gal: bool = True) -> str:
    """Return the verdict, from where on what stands still rocks, and that it takes more friction than there is where that is so."""
    outcome, name = response.outcome, response.motion.name or "x"
    what = verdict(outcome, response.motion.name)
    if not outcome.rocks:
        what = tell("{verdict}; {onset}", verdict=what, onset=_onset(response, gal=gal))
    told = tell("{name}: {verdict}.", name=name, verdict=what)
    if mu is None or friction_suffices(outcome, mu, response.options["gravity_m_s2"]):
        return told
    ratio = outcome.threshold_m_s2 / response.options["gravity_m_s2"]
    if mu < ratio:
        text = noted("With a friction of {mu:g}, less than b/h, {ratio:.3f}, it would slide and not rock: this is not what happens.")
        return strung([told, tell(text, mu=mu, ratio=ratio)])
    if outcome.max_friction_demand is None:
        return strung([told, tell("It leaves the ground, so that no friction suffices: this is not what happens.")])
    text = noted("That needs a friction of {needed:.2f} at {time:.3f} s, and there is {mu:g}: it would slip while it rocks.")
    return strung([told, tell(text, needed=outcome.max_friction_demand, time=outcome.max_friction_demand_s, mu=mu)])


def sentences(response: Response[RockOutcome], extra: Mapping[str, Any]) -> Iterator[str]:
    """Yield how far the models disagree, the margins and the share of perturbed runs."""
    name = response.motion.name or "x"
    if "agreement" in extra:
        yield agreement_line(name, extra["agreement"])
    if "directions" in extra:
        yield around(extra["directions"])
    if "margin" in extra:
        yield from (tell("{name}: {text}", name=name, text=told) for told in _margin_lines(extra["margin"]))
    if "perturbation" in extra:
        yield from (tell("{name}: {text}", name=name, text=told) for told in chance_lines(extra["perturbation"], response.body))


def _fell(response: Response[RockOutcome]) -> str:
    """Return whether a block overturned, and where to."""
    outcome = response.outcome
    return tell("to {side}", side=side(response.motion.name, outcome.overturned_towards)) if outcome.overturned else tell("no")


def verdict(outcome: RockOutcome, direction: str) -> str:
    """Return what became of a block under a motion in a direction, and whether a small change would change it."""
    fell = side(direction, outcome.overturned_towards)
    if not outcome.rocks:
        told = tell("stands still")
    elif not outcome.overturned:
        told = tell("rocks and stands: {way}", way=way_to_alpha(outcome.max_rotation_ratio))
    elif outcome.overturning_time_s is None:
        told = tell("overturns to {side}", side=fell)
    else:
        late = outcome.decided_after_record
        text = noted("overturns to {side} at {time:.2f} s, after the record") if late else noted("overturns to {side} at {time:.2f} s")
        told = tell(text, side=fell, time=outcome.overturning_time_s)
    return told + flip(outcome)


def flip(outcome: RockOutcome) -> str:
    """Return at which factor near 1 the verdict is the other, empty where none was found or nobody looked."""
    if outcome.flips_at_factor is None:
        return ""
    would = noted("; it would stand at {factor:.3f} times this record"), noted("; it would fall at {factor:.3f} times this record")
    text = would[0] if outcome.overturned else would[1]
    return tell(text, factor=outcome.flips_at_factor)


def way_to_alpha(ratio: float) -> str:
    """Return how far a block leaned, in words."""
    return tell("{share} of the way to alpha", share=roughly(ratio))


def _margin_lines(margin: Margin) -> Iterator[str]:
    """Yield the first fall found, how often it falls above, and the windows in which it does."""
    if margin.first_fall is None or margin.falls_above_first is None:
        yield tell("stands at every factor looked at, up to {limit:g} (every {step:g}).", limit=margin.limit, step=margin.step)
        return
    yield tell(
        "falls from {first:.3g} times this record on (first found, looked at every {step:g} up to {limit:g}); above that at {share:.0%} of "
        "the factors.",
        first=margin.first_fall,
        step=margin.step,
        limit=margin.limit,
        share=margin.falls_above_first,
    )
    unsafe = [window for window in margin.windows if window.overturned]
    shown = [tell("{first:.4f} to {last:.4f}", first=w.first, last=w.last) for w in unsafe[:8]] + ["..."] * (len(unsafe) > 8)
    yield tell("falls were found at factors {factors}.", factors=shown)
    if margin.nearest_flip is not None:
        yield tell("the verdict changes next at a factor of {factor:.4f}, of those found.", factor=margin.nearest_flip)
