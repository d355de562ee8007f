# SPDX-License-Identifier: BSD-3-Clause
"""How load becomes counts: elastic element, gauge, bridge, amplifier, converter, saturation, full scale.

The elastic elements, gauges and transfer functions are in the sub-packages `elastic`, `gauge` and `transfer`.
"""

from forcetorque.sensor.adc import Adc, Rounding
from forcetorque.sensor.amplifier import Amplifier
from forcetorque.sensor.bridge import (
    FULL_BRIDGE,
    HALF_BRIDGE,
    OPPOSITE_HALF_BRIDGE,
    QUARTER_BRIDGE,
    QUARTER_BRIDGE_WITH_DUMMY,
    Bridge,
    bridge_ratio,
    linearised_bridge_ratio,
)
from forcetorque.sensor.catalogue import (
    CatalogueSensor,
    Technology,
    find_sensor,
    sensor_catalogue,
    sensors_with_range,
)
from forcetorque.sensor.elastic import ElasticElement, cross_shaped_element, y_shaped_element
from forcetorque.sensor.full_scale import (
    FullScale,
    all_channels_full_scale,
    axis_resolution,
    full_scale,
    quantisation_noise,
)
from forcetorque.sensor.gauge import ResistiveGauge
from forcetorque.sensor.reachable import Coverage, RawLimits, ReachableFullScale, coverage, reachable_full_scale
from forcetorque.sensor.saturation import HeldCounts, hold_on_saturation

__all__ = [
    "FULL_BRIDGE",
    "HALF_BRIDGE",
    "OPPOSITE_HALF_BRIDGE",
    "QUARTER_BRIDGE",
    "QUARTER_BRIDGE_WITH_DUMMY",
    "Adc",
    "Amplifier",
    "Bridge",
    "CatalogueSensor",
    "Coverage",
    "ElasticElement",
    "FullScale",
    "HeldCounts",
    "RawLimits",
    "ReachableFullScale",
    "ResistiveGauge",
    "Rounding",
    "Technology",
    "all_channels_full_scale",
    "axis_resolution",
    "bridge_ratio",
    "coverage",
    "cross_shaped_element",
    "find_sensor",
    "full_scale",
    "hold_on_saturation",
    "linearised_bridge_ratio",
    "quantisation_noise",
    "reachable_full_scale",
    "sensor_catalogue",
    "sensors_with_range",
    "y_shaped_element",
]
