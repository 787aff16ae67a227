"""Options of the samples behind an overturning probability: number, variation, seed."""

from __future__ import annotations

from typing import Any

import click

from seisblock.cli.command import Decorator, add_options, option
from seisblock.cli.option_checks import given_flags
from seisblock.cli.types import ANGLE, LENGTH, Count
from seisblock.core import checks
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_RUNS

_SPREAD_OPTIONS = {
    "size": (0.05, "Samples: half width of the variation of width and height, a ratio."),
    "inset": (0.1, "Samples: half width of the variation of a known inset, a ratio."),
    "mu": (0.2, "Samples: half width of the variation of the friction coefficient, a ratio."),
    "restitution": (0.1, "Samples: half width of the coefficient of restitution; values below 0 are extra losses of rocking impacts."),
    "amplitude": (0.1, "Samples: half width of the variation of the amplitude of the motion, a ratio."),
    "azimuth": (10.0, "Samples: half width of the azimuth of the motion, degrees."),
}
"""Default half width of each parameter's variation, and its help text."""


def version_options(*names: str, runs: int) -> Decorator:
    """Return a decorator that adds ``--runs``, ``--moved``, a ``--vary-...`` option per name, and ``--seed``.

    Examples
    --------
    >>> def f(): ...
    >>> [row.name for row in reversed(version_options("size", "azimuth", runs=0)(f).__click_params__)]
    ['runs', 'moved', 'vary_size', 'vary_azimuth', 'seed']
    """
    return add_options(
        option(
            "--runs",
            type=Count(N_("samples"), MAX_RUNS, minimum=0),
            default=runs,
            show_default=True,
            help="Samples of body and motion for the overturning probability; 0 for none.",
        ),
        option("--moved", type=LENGTH, default=0.01, help="Displacement that counts as moved, m or with a unit. [default: 1cm]"),
        *(
            option(
                f"--vary-{name}",
                type=ANGLE if name == "azimuth" else float,
                default=_SPREAD_OPTIONS[name][0],
                show_default=True,
                help=_SPREAD_OPTIONS[name][1],
            )
            for name in names
        ),
        option("--seed", type=int, default=0, show_default=True, help="Seed of the samples."),
    )  # fmt: skip


def pop_spreads(params: dict[str, Any], *names: str) -> dict[str, float]:
    """Remove the variation widths from `params` and return them by field name.

    Raises
    ------
    ParameterError
        If widths are given without samples, or the displacement that counts as moved is not positive.
    """
    _check_options(*(f"vary_{name}" for name in names), "moved", "seed")
    checks.positive("the residual displacement that counts as moved", click.get_current_context().params["moved"], "m")
    return {"azimuth_deg" if name == "azimuth" else name: params.pop(f"vary_{name}") for name in names}


def ranges_replaced() -> list[str]:
    """Return the fields of the ranges that variation widths on the command line replace."""
    return [name for option, name in (("vary_inset", "inset_m"), ("vary_mu", "mu")) if given_flags([option])]


def _check_options(*names: str) -> None:
    """Raise an error for variation options without samples."""
    from seisblock.core.errors import ParameterError

    flags = given_flags(names)
    if flags and not click.get_current_context().params["runs"]:
        raise ParameterError("{flags} has no effect without samples: give --runs, for example --runs 100", flags=flags)
