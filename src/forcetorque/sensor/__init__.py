# SPDX-License-Identifier: BSD-3-Clause
"""The sensor by itself: its choice, how load becomes counts, gains, drift, response to fast forces."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.sensor.bandwidth.response import response as response
    from forcetorque.sensor.commands import choose_sensor as choose_sensor, drift as drift, thermal as thermal
    from forcetorque.sensor.gains.gains import select_gains as select_gains

CAPABILITY = Capability(
    page="sensor/temperature.md",
    commands=(
        "forcetorque.sensor.commands:gains",
        "forcetorque.sensor.commands:sensor",
        "forcetorque.sensor.commands:response",
        "forcetorque.sensor.commands:thermal",
        "forcetorque.sensor.commands:drift",
    ),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    choose_sensor="forcetorque.sensor.commands",
    drift="forcetorque.sensor.commands",
    response="forcetorque.sensor.bandwidth.response",
    select_gains="forcetorque.sensor.gains.gains",
    thermal="forcetorque.sensor.commands",
)
