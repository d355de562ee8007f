# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file says as the arguments of `experiment_of_arrays`."""

from __future__ import annotations

from typing import Any

from forcetorque.app.python.experiment import Experiment
from forcetorque.recording.recording import Use


def arrays_of(experiment: Experiment, **changes: Any) -> dict[str, Any]:
    """The same as arrays."""
    recording, sensor = experiment.recording, experiment.sensors[0]
    readings = recording.stream(sensor.stream)
    (joints,) = (stream for stream in recording.streams.values() if "position" in stream.signals)
    position, start = joints.signal("position"), recording.start_ns
    spans = {
        interval.use: ((interval.start_ns - start) * 1e-9, (interval.end_ns - start) * 1e-9)
        for interval in recording.intervals
    }
    arguments = {
        "robot": experiment.model,
        "sensor": sensor.name,
        "time_s": (readings.stamp_ns - start) * 1e-9,
        "reading": readings.signal("raw").values,
        "joints": dict(zip(position.columns, position.values.T, strict=True)),
        "joint_time_s": (joints.stamp_ns - start) * 1e-9,
        "support": "base",
        "gravity_direction": [0.0, 0.0, -1.0],
        "calibrate": spans[Use.CALIBRATION],
        "validate": spans[Use.VALIDATION],
        "serial": sensor.serial,
        "prior": sensor.prior,
        "tolerance": "exact",
    }
    return arguments | changes
