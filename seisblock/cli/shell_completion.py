"""Shell completion of components, bundled files, stones and surface pairs."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import click
from click.shell_completion import CompletionItem

from seisblock.records.motion import ALL_AZIMUTHS

Completion = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]

COMPONENT_NAMES = ("NS", "EW", "UD", "all")
"""Component names offered without reading a record."""


def complete_components(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the last component of a comma-separated list."""
    prefix, _, partial = incomplete.rpartition(",")
    # the help of a command that sweeps the azimuths says so
    sweeps = f"--component {ALL_AZIMUTHS}" in " ".join((ctx.command.help or "").split())
    names = [*COMPONENT_NAMES, *([ALL_AZIMUTHS] if sweeps else [])]
    return _completion_items((f"{prefix}," if prefix else "") + name for name in names if name.lower().startswith(partial.lower()))


def complete_bundled(kind: str, *, from_first_letter: bool = False) -> Completion:
    """Return a completion of the bundled files of a kind, if so only after the first letter, and of files."""

    def offer(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Complete names of files."""
        names = () if from_first_letter and not incomplete else _bundled_names(incomplete, kind)
        return [*_completion_items(names), CompletionItem(incomplete, type="file")]

    return offer


def complete_samples(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete bundled files."""
    return _completion_items(_bundled_names(incomplete))


def complete_bodies(*kinds: str) -> Completion:
    """Return a completion of bundled bodies of the given kinds (default: all) and files."""

    def offer(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Complete body names without suffix."""
        names = (name.removesuffix(".toml") for name in _bundled_names(incomplete, "body"))
        fitting = (name for name in names if not kinds or _body_table(name).get("kind") in kinds)
        return [*_completion_items(fitting), CompletionItem(incomplete, type="file")]

    return offer


def complete_stones(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the stones of the pile on the line."""
    stone_tables = _body_table(str(ctx.params.get("stones") or "wagata")).get("stone", [])
    return _completion_items(name for stone in stone_tables if (name := str(stone.get("name", ""))).startswith(incomplete))


def complete_surfaces(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete surface pairs with known friction."""
    from seisblock.bodies.friction import SURFACES

    return _completion_items(pair for pair in SURFACES if pair.startswith(incomplete))


def _bundled_names(incomplete: str, *kinds: str) -> Iterator[str]:
    """Yield the names of the bundled files of the given kinds."""
    from seisblock.samples import list_samples

    return (sample.name for sample in list_samples() if sample.name.startswith(incomplete) and (not kinds or sample.kind in kinds))


def _body_table(name: str) -> dict[str, Any]:
    """Return the table of a body, empty on errors: completion must not print messages."""
    from seisblock.bodies.toml import read_body_toml
    from seisblock.core.errors import SeisblockError

    try:
        return read_body_toml(name)
    except (SeisblockError, tomllib.TOMLDecodeError):
        return {}


def _completion_items(names: Iterable[str]) -> list[CompletionItem]:
    return [CompletionItem(name) for name in names]
