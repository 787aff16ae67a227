"""The criterion study of gravestones: its fits, its grid, and taking it up again."""

import numpy as np
import pytest

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.pile.top_block import rigid_top
from seisblock.core.errors import OutputError, ParameterError
from seisblock.core.units import SUN
from seisblock.criteria.gravestones import PLAIN, overturning_level
from seisblock.records import Motion
from seisblock.studies.gravestone_criterion import (
    FREQUENCIES_HZ,
    PGAS,
    RATIOS,
    Threshold,
    criterion_study,
    fit_criterion,
    fit_levels,
    record_thresholds,
    rigid_levels,
    sine_base,
    with_top,
)

SAO = Pile("sao", (PileStone("sao", 8 * SUN, 8 * SUN, 20 * SUN),), mu=2.0)
SMALL = {"frequencies": (1.0,), "pgas": (2.0, 4.0), "ratios": (2.0, 3.0, 4.0), "points": 2, "duration": 3.0}


def test_study_grid_equals_paper():
    """13 amplitudes of 100 to 1300 gal, 6 frequencies, 29 stones of H/B 1.25 to 6.5 (section 3, table 1)."""
    assert (len(PGAS), PGAS[0], PGAS[-1]) == (13, pytest.approx(1.0), pytest.approx(13.0))
    assert (FREQUENCIES_HZ[0], FREQUENCIES_HZ[-1], len(FREQUENCIES_HZ)) == (0.5, 3.0, 6)
    assert (len(RATIOS), RATIOS[0], RATIOS[-1]) == (29, 1.25, 6.5)
    assert with_top(SAO, 6.5).stones[-1].height == pytest.approx(52 * SUN)
    assert sine_base(1.0, 3.0).time[-1] == pytest.approx(20.0)


def test_fit_of_exact_thresholds_recovers_level():
    """Thresholds on a hyperbola of level a(f) fit a(f), and levels of eq. (9) fit its p, q, r."""
    levels = {f: float(overturning_level(f, PLAIN)) for f in FREQUENCIES_HZ}
    thresholds = [Threshold(f, a, levels[f] / a) for f in FREQUENCIES_HZ for a in PGAS]
    assert fit_levels(thresholds) == pytest.approx(levels)
    fit = fit_criterion(levels)
    assert (fit.p_m_s2, fit.q_hz, fit.r) == pytest.approx((PLAIN.p_m_s2, PLAIN.q_hz, PLAIN.r), rel=1e-4)
    assert fit_criterion({1.0: 8.0, 2.0: 12.0}) is None


def test_study_resumes_from_checkpoint(tmp_path):
    """Finished sines are not run again, a half-written last line is, and the answer is the same."""
    path = tmp_path / "study.jsonl"
    study = criterion_study(SAO, **SMALL, resume=path)
    assert [t.ratio for t in study.thresholds] == [None, 3.0]
    header, *lines = path.read_text(encoding="utf-8").splitlines()
    assert len(lines) == 2
    path.write_text(f"{header}\n{lines[0]}\n{lines[1][:20]}", encoding="utf-8")
    progress = []
    resumed = criterion_study(SAO, **SMALL, resume=path, progress=lambda result, total: progress.append((result, total)))
    assert resumed.thresholds == study.thresholds
    assert progress == [(2, 2)]
    assert path.read_text(encoding="utf-8").splitlines() == [header, *lines]


def test_study_rejects_checkpoint_of_another_study(tmp_path):
    """A file of another pile, or of another kind, is one sentence, and is unchanged."""
    path = tmp_path / "study.jsonl"
    criterion_study(SAO, **SMALL, resume=path)
    before = path.read_text(encoding="utf-8")
    with pytest.raises(OutputError, match="belongs to a run with other bodies"):
        criterion_study(Pile("another", SAO.stones), **SMALL, resume=path)
    assert path.read_text(encoding="utf-8") == before
    for text in ("nothing\n" + before, "a line of another program", ""):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(OutputError, match="no header of an interrupted run"):
            criterion_study(SAO, **SMALL, resume=path)
        assert path.read_text(encoding="utf-8") == text
    with pytest.raises(ParameterError, match="at least one"):
        criterion_study(SAO, pgas=())


def test_single_stone_level_is_near_rigid_block():
    """At 1 Hz the level of one stone on 5 x 5 points is near that of a rigid block with pivots at 0.8."""
    study = criterion_study(SAO, frequencies=(1.0,), pgas=(3.0, 5.0), ratios=RATIOS, duration=6.0)
    rigid = rigid_levels(study, SAO, points=5)
    assert study.levels[1.0] == pytest.approx(rigid[1.0], rel=0.06)


def test_dowelled_stones_form_one_rigid_block():
    """Sao and jodai as one body: its mass, its centre of gravity and its inertia are those of both stones."""
    pile = load_pile("wagata", reinforced=True)
    block = rigid_top(pile, 5)
    jodai, sao = pile.stones[-2:]
    mass = jodai.mass + sao.mass
    height = (jodai.mass * jodai.height / 2 + sao.mass * (jodai.height + sao.height / 2)) / mass
    inertia = sum(
        stone.mass * ((stone.width**2 + stone.height**2) / 12 + (middle - height) ** 2)
        for stone, middle in ((jodai, jodai.height / 2), (sao, jodai.height + sao.height / 2))
    )
    assert sum(block.arms) == pytest.approx(0.8 * jodai.width)
    assert (block.total_mass, block.centroid_height, block.centroid_inertia) == pytest.approx((mass, height, inertia))


def test_sine_record_has_threshold_of_sine():
    """A record that is a sine topples the stones that the sine does, at its own equivalent frequency."""
    # a cosine taper keeps its velocity free of an offset
    motion = sine_base(2.0, 1.0, 6.0)
    motion = Motion.from_arrays(motion.horizontal * np.hanning(motion.samples) ** 0.25, motion.dt)
    (shaking,) = record_thresholds(SAO, motion, pgas=(6.0,), ratios=(1.5, 2.0, 3.0, 4.0), points=2)
    assert shaking.frequency_hz == pytest.approx(2.0, rel=0.05)
    assert (
        shaking.ratio
        == criterion_study(SAO, frequencies=(2.0,), pgas=(6.0,), ratios=(1.5, 2.0, 3.0, 4.0), points=2, duration=6.0).thresholds[0].ratio
    )
