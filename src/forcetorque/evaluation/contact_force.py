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
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_shape
from forcetorque.errors import EstimationError, ShapeError, known_names
from forcetorque.estimation import estimate
from forcetorque.evaluation.contact_force_validation import ContactForceValidation
from forcetorque.robot import JointMotion, RootMotion, Wrenches
from forcetorque.spatial import WRENCH_COMPONENTS, invert_pose, transform_wrench


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
