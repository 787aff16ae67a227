"""What every test shares: an English locale and a terminal of 80 columns, whoever runs it."""

import os

import hypothesis

os.environ.setdefault("COLUMNS", "80")
os.environ["NO_COLOR"] = "1"
for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
    os.environ.pop(name, None)

# the same examples in every run of continuous integration; fresh ones at a developer's desk
hypothesis.settings.register_profile("ci", derandomize=True, deadline=None)
if os.environ.get("CI"):
    hypothesis.settings.load_profile("ci")
