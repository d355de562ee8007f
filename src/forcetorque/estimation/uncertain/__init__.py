# SPDX-License-Identifier: BSD-3-Clause
"""Estimation with covariances: of readings, of known wrenches, and of the tangential force that skin does not feel."""

from forcetorque.estimation.uncertain.covariance import square_root, wrench_covariances
from forcetorque.estimation.uncertain.estimate import estimate_determined, estimate_with_covariance
from forcetorque.estimation.uncertain.estimates import UncertainEstimates
from forcetorque.estimation.uncertain.skin_source import OLDEST_S, SkinSource, frames_before, skin_sources
from forcetorque.estimation.uncertain.uncertainty import SLIPPING, Tangents, Uncertainty, tangent_maps
from forcetorque.estimation.uncertain.undetermined import Undetermined

__all__ = [
    "OLDEST_S",
    "SLIPPING",
    "SkinSource",
    "Tangents",
    "UncertainEstimates",
    "Uncertainty",
    "Undetermined",
    "estimate_determined",
    "estimate_with_covariance",
    "frames_before",
    "skin_sources",
    "square_root",
    "tangent_maps",
    "wrench_covariances",
]
