# SPDX-License-Identifier: BSD-3-Clause
"""Contact-force validation: the contact wrench that a sensor reports where nothing touches (thesis 4.1.3).

The robot is cut at its sensors into sub-models. In one that nothing touches the contact wrench that
its sensors add up to should be zero; what is found instead is the error of the sensors, and is carried
back to the sensor that is judged:

    f^s = -s s_X_k f^k                                                                             (4.1)

`f^k` is what the environment does to the robot, in and about the contact frame. The factor -s, with s
the sign of the reading (`forcetorque.spatial.sign`), turns it to the direction in which the sensor
measures; it is 1, as printed, where a child on the far side of the sensor is read `child_to_parent`.

One full wrench takes up all that its sub-model leaves unexplained. Hence `f^s` does not depend on the
contact point, and is affine in the reading:

    f^s = reading - free_reading        of the sensor at the base of the sub-model
    f^s = free_reading - reading        of a sensor at one of its outboard cuts

with one `free_reading` for all candidates: the reading with which there would be no contact. The
estimator of the robot runs once, however many candidates are judged.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_shape
from forcetorque.errors import EstimationError, RobotError, ShapeError, known_names
from forcetorque.estimation import Contact, ContactType, Question, estimate, required_joints_of
from forcetorque.robot import BodyTree, JointMotion, RootMotion, Wrenches
from forcetorque.robot.kinematics import body_pose
from forcetorque.robot.sub_model import SubModel, cut_of, sub_models
from forcetorque.spatial import WRENCH_COMPONENTS, invert_pose, transform_wrench


class OtherSensors(StrEnum):
    """What the other sensors at the cuts of the sub-model are taken to read."""

    MODEL = "model"
    """What the model expects: only the judged sensor errs. Right only while the support is the one contact of the
    whole robot."""
    MEASURED = "measured"
    """What they measured: contacts elsewhere do no harm, and the errors of these sensors are in the result."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactForceValidation:
    """Which sensor is judged, by which of the two sub-models that it bounds; nothing may touch that one."""

    tree: BodyTree
    """Robot rooted at the link whose motion is known: that of an IMU, or the fixed one."""
    sensor: str
    """Sensor that is judged."""
    sub_model: str | None = None
    """Sub-model that is free of contact, by the sensor at its base or the root link; None for the one outboard of the
    judged sensor."""
    contact: Contact | None = None
    """Contact of type `wrench` on the sub-model at which the wrench is estimated; None for the origin of the link that
    is mounted on the judged sensor on the sub-model's side, or of one that is fixed to it."""
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
        """Find where the contact is, seen from the judged sensor.

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
        pose: FloatArray = sensor_H_cut @ invert_pose(root_H_cut) @ root_H_body @ body_H_contact
        return pose

    def _bounded_part(self, cuts: tuple[str, ...]) -> SubModel:
        cut_of(self.tree, self.sensor)  # its error lists the sensors
        if self.sensor not in cuts:
            raise EstimationError(f"cut_at: expected the judged sensor {self.sensor!r} among the cuts, got {cuts}")
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
        if self.contact.link not in frames:
            raise RobotError(f"contact: no link {self.contact.link!r}; {known_names(self.contact.link, frames)}")
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
        if support not in self.tree.frames:
            raise RobotError(f"support: no link {support!r}; {known_names(support, self.tree.frames)}")
        if self.tree.frames[support][0] in self.part.bodies:
            raise EstimationError(
                f"sub_model: {self.part.name!r} bears the support {support!r}, so that it is not free of contact; "
                f"judge {self.sensor!r} by the sub-model on its other side, or name the link that does bear the robot"
            )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactForces:
    """Contact wrenches of a sub-model that nothing touches, by each of k candidates over n samples."""

    validation: ContactForceValidation
    """What was validated."""
    candidates: tuple[str, ...]
    """Names of the candidates."""
    at_sensor: FloatArray
    """Contact wrenches in the frame of the judged sensor and in its direction (4.1); shape (k, n, 6); N, N m; NaN in
    a sample with a gap."""
    free_reading: FloatArray
    """Reading of the judged sensor with which there would be no contact; shape (n, 6); N, N m."""
    sensor_H_contact: FloatArray
    """Pose of the contact frame in the frame of the reading; shape (n, 4, 4) or (1, 4, 4); m."""

    def __post_init__(self) -> None:
        free = read_only(self.free_reading, name="free_reading", shape=(None, 6))
        object.__setattr__(self, "free_reading", free)
        wrenches = read_only(self.at_sensor, name="at_sensor", shape=(len(self.candidates), len(free), 6))
        object.__setattr__(self, "at_sensor", wrenches)
        pose = read_only(self.sensor_H_contact, name="sensor_H_contact", shape=(None, 4, 4))
        object.__setattr__(self, "sensor_H_contact", pose)

    def of(self, candidate: str) -> FloatArray:
        """Give the wrenches of one candidate.

        Args:
            candidate: Its name.

        Returns:
            Wrenches in the frame and direction of the judged sensor; shape (n, 6); N, N m.

        Raises:
            EstimationError: If there is no such candidate.
        """
        if candidate not in self.candidates:
            raise EstimationError(f"no candidate {candidate!r}; {known_names(candidate, self.candidates)}")
        wrench: FloatArray = self.at_sensor[self.candidates.index(candidate)]
        return wrench

    def at_contact(self, candidate: str) -> FloatArray:
        """Give the wrenches of one candidate as the estimator has them.

        Args:
            candidate: Its name.

        Returns:
            What the environment does to the robot, in and about the contact frame; shape (n, 6); N, N m.
        """
        in_direction = transform_wrench(invert_pose(self.sensor_H_contact), self.of(candidate))
        wrench: FloatArray = self.validation.direction * in_direction
        return wrench


def contact_forces(
    validation: ContactForceValidation,
    joints: JointMotion,
    root: RootMotion,
    readings: Mapping[str, Any] | FloatArray,
    *,
    measured: Wrenches | None = None,
) -> ContactForces:
    """Estimate the contact wrench of a sub-model that nothing touches, with candidates for one of its sensors.

    NaN in a sample is a gap: it makes NaN of that sample and of no other.

    Args:
        validation: What is validated.
        joints: Motion of at least its required joints; n samples.
        root: Motion of the root link's frame; one sample or n.
        readings: What the judged sensor reads with each candidate, in its frame and direction; shape (n, 6) by name,
            or (k, n, 6), and the candidates are then named by their index; N, N m.
        measured: Readings of at least the other sensors of the sub-model; looked at only in the mode `measured`.

    Returns:
        The wrenches of every candidate.

    Raises:
        EstimationError: If readings of other sensors are missing, or a number is infinite.
        RobotError: If a joint that is needed is not in `joints`.
        ShapeError: If numbers of samples differ, or there is no candidate.
    """
    candidates = _named(readings, len(joints))
    unread = _contact_if_it_read_zero(validation, joints, root, measured)
    pose = validation.sensor_H_contact(joints)
    free = -validation.sign * validation.direction * transform_wrench(pose, unread)
    wrenches = np.empty((len(candidates), len(joints), 6))
    for wrench, (name, reading) in zip(wrenches, candidates.items(), strict=True):
        np.subtract(reading, free, out=wrench)
        wrench *= validation.sign
        whole = np.isfinite(wrench).all(axis=1)
        if not whole.all():
            _refuse_infinite(name, reading)
            wrench[~whole] = np.nan  # a wrench at another point mixes all components
    wrenches.setflags(write=False)  # held as it is, not copied
    return ContactForces(
        validation=validation,
        candidates=tuple(candidates),
        at_sensor=wrenches,
        free_reading=free,
        sensor_H_contact=pose,
    )


def _named(readings: Mapping[str, Any] | FloatArray, n: int) -> dict[str, FloatArray]:
    if isinstance(readings, Mapping):
        named = {name: np.asarray(values, dtype=np.float64) for name, values in readings.items()}
    else:
        stacked = np.asarray(readings, dtype=np.float64)
        require_shape(stacked, name="readings", shape=(None, n, 6))
        named = {str(index): values for index, values in enumerate(stacked)}
    if not named:
        raise ShapeError("readings: expected at least one candidate, got none")
    for name, values in named.items():
        require_shape(values, name=f"readings of {name!r}", shape=(n, 6))
    return named


def _refuse_infinite(candidate: str, reading: FloatArray) -> None:
    places = np.argwhere(np.isinf(reading))
    if len(places):
        sample, component = places[0].tolist()
        raise EstimationError(
            f"readings of {candidate!r}: expected finite numbers, or NaN for a gap; {WRENCH_COMPONENTS[component]} is "
            f"{reading[sample, component]} in sample {sample}"
        )


def _contact_if_it_read_zero(
    validation: ContactForceValidation, joints: JointMotion, root: RootMotion, measured: Wrenches | None
) -> FloatArray:
    """What the estimator finds at the contact if the judged sensor reads zero; shape (n, 6)."""
    readings = {validation.sensor: np.zeros((len(joints), 6)), **_others(validation, joints, root, measured)}
    estimates = estimate(validation.contact_question, joints, root, measured=Wrenches.of(readings))
    return estimates.contact(validation.point.name)


def _others(
    validation: ContactForceValidation, joints: JointMotion, root: RootMotion, measured: Wrenches | None
) -> dict[str, FloatArray]:
    question = validation.expected_question
    if question is not None:
        estimates = estimate(question, joints, root)
        return {name: estimates.expected_of(name) for name in validation.others}
    wrenches = Wrenches(names=(), values=np.empty((len(joints), 0, 6))) if measured is None else measured
    for name in validation.others:
        if name not in wrenches.names:
            raise EstimationError(
                f"measured: reading of sensor {name!r}, which bounds sub-model {validation.part.name!r}, is missing; "
                f"{known_names(name, wrenches.names)}; if it has none, leave it out of cut_at, or take the mode model"
            )
    return {name: wrenches.of_name(name) for name in validation.others}
