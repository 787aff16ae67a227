"""Text report of a jump: a table as in the paper and a sentence per chain of motion."""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Sequence
from itertools import zip_longest
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.core.results import Response
from seisblock.models.jump.chain import COMPLETE, Chain, ChainOutcome
from seisblock.models.jump.segments import exceeds
from seisblock.models.jump.solve import JumpOutcome, leaves_mortise
from seisblock.output.directions import direction_label, format_displacement
from seisblock.output.text.section import SEVERE, Section
from seisblock.output.text.shaking import shaking_lines
from seisblock.output.text.tables import Part, format_acceleration, format_seconds, group_answers, side_by_side, styled_line, with_notes
from seisblock.output.text.threshold import ROCKS, threshold_text
from seisblock.output.units_display import Unit, format_length, format_size, length_cell, length_unit

JumpResponses = Sequence[Response[JumpOutcome]]


_ROWS: tuple[tuple[str, str], ...] = (
    (N_("rocking start (s)"), "rocking_start_s"),
    (N_("impact (s)"), "impact_s"),
    (N_("landing (s)"), "landing_s"),
    (N_("end (s)"), "end_s"),
    (N_("above threshold (s)"), "time_above_threshold_s"),
    (N_("rocking (s)"), "rocking_duration_s"),
    (N_("jump (s)"), "jump_duration_s"),
    (N_("slide-rock (s)"), "rock_slide_duration_s"),
)


_LENGTHS: tuple[tuple[str, str], ...] = (
    (N_("rise in jump ({unit})"), "max_rise_m"),
    (N_("jump distance ({unit})"), "jump_displacement_m"),
    (N_("slide-rock distance ({unit})"), "rock_slide_displacement_m"),
    (N_("total distance ({unit})"), "total_displacement_m"),
)


_ALL = frozenset(key for _, key in (*_ROWS, *_LENGTHS))
_DECISIVE = frozenset(("rocking_start_s", "landing_s", "time_above_threshold_s", "max_rise_m", "total_displacement_m"))
"""Results of the largest chain in the shortened answer, beside direction, tilt and friction."""


MAX_CHAINS = 6
"""Most chains in the table: those with the largest displacement, in order of time."""


MIN_VELOCITY = 0.005
"""Smallest angular velocity printed with two decimals, rad/s; smaller values are printed with one digit."""


def tables(responses: JumpResponses, *, gal: bool, printed: JumpResponses = (), combinations: int = 1) -> Iterator[Any]:
    """Yield, per component, the verdict and a table with a column per chain as in [Sugimoto2017]_ table 1; in short the largest chains.

    Parameters
    ----------
    responses : sequence of Response
    gal : bool
    printed : sequence of Response
        Of the paper's own scheme, one per response.
    combinations : int
        Number of combinations of side, drop and restitution; several are compared by their first chains.
    """
    if combinations > 1:
        yield from _first_chains(responses, printed, gal=gal)
        return
    for heading, part in group_answers(responses, lambda item: item.motion.record, lambda item: [styled_line(describe(item, gal=gal))]):
        yield from heading
        full = [block for response in part for block in _details(response, gal=gal)]
        moving = [response for response in part if response.outcome.chains]
        yield from [Part(tuple(full), tuple(_largest_chains(moving, gal=gal)))] if moving else full
    if printed:
        yield from _first_chains(responses, printed, gal=gal)


def _largest_chains(responses: JumpResponses, *, gal: bool) -> Iterator[Any]:
    """Yield a table with the largest chain of each component, and the effect of the highest rise on tenons."""
    outcomes = [response.outcome for response in responses]
    indices = [max(range(len(o.chains)), key=lambda i: _size(o.chains[i])) for o in outcomes]
    chains = [outcome.chains[i] for outcome, i in zip(outcomes, indices, strict=True)]
    names = [response.motion.name for response in responses]
    title = gettext(
        "{body}, rocking threshold {threshold}; largest chain of motion",
        body=gettext(responses[0].body.name),
        threshold=format_acceleration(outcomes[0].rocking_threshold_m_s2, gal=gal),
    )
    places = [gettext("{number} of {count}", number=i + 1, count=len(o.chains)) for i, o in zip(indices, outcomes, strict=True)]
    yield side_by_side(title, ["", *names], [[gettext("chain"), *places], *_cells(chains, names, gal=gal, keys=_DECISIVE)])


def _first_chains(responses: JumpResponses, printed: JumpResponses, *, gal: bool) -> Iterator[Any]:
    """Yield a table of the first chain of each response and of the paper's own scheme, as [Sugimoto2017]_ table 1."""
    columns: list[tuple[str, Response[JumpOutcome]]] = []
    for response, paper in zip_longest(responses, printed):
        columns.append((gettext("corrected") if printed else "", response))
        columns += [] if paper is None else [(gettext("as printed"), paper)]
    with_chains = [(scheme, response) for scheme, response in columns if response.outcome.chains]
    for scheme, response in columns:
        if not response.outcome.chains and not scheme.startswith(gettext("as printed")):
            yield styled_line(describe(response, gal=gal))
    if not with_chains:
        return
    chains = [response.outcome.chains[0] for _, response in with_chains]
    names = [response.motion.name for _, response in with_chains]
    sizes = [abs(chain.total_displacement_m) for chain in chains if chain.total_displacement_m is not None]
    if sizes and not printed:
        unit = length_unit(sizes, gal=gal)
        held_count = sum(chain.outcome == ChainOutcome.IN_MORTISES for chain in chains)
        text = (
            N_("First chain of {count} runs: total displacement {low} to {high} {unit}; {jumps} jump, {held} stay in the mortises.")
            if held_count
            else N_("First chain of {count} runs: total displacement {low} to {high} {unit}; {jumps} jump.")
        )
        yield styled_line(
            gettext(
                text,
                count=len(chains),
                low=length_cell(min(sizes), unit),
                high=length_cell(max(sizes), unit),
                unit=unit.name,
                jumps=sum(chain.outcome == ChainOutcome.JUMPED for chain in chains),
                held=held_count,
            )
        )
    rows = [] if not printed else [[gettext("scheme"), *(scheme for scheme, _ in with_chains)]]
    rows += [
        [gettext("body"), *(gettext(response.body.name) for _, response in with_chains)],
        [gettext("drop (m)"), *(f"{response.options.drop:g}" for _, response in with_chains)],
        [gettext("restitution y"), *(f"{response.options.contact.restitution_y:g}" for _, response in with_chains)],
        [gettext("spin ratio"), *(f"{response.outcome.spin_ratio:.4f}" for _, response in with_chains)],
        *_cells(chains, names, gal=gal),
    ]
    if any(response.options.tenon for _, response in with_chains):
        inside = [chain.outcome == ChainOutcome.IN_MORTISES or chain.foot_rise_m is None for chain in chains]
        states = [gettext("no") if stays else gettext("yes") for stays in inside]
        rows.append([gettext("tenons leave their mortises"), *states])
    yield side_by_side(gettext("First chain of motion"), ["", *names], rows)


def _details(response: Response[JumpOutcome], *, gal: bool) -> Iterator[Any]:
    """Yield the table of one component and the sentences on its chains."""
    outcome = response.outcome
    chain_indices = _table_chains(outcome.chains)
    if chain_indices:
        title = gettext(
            "{name}: {body}, rocking threshold {threshold}",
            name=response.motion.name,
            body=gettext(response.body.name),
            threshold=format_acceleration(outcome.rocking_threshold_m_s2, gal=gal),
        )
        chains = [outcome.chains[i] for i in chain_indices]
        cells = _cells(chains, [response.motion.name] * len(chains), gal=gal)
        yield side_by_side(title, [gettext("chain"), *(str(i + 1) for i in chain_indices)], cells)
    for sentence in sentences(response, gal=gal):
        yield styled_line(sentence)
    yield from shaking_lines([response], gal=gal)
    if chain_indices:
        yield styled_line()


def _table_chains(chains: Sequence[Chain]) -> list[int]:
    """Return the indices of the chains in the table."""
    by_size = sorted(range(len(chains)), key=lambda i: -_size(chains[i]))
    return sorted(by_size[:MAX_CHAINS])


def _size(chain: Chain) -> float:
    """Return the displacement of a chain, m; infinite for an incomplete one."""
    return abs(chain.total_displacement_m or math.inf)


def _cells(chains: Sequence[Chain], names: Sequence[str], *, gal: bool, keys: Container[str] = _ALL) -> Iterator[list[str]]:
    """Yield the table rows, a column per chain with the name of its component; of the timed and measured rows those in `keys`."""
    yield [gettext("direction"), *(direction_label(name, chain.direction) for name, chain in zip(names, chains, strict=True))]
    for heading, key in _ROWS:
        if key in keys:
            yield [gettext(heading), *(format_seconds(getattr(chain, key)) for chain in chains)]
    yield [gettext("peak tilt (deg)"), *(f"{math.degrees(chain.max_rotation_rad):.2f}" for chain in chains)]
    yield [gettext("impact velocity (rad/s)"), *(_format_or_dash(chain.impact_velocity_rad_s, "{:z.3f}") for chain in chains)]
    unit = length_unit((getattr(chain, key) for chain in chains for _, key in _LENGTHS), gal=gal)
    for heading, key in _LENGTHS:
        if key in keys:
            yield [gettext(heading, unit=unit.name), *(length_cell(getattr(chain, key), unit) for chain in chains)]
    yield [gettext("friction required to land"), *(_format_friction(chain.friction_needed_at_landing) for chain in chains)]


def _format_or_dash(value: float | None, form: str) -> str:
    return "-" if value is None else form.format(value)


def _format_friction(friction: float | None) -> str:
    """Return P_x/P_y of a landing; infinite if the ground would have to pull."""
    return "-" if friction is None else f"{friction:.2f}" if math.isfinite(friction) else gettext("none suffices")


def _displacement_unit(outcome: JumpOutcome, *, gal: bool) -> Unit:
    """Return the common unit of the displacements of all chains."""
    return length_unit([outcome.final_displacement_m, *(chain.total_displacement_m for chain in outcome.chains)], gal=gal)


def describe(response: Response[JumpOutcome], *, gal: bool = True) -> str:
    """Return the final outcome and the friction required for it."""
    outcome, name = response.outcome, response.motion.name or "x"
    if not outcome.chains:
        gravity = response.options.gravity
        share = outcome.rocking_threshold_m_s2 / gravity
        onset_text = threshold_text(ROCKS, (share, share), response.motion, gravity=gravity, gal=gal)
        return gettext("{name}: remains at rest; {onset}.", name=name, onset=onset_text)
    jumps = sum(chain.outcome == ChainOutcome.JUMPED for chain in outcome.chains)
    if outcome.outcome not in COMPLETE:
        text = N_("{name}: {outcome} in chain {count} of motion, displacement {moved}.")
    elif leaves_mortise(response) is False:
        text = N_("{name}: the feet rise at most {foot}, less than the tenons of {tenon}: stays in the mortises, without displacement.")
    elif jumps == 0:
        text = N_("{name}: rocks without jumping, {count} chains of motion.")
    elif leaves_mortise(response):
        text = N_("{name}: leaves the mortises, the feet rise {foot}, more than the tenons of {tenon}; stands {moved} from its place.")
    elif len(outcome.chains) == 1:
        text = N_("{name}: jumps; final displacement {moved}.")
    else:
        text = N_("{name}: jumps {jumps} times in {count} chains of motion; final displacement {moved}.")
    displacement = format_displacement(outcome.final_displacement_m, name, _displacement_unit(outcome, gal=gal))
    rise = max((chain.foot_rise_m or 0.0 for chain in outcome.chains), default=0.0)
    unit = length_unit([rise, response.options.tenon], gal=gal)
    foot, tenon = (f"{length_cell(length, unit)} {unit.name}" for length in (rise, response.options.tenon))
    values = {"outcome": gettext(outcome.outcome), "moved": displacement, "count": len(outcome.chains), "jumps": jumps}
    sentence = gettext(text, name=name, foot=foot, tenon=tenon, **values)
    return with_notes(sentence, [*_friction_caveats(response)])


def _friction_caveats(response: Response[JumpOutcome]) -> Iterator[str]:
    """Yield a note where the result requires more friction than given."""
    mu, friction = response.options.contact.mu, response.outcome.friction_needed_at_landing
    ratio = response.body.width / 2 / response.body.centroid_height
    if mu < ratio:
        text = N_(
            "The model assumes feet that do not slide; with a friction coefficient of {mu:g} < b/h = {ratio:.2f} the feet slide "
            "before the block rocks."
        )
        yield gettext(text, mu=mu, ratio=ratio)
    if friction is not None and exceeds(friction, mu):
        if math.isfinite(friction):
            yield gettext(
                "Landing without slip requires a friction coefficient of {needed:.2f}; the given one is {mu:g}.", needed=friction, mu=mu
            )
        else:
            yield gettext("No friction coefficient suffices for landing without slip.")


def sentences(response: Response[JumpOutcome], *, gal: bool = True) -> Iterator[str]:
    """Yield one sentence per chain of the table, and the notes."""
    chains, name, tenon = response.outcome.chains, response.motion.name, response.options.tenon
    chain_indices, unit = _table_chains(chains), _displacement_unit(response.outcome, gal=gal)
    for number, chain in ((i + 1, chains[i]) for i in chain_indices):
        if chain.outcome == ChainOutcome.JUMPED and chain.total_displacement_m is not None:
            yield gettext(
                "Chain {number}: jumps {moved} after {rocking:.3f} s of rocking; ground acceleration above the "
                "threshold for {above:.3f} s.",
                number=number,
                moved=format_displacement(chain.total_displacement_m, name, unit),
                rocking=chain.rocking_duration_s,
                above=chain.time_above_threshold_s,
            )
        else:
            yield gettext("Chain {number}: {outcome}.", number=number, outcome=gettext(chain.outcome))
        if tenon and chain.foot_rise_m is not None and chain.max_rise_m is not None:
            yield _tenon_text(chain.foot_rise_m, chain.max_rise_m, tenon, gal=gal)
    if len(chain_indices) < len(chains):
        max_displacement = max(abs(chain.total_displacement_m or 0.0) for i, chain in enumerate(chains) if i not in chain_indices)
        yield gettext(
            "Displacement in the {count} other chains: at most {least} each.",
            count=len(chains) - len(chain_indices),
            least=format_size(max_displacement, unit),
        )
    residual_velocity = max(
        (chain.end_angular_velocity_rad_s or 0.0 for chain in chains if chain.outcome == ChainOutcome.JUMPED), default=0.0
    )
    if residual_velocity > 0.0 and response.outcome.landing != "friction":
        text = N_("The chain ends at zero tilt, as in the paper's model; the remaining angular velocity (up to {most} rad/s) is ignored.")
        yield gettext(text, most=f"{residual_velocity:.2f}" if residual_velocity >= MIN_VELOCITY else f"{residual_velocity:.1g}")


def _tenon_text(foot: float, centroid: float, tenon: float, *, gal: bool) -> str:
    """Return whether a tenon leaves its mortise; rise of the lowest foot and of the centroid, tenon length, all in m."""
    if foot > tenon:
        text = N_("Tenon of {tenon}: the lowest foot rises {foot} (centroid {centroid}); the tenon leaves the mortise.")
    else:
        text = N_(
            "Tenon of {tenon}: the lowest foot rises only {foot} (centroid {centroid}); the tenon stays in the mortise, "
            "and the block does not move away."
        )
    unit = length_unit([foot, centroid, tenon], gal=gal)
    # same precision as the table: nearly equal lengths are compared
    rose, middle, hole = (f"{length_cell(length, unit)} {unit.name}" for length in (foot, centroid, tenon))
    return gettext(text, foot=rose, centroid=middle, tenon=hole)


def _severity(outcome: JumpOutcome) -> float:
    return SEVERE + abs(float(outcome.final_displacement_m)) if outcome.outcome == ChainOutcome.JUMPED else 1.0 if outcome.chains else 0.0


def _short_verdict(response: Response[JumpOutcome]) -> str:
    outcome, name = response.outcome, response.motion.name
    if outcome.outcome == ChainOutcome.JUMPED:
        return gettext("jump, displacement {moved}", moved=format_displacement(float(outcome.final_displacement_m), name))
    return gettext("rocking without jump" if outcome.chains else "no motion")


def _chain_sentences(response: Response[JumpOutcome]) -> Iterator[str]:
    """Yield a sentence on each chain of motion, for the report."""
    outcome = response.outcome
    if not outcome.chains:
        yield gettext("The ground acceleration does not exceed the rocking threshold.")
    unit = length_unit((length for chain in outcome.chains for length in (chain.total_displacement_m, chain.max_rise_m)), gal=True)
    for number, chain in enumerate(outcome.chains, start=1):
        if chain.outcome == ChainOutcome.JUMPED:
            displacement = chain.total_displacement_m or 0.0
            text = N_("Chain {number}, rocking {rock:.3f} s, flight {fly:.3f} s, displacement {moved}, rise of the centroid {rise}.")
            yield gettext(
                text,
                number=number,
                rock=chain.rocking_duration_s,
                fly=chain.jump_duration_s,
                moved=format_displacement(displacement, response.motion.name, unit),
                rise=format_length(chain.max_rise_m or 0.0, unit),
            )
        else:
            yield gettext("Chain {number}, {outcome}.", number=number, outcome=gettext(chain.outcome))


SECTION = Section(
    title=N_("Jump of the two-layer block"),
    severity=_severity,
    verdict=_short_verdict,
    sentences=_chain_sentences,
    onset=N_("Onset of rocking and jump at {factor:.2f} times this record."),
)
