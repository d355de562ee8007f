# SPDX-License-Identifier: BSD-3-Clause
"""Reading how far and how fast joints go."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.robot.model import JointLimit, JointType
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import example_robot, icub, joint_xml, link_xml, read_text, robot_xml


def _limit(kind: str, inside: str, folder: Path) -> JointLimit | None:
    joint = joint_xml("j", "a", "b", type=kind, inside=inside)
    return read_text(robot_xml(link_xml("a"), link_xml("b"), joint), folder).joints["j"].limit


@pytest.mark.parametrize(
    ("kind", "inside", "expected"),
    [
        (
            "revolute",
            "<limit lower='-1' upper='2' velocity='3' effort='4'/>",
            JointLimit(lower=-1, upper=2, velocity=3, effort=4),
        ),
        ("prismatic", "<limit lower='0' upper='0.1'/>", JointLimit(lower=0, upper=0.1)),
        ("revolute", "<limit velocity='3'/>", JointLimit(velocity=3)),
        ("revolute", "<limit lower='2' upper='-1'/>", JointLimit(lower=2, upper=-1)),
        ("continuous", "<limit lower='-1' upper='2' velocity='3'/>", JointLimit(velocity=3)),
        ("revolute", "", None),
        ("fixed", "<limit lower='-1' upper='word'/>", None),
    ],
)
def test_limits_are_read_as_they_stand(kind: str, inside: str, expected: JointLimit | None, tmp_path: Path) -> None:
    """An absent bound stays absent, an endless joint has none, and implausible ones are not yet judged."""
    assert _limit(kind, inside, tmp_path) == expected


ROBOTS: list[Callable[[], Path]] = [
    lambda: icub("iCubGazeboV2_7"),
    lambda: icub("iCubGenova02"),
    lambda: example_robot("talos_data/robots/talos_reduced.urdf"),
    lambda: example_robot("panda_description/urdf/panda.urdf"),
]


@pytest.mark.parametrize("urdf", ROBOTS)
def test_limits_of_real_robots_are_pinocchios(urdf: Callable[[], Path]) -> None:
    """Bounds and speeds of every free joint agree with another reader's."""
    pinocchio = pytest.importorskip("pinocchio")
    theirs, ours = pinocchio.buildModelFromUrdf(str(urdf())), read_urdf(urdf()).joints
    compared = 0
    for name, joint in zip(theirs.names[1:], theirs.joints[1:], strict=True):
        limit = ours[name].limit
        if ours[name].type is JointType.CONTINUOUS or limit is None:
            continue
        bounds = theirs.lowerPositionLimit[joint.idx_q], theirs.upperPositionLimit[joint.idx_q]
        np.testing.assert_array_equal((limit.lower, limit.upper), bounds)
        assert limit.velocity == theirs.velocityLimit[joint.idx_v]
        compared += 1
    assert compared > 6
