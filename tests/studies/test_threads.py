"""Threads answer in the language that is spoken where their answers are asked for."""

from seisblock.core.i18n import get_locale, use_locale
from seisblock.studies.parallel import MAX_PENDING_RECORDS, map_threads


def test_map_threads_uses_locale_of_caller():
    """Messages of kernel compilation in a thread use the locale of the caller."""
    with use_locale("ja"):
        assert set(map_threads(lambda _: get_locale(), range(8), workers=4)) == {"ja"}
    with use_locale("en"):
        assert set(map_threads(lambda _: get_locale(), range(8), workers=4)) == {"en"}


def test_map_threads_consumes_items_lazily():
    """However many there are, no more are taken than are asked to be under way: they may hold a record each."""
    collected = []
    answers = map_threads(lambda item: item, (collected.append(n) or n for n in range(1000)), workers=2, max_pending=MAX_PENDING_RECORDS)
    for result, answer in enumerate(answers, start=1):
        assert answer == result - 1 and len(collected) <= result + MAX_PENDING_RECORDS - 1
