# SPDX-License-Identifier: BSD-3-Clause
"""iDynTree's estimator in a Python loop, as its users write it: objects are made once, arrays converted per sample."""

from __future__ import annotations

from typing import Any

import idyntree.bindings as idyn
import numpy as np

from benchmarks.dynamics.problem import ROOT, TOUCHED, Problem
from forcetorque.base.arrays import FloatArray


class IDynTreeLoop:
    """The first samples of a problem, one after the other."""

    def __init__(self, problem: Problem, *, samples: int) -> None:
        """Load the robot.

        Args:
            problem: Robot and motion.
            samples: Number of samples.
        """
        self.samples = samples
        self.estimator = idyn.ExtWrenchesAndJointTorquesEstimator()
        names = idyn.StringVector()
        for name in problem.joints.names:
            names.push_back(name)
        _require(self.estimator.loadModelAndSensorsFromFileWithSpecifiedDOFs(str(problem.urdf), names), "load")
        self.model, sensors = self.estimator.model(), self.estimator.sensors()
        count = sensors.getNrOfSensors(idyn.SIX_AXIS_FORCE_TORQUE)
        order = [sensors.getSensor(idyn.SIX_AXIS_FORCE_TORQUE, i).getName() for i in range(count)]
        self.columns = [problem.sensors.index(name) for name in order]  # of our sensors, per sensor of iDynTree
        joints = problem.joints
        self.state = [np.array(a[:samples]) for a in (joints.position, joints.velocity, joints.acceleration)]
        self.base = problem.base()[:samples]
        self.readings = np.array(problem.readings.values[:samples])
        self.root = self.model.getFrameIndex(ROOT)
        self.one_contact, self.contacts = self._unknown((ROOT,)), self._unknown(TOUCHED)
        self.links = [self.model.getFrameLink(self.model.getFrameIndex(link)) for link in TOUCHED]
        transforms = (self.model.getFrameTransform(self.model.getFrameIndex(link)) for link in TOUCHED)
        self.link_R_contact = [transform.getRotation().toNumPy() for transform in transforms]
        self.measurements = idyn.SensorsMeasurements(sensors)
        self.wrenches, self.torques = idyn.LinkContactWrenches(self.model), idyn.JointDOFsDoubleArray(self.model)
        self.converted = [self._converted(k) for k in range(samples)]

    def expected(self) -> FloatArray:
        """Compute expected readings.

        Returns:
            Readings, by our order of sensors; shape (samples, sensors, 6); N, N m.
        """
        found, wrench = np.empty((self.samples, len(self.columns), 6)), idyn.Wrench()
        for k in range(self.samples):
            self._update(*self._converted(k))
            self._expect()
            for i, column in enumerate(self.columns):
                self.measurements.getMeasurement(idyn.SIX_AXIS_FORCE_TORQUE, i, wrench)
                found[k, column] = wrench.asVector().toNumPy()
        return found

    def expected_calls_alone(self) -> None:
        """Compute expected readings from arrays converted beforehand, and leave the results in C++."""
        for arrays in self.converted:
            self._update(*arrays)
            self._expect()

    def contacts_and_torques(self) -> tuple[FloatArray, FloatArray]:
        """Compute contact wrenches and torques from readings.

        Returns:
            Wrenches, oriented as the link that is touched, shape (samples, contacts, 6), and torques, shape
            (samples, joints); N, N m.
        """
        contacts, torques = np.empty((self.samples, len(TOUCHED), 6)), np.empty_like(self.state[0])
        for k in range(self.samples):
            self._update(*self._converted(k))
            for i, column in enumerate(self.columns):
                reading = idyn.Wrench.FromPython(self.readings[k, column])
                self.measurements.setMeasurement(idyn.SIX_AXIS_FORCE_TORQUE, i, reading)
            self._estimate()
            for i, link in enumerate(self.links):
                contacts[k, i] = self.wrenches.contactWrench(link, 0).contactWrench.asVector().toNumPy()
            torques[k] = self.torques.toNumPy()
        return contacts, torques

    def contacts_and_torques_calls_alone(self) -> None:
        """Compute contact wrenches and torques from arrays converted beforehand, and leave the results in C++."""
        for arrays in self.converted:
            self._update(*arrays)
            self._estimate()

    def in_contact_frames(self, wrenches: FloatArray) -> FloatArray:
        """Turn wrenches from the axes of the touched link to those of the contact frame.

        Args:
            wrenches: Wrenches; shape (n, contacts, 6).

        Returns:
            The same about the same points; shape (n, contacts, 6).
        """
        parts = wrenches.reshape(*wrenches.shape[:2], 2, 3)
        return np.einsum("cji,ncpj->ncpi", np.array(self.link_R_contact), parts).reshape(wrenches.shape)

    def _unknown(self, frames: tuple[str, ...]) -> Any:
        unknown = idyn.LinkUnknownWrenchContacts(self.model)
        unknown.clear()
        for frame in frames:
            full = idyn.UnknownWrenchContact(idyn.FULL_WRENCH, idyn.Position.Zero())
            _require(unknown.addNewContactInFrame(self.model, self.model.getFrameIndex(frame), full), "contact")
        return unknown

    def _converted(self, k: int) -> tuple[Any, ...]:
        array, vector = idyn.JointPosDoubleArray.FromPython, idyn.Vector3.FromPython
        base = self.base[k]
        return (*(array(values[k]) for values in self.state), vector(base[:3]), vector(base[3:6]), vector(base[6:]))

    def _update(self, q: Any, dq: Any, ddq: Any, *base: Any) -> None:
        _require(self.estimator.updateKinematicsFromFloatingBase(q, dq, ddq, self.root, *base), "kinematics")

    def _expect(self) -> None:
        done = self.estimator.computeExpectedFTSensorsMeasurements(
            self.one_contact, self.measurements, self.wrenches, self.torques
        )
        _require(done, "expected readings")

    def _estimate(self) -> None:
        done = self.estimator.estimateExtWrenchesAndJointTorques(
            self.contacts, self.measurements, self.wrenches, self.torques
        )
        _require(done, "contact wrenches")


def _require(done: bool, what: str) -> None:
    if not done:
        raise RuntimeError(f"iDynTree: {what} failed")
