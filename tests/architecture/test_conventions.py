"""Conventions that a machine can check: citations, docstrings, imports."""

import ast
import builtins
import doctest
import graphlib
import inspect
import re
import subprocess
import sys
from pathlib import Path

import grimp
import pytest

import seisblock
from seisblock.core.registry import solver_names
from seisblock.references import REFERENCES
from tests.public_names import PUBLIC
from tests.trees import syntax_tree

PACKAGE = Path(seisblock.__file__).parent
CITATION = re.compile(r"\[(\w+)\]_")
CITING = ("measures", "criteria", "models", "bodies", "studies")

HEAVY = {"numba", "obspy", "scipy", "matplotlib", "PIL", "rich", "pandas"}
LIGHT = (
    "seisblock",
    "seisblock.cli",
    "seisblock.cli.command",
    "seisblock.cli.options",
    "seisblock.cli.types",
    "seisblock.core.errors",
    "seisblock.core.i18n",
    "seisblock.core.units",
    "seisblock.references",
    "seisblock.core.results",
    "seisblock.records",
    "seisblock.bodies.block",
    "seisblock.samples",
    "seisblock.output.templating",
    "seisblock.output.json.schema",
    "seisblock.output.json.encode",
    "seisblock.output.io.atomic",
)
"""Modules that load no large package."""

PUBLIC_FUNCTIONS = [name for name, value in PUBLIC.items() if inspect.isfunction(value)]


def sources(*folders):
    """Return the package's files, those of some folders only when given."""
    roots = [PACKAGE / folder for folder in folders] or [PACKAGE]
    return [path for root in roots for path in sorted(root.rglob("*.py"))]


def public_functions(path):
    """Return the public functions at the top of a file as (name, docstring)."""
    tree = syntax_tree(path)
    nodes = [node for node in tree.body if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")]
    return [(node.name, ast.get_docstring(node) or "") for node in nodes]


def docstrings(folder):
    """Yield (place, docstring) of every module, class and function of a folder."""
    for path in sources(folder):
        for node in ast.walk(syntax_tree(path)):
            if isinstance(node, (ast.FunctionDef, ast.ClassDef, ast.Module)) and ast.get_docstring(node):
                yield f"{path.relative_to(PACKAGE).as_posix()}:{getattr(node, 'name', 'module')}", ast.get_docstring(node)


FORMULA = re.compile(
    r"""
    \b(?:sqrt|sin|cos|tan|asin|acos|atan|acosh|exp|log10)\s?\(     # a function of something
  | \b[A-Za-z]\w*\^\d                                              # a power
  | \b[a-z]\ [A-Z]/[A-Z]\b                                         # g B/H
  | \d\ [a-z]/\(                                                   # 3 g/(2 p^2)
  | [\w)'\]]\s=\s[^=\n]*(?:[\w)]\s?[*/]\s?[\w(]|[\w)]\s[-+]\s[\w(]|\d\s[a-z]\b)   # x = a + b, a/b, 2 zeta k
    """,
    re.VERBOSE,
)
LOCATED = re.compile(
    r"\[\w+\]_(?:,\scorrected)?,?\s(?:eqs?|tables?|figs?|sections?|sec|ph|pp?|statements?|definition|method|mode|criterion|relation|steady)\b"
    r"|derived\shere",
    re.IGNORECASE,
)
"""A key with its place in the paper, in words where the paper has no numbers, or the statement that no paper has it."""

POWERS_OF_UNITS = re.compile(r"\b(?:kg\sm\^2|m\^2/s\^3|kg/m\^3|N/m\^3|rad/s\^2|m/s\^[23]|1/s\^2|m\^[23])")


def formula_in(text):
    """Return the first formula of a docstring, in its words or its Notes; None without one. Units, code and other sections are none."""
    remaining, keep, lines = [], True, text.splitlines()
    for line, after in zip(lines, [*lines[1:], ""], strict=True):
        if re.fullmatch(r"\s*-{3,}", after):
            keep = line.strip() == "Notes"
        elif keep and not re.fullmatch(r"\s*-{3,}", line):
            remaining.append(line)
    result = FORMULA.search(POWERS_OF_UNITS.sub("", re.sub(r"``[^`]*``", "", "\n".join(remaining))))
    return result.group(0) if result else None


@pytest.mark.parametrize("folder", CITING)
def test_docstring_with_formula_cites_paper_and_equation(folder):
    """A docstring with a formula cites paper and place, or states that it was derived here."""
    assert [(place, formula_in(text)) for place, text in docstrings(folder) if formula_in(text) and not LOCATED.search(text)] == []


@pytest.mark.parametrize(
    ("text", "formula", "located"),
    [
        ("Return p = sqrt(3 g/(4 R)), rad/s ([Housner1963]_).", True, False),
        ("Return p = sqrt(3 g/(4 R)), rad/s ([Furukawa2009]_ eq. (6)).", True, True),
        ("Return g B/H, m/s^2.", True, False),
        ("Return it.\n\nNotes\n-----\nx'' = -a - mu g, by [Fujino1978]_.", True, False),
        ("Return it.\n\nNotes\n-----\nx'' = -a - mu g, derived here.", True, True),
        ("Return the acceleration, (n,), m/s^2, of ``a = b + c``.", False, False),
        ("Return it.\n\nExamples\n--------\n>>> x = a + b", False, False),
        ("Return the stones that fall.", False, False),
    ],
)
def test_formula_in_recognises_formulas_and_locations(text, formula, located):
    """The rule sees formulas in words and Notes, not in units, code and examples; a bare key locates nothing."""
    assert bool(formula_in(text)) is formula
    assert bool(LOCATED.search(text)) is located


def test_formula_rule_has_formulas_to_check():
    """Every package of physics has formulas in its docstrings."""
    result = {folder: sum(formula_in(text) is not None for _, text in docstrings(folder)) for folder in CITING}
    assert sum(result.values()) > 60 and min(result.values()) > 0, result


def test_citation_keys_exist():
    """A key in any docstring, comment or case is one of the references."""
    text = {(path.name, key) for path in sources() for key in CITATION.findall(path.read_text(encoding="utf-8"))}
    assert {(file, key) for file, key in text if key not in REFERENCES} == set()


def test_references_are_unique_and_used():
    """The bibliography has no duplicates and no unused entry."""
    bibliography = "".join(path.read_text(encoding="utf-8") for path in sources("references"))
    assert len(re.findall(r"^    Reference\(", bibliography, re.MULTILINE)) == len(REFERENCES)
    text = "".join(path.read_text(encoding="utf-8") for path in sources() if path.parent.name != "references")
    assert set(REFERENCES) <= set(CITATION.findall(text))


def test_citation_keys_are_written_in_one_table():
    """A bare key is written in the table of references only."""
    trees = {path: syntax_tree(path) for path in sources() if path.parent.name != "references"}
    constants = [(path.name, node.value) for path, tree in trees.items() for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    assert [(name, value) for name, value in constants if isinstance(value, str) and value in REFERENCES] == []


def test_public_functions_have_docstrings():
    """No public function of the package is without a docstring."""
    assert [f"{path.name}:{name}" for path in sources() for name, text in public_functions(path) if not text] == []


@pytest.mark.parametrize("name", PUBLIC_FUNCTIONS)
def test_public_api_documents_parameters_and_returns(name):
    """Every parameter is documented, and every function with a section Parameters has a section Returns or Yields."""
    function = PUBLIC[name]
    text = inspect.getdoc(function)
    # a solver documents its options in the class of its options
    signature = inspect.signature(getattr(function, "__wrapped__", function))
    parameters = [p for p in signature.parameters.values() if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
    if parameters:
        section = text.partition("Parameters\n----------\n")[2]
        assert section, f"{name} has no section Parameters"
        missing = [p.name for p in parameters if not re.search(rf"^[\w, *]*\b{p.name}\b[\w, *]*( :|$)", section, re.MULTILINE)]
        assert missing == []
    if "Parameters\n----------" in text and function.__annotations__.get("return") not in (None, "None"):
        assert re.search(r"^(Returns|Yields)\n-------?$", text, re.MULTILINE), f"{name} has no section Returns"


@pytest.mark.parametrize("name", PUBLIC_FUNCTIONS)
def test_public_api_has_runnable_examples(name):
    """Every function shows one call, in public names and what the example itself imports: pasted into a session, it runs."""
    examples = doctest.DocTestParser().get_examples(inspect.getdoc(PUBLIC[name]))
    assert examples, f"{name} has no example"
    nodes = list(ast.walk(ast.parse("".join(example.source for example in examples))))
    names = [node for node in nodes if isinstance(node, ast.Name)]
    mask = {node.id for node in names if isinstance(node.ctx, ast.Store)} | {node.arg for node in nodes if isinstance(node, ast.arg)}
    brought = {alias.asname or alias.name for node in nodes if isinstance(node, (ast.Import, ast.ImportFrom)) for alias in node.names}
    assert {node.id for node in names} - mask - brought - set(seisblock.__all__) - set(dir(builtins)) == set()


def test_solver_names_stand_together_in_few_files():
    """At most three files outside of the models name three solvers or more: the others ask the registry what a solver can do."""
    files = []
    for path in sources():
        literals = {node.value for node in ast.walk(syntax_tree(path)) if isinstance(node, ast.Constant) and isinstance(node.value, str)}
        if "models" not in path.parts and len(literals & set(solver_names())) >= 3:
            files.append(path.name)
    assert len(files) <= 3, files


def test_imports_have_no_cycle():
    """No import cycle, including imports inside functions and for types."""
    graph = grimp.build_graph("seisblock", exclude_type_checking_imports=False, cache_dir=None)
    modules = {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    assert sum(len(imported) for imported in modules.values()) > 1000
    graphlib.TopologicalSorter(modules).prepare()


def test_light_modules_load_no_large_package():
    """Importing a light module loads no large package."""
    # in one process, as a package that the first module loads would stay loaded
    script = (
        f"import sys, importlib\nfor name in {list(LIGHT)!r}: importlib.import_module(name); print(name, *set(sys.modules) & {HEAVY!r})"
    )
    lines = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.splitlines()
    assert lines == list(LIGHT)


def test_stack_does_not_load_the_engine():
    """Stack shares array types and cancellation only and does not load the engine's kernels."""
    script = "import sys, seisblock.models.stack.solve; print(*(name for name in sys.modules if name.startswith('seisblock.dynamics.')))"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert sorted(loaded) == ["seisblock.dynamics.array_types", "seisblock.dynamics.cancellation"]


def test_commands_import_large_packages_inside_functions():
    """Files of the command line import large packages inside functions only."""
    result = []
    for path in sources("cli"):
        for node in syntax_tree(path).body:
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            result += [f"{path.name}: {name}" for name in names if name.split(".")[0] in HEAVY]
    assert result == []


def test_only_validation_imports_scipy_signal_or_stats():
    """They take 1.5 s of CPU to load, a third of a report."""
    loading = re.compile(r"(from|import) scipy\.(signal|stats)\b")
    assert {path.relative_to(PACKAGE).parts[0] for path in sources() if loading.search(path.read_text("utf-8"))} <= {"validation"}


def test_numba_options_are_in_the_jit_package_only():
    """`numba.njit` and its options live in one place."""
    assert [path.name for path in sources() if re.search(r"@(numba\.)?n?jit\b|fastmath=", path.read_text(encoding="utf-8"))] == []


def test_no_statement_follows_a_return():
    """No statement follows return, raise, break or continue in its block."""
    ends = (ast.Return, ast.Raise, ast.Break, ast.Continue)
    for path in sources():
        for node in ast.walk(syntax_tree(path)):
            for name in ("body", "orelse", "finalbody"):
                block = getattr(node, name, [])
                for statement in block[:-1] if isinstance(block, list) else []:
                    assert not isinstance(statement, ends), f"{path}:{statement.lineno} nothing after this is done"


def test_library_does_not_print():
    """No print and no sys.stdout outside cli."""
    loud = [
        path.name
        for path in sources()
        if path.parent.name != "cli" and re.search(r"^\s*print\(|sys\.std(out|err)", path.read_text(encoding="utf-8"), re.MULTILINE)
    ]
    assert loud == []


def test_public_names_can_be_imported():
    """Every name of the public API can be imported, and `dir` lists it."""
    for name in seisblock.__all__:
        assert getattr(seisblock, name) is not None
    assert set(dir(seisblock)) == set(seisblock.__all__)


def test_public_class_names_are_unique():
    """No two public classes share a name."""
    result = {}
    for path in sources():
        for node in syntax_tree(path).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                result.setdefault(node.name, []).append(path.relative_to(PACKAGE).as_posix())
    assert {name: files for name, files in result.items() if len(files) > 1} == {}


FLAG = re.compile(r"(?<![\w-])--[a-z]")


def test_messages_below_the_command_line_name_parameters():
    """Below cli a message of anything but a presenter names a parameter, `` `dt` ``; the command line prints its option."""
    result = []
    presenters = {"text.py", "plot.py", "document.py", "animate.py"}
    for path in PACKAGE.rglob("*.py"):
        folder = path.relative_to(PACKAGE).parts[0]
        presents = folder in {"cli", "app", "report", "output", "validation"} or (folder == "models" and path.name in presenters)
        if not presents and path.name != "options.py":
            tree = syntax_tree(path)
            # help texts of options are those of the command line
            calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "option"]
            helps = {id(node) for call in calls for node in ast.walk(call)}
            texts = [node for node in ast.walk(tree) if isinstance(node, ast.Constant) and id(node) not in helps]
            result += [f"{path.name}: {node.value}" for node in texts if isinstance(node.value, str) and FLAG.search(node.value)]
    assert result == []


def test_top_level_has_at_most_60_names():
    """The top of the package stays small: the rest is in its public subpackages."""
    assert len(seisblock.__all__) <= 60
