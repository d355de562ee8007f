# SPDX-License-Identifier: BSD-3-Clause
"""Postures in which a sensor begins to disagree with the robot model, to take up again on the robot [1].

[1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), section 4.2.2, Table 4.2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.logged_posture import JointRow, logged_postures
from forcetorque.inspection.residual_findings import UNEXPLAINED
from forcetorque.recording.recording import Finding
from forcetorque.results.table import Row, Table
from forcetorque.robot.tree import build_tree, required_joints

_MOST_SHOWN = 8
"""Largest number of postures of a sensor in the table; JSON has all."""


class PostureRow(Row):
    """Where the joints stood when something began that the robot model does not explain."""

    sensor: str
    """Sensor."""
    kind: str
    """Kind of the finding, such as `contact` or `step`."""
    time_s: float
    """First sample; s from the earliest stamp of the recording."""
    size: float | None
    """Size of the finding, in `unit`."""
    unit: str | None
    """Unit of the size."""
    joints: tuple[JointRow, ...]
    """Joints that the expected wrench of the sensor depends on, where they were logged on its clock."""


def unexplained_postures(experiment: Experiment, findings: Sequence[Finding]) -> Iterator[PostureRow]:
    """Find the postures in which something begins that the robot model does not explain.

    Args:
        experiment: The experiment.
        findings: Findings of `inspect`.

    Yields:
        A row per finding, by sensor, in the order of time; none where no joint that matters was logged.
    """
    recording = experiment.recording
    for sensor in experiment.sensors:
        begun = [
            (finding, finding.start_ns)
            for finding in findings
            if finding.sensor == sensor.name and finding.kind in UNEXPLAINED and finding.start_ns is not None
        ]
        if not begun:
            continue
        instants = np.array([start_ns for _, start_ns in begun], dtype=np.int64)
        roots = {one.support.frame for one in recording.intervals if one.support is not None}
        needed = {joint for root in roots for joint in required_joints(build_tree(experiment.model, root), sensor.name)}
        postures = logged_postures(recording, recording.stream(sensor.stream), instants)
        for (finding, start_ns), posture in zip(begun, postures, strict=True):
            joints = tuple(row for row in posture if row.joint in needed)
            if joints:
                yield PostureRow(
                    sensor=sensor.name,
                    kind=finding.kind,
                    time_s=1e-9 * (start_ns - recording.start_ns),
                    size=finding.size,
                    unit=finding.unit,
                    joints=joints,
                )


def posture_tables(rows: Sequence[PostureRow]) -> Iterator[Table | str]:
    """Write the postures of each sensor, a column per joint.

    Args:
        rows: Postures, by sensor.

    Yields:
        A table per sensor, with the first postures of many.
    """
    for sensor, group in groupby(rows, key=lambda row: row.sensor):
        own = list(group)
        names = [f"{joint.joint}, {'deg' if joint.unit == 'rad' else joint.unit}" for joint in own[0].joints]
        yield Table(
            caption=f"{sensor}: postures in which it begins to disagree with the model",
            headings=("at, s", "finding", "size", *names),
            rows=tuple(
                (
                    f"{row.time_s:.2f}",
                    row.kind,
                    "" if row.size is None else f"{row.size:.3g} {row.unit}",
                    *map(_position, row.joints),
                )
                for row in own[:_MOST_SHOWN]
            ),
        )
        if len(own) > _MOST_SHOWN:
            yield f"{len(own) - _MOST_SHOWN} more postures of {sensor}: see --format json"


def _position(row: JointRow) -> str:
    if row.position is None:
        return "-"
    return f"{math.degrees(row.position):.1f}" if row.unit == "rad" else f"{row.position:.4f}"
