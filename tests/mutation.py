"""Mutation run over models, studies and readers: the share of seeded faults that no test notices (requires cosmic-ray).

``python -m tests.mutation --sample 150`` changes one operator or number at a time in a copy of the tree (cosmic-ray's operators), runs the
tests of the changed module, the fast ones first, and prints the survivors; it fails when their share exceeds the budget. Modules with
kernels are tested as plain Python first, with the JIT only if a mutant survives that. It takes half a minute per mutant, some minutes for
one that survives, and belongs to no regular run.
"""

import argparse
import functools
import os
import random
import re
import shutil
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import seisblock

# cosmic_ray is imported where it is used: it belongs to no extra, and doctests import this module
if TYPE_CHECKING:
    from cosmic_ray.work_item import MutationSpec

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("models", "studies", "readers")
LAYOUT = ("plot.py", "animate.py")
"""Modules of layout, whose numbers are looked at, not tested."""

BUDGET = 0.25
"""Largest share of survivors."""

OPERATORS = (
    "core/ReplaceBinaryOperator_Add_Sub",
    "core/ReplaceBinaryOperator_Sub_Add",
    "core/ReplaceBinaryOperator_Mul_Div",
    "core/ReplaceBinaryOperator_Div_Mul",
    "core/ReplaceComparisonOperator_Lt_GtE",
    "core/ReplaceComparisonOperator_LtE_Lt",
    "core/ReplaceComparisonOperator_Gt_LtE",
    "core/ReplaceComparisonOperator_GtE_Gt",
    "core/ReplaceComparisonOperator_Eq_NotEq",
    "core/ReplaceUnaryOperator_Delete_USub",
    "core/ReplaceUnaryOperator_Delete_Not",
    "core/ReplaceAndWithOr",
    "core/ReplaceOrWithAnd",
    "core/ReplaceTrueWithFalse",
    "core/ReplaceFalseWithTrue",
    "core/NumberReplacer",
)
TIMEOUT_S = 400
"""Processor time, s, after which a mutant counts as an endless loop; a busy machine must not kill any."""

SLOW_FOLDERS = {"benchmarks", "papers", "fuzz", "validation"}
PRINTED = ("papers/test_evidence.py", "papers/test_paper_items.py", "test_pages.py")
"""Tests of many models and studies at once, run last: evidence, tables of papers, output on pages. A change of a file on which kernels
depend would have them all compiled again: its numbers are looked for in the tests of its model."""


def mutation_specs(path: Path) -> list["MutationSpec"]:
    """Return every mutation of a module, with the path relative to the tree."""
    from cosmic_ray.ast import ast_nodes, get_ast
    from cosmic_ray.plugins import get_operator
    from cosmic_ray.work_item import MutationSpec

    source = path.read_text(encoding="utf-8")
    nodes = list(ast_nodes(get_ast(source)))
    lines = source.splitlines()

    def is_behaviour(start: tuple[int, int]) -> bool:
        """Return whether a test could hold a place: no option of a dataclass or kernel, no ``*`` of a signature, no assertion of `zip`.

        Nor is it one where an error or a flag shortens the text that it quotes.
        """
        line = lines[start[0] - 1]
        before, after = line[: start[1]], line[start[1] :]
        is_marker = after.startswith("*,") or before.endswith("strict=")
        is_quotation = before.endswith("[:") and re.search(r"(?:[eE]rror|qc_flag)\(", line) is not None
        return not line.lstrip().startswith("@") and not is_marker and not is_quotation

    specs = []
    for name in OPERATORS:
        operator = get_operator(name)()
        positions = [position for node in nodes for position in operator.mutation_positions(node)]
        specs += [
            MutationSpec(path.relative_to(ROOT), name, occurrence, start_pos=start, end_pos=end)
            for occurrence, (start, end) in enumerate(positions)
            if is_behaviour(start)
        ]
    return specs


@functools.cache
def compiled_sources() -> set[Path]:
    """Return the files whose change has the kernels compiled again."""
    from seisblock._jit.cache import kernel_sources

    return {ROOT / "seisblock" / path.relative_to(Path(seisblock.__file__).parent) for path in kernel_sources()}


def select_tests(module: Path) -> list[str]:
    """Return the tests of a module: its doctests, the files that import it, then those that concern its model, format or study."""
    folder, name, stem = module.parts[1], module.parts[2], module.stem
    dotted = ".".join(module.with_suffix("").parts)
    parent, last = dotted.rsplit(".", 1)
    imports = (f"from {dotted} import", f"from {parent} import {last}", f"import {dotted}")
    texts = {path: path.read_text(encoding="utf-8") for path in sorted((ROOT / "tests").rglob("test_*.py"))}
    texts = {path: text for path, text in texts.items() if not SLOW_FOLDERS & set(path.parts)}
    direct = [path for path, text in texts.items() if any(line in text for line in imports)]
    is_compiled = ROOT / module in compiled_sources()
    if folder == "models":
        named = [path for path, text in texts.items() if {"models", "properties"} & set(path.parts)]
        named = [path for path in named if f"models.{name}." in texts[path] or name in str(path.relative_to(ROOT))]
        printed = [path for path in texts if "cli" in path.parts and name in path.stem and not is_compiled]
        nearby = [*named, *printed]
    elif name == "formats":
        nearby = [path for path, text in texts.items() if "readers" in path.parts and (stem.split("_")[0] in text or "FORMATS" in text)]
    else:
        words = {part.removesuffix(".py") for part in module.parts[2:]}
        nearby = [
            path
            for path in texts
            if {folder, "cli"} & set(path.parts) and any(word in str(path.relative_to(ROOT / "tests")) for word in words)
        ]
        nearby += [] if folder != "readers" or direct else [path for path in texts if "readers" in path.parts]
    files = list(dict.fromkeys([*direct, *nearby])) or [ROOT / "tests" / folder]
    files += [] if folder == "readers" or is_compiled else [ROOT / "tests" / name for name in PRINTED]
    return [str(module), *(str(path.relative_to(ROOT)) for path in files)]


def killing_test(spec: "MutationSpec") -> str | None:
    """Return the first test that fails with a mutation, None if all pass, in the tree of the current folder."""
    from cosmic_ray.mutating import mutate_and_test
    from cosmic_ray.work_item import TestOutcome

    command = f"{sys.executable} -m pytest -q -x -p no:cacheprovider --benchmark-disable"
    # exit status 5: no test of that kind; slow tests that reach the limit have found nothing
    stages = [("0", "not slow", "$status -eq 5"), ("0", "slow", "$status -eq 5 -o $status -ge 128")]
    if ROOT / spec.module_path in compiled_sources():
        stages.insert(0, ("1", "kernel and not slow", "$status -eq 5"))
    for disabled, markers, passed in stages:
        os.environ["NUMBA_DISABLE_JIT"] = disabled
        tests = f"{command} -m '{markers}' {' '.join(select_tests(spec.module_path))}"
        shell = f"ulimit -t {TIMEOUT_S}; {tests}; status=$?; test $status -eq 0 -o {passed}"
        result = mutate_and_test([spec], f'sh -c "{shell}"', 20.0 * TIMEOUT_S)
        if result.test_outcome != TestOutcome.SURVIVED:
            failures = re.findall(r"^(?:FAILED|ERROR) (\S+)", result.output or "", re.MULTILINE)
            return failures[0] if failures else str(result.output)[-80:].strip()
    return None


def main() -> int:
    """Run a sample of mutants and print the survivors."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--sample", type=int, default=150)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=1, help="number of the mutant to begin with, to resume a run or to share it out")
    parser.add_argument("--only", default="", help="part of the module's path")
    parser.add_argument("--skip", action="append", default=[], help="part of the paths of modules to leave out, may be repeated")
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    paths = [path for folder in FOLDERS for path in sorted((ROOT / "seisblock" / folder).rglob("*.py")) if arguments.only in str(path)]
    paths = [path for path in paths if path.name not in LAYOUT and not any(part in str(path) for part in arguments.skip)]
    specs = [spec for path in paths for spec in mutation_specs(path)]
    sample = rng.sample(specs, min(arguments.sample, len(specs)))
    print(f"{len(specs)} mutations of {len(paths)} modules, sample of {len(sample)}, seed {arguments.seed}", flush=True)
    survivors: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(".git", "__pycache__", ".mypy_cache", ".ruff_cache"))
        os.chdir(tree)
        for number, spec in enumerate(sample[arguments.first - 1 :], start=arguments.first):
            killer = killing_test(spec)
            survivors[spec.module_path.parts[1]] += killer is None
            line = spec.start_pos[0]
            source = (tree / spec.module_path).read_text(encoding="utf-8")
            mutant = mutate_code(source, get_operator(spec.operator_name)(), spec.occurrence) or source
            change = f"{source.splitlines()[line - 1].strip()}  ->  {mutant.splitlines()[line - 1].strip()}"
            print(f"{number} {spec.module_path}:{line}", f"SURVIVED: {change}" if killer is None else f"killed by {killer}", flush=True)
    count = len(sample) - arguments.first + 1
    share = survivors.total() / max(count, 1)
    print(f"survivors: {dict(survivors)}, {100.0 * share:.0f} % of {count}; budget {100.0 * BUDGET:.0f} %")
    return share > BUDGET


if __name__ == "__main__":
    sys.exit(main())
