"""Equations as MathML, which browsers render without script, font or network."""

import re

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator


def to_mathml(source: str, *, block: bool) -> str:
    """Return an equation in LaTeX as MathML."""
    # docutils takes the digits of \tfrac12 for one number
    digits = re.sub(r"(\\[td]?frac)(\d)(\d)", r"\1{\2}{\3}", source.strip())
    return latex2mathml.tex2mathml(digits, as_block=block)


def inline(writer: HTML5Translator, node: nodes.math) -> None:
    """Write an inline equation."""
    writer.body.append(to_mathml(node.astext(), block=False))
    raise nodes.SkipNode


def block(writer: HTML5Translator, node: nodes.math_block) -> None:
    """Write a displayed equation, which scrolls on narrow screens."""
    writer.body.append(f'<div class="equation">{to_mathml(node.astext(), block=True)}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
