"""An error that names a line names the right one: what it quotes stands there, or there the file was damaged."""

import re

import pytest

from seisblock.core.errors import InputError
from seisblock.readers import read_all
from tests.fuzz.formats import FORMATS
from tests.readers.format_trials import BINARY

DAMAGE = (
    lambda line: ["@ not a line @"],
    lambda line: [re.sub(r"\S+(\s*)$", r"@\1", line)],
    lambda line: [line, line],
)
"""Changes of one line: replaced, its last entry lost, repeated."""


@pytest.mark.parametrize("kind", [kind for kind in FORMATS if kind not in (*BINARY, "phone", "slist", "tspair")])
def test_errors_name_the_line_that_they_quote(kind, tmp_path):
    """Lines of the header and of samples damaged one at a time, and a line below the last one."""
    intact = FORMATS[kind].data.decode("latin-1").rstrip("\r\n").split("\n")
    path, named = tmp_path / "record", 0
    places = [*range(min(len(intact), 30)), len(intact) // 2, len(intact) // 2 + 1, len(intact) - 1, len(intact)]
    for i in places:
        damage = i % 3 if i < len(intact) else 0
        lines = [*intact[:i], *DAMAGE[damage]("".join(intact[i : i + 1])), *intact[i + 1 :], ""]
        path.write_bytes("\n".join(lines).encode("latin-1"))
        try:
            read_all(str(path), **FORMATS[kind].options)
        except InputError as error:
            message = str(error)
            place = re.search(r"record, line (\d+): ", message)
            if place is None:
                continue
            named += 1
            number, quoted = int(place[1]), re.search(r"found (?:'([^']*)'|\"([^\"]*)\")", message)
            if quoted:
                assert (quoted[1] or quoted[2] or "") in lines[number - 1], message
            elif "duplicate" in message or "twice" in message:
                assert number == i + 2, message
            else:
                # a repeated line shifts those below it
                assert number == i + 1 or (damage == 2 and number > i + 1), message
    assert named > 0
