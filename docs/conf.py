"""Configuration of the site: ``python -m sphinx -W docs site``; built and read without network access."""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent / "_ext"), str(Path(__file__).parents[1])]

from sphinx.ext import autosummary  # noqa: E402

import seisblock  # noqa: E402

autosummary.WELL_KNOWN_ABBREVIATIONS += ("eq.", "eqs.", "fig.", "figs.", "sec.")  # no end of a sentence

project = "seisblock"
author = "seisblock developers"
copyright = "seisblock developers"  # noqa: A001
version = release = seisblock.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "numpydoc", "mathml", "reference"]
exclude_patterns = ["_ext"]

myst_enable_extensions = ["dollarmath", "deflist", "attrs_inline"]
myst_heading_anchors = 3
smartquotes = False  # two hyphens are an option
html_math_renderer = "mathml"
suppress_warnings = ["ref.citation"]  # papers that no page cites

autodoc_default_options = {"member-order": "bysource"}
autodoc_typehints = "none"
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

html_theme = "furo"
html_title = "seisblock"
html_static_path = ["_static"]
html_css_files = ["seisblock.css"]
html_copy_source = html_show_sourcelink = False
html_theme_options = {
    "navigation_with_keys": True,
    "light_css_variables": {"color-brand-primary": "#a93226", "color-brand-content": "#a93226", "color-brand-visited": "#7b3f36"},
    "dark_css_variables": {"color-brand-primary": "#e59a8f", "color-brand-content": "#e59a8f", "color-brand-visited": "#d3b0aa"},
}

THEME_JA = {
    "Next": "次へ",
    "Previous": "前へ",
    "Home": "ホーム",
    "On this page": "目次",
    "Search": "検索",
    "Contents": "目次",
    "Back to top": "先頭へ",
}


def setup(app):
    """Translate the theme's own words on the Japanese pages: the site is built in one language."""
    app.connect("html-page-context", translate_theme)


def translate_theme(app, pagename, templatename, context, doctree):
    """Replace the theme's gettext on a Japanese page."""
    if pagename.startswith("ja/"):
        context["_"] = lambda text: THEME_JA.get(text, text)
