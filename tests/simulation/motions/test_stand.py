# SPDX-License-Identifier: BSD-3-Clause
"""Where joints may go and rest, and which way is down."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.robot.model import RobotModel
from forcetorque.simulation.motions.held_robot import Stand
from tests.scenes.robots import joint_xml, link_xml, read_text, robot_xml
from tests.simulation.motions.stands import DOWN, arm, robot

LIMITED = "<limit lower='{}' upper='{}' velocity='{}' effort='1'/>"
FOLLOWS = "<mimic joint='slide' multiplier='-2' offset='0.1'/>"


@pytest.fixture
def model(tmp_path: Path) -> RobotModel:
    """A robot with every kind of joint."""
    kinds = [
        ("hinge", "revolute", LIMITED.format(0.2, 1.2, 9)),
        ("slow", "revolute", LIMITED.format(-7, 7, 0.1)),
        ("wheel", "continuous", ""),
        ("slide", "prismatic", LIMITED.format(0, 1, 0)),
        ("finger", "prismatic", LIMITED.format(-0.5, 0.3, 1) + FOLLOWS),
        ("bare", "revolute", ""),
        ("reversed", "revolute", LIMITED.format(2, 1, 1)),
    ]
    links = [link_xml(f"l{k}", mass=1.0) for k in range(len(kinds) + 1)]
    joints = [
        joint_xml(name, f"l{k}", f"l{k + 1}", type=kind, inside=inside) for k, (name, kind, inside) in enumerate(kinds)
    ]
    return read_text(robot_xml(*links, *joints), tmp_path)


def _stand(model: RobotModel, **changes: Any) -> Stand:
    settings: dict[str, Any] = {"margin": 0.1, "speed": 0.5, "gravity_direction": np.array(DOWN), **changes}
    return Stand(model=model, support="l0", **settings)


def test_ranges_come_from_limits_and_margin(model: RobotModel) -> None:
    """A tenth of the range stays free at either end, a turn is enough, and a leader heeds its follower's limits."""
    stand = _stand(model)
    assert stand.joints == ("hinge", "slow", "wheel", "slide", "bare", "reversed")
    assert stand.range_of("hinge") == pytest.approx((0.3, 1.1))
    assert stand.range_of("slow") == pytest.approx((-0.8 * np.pi, 0.8 * np.pi))
    assert stand.range_of("wheel") == pytest.approx((-0.8 * np.pi, 0.8 * np.pi))
    # -0.5 <= 0.1 - 2 q <= 0.3 and 0 <= q <= 1 leave 0 to 0.3
    assert stand.range_of("slide") == pytest.approx((0.03, 0.27))
    assert _stand(model, ranges={"bare": (-1, 2)}).range_of("bare") == (-1.0, 2.0)


def test_joints_rest_at_zero_or_near_it(model: RobotModel) -> None:
    """The nearest position in range, unless another one is wanted; without limits zero."""
    rest = dict(zip(_stand(model).joints, _stand(model, posture={"slow": 1.0}).rest, strict=True))
    assert rest == pytest.approx({"hinge": 0.3, "slow": 1.0, "wheel": 0, "slide": 0.03, "bare": 0, "reversed": 0})


def test_the_slower_of_two_speeds_holds(model: RobotModel) -> None:
    """The stand's speed, or the joint's own where that is lower and not an unknown 0."""
    assert _stand(model).speeds.tolist() == [0.5, 0.1, 0.5, 0.5, 0.5, 0.5]


def test_what_cannot_be_used_is_refused_with_a_way_out(model: RobotModel) -> None:
    """Missing and reversed limits, followers and unknown joints, and numbers that make no sense."""
    stand = _stand(model)
    with pytest.raises(RobotError, match=r"'bare': expected limits .* ranges=\{'bare': \(low, high\)\}"):
        stand.range_of("bare")
    with pytest.raises(RobotError, match="'reversed': expected a lower limit below the upper one.* got 2 to 1"):
        stand.range_of("reversed")
    with pytest.raises(RobotError, match="no free joint 'finger'.*known: bare, hinge"):
        stand.range_of("finger")
    with pytest.raises(RobotError, match="no free joint 'hindge'; did you mean \"hinge\""):
        _stand(model, posture={"hindge": 1.0})
    with pytest.raises(RobotError, match="'hinge': expected a position in its range 0.3 to 1.1 .*got 0.2"):
        _stand(model, posture={"hinge": 0.2})
    with pytest.raises(RobotError, match="ranges: joint 'hinge'"):
        _stand(model, ranges={"hinge": (2.0, 1.0)})
    for name, value in (("speed", 0.0), ("speed", np.nan), ("margin", 0.5), ("margin", -0.1)):
        with pytest.raises(ShapeError, match=f"{name}: expected"):
            _stand(model, **{name: value})
    with pytest.raises(ShapeError, match="gravity_direction: expected a direction other than zero"):
        _stand(model, gravity_direction=np.zeros(3))


@pytest.mark.parametrize(
    "down", [DOWN, (0, 0, 1), (1, 0, 0), (0.3, -0.8, 0.5), (1e-9, 0, 1), (0, 1e-9, -1), (0, -1, 0)]
)
def test_the_world_stands_upright(down: tuple[float, float, float]) -> None:
    """The pose of the support in the world is a rotation that sends its down to straight down."""
    stand = Stand(model=robot("arm"), support="base", gravity_direction=np.array(down))
    rotation = stand.world_H_support[:3, :3]
    np.testing.assert_allclose(rotation @ stand.gravity_direction, DOWN, rtol=0, atol=1e-15)
    np.testing.assert_allclose(rotation.T @ rotation, np.eye(3), rtol=0, atol=1e-15)
    assert np.linalg.det(rotation) == pytest.approx(1.0)


def test_level_stays_level() -> None:
    """A support that is upright already is not turned at all."""
    np.testing.assert_array_equal(arm().world_H_support, np.eye(4))
