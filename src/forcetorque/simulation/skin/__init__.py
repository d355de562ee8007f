# SPDX-License-Identifier: BSD-3-Clause
"""Simulated skin: objects of known weight on a smooth surface, and what the taxels of a patch read of them."""

from forcetorque.simulation.skin.chamber import chamber_recording
from forcetorque.simulation.skin.contact import GRID_M, ContactTruth, SkinBody, SkinContact
from forcetorque.simulation.skin.draw import ON_SKIN, contacts
from forcetorque.simulation.skin.objects import ClothStrip, FlatWeight, Palm, SkinObject, Sphere
from forcetorque.simulation.skin.recording import Loading, contact_recording
from forcetorque.simulation.skin.response import NOISE_COUNTS, REFERENCE_PA, REST_COUNTS, SWING_COUNTS, TaxelResponses
from forcetorque.simulation.skin.true_surface import SurfacePoints, TrueSurface
from forcetorque.simulation.skin.warmth import HeatResponses, MotorHeat, Warmth, warm_recording

__all__ = [
    "GRID_M",
    "NOISE_COUNTS",
    "ON_SKIN",
    "REFERENCE_PA",
    "REST_COUNTS",
    "SWING_COUNTS",
    "ClothStrip",
    "ContactTruth",
    "FlatWeight",
    "HeatResponses",
    "Loading",
    "MotorHeat",
    "Palm",
    "SkinBody",
    "SkinContact",
    "SkinObject",
    "Sphere",
    "SurfacePoints",
    "TaxelResponses",
    "TrueSurface",
    "Warmth",
    "chamber_recording",
    "contact_recording",
    "contacts",
    "warm_recording",
]
