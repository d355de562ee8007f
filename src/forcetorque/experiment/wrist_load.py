# SPDX-License-Identifier: BSD-3-Clause
"""A wrist sensor's load as a robot of two links: the frame of the sensor, and what hangs on it."""

from __future__ import annotations

import numpy as np

from forcetorque.errors import ExperimentError
from forcetorque.estimation import Payload, identify_payload, support_motion_at
from forcetorque.experiment import schema
from forcetorque.experiment.content import ExperimentSensor
from forcetorque.recording import Interval, MovingSupport, Recording, SavitzkyGolay, Use
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot import ForceTorqueSensor, Joint, JointMotion, JointType, RobotModel, SensorFrame
from forcetorque.spatial import Inertia

LOAD_LINK = "load"
"""Link of what hangs on the sensor."""
_JOINT = "mount"


def load_model(load: schema.Load, sensor: str, inertia: Inertia) -> RobotModel:
    """Build the robot of a wrist sensor.

    Args:
        load: The `[load]` table.
        sensor: Name of the sensor.
        inertia: Inertia of the load in the sensor's frame.

    Returns:
        Two links, joined by a fixed joint with the sensor.
    """
    identity = np.eye(4)
    return RobotModel(
        name=f"load of {sensor}",
        links={load.frame: Inertia.zero(), LOAD_LINK: inertia},
        joints={
            _JOINT: Joint(
                name=_JOINT,
                type=JointType.FIXED,
                parent=load.frame,
                child=LOAD_LINK,
                parent_H_child=identity,
                axis=np.array([1.0, 0.0, 0.0]),  # a fixed joint has none
            )
        },
        sensors={
            sensor: ForceTorqueSensor(
                name=sensor,
                joint=_JOINT,
                frame=SensorFrame.CHILD,
                direction=load.measure_direction,
                child_H_sensor=identity,
            )
        },
    )


def is_wrist_load(model: RobotModel) -> bool:
    """Tell the robot of a wrist sensor from that of a URDF file.

    Args:
        model: A robot.

    Returns:
        Whether `load_model` made it.
    """
    return tuple(model.joints) == (_JOINT,) and tuple(model.links)[1:] == (LOAD_LINK,)


def given_inertia(load: schema.Load) -> Inertia | None:
    """Give the inertia that the file states.

    Args:
        load: The `[load]` table.

    Returns:
        A point mass in the sensor's frame; None where it is to be estimated.
    """
    if load.mass_kg is None or load.centre_of_mass_m is None:
        return None
    return Inertia.about_centre_of_mass(
        mass=load.mass_kg, centre_of_mass=load.centre_of_mass_m, second_moment=np.zeros((3, 3))
    )


def estimate_load(
    load: schema.Load,
    sensor: ExperimentSensor,
    recording: Recording,
    intervals: list[Interval],
    *,
    window: SavitzkyGolay,
) -> Payload:
    """Estimate mass, centre of mass and bias on the calibration intervals, with the prior matrix.

    Args:
        load: The `[load]` table.
        sensor: The sensor.
        recording: Its stream, and those of the motion.
        intervals: Intervals of the experiment.
        window: Filter that differentiates an IMU's angular velocity.

    Returns:
        The payload.

    Raises:
        ExperimentError: If the sensor has raw readings and no prior, or there is no calibration interval.
    """
    stream = recording.stream(sensor.stream)
    reading = stream.signal(sensor.quantity).values
    if sensor.quantity == "raw":
        if sensor.prior is None:
            raise ExperimentError(f"sensor {sensor.name!r}: estimating its load from raw counts needs a prior matrix")
        reading = reading @ sensor.prior.T
    chosen = np.zeros(len(stream), dtype=bool)
    for use, value in ((Use.CALIBRATION, True), (Use.IGNORE, False)):
        for interval in intervals:
            if interval.use is use:
                chosen[interval.holds(stream.stamp_ns)] = value
    if not chosen.any():
        raise ExperimentError(f'sensor {sensor.name!r}: expected samples in an interval with use = "calibration"')
    motion = support_motion_at(
        load_model(load, sensor.name, Inertia.zero()),
        recording,
        MovingSupport(frame=load.frame, motion_streams=load.motion),
        JointMotion.at_rest((), np.empty((np.count_nonzero(chosen), 0))),
        stream.stamp_ns[chosen],
        window=window,
        gravity=0.0,
    )
    complete = np.isfinite(motion.proper_acceleration).all(axis=1) & np.isfinite(reading[chosen]).all(axis=1)
    return identify_payload(
        reading[chosen][complete],
        motion.proper_acceleration[complete],
        seconds_since(stream.stamp_ns[chosen][complete], recording.start_ns),
        direction=load.measure_direction,
    )
