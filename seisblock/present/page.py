"""One self-contained page: its style, its head, and the parts it is built of; it opens without network, on a phone and on paper."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from seisblock import __version__

STYLE = """
:root { --ink: #1c1f23; --soft: #626a73; --line: #dfe3e7; --paper: #fff; --tint: #f5f6f7;
  --accent: #c0392b; --second: #1f5a8c; --good: #2d7d46; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; padding: 1.5rem 1.25rem 3rem; max-width: 60rem; color: var(--ink); background: var(--paper);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Hiragino Sans", "Yu Gothic", "Noto Sans CJK JP", "Noto Sans JP",
    IPAGothic, sans-serif; }
header { border-bottom: 2px solid var(--ink); margin-bottom: 1.5rem; padding-bottom: .75rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.25rem; margin: 2.4rem 0 .6rem; padding-top: .6rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.02rem; margin: 1.5rem 0 .4rem; }
p, ul { margin: .5rem 0; }
a { color: var(--second); }
.soft { color: var(--soft); font-size: .9rem; }
.lead { font-size: 1.08rem; }
code, .key { font-family: ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace; font-size: .86em; overflow-wrap: anywhere; }
table { border-collapse: collapse; width: 100%; font-size: .92rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .6rem .3rem 0; text-align: right; vertical-align: top; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child, td.text, th.text { text-align: left; }
th { color: var(--soft); font-weight: 600; font-size: .84rem; }
.wide { overflow-x: auto; }
figure { margin: 1rem 0; }
figure img, figure svg { display: block; width: 100%; max-width: 44rem; height: auto; }
figcaption { color: var(--soft); font-size: .86rem; margin-top: .3rem; }
.pairs { display: grid; grid-template-columns: repeat(auto-fit, minmax(20rem, 1fr)); gap: 0 1.5rem; }
.note { border-left: 4px solid var(--accent); background: var(--tint); padding: .5rem .8rem; margin: .7rem 0; }
.verdicts { display: grid; grid-template-columns: repeat(auto-fit, minmax(13rem, 1fr)); gap: .7rem; margin: 1rem 0; }
.verdicts > div { border: 1px solid var(--line); border-left: 5px solid var(--good); padding: .5rem .7rem; }
.verdicts > div.bad { border-left-color: var(--accent); }
.verdicts > div.mild { border-left-color: #d9a441; }
.verdicts b { display: block; font-size: 1.02rem; }
.verdicts span { color: var(--soft); font-size: .88rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1rem; margin: .6rem 0; font-size: .93rem; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
footer { margin-top: 3rem; border-top: 1px solid var(--line); padding-top: .6rem; color: var(--soft); font-size: .86rem; }
@media (max-width: 40rem) {
  body { padding: 1rem .9rem 2rem; } h1 { font-size: 1.4rem; } h2 { font-size: 1.15rem; }
  dl { grid-template-columns: 1fr; gap: 0; } dd { margin-bottom: .4rem; }
  .pairs { grid-template-columns: 1fr; }
}
@media print {
  @page { size: A4; margin: 16mm 15mm; }
  body { padding: 0; max-width: none; font-size: 10pt; } a { color: inherit; text-decoration: none; }
  h2 { break-after: avoid; } h3 { break-after: avoid; } figure, tr, .note, .verdicts > div { break-inside: avoid; }
  .wide { overflow: visible; }
  figure img, figure svg { max-width: min(15cm, 100%); max-height: 16cm; width: auto; } .screen { display: none; }
}
"""
"""Everything a page looks like; a command adds what only it needs."""


def page(title: str, body: Iterable[str], *, lang: str = "en", style: str = "", subtitle: str = "", foot: str = "") -> str:
    """Return a whole HTML document.

    Parameters
    ----------
    title, subtitle : str
        Plain text.
    body : iterable of str
        HTML parts, in order.
    lang : str
        Language code of the document.
    style : str
        Further CSS.
    foot : str
        Plain text after the program's name and version.
    """
    head = f"<header><h1>{escape(title)}</h1>{f'<p class=soft>{escape(subtitle)}</p>' if subtitle else ''}</header>"
    return "\n".join(
        [
            "<!doctype html>",
            f'<html lang="{escape(lang)}"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title>",
            f"<style>{STYLE}{style}</style></head><body>",
            head,
            *body,
            f"<footer>seisblock {__version__}{' · ' + escape(foot) if foot else ''}</footer>",
            "</body></html>\n",
        ]
    )


def html_table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table of plain texts; the first column is text, the others are numbers."""
    head = "".join(f"<th>{escape(text)}</th>" for text in headings)
    body = "".join("<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def facts(pairs: Iterable[tuple[str, str]]) -> str:
    """Return pairs of name and value, plain texts, as a list."""
    return "<dl>" + "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in pairs if value) + "</dl>"


def note(text: str) -> str:
    """Return a text that should not be overlooked."""
    return f'<p class="note">{escape(text)}</p>'
