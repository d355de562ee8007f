# SPDX-License-Identifier: BSD-3-Clause
"""The reference point of a moment by the force in motion: shown where it is the other one, and never else."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.ur_rtde.point_by_motion import is_about_other_point
from tests.payload.simulated_ur5 import GRAVITY, RATE_HZ, Recording, simulated

LOGS = 6


def _shown(recording: Recording, wrench: FloatArray, other_p_taken: FloatArray, rows: slice = slice(None)) -> bool:
    pose = recording.pose[rows]
    stamp_ns = np.rint(np.arange(len(pose)) / RATE_HZ * 1e9).astype(np.int64)
    gravity = np.array([0.0, 0.0, -GRAVITY])
    return is_about_other_point(stamp_ns, pose[:, :3, :3], pose[:, :3, 3], gravity, wrench[rows], other_p_taken)


@cache
def _cases() -> list[tuple[Recording, FloatArray, FloatArray]]:
    """Recording, offset of the tool centre point, and wrench with its moment about that."""
    cases = []
    for seed in range(700, 700 + LOGS):
        recording = simulated(seed, declared_shares=(0.0,))
        offset = np.array([recording.columns[f"tcp_offset_{k}"][0] for k in range(3)])
        wrench = recording.reading.copy()
        wrench[:, 3:] -= np.cross(offset, wrench[:, :3])
        cases.append((recording, offset, wrench))
    return cases


def test_the_other_point_is_shown_by_motion() -> None:
    """In both directions, and never where the point is the one that was taken: all logs."""
    for recording, offset, about_tcp in _cases():
        assert _shown(recording, about_tcp, offset)
        assert not _shown(recording, about_tcp, -offset)
        assert not _shown(recording, recording.reading, offset)
        assert not _shown(recording, recording.reading, -offset)


@pytest.mark.parametrize("delay_s", [-0.008, 0.008])
def test_a_delay_does_not_hide_it(delay_s: float) -> None:
    """Pose and force a cycle apart move the centre by millimetres."""
    for recording, offset, about_tcp in _cases():
        time_s = np.arange(len(about_tcp)) / RATE_HZ
        late, right = (
            np.column_stack([np.interp(time_s - delay_s, time_s, column) for column in wrench.T])
            for wrench in (about_tcp, recording.reading)
        )
        assert _shown(recording, late, offset)
        assert not _shown(recording, right, offset)


def test_nothing_is_shown_by_an_arm_at_rest() -> None:
    """A single posture, a log without a moving sample, rows that lack, no distance, and numbers that are none."""
    recording, offset, about_tcp = _cases()[0]
    second = round(RATE_HZ)
    assert not _shown(recording, about_tcp, offset, slice(0, second))
    still = np.concatenate([np.arange(2 * k * second + 5, (2 * k + 1) * second - 5) for k in range(12)])
    assert not _shown(recording, about_tcp, offset, still)  # type: ignore[arg-type]  # rows by their numbers
    assert not _shown(recording, about_tcp, np.zeros(3))
    assert not _shown(recording, np.full_like(about_tcp, np.nan), offset)
    assert not _shown(recording, 1e300 * about_tcp, offset)
