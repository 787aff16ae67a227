"""What somebody meant who wrote a name that is not there: the nearest of those that are, when one of them is really near."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import click

from seisblock.core.i18n import Message, gettext

KNOWN_KEYS = ("known", "codes", "names")
"""Fields of a message that list the names there are."""

NAME_KEYS = ("name", "code", "pair")
"""Fields that hold the one that is not."""

MIN_TYPO_LENGTH, TWO_TYPO_LENGTH = 3, 8
"""Of letters: shorter names have no slips, longer ones may have two."""

MIN_PREFIX_LENGTH = 4
"""Letters from which on a name is meant by what goes on after it (``rocking``)."""


def closest_name(name: str, candidates: Iterable[str]) -> str | None:
    """Return the name that was meant by one that is not there, whatever its case; None where none is near.

    Near is the only name that begins so, one that differs by a slip of the hand (in eight letters and more, two): a letter too many,
    too few, another or changed places with the next; and one that is a word of which the name is more.
    """
    typed = name.lstrip("-").lower()
    by_form: dict[str, str] = {}
    for candidate in candidates:
        folded = candidate.lstrip("-").lower()
        by_form.setdefault(folded, candidate)
        by_form.setdefault(folded.partition(".")[0], candidate)  # a file by its name without suffix
    if not typed or not by_form:
        return None
    matches = {candidate for form, candidate in by_form.items() if form.startswith(typed)}
    if len(matches) == 1:
        return matches.pop()
    distance, form = min((_edit_distance(typed, form), form) for form in by_form)
    if distance <= (0 if len(typed) < MIN_TYPO_LENGTH else 1 if len(typed) < TWO_TYPO_LENGTH else 2):
        return by_form[form]
    words = [form for form in by_form if len(form) >= MIN_PREFIX_LENGTH and typed.startswith(form)]
    return by_form[max(words, key=len)] if words else None


def _edit_distance(a: str, b: str) -> int:
    """Return how many letters are too many, too few, others, or in each other's place."""
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
    """Return a message as it is told, and after it the name that was meant, where it lists the names there are and one of them is near.

    Parameters
    ----------
    text : str
        In the language spoken.
    message : str
        The same, with the values it was said with.
    """
    if not isinstance(message, Message):
        return text
    candidates = next((message.values[key] for key in KNOWN_KEYS if key in message.values), ())
    name = next((message.values[key] for key in NAME_KEYS if key in message.values), "")
    return did_you_mean(text, closest_name(str(name), map(str, candidates)) if isinstance(candidates, list | tuple) else None)


def did_you_mean(text: str, name: str | None) -> str:
    """Return a message that asks whether a name was meant, where there is one."""
    return gettext("{message}; did you mean {name}?", message=text.rstrip("。.?"), name=name) if name else text


@contextmanager
def suggest_options(command: click.Command, ctx: click.Context) -> Iterator[None]:
    """Ask for the nearest option of a command where one is given that it does not have."""
    try:
        yield
    except click.NoSuchOption as error:
        names = [
            name for parameter in command.get_params(ctx) for name in (*parameter.opts, *parameter.secondary_opts) if name.startswith("--")
        ]
        raise click.UsageError(did_you_mean(error.message, closest_name(error.option_name, names)), ctx) from None


class SuggestingChoice(click.Choice[str]):
    """One of some words; for one that is none of them the nearest is asked for."""

    def __init__(self, words: Collection[str]) -> None:
        super().__init__(list(words))

    def get_invalid_choice_message(self, value: Any, ctx: click.Context | None) -> str:
        """Return what is said of another word."""
        return did_you_mean(super().get_invalid_choice_message(value, ctx), closest_name(str(value), self.choices))
