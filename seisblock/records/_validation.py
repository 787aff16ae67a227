"""What a solver was given: a body, then a motion, and whether the vertical ground motion acts. Said once for all solvers."""

from __future__ import annotations

from typing import TypeAlias

from seisblock.core import checks
from seisblock.core.errors import ComponentError, KindError
from seisblock.core.i18n import lazy_gettext
from seisblock.records.motion import Motion
from seisblock.records.record import Record

Gain: TypeAlias = bool | float
"""Whether something acts, or the factor by which it does."""


def validate_inputs(body: object, kind: type, motion: object) -> None:
    """Refuse what is not a body of a kind, or not a motion, with the sentence that helps.

    Raises
    ------
    KindError
        If the two stand in the wrong order, a record stands where a motion belongs, or either is something else.
    """
    if isinstance(motion, Motion) and isinstance(body, kind):
        return
    if isinstance(body, (Motion, Record)) and not isinstance(motion, (Motion, Record)):
        raise KindError(
            "the body comes first, then the motion: found a {body} before the {motion}",
            body=type(body).__name__,
            motion=type(motion).__name__,
        )
    validate_motion(motion)
    checks.instance(body, kind)


def validate_motion(motion: object) -> None:
    """Refuse what is no motion, with the sentence that helps.

    Raises
    ------
    KindError
        If a record stands where a motion belongs, or anything else.
    """
    if isinstance(motion, Record):
        code = next((component.code for component in motion.horizontals), "EW")
        raise KindError(
            "{source} is a Record: choose a component with motion_of(record, {code!r})",
            source=motion.source or lazy_gettext("this"),
            code=code,
        )
    if not isinstance(motion, Motion):
        raise KindError(
            "a Motion is needed, found {found}: make one with motion_of(record, 'EW') or Motion.from_arrays(...)",
            found=checks.type_name(motion),
        )


def vertical_gain(motion: Motion, vertical: Gain | None) -> float:
    """Return the factor on a motion's vertical row.

    Parameters
    ----------
    motion : Motion
    vertical : bool, float or None
        Whether the vertical ground motion acts, or a factor on it; None: where the record has one.

    Raises
    ------
    ParameterError
        If the factor is not a finite number.
    ComponentError
        If it is asked for, and the motion's record has no vertical component.
    """
    if vertical is None:
        return 1.0
    gain = checks.finite("the factor on the vertical motion", float(vertical) if isinstance(vertical, bool) else vertical)
    if gain != 0.0 and motion.record is not None and motion.record.vertical is None:
        raise ComponentError(
            "{source}: no vertical component; it has {codes}: leave the vertical motion out, or give a record that has one",
            source=motion.record.source or lazy_gettext("record"),
            codes=motion.record.codes,
        )
    return gain
