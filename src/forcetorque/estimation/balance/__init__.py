# SPDX-License-Identifier: BSD-3-Clause
"""How a robot stands: which feet bear it, where their pressure is centred, and how its centre of mass moves."""

from forcetorque.estimation.balance.contact_state import (
    RELEASE_SHARE,
    TOUCH_SHARE,
    ContactThresholds,
    contact_state,
)
from forcetorque.estimation.balance.support_phases import NO_FOOT, SupportPhase, SupportPhases, support_phases

__all__ = [
    "NO_FOOT",
    "RELEASE_SHARE",
    "TOUCH_SHARE",
    "ContactThresholds",
    "SupportPhase",
    "SupportPhases",
    "contact_state",
    "support_phases",
]
