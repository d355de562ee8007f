# SPDX-License-Identifier: BSD-3-Clause
"""Files of a simulated leg that moves, on a base that may move too, with skin, FT sensor, motors and an IMU."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.contacts import Contact
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.urdf import read_urdf
from forcetorque.skin.simulation.recordings import Loading
from tests.robot.mechanics.simulated import Simulation
from tests.scenes.robots import joint_xml, link_xml, robot_xml, sensor_xml
from tests.scenes.simulated_motor import SimulatedMotor
from tests.scenes.touched import shank_layout, write_table, write_touched

FILE = "leg.toml"
RATE_HZ = 50.0
FEW = 3
"""Rows of modules of a patch whose surface is built quickly."""
GRAVITY = 9.80665
LOADING = Loading(rest_s=9.0)
"""Nothing touches in the first interval, which friction and the offset of the sensor are fitted on."""
JOINTS = ("hip_roll", "hip_pitch", "ankle")
DRIVEN = JOINTS[:2]
"""Joints with motors, inboard of sensor and skin."""
FT_NOISE = np.array([0.1, 0.1, 0.1, 0.005, 0.005, 0.005])
FT_OFFSET = np.array([0.3, 0.3, 0.3, 0.01, 0.01, 0.01])
"""Standard deviations of noise and of the offset of a power-up; N, N m."""
MOTOR = SimulatedMotor(
    torque_constant=0.05, gear_ratio=100.0, coulomb=1.5, viscous=0.6, inertia=0.08, noise_a=0.02, offset_a=0.01
)
URDF = robot_xml(
    link_xml("base"),
    link_xml("imu"),
    link_xml("pelvis", mass=1.0, moments="0.002 0 0 0.002 0 0.002"),
    link_xml("thigh", mass=2.0, xyz="0 0 -0.15", moments="0.01 0 0 0.01 0 0.01"),
    link_xml("shank", mass=1.5, xyz="0 0 0.1", moments="0.01 0 0 0.01 0 0.01"),
    link_xml("foot", mass=0.5, xyz="0 0 -0.03", moments="0.001 0 0 0.001 0 0.001"),
    joint_xml("mount", "base", "imu", xyz="0.05 -0.02 0.1", rpy="0.1 0.2 1.5"),
    joint_xml("hip_roll", "base", "pelvis", type="continuous", axis="1 0 0"),
    joint_xml("hip_pitch", "pelvis", "thigh", type="continuous", axis="0 1 0"),
    joint_xml("knee", "thigh", "shank", xyz="0 0 -0.4"),
    joint_xml("ankle", "shank", "foot", type="continuous", axis="0 1 0"),
    sensor_xml("knee_ft", "knee"),
)
AT_REST = "gravity_direction = [0.0, 0.0, -1.0]"
BY_IMU = 'imu = ["imu"]'
FT = f"""
[[sensor]]
name = "knee_ft"
stream = "knee_ft"
serial = "F1"
prior = "identity"
measurement_noise = {FT_NOISE.tolist()}
measurement_offset_sd = {FT_OFFSET.tolist()}
"""
SKIN = """
[[patch]]
name = "shank"
serial = "S1"
counts = "counts"
layout = "shank.csv"
table = "shank.json"
friction = 0.1
"""
CURRENT = "".join(
    f'\n[[motor]]\njoint = "{joint}"\ntorque_constant_Nm_per_A = 0.05\ngear_ratio = 100.0\n' for joint in DRIVEN
)
_TEXT = """schema = "forcetorque/experiment/1"
name = "leg"

[robot]
urdf = "leg.urdf"

[recording]
format = "parquet"
path = "leg"

[fusion]
model_deviation = 0.02

[[support]]
frame = "base"
{support}

[[interval]]
label = "fit"
start_s = 2.5
end_s = 9.0
use = "calibration"
support = "base"

[[interval]]
label = "judge"
start_s = 9.0
use = "validation"
support = "base"
"""


@dataclass(frozen=True, kw_only=True)
class Faults:
    """What is wrong in the second interval, beyond what the file allows for."""

    hot_counts: float = 0.0
    """What the taxels of one side read too low for heat, at the end; half of it at the beginning; counts."""
    ft_N: float = 0.0
    """Offset of the FT sensor along each axis; N."""
    friction: float = 1.0
    """Friction of the motors over that of the first interval."""


def write_moving_leg(
    folder: Path, *, seed: int = 6, base_moves: bool = False, faults: Faults | None = None, along: int = FEW
) -> Simulation:
    """Write `leg.toml`, with all sources, and what it needs.

    Args:
        folder: Where to.
        seed: Seed of objects, taxels, motion and noise.
        base_moves: Whether the base moves, which its IMU tells; it rests, level, if not.
        faults: What is wrong; nothing if None.
        along: Rows of modules of the skin.

    Returns:
        The leg, with the objects as they press, at every message.
    """
    wrong, rng = faults or Faults(), np.random.default_rng(seed + 1000)
    truths = write_touched(folder, seed=seed, loading=LOADING, along=along)
    write_table(folder)
    (folder / "leg.urdf").write_text(URDF, encoding="utf-8")
    counts = read_recording(folder / "touched").stream("counts")
    seconds, shares = LOADING.shares(len(truths))
    simulation = Simulation(
        read_urdf(folder / "leg.urdf"), "base", _joints(seconds, rng), _base(seconds) if base_moves else _rest()
    )
    simulation.touch(Contact(link="shank"), shares @ np.stack([truth.wrench for truth in truths]))
    late = seconds >= LOADING.rest_s
    signals = {
        "knee_ft": _reading(simulation, rng, wrong.ft_N * late),
        "joints": Signal(
            quantity="position", values=simulation.joints.position, columns=JOINTS, units=("rad",) * len(JOINTS)
        ),
        "motors": _currents(simulation, rng, np.where(late, wrong.friction, 1.0)),
    }
    streams = {name: _stream(name, counts, signal) for name, signal in signals.items()}
    streams |= {"counts": _heated(counts, wrong.hot_counts, along), "imu": _imu(simulation, counts)}
    write_recording(folder / "leg", Recording(streams=streams))
    text = _TEXT.format(support=BY_IMU if base_moves else AT_REST) + FT + SKIN + CURRENT
    (folder / FILE).write_text(text, encoding="utf-8")
    return simulation


def changed(folder: Path, name: str, *changes: tuple[str, str]) -> Path:
    """Write another file of the same leg, with texts replaced."""
    text = (folder / FILE).read_text(encoding="utf-8")
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def _joints(seconds: FloatArray, rng: np.random.Generator) -> JointMotion:
    """Sines with exact derivatives."""
    omega, phase = np.array([0.9, 1.3, 1.7]), rng.uniform(0.0, 6.0, 3)
    angle, size = seconds[:, None] * omega + phase, np.array([0.4, 0.5, 0.2])
    return JointMotion(
        names=JOINTS,
        position=size * np.sin(angle),
        velocity=size * omega * np.cos(angle),
        acceleration=-size * omega**2 * np.sin(angle),
    )


def _rest() -> RootMotion:
    return RootMotion.fixed([0.0, 0.0, -1.0], gravity=GRAVITY)


def _base(seconds: FloatArray) -> RootMotion:
    """A base that is swung about: up to 0.4 rad and 2 m/s2."""
    omega, phase, size = np.array([1.1, 0.8, 0.6]), np.array([0.0, 1.0, 2.0]), np.array([0.4, 0.3, 0.2])

    def rate(times: FloatArray) -> FloatArray:
        turned: FloatArray = size * np.cos(times[..., None] * omega + phase)
        return turned

    fine = np.arange(seconds[-1] * 1000.0 + 21.0) * 1e-3
    turns, attitude = Rotation.from_rotvec(1e-3 * rate(fine + 0.5e-3)), [Rotation.identity()]
    for k in range(len(fine)):
        attitude.append(attitude[-1] * turns[k])
    world_R_base = Rotation.concatenate(attitude)[np.rint(seconds * 1000.0).astype(int)]
    pushed = 2.0 * np.sin(seconds[:, None] * np.array([1.5, 1.9, 2.3])) + np.array([0.0, 0.0, GRAVITY])
    return RootMotion(
        proper_acceleration=world_R_base.inv().apply(pushed),
        angular_velocity=rate(seconds),
        angular_acceleration=-size * omega * np.sin(seconds[:, None] * omega + phase),
    )


def _reading(simulation: Simulation, rng: np.random.Generator, offset_N: FloatArray) -> Signal:
    values = simulation.reading("knee_ft") + FT_OFFSET * rng.standard_normal(6)
    values = values + FT_NOISE * rng.standard_normal(values.shape) + offset_N[:, None] * np.repeat([1.0, 0.0], 3)
    return Signal(quantity="wrench", values=values, columns=WRENCH_COMPONENTS, units=WRENCH_UNITS, frame="knee_ft")


def _currents(simulation: Simulation, rng: np.random.Generator, factor: FloatArray) -> Signal:
    columns = []
    for joint in DRIVEN:
        _, velocity, acceleration = simulation.coordinate(joint)
        soft = MOTOR.current(simulation.torque(joint), velocity, acceleration, rng, rate_hz=RATE_HZ)
        extra = (factor - 1.0) * (MOTOR.coulomb * np.sign(velocity) + MOTOR.viscous * velocity)
        columns.append(soft + extra / (MOTOR.torque_constant * MOTOR.gear_ratio))
    values = np.stack(columns, axis=1)
    return Signal(quantity="motor_current", values=values, columns=DRIVEN, units=("A",) * len(DRIVEN))


def _imu(simulation: Simulation, counts: Stream) -> Stream:
    """What an IMU on a link of its own reads, along the axes of that link."""
    motion = simulation.links["imu"]
    link_R_root = motion.pose[:, :3, :3].transpose(0, 2, 1)
    columns = ("x", "y", "z")
    signals = {
        quantity: Signal(
            quantity=quantity,
            values=(link_R_root @ values[:, :, None])[:, :, 0],
            columns=columns,
            units=(unit,) * 3,
            frame="imu",
        )
        for quantity, values, unit in (
            ("proper_acceleration", motion.proper_acceleration, "m/s2"),
            ("angular_velocity", motion.angular_velocity, "rad/s"),
        )
    }
    return Stream(name="imu", clock=counts.clock, stamp_ns=counts.stamp_ns, signals=signals)


def _heated(counts: Stream, hot: float, along: int) -> Stream:
    """The counts, lower on the side that x points to, from the second interval on."""
    signal = counts.signal("taxel_counts")
    seconds = (counts.stamp_ns - counts.stamp_ns[0]) * 1e-9
    warmth = hot * np.linspace(0.5, 1.0, len(seconds)) * (seconds >= LOADING.rest_s)
    side = np.maximum(shank_layout(along).normals[:, 0], 0.0)
    values = signal.values - np.rint(warmth[:, None] * side)
    return replace(counts, signals={"taxel_counts": replace(signal, values=values)})


def _stream(name: str, counts: Stream, signal: Signal) -> Stream:
    return Stream(name=name, clock=counts.clock, stamp_ns=counts.stamp_ns, signals={signal.quantity: signal})
