"""``seisblock`` with few records and runs of `secure` and `scenario`, also in the workers of its page, which run this module, too."""

import importlib

from seisblock.__main__ import run
from tests.lengths import SCENARIOS

# not where it is imported: tests in that process would have few runs, too
if __name__ in {"__main__", "__mp_main__"}:
    for name, value in SCENARIOS.items():
        module, _, constant = name.partition(".")
        setattr(importlib.import_module(f"seisblock.studies.scenario.{module}"), constant, value)

if __name__ == "__main__":
    run()
