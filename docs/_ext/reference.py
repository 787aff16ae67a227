"""Reference pages generated from the program while the site is built.

A fence named `commands`, `documents`, `formats`, `gallery`, `glossary`, `literature`, `options`, `papers` or `names` (one public name per
line, those of subpackages with a dot) is replaced by the generated text, and the key of a paper in brackets, [Housner1963], by a
link to its entry.
"""

import inspect
import operator
import re
import tomllib
from collections.abc import Iterator
from dataclasses import MISSING
from pathlib import Path
from typing import Any

import click
from docutils import nodes
from sphinx.application import Sphinx

import seisblock
from seisblock.cli import COMMANDS, main
from seisblock.cli.command import SECTIONS, section_heading
from seisblock.cli.help import help_rows, paragraphs
from seisblock.core.options import document_key, option_fields, plain_help
from seisblock.core.registry import get_solver, solver_names
from seisblock.paper import papers
from seisblock.readers.registry import list_formats
from seisblock.references import REFERENCES, cited_commands, command_papers
from seisblock.report.json.paper import verdict
from seisblock.report.json.registry import OTHER_DOCUMENTS, document_commands, json_schema
from seisblock.report.text.paper import VERDICTS

FENCE = re.compile(r"^```\{(commands|documents|formats|gallery|glossary|literature|options|papers|names)\}\n(.*?)^```$", re.M | re.S)
DOCS = Path(__file__).parents[1]
KEY = re.compile(r"(?<![\w\]`])\[(" + "|".join(REFERENCES) + r")\](?![\w(_:\]])")


def plain(text: str) -> str:
    """Return a text of the command line, escaped for Markdown."""
    return re.sub(r"([\\`*_<>|\[\]{}$~#])", r"\\\1", text)


def command(name: str, context: click.Context) -> Iterator[str]:
    """Yield the reference of a command, line by line: description, options by section, examples, papers."""
    cmd = main.get_command(context, name)
    assert cmd is not None
    inner = click.Context(cmd, info_name=f"seisblock {name}", parent=None)
    yield f"## {name}\n"
    yield f"`{' '.join(['seisblock', name, *cmd.collect_usage_pieces(inner)])}`\n"
    yield from (f"{plain(part)}\n" for part in paragraphs(cmd.help or ""))
    groups: dict[str, list[str]] = {section: [] for section in SECTIONS}
    for parameter, (terms, text) in help_rows(cmd.get_params(inner), inner):
        groups[section_heading(parameter)] += [f"`{terms}`", f": {plain(text)}\n"]
    for section, rows in groups.items():
        if rows:
            yield f"**{section}**\n"
            yield from rows
    examples = getattr(cmd, "examples", ())
    if examples:
        yield "\n".join(("```sh", *examples, "```\n"))
    if name in document_commands():
        yield f"Document of `--json`: [{name}](documents.md#{name})\n"
    if name in cited_commands():
        yield "Papers: " + ", ".join(f"[{key}]" for key in command_papers(name)) + "\n"


def commands(_: str) -> str:
    """Return every command, from its help."""
    context = click.Context(main, info_name="seisblock")
    return "\n".join(line for name in COMMANDS for line in command(name, context))


def kind_of(schema: dict[str, Any]) -> str:
    """Return the type of a value in words; named types are links."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        return f"[{name}](#{name.lower()})"
    if "anyOf" in schema:
        kinds = [kind for each in schema["anyOf"] for kind in kind_of(each).split(" or ")]
        return " or ".join(sorted(dict.fromkeys(kinds), key="null".__eq__))
    if "enum" in schema:
        return ", ".join("null" if value is None else f"`{value}`" for value in schema["enum"])
    if schema.get("type") == "array":
        return f"list of {kind_of(schema['items'])}" if schema.get("items") else "list"
    if schema.get("type") == "object" and isinstance(schema.get("additionalProperties"), dict):
        return f"by name: {kind_of(schema['additionalProperties'])}"
    return str(schema.get("type", "anything"))


def table(name: str, schema: dict[str, Any]) -> str:
    """Return the keys of one type: contents, unit, meaning."""
    text = plain(schema.get("description", "").strip().replace("\n", " "))
    rows = [
        f"| `{key}` | {kind_of(value)} | {plain(value.get('unit', ''))} | {plain(' '.join(value.get('description', '').split()))} |"
        for key, value in schema.get("properties", {}).items()
    ]
    head = ["| key | holds | unit | meaning |", "|---|---|---|---|"] if rows else []
    return "\n".join((f"### {name}\n", f"{text}\n" if text else "", *head, *rows, ""))


def documents(_: str) -> str:
    """Return the keys of every document of ``--json``; shared types come once, at the end."""
    types = {kind: json_schema(kind) for kind in document_commands()}
    owners: dict[str, list[str]] = {}
    for kind, schema in types.items():
        elsewhere = {name for other in OTHER_DOCUMENTS.get(kind, ()) for name in types[other]["$defs"]}
        for name in schema["$defs"].keys() - elsewhere:
            owners.setdefault(name, []).append(kind)
    parts = []
    for kind, schema in types.items():
        own = [table(name, shown) for name, shown in schema["$defs"].items() if owners[name] == [kind]]
        parts += [f"## {kind}\n", f"`{schema['title']}`, written by [`seisblock {kind}`](commands.md#{kind}).\n", *own]
    shared = {name: types[kinds[0]]["$defs"][name] for name, kinds in owners.items() if len(kinds) > 1}
    return "\n".join((*parts, "## Types that several documents share\n", *(table(name, shared[name]) for name in sorted(shared))))


def formats(_: str) -> str:
    """Return the registered formats of records: names, files of a recording, name in ObsPy."""
    rows = []
    for file_format in sorted(list_formats(), key=lambda each: each.name):
        summary = (inspect.getdoc(inspect.getmodule(file_format.parse)) or "").partition("\n")[0].replace("``", "`")
        spellings = ", ".join(f"`{name}`" for name in (file_format.name, *file_format.aliases))
        files = "one of the set" if file_format.file_set else "one file"
        rows.append(f"| {spellings} | {summary} | {files} | {file_format.obspy_name if file_format.plugin else ''} |")
    return "\n".join(("| `--format` | contents | give | ObsPy plug-in |", "|---|---|---|---|", *rows, ""))


def gallery(_: str) -> str:
    """Return every figure of the pages: thumbnails, then each with title, caption, page and command."""
    thumbnails, parts = [], []
    for page in sorted(DOCS.rglob("*.md"), key=lambda path: ("ja" in path.parts, path)):
        text, where = page.read_text(encoding="utf-8"), page.relative_to(DOCS)
        for line, name in re.findall(r"^\$ (seisblock .*?--plot (\S+\.png).*)$", text, re.M):
            shown = re.search(rf"!\[(.*)\]\(figures/{name}\)", text)
            if not shown:
                continue
            caption, figure = shown[1], where.parent / "figures" / name
            title, target = re.split(r"[:、。]", caption, maxsplit=1)[0], f"gallery-{len(parts) + 1}"
            thumbnails.append(f"[![{title}]({figure})](#{target})")
            parts.append(
                f"({target})=\n\n## {title}\n\n![{caption}]({figure})\n\n"
                f"*{caption}.* From [{text.splitlines()[0].removeprefix('# ')}]({where}):\n\n```sh\n{line}\n```\n"
            )
    return "\n".join((*thumbnails, "", *parts))


def literature(_: str) -> str:
    """Return every reference under its key."""
    entries = "\n".join(f".. [{key}] {reference.text()}" for key, reference in sorted(REFERENCES.items()))
    return "\n".join(("```{eval-rst}", entries, "```"))


def options(_: str) -> str:
    """Return the options of every solver: keyword, command-line option, document key, unit, range, default, meaning."""
    parts = []
    for name in solver_names():
        kind = get_solver(name).options
        parts += [f"## {name}\n", f"`seisblock.models.{name}.options.{kind.__name__}`\n"]
        parts += ["| keyword | option | key | unit | range | default | meaning |", "|---|---|---|---|---|---|---|"]
        for keyword, described, field in option_fields(kind):
            default = "required" if field.default is MISSING else f"`{field.default!r}`"
            flag = f"`{described.flag}`" if described.flag else ""
            cells = (plain(described.unit), plain(described.interval), default, plain(plain_help(described.help)))
            parts.append(f"| `{keyword}` | {flag} | `{document_key(keyword, described)}` | {' | '.join(cells)} |")
        parts.append("")
    return "\n".join(parts)


def names(name_list: str) -> str:
    """Return the public names of a list, those of subpackages with a dot: a table, then each with its docstring."""
    public_names = name_list.split()
    head = ["```{eval-rst}", ".. currentmodule:: seisblock", "", ".. autosummary::", "   :nosignatures:", ""]
    parts = [*head, *(f"   {name}" for name in public_names), ""]
    for name in public_names:
        value = operator.attrgetter(name)(seisblock)
        if inspect.ismodule(value):
            parts += [f".. automodule:: {value.__name__}", ""]
        elif inspect.isclass(value):
            parts += [f".. auto{'exception' if issubclass(value, Exception) else 'class'}:: seisblock.{name}", "   :members:", ""]
        else:
            parts += [f".. auto{'function' if inspect.isfunction(value) else 'data'}:: seisblock.{name}", ""]
    return "\n".join((*parts, "```"))


def paper_items(_: str) -> str:
    """Return a table of the items of each paper: command, whether the paper holds, and the causes of what differs."""
    parts = []
    for paper in papers():
        parts += [f"## {paper.key}\n", "| item | contents | command | agreement | causes of differences |", "|---|---|---|---|---|"]
        for item in paper.items:
            cases = paper.cases(item)
            causes = dict.fromkeys(case.note for case in cases if case.status == "differs")
            cells = (item.place, plain(item.title), f"`seisblock paper {paper.key.lower()} {item.name}`")
            differing = sum(case.status == "differs" for case in cases)
            share = f"{differing} of {len(cases)}" if differing else f"{len(cases)}"
            result = f"{VERDICTS[verdict(cases)]} ({share})" if cases else VERDICTS["drawn"]
            parts.append(f"| {' | '.join(cells)} | {result} | {plain('; '.join(causes))} |")
        parts.append("")
    return "\n".join(parts)


GLOSSARY_GROUPS = {
    "units": ("Units", "単位"),
    "record": ("Record", "記録"),
    "object": ("Object", "物体"),
    "response": ("Response", "応答"),
    "contact": ("Contact of stones", "石の接触"),
}


def glossary(language: str) -> str:
    """Return the terms of ``glossary.toml``, grouped, with the other language and the module."""
    japanese = language.strip() == "ja"
    terms = tomllib.loads((DOCS / "glossary.toml").read_text(encoding="utf-8"))["term"]
    lines = []
    for group, headings in GLOSSARY_GROUPS.items():
        lines.append(f"## {headings[japanese]}\n")
        for term in (term for term in terms if term["group"] == group):
            term_names = (term["ja"], term["en"]) if japanese else (term["en"], term["ja"])
            lines += [f"{term_names[0]} ({term_names[1]})", f": {term['text_ja' if japanese else 'text']} `{term['module']}`\n"]
    return "\n".join(lines)


GENERATORS = {
    "commands": commands,
    "documents": documents,
    "formats": formats,
    "gallery": gallery,
    "glossary": glossary,
    "literature": literature,
    "options": options,
    "papers": paper_items,
    "names": names,
}


def fill(app: Sphinx, page: str, source: list[str]) -> None:
    """Replace fences and keys of a page, outside of code."""
    text = FENCE.sub(lambda match: GENERATORS[match[1]](match[2]), source[0])
    pieces = re.split(r"(^```.*?^```$|`[^`\n]+`)", text, flags=re.M | re.S)
    source[0] = "".join(piece if piece.startswith("`") else KEY.sub(r"{cite}`\1`", piece) for piece in pieces)


def cite(
    name: str, raw: str, key: str, line: int, inliner: Any, options: Any = None, content: Any = ()
) -> tuple[list[nodes.Node], list[Any]]:
    """Return a link to the entry of a paper."""
    return [nodes.citation_reference(f"[{key}]_", key, refname=key)], []


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the replacements and the role."""
    app.add_role("cite", cite)
    app.connect("source-read", fill)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
