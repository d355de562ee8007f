# SPDX-License-Identifier: BSD-3-Clause
"""The reference point of a moment by the force in motion: shown where it is the other one, and never else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.ur_rtde.log_format import UrRtdeFormat
from forcetorque.formats.ur_rtde.moment_point_axes_and_gravity import is_about_other_point
from tests.formats.ur_rtde.recordings import write_text
from tests.payload.simulated_ur5 import GRAVITY, RATE_HZ, Recording, about_tcp, simulated, with_columns

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
    for recording, offset, displaced in _cases():
        assert _shown(recording, displaced, offset)
        assert not _shown(recording, displaced, -offset)
        assert not _shown(recording, recording.reading, offset)
        assert not _shown(recording, recording.reading, -offset)


@pytest.mark.parametrize("delay_s", [-0.008, 0.008])
def test_a_delay_does_not_hide_it(delay_s: float) -> None:
    """Pose and force a cycle apart move the centre by millimetres."""
    for recording, offset, displaced in _cases():
        time_s = np.arange(len(displaced)) / RATE_HZ
        late, right = (
            np.column_stack([np.interp(time_s - delay_s, time_s, column) for column in wrench.T])
            for wrench in (displaced, recording.reading)
        )
        assert _shown(recording, late, offset)
        assert not _shown(recording, right, offset)


def test_nothing_is_shown_by_an_arm_at_rest() -> None:
    """A single posture, a log without a moving sample, rows that lack, no distance, and numbers that are none."""
    recording, offset, displaced = _cases()[0]
    second = round(RATE_HZ)
    assert not _shown(recording, displaced, offset, slice(0, second))
    still = np.concatenate([np.arange(2 * k * second + 5, (2 * k + 1) * second - 5) for k in range(12)])
    assert not _shown(recording, displaced, offset, still)  # type: ignore[arg-type]  # rows by their numbers
    assert not _shown(recording, displaced, np.zeros(3))
    assert not _shown(recording, np.full_like(displaced, np.nan), offset)
    assert not _shown(recording, 1e300 * displaced, offset)


def _another_tcp(recording: Recording) -> Recording:
    """With another tool centre point from the middle of the log on, as a program sets it."""
    columns, later = recording.columns, slice(len(recording.pose) // 2, None)
    offset = np.column_stack([columns[f"tcp_offset_{k}"] for k in range(6)])
    offset[later] = [0.03, -0.02, 0.25, 0.4, 0.0, -0.3]
    turn = Rotation.from_matrix(recording.pose[:, :3, :3])
    place = recording.pose[:, :3, 3] + turn.apply(offset[:, :3])
    pose = np.hstack([place, (turn * Rotation.from_rotvec(offset[:, 3:])).as_rotvec()])
    fields = {"tcp_offset": offset, "actual_TCP_pose": pose}
    return with_columns(recording, **{f"{name}_{k}": rows[:, k] for name, rows in fields.items() for k in range(6)})


def _at_rest(recording: Recording) -> Recording:
    """Without the samples of the moves, at the stamps of the log."""
    second = round(RATE_HZ)
    kept = (np.arange(len(recording.pose)) // second) % 2 == 0
    return replace(recording, columns={name: values[kept] for name, values in recording.columns.items()})


def _with_payload_from_the_middle(recording: Recording) -> Recording:
    """The payload is declared while the log is written; the controller subtracts its weight from then on."""
    declared = simulated(701, declared_shares=(0.5,))
    half = len(recording.pose) // 2
    columns = {
        name: np.append(values[:half], declared.columns[name][half:]) for name, values in recording.columns.items()
    }
    return replace(recording, columns=columns)


@pytest.mark.parametrize(
    ("share", "change", "is_shown"),
    [
        (0.0, lambda same: same, True),
        (0.5, lambda same: same, False),
        (1.5, lambda same: same, False),
        (0.0, _with_payload_from_the_middle, False),
        (0.0, _another_tcp, False),
        (0.0, _at_rest, False),
    ],
    ids=["plain", "half declared", "more declared", "declared from the middle", "another TCP", "at rest"],
)
def test_a_log_names_the_other_point_only_where_it_is_shown(
    tmp_path: Path, share: float, change: Callable[[Recording], Recording], is_shown: bool
) -> None:
    """Without a declared payload, with one TCP and in motion; a log about the stated point names nothing at all."""
    recording = change(simulated(701, declared_shares=(share,)))
    for logged, stated in (("flange", "flange"), ("flange", "tcp"), ("tcp", "flange"), ("tcp", "tcp")):
        columns = (about_tcp(recording) if logged == "tcp" else recording).columns
        log = write_text(tmp_path / "log.csv", columns, delimiter=",")
        wrist = UrRtdeFormat().describe_specified(log, {"moment_about": stated}).wrist
        assert wrist is not None
        named = [text.partition(", by")[0] for text in wrist.contradictions]
        expected = f"moment about another point: expected moment_about = {logged}"
        assert named == [expected] * (is_shown and logged != stated)


def test_a_payload_that_is_not_stated_names_nothing(tmp_path: Path) -> None:
    """The user states 0 kg of a log without the field, whose controller subtracted half the tool, or more than it."""
    logs = 0
    for share in (0.5, 1.5):
        recording = simulated(702, declared_shares=(share,))
        for one in (recording, about_tcp(recording)):
            columns = {name: values for name, values in one.columns.items() if not name.startswith("payload")}
            log = write_text(tmp_path / "log.csv", columns, delimiter=",")
            specified: dict[str, object] = {"moment_about": "flange", "payload_kg": 0.0}
            wrist = UrRtdeFormat().describe_specified(log, specified).wrist
            assert wrist is not None
            assert wrist.contradictions == ()
            logs += 1
    assert logs == 4
