# SPDX-License-Identifier: BSD-3-Clause
"""What each of the ten inertial parameters of a load adds to a wrist sensor, in motion, against Pinocchio."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.window_means import means_over, window_for
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.payload.loads_on_robot_links import link_loads
from forcetorque.recording.recording import Use
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import example_robot, random_motion

UR5 = "ur_description/urdf/ur5_robot.urdf"
SENSOR_LINK, LINK = "wrist_3_link", "tool0"
DOWN = np.array([0.48, 0.6, -0.64])
"""Gravity of an arm that is mounted askew."""
RATE_HZ, SECONDS = 50.0, 4.0
AGREEMENT = 1e-9
"""N, N m per unit: rounding of some 1e2 over ten joints, a table of 15 digits, with a margin of 100."""
PINOCCHIO_ORDER = [0, 1, 2, 3, 4, 6, 9, 5, 7, 8]
"""Places of m, mc, xx, yy, zz, xy, xz, yz in its m, mc, xx, xy, yy, xz, yz, zz."""

EXPERIMENT = """schema = "forcetorque/experiment/1"
name = "columns"
robot = {{ urdf = "{urdf}" }}
processing = {{ derivatives = "logged" }}

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "log.csv"
stamp = {{ column = "t_s", unit = "s" }}
{signals}
[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "wrist_ft"

[[sensor]]
name = "wrist_ft"
stream = "log"
serial = "FT-17"
prior = "identity"
full_scale = [150, 150, 150, 10, 10, 10]
joint = "{joint}"
frame = "parent"
measure_direction = "child_to_parent"

[[support]]
frame = "base_link"
gravity_direction = {down}

[[load]]
link = "{link}"

[[interval]]
label = "all"
start_s = 0.0
use = "calibration"
support = "base_link"
"""
SIGNAL = (
    '[[recording.stream.signal]]\nquantity = "{quantity}"\ncolumns = {columns}\nunits = {units}\nnames = {joints}\n'
)
UNITS = {"position": "rad", "velocity": "rad/s", "acceleration": "rad/s2"}


@dataclass(frozen=True, eq=False)
class Moved:
    """An arm that moves fast, and its experiment."""

    experiment: Experiment
    time: FloatArray
    motion: JointMotion


def _moved(folder: Path) -> Moved:
    urdf = example_robot(UR5)
    model = read_urdf(urdf)
    motion = random_motion(model, samples=int(SECONDS * RATE_HZ), seed=3)
    time = np.arange(len(motion)) / RATE_HZ
    names = list(motion.names)
    columns = {quantity: [f"{quantity}_{name}" for name in names] for quantity in UNITS}
    table = np.column_stack([time, motion.position, motion.velocity, motion.acceleration, np.ones((len(time), 6))])
    head = ["t_s", *(name for own in columns.values() for name in own), "fx", "fy", "fz", "tx", "ty", "tz"]
    np.savetxt(folder / "log.csv", table, fmt="%.17g", delimiter=",", header=",".join(head), comments="")
    signals = "".join(
        SIGNAL.format(quantity=quantity, columns=own, units=[UNITS[quantity]] * len(names), joints=names)
        for quantity, own in columns.items()
    )
    (joint,) = (one.name for one in model.joints.values() if one.parent == SENSOR_LINK and one.child == LINK)
    text = EXPERIMENT.format(
        urdf=urdf.resolve(),
        signals=signals.replace("'", '"'),
        joint=joint,
        down=DOWN.tolist(),
        link=LINK,
    )
    (folder / "experiment.toml").write_text(text, encoding="utf-8")
    return Moved(load_experiment(folder / "experiment.toml"), time, motion)


def _columns(moved: Moved) -> FloatArray:
    loads = link_loads(moved.experiment)
    assert loads is not None
    rows = loads.problem(moved.experiment, use=Use.CALIBRATION).rows
    assert np.median(rows.share) == 1.0  # what a row counts is relative to a usual one
    assert rows.columns is not None
    return rows.columns


def _from_pinocchio(moved: Moved, *, gravity: float = STANDARD_GRAVITY) -> FloatArray:
    """Wrench that moves a body on the link, in the sensor's frame, per parameter; means as the rows are."""
    pin = pytest.importorskip("pinocchio")
    model = pin.buildModelFromUrdf(str(example_robot(UR5)))
    data = model.createData()
    sensor, link = model.getFrameId(SENSOR_LINK), model.getFrameId(LINK)
    order = [moved.motion.names.index(name) for name in model.names[1:]]
    columns = np.empty((len(moved.time), 6, 10))
    for k in range(len(moved.time)):
        state = [getattr(moved.motion, quantity)[k, order] for quantity in UNITS]
        pin.forwardKinematics(model, data, *state)
        pin.updateFramePlacements(model, data)
        sensor_H_link = data.oMf[sensor].actInv(data.oMf[link])
        velocity = pin.getFrameVelocity(model, data, link, pin.LOCAL)
        acceleration = pin.getFrameAcceleration(model, data, link, pin.LOCAL)
        acceleration.linear -= gravity * data.oMf[link].rotation.T @ DOWN
        regressor = pin.bodyRegressor(velocity, acceleration)[:, PINOCCHIO_ORDER]
        columns[k] = sensor_H_link.toDualActionMatrix() @ regressor
    _, means, _ = means_over(moved.time, columns.reshape(len(columns), -1), window_for(moved.time))
    return means.reshape(-1, 6, 10)


def test_columns_of_a_load_in_motion_are_those_of_pinocchio(tmp_path: Path) -> None:
    """All ten, about a frame that is turned and displaced against the sensor's, under gravity askew."""
    moved = _moved(tmp_path)
    ours, theirs = _columns(moved), _from_pinocchio(moved)
    assert (np.abs(theirs).max(axis=(0, 1)) > 0.1).all()
    np.testing.assert_allclose(ours, theirs, atol=AGREEMENT * np.abs(theirs).max())


def test_columns_without_gravity_are_others(tmp_path: Path) -> None:
    """Negative control: what gravity adds to mass and first moment is seen, to inertia it adds nothing."""
    moved = _moved(tmp_path)
    ours, theirs = _columns(moved), _from_pinocchio(moved, gravity=0.0)
    off = np.abs(ours - theirs).max(axis=(0, 1))
    assert (off[:4] > 1.0).all()
    assert (off[4:] < AGREEMENT * np.abs(theirs).max()).all()
