# SPDX-License-Identifier: BSD-3-Clause
"""What may touch a robot that stands on a link at rest, and is taken not to: the other foot, stated as a contact."""

from __future__ import annotations

from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.recording import Use


def possible_touch(run: SensorRun) -> str | None:
    """Say where a contact that the file states would be beyond a sensor that is fitted as if nothing touched.

    Args:
        run: The sensor.

    Returns:
        A sentence about its calibration intervals; None if there is no such contact.
    """
    places: dict[str, list[str]] = {}
    for interval in run.experiment.recording.intervals:
        if interval.use is Use.CALIBRATION:
            for name in run.possibly_touched(interval):
                places.setdefault(name, []).append(interval.label)
    if not places:
        return None
    labels = ", ".join(repr(label) for label in dict.fromkeys(label for own in places.values() for label in own))
    return (
        f"by [[contact]] {', '.join(places)} may touch the robot beyond the sensor in {labels}, and the fit takes it "
        "that nothing did; if both feet were down, name all links that touched in touched of [[interval]], with an IMU"
    )
