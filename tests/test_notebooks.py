"""Notebooks of the documentation: made by their script, and every cell runs."""

import ast
import json

import matplotlib as mpl
import pytest

from tests.make_notebooks import FOLDER, NOTEBOOKS, notebook


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_notebook_file_is_what_its_script_makes(name):
    assert (FOLDER / name).read_text(encoding="utf-8") == notebook(NOTEBOOKS[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", NOTEBOOKS)
def test_notebook_cells_run_and_show_their_last_value(name, tmp_path, monkeypatch):
    """As a kernel does: statements are executed, the last expression of a cell is shown, here by its HTML or its repr."""
    monkeypatch.chdir(tmp_path)
    mpl.use("agg")
    names: dict[str, object] = {}
    cells = json.loads((FOLDER / name).read_text(encoding="utf-8"))["cells"]
    for cell in (cell for cell in cells if cell["cell_type"] == "code"):
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, name, "exec"), names)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), name, "eval"), names)
            output = value._repr_html_() if hasattr(value, "_repr_html_") else repr(value)
            assert output and "Traceback" not in output
