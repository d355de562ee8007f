# SPDX-License-Identifier: BSD-3-Clause
"""Frames, wrenches, twists, inertias and the one sign rule; see docs/conventions.md."""

from forcetorque.spatial.inertia import Inertia
from forcetorque.spatial.pose import invert_pose, make_pose, split_pose
from forcetorque.spatial.rotation import (
    cross,
    rotation_about_z,
    rotation_from_rpy,
    rotation_with_z_along,
    rpy_from_rotation,
    skew,
)
from forcetorque.spatial.sign import MeasureDirection, reading_sign
from forcetorque.spatial.twist import transform_twist, twist_matrix
from forcetorque.spatial.units import SI_FACTORS, si_factor
from forcetorque.spatial.wrench import (
    FORCE,
    FORCE_AND_MOMENT,
    MOMENT,
    WRENCH_COMPONENTS,
    WRENCH_UNITS,
    transform_wrench,
    wrench_matrix,
)

__all__ = [
    "FORCE",
    "FORCE_AND_MOMENT",
    "MOMENT",
    "SI_FACTORS",
    "WRENCH_COMPONENTS",
    "WRENCH_UNITS",
    "Inertia",
    "MeasureDirection",
    "cross",
    "invert_pose",
    "make_pose",
    "reading_sign",
    "rotation_about_z",
    "rotation_from_rpy",
    "rotation_with_z_along",
    "rpy_from_rotation",
    "si_factor",
    "skew",
    "split_pose",
    "transform_twist",
    "transform_wrench",
    "twist_matrix",
    "wrench_matrix",
]
