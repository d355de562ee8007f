# SPDX-License-Identifier: BSD-3-Clause
"""How a robot differs from its model: errors of masses, centres and joint zeros, and masses fastened to it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, mapping, read_only
from forcetorque.base.errors import RobotError, require_known
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import make_pose, rotation_about_z, rotation_with_z_along, skew
from forcetorque.robot.model import Joint, JointType, RobotModel


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RobotErrors(ArrayRecord):
    """Differences between a robot and its model, link by link and joint by joint."""

    mass: Mapping[str, float] = field(metadata=mapping())
    """Relative difference of every link's mass, and with it of its second moment about the centre of mass."""
    centre_m: Mapping[str, FloatArray] = field(metadata=mapping(3))
    """How far the centre of mass of every link is away from the model's, in the link's frame; shape (3,); m."""
    joint_zero_rad: Mapping[str, float] = field(metadata=mapping())
    """How far every joint is turned, or moved, where it reads zero; rad, or m where it slides.

    Joints that mimic it are turned by as much as that moves them.
    """

    @classmethod
    def draw(
        cls, model: RobotModel, *, mass: float, centre_m: float, joint_zero_rad: float, rng: np.random.Generator
    ) -> RobotErrors:
        """Draw errors for all links with a mass, and all rotary joints that mimic no other.

        Args:
            model: The robot as it is thought to be.
            mass: Standard deviation of the relative difference of masses.
            centre_m: Standard deviation of every coordinate of centres of mass; m.
            joint_zero_rad: Standard deviation of zeros of joints; rad.
            rng: Source of the errors.

        Returns:
            The errors.
        """
        links = [link for link, inertia in model.links.items() if inertia.mass > 0.0]
        rotary = (JointType.REVOLUTE, JointType.CONTINUOUS)
        joints = [joint.name for joint in model.joints.values() if joint.type in rotary and joint.mimic is None]
        return cls(
            mass=dict(zip(links, (mass * rng.standard_normal(len(links))).tolist(), strict=True)),
            centre_m=dict(zip(links, centre_m * rng.standard_normal((len(links), 3)), strict=True)),
            joint_zero_rad=dict(zip(joints, (joint_zero_rad * rng.standard_normal(len(joints))).tolist(), strict=True)),
        )

    def applied_to(self, model: RobotModel) -> RobotModel:
        """Give the robot as it is.

        Args:
            model: The robot as it is thought to be.

        Returns:
            The robot with these errors; joints have the coordinates that their encoders read.

        Raises:
            RobotError: If the robot has no such link or joint, a link without a mass is to change, or a mass would not
                stay positive.
        """
        links, joints = dict(model.links), dict(model.joints)
        for link in {**self.mass, **self.centre_m}:
            require_known(link, links, RobotError, f"errors: robot {model.name!r} has no link {link!r}")
            share = 1.0 + self.mass.get(link, 0.0)
            if links[link].mass <= 0.0 or not share > 0.0:
                raise RobotError(
                    f"errors of link {link!r}: expected a mass that stays positive, got {links[link].mass:g} kg times "
                    f"{share:g}"
                )
            links[link] = _changed(links[link], share, self.centre_m.get(link, np.zeros(3)))
        for name, angle in self.joint_zero_rad.items():
            require_known(name, joints, RobotError, f"errors: robot {model.name!r} has no joint {name!r}")
            for joint in joints.values():
                ratio = _ratio(model, joint, name)
                if ratio:
                    joints[joint.name] = _moved(joint, ratio * angle)
        return replace(model, links=links, joints=joints)


def _changed(inertia: Inertia, share: float, shift: FloatArray) -> Inertia:
    centre = inertia.first_moment / inertia.mass
    hat = skew(centre)
    return Inertia.about_centre_of_mass(
        mass=share * inertia.mass,
        centre_of_mass=centre + shift,
        second_moment=share * (inertia.second_moment + inertia.mass * hat @ hat),
    )


def _ratio(model: RobotModel, joint: Joint, name: str) -> float:
    """By how much a joint moves where a joint of some name moves by 1."""
    ratio, seen = 1.0, {joint.name}
    while joint.name != name and joint.mimic is not None and joint.mimic.leader in model.joints.keys() - seen:
        ratio *= joint.mimic.multiplier
        joint = model.joints[joint.mimic.leader]
        seen.add(joint.name)
    return ratio if joint.name == name else 0.0


def _moved(joint: Joint, by: float) -> Joint:
    if joint.type is JointType.PRISMATIC:
        move = make_pose(np.eye(3), by * joint.axis)
    else:
        axis = rotation_with_z_along(joint.axis)
        move = make_pose(axis @ rotation_about_z(np.array(by)) @ axis.T, np.zeros(3))
    return replace(joint, parent_H_child=joint.parent_H_child @ move)


def with_load(
    model: RobotModel, link: str, *, mass_kg: float, centre_of_mass_m: Any, second_moment: Any = None
) -> RobotModel:
    """Fasten a known mass to a link.

    Args:
        model: The robot.
        link: Link that carries it.
        mass_kg: Mass; kg.
        centre_of_mass_m: Its centre of mass in the link's frame; shape (3,); m.
        second_moment: Rotational inertia about its centre of mass, in the link's axes; shape (3, 3); kg m2; that of
            a point if None.

    Returns:
        A robot whose link is heavier.

    Raises:
        RobotError: If there is no such link, or the mass is negative or not finite.
    """
    require_known(link, model.links, RobotError, f"load: robot {model.name!r} has no link {link!r}")
    centre = read_only(centre_of_mass_m, name="centre_of_mass_m", shape=(3,))
    if not 0.0 <= mass_kg < np.inf or not np.isfinite(centre).all():
        raise RobotError(f"load on {link!r}: expected a mass of at least 0 kg, got {mass_kg} kg at {centre.tolist()} m")
    load = Inertia.about_centre_of_mass(
        mass=mass_kg,
        centre_of_mass=centre,
        second_moment=np.zeros((3, 3)) if second_moment is None else second_moment,
    )
    return replace(model, links={**model.links, link: model.links[link] + load})
