"""Write the present output of every command into the README's console blocks: ``python -m tests.refresh_readme``."""

import os
import re
import shlex

from click.testing import CliRunner

from seisblock.cli import main
from tests.test_readme import README


def refreshed(block: re.Match[str]) -> str:
    """Return a console block with what its commands print now."""
    lines = []
    for command in re.findall(r"^\$ (.*)$", block[1], re.M):
        result = CliRunner().invoke(main, shlex.split(command)[1:])
        if result.exit_code:
            raise SystemExit(f"{command}: {result.stderr}")
        lines += [f"$ {command}", *(line.rstrip() for line in result.stdout.strip().splitlines())]
    return "```console\n" + "\n".join(lines) + "\n```"


if __name__ == "__main__":
    os.environ |= {"COLUMNS": "80", "NO_COLOR": "1"}
    text = README.read_text(encoding="utf-8")
    README.write_text(re.sub(r"```console\n(.*?)```", refreshed, text, flags=re.S), encoding="utf-8")
