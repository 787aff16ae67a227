"""What a shell offers while a command line is typed: components, bundled records, bodies and cemeteries, stones, pairs of surfaces."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import click
from click.shell_completion import CompletionItem

from seisblock.records.motion import ALL_AZIMUTHS

Completion = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]

COMPONENTS = ("NS", "EW", "UD", "all")
"""What most records have."""

SWEEPING = {"batch", "fragility", "respond", "rock", "slide", "spectrum"}
"""Commands that look in every direction when they are asked to."""


def components(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer components, after those that a list already has."""
    before, _, last = incomplete.rpartition(",")
    names = [*COMPONENTS, *([ALL_AZIMUTHS] if ctx.info_name in SWEEPING else [])]
    return _items((f"{before}," if before else "") + name for name in names if name.lower().startswith(last.lower()))


def records(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer files, and the bundled records once a letter is typed."""
    return [*_items(_bundled(incomplete or "?", "record")), CompletionItem(incomplete, type="file")]


def scans(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer the bundled scans, and files."""
    return [*_items(_bundled(incomplete, "scan")), CompletionItem(incomplete, type="file")]


def samples(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer the bundled files."""
    return _items(_bundled(incomplete))


def cemeteries(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer the bundled cemeteries, and files."""
    return [*_items(_bundled(incomplete, "cemetery")), CompletionItem(incomplete, type="file")]


def outcomes(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer the bundled tables of outcomes, and files."""
    return [*_items(_bundled(incomplete, "outcomes")), CompletionItem(incomplete, type="file")]


def hazards(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer the bundled tables of hazard, and files."""
    return [*_items(_bundled(incomplete, "hazard")), CompletionItem(incomplete, type="file")]


def bodies(*kinds: str) -> Completion:
    """Return what offers the bundled bodies of some kinds (all of them when left out), and files."""

    def offer(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Offer names without their suffix, as one types them."""
        names = (name.removesuffix(".toml") for name in _bundled(incomplete, "body"))
        fitting = (name for name in names if not kinds or _table(name).get("kind") in kinds)
        return [*_items(fitting), CompletionItem(incomplete, type="file")]

    return offer


def stones(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer the stones of the pile that the line names."""
    there = _table(str(ctx.params.get("stones") or "wagata")).get("stone", [])
    return _items(name for each in there if (name := str(each.get("name", ""))).startswith(incomplete))


def surfaces(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Offer the pairs of surfaces whose friction is known."""
    from seisblock.bodies.friction import SURFACES

    return _items(pair for pair in SURFACES if pair.startswith(incomplete))


def _bundled(incomplete: str, *kinds: str) -> Iterator[str]:
    """Yield the names of the bundled files of some kinds."""
    from seisblock.samples import list_samples

    return (sample.name for sample in list_samples() if sample.name.startswith(incomplete) and (not kinds or sample.kind in kinds))


def _table(name: str) -> dict[str, Any]:
    """Return what describes a body; empty where it cannot be read: a shell is not told of errors."""
    from seisblock.bodies.toml import read_table
    from seisblock.errors import SeisblockError

    try:
        return read_table(name)
    except (SeisblockError, tomllib.TOMLDecodeError):
        return {}


def _items(names: Iterable[str]) -> list[CompletionItem]:
    """Return names as a shell takes them."""
    return [CompletionItem(name) for name in names]
