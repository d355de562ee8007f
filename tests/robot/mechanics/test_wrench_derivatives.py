# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of expected wrenches against differences of the readable recursion, on robots with any joints."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import assume, given, settings, strategies as st

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.mechanics.sub_model_equations import heavy_bodies, joints_of_part, part_equations, sensors_of
from forcetorque.robot.mechanics.wrench_derivatives import PartDerivatives, demand_derivatives, part_derivatives
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import SubModel, sub_models
from forcetorque.robot.tree import BodyTree, build_tree
from tests.fuzzing import examples
from tests.robot.mechanics.random_robots import robots
from tests.robot.mechanics.simulated import random_root
from tests.scenes.robots import random_motion

SAMPLES = 5
STEP = 1e-5
CLOSE = 1e-7
"""Share of the largest wrench: errors of a central difference are the square of its step, and rounding over it."""
SHIFT = np.array([0.1, -0.2, 0.3])


def _part(tree: BodyTree, sensor: str) -> SubModel:
    return next(part for part in sub_models(tree, [sensor]) if part.sensor == sensor)


def _derivatives(tree: BodyTree, sensor: str, joints: JointMotion, root: RootMotion) -> PartDerivatives:
    part = _part(tree, sensor)
    axes = dict.fromkeys(heavy_bodies(tree, part), np.eye(3))
    turned = joints_of_part(tree, part)
    return part_derivatives(tree, part, joints, root, bare=tree, axes=axes, turned=turned)


def _by_joint(tree: BodyTree, sensor: str, joints: JointMotion, root: RootMotion, joint: str) -> FloatArray:
    up, down = (
        expected_wrenches(tree, joints.shifted({joint: step}), root, [sensor])[sensor] for step in (STEP, -STEP)
    )
    return (up - down).T / (2.0 * STEP)


@settings(max_examples=examples(60), deadline=None)
@given(model=robots(), seed=st.integers(0, 1000))
def test_derivatives_are_differences(model: RobotModel, seed: int) -> None:
    """By positions of rotary, sliding and mimicking joints, by masses, centres and the acceleration of the root."""
    assume(model.sensors and any(joint.type.moves for joint in model.joints.values()))
    links = list(model.links)
    tree = build_tree(model, links[seed % len(links)])
    heavy = [sensor for sensor in tree.cuts if heavy_bodies(tree, _part(tree, sensor))]
    assume(heavy)
    sensor = heavy[seed % len(heavy)]
    joints, root = random_motion(model, samples=SAMPLES, seed=seed), random_root(samples=SAMPLES, seed=seed)
    found, expected = _derivatives(tree, sensor, joints, root), expected_wrenches(tree, joints, root, [sensor])[sensor]
    size = 1.0 + np.abs(expected).max()
    for joint, column in found.joints.items():
        difference = _by_joint(tree, sensor, joints, root, joint)
        np.testing.assert_allclose(column, difference, rtol=CLOSE, atol=CLOSE * size)
    np.testing.assert_allclose(sum(column[0] for column in found.bodies.values()), expected.T, atol=1e-9 * size)
    pushed = replace(root, proper_acceleration=root.proper_acceleration + SHIFT)
    moved = expected_wrenches(tree, joints, pushed, [sensor])[sensor] - expected
    np.testing.assert_allclose(np.tensordot(SHIFT, found.acceleration, 1), moved.T, atol=1e-9 * size)
    for k, columns in found.bodies.items():
        body = tree.bodies[k]
        inertia = replace(body.inertia, first_moment=body.inertia.first_moment + body.inertia.mass * SHIFT)
        bodies = tuple(replace(one, inertia=inertia) if one is body else one for one in tree.bodies)
        shifted = expected_wrenches(replace(tree, bodies=bodies), joints, root, [sensor])[sensor] - expected
        np.testing.assert_allclose(np.tensordot(SHIFT, columns[1:], 1), shifted.T, atol=1e-9 * size)


@settings(max_examples=examples(60), deadline=None)
@given(model=robots(), seed=st.integers(0, 1000))
def test_derivatives_of_demands_are_differences(model: RobotModel, seed: int) -> None:
    """Of parts between any number of sensors, that of the root link too, along its axes."""
    assume(model.sensors and any(joint.type.moves for joint in model.joints.values()))
    links = list(model.links)
    tree = build_tree(model, links[seed % len(links)])
    parts = [part for part in sub_models(tree, tuple(tree.cuts)) if sensors_of(part)]
    assume(parts)
    part = parts[seed % len(parts)]
    joints, root = random_motion(model, samples=SAMPLES, seed=seed), random_root(samples=SAMPLES, seed=seed)

    def demand(motion: JointMotion, of_tree: BodyTree = tree, of_root: RootMotion = root) -> FloatArray:
        (equation,) = part_equations(of_tree, [part], motion, of_root)
        return equation.demand.T

    axes = dict.fromkeys(heavy_bodies(tree, part), np.eye(3))
    found, expected = demand_derivatives(tree, part, joints, root, axes=axes), demand(joints)
    size = 1.0 + np.abs(expected).max()
    for joint, column in found.joints.items():
        up, down = (demand(joints.shifted({joint: step})) for step in (STEP, -STEP))
        np.testing.assert_allclose(column, (up - down) / (2.0 * STEP), rtol=CLOSE, atol=CLOSE * size)
    weights = sum((column[0] for column in found.bodies.values()), np.zeros((6, SAMPLES)))
    np.testing.assert_allclose(weights, expected, atol=1e-9 * size)
    pushed = replace(root, proper_acceleration=root.proper_acceleration + SHIFT)
    moved = demand(joints, of_root=pushed) - expected
    np.testing.assert_allclose(np.tensordot(SHIFT, found.acceleration, 1), moved, atol=1e-9 * size)
    for k, columns in found.bodies.items():
        body = tree.bodies[k]
        inertia = replace(body.inertia, first_moment=body.inertia.first_moment + body.inertia.mass * SHIFT)
        bodies = tuple(replace(one, inertia=inertia) if one is body else one for one in tree.bodies)
        shifted = demand(joints, of_tree=replace(tree, bodies=bodies)) - expected
        np.testing.assert_allclose(np.tensordot(SHIFT, columns[1:], 1), shifted, atol=1e-9 * size)
