# SPDX-License-Identifier: BSD-3-Clause
"""The robot hangs, stands on both feet, and its weight goes from foot to foot: in one movement, without a jump."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.base.pose import cross
from forcetorque.base.wrench import transform_wrench
from forcetorque.simulation.motions.contact_switching import contact_switching_movement
from forcetorque.simulation.motions.movement import Movement, PhaseKind
from tests.simulation.motions.stances import IMU_LINKS, stance
from tests.simulation.motions.stands import ROBOTS, on_pole, require_exact_derivatives, require_inside_limits, robot

HUMANOIDS = ("biped", "iCubGazeboV2_7")
HOOKS = {"biped": "torso", "iCubGazeboV2_7": "chest"}
LABELS = ("hanging", "landing", "double_1", "l_sole", "double_2", "r_sole", "double_3")
ROUNDING_N = 1e-9
"""Rounding of 300 N over 40 bodies."""


@cache
def switching(name: str, *, hook: bool = True, steps: int = 2) -> Movement:
    """A short movement, made once; the feet stand anywhere."""
    return contact_switching_movement(
        stance(name, seed=3),
        rng=np.random.default_rng(1),
        hook=HOOKS[name] if hook else None,
        steps=steps,
        postures=1,
        candidates=10,
        still_s=1.0,
    )


def _instants(movement: Movement, count: int = 300) -> FloatArray:
    """Instants over all of it, those of the borders between phases among them."""
    borders = [phase.end_s for phase in movement.phases]
    return np.unique(np.concatenate([np.linspace(0.0, movement.duration_s, count), borders]))


def _contact_wrench(movement: Movement, at: FloatArray) -> FloatArray:
    """Sum of all contact wrenches about the origin and in the axes of the world; shape (n, 6)."""
    touches = movement.external_wrenches(at)
    return sum(
        (transform_wrench(movement.base_pose(at, link), touches.of_name(link)) for link in touches.names),
        start=np.zeros((len(at), 6)),
    )


def _momentum(movement: Movement, at: FloatArray) -> FloatArray:
    """Linear and angular momentum about the world's origin, link by link, from poses and motions alone; (n, 6)."""
    total = np.zeros((len(at), 6))
    step = 1e-5
    for link, inertia in movement.model.links.items():
        if not inertia.mass:
            continue
        pose = movement.base_pose(at, link)
        rotation = pose[:, :3, :3]
        centre = inertia.first_moment / inertia.mass
        before, after = (movement.base_pose(at + shift, link) for shift in (-step, step))
        place = [p[:, :3, :3] @ centre + p[:, :3, 3] for p in (before, pose, after)]
        force = inertia.mass * (place[2] - place[0]) / (2.0 * step)
        omega = movement.link_motion(at, link).angular_velocity
        about_centre = inertia.second_moment - inertia.mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
        spin = np.einsum("nij,nj->ni", rotation, omega @ about_centre.T)
        total[:, :3] += force
        total[:, 3:] += cross(place[1], force) + spin
    return total


@pytest.mark.parametrize("name", HUMANOIDS)
def test_phases_follow_each_other_from_hook_to_feet(name: str) -> None:
    """Their order, kinds and links, without gaps; and what touches in none of them bears nothing."""
    movement = switching(name)
    assert tuple(phase.label for phase in movement.phases) == LABELS
    assert movement.phases[0].start_s == 0.0
    assert movement.phases[-1].end_s == movement.duration_s
    assert all(before.end_s == after.start_s for before, after in pairwise(movement.phases))
    assert [phase.kind for phase in movement.phases].count(PhaseKind.DOUBLE_SUPPORT) == 3
    free = 0
    for phase in movement.phases:
        at = np.linspace(phase.start_s, phase.end_s, 40)
        touches = movement.external_wrenches(at)
        for link in touches.names:
            if link not in phase.touched:
                assert np.abs(touches.of_name(link)).max() < ROUNDING_N, (phase.label, link)
                free += 1
            elif len(phase.touched) > 1:
                assert np.abs(touches.of_name(link)).max() > 100.0, (phase.label, link)
    assert free == 2 + 3 * 1 + 2 * 2


@pytest.mark.parametrize("name", HUMANOIDS)
def test_links_that_touch_stand_still(name: str) -> None:
    """In each phase to rounding; both soles on one level floor, and the free foot leaves it by far."""
    movement = switching(name)
    for phase in movement.phases:
        at = np.linspace(phase.start_s, phase.end_s, 60)
        for link in phase.touched:
            assert np.ptp(movement.base_pose(at, link), axis=0).max() < 1e-13, (phase.label, link)
        for foot in {"l_sole", "r_sole"} - set(phase.touched):
            assert np.ptp(movement.base_pose(at, foot)[:, :3, 3], axis=0).max() > 0.05, (phase.label, foot)
        if len(phase.touched) > 1:
            joints = movement.joints(at)
            assert np.ptp(joints.position, axis=0).max() == np.abs(joints.velocity).max() == 0.0
    for foot in ("l_sole", "r_sole"):
        pose = movement.base_pose([movement.duration_s], foot)[0]
        assert abs(pose[2, 3]) < 1e-8  # what inverse kinematics leaves
        np.testing.assert_allclose(pose[2, :3], [0.0, 0.0, 1.0], rtol=0, atol=1e-8)


@pytest.mark.parametrize("name", HUMANOIDS)
def test_nothing_jumps(name: str) -> None:
    """Joints with their derivatives, readings, the IMU's motion and the wrench of every touch go on at each border."""
    movement = switching(name)
    borders = np.array([phase.end_s for phase in movement.phases[:-1]])
    assert len(borders) == 6
    before, after = borders - 1e-9, borders + 1e-9
    jump = 1e-6  # 300 N that go within 1.5 s change by less than 1e-6 N in 2 ns
    sensors = ("l_leg_ft", "r_foot_ft", "l_arm_ft")
    for quantity in (
        lambda at: movement.joints(at).acceleration,
        lambda at: movement.readings(at, sensors).values,
        lambda at: movement.external_wrenches(at).values,
        lambda at: movement.link_motion(at, IMU_LINKS[name]).proper_acceleration,
    ):
        np.testing.assert_allclose(quantity(before), quantity(after), rtol=0, atol=jump)
    at = _instants(movement, 80)
    require_exact_derivatives(movement.joints, at)
    require_inside_limits(stance(name, seed=3).stand, movement.joints(at))
    # negative control: seconds before and after them the readings differ
    apart = movement.readings(borders + 1.0, sensors).values - movement.readings(borders - 1.0, sensors).values
    assert np.abs(apart).max() > 50.0


@pytest.mark.parametrize("name", HUMANOIDS)
def test_contacts_bear_weight_and_inertia(name: str) -> None:
    """All that touches the robot adds up to what its motion demands: the carried trunk bears nothing, to 1e-9."""
    movement = switching(name)
    at = _instants(movement)
    assert np.abs(movement.support_wrench(at)).max() < ROUNDING_N
    # negative control: without one foot the trunk would bear something
    one_foot = replace(movement, external=movement.external[1:])
    assert np.abs(one_foot.support_wrench(at)).max() > 250.0


def test_contacts_change_the_momentum() -> None:
    """Their sum and gravity are the slope of the momentum, which is made of poses and angular velocities alone."""
    movement = switching("biped")
    singles = [phase for phase in movement.phases if len(phase.touched) == 1]
    assert len(singles) == 3
    at = np.concatenate([np.linspace(phase.start_s + 1.1, phase.end_s - 1.1, 20) for phase in singles])
    step = 1e-4
    slope = (_momentum(movement, at + step) - _momentum(movement, at - step)) / (2.0 * step)
    weight = np.zeros((len(at), 6))
    for link, inertia in movement.model.links.items():
        pose = movement.base_pose(at, link)
        down = np.array([0.0, 0.0, -movement.gravity])
        weight[:, :3] += inertia.mass * down
        weight[:, 3:] += cross(pose[:, :3, :3] @ inertia.first_moment + inertia.mass * pose[:, :3, 3], down)
    total = _contact_wrench(movement, at) + weight
    # positions of 1 m are rounded to 1e-16, over 4e-9 s2, for 31 kg
    np.testing.assert_allclose(total, slope, rtol=0, atol=1e-4)
    assert np.abs(slope).max() > 1.0  # negative control: weight alone would not do


def test_a_foot_reads_what_it_bears_less_its_own_weight_by_hand() -> None:
    """At rest on both feet, from the numbers of the URDF: the sole is 10 mm before and 35 mm below the sensor."""
    movement = switching("biped")
    double = movement.phases[2]
    at = np.linspace(double.start_s, double.end_s, 50)
    sole_from_sensor, centre, mass = np.array([0.01, 0.0, -0.035]), np.array([0.02, 0.002, -0.02]), 0.5
    for side in ("l", "r"):
        ground = movement.external_wrenches(at).of_name(f"{side}_sole")
        own = np.array([0.0, 0.0, -movement.gravity * mass])
        force = ground[:, :3] + own  # axes of sensor and sole are the same, and level
        moment = ground[:, 3:] + np.cross(sole_from_sensor, ground[:, :3]) + np.cross(centre, own)
        if side == "r":
            moment += np.cross([0.0, -0.004, 0.0], own)  # its centre of mass is on the other side
        read = movement.readings(at, [f"{side}_foot_ft"]).of_name(f"{side}_foot_ft")
        np.testing.assert_allclose(read, np.hstack([force, moment]), rtol=0, atol=1e-6)  # soles are level to 1e-8
        assert np.abs(read - ground).max() > 4.0  # negative control


def test_inner_forces_have_the_stated_size() -> None:
    """At rest each foot pushes the other along the ground by what is stated at most; none where none is stated."""
    made = {
        force: contact_switching_movement(
            stance("biped"), rng=np.random.default_rng(2), postures=1, candidates=5, internal_force_N=force
        )
        for force in (0.0, 15.0)
    }
    largest = {}
    for force, movement in made.items():
        double = movement.phases[0]
        at = np.linspace(double.start_s, double.start_s + 3.0, 100)
        left = movement.external_wrenches(at).of_name("l_sole")
        largest[force] = np.abs(left[:, :2]).max()
        weight = movement.gravity * sum(link.mass for link in movement.model.links.values())
        assert np.abs(left[:, 2] / weight - 0.5).max() < 0.05 + force / weight
    assert largest[0.0] < 0.5
    assert 2.0 < largest[15.0] < 15.0


def test_it_may_start_on_both_feet_and_take_more_steps() -> None:
    """Without a hook nothing hangs; a foot that bears alone twice has two labels."""
    movement = switching("biped", hook=False, steps=3)
    assert [phase.label for phase in movement.phases] == [
        "double_1",
        "l_sole_1",
        "double_2",
        "r_sole_1",
        "double_3",
        "l_sole_2",
        "double_4",
    ]
    assert movement.touched == ("l_sole", "r_sole")
    at = _instants(movement, 100)
    assert np.abs(movement.support_wrench(at)).max() < ROUNDING_N
    assert np.abs(movement.base_pose(at, "l_sole")[0] - movement.base_pose(at, "l_sole")[-1]).max() < 1e-13


@pytest.mark.parametrize("name", HUMANOIDS)
def test_contacts_move_the_robot_of_pinocchio(name: str) -> None:
    """Another library moves the whole robot with a free base, which needs the sum of the contacts' wrenches."""
    pinocchio = pytest.importorskip("pinocchio")
    movement = switching(name)
    theirs = pinocchio.buildModelFromUrdf(str(ROBOTS[name]()), pinocchio.JointModelFreeFlyer())
    theirs.gravity.linear = np.array([0.0, 0.0, -movement.gravity])
    data, root = theirs.createData(), robot(name).root_link
    at = np.concatenate([np.random.default_rng(4).uniform(phase.start_s, phase.end_s, 6) for phase in movement.phases])
    motion, base = movement.joints(at), movement.link_motion(at, root)
    pose = movement.base_pose(at, root)
    step = 1e-6
    along = (movement.base_pose(at + step, root)[:, :3, 3] - movement.base_pose(at - step, root)[:, :3, 3]) / (2 * step)
    touches, worst, wrong = movement.external_wrenches(at), 0.0, 0.0
    for k in range(len(at)):
        rotation = pose[k, :3, :3]
        q, v, a = pinocchio.neutral(theirs), np.zeros(theirs.nv), np.zeros(theirs.nv)
        q[:7] = pinocchio.SE3ToXYZQUAT(pinocchio.SE3(pose[k]))
        linear = rotation.T @ along[k]
        v[:3], v[3:6] = linear, base.angular_velocity[k]
        # theirs is the spatial acceleration: without the product of turning and velocity
        gravity = rotation.T @ [0.0, 0.0, movement.gravity]
        a[:3] = base.proper_acceleration[k] - gravity - np.cross(base.angular_velocity[k], linear)
        a[3:6] = base.angular_acceleration[k]
        states = np.stack([motion.position[k], motion.velocity[k], motion.acceleration[k]], axis=1)
        for joint, values in zip(motion.names, states, strict=True):
            index = theirs.joints[theirs.getJointId(joint)]
            q[index.idx_q], v[index.idx_v], a[index.idx_v] = values
        force = pinocchio.rnea(theirs, data, q, v, a)[:6]  # of the free base, in its axes
        demanded = transform_wrench(pose[k], force)
        contacts = sum(
            transform_wrench(movement.base_pose(at[[k]], link)[0], touches.of_name(link)[k]) for link in touches.names
        )
        worst = max(worst, float(np.abs(demanded - contacts).max()))
        wrong = max(wrong, float(np.abs(pinocchio.rnea(theirs, data, q, v, 0.0 * a)[:6] - force).max()))
    # the velocity of the base, by finite differences, is right to 1e-10 m/s, and products of it cancel
    assert worst < 1e-6
    assert wrong > 0.5  # negative control: without accelerations it is another


def test_what_makes_no_sense_is_refused() -> None:
    """No step, shifts and rests that take no time, hooks that are not there or on a leg, no posture."""
    biped = stance("biped")
    rng = np.random.default_rng(2)
    for changes in ({"steps": 0}, {"shift_s": 0.0}, {"still_s": 0.0}):
        with pytest.raises(ShapeError, match="at least one step and positive shift_s and still_s"):
            contact_switching_movement(biped, rng=rng, **changes)
    with pytest.raises(ShapeError, match="at least one posture, got 0"):
        contact_switching_movement(biped, rng=rng, hook="torso", postures=0)
    with pytest.raises(ShapeError, match="internal_force_N: expected a force of at least 0 N, got -1"):
        contact_switching_movement(biped, rng=rng, internal_force_N=-1.0)
    with pytest.raises(RobotError, match="hook: robot 'biped' has no link 'trso'; did you mean"):
        contact_switching_movement(biped, rng=rng, hook="trso")
    with pytest.raises(RobotError, match="hook: expected a link that no leg moves, 'l_shin' hangs on l_hip_pitch"):
        contact_switching_movement(biped, rng=rng, hook="l_shin")
    assert on_pole("biped").support == "pelvis"  # which may be a hook, as the trunk itself
    contact_switching_movement(biped, rng=rng, hook="pelvis", postures=1, candidates=2, steps=1)
