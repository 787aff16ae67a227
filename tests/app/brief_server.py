"""``seisblock`` with few records and runs of `secure` and `scenario`, also in the workers of its page: each of them imports this module."""

import importlib

from seisblock.__main__ import run
from tests.lengths import SCENARIOS

for name, value in SCENARIOS.items():
    module, _, constant = name.partition(".")
    setattr(importlib.import_module(f"seisblock.studies.scenario.{module}"), constant, value)

if __name__ == "__main__":
    run()
