# SPDX-License-Identifier: BSD-3-Clause
"""Files of a simulated leg with skin on its shank: objects rest on it, one after the other, and its sensor reads."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.contacts import Contact
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.urdf import read_urdf
from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.simulation.recordings import Loading
from tests.robot.mechanics.simulated import Simulation
from tests.scenes.robots import joint_xml, link_xml, robot_xml, sensor_xml
from tests.scenes.touched import write_touched

FILE = "leg.toml"
HIP_RAD, ANKLE_RAD = 0.4, -0.2
GRAVITY = 9.80665
NOISE = np.array([0.05, 0.05, 0.05, 0.002, 0.002, 0.002])
"""Standard deviation of the sensor's noise; N, N m."""
_URDF = robot_xml(
    link_xml("base"),
    link_xml("thigh", mass=2.0, xyz="0 0 -0.15", moments="0.01 0 0 0.01 0 0.01"),
    link_xml("shank", mass=1.5, xyz="0 0 0.1", moments="0.01 0 0 0.01 0 0.01"),
    link_xml("foot", mass=0.5, xyz="0 0 -0.03", moments="0.001 0 0 0.001 0 0.001"),
    joint_xml("hip", "base", "thigh", type="continuous", axis="0 1 0"),
    joint_xml("knee", "thigh", "shank", xyz="0 0 -0.4"),
    joint_xml("ankle", "shank", "foot", type="continuous", axis="0 1 0"),
    sensor_xml("knee_ft", "knee"),
)
_TEXT = """schema = "forcetorque/experiment/1"
name = "leg"

[robot]
urdf = "leg.urdf"

[recording]
format = "parquet"
path = "leg"

[[sensor]]
name = "knee_ft"
stream = "knee_ft"
serial = "F1"
prior = "identity"

[[patch]]
name = "shank"
serial = "S1"
counts = "counts"
layout = "shank.csv"
table = "shank.json"
friction = 0.0

[[contact]]
frame = "foot"

[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "all"
start_s = 3.0
end_s = 20.0
use = "validation"
support = "base"
"""


def write_leg(folder: Path, *, seed: int = 8) -> tuple[Sequence[ContactTruth], Simulation]:
    """Write `leg.toml` and what it needs beside the calibration, which `skin calibrate bag.toml` makes.

    Args:
        folder: Where to.
        seed: Seed of the sensor's noise.

    Returns:
        The objects, and the leg with all of them as they rest, at every message of the skin.
    """
    truths = write_touched(folder)
    (folder / "leg.urdf").write_text(_URDF, encoding="utf-8")
    counts = read_recording(folder / "touched").stream("counts")
    shares = Loading().shares(len(truths))[1]
    n = len(counts.stamp_ns)
    joints = JointMotion.at_rest(("hip", "ankle"), np.tile([HIP_RAD, ANKLE_RAD], (n, 1)))
    still = RootMotion(
        proper_acceleration=np.array([0.0, 0.0, GRAVITY]),
        angular_velocity=np.zeros(3),
        angular_acceleration=np.zeros(3),
    )
    simulation = Simulation(read_urdf(folder / "leg.urdf"), "base", joints, still)
    simulation.touch(Contact(link="shank"), shares @ np.stack([truth.wrench for truth in truths]))
    reading = simulation.reading("knee_ft") + np.random.default_rng(seed).normal(size=(n, 6)) * NOISE
    streams = {
        "counts": counts,
        "knee_ft": _stream("knee_ft", counts, _wrench(reading)),
        "joints": _stream("joints", counts, _positions(joints)),
    }
    write_recording(folder / "leg", Recording(streams=streams))
    (folder / FILE).write_text(_TEXT, encoding="utf-8")
    return truths, simulation


def _stream(name: str, counts: Stream, signal: Signal) -> Stream:
    return Stream(name=name, clock=counts.clock, stamp_ns=counts.stamp_ns, signals={signal.quantity: signal})


def _wrench(values: FloatArray) -> Signal:
    return Signal(quantity="wrench", values=values, columns=WRENCH_COMPONENTS, units=WRENCH_UNITS, frame="knee_ft")


def _positions(joints: JointMotion) -> Signal:
    return Signal(quantity="position", values=joints.position, columns=joints.names, units=("rad",) * len(joints.names))
