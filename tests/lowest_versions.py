"""Print constraints that pin each dependency to its lower bound.

``python tests/lowest_versions.py [EXTRA ...] > lowest.txt`` reads ``pyproject.toml``; ``pip install -c lowest.txt .`` then installs the
oldest versions that the project declares. Standard library only: it runs before anything is installed.
"""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
REQUIREMENT = re.compile(r"(?P<name>[\w.-]+)(?:\[[\w,.-]+\])?(?:>=|==)(?P<lowest>[\w.]+)(?:,<(?P<limit>[\w.]+))?")


def lowest_versions(*extras: str) -> dict[str, str]:
    """Return the lower bound of each runtime dependency and of those of some extras.

    Raises
    ------
    ValueError
        If a requirement has no lower bound.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lowest = {}
    for requirement in [*project["dependencies"], *(line for extra in extras for line in project["optional-dependencies"][extra])]:
        match = REQUIREMENT.fullmatch(requirement)
        if match is None:
            raise ValueError(f"{requirement}: no lower bound of the form NAME>=VERSION")
        lowest[match["name"]] = match["lowest"]
    return lowest


if __name__ == "__main__":
    for name, version in lowest_versions(*sys.argv[1:]).items():
        print(f"{name}=={version}")
