# SPDX-License-Identifier: BSD-3-Clause
"""Whether accelerations contradict who acts on whom by the file.

A weight reads alike where `measure_direction` and `gravity_direction` are both reversed, and every push comes out with
the other sign. Only the inertia of what hangs on the sensor tells the two apart.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.analysis.draft.hanging import hanging
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.recording import Support, Use
from forcetorque.spatial import MeasureDirection


def reversed_sense(run: SensorRun) -> Iterator[str]:
    """Name the sense of a reading on an arm whose tool is a `[[load]]`, where the accelerations say the other one.

    Args:
        run: The sensor.

    Yields:
        A sentence where they do; none where the arm moves too slowly to tell, where the base moves, or for raw counts.
    """
    yield from run.once("reversed sense", lambda: tuple(_reversed_sense(run)))


def _reversed_sense(run: SensorRun) -> Iterator[str]:
    experiment = run.experiment
    if experiment.link_loads is None or run.sensor.quantity != "wrench" or not run.has(Use.CALIBRATION):
        return
    supports = [interval.support for interval in experiment.intervals(Use.CALIBRATION)]
    frames = {support.frame if isinstance(support, Support) else None for support in supports}
    frame, *others = frames
    if others or frame is None:
        return
    sensor, stream = experiment.model.sensor(run.sensor.name), experiment.recording.stream(run.sensor.stream)
    felt = hanging(experiment.model, sensor.joint, frame, experiment.recording, stream)
    if felt is None or not felt.says_something or felt.direction in (None, sensor.direction):
        return
    down = felt.weight if felt.direction == MeasureDirection.CHILD_TO_PARENT else -felt.weight
    along = (np.round(down / np.linalg.norm(down), 1) + 0.0).tolist()
    yield (
        f"the accelerations in the log say measure_direction = {felt.direction!r}, with which things fall along "
        f"{along} of {frame!r}, and the file says {sensor.direction.value!r}; state both so: with both reversed "
        "weights are right, and every push comes out with the other sign"
    )
