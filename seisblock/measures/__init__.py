"""Ground motion measures: peaks, equivalent frequencies, durations, intensities, spectra."""

from seisblock.measures.baseline import GroundHistory, ground_history
from seisblock.measures.duration import Duration, block_threshold, duration_above, intervals_above
from seisblock.measures.filter_sensitivity import USUAL_HIGHPASS_HZ, FilterRange, filter_range
from seisblock.measures.frequency import EquivalentFrequency, Pulse, dominant_frequency, peak_pulse, pga_pgv_frequency
from seisblock.measures.intensity import arias_intensity, cumulative_absolute_velocity, jma_class, significant_duration
from seisblock.measures.long_period import LongPeriodMotion, long_period_class, long_period_motion
from seisblock.measures.peaks import HorizontalPeak, peak_acceleration, peak_displacement, peak_horizontal, peak_velocity
from seisblock.measures.rotd import RotatedSpectrum, rotated_spectrum
from seisblock.measures.spectra import ResponseSpectrum, default_periods, fourier_amplitude, response_spectrum
from seisblock.measures.summary import ComponentMeasures, Conventions, RecordMeasures, measure
from seisblock.records.seismic_intensity import jma_intensity

__all__ = [
    "ComponentMeasures",
    "Conventions",
    "Duration",
    "EquivalentFrequency",
    "FilterRange",
    "GroundHistory",
    "HorizontalPeak",
    "LongPeriodMotion",
    "Pulse",
    "RecordMeasures",
    "ResponseSpectrum",
    "RotatedSpectrum",
    "USUAL_HIGHPASS_HZ",
    "arias_intensity",
    "cumulative_absolute_velocity",
    "block_threshold",
    "default_periods",
    "dominant_frequency",
    "duration_above",
    "filter_range",
    "fourier_amplitude",
    "ground_history",
    "jma_class",
    "jma_intensity",
    "long_period_class",
    "long_period_motion",
    "measure",
    "pga_pgv_frequency",
    "peak_acceleration",
    "peak_displacement",
    "peak_horizontal",
    "peak_pulse",
    "peak_velocity",
    "response_spectrum",
    "rotated_spectrum",
    "significant_duration",
    "intervals_above",
]
