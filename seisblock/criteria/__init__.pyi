from .compare import CriterionResult, overturning_card
from .gravestones import (
    DOWELLED,
    PLAIN,
    GravestoneFit,
    fit_range_warnings,
    overturning_frequency,
    overturning_level,
    overturning_pga,
    overturning_ratio,
    predict,
)
from .initiation import first_mode, friction_to_rock, peak_loading_ratio
from .intensity import intensity_from_velocity
from .overturning import (
    housner_acceleration,
    housner_acceleration_as_printed,
    ishiyama_acceleration,
    ishiyama_velocity,
    static_acceleration,
    tsutsui_sine_velocity,
    tsutsui_velocity,
    velocity_step,
)
from .pulses import half_sine_ratio, one_sine_ratio, rectangular_ratio
from .sliding import min_friction_to_hold, min_friction_to_stop, pulse_slip, slip_acceleration, slip_limits, steady_slip
from .uplift import SquareBaseModes, harmonic_uplift_ratio, square_base_modes

__all__ = [
    "DOWELLED",
    "first_mode",
    "PLAIN",
    "min_friction_to_hold",
    "min_friction_to_stop",
    "friction_to_rock",
    "GravestoneFit",
    "half_sine_ratio",
    "harmonic_uplift_ratio",
    "housner_acceleration",
    "housner_acceleration_as_printed",
    "intensity_from_velocity",
    "ishiyama_acceleration",
    "ishiyama_velocity",
    "predict",
    "peak_loading_ratio",
    "one_sine_ratio",
    "fit_range_warnings",
    "overturning_card",
    "overturning_frequency",
    "overturning_level",
    "overturning_pga",
    "overturning_ratio",
    "pulse_slip",
    "rectangular_ratio",
    "CriterionResult",
    "slip_acceleration",
    "slip_limits",
    "square_base_modes",
    "SquareBaseModes",
    "static_acceleration",
    "steady_slip",
    "tsutsui_sine_velocity",
    "tsutsui_velocity",
    "velocity_step",
]
