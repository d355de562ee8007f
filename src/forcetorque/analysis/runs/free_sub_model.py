# SPDX-License-Identifier: BSD-3-Clause
"""The sub-model that nothing touches, by which a sensor is judged, and how the other sensors are read meanwhile."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Self

from forcetorque.analysis.runs.corrections import corrections_of
from forcetorque.analysis.runs.reading import Correction, wrench_at
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Contact
from forcetorque.evaluation import ContactForceValidation, OtherSensors
from forcetorque.recording import Interval
from forcetorque.recording.alignment import require_overlap
from forcetorque.robot import build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FreeSubModel:
    """A sub-model that the judged sensor bounds and that nothing touches, whatever supports the robot."""

    run: SensorRun
    """The judged sensor."""
    other_sensors: OtherSensors
    """Whether the other sensors read what the model expects or what they measured."""
    sub_model: str | None
    """The sub-model, by the sensor at its base or the root link; None for that outboard of the sensor."""
    contact: str | None
    """Link at whose origin the contact is estimated; None for that mounted on the sensor."""
    corrections: Mapping[str, Correction]
    """How the sensors are read, by name; empty where the others read what the model expects."""

    @classmethod
    def of(
        cls,
        run: SensorRun,
        *,
        others: Mapping[str, Calibration] | None = None,
        other_sensors: OtherSensors = OtherSensors.MODEL,
        sub_model: str | None = None,
        contact: str | None = None,
    ) -> Self:
        """Decide how the other sensors are read.

        Args:
            run: The judged sensor.
            others: Calibrations of the other sensors by name, for the mode `measured`; where there is none, their
                prior.
            other_sensors: Whether the other sensors read what the model expects or what they measured.
            sub_model: The sub-model, by the sensor at its base or the root link.
            contact: Link at whose origin the contact is estimated.

        Returns:
            The sub-model.
        """
        measured = other_sensors is OtherSensors.MEASURED
        return cls(
            run=run,
            other_sensors=other_sensors,
            sub_model=sub_model,
            contact=contact,
            corrections=corrections_of(run.experiment, others or {}) if measured else {},
        )

    def seen_from_support(self, interval: Interval) -> ContactForceValidation:
        """Find the sub-model in an interval.

        Args:
            interval: The interval.

        Returns:
            The sub-model, seen from the support.

        Raises:
            ExperimentError: If the interval has no support.
        """
        if interval.support is None:
            raise ExperimentError("expected a support frame, got none")
        experiment = self.run.experiment
        return ContactForceValidation(
            tree=build_tree(experiment.model_on(interval.support), interval.support.frame),
            sensor=self.run.sensor.name,
            sub_model=self.sub_model,
            contact=None if self.contact is None else Contact(link=self.contact, name="contact"),
            other_sensors=self.other_sensors,
            support=interval.support.frame,
            cut_at=tuple(sensor.name for sensor in experiment.sensors),
        )

    def measured(self, sensors: Iterable[str], interval: Interval) -> dict[str, FloatArray]:
        """Give what other sensors measured at the instants of an interval.

        Args:
            sensors: Their names.
            interval: The interval.

        Returns:
            Wrenches by name; shape (n, 6) each; N, N m; NaN in gaps.
        """
        experiment, at_ns = self.run.experiment, self.run.instants(interval).at_ns
        wrenches = {}
        for name in sensors:
            sensor = experiment.sensor(name)
            require_overlap(self.run.stream, experiment.recording.stream(sensor.stream))
            wrenches[name] = wrench_at(experiment, sensor, self.corrections[name], at_ns, interval=interval)
        return wrenches
