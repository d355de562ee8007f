# SPDX-License-Identifier: BSD-3-Clause
"""iDynTree's estimator of external wrenches and joint torques, sample by sample."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.contacts import Contact
from forcetorque.robot.motion import JointMotion, RootMotion


class IDynTree:
    """A robot in iDynTree; its coordinates are in the order of the joint motion."""

    def __init__(self, urdf: Path, joints: JointMotion) -> None:
        self.bindings = idyn = pytest.importorskip("idyntree.bindings")
        self.joints, self.estimator, names = joints, idyn.ExtWrenchesAndJointTorquesEstimator(), idyn.StringVector()
        for name in joints.names:
            names.push_back(name)
        assert self.estimator.loadModelAndSensorsFromFileWithSpecifiedDOFs(str(urdf), names)
        self.model = self.estimator.model()
        assert self.model.getNrOfDOFs() == len(joints.names)
        tags, kind = self.estimator.sensors(), idyn.SIX_AXIS_FORCE_TORQUE
        self.sensors = tuple(tags.getSensor(kind, i).getName() for i in range(tags.getNrOfSensors(kind)))
        self.readings = idyn.SensorsMeasurements(tags)
        self.wrenches, self.torques = idyn.LinkContactWrenches(self.model), idyn.JointDOFsDoubleArray(self.model)

    def fix(self, k: int, link: str, gravity: FloatArray) -> None:
        """Take sample k of the joints, with a link that stands still."""
        frame, vector = self.model.getFrameIndex(link), self.bindings.Vector3.FromPython
        assert self.estimator.updateKinematicsFromFixedBase(*self._state(k), frame, vector(gravity))

    def float(self, k: int, link: str, root: RootMotion) -> None:
        """Take sample k of the joints, and of the motion of a link."""
        frame, vector = self.model.getFrameIndex(link), self.bindings.Vector3.FromPython
        base = (root.proper_acceleration[k], root.angular_velocity[k], root.angular_acceleration[k])
        assert self.estimator.updateKinematicsFromFloatingBase(*self._state(k), frame, *map(vector, base))

    def expected(self, contact: str) -> tuple[dict[str, FloatArray], FloatArray]:
        """Readings and torques where one link takes up everything."""
        unknowns = self._unknowns([Contact(link=contact)])
        assert self.estimator.computeExpectedFTSensorsMeasurements(unknowns, self.readings, self.wrenches, self.torques)
        found = {}
        for i, name in enumerate(self.sensors):
            wrench = self.bindings.Wrench()
            self.readings.getMeasurement(self.bindings.SIX_AXIS_FORCE_TORQUE, i, wrench)
            found[name] = wrench.asVector().toNumPy().copy()
        return found, self.torques.toNumPy().copy()

    def estimate(
        self, readings: Mapping[str, FloatArray], contacts: Sequence[Contact]
    ) -> tuple[dict[str, FloatArray], FloatArray]:
        """Contact wrenches along the axes of their links, about the contact frames' origins, and torques."""
        for i, name in enumerate(self.sensors):
            wrench = self.bindings.Wrench.FromPython(readings[name])
            self.readings.setMeasurement(self.bindings.SIX_AXIS_FORCE_TORQUE, i, wrench)
        unknowns = self._unknowns(contacts)
        assert self.estimator.estimateExtWrenchesAndJointTorques(unknowns, self.readings, self.wrenches, self.torques)
        found = {}
        for contact in contacts:
            link = self.model.getFrameLink(self.model.getFrameIndex(contact.link))
            found[contact.name] = self.wrenches.contactWrench(link, 0).contactWrench.asVector().toNumPy().copy()
        return found, self.torques.toNumPy().copy()

    def net_wrenches(self) -> dict[str, FloatArray]:
        """Net wrench of every link that iDynTree has, in its frame; it holds all links that are fixed to it."""
        found = self.bindings.LinkWrenches(self.model)
        names = [self.model.getLinkName(i) for i in range(self.model.getNrOfLinks())]
        assert self.estimator.estimateLinkNetWrenchesWithoutGravity(found)
        return {name: found(i).asVector().toNumPy().copy() for i, name in enumerate(names)}

    def link_H_frame(self, frame: str) -> FloatArray:
        """Pose of a frame in the link that iDynTree has it on."""
        pose: FloatArray = (
            self.model.getFrameTransform(self.model.getFrameIndex(frame)).asHomogeneousTransform().toNumPy()
        )
        return pose

    def link_of(self, frame: str) -> str:
        """Link that iDynTree has a frame on; empty where it has no such frame."""
        index = self.model.getFrameIndex(frame)
        return "" if index < 0 else str(self.model.getLinkName(self.model.getFrameLink(index)))

    def _state(self, k: int) -> list[Any]:
        motion = (self.joints.position, self.joints.velocity, self.joints.acceleration)
        return [self.bindings.JointPosDoubleArray.FromPython(values[k]) for values in motion]

    def _unknowns(self, contacts: Sequence[Contact]) -> Any:
        unknowns = self.bindings.LinkUnknownWrenchContacts(self.model)
        unknowns.clear()
        for contact in contacts:
            position = self.bindings.Position.FromPython(contact.link_H_contact[:3, 3])
            unknown = self.bindings.UnknownWrenchContact(self.bindings.FULL_WRENCH, position)
            assert unknowns.addNewContactInFrame(self.model, self.model.getFrameIndex(contact.link), unknown)
        return unknowns
