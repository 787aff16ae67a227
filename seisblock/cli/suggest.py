"""Suggestions ("did you mean ...?") for mistyped names."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

import click

from seisblock.core.i18n import N_, Message, gettext, join_sentences

KNOWN_KEYS = ("known", "codes", "names")
"""Fields of a message that list the known names."""

NAME_KEYS = ("name", "code", "pair")
"""Fields of a message that hold the unknown name."""

MIN_TYPO_LENGTH, TWO_TYPO_LENGTH = 3, 8
"""Shortest name, letters, for which one typing error, and two errors, are tolerated."""

RELATED_OPTIONS = (
    ("--body", "--bodies", "--block", "--cemetery", "--stones"),
    ("--out", "--output", "--directory"),
    ("--runs", "--samples", "--perturb"),
)
"""Options of different commands for the same thing: one that a command lacks suggests the one that it has."""

MAX_NEIGHBOURS = 1000
"""Most files of a folder that are compared with a mistyped name."""

MIN_PREFIX_LENGTH = 4
"""Shortest name, letters, that matches a longer word beginning with it (``rocking``: ``rock``)."""


def closest_name(name: str, candidates: Iterable[str]) -> str | None:
    """Return the candidate nearest to a mistyped name, case-insensitively; None if none is near.

    Near are: the only candidate that begins with the name; a candidate within one typing error (two from eight letters on), see
    :func:`_edit_distance`; and the longest candidate with which the name begins.
    """
    query = name.lstrip("-").lower()
    by_form: dict[str, str] = {}
    for candidate in candidates:
        lower_name = candidate.lstrip("-").lower()
        by_form.setdefault(lower_name, candidate)
        by_form.setdefault(lower_name.partition(".")[0], candidate)  # a file by its name without suffix
    if not query or not by_form:
        return None
    matches = {candidate for form, candidate in by_form.items() if form.startswith(query)}
    if len(matches) == 1:
        return matches.pop()
    distance, form = min((_edit_distance(query, form), form) for form in by_form)
    if distance <= (0 if len(query) < MIN_TYPO_LENGTH else 1 if len(query) < TWO_TYPO_LENGTH else 2):
        return by_form[form]
    words = [form for form in by_form if len(form) >= MIN_PREFIX_LENGTH and query.startswith(form)]
    return by_form[max(words, key=len)] if words else None


def _edit_distance(a: str, b: str) -> int:
    """Return the optimal-string-alignment distance: insertions, deletions, substitutions and transpositions."""
    row_before_last, last_row = [0] * (len(b) + 1), list(range(len(b) + 1))
    for i, letter in enumerate(a, start=1):
        row = [i]
        for j, expected in enumerate(b, start=1):
            cost = min(last_row[j] + 1, row[j - 1] + 1, last_row[j - 1] + (letter != expected))
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == expected:
                cost = min(cost, row_before_last[j - 2] + 1)
            row.append(cost)
        row_before_last, last_row = last_row, row
    return last_row[-1]


def add_suggestion(text: str, message: str) -> str:
    """Return a translated message with a suggestion where it lists known names and one of them, or a file in the same folder, is near.

    Parameters
    ----------
    text : str
        Translated message.
    message : str
        The untranslated message with its values.
    """
    if not isinstance(message, Message):
        return text
    candidates = next((message.values[key] for key in KNOWN_KEYS if key in message.values), ())
    name = str(next((message.values[key] for key in NAME_KEYS if key in message.values), ""))
    if not isinstance(candidates, list | tuple) or not candidates:
        return text
    return did_you_mean(text, closest_name(name, [*map(str, candidates), *_neighbours(Path(name))]))


def _neighbours(path: Path) -> list[str]:
    """Return the files in the folder of a file that does not exist; of names without a suffix, none."""
    try:
        return [str(file) for file in islice(path.parent.iterdir(), MAX_NEIGHBOURS)] if path.suffix else []
    except (OSError, ValueError):
        return []


def did_you_mean(text: str, name: str | None) -> str:
    """Return a message with the suggested name, unchanged without one."""
    return gettext("{message}; did you mean {name}?", message=text.rstrip("。.?"), name=name) if name else text


@contextmanager
def suggest_options(command: click.Command, ctx: click.Context) -> Iterator[None]:
    """Add a suggestion to click's error about an unknown option; name a missing parameter within the sentence."""
    try:
        yield
    except click.MissingParameter as error:
        if error.param is None:
            raise
        # click appends the name and an English full stop to its translated text
        text = N_("Missing option {name}.") if isinstance(error.param, click.Option) else N_("Missing argument {name}.")
        choices = error.param.type.get_missing_message(error.param, ctx)
        sentences = [gettext(text, name=error.param.get_error_hint(ctx)), error.message, choices or ""]
        raise click.UsageError(join_sentences(filter(None, sentences)), ctx) from None
    except click.NoSuchOption as error:
        names = [
            name for parameter in command.get_params(ctx) for name in (*parameter.opts, *parameter.secondary_opts) if name.startswith("--")
        ]
        suggestion = closest_name(error.option_name, names) or _related_option(error.option_name, names)
        raise click.UsageError(did_you_mean(error.message, suggestion), ctx) from None


def _related_option(name: str, available: Collection[str]) -> str | None:
    """Return the available option for the same thing as another command's option, None without one."""
    related = next((group for group in RELATED_OPTIONS if name in group), ())
    return next((option for option in related if option in available), None)


class SuggestingChoice(click.Choice[str]):
    """Choice parameter that suggests the nearest value."""

    def __init__(self, words: Collection[str]) -> None:
        super().__init__(list(words))

    def get_invalid_choice_message(self, value: Any, ctx: click.Context | None) -> str:
        """Return the error message for an invalid choice."""
        return did_you_mean(super().get_invalid_choice_message(value, ctx), closest_name(str(value), self.choices))
