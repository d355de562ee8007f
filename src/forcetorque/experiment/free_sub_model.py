# SPDX-License-Identifier: BSD-3-Clause
"""The sub-model without contact that validates a sensor, and links that might be in contact."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TypeVar

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.sensor_models import corrections_of
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sub_model_choice import ContactForceValidation, OtherSensors
from forcetorque.recording.alignment import require_overlap
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.contacts import Contact
from forcetorque.robot.tree import build_tree

Answer = TypeVar("Answer")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SubModelChoice:
    """Which sub-model judges a sensor, and what the other sensors are taken to read: alike in all recordings."""

    others: Mapping[str, Calibration] | None = None
    """Calibrations of the other sensors by name, for the mode `measured`; where there is none, their prior."""
    other_sensors: OtherSensors = OtherSensors.MODEL
    """Whether the other sensors read what the model expects or what they measured."""
    sub_model: str | None = None
    """The sub-model, by the sensor at its base or the root link; None for that outboard of the sensor."""
    contact: str | None = None
    """Link at whose origin the contact is estimated; None for that mounted on the sensor."""

    def in_run(self, run: SensorRun) -> FreeSubModel:
        """Decide how the other sensors are read in a recording.

        Args:
            run: The judged sensor.

        Returns:
            The sub-model.
        """
        measured = self.other_sensors is OtherSensors.MEASURED
        corrections = corrections_of(run.experiment, self.others or {}) if measured else {}
        return FreeSubModel(run=run, choice=self, corrections=corrections)

    def in_campaign(self, campaign: Campaign, question: Callable[[FreeSubModel], Answer]) -> dict[str, Answer]:
        """Ask the sub-model of every recording that has validation intervals.

        Args:
            campaign: The judged sensor.
            question: What is asked; its errors tell the file where there are several.

        Returns:
            Answers by the names of the recordings.
        """
        answers = {}
        for run in campaign.runs_with(Use.VALIDATION):
            with campaign.stated(run):
                answers[campaign.recording(run)] = question(self.in_run(run))
        return answers


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FreeSubModel:
    """A sub-model that the judged sensor bounds and that nothing touches, whatever supports the robot."""

    run: SensorRun
    """The judged sensor."""
    choice: SubModelChoice
    """Which sub-model it is, and where its contact."""
    corrections: Mapping[str, Correction]
    """How the sensors are read, by name; empty where the others read what the model expects."""

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
        experiment, contact = self.run.experiment, self.choice.contact
        return ContactForceValidation(
            tree=build_tree(experiment.model_on(interval.support), interval.support.frame),
            sensor=self.run.sensor.name,
            sub_model=self.choice.sub_model,
            contact=None if contact is None else Contact(link=contact, name="contact"),
            other_sensors=self.choice.other_sensors,
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
