# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file points to, read and checked."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray
from forcetorque.errors import ExperimentError, known_names
from forcetorque.estimation import Contact, Payload, Processing
from forcetorque.recording import Interval, Recording, Use
from forcetorque.robot import RobotModel


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentSensor:
    """A sensor of the experiment, matched to the robot and to a stream."""

    name: str
    """Name in the robot model."""
    serial: str
    """Serial number."""
    stream: str
    """Stream that holds its reading."""
    quantity: str
    """`raw` or `wrench`."""
    prior: FloatArray | None
    """Prior matrix; shape (6, c); N/count, N m/count."""
    prior_source: str | None
    """Its file, as the experiment names it; `identity` where the reading itself takes the place of counts."""
    limit_counts: float
    """Largest magnitude of a raw reading; counts."""
    amplifier_gain: tuple[float, ...] | None = None
    """Gain of each channel's amplifier while it was recorded; None if it is not known."""
    allowed_gains: tuple[float, ...] | None = None
    """Gains that its amplifiers can be set to; None if they are not known."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentContact:
    """A place where the world may touch the robot beside the support."""

    contact: Contact
    """The contact."""
    stream: str | None = None
    """Stream with the wrench of a known contact."""
    intervals: tuple[str, ...] | None = None
    """Labels of the intervals in which it may touch; None for all."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Experiment:
    """Everything that an experiment file points to."""

    name: str
    """Name of the experiment."""
    model: RobotModel
    """The robot."""
    recording: Recording
    """What was measured, with the file's intervals."""
    sensors: tuple[ExperimentSensor, ...]
    """Sensors in the order of the file."""
    contacts: tuple[ExperimentContact, ...]
    """Contacts beside the support."""
    length_scale: float | None
    """Moment that weighs as much as one newton, where contacts leave something undetermined; m."""
    processing: Processing
    """Filters and gravity."""
    regularisation: float | None
    """Lambda; counts2; None to choose it on held-out blocks."""
    payload: Payload | None
    """What hangs on a wrist sensor, estimated on the calibration intervals; None for a robot or a given load."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment names it."""

    def sensor(self, name: str) -> ExperimentSensor:
        """Find a sensor of the experiment.

        Args:
            name: Its name, or another one that the robot model has for it.

        Returns:
            The sensor.

        Raises:
            ExperimentError: If the experiment has none of that name.
        """
        for sensor in self.sensors:
            if name in (sensor.name, *self.model.sensor(sensor.name).aliases):
                return sensor
        raise ExperimentError(
            f"experiment {self.name!r} has no sensor {name!r}; {known_names(name, (s.name for s in self.sensors))}"
        )

    def intervals(self, use: Use) -> tuple[Interval, ...]:
        """Give the intervals of one use.

        Args:
            use: The use.

        Returns:
            Intervals in the order of the file.

        Raises:
            ExperimentError: If there is none.
        """
        found = tuple(interval for interval in self.recording.intervals if interval.use is use)
        if not found:
            raise ExperimentError(f'experiment {self.name!r}: expected an interval with use = "{use}", it has none')
        return found
