# SPDX-License-Identifier: BSD-3-Clause
"""What mechanics demands of the sensors of a recording."""

from forcetorque.estimation.payload import Payload, identify_payload
from forcetorque.estimation.root_motion import support_motion_at
from forcetorque.estimation.samples import Processing, SensorSamples, sensor_samples

__all__ = ["Payload", "Processing", "SensorSamples", "identify_payload", "sensor_samples", "support_motion_at"]
