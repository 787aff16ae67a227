"""Syntax trees of the package, parsed once for all architecture tests."""

import ast
import functools


@functools.cache
def syntax_tree(path):
    """Return the syntax tree of a file; must not be changed."""
    return ast.parse(path.read_text(encoding="utf-8"))
