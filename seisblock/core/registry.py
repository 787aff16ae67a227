"""Registry of solvers: each registers itself once, in ``seisblock/models/NAME/solver.py``; commands and studies read the registry."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from seisblock.core._display import exact_repr
from seisblock.core.errors import ParameterError
from seisblock.core.options import SolverOptions

if TYPE_CHECKING:
    from seisblock.core.results import Response

ValueMap: TypeAlias = Mapping[str, Any]
RowResult: TypeAlias = tuple[ValueMap, Sequence[str]]
"""Scalar fields of an outcome, and its warnings."""

Presenter: TypeAlias = str | Callable[..., Any] | None
"""Function that presents responses, or its reference ``package.module:name``, which is imported on use."""


@dataclass(frozen=True)
class SolverBody:
    """Body of a solver with its name and options.

    Parameters
    ----------
    name : str
    body : object
        Of a type in :attr:`Solver.bodies`.
    options : SolverOptions
    """

    name: str
    body: Any
    options: Any

    @cached_property
    def option_texts(self) -> dict[str, str]:
        """Text of each option, to compare the options of bodies once for all motions."""
        return {name: exact_repr(value) for name, value in self.options.keywords().items()}


@dataclass(frozen=True, kw_only=True)
class Solver:
    """Everything that commands, batches and studies need to know of one solver.

    Parameters
    ----------
    name : str
        Of the command and of the folder in ``seisblock/models``.
    options, outcome : type
        Dataclasses of its options and of its scalar results.
    solve : callable
        ``solve(body, motion, **keywords) -> Response``; the keywords are the fields of the options.
    bodies : tuple of type
        Body types accepted without conversion.
    columns : tuple of str
        Columns used of a table of bodies.
    build_body : callable
        ``build_body(spec, values) -> SolverBody``: body and options from the row of a table and the values common to all rows.
    event : str
        Field of the outcome for the event of the solver: overturning, slip, uplift.
    event_values : tuple
        Values of that field for which the event occurred; default: true ones.
    displacement : str or None
        Field of the outcome for the displacement, or None.
    overturned : str or None
        Field of the outcome for overturning, None for a solver without overturning.
    overturned_values : tuple
        Values of that field for an overturned body.
    damage_states : mapping of str to str
        Limit states of a fragility by run, with their fields of the outcome: ``overturn``; ``slip``, a displacement, m, or a mapping of
        names to displacements.
    describe : callable, str or None
        ``describe(response, *, gal) -> str``: the result in one sentence with the direction; default: whether the event occurred.
    plot : callable, str or None
        ``plot(responses, *, gal) -> Figure``; default: a panel per channel. A reference, so that a text output does not load matplotlib.
    animate : callable, str or None
        ``animate(response, path, options)`` writes an animation; default: none.
    section : str or None
        Reference of a :class:`~seisblock.output.text.section.Section`, the model's section in the HTML report.
    document : str or None
        Reference of a :class:`~seisblock.output.json.solver.ModelDocument`; default: options, body and outcome as they are.
    solve_rows : callable or None
        ``solve_rows(bodies, motion) -> dict of name to RowResult``: several bodies at once, bit by bit as single runs; bodies without
        a result are left out.
    row_options : tuple of str
        Options that may differ between these bodies.
    threshold : callable or None
        ``threshold(body, options) -> (right, left)``: horizontal accelerations, m/s^2, at which a body at rest starts to move to +x and to
        -x under its static weight (rocks, slips or lifts); infinite where it does not move. Motion to +x starts under ground acceleration
        to -x. A spatial model takes ``axis`` as well: 1 for the directions +y and -y.
    spatial : bool
        True if the body meets all components in three dimensions, with its own orientation; else it is reduced to the plane of the motion.
    topics : tuple of str
        Topics of its references, see :mod:`seisblock.references`.
    command_topics : tuple of str
        Further topics of its command.
    """

    name: str
    options: type[SolverOptions]
    outcome: type
    solve: Callable[..., Response[Any]]
    bodies: tuple[type, ...]
    columns: tuple[str, ...]
    build_body: Callable[[Any, ValueMap], SolverBody]
    event: str
    event_values: tuple[Any, ...] = (True,)
    displacement: str | None = None
    overturned: str | None = None
    overturned_values: tuple[Any, ...] = (True,)
    damage_states: Mapping[str, str] = field(default_factory=dict)
    describe: Presenter = None
    plot: Presenter = None
    animate: Presenter = None
    section: str | None = None
    document: str | None = None
    solve_rows: Callable[[Sequence[SolverBody], Any], dict[str, RowResult]] | None = None
    row_options: tuple[str, ...] = ()
    threshold: Callable[..., tuple[float, float]] | None = None
    spatial: bool = False
    topics: tuple[str, ...] = ()
    command_topics: tuple[str, ...] = ()

    @cached_property
    def body_columns(self) -> frozenset[str]:
        """Columns of friction, which are options of the line although they belong to the body."""
        return frozenset(("mu", "mu_kinetic")) & frozenset(self.columns)

    def check_options(self, values: ValueMap) -> None:
        """Raise for values that neither the solver nor its bodies have.

        Raises
        ------
        ParameterError
            Naming them.
        """
        allowed_names = {option.name for option in fields(self.options)} | self.body_columns
        unknown = [f"`{name}`" for name in values if name not in allowed_names]
        if unknown:
            raise ParameterError("{solver} has no option {names}: omit it", solver=self.name, names=unknown)

    def make_options(self, values: ValueMap) -> Any:
        """Return the options of the solver.

        Raises
        ------
        ParameterError
            If a value is missing or outside its range.
        """
        missing = [f"`{o.name}`" for o in fields(self.options) if o.default is MISSING and o.name not in values]
        if missing:
            raise ParameterError("{solver} requires {names}", solver=self.name, names=missing)
        return self.options(**values)

    def event_occurred(self, row: ValueMap) -> bool:
        """Return whether the event of the solver occurred in a row with a result."""
        return row[self.event] in self.event_values

    def overturns(self, row: ValueMap) -> bool | None:
        """Return whether the body overturned in a row with a result; None for a solver without overturning."""
        return None if self.overturned is None else row[self.overturned] in self.overturned_values

    def presenter(self, kind: str) -> Any:
        """Return ``describe``, ``plot``, ``animate``, ``section`` or ``document`` of the solver, imported now; None if it has none."""
        value = getattr(self, kind)
        return pkgutil.resolve_name(value) if isinstance(value, str) else value

    def ignored_columns(self, columns: Iterable[str]) -> list[str]:
        """Return the columns of a body that the solver does not use."""
        return [key for key in columns if key not in self.columns]


_SOLVERS: dict[str, Solver] = {}


def register(solver: Solver) -> Solver:
    """Add a solver to the registry."""
    _SOLVERS[solver.name] = solver
    return solver


@cache
def solver_names() -> tuple[str, ...]:
    """Return the names of all solvers, without importing them: folders of ``seisblock/models`` with a module ``solver``."""
    folder = Path(__file__).parents[1] / "models"
    return tuple(sorted(path.parent.name for path in folder.glob("*/solver.py")))


def get_solver(name: str) -> Solver:
    """Return a solver by name.

    Raises
    ------
    ParameterError
        If there is none of that name.
    """
    if name not in _SOLVERS:
        if name not in solver_names():
            raise ParameterError("unknown solver {name!r}; available: {known}", name=str(name)[:100], known=list(solver_names()))
        importlib.import_module(f"seisblock.models.{name}.solver")
    return _SOLVERS[name]
