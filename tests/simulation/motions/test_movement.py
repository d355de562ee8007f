# SPDX-License-Identifier: BSD-3-Clause
"""What holds for every kind of movement on every robot."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.base.pose import invert_pose
from forcetorque.robot.contacts import Contact
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import (
    balancing_movement,
    grid_movement,
    random_movement,
    z_torque_movement,
)
from forcetorque.simulation.motions.movement import Movement, MovementKind, Touch
from tests.simulation.motions.stances import MOVEMENTS
from tests.simulation.motions.stands import (
    DOWN,
    POLES,
    ROBOTS,
    arm,
    on_foot,
    on_pole,
    require_exact_derivatives,
    require_inside_limits,
    robot,
    times,
)

MAKE: dict[str, Callable[[str, np.random.Generator, float], tuple[Stand, Movement]]] = {}


def _register(kind: str, stand: Callable[..., Stand], make: Callable[[Stand, np.random.Generator], Movement]) -> None:
    def made(name: str, rng: np.random.Generator, speed: float) -> tuple[Stand, Movement]:
        held = stand(name, speed=speed)
        return held, make(held, rng)

    MAKE[kind] = made


_register("grid", on_pole, lambda stand, _: grid_movement(stand, "l_leg_ft", steps=3))
_register("z_torque", on_pole, lambda stand, rng: z_torque_movement(stand, "r_arm_ft", rng=rng, postures=4))
_register("random", on_pole, lambda stand, rng: random_movement(stand, rng=rng, duration_s=20.0))
_register(
    "balancing", on_foot, lambda stand, rng: balancing_movement(stand, "r_sole", rng=rng, postures=3, candidates=10)
)
CASES = [(name, kind) for name in ROBOTS for kind in MAKE]


def test_every_kind_is_tried() -> None:
    """The list of cases below, that of movements on both feet, and contact switching are all kinds that there are."""
    assert {*MAKE, *MOVEMENTS, MovementKind.CONTACT_SWITCHING} == set(MovementKind)


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_movements_are_exact_and_stay_in_limits(name: str, kind: str) -> None:
    """Derivatives agree with finite differences, limits hold with their margin, the support stands still."""
    stand, movement = MAKE[kind](name, np.random.default_rng(1), 0.5)
    assert movement.kind == kind
    at = times(movement)
    motion = movement.joints(at)
    assert set(motion.names) == {joint.name for joint in stand.model.joints.values() if joint.type.moves}
    require_exact_derivatives(movement.joints, at)
    require_inside_limits(stand, motion)
    np.testing.assert_array_equal(
        movement.base_pose(at, movement.support), np.broadcast_to(movement.world_H_support, (len(at), 4, 4))
    )
    # negative control: the links of the busiest joint do move
    busiest = stand.model.joints[motion.names[int(np.ptp(motion.position, axis=0).argmax())]]
    assert max(np.ptp(movement.base_pose(at, link)[:, 0]) for link in (busiest.parent, busiest.child)) > 0.1


@pytest.mark.parametrize("kind", MAKE)
@pytest.mark.parametrize(("seed", "speed"), [(2, 0.05), (3, 2.0), (4, 30.0)])
def test_limits_hold_for_other_seeds_and_speeds(kind: str, seed: int, speed: float) -> None:
    """However fast it is told to go, no joint leaves its range or its own largest speed."""
    stand, movement = MAKE[kind]("biped", np.random.default_rng(seed), speed)
    motion = movement.joints(times(movement, 1000))
    require_inside_limits(stand, motion)
    if kind != "random":  # whose slowest joints keep their frequencies
        assert np.abs(motion.velocity).max() > 0.9 * min(speed, 4.0)  # limits of the biped are 4 or 5 rad/s


@pytest.mark.parametrize("name", ROBOTS)
def test_the_base_is_where_pinocchio_puts_it(name: str) -> None:
    """Poses of base and hand in the world are those of another library with the foot held at its place."""
    pinocchio = pytest.importorskip("pinocchio")
    stand = on_foot(name)
    tilted = Stand(model=stand.model, support="l_sole", gravity_direction=np.array([0.1, -0.2, -0.9]))
    movement = random_movement(tilted, rng=np.random.default_rng(5), duration_s=10.0)
    at = times(movement, 5)
    motion = movement.joints(at)
    theirs = pinocchio.buildModelFromUrdf(str(ROBOTS[name]()))
    data, links = theirs.createData(), (POLES[name], "r_sole", "l_foot")
    ours = {link: movement.base_pose(at, link) for link in links}
    for k in range(len(at)):
        q = np.zeros(theirs.nq)
        for joint, value in zip(motion.names, motion.position[k], strict=True):
            q[theirs.joints[theirs.getJointId(joint)].idx_q] = value
        pinocchio.framesForwardKinematics(theirs, data, q)
        root_H = {link: data.oMf[theirs.getFrameId(link)].homogeneous for link in (*links, "l_sole")}
        for link in links:
            expected = movement.world_H_support @ invert_pose(root_H["l_sole"]) @ root_H[link]
            # products of some 20 rotations
            np.testing.assert_allclose(ours[link][k], expected, rtol=0, atol=1e-13)


def test_readings_are_expected_wrenches_where_nothing_touches() -> None:
    """Two ways through the library agree."""
    movement = random_movement(arm(), rng=np.random.default_rng(7), duration_s=5.0)
    at = times(movement, 20)
    other = expected_wrenches(movement.tree, movement.joints(at), movement.root(at))["arm_ft"]
    np.testing.assert_allclose(movement.readings(at).of_name("arm_ft"), other, rtol=0, atol=1e-11)
    assert np.ptp(other) > 10.0


def test_the_seed_decides() -> None:
    """The same generator gives the same movement, another one another."""
    first, again, other = (MAKE["balancing"]("biped", np.random.default_rng(seed), 0.5)[1] for seed in (8, 8, 9))
    at = times(first)
    np.testing.assert_array_equal(first.joints(at).position, again.joints(at).position)
    assert np.abs(first.joints(at).position - other.joints(at).position).max() > 0.1


def test_what_makes_no_sense_is_refused() -> None:
    """A touch that is unknown, instants that are not a list, a link that is not there."""
    movement = random_movement(arm(), rng=np.random.default_rng(10), duration_s=1.0)
    unknown = Touch(Contact(link="hand"), lambda seconds: np.zeros((len(seconds), 6)))
    with pytest.raises(RobotError, match="touch 'hand': expected the contact type known, got wrench"):
        Movement(
            name="m",
            kind=MovementKind.RANDOM,
            model=robot("arm"),
            support="base",
            world_H_support=np.eye(4),
            duration_s=1.0,
            trajectory=movement.trajectory,
            external=(unknown,),
        )
    with pytest.raises(ShapeError, match=r"seconds: expected an array of shape \(n\), got \(\)"):
        movement.joints(1.0)
    with pytest.raises(RobotError, match="no link 'hnad'; did you mean \"hand\""):
        movement.base_pose([0.0], "hnad")
    np.testing.assert_allclose(movement.gravity_direction, DOWN)
