"""What somebody meant who wrote a name that is not there: the nearest of those that are, when one of them is really near."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import click

from seisblock.words import Said, tell

LISTS = ("known", "codes", "names")
"""Fields of a message that list the names there are."""

GIVEN = ("name", "code", "pair")
"""Fields that hold the one that is not."""

TOO_SHORT, LONG = 3, 8
"""Of letters: shorter names have no slips, longer ones may have two."""

WHOLE_WORD = 4
"""Letters from which on a name is meant by what goes on after it (``rocking``)."""


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the name that was meant by one that is not there, whatever its case; None where none is near.

    Near is the only name that begins so, one that differs by a slip of the hand (in eight letters and more, two): a letter too many,
    too few, another or changed places with the next; and one that is a word of which the name is more.
    """
    typed = name.lstrip("-").lower()
    there: dict[str, str] = {}
    for each in known:
        whole = each.lstrip("-").lower()
        there.setdefault(whole, each)
        there.setdefault(whole.partition(".")[0], each)  # a file by its name without suffix
    if not typed or not there:
        return None
    begun = {each for form, each in there.items() if form.startswith(typed)}
    if len(begun) == 1:
        return begun.pop()
    slips, form = min((_slips(typed, form), form) for form in there)
    if slips <= (0 if len(typed) < TOO_SHORT else 1 if len(typed) < LONG else 2):
        return there[form]
    words = [form for form in there if len(form) >= WHOLE_WORD and typed.startswith(form)]
    return there[max(words, key=len)] if words else None


def _slips(one: str, other: str) -> int:
    """Return how many letters are too many, too few, others, or in each other's place."""
    before, last = [0] * (len(other) + 1), list(range(len(other) + 1))
    for i, letter in enumerate(one, start=1):
        row = [i]
        for j, wanted in enumerate(other, start=1):
            least = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (letter != wanted))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == wanted:
                least = min(least, before[j - 2] + 1)
            row.append(least)
        before, last = last, row
    return last[-1]


def suggested(told: str, said: str) -> str:
    """Return a message as it is told, and after it the name that was meant, where it lists the names there are and one of them is near.

    Parameters
    ----------
    told : str
        In the language spoken.
    said : str
        The same, with the values it was said with.
    """
    if not isinstance(said, Said):
        return told
    known = next((said.values[key] for key in LISTS if key in said.values), ())
    name = next((said.values[key] for key in GIVEN if key in said.values), "")
    return asking(told, nearest(str(name), map(str, known)) if isinstance(known, list | tuple) else None)


def asking(told: str, name: str | None) -> str:
    """Return a message that asks whether a name was meant, where there is one."""
    return tell("{message}; did you mean {name}?", message=told.rstrip("。.?"), name=name) if name else told


@contextmanager
def asking_for_options(command: click.Command, ctx: click.Context) -> Iterator[None]:
    """Ask for the nearest option of a command where one is given that it does not have."""
    try:
        yield
    except click.NoSuchOption as error:
        names = [name for each in command.get_params(ctx) for name in (*each.opts, *each.secondary_opts) if name.startswith("--")]
        raise click.UsageError(asking(error.message, nearest(error.option_name, names)), ctx) from None


class OneOf(click.Choice[str]):
    """One of some words; for one that is none of them the nearest is asked for."""

    def __init__(self, words: Collection[str]) -> None:
        super().__init__(list(words))

    def get_invalid_choice_message(self, value: Any, ctx: click.Context | None) -> str:
        """Return what is said of another word."""
        return asking(super().get_invalid_choice_message(value, ctx), nearest(str(value), self.choices))
