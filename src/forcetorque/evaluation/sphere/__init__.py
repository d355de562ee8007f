# SPDX-License-Identifier: BSD-3-Clause
"""The sphere that gravity draws in the space of forces, and the ellipsoid that a sensor makes of it."""

from forcetorque.evaluation.sphere.affine import MappedFit, MomentFit
from forcetorque.evaluation.sphere.analysis import SphereAnalysis, analyse_sphere
from forcetorque.evaluation.sphere.apparent_mass import apparent_masses, axis_errors, performance_index
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid, ellipsoid_of_map
from forcetorque.evaluation.sphere.findings import RULE, TOLERANCE, CloudForm, EllipsoidFit, RadiusFit

__all__ = [
    "RULE",
    "TOLERANCE",
    "CloudForm",
    "Ellipsoid",
    "EllipsoidFit",
    "MappedFit",
    "MomentFit",
    "RadiusFit",
    "SphereAnalysis",
    "analyse_sphere",
    "apparent_masses",
    "axis_errors",
    "ellipsoid_of_map",
    "performance_index",
]
