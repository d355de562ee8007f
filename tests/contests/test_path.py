# SPDX-License-Identifier: BSD-3-Clause
"""Phases go by the way that is behind, not by time; what goes another way is refused."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.contests.phases_and_runs_by_load import MotionPath, require_same_motion

NAMES = ("pitch", "yaw")
COARSE = 0.02
"""Of a phase: steps of .05 rad on a path of 7 rad, and noise of .002 rad."""


def _way(phase: FloatArray) -> FloatArray:
    return np.column_stack([np.interp(phase, [0.0, 0.5, 1.0], [-1.5, 1.5, -1.5]), 1.0 * phase])


def _run(seed: int = 0, *, pace: float = 1.0, rest: int = 0, noise: float = 0.002) -> tuple[FloatArray, FloatArray]:
    """True phases and positions of a run that slows down and rests in the middle."""
    phase = np.linspace(0.0, 1.0, 1500) ** pace
    phase = np.sort(np.append(phase, np.full(rest, 0.4)))
    return phase, _way(phase) + noise * np.random.default_rng(seed).standard_normal((len(phase), 2))


@pytest.mark.parametrize(("pace", "rest"), [(1.0, 0), (2.0, 0), (0.5, 800)])
def test_phase_is_what_is_behind(pace: float, rest: int) -> None:
    """Whatever the pace and however long it rests."""
    phase, positions = _run(pace=pace, rest=rest)
    path = MotionPath.of(NAMES, positions)
    np.testing.assert_allclose(path.phase, phase, atol=COARSE)
    assert (np.diff(path.phase) >= 0.0).all()
    middles = np.linspace(0.05, 0.95, 19)
    np.testing.assert_allclose(path.at(middles), _way(middles), atol=0.1)


def test_time_is_no_phase() -> None:
    """Negative control: a run that slows down and rests is elsewhere at equal parts of its time."""
    phase, positions = _run(pace=2.0, rest=800)
    assert np.abs(np.linspace(0.0, 1.0, len(positions)) - phase).max() > 5 * COARSE


def test_runs_of_one_motion_match_and_others_do_not() -> None:
    """The error names run, joint and phase; backwards, another way and other joints are refused."""
    same = {f"run {k}": MotionPath.of(NAMES, _run(k, pace=pace)[1]) for k, pace in enumerate((1.0, 2.0, 0.7))}
    require_same_motion(same, phases=100)
    positions = _run(5)[1]
    with pytest.raises(RecordingError, match=r"backwards: expected the motion of run 0 .*yaw .* % of the path; repeat"):
        require_same_motion(same | {"backwards": MotionPath.of(NAMES, positions[::-1])}, phases=100)
    with pytest.raises(RecordingError, match="farther: expected the motion of run 0 phase by phase, got"):
        require_same_motion(same | {"farther": MotionPath.of(NAMES, positions * [1.2, 1.0])}, phases=100)
    with pytest.raises(RecordingError, match=r"expected the motion of pitch, yaw as in run 0, got pitch, roll"):
        require_same_motion(same | {"roll": MotionPath.of(("pitch", "roll"), positions)}, phases=100)


def test_rest_is_no_motion() -> None:
    """Nothing can be aligned by it."""
    with pytest.raises(RecordingError, match="expected pitch, yaw to move by more than"):
        MotionPath.of(NAMES, 0.002 * np.random.default_rng(1).standard_normal((500, 2)))
