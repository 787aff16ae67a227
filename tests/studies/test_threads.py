"""Threads answer in the language that is spoken where their answers are asked for."""

from seisblock.studies.runs import RECORDS, in_threads
from seisblock.words import language, speaking


def test_threads_speak_the_language_of_who_asks():
    """What is said while a kernel is compiled in a thread was English, whatever `--lang` said."""
    with speaking("ja"):
        assert set(in_threads(lambda _: language(), range(8), workers=4)) == {"ja"}
    with speaking("en"):
        assert set(in_threads(lambda _: language(), range(8), workers=4)) == {"en"}


def test_items_are_taken_as_they_are_needed():
    """However many there are, no more are taken than are asked to be under way: they may hold a record each."""
    taken = []
    answers = in_threads(lambda item: item, (taken.append(n) or n for n in range(1000)), workers=2, ahead=RECORDS)
    for done, answer in enumerate(answers, start=1):
        assert answer == done - 1 and len(taken) <= done + RECORDS - 1
