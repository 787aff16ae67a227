"""The package's files as Python reads them, each parsed once: many rules of the house look at all of them."""

import ast
import functools


@functools.cache
def syntax_tree(path):
    """Return the syntax tree of a file, which nobody changes."""
    return ast.parse(path.read_text(encoding="utf-8"))
