# SPDX-License-Identifier: BSD-3-Clause
"""The sensor by itself: how load becomes counts, amplifier gains, drift with temperature, response to fast forces."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.sensor.bandwidth.bandwidth import response
    from forcetorque.sensor.commands import thermal
    from forcetorque.sensor.gains.gains import select_gains

CAPABILITY = Capability(
    page="sensor/temperature.md",
    commands=(
        "forcetorque.sensor.commands:gains",
        "forcetorque.sensor.commands:response",
        "forcetorque.sensor.commands:thermal",
    ),
)

__all__ = [
    "response",
    "select_gains",
    "thermal",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "response": "forcetorque.sensor.bandwidth.bandwidth",
        "select_gains": "forcetorque.sensor.gains.gains",
        "thermal": "forcetorque.sensor.commands",
    },
)
