"""Validation of the common solver inputs: body, motion and gains."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ComponentError, KindError, ParameterError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.records.motion import Motion
from seisblock.records.record import Record

Gain: TypeAlias = bool | float
"""Switch (bool) or factor (float) on a load component."""


def validate_inputs(body: object, kind: type, motion: object) -> None:
    """Raise `KindError` unless `body` is of the expected class and `motion` is a Motion.

    Raises
    ------
    KindError
        If the arguments are in the wrong order, a Record is passed instead of a Motion, or either has another type.
    """
    if isinstance(motion, Motion) and isinstance(body, kind):
        return
    if isinstance(body, (Motion, Record)) and not isinstance(motion, (Motion, Record)):
        raise KindError(
            "wrong order of arguments: expected the body first, then the motion, found {body} before {motion}",
            body=type(body).__name__,
            motion=type(motion).__name__,
        )
    validate_motion(motion)
    checks.instance(body, kind)


def validate_motion(motion: object) -> None:
    """Raise `KindError` unless `motion` is a Motion.

    Raises
    ------
    KindError
        If `motion` is a Record or any other type.
    """
    if isinstance(motion, Record):
        code = next((component.code for component in motion.horizontals), "EW")
        raise KindError(
            "expected a Motion, found a Record ({source}): select a component with motion_of(record, {code!r})",
            source=motion.source or lazy_gettext("unnamed record"),
            code=code,
        )
    if not isinstance(motion, Motion):
        raise KindError(
            "expected a Motion, found {found}: create one with motion_of(record, 'EW') or Motion.from_arrays(...)",
            found=checks.type_name(motion),
        )


def gain_rows(gains: ArrayLike, count: int | None = None) -> FloatArray:
    """Return the gains of runs, (1, 3) or (count, 3); without a count any number of rows.

    Raises
    ------
    ParameterError
        If they are no numbers or have another shape.
    """
    values = checks.float_array("`gains`", gains)
    rows = np.atleast_2d(values)
    count = len(rows) if count is None else count
    if rows.shape not in ((1, 3), (count, 3)):
        raise ParameterError(
            "`gains` must have shape (3,) or ({rows}, 3), one row per run, found {shape}", rows=count, shape=str(values.shape)
        )
    return rows


def vertical_gain(motion: Motion, vertical: Gain | None) -> float:
    """Return the factor applied to the vertical acceleration of a motion.

    Parameters
    ----------
    motion : Motion
    vertical : bool, float or None
        Switch or factor; None applies the vertical component where the motion has one.

    Returns
    -------
    float
        With None: 1.0 if the motion's record has a vertical component, or, without a record, if any vertical sample is nonzero; else 0.0.

    Raises
    ------
    ParameterError
        If the factor is not a finite number.
    ComponentError
        If a nonzero gain is requested and the motion's record has no vertical component.
    """
    # a missing component is a row of zeros, which a factor of one leaves alone
    if vertical is None:
        return float(_has_vertical(motion))
    gain = checks.finite("the vertical gain", float(vertical) if isinstance(vertical, bool) else vertical)
    if gain != 0.0 and motion.record is not None and motion.record.vertical is None:
        raise ComponentError(
            "{source}: no vertical component (components: {codes}); switch the vertical motion off or use a record with a vertical "
            "component",
            source=motion.record.source or lazy_gettext("record"),
            codes=motion.record.codes,
        )
    return gain


def vertical_acts(motions: Iterable[Motion], vertical: Gain | None) -> bool:
    """Return True if the vertical acceleration acts in any of the motions; see :func:`vertical_gain`."""
    gains = [vertical_gain(motion, vertical) for motion in motions]  # a list, so that every motion is validated
    return any(gain != 0.0 for gain in gains)


def _has_vertical(motion: Motion) -> bool:
    """Return True if a motion has a vertical component."""
    if motion.record is not None:
        return motion.record.vertical is not None
    return bool(motion.vertical.any())
