"""Types of the public names as an editor shows them; misspelt names are rejected."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

import seisblock

ROOT = Path(seisblock.__file__).parent.parent
STUBS = sorted(ROOT.glob("seisblock/**/__init__.pyi"))

SCRIPT = """
import seisblock
from seisblock import Block, Contact, Motion, SlidingBase
from seisblock.models.rock import solve_rock

record = seisblock.records.highpass(seisblock.records.demean(seisblock.read("synthetic_jma.csv")), 0.1)
motion = seisblock.motion_of(record, "EW")
gravestone = seisblock.load_block("gravestone")
pavilion = seisblock.load_two_layer("chozusha")
reveal_type(record)  # Record
reveal_type(motion.horizontal)  # ndarray[
reveal_type(seisblock.measure(record).components[0].pga_m_s2)  # float
reveal_type(seisblock.solve_slide(SlidingBase(0.2), motion).outcome.max_slip_m)  # float
reveal_type(solve_rock(gravestone, motion).outcome)  # RockOutcome
reveal_type(seisblock.solve_rock(gravestone, motion).outcome.overturning_time_s)  # float | None
reveal_type(seisblock.solve_jump(pavilion, motion, contact=seisblock.load_contact("chozusha")))  # Response[JumpOutcome]
reveal_type(seisblock.solve_stack(seisblock.load_pile("wagata"), motion).outcome.overturned)  # tuple[str, ...]
reveal_type(seisblock.studies.find_margin(gravestone, motion).nearest_flip)  # float | None
reveal_type(seisblock.uncertainty.perturb(gravestone, motion, 20, spread=seisblock.uncertainty.ParameterVariation()).probability)  # float
reveal_type(seisblock.criteria.overturning_card)  # def (block: Block
reveal_type(seisblock.core.errors.SolverError)  # def (
try:
    seisblock.read("nothing.csv")
except seisblock.errors.RecordNotFoundError as found:
    reveal_type(found)  # RecordNotFoundError
"""

INVALID = {
    "seisblock.solve_rok(Block(0.2, 0.6), motion)": 'has no attribute "solve_rok"',
    "seisblock.solve_rock(motion, Block(0.2, 0.6))": "incompatible type",
    "seisblock.solve_rock(Block(0.2, 0.6), seisblock.read('a.csv'))": "incompatible type",
    "seisblock.solve_rock(Block(0.2, 0.6), motion, vertcal=True)": 'Unexpected keyword argument "vertcal"',
    "seisblock.solve_rock(Block(0.2, 0.6), motion).outcome.max_rotation": 'has no attribute "max_rotation"',
    "seisblock.criteria.housner": "has no attribute",
    "from seisblock import demeaned": "has no attribute",
    "from seisblock.models.rock import solve_slide": "has no attribute",
}
HEAD = "import seisblock\nfrom seisblock import Block, Motion\nmotion = Motion.from_arrays([0.0, 1.0], 0.01)\n"


@pytest.fixture(scope="module")
def mypy_output(tmp_path_factory):
    """Output of mypy --strict for a correct script and for one with a wrong line each, by script and line."""
    folder = tmp_path_factory.mktemp("user")
    (folder / "right.py").write_text(SCRIPT, encoding="utf-8")
    (folder / "wrong.py").write_text(HEAD + "\n".join(INVALID) + "\n", encoding="utf-8")
    # the package as one that is installed: its own modules are read, not judged
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--follow-imports=silent",
        "--no-error-summary",
        "--config-file=",
        "right.py",
        "wrong.py",
    ]
    paths = {"MYPYPATH": str(ROOT), "PATH": "", "MYPY_CACHE_DIR": str(ROOT / ".mypy_cache" / "stranger")}
    answer = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=paths, check=False)
    assert not answer.stderr, answer.stderr
    result = {}
    for script, line, text in re.findall(r"^(\w+)\.py:(\d+): (.*)$", answer.stdout, re.MULTILINE):
        result.setdefault((script, int(line)), []).append(text)
    return result


@pytest.mark.slow
def test_correct_script_passes_mypy(mypy_output):
    """Nothing is refused, and no public name is Any."""
    lines = SCRIPT.splitlines()
    expected_types = {number: line.rpartition("  # ")[2] for number, line in enumerate(lines, 1) if "reveal_type" in line}
    mapping = {line: texts for (script, line), texts in mypy_output.items() if script == "right"}
    assert set(mapping) == set(expected_types), [texts for line, texts in mapping.items() if line not in expected_types]
    for number, kind in expected_types.items():
        (text,) = mapping[number]
        plain = re.sub(r"\b(seisblock|numpy|builtins)\.[\w.]*?(?=\w+\b(?!\.))", "", text)
        assert kind in plain, (lines[number - 1], plain)


@pytest.mark.slow
def test_mypy_rejects_wrong_names_and_types(mypy_output):
    """A misspelt name, option or field, the wrong order and a record for a motion are found before the script runs."""
    first = HEAD.count("\n") + 1
    for number, (line, expected) in enumerate(INVALID.items(), first):
        assert any(expected in text for text in mypy_output.get(("wrong", number), [])), (line, mypy_output.get(("wrong", number)))


@pytest.mark.parametrize("stub", STUBS, ids=lambda path: path.parent.relative_to(ROOT).as_posix())
def test_stubs_match_the_package(stub):
    """Names of a stub can be imported, are listed once in order, and equal those of the package."""
    tree = ast.parse(stub.read_text(encoding="utf-8"))
    names = [alias.name for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names]
    listed = next(ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert sorted(listed) == sorted(names)
    package = __import__(".".join(stub.parent.relative_to(ROOT).parts), fromlist=["_"])
    assert sorted(package.__all__) == sorted(dir(package)) == sorted(names)
    assert all(getattr(package, name) is not None for name in names)
