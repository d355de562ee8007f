# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a plan for all sensors at once: recordings, and what each sensor is expected to err by."""

from __future__ import annotations

from typing import Annotated

from forcetorque.result import FloatOrNull, Row, Shown


class JointPlanStep(Row):
    """One recording, added to those before it."""

    step: Annotated[int, Shown("recording")]
    """Its number, from 1."""
    recording: Annotated[str, Shown("motion")]
    """Which of the given recordings has the motion."""
    sensors: Annotated[int, Shown("sensors")]
    """Sensors with a use that the recordings so far tell something of."""
    excess_before: Annotated[float, Shown("error over allowed before", digits=2)]
    """Predicted error over what is allowed, geometric mean over sensors and uses."""
    excess_after: Annotated[float, Shown("after", digits=2)]
    """The same with this recording."""


class SensorForecast(Row):
    """What one sensor is expected to err by at the loads of one use; root mean square over the loads."""

    step: int
    """Number of the recording after which this holds."""
    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    load_case: Annotated[str, Shown("use")]
    """The use."""
    force_before_N: Annotated[float, Shown("force by the prior", "N", digits=2)]
    """Predicted force error of the prior matrix, typically."""
    force_after_N: Annotated[float, Shown("after", "N", digits=2)]
    """Predicted force error of a calibration from the recordings so far."""
    force_after_at_most_N: Annotated[float, Shown("at most", "N", digits=2)]
    """With 95 % it is no more than that."""
    force_allowed_N: Annotated[FloatOrNull, Shown("allowed", "N", digits=2)]
    """What is allowed; infinite where it is not judged."""
    moment_before_Nm: Annotated[float, Shown("moment by the prior", "N m", digits=3)]
    """Predicted moment error of the prior matrix."""
    moment_after_Nm: Annotated[float, Shown("after", "N m", digits=3)]
    """Predicted moment error of a calibration."""
    moment_after_at_most_Nm: Annotated[float, Shown("at most", "N m", digits=3)]
    """With 95 % it is no more than that."""
    moment_allowed_Nm: Annotated[FloatOrNull, Shown("allowed", "N m", digits=3)]
    """What is allowed; infinite where it is not judged."""

    @property
    def excess(self) -> float:
        """Error over what is allowed, the larger of force and moment."""
        return max(self.force_after_N / self.force_allowed_N, self.moment_after_Nm / self.moment_allowed_Nm)

    @property
    def excess_before(self) -> float:
        """The same by the prior matrix."""
        return max(self.force_before_N / self.force_allowed_N, self.moment_before_Nm / self.moment_allowed_Nm)
