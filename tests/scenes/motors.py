# SPDX-License-Identifier: BSD-3-Clause
"""Motors for the small arm: currents beside its joints, as its torques without contact take them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.recording.recording import Recording
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.motion import RootMotion, joint_motion_at
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.scenes.experiments import PARQUET, RATE_HZ, add, edit
from tests.scenes.simulated_motor import SimulatedMotor

DRIVEN = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll")
"""Joints inboard of the arm's sensor."""
MOTOR = SimulatedMotor(
    torque_constant=0.05, gear_ratio=100.0, coulomb=1.5, viscous=0.6, inertia=0.08, noise_a=0.02, offset_a=0.01
)
FUSION = "\n[fusion]\nmodel_deviation = 0.02\n"
ERRORS = """measurement_noise = [0.3, 0.3, 0.3, 0.01, 0.01, 0.01]
measurement_offset_sd = [0.5, 0.5, 0.5, 0.02, 0.02, 0.02]
"""


def motor_tables(joints: tuple[str, ...] = DRIVEN) -> str:
    """Tables of motors."""
    tables = [
        f'\n[[motor]]\njoint = "{joint}"\ntorque_constant_Nm_per_A = 0.05\ngear_ratio = 100.0\n' for joint in joints
    ]
    return "".join(tables)


def with_motors(folder: Path, *, late_factor: float = 1.0) -> Path:
    """Add currents to the small arm, and what its file has to say; friction may be another one after 14 s."""
    recording = read_recording(folder / "recording")
    stream = recording.stream("joints")
    tree = build_tree(read_urdf(folder / "arm.urdf"), "base")
    question = Question(tree=tree, torques=DRIVEN, equations=())
    window = SavitzkyGolay(window_s=0.3, order=3)
    joints = joint_motion_at(recording, required_joints_of(question), stream.stamp_ns, window=window)
    torque = estimate(question, joints, RootMotion.fixed([0.0, 0.0, -1.0], gravity=9.80665)).torques
    rng = np.random.default_rng(3)
    late = (stream.stamp_ns - recording.start_ns) * 1e-9 > 14.0
    factor = np.where(late, late_factor, 1.0)
    current = np.empty((len(stream), len(DRIVEN)))
    for k, joint in enumerate(DRIVEN):
        column = joints.names.index(joint)
        velocity, acceleration = joints.velocity[:, column], joints.acceleration[:, column]
        soft = MOTOR.current(torque[:, k], velocity, acceleration, rng, rate_hz=RATE_HZ)
        extra = (factor - 1.0) * (MOTOR.coulomb * np.sign(velocity) + MOTOR.viscous * velocity)
        current[:, k] = soft + extra / (MOTOR.torque_constant * MOTOR.gear_ratio)
    signal = Signal(quantity="motor_current", values=current, columns=DRIVEN, units=("A",) * len(DRIVEN))
    motors = Stream(name="motors", clock=stream.clock, stamp_ns=stream.stamp_ns, signals={"motor_current": signal})
    write_recording(folder / "recording", Recording(streams={**recording.streams, "motors": motors}))
    file = edit(folder / PARQUET, 'serial = "SIM001"\n', f'serial = "SIM001"\n{ERRORS}')
    return add(file, motor_tables() + FUSION)
