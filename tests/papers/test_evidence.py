"""The evidence about the evidence: labels are true, what differs is held where it is, nothing is computed before it is asked for."""

import dataclasses
import importlib
import math
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import seisblock
from seisblock import validation
from seisblock.references import REFERENCES
from seisblock.validation import cases
from seisblock.validation.case import EVIDENCE_KINDS, REPRODUCIBLE, Case, count_verdicts, count_verdicts_by_kind, expected_difference

PACKAGE = Path(seisblock.__file__).parent
EVIDENCE = str(PACKAGE / "validation")
READS = {"read", "read_all", "read_cemetery"}
"""Functions that read a bundled record or survey, which stand in for the papers' own."""

QUICK = [case for case in cases() if case.quick]


class ReachedError(Exception):
    """The evidence called a function of the program."""


def first_call(case):
    """Return the first function of the program that a case calls: its name when it reads a record or a survey, "runs" for any other."""
    for _, name, _ in pkgutil.iter_modules(validation.__path__, f"{validation.__name__}."):
        for value in vars(importlib.import_module(name)).values():
            getattr(value, "cache_clear", lambda: None)()

    def watch(frame, event, argument):
        code = frame.f_code
        if event == "call" and code.co_filename.startswith(str(PACKAGE)) and not code.co_filename.startswith(EVIDENCE):
            raise ReachedError("reads" if code.co_name in READS else "runs")

    before = sys.getprofile()
    sys.setprofile(watch)
    try:
        case.compute()
    except ReachedError as reached:
        return str(reached)
    finally:
        sys.setprofile(before)
    return "nothing"


@pytest.mark.parametrize("case", QUICK, ids=lambda case: case.key)
def test_case_kinds_are_true(case):
    """Cases that run no line of the program are consistency of the print; cases on a bundled record or survey are rebuilt."""
    reached = first_call(case)
    assert reached != "nothing" or case.kind == "print"
    assert reached != "reads" or case.kind == "rebuilt"


def test_cases_have_unique_keys_and_known_kinds():
    """Keys are unique, kinds known, papers among the references, tolerances numbers."""
    all_cases = cases()
    assert len({case.key for case in all_cases}) == len(all_cases)
    assert {case.kind for case in all_cases} == set(EVIDENCE_KINDS)
    assert {case.paper for case in all_cases} <= set(REFERENCES)
    assert all(math.isfinite(case.tolerance) and case.tolerance >= 0.0 for case in all_cases)
    assert all(re.search(r"eq|table|fig|sec|ph|rock|puls|slid|\]_$", case.where) for case in all_cases)


@pytest.mark.parametrize("case", [case for case in cases() if case.status == "differs"], ids=lambda case: case.key)
def test_differing_case_holds_its_own_value(case):
    """It knows today's value, does not admit the paper's, and fails at any other; to a millionth, or to what a chaotic verdict moves."""
    value, within = case.today
    expected = case.expected() if callable(case.expected) else case.expected
    assert abs(value - expected) > case.tolerance
    assert (
        within <= REPRODUCIBLE * abs(value)
        or "rocking-edges" in case.key
        or "pile" in case.key
        or case.key in ("okumura-fig11-corner-4", "fema-p58-constant", "cube-tosses-place")
    )
    for invalid in (value + 2.0 * within + 1e-3, value - 2.0 * within - 1e-3, expected, math.nan):
        assert dataclasses.replace(case, compute=lambda faulty=invalid: faulty).run().verdict == "fails"
    assert dataclasses.replace(case, compute=lambda: value).run().verdict == "differs"


def test_case_counts_add_up():
    """By verdict, and by kind and verdict."""
    two = [
        Case("a", "[Tsutsui]_ eq. (1)", "a", "1", 1.0, 0.1, lambda: 1.0),
        Case(
            "b",
            "[Tsutsui]_ eq. (2)",
            "b",
            "1",
            lambda: 1.0,
            0.1,
            lambda: 3.0,
            "differs",
            "why",
            kind="print",
            today=expected_difference(3.0),
        ),
    ]
    results = [case.run() for case in two]
    assert [result.expected for result in results] == [1.0, 1.0]
    assert count_verdicts(results) == {"fails": 0, "differs": 1, "holds": 1}
    assert count_verdicts_by_kind(results)["print"] == {"fails": 0, "differs": 1, "holds": 0}
    assert sum(sum(counted.values()) for counted in count_verdicts_by_kind(results).values()) == 2


def test_readme_table_equals_case_counts():
    """Its table has the four kinds in words, with how many cases each has and how many of them differ."""
    text = (PACKAGE.parent / "README.md").read_text(encoding="utf-8")
    for kind, words in EVIDENCE_KINDS.items():
        computed = [case for case in cases() if case.kind == kind]
        assert f"| {words} | {len(computed)} | {sum(case.status == 'differs' for case in computed)} |" in text


def test_importing_cases_computes_nothing():
    """Importing the evidence solves nothing and reads no file; closed forms may give expected values."""
    script = (
        "import sys, importlib\n"
        "from seisblock.validation import PAPERS\n"
        "modules = [importlib.import_module(f'seisblock.validation.{name}') for name in PAPERS]\n"
        "names = [name for name in sys.modules if name.startswith('seisblock.validation.')]\n"
        "called = set()\n"
        "def watch(frame, event, argument):\n"
        "    file = frame.f_code.co_filename.rpartition('seisblock/')[2]\n"
        "    if event == 'call' and file.split('/')[0] in ('readers', 'solvers', 'studies', 'dynamics', 'measures', 'samples.py'):\n"
        "        called.add(f'{file}:{frame.f_code.co_name}')\n"
        "sys.setprofile(watch)\n"
        "[importlib.reload(sys.modules[name]) for name in names]\n"
        "sys.setprofile(None)\n"
        "print(*sorted(called), sep='\\n')\n"
    )
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert result.stdout.split() == []
