# SPDX-License-Identifier: BSD-3-Clause
"""Positions that are degrees and stated as radians are refused where the URDF has limits; what a robot reads is not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.robot.model import JointLimit, RobotModel
from forcetorque.robot.motion import JointMotion, JointUnits
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF

JOINT = "elbow"


def _model(limit: JointLimit | None) -> RobotModel:
    model = read_urdf(ARM_URDF)
    return replace(model, joints={**model.joints, JOINT: replace(model.joints[JOINT], limit=limit)})


def _motion(position: FloatArray) -> JointMotion:
    still = np.zeros((len(position), 1))
    return JointMotion(names=(JOINT,), position=position[:, None], velocity=still, acceleration=still)


def _require_radians(model: RobotModel, motion: JointMotion) -> None:
    units = JointUnits(model, motion.names)
    units.add(motion)
    units.require_radians()


LIMIT = JointLimit(lower=-2.6, upper=2.6)
TURNING = 1.2 * np.sin(np.linspace(0.0, 12.0, 1000))


def test_degrees_that_are_stated_as_radians_are_refused() -> None:
    """In one line, with the joint, its limits and the unit that fits; a few samples without a value do not matter."""
    position = np.degrees(TURNING)
    position[:5] = np.nan
    match = (
        r"joint 'elbow': expected .* -2.6 to 2.6 rad, got up to -?68.8 rad, which fits them in degrees; check the unit"
    )
    with pytest.raises(RecordingError, match=match):
        _require_radians(_model(LIMIT), _motion(position))


@pytest.mark.parametrize(
    ("limit", "position"),
    [
        (LIMIT, TURNING),
        (LIMIT, 1.1 * 2.6 * TURNING / 1.2),
        (LIMIT, TURNING + 2.0 * np.pi),
        (LIMIT, np.where(np.arange(1000) % 200 == 0, 70.0, TURNING)),
        (LIMIT, 1e4 * TURNING),
        (LIMIT, np.full(1000, np.nan)),
        (None, np.degrees(TURNING)),
        (JointLimit(), np.degrees(TURNING)),
        (JointLimit(lower=0.0, upper=0.0), np.degrees(TURNING)),
    ],
    ids=["inside", "a little beyond", "another zero", "spikes", "no unit fits", "none", "no limit", "endless", "dummy"],
)
def test_what_limits_do_not_tell_passes(limit: JointLimit | None, position: FloatArray) -> None:
    """Negative controls."""
    _require_radians(_model(limit), _motion(position))
