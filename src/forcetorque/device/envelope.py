# SPDX-License-Identifier: BSD-3-Clause
"""The space that a device sweeps (thesis figure 6.13), seen from above, from the side and from behind."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.device.description import Device, HungLoad
from forcetorque.device.model import BASE, device_model
from forcetorque.robot.kinematics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree

ARM_RADIUS_M = 0.06
"""Radius about the axis of the arm that motors, sensors and hinge stay within; the thesis prints none, it is ours."""

VIEWS = {"above": (0, 1), "the side": (0, 2), "behind": (1, 2)}
"""Axes of the base that each view shows."""

_RIM = 36
"""Points on a circle: its area is short by half a percent."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Silhouette:
    """What a device sweeps in one view."""

    view: str
    """One of `VIEWS`."""
    outline: FloatArray
    """Corners of the convex hull of all that is swept, in turn; shape (k, 2); m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "outline", read_only(self.outline, name="outline", shape=(None, 2)))

    @property
    def extent_m(self) -> FloatArray:
        """Width and height of the rectangle around it; shape (2,); m."""
        return np.asarray(np.ptp(self.outline, axis=0), dtype=np.float64)

    @property
    def rectangle_m2(self) -> float:
        """Area of that rectangle, in which the motion is contained; m2."""
        return float(np.prod(self.extent_m))

    @property
    def hull_m2(self) -> float:
        """Area of the convex hull; m2."""
        x, y = self.outline.T
        return float(0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def envelope(device: Device, load: HungLoad, poses: JointMotion) -> tuple[Silhouette, ...]:
    """Sweep all bodies through a motion: the arm within `ARM_RADIUS_M` of its axis, and the plates as a cylinder.

    Args:
        device: The device.
        load: What hangs on its hinge; plates are drawn for its mass.
        poses: Poses through which it moves, close to each other; n of them.

    Returns:
        One silhouette per view.
    """
    from scipy.spatial import ConvexHull

    tree = build_tree(device_model(device, load), BASE)
    moving = [link for link in tree.frames if link != BASE]
    origins = np.concatenate([link_pose(tree, poses, link)[:, :3, 3] for link in moving])
    carrier = link_pose(tree, poses, "carrier")
    plates = (_plate_rims(device, load) @ carrier[:, :3, :3].transpose(0, 2, 1) + carrier[:, None, :3, 3]).reshape(
        -1, 3
    )
    silhouettes = []
    for view, axes in VIEWS.items():
        arm = (origins[:, None, axes] + ARM_RADIUS_M * _circle()).reshape(-1, 2)
        points = np.concatenate([arm, plates[:, axes]])
        silhouettes.append(Silhouette(view=view, outline=points[ConvexHull(points).vertices]))
    return tuple(silhouettes)


def _plate_rims(device: Device, load: HungLoad) -> FloatArray:
    """Both rims of the plates that make up a load, in the frame of the carrier; shape (k, 3); m."""
    weights = device.weights
    top = weights.foot_m + weights.height_m * np.ceil(load.mass_kg / weights.step_kg)
    rim = weights.radius_m * _circle()
    return np.concatenate([np.column_stack([rim, np.full(_RIM, height)]) for height in (weights.foot_m, top)])


def _circle() -> FloatArray:
    angle = np.linspace(0.0, 2.0 * np.pi, _RIM, endpoint=False)
    return np.column_stack([np.cos(angle), np.sin(angle)])
