"""Validation of the common solver inputs: body, motion and vertical gain."""

from __future__ import annotations

from typing import TypeAlias

from seisblock.core import checks
from seisblock.core.errors import ComponentError, KindError
from seisblock.core.i18n import lazy_gettext
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


def vertical_gain(motion: Motion, vertical: Gain | None) -> float:
    """Return the factor applied to the vertical acceleration of a motion.

    Parameters
    ----------
    motion : Motion
    vertical : bool, float or None
        Switch or factor; None applies the vertical component where the record has one.

    Raises
    ------
    ParameterError
        If the factor is not a finite number.
    ComponentError
        If a nonzero gain is requested and the motion's record has no vertical component.
    """
    # a missing component is a row of zeros, which a factor of one leaves alone
    if vertical is None:
        return 1.0
    gain = checks.finite("the vertical gain", float(vertical) if isinstance(vertical, bool) else vertical)
    if gain != 0.0 and motion.record is not None and motion.record.vertical is None:
        raise ComponentError(
            "{source}: no vertical component (components: {codes}); switch the vertical motion off or use a record with a vertical "
            "component",
            source=motion.record.source or lazy_gettext("record"),
            codes=motion.record.codes,
        )
    return gain
