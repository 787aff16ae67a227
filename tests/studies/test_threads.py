"""Threads answer in the language that is spoken where their answers are asked for."""

from seisblock.studies.runs import in_threads
from seisblock.words import language, speaking


def test_threads_speak_the_language_of_who_asks():
    """What is said while a kernel is compiled in a thread was English, whatever `--lang` said."""
    with speaking("ja"):
        assert set(in_threads(lambda _: language(), range(8), workers=4)) == {"ja"}
    with speaking("en"):
        assert set(in_threads(lambda _: language(), range(8), workers=4)) == {"en"}
