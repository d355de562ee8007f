# SPDX-License-Identifier: BSD-3-Clause
"""What every column or array of a log looks like by its name, to show it."""

from __future__ import annotations

from forcetorque.analysis.draft.arrays import array_groups, array_time
from forcetorque.analysis.draft.likeness import likenesses, time_column
from forcetorque.exchange.heading import read_heading
from forcetorque.exchange.log_sketch import LogSketch


def looks(sketch: LogSketch) -> dict[int, str]:
    """Say what each column of a log looks like, without a robot.

    Args:
        sketch: The log.

    Returns:
        A quantity or `time`, by the place of the column; what looks like nothing is left out.
    """
    if not sketch.is_table:
        groups = array_groups(sketch.columns, ())
        chosen = array_time(sketch.columns)
        named = {group.columns[0]: group.quantity for group in groups}
        return named if chosen is None else {**named, sketch.columns.index(chosen): "time"}
    headings = [read_heading(column.name) for column in sketch.columns]
    likeness = {k: group.words or group.quantity for group in likenesses(headings, ()) for k in group.columns}
    likeness |= {k: "orientation" for first in sketch.quaternion for k in range(first, first + 4) if k not in likeness}
    time = time_column(headings, [column.step for column in sketch.columns])
    return likeness if time is None else {**likeness, time: "time"}
