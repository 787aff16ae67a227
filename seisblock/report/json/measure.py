"""JSON document of ``seisblock measure``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from msgspec import Meta, Struct

from seisblock.measures import ComponentMeasures, Conventions, RecordMeasures, RotatedSpectrum
from seisblock.measures.long_period import LongPeriodMotion
from seisblock.measures.peaks import HorizontalPeak
from seisblock.output.json.entries import entry_type, to_entry
from seisblock.output.json.schema import Document, DocumentSchema
from seisblock.records import Record

MEASURE_PARAMETERS = entry_type(
    "MeasureParameters",
    Conventions,
    leading={
        "threshold_m_s2": Annotated[float, Meta(description="Threshold of the durations.")],
        "threshold_from": Annotated[str, Meta(description="Source of the threshold.")],
    },
    bases=(),
)


class SpectrumRow(Struct, frozen=True, kw_only=True):
    """Spectral acceleration of both horizontals at one period, damping 5 %.

    Parameters
    ----------
    period_s : float
    rotd50_m_s2, rotd100_m_s2 : float
        Median and maximum over all directions of the pseudo-spectral acceleration.
    """

    period_s: float
    rotd50_m_s2: float
    rotd100_m_s2: float


EXTRA_KEYS = {
    "jma_intensity": Annotated[float | list[float | None] | None, Meta(description="Instrumental intensity, not rounded.")],
    "jma_class": Annotated[str | list[str | None] | None, Meta(description="Class of that intensity.")],
    "long_period": Annotated[
        LongPeriodMotion | list[LongPeriodMotion | None] | None,
        Meta(description="JMA class of long-period ground motion, and the floor velocity."),
    ],
    "peak_horizontal": Annotated[HorizontalPeak | list[HorizontalPeak | None] | None, Meta(description="Peak horizontal vector.")],
    "spectra": Annotated[
        list[SpectrumRow | list[SpectrumRow]], Meta(description="RotD50 and RotD100 by period; empty without two horizontals.")
    ],
}
"""Keys of the record rather than of a component; lists for several records."""

MEASURE_RESULT = entry_type("MeasureResult", ComponentMeasures)
MEASURE = DocumentSchema("measure", MEASURE_PARAMETERS, MEASURE_RESULT, EXTRA_KEYS)


def document(
    records: Sequence[Record], answers: Sequence[RecordMeasures], conventions: Conventions, *, threshold: float, threshold_from: str
) -> Document:
    """Return the document of records: one result per component, record keys beside the results."""
    entries = [
        (r, to_entry(MEASURE_RESULT, component)) for r, measures in zip(records, answers, strict=True) for component in measures.components
    ]
    extra: dict[str, Any] = {
        "jma_intensity": [measures.jma_intensity for measures in answers],
        "jma_class": [measures.jma_class for measures in answers],
        "long_period": [measures.long_period for measures in answers],
        "peak_horizontal": [measures.horizontal for measures in answers],
        "spectra": [_spectrum_rows(measures.spectra) for measures in answers],
    }
    return MEASURE.document(
        to_entry(MEASURE_PARAMETERS, conventions, threshold_m_s2=threshold, threshold_from=threshold_from),
        entries,
        citations=answers[0].citations,
        warnings=[text for measures in answers for text in measures.warnings],
        **{key: values if len(records) > 1 else values[0] for key, values in extra.items()},
    )


def _spectrum_rows(spectrum: RotatedSpectrum | None) -> list[SpectrumRow]:
    if spectrum is None:
        return []
    columns = (spectrum.period_s.tolist(), spectrum.rotd50_m_s2.tolist(), spectrum.rotd100_m_s2.tolist())
    return [SpectrumRow(period_s=t, rotd50_m_s2=median, rotd100_m_s2=largest) for t, median, largest in zip(*columns, strict=True)]
