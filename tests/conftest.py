"""What every test shares: an English locale and a terminal of 80 columns, whoever runs it."""

import os

os.environ.setdefault("COLUMNS", "80")
os.environ["NO_COLOR"] = "1"
for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
    os.environ.pop(name, None)
