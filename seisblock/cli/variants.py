"""Lists of width, height and friction in ``respond`` and ``rock``: one variant of the object per combination."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from seisblock.cli.azimuth_sweep import is_azimuth_sweep
from seisblock.cli.options import Source
from seisblock.cli.output import OutputOptions
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.errors import OutputError, ParameterError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.limits import MAX_VALUES, check_limit

if TYPE_CHECKING:
    from seisblock.core.results import Response
    from seisblock.output.json.schema import Document

LISTS = ("width", "height", "mu")
"""Options that accept a list, by parameter name."""


def list_variants(params: Mapping[str, Any]) -> list[dict[str, float]]:
    """Return the values of each variant that differ between them; one empty entry without lists.

    Parameters
    ----------
    params : mapping
        Tuples of ``width`` and ``height`` (m) and ``mu``, or None.
    """
    lists = {name: tuple(dict.fromkeys(params[name])) for name in LISTS if params.get(name) is not None and len(params[name]) > 1}
    variants = [dict(zip(lists, values, strict=True)) for values in itertools.product(*lists.values())]
    check_limit(N_("values"), len(variants), MAX_VALUES)
    return variants


def variant_params(params: Mapping[str, Any], variant: Mapping[str, float]) -> dict[str, Any]:
    """Return the parameters of one variant, with numbers instead of lists."""
    single = {name: params[name][0] for name in LISTS if params.get(name) is not None}
    return {**params, **single, **variant}


def describe_first(description: str, variants: list[dict[str, float]]) -> Message:
    """Return the line on the body; of several variants it describes the first."""
    if len(variants) == 1:
        return lazy_gettext("body: {says}", says=description)
    return lazy_gettext("body, first of {count}: {says}", count=len(variants), says=description)


def check_variants(source: Source, output: OutputOptions, variants: list[dict[str, float]]) -> None:
    """Raise an error for options without effect on several variants."""
    if len(variants) > 1 and is_azimuth_sweep(source):
        raise ParameterError("all-azimuths accepts one width, height and friction: give one of each, or other components")
    if len(variants) > 1 and output.animate is not None:
        raise OutputError("--animate shows one width, height and friction: give one of each, or omit --animate")


def write_variants(document: Document, output: OutputOptions, responses: list[Response[Any]], extras: list[dict[str, Any]]) -> None:
    """Print the comparison of variants and write its files."""
    from seisblock.report.text import variants as text_output

    write_results(
        document,
        output,
        tables=lambda: text_output.tables(responses, extras, gal=output.gal),
        csv=lambda: text_output.csv_columns(responses, extras),
        figure=figure_of("variants:figure", responses, extras, gal=output.gal),
    )
