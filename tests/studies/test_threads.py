"""Threads answer in the language that is spoken where their answers are asked for."""

from seisblock.core.i18n import get_locale, use_locale
from seisblock.studies.parallel import MAX_PENDING_RECORDS, map_threads


def test_map_threads_uses_locale_of_caller():
    """What is said while a kernel is compiled in a thread was English, whatever `--lang` said."""
    with use_locale("ja"):
        assert set(map_threads(lambda _: get_locale(), range(8), workers=4)) == {"ja"}
    with use_locale("en"):
        assert set(map_threads(lambda _: get_locale(), range(8), workers=4)) == {"en"}


def test_map_threads_consumes_items_lazily():
    """However many there are, no more are taken than are asked to be under way: they may hold a record each."""
    taken = []
    answers = map_threads(lambda item: item, (taken.append(n) or n for n in range(1000)), workers=2, max_pending=MAX_PENDING_RECORDS)
    for done, answer in enumerate(answers, start=1):
        assert answer == done - 1 and len(taken) <= done + MAX_PENDING_RECORDS - 1
