# SPDX-License-Identifier: BSD-3-Clause
"""The sub-model without contact that validates a sensor, how it is chosen, and links that might be in contact."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Final, TypeVar

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import (
    EstimationError,
    ExperimentError,
    RecordingError,
    RobotError,
    known_names,
    require_known,
)
from forcetorque.base.pose import invert_pose
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.long_recording import is_long, segment_runs
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import EvaluatedInstants, IntervalStart
from forcetorque.recording.alignment import require_overlap
from forcetorque.recording.recording import Interval, Use
from forcetorque.robot.contacts import Contact, ContactType
from forcetorque.robot.dynamics import body_pose
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.sub_models import SubModel, sub_models
from forcetorque.robot.tree import BodyTree, build_tree, cut_of


class OtherSensors(StrEnum):
    """What the other sensors at the cuts of the sub-model are taken to read."""

    MODEL = "model"
    """What the model expects: only the evaluated sensor errs. Right only while the support is the one contact of the
    whole robot."""
    MEASURED = "measured"
    """What they measured: contacts elsewhere do no harm, and the errors of these sensors are in the result."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactForceValidation:
    """Which sensor is evaluated, by which of the two sub-models that it bounds; nothing may touch that one."""

    tree: BodyTree
    """Robot rooted at the link whose motion is known: that of an IMU, or the fixed one."""
    sensor: str
    """Sensor that is evaluated."""
    sub_model: str | None = None
    """Sub-model that is free of contact, by the sensor at its base or the root link; None for the one outboard of the
    evaluated sensor."""
    contact: Contact | None = None
    """Contact of type `wrench` on the sub-model at which the wrench is estimated; None for the origin of the link that
    is mounted on the evaluated sensor on the sub-model's side, or of one that is fixed to it."""
    other_sensors: OtherSensors = OtherSensors.MODEL
    """What the other sensors of the sub-model are taken to read."""
    support: str | None = None
    """Link of the one contact that expected readings assume; the root link if None. It may not be on the sub-model."""
    cut_at: tuple[str, ...] | None = None
    """Sensors at which the robot is cut; all in fixed joints if None. One that does not work is left out."""
    part: SubModel = field(init=False)
    """The sub-model."""
    point: Contact = field(init=False)
    """The contact, chosen or given."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "other_sensors", OtherSensors(self.other_sensors))
        cuts = self.tree.cuts if self.cut_at is None else self.cut_at
        object.__setattr__(self, "cut_at", tuple(cuts))
        object.__setattr__(self, "part", self._bounded_part(tuple(cuts)))
        object.__setattr__(self, "point", self._point_on_part())
        self._refuse_support()

    @property
    def others(self) -> tuple[str, ...]:
        """The other sensors at the cuts of the sub-model."""
        cuts = () if self.part.sensor is None else (self.part.sensor,)
        return tuple(name for name in (*cuts, *self.part.outboard_sensors) if name != self.sensor)

    @property
    def sign(self) -> float:
        """Factor from reading less `free_reading` to the wrench at the sensor: 1 at the base, -1 at an outboard cut."""
        return 1.0 if self.part.sensor == self.sensor else -1.0

    @property
    def direction(self) -> float:
        """Factor from what the environment does to the robot to the direction in which the sensor measures; 1 or -1."""
        return -self.tree.cuts[self.sensor].sign

    @property
    def required_joints(self) -> tuple[str, ...]:
        """Joints whose motion the result depends on, each once."""
        questions = (self.contact_question, self.expected_question)
        return tuple(dict.fromkeys(joint for asked in questions if asked for joint in required_joints_of(asked)))

    @property
    def contact_question(self) -> Question:
        """What the sensors of the sub-model are asked about the contact."""
        return Question(tree=self.tree, measured=(self.sensor, *self.others), contacts=(self.point,), equations=())

    @property
    def expected_question(self) -> Question | None:
        """What the model is asked about the other sensors; None if nothing."""
        if self.other_sensors is OtherSensors.MEASURED or not self.others:
            return None
        return Question(tree=self.tree, expected=self.others, expected_contact=self.support, equations=())

    def sensor_H_contact(self, joints: JointMotion) -> FloatArray:
        """Find where the contact is, seen from the evaluated sensor.

        Args:
            joints: Motion of at least the required joints; n samples.

        Returns:
            Pose of the contact frame in the frame of the reading; shape (n, 4, 4), or (1, 4, 4) where both are on one
            rigid body; m.
        """
        cut = self.tree.cuts[self.sensor]
        body, body_H_link = self.tree.frames[self.point.link]
        sensor_H_cut, body_H_contact = invert_pose(cut.body_H_sensor), body_H_link @ self.point.link_H_contact
        if body in (cut.body, self.tree.bodies[cut.body].parent):  # both sides of a cut share their frame
            return (sensor_H_cut @ body_H_contact)[None]
        root_H_cut, root_H_body = (body_pose(self.tree, joints, index) for index in (cut.body, body))
        return sensor_H_cut @ invert_pose(root_H_cut) @ root_H_body @ body_H_contact

    def _bounded_part(self, cuts: tuple[str, ...]) -> SubModel:
        cut_of(self.tree, self.sensor)  # its error lists the sensors
        if self.sensor not in cuts:
            raise EstimationError(f"cut_at: expected the evaluated sensor {self.sensor!r} among the cuts, got {cuts}")
        parts = sub_models(self.tree, cuts)
        sides = {part.name: part for part in parts if self.sensor in (part.sensor, *part.outboard_sensors)}
        wanted = self.sensor if self.sub_model is None else self.sub_model
        if wanted not in sides:
            raise EstimationError(
                f"sub_model: expected one of the two that sensor {self.sensor!r} bounds, "
                f"{' or '.join(map(repr, sides))}, got {wanted!r}"
            )
        return sides[wanted]

    def _point_on_part(self) -> Contact:
        frames, cut = self.tree.frames, self.tree.cuts[self.sensor]
        if self.contact is None:
            body = cut.body if self.part.sensor == self.sensor else self.tree.bodies[cut.body].parent
            return Contact(link=self.tree.bodies[body].links[0], name="contact")
        require_known(self.contact.link, frames, RobotError, f"contact: no link {self.contact.link!r}")
        if frames[self.contact.link][0] not in self.part.bodies:
            links = [link for body in self.part.bodies for link in self.tree.bodies[body].links]
            raise EstimationError(
                f"contact: expected a link of sub-model {self.part.name!r}, got {self.contact.link!r}; "
                f"{known_names(self.contact.link, links)}"
            )
        if self.contact.type is not ContactType.WRENCH:
            raise EstimationError(
                f"contact on {self.contact.link!r}: expected the type wrench, which takes up whatever its sub-model "
                f"leaves unexplained, got {self.contact.type}"
            )
        return self.contact

    def _refuse_support(self) -> None:
        modelled = self.other_sensors is OtherSensors.MODEL
        support = self.tree.root_link if self.support is None and modelled else self.support
        if support is None:
            return
        require_known(support, self.tree.frames, RobotError, f"support: no link {support!r}")
        if self.tree.frames[support][0] in self.part.bodies:
            raise EstimationError(
                f"sub_model: {self.part.name!r} bears the support {support!r}, so that it is not free of contact; "
                f"judge {self.sensor!r} by the sub-model on its other side, or name the link that does bear the robot"
            )


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
            run: The evaluated sensor.

        Returns:
            The sub-model.

        Raises:
            ExperimentError: If the sensor measures fewer than six components: at another point the others count.
        """
        run.sensor.require_six_components("a validation by contact forces and joint torques")
        measured = self.other_sensors is OtherSensors.MEASURED
        corrections = corrections_of(run.experiment, self.others or {}) if measured else {}
        return FreeSubModel(run=run, whole=run, choice=self, corrections=corrections)

    def in_campaign(self, campaign: Campaign, question: Callable[[FreeSubModel], Answer]) -> dict[str, Answer]:
        """Ask the sub-model of every recording that has validation intervals.

        Args:
            campaign: The evaluated sensor.
            question: What is asked; its errors tell the file where there are several.

        Returns:
            Answers by the names of the recordings.
        """
        answers = {}
        for run in campaign.runs_with(Use.VALIDATION):
            with campaign.stated(run):
                answers[campaign.recording(run)] = question(self.in_run(run))
        return answers


BEYOND_SENSOR: Final = SubModelChoice()
"""The sub-model outboard of the sensor, other sensors as the model expects."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FreeSubModel:
    """A sub-model that the evaluated sensor bounds and that nothing touches, whatever supports the robot."""

    run: SensorRun
    """The evaluated sensor, in a recording or in a segment of one."""
    whole: SensorRun
    """The same in the whole recording."""
    choice: SubModelChoice
    """Which sub-model it is, and where its contact."""
    corrections: Mapping[str, Correction]
    """How the sensors are read, by name; empty where the others read what the model expects."""
    starts: dict[str, IntervalStart] = field(default_factory=dict)
    """Starts of the intervals that were looked at, by label."""

    def segments(self) -> Iterator[FreeSubModel]:
        """Give the same in one segment of a long recording after the other.

        Yields:
            Those with a part of a validation interval, not to be kept; that recording where it is not long.

        Raises:
            RecordingError: If an interval has no sample.
        """
        if not is_long(self.whole):
            yield replace(self, starts={})
            return
        starts: dict[str, IntervalStart] = {}
        for run in segment_runs(self.whole):
            if run.has(Use.VALIDATION):
                yield replace(self, run=run, starts=starts)
            del run
        for interval in self.whole.intervals(Use.VALIDATION):
            if interval.label not in starts:
                self.whole.instants(interval)  # says what it lacks

    def instants(self) -> Iterator[tuple[Interval, EvaluatedInstants]]:
        """Give the instants at which the sensor is evaluated.

        Yields:
            Every validation interval, or the part of one that lies in the segment, with its instants.

        Raises:
            RecordingError: If an interval of a recording that is no segment has no sample.
        """
        for interval in self.run.intervals(Use.VALIDATION):
            with stated_in(f"interval {interval.label!r}"):
                try:
                    own = self.run.instants(interval)
                except RecordingError:
                    if self.run is self.whole:
                        raise
                    continue  # the log has a gap there
                start = IntervalStart(stamp_ns=int(own.at_ns[own.samples.inside][0]))
                yield interval, replace(own, start=self.starts.setdefault(interval.label, start))

    def seen_from_support(self, interval: Interval) -> ContactForceValidation:
        """Find the sub-model in an interval.

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
    """Report a contact of the file that would be beyond a sensor which is fitted as if nothing touched.

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
        "that nothing did; if both feet were down, name all links that touched in contact_links of [[interval]], with "
        "an IMU"
    )
