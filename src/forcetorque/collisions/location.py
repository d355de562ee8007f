# SPDX-License-Identifier: BSD-3-Clause
"""Where a contact acts and how: the wrench on the robot, its line of action, and the link that is nearest to it.

One force along a line explains a wrench whose moment about the line is zero. The point of contact lies where the line
meets the surface of a link; without the surface it is the point of the line that is nearest to the axis of a link, from
its joint to the next joint, to the frames that are fixed to it and to its centre of mass.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.units import NORMAL_95
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval
from forcetorque.robot.mechanics.sub_model_equations import PartEquation, joints_of_part, part_equations
from forcetorque.robot.sub_models import sub_models
from forcetorque.robot.tree import BodyTree, build_tree

_ALONG: Final = 21
"""Points of the axis of a link from which the nearest is taken."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Location:
    """A contact as one force along a line, in the axes and about the origin of the support frame."""

    wrench: FloatArray
    """What acts on the robot; shape (6,); N, N m."""
    force_half_width_95_N: float
    """Half of the 95 % interval of its size."""
    couple_Nm: float
    """Moment about the line, which one force does not have."""
    couple_half_width_95_Nm: float
    """Half of its 95 % interval."""
    link: str
    """Link whose axis is nearest to the line."""
    others: tuple[str, ...]
    """Links that may be as near, by the interval of the distance."""
    distance_m: float
    """Distance of the line from that axis."""
    distance_half_width_95_m: float
    """Half of the 95 % interval of the distance."""
    point: FloatArray
    """Point of the line that is nearest to the axis, in the frame of the link; shape (3,); m."""


def equation_at(run: SensorRun, interval: Interval, at_ns: IntArray) -> tuple[BodyTree, PartEquation]:
    """Give the equation of the links beyond a sensor at instants.

    Args:
        run: The sensor.
        interval: Interval of the instants.
        at_ns: The instants; shape (n,); ns.

    Returns:
        The robot, rooted at the support frame, and the equation.

    Raises:
        ExperimentError: If the interval has no support, or no link lies beyond the sensor.
    """
    support = interval.required_support(ExperimentError)
    experiment = run.experiment
    tree = build_tree(experiment.model_on(support), support.frame)
    part = next((part for part in sub_models(tree, [run.sensor.name]) if part.sensor == run.sensor.name), None)
    if part is None:
        raise ExperimentError(f"sensor {run.sensor.name!r}: no link lies beyond it, seen from {support.frame!r}")
    joints, root = experiment.motion_at(support, joints_of_part(tree, part), run.stream, at_ns)
    return tree, next(part_equations(tree, [part], joints, root))


def locate(run: SensorRun, interval: Interval, at_ns: int, excess: FloatArray, covariance: FloatArray) -> Location:
    """Find out where something touches the robot beyond a sensor.

    Args:
        run: The sensor.
        interval: Interval of the instant.
        at_ns: The instant; ns.
        excess: What the sensor reads too much; shape (6,); N, N m.
        covariance: Its covariance; shape (6, 6).

    Returns:
        Wrench, line and link.

    Raises:
        ExperimentError: If the interval has no support, or no link lies beyond the sensor.
    """
    tree, equation = equation_at(run, interval, np.array([at_ns]))
    # the sensor and what touches carry the bodies together
    on_robot = -equation.transmission[0, 0]
    wrench, spread = on_robot @ excess, on_robot @ covariance @ on_robot.T
    axes = {link: points[0] for link, points in _axes(tree, equation).items()}
    lines = {link: _nearest(wrench, points) for link, points in axes.items()}
    half = {link: NORMAL_95 * _deviation(wrench, spread, points) for link, points in axes.items()}
    link = min(lines, key=lambda name: lines[name][0])
    distance, point = lines[link]
    body, body_H_link = tree.frames[link]
    root_H_link = equation.poses[body][0] @ body_H_link
    direction = wrench[:3] / np.linalg.norm(wrench[:3])
    along = np.r_[np.zeros(3), direction]
    return Location(
        wrench=wrench,
        force_half_width_95_N=NORMAL_95 * float(np.sqrt(direction @ spread[:3, :3] @ direction)),
        couple_Nm=float(wrench[3:] @ direction),
        couple_half_width_95_Nm=NORMAL_95 * float(np.sqrt(along @ spread @ along)),
        link=link,
        others=tuple(name for name in lines if name != link and lines[name][0] < distance + half[name] + half[link]),
        distance_m=distance,
        distance_half_width_95_m=half[link],
        point=root_H_link[:3, :3].T @ (point - root_H_link[:3, 3]),
    )


def noticed_on_links(
    run: SensorRun, interval: Interval, at_ns: IntArray, covariances: FloatArray, square: float
) -> dict[str, FloatArray]:
    """Give the force on each link beyond a sensor that is noticed, whatever its direction and its place on the axis.

    Args:
        run: The sensor.
        interval: Interval of the instants.
        at_ns: Instants; shape (n,); ns.
        covariances: What the sensor reads without a contact; shape (n, 6, 6).
        square: Square over the covariance that is noticed.

    Returns:
        Forces by link, that at the worst place of the axis in the worst direction; shape (n,) each; N.

    Raises:
        ExperimentError: If the interval has no support, or no link lies beyond the sensor.
    """
    tree, equation = equation_at(run, interval, at_ns)
    of_robot = np.linalg.inv(equation.transmission[:, 0])
    information = of_robot.swapaxes(1, 2) @ np.linalg.solve(covariances, of_robot)
    forces = {}
    for link, points in _axes(tree, equation).items():
        force = np.tile(np.eye(6, 3), (*points.shape[:2], 1, 1))
        force[..., 3:, :] = np.cross(points[:, :, None], np.eye(3)).swapaxes(2, 3)
        least = np.linalg.eigvalsh(force.swapaxes(2, 3) @ information[:, None] @ force)[..., 0]
        forces[link] = np.sqrt(square / least.min(axis=1))
    return forces


def _axes(tree: BodyTree, equation: PartEquation) -> dict[str, FloatArray]:
    """Points of the axes of the bodies of a part, by the heaviest link of each; shape (n, k, 3) each; m."""
    axes = {}
    share = np.linspace(0.0, 1.0, _ALONG)[:, None]
    for index in equation.part.bodies:
        body, poses = tree.bodies[index], equation.poses[index]
        start = poses[:, None, :3, 3]
        ends = [equation.poses[k][:, :3, 3] for k in equation.part.bodies if tree.bodies[k].parent == index]
        ends += [(poses @ tree.frames[link][1])[:, :3, 3] for link in body.links]
        if body.inertia.mass > 0.0:
            ends.append(poses[:, :3, :3] @ (body.inertia.first_moment / body.inertia.mass) + poses[:, :3, 3])
        points = [start + share * (end[:, None] - start) for end in ends]
        name = max(body.links, key=lambda link: tree.inertias[link].mass)
        axes[name] = np.concatenate([start, *points], axis=1)
    return axes


def _nearest(wrench: FloatArray, points: FloatArray) -> tuple[float, FloatArray]:
    """Distance of the line of action from points, and the point of the line that is nearest to them."""
    force, moment = wrench[:3], wrench[3:]
    direction = force / np.linalg.norm(force)
    foot = np.cross(force, moment) / (force @ force)
    of_line = foot + ((points - foot) @ direction)[:, None] * direction
    distances = np.linalg.norm(points - of_line, axis=1)
    place = int(np.argmin(distances))
    return float(distances[place]), of_line[place]


def _deviation(wrench: FloatArray, covariance: FloatArray, points: FloatArray) -> float:
    """Standard deviation of where the line passes the points, to first order; m."""
    _, at = _nearest(wrench, points)
    direction = wrench[:3] / np.linalg.norm(wrench[:3])
    across = np.eye(3) - np.outer(direction, direction)
    # the line moves at a point by what the moment about the point says: f x m / f^2
    about = np.zeros((3, 6))
    about[:, 3:] = np.eye(3)
    about[:, :3] = -np.array([[0.0, -at[2], at[1]], [at[2], 0.0, -at[0]], [-at[1], at[0], 0.0]])
    moved = across @ np.cross(wrench[:3], about.T).T / (wrench[:3] @ wrench[:3])
    return float(np.sqrt(max(np.linalg.eigvalsh(moved @ covariance @ moved.T)[-1], 0.0)))
