# SPDX-License-Identifier: BSD-3-Clause
"""How a robot stands: which feet bear it, where their pressure is centred, and how its centre of mass moves."""

from forcetorque.estimation.balance.centre_of_mass import centre_of_mass, mass_of
from forcetorque.estimation.balance.centre_of_pressure import PressureCentres, centre_of_pressure
from forcetorque.estimation.balance.com_acceleration import (
    STAY_S,
    ComAcceleration,
    com_acceleration,
    pendulum_acceleration,
    stays_in_band,
)
from forcetorque.estimation.balance.contact_state import (
    RELEASE_SHARE,
    TOUCH_SHARE,
    ContactThresholds,
    contact_state,
)
from forcetorque.estimation.balance.force_limit import ForceLimit
from forcetorque.estimation.balance.ground import PlaneTolerance, coplanar, wrench_on_ground
from forcetorque.estimation.balance.sole import Sole
from forcetorque.estimation.balance.support_phases import (
    NO_FOOT,
    SupportPhase,
    SupportPhases,
    require_support,
    support_phases,
)

__all__ = [
    "NO_FOOT",
    "RELEASE_SHARE",
    "STAY_S",
    "TOUCH_SHARE",
    "ComAcceleration",
    "ContactThresholds",
    "ForceLimit",
    "PlaneTolerance",
    "PressureCentres",
    "Sole",
    "SupportPhase",
    "SupportPhases",
    "centre_of_mass",
    "centre_of_pressure",
    "com_acceleration",
    "contact_state",
    "coplanar",
    "mass_of",
    "pendulum_acceleration",
    "require_support",
    "stays_in_band",
    "support_phases",
    "wrench_on_ground",
]
