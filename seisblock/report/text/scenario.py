"""Text report of a scenario: objects by class, table, advice."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import N_, gettext, join_list, join_sentences
from seisblock.output.text.tables import DASH, Part, format_range, styled_line, table
from seisblock.studies.scenario.assess import CLASSES, DEPTH, EITHER, WIDTH, ObjectRisk

SIDES = {WIDTH: N_("width"), DEPTH: N_("depth"), EITHER: N_("either side")}

MAX_ROWS = 12
"""Largest number of objects without ``--details``."""


def class_counts(results: Sequence[ObjectRisk]) -> str:
    """Return the number of objects in each class, and of those without a result."""
    counts = {name: sum(result.class_name == name for result in results) for name in CLASSES}
    parts = [gettext("{name} {count}", name=gettext(name), count=count) for name, count in counts.items() if count]
    failed = sum(result.class_name is None for result in results)
    return join_list([*parts, *([gettext("no result {count}", count=failed)] if failed else [])])


def format_percent(share: float | None) -> str:
    """Return a share in per cent."""
    return DASH if share is None else f"{100.0 * share:.0f}"


def object_name(result: ObjectRisk) -> str:
    """Return the name of an object in the language of the locale."""
    return gettext(body_name(result.body))


def advice_text(result: ObjectRisk) -> str:
    """Return the advice on an object, or the reason why it has no result."""
    return gettext(result.failure) if result.failure else join_sentences(map(gettext, result.advice))


def tables(results: Sequence[ObjectRisk], label: str) -> Iterator[Any]:
    """Yield the number of objects by class, the table and the advice, worst first."""
    count = len(results)
    count_text = gettext("1 object") if count == 1 else gettext("{count} objects", count=count)
    yield styled_line(
        gettext("{scenario}, {objects}: {classes}", scenario=gettext(label), objects=count_text, classes=class_counts(results)), "bold"
    )
    full = (_table(results), *_advice(results), *_stopped(results))
    if len(results) <= MAX_ROWS:
        yield from full
        return
    note = styled_line(gettext("{count} further objects", count=len(results) - MAX_ROWS), "dim")
    yield Part(full, (_table(results[:MAX_ROWS]), *_advice(results[:MAX_ROWS]), *_stopped(results[:MAX_ROWS]), note))


def _table(results: Sequence[ObjectRisk]) -> Any:
    header = [gettext("object"), gettext("class"), gettext("overturns (%)"), "95 %", gettext("moves (%)"), gettext("falls along")]
    rows = [
        [
            object_name(result),
            gettext(result.class_name) if result.class_name else DASH,
            format_percent(result.overturning_probability),
            DASH if result.interval is None else format_range(*map(format_percent, result.interval)),
            format_percent(result.moved_probability),
            gettext(SIDES[result.falls_along]) if result.falls_along else DASH,
        ]
        for result in results
    ]
    caption = gettext("95 %: interval over the records, model error not included; moves: residual displacement above 1 cm, or overturning")
    return table("", header, rows, caption=caption)


def _advice(results: Sequence[ObjectRisk]) -> Iterator[Any]:
    """Yield one line for each advice, with the objects it concerns."""
    groups: dict[str, list[str]] = {}
    for result in results:
        groups.setdefault(advice_text(result), []).append(object_name(result))
    for text, names in groups.items():
        yield styled_line(gettext("{names}: {text}", names=join_list(names), text=text))


def _stopped(results: Sequence[ObjectRisk]) -> Iterator[Any]:
    """Yield one line for each object and motion with runs without a result."""
    for result in results:
        for sentence in result.stopped:
            yield styled_line(gettext("{names}: {text}", names=object_name(result), text=gettext(sentence)), "yellow")


def csv_columns(results: Sequence[ObjectRisk]) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of ``--csv``: keys and numbers, advice and reason in the language of the locale."""
    header = [
        "body", "class", "overturning_probability", "probability_low", "probability_high", "moved_probability", "runs", "falls_along",
        "fall_reach_m", "displacement_m", "advice", "reason",
    ]  # fmt: skip
    rows = [
        [
            result.body,
            result.class_name,
            result.overturning_probability,
            *(result.interval or (None, None)),
            result.moved_probability,
            result.runs,
            result.falls_along,
            result.fall_reach_m,
            result.displacement_m,
            join_sentences(map(gettext, result.advice)),
            join_sentences(map(gettext, (*((result.failure,) if result.failure else ()), *result.stopped))) or None,
        ]
        for result in results
    ]
    return header, rows


def sheet_rows(results: Sequence[ObjectRisk]) -> tuple[list[str], list[list[Any]]]:
    """Return header and rows of a worksheet in the language of the locale."""
    header = [
        *(gettext("object"), gettext("class"), gettext("overturns (%)"), gettext("95 % from"), gettext("95 % to"), gettext("moves (%)")),
        *(gettext("falls along"), gettext("covers (m)"), gettext("shifts by up to (cm)"), gettext("advice")),
    ]
    rows = [
        [
            object_name(result),
            gettext(result.class_name) if result.class_name else gettext("no result"),
            _rounded_percent(result.overturning_probability),
            *map(_rounded_percent, result.interval or (None, None)),
            _rounded_percent(result.moved_probability),
            gettext(SIDES[result.falls_along]) if result.falls_along else None,
            None if result.fall_reach_m is None else round(result.fall_reach_m, 2),
            None if result.displacement_m is None else round(100.0 * result.displacement_m, 1),
            advice_text(result),
        ]
        for result in results
    ]
    return header, rows


def _rounded_percent(share: float | None) -> float | None:
    return None if share is None else round(100.0 * share, 1)
