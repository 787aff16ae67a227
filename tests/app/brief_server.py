"""``seisblock`` with few records and runs of `secure` and `scenario`, also in the workers of its page, which run this module, too."""

from seisblock.__main__ import run
from tests.lengths import short_studies

# not where it is imported: tests in that process would have few runs, too
if __name__ in {"__main__", "__mp_main__"}:
    studies = short_studies()
    studies.__enter__()

if __name__ == "__main__":
    run()
