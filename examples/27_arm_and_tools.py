# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate the wrist sensor of an arm with two tools of which one was weighed, or none.

Usage: python examples/27_arm_and_tools.py [FOLDER [URDF]] [--weighed] [--seed N]

Simulates an arm (that of the URDF: UR5 of example-robot-data) that moves for 60 s with each of two tools, and a sensor
whose maker's matrix is 3 % off; writes a log and an experiment file for each into FOLDER; calibrates from both; and
prints how far pushes of 10 N anywhere within 0.3 m are misread with either matrix, which a user never learns.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.base.inertia import Inertia
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.installed_robots import installed_robot
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf

BASE, JOINT, LINK = "base_link", "ee_fixed_joint", "ee_link"
FULL_SCALE = np.array([150.0, 150.0, 150.0, 10.0, 10.0, 10.0])
NOISE = np.array([0.1, 0.1, 0.1, 0.005, 0.005, 0.005])
DURATION_S, RATE_HZ = 60.0, 50.0
TOOLS = {"gripper": (1.3, [0.01, 0.02, 0.06]), "weight": (2.2, [-0.04, 0.05, 0.12])}
"""Mass in kg and centre of mass in m, in the frame of the link."""

EXPERIMENT = """schema = "forcetorque/experiment/1"
name = "{tool}"

[robot]
urdf = "{urdf}"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "{tool}.csv"
stamp = {{ column = "t_s", unit = "s" }}

[[recording.stream.signal]]
quantity = "position"
columns = {columns}
units = {radians}
names = {joints}

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "wrist_ft"

[[sensor]]
name = "wrist_ft"
stream = "log"
serial = "FT-17"
prior = "identity"
full_scale = [150, 150, 150, 10, 10, 10]
joint = "{joint}"
measure_direction = "child_to_parent"

[[support]]
frame = "{base}"
gravity_direction = {gravity}

[[load]]
name = "{tool}"
link = "{link}"
{stated}
[[interval]]
label = "fit"
start_s = 0.0
end_s = {split_s}
use = "calibration"
support = "{base}"

[[interval]]
label = "judge"
start_s = {split_s}
use = "validation"
support = "{base}"
"""


def main() -> None:
    """Simulate, calibrate, and compare with the truth."""
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    words.add_argument(
        "folder",
        nargs="?",
        type=Path,
        default=Path("arm_and_tools"),
        help="folder for logs and files; made if it does not exist",
    )
    words.add_argument(
        "urdf",
        nargs="?",
        type=Path,
        help="URDF of a UR5 with the links base_link and ee_link (default: that of the package example-robot-data)",
    )
    words.add_argument("--weighed", action="store_true", help="state mass and centre of mass of the second tool")
    words.add_argument("--seed", type=int, default=1, help="seed of sensor, motion and noise")
    asked = words.parse_args()
    urdf = asked.urdf or installed_robot("ur5").urdf
    truth = simulate(asked.folder, urdf, seed=asked.seed, weighed=("weight",) if asked.weighed else ())
    fitted = calibrated(asked.folder, tuple(TOOLS))
    for name, matrix in (("maker's matrix", np.eye(6)), ("calibration", fitted)):
        force, moment = push_errors(matrix @ np.linalg.inv(truth))
        print(f"{name}: a push of 10 N is misread by {force:.2f} N and {moment:.3f} N m")


def calibrated(folder: Path, tools: tuple[str, ...]) -> np.ndarray:
    """Calibrate from the recordings of tools.

    Args:
        folder: Where they are.
        tools: Their names.

    Returns:
        The matrix, of readings by the maker's; shape (6, 6).
    """
    runs = [SensorRun(load_experiment(folder / f"{tool}.toml"), "wrist_ft") for tool in tools]
    return np.array(calibrate_sensor(runs, code_version="", created="2026-01-01T00:00:00").matrix)


def simulate(
    folder: Path,
    urdf: Path,
    *,
    seed: int,
    weighed: tuple[str, ...] = (),
    tools: dict[str, tuple[float, list[float]]] = TOOLS,
    gravity: tuple[float, float, float] = (0.0, 0.0, -1.0),
    relative: float = 0.03,
    duration_s: float = DURATION_S,
    fastest_rad_s: float = 1.0,
) -> np.ndarray:
    """Write the log and the experiment file of each tool.

    Args:
        folder: Where.
        urdf: The arm.
        seed: Of sensor, motion and noise.
        weighed: Tools that the files state; the others are unknown.
        tools: Mass in kg and centre of mass in m of each.
        gravity: Where things fall, in the axes of the base.
        relative: How far the maker's matrix is off, a share of the full scales.
        duration_s: Length of each log.
        fastest_rad_s: Angular frequency of the fastest of the two sines of each joint.

    Returns:
        What the true wrench is of a reading by the maker's matrix; shape (6, 6).
    """
    rng = np.random.default_rng(seed)
    truth = FULL_SCALE[:, None] * (np.eye(6) + relative * rng.normal(size=(6, 6))) / FULL_SCALE
    offset = rng.normal(0.0, [3.0, 3.0, 3.0, 0.2, 0.2, 0.2])
    folder.mkdir(parents=True, exist_ok=True)
    arm = read_urdf(urdf)
    for tool, (mass, centre) in tools.items():
        body = Inertia.about_centre_of_mass(
            mass=mass, centre_of_mass=np.array(centre), second_moment=mass * 0.04**2 * np.eye(3)
        )
        carrying = replace(arm, links={**arm.links, LINK: arm.links[LINK] + body})
        time, motion, wrench = _moved(carrying, rng, np.array(gravity), duration_s, fastest_rad_s)
        reading = (wrench + NOISE * rng.normal(size=wrench.shape)) @ np.linalg.inv(truth).T + offset
        names = [f"{joint}_rad" for joint in motion.names]
        table = np.column_stack([time, motion.position, reading])
        head = ",".join(["t_s", *names, "fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"])
        np.savetxt(folder / f"{tool}.csv", table, fmt="%.6f", delimiter=",", header=head, comments="")
        text = EXPERIMENT.format(
            tool=tool,
            urdf=urdf.resolve(),
            columns=str(names).replace("'", '"'),
            joints=str(list(motion.names)).replace("'", '"'),
            radians=str(["rad"] * len(names)).replace("'", '"'),
            joint=JOINT,
            base=BASE,
            link=LINK,
            gravity=list(gravity),
            stated=f"mass_kg = {mass}\ncentre_of_mass_m = {centre}\n" if tool in weighed else "",
            split_s=round(0.7 * duration_s, 3),
        )
        (folder / f"{tool}.toml").write_text(text, encoding="utf-8")
    return truth


def _moved(
    arm: RobotModel, rng: np.random.Generator, gravity: np.ndarray, duration_s: float, fastest_rad_s: float
) -> tuple[np.ndarray, JointMotion, np.ndarray]:
    """Instants, a motion of all joints by sines, and what the sensor must read of it."""
    sensed = arm.with_sensor("wrist_ft", joint=JOINT, direction=MeasureDirection.CHILD_TO_PARENT)
    joints = tuple(name for name, joint in sensed.joints.items() if joint.type.moves)
    time = np.arange(0.0, duration_s, 1.0 / RATE_HZ)
    shape = (2, len(joints))
    amplitude, phase = rng.uniform(0.3, 0.9, shape), rng.uniform(0.0, 6.0, shape)
    frequency = rng.uniform(0.3 * fastest_rad_s, fastest_rad_s, shape)
    angle = time[:, None, None] * frequency + phase
    motion = JointMotion(
        names=joints,
        position=(amplitude * np.sin(angle)).sum(axis=1),
        velocity=(amplitude * frequency * np.cos(angle)).sum(axis=1),
        acceleration=-(amplitude * frequency**2 * np.sin(angle)).sum(axis=1),
    )
    still = np.zeros(3)
    root = RootMotion(proper_acceleration=-9.80665 * gravity, angular_velocity=still, angular_acceleration=still)
    wrench = expected_wrenches(build_tree(sensed, BASE), motion, root)["wrist_ft"]
    return time, motion, np.array(wrench)


def push_errors(response: np.ndarray, *, reach_m: float = 0.3, count: int = 500) -> tuple[float, float]:
    """Say how far pushes of 10 N at random points, in random directions, are misread.

    Args:
        response: What is read of a true wrench; shape (6, 6).
        reach_m: Half the side of the cube about the sensor that the points are in.
        count: Number of pushes.

    Returns:
        Mean errors of force in N and moment in N m.
    """
    rng = np.random.default_rng(0)
    force = rng.normal(size=(count, 3))
    force *= 10.0 / np.linalg.norm(force, axis=1, keepdims=True)
    wrench = np.hstack([force, np.cross(rng.uniform(-reach_m, reach_m, (count, 3)), force)])
    error = wrench @ response.T - wrench
    return (
        float(np.linalg.norm(error[:, :3], axis=1).mean()),
        float(np.linalg.norm(error[:, 3:], axis=1).mean()),
    )


if __name__ == "__main__":
    main()
