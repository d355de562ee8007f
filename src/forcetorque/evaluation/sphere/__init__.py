# SPDX-License-Identifier: BSD-3-Clause
"""The sphere that gravity draws in the space of forces, and the ellipsoid that a sensor makes of it."""

from forcetorque.evaluation.sphere.affine import MappedFit, MomentFit
from forcetorque.evaluation.sphere.analysis import SphereAnalysis, analyse_sphere
from forcetorque.evaluation.sphere.apparent_mass import apparent_masses, axis_errors
from forcetorque.evaluation.sphere.ellipsoid import Ellipsoid, ellipsoid_of_map
from forcetorque.evaluation.sphere.findings import RULE, TOLERANCE, CloudForm, EllipsoidFit, RadiusFit
from forcetorque.evaluation.sphere.orthogonal import ellipsoid_distances
from forcetorque.evaluation.sphere.pooled import PooledSphere, pool_trials
from forcetorque.evaluation.sphere.trials import Drift, TrialMean, drift_between, mean_of_trials

__all__ = [
    "RULE",
    "TOLERANCE",
    "CloudForm",
    "Drift",
    "Ellipsoid",
    "EllipsoidFit",
    "MappedFit",
    "MomentFit",
    "PooledSphere",
    "RadiusFit",
    "SphereAnalysis",
    "TrialMean",
    "analyse_sphere",
    "apparent_masses",
    "axis_errors",
    "drift_between",
    "ellipsoid_distances",
    "ellipsoid_of_map",
    "mean_of_trials",
    "pool_trials",
]
