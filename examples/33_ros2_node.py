# SPDX-License-Identifier: BSD-3-Clause
"""A node of ROS 2 that corrects a WrenchStamped, for users of rclpy.

Usage: python examples/33_ros2_node.py CALIBRATION --input TOPIC --output TOPIC

The wrench of the topic must be that of the prior matrix of the calibration. Without ROS, `forcetorque live --ros2` does
the same. Parameters that `forcetorque export` writes for a driver or controller need no Python in the loop.
"""

from __future__ import annotations

import argparse
from contextlib import suppress
from typing import Any

from forcetorque import read_calibration
from forcetorque.live import Corrector, CorrectorOptions, FaultPolicy
from forcetorque.live.option_values import HeldQuantity


def main() -> None:
    """Correct messages until the node is shut down."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("calibration", help="calibration file")
    parser.add_argument("--input", required=True, help="topic of WrenchStamped")
    parser.add_argument("--output", required=True, help="topic of the corrected WrenchStamped")
    arguments = parser.parse_args()

    import rclpy
    from geometry_msgs.msg import WrenchStamped
    from rclpy.executors import ExternalShutdownException
    from rclpy.qos import qos_profile_sensor_data

    options = CorrectorOptions(quantity=HeldQuantity.WRENCH, policy=FaultPolicy.REFUSE)
    corrector = Corrector(read_calibration(arguments.calibration), options)
    if corrector.variables[0]:
        parser.error(f"the calibration needs {', '.join(corrector.variables[0])}, which a WrenchStamped lacks")
    rclpy.init()
    node = rclpy.create_node("forcetorque_live")
    publisher = node.create_publisher(WrenchStamped, arguments.output, 10)

    def correct(message: Any) -> None:
        vectors = (message.wrench.force, message.wrench.torque)
        values = [getattr(vector, axis) for vector in vectors for axis in "xyz"]
        stamp = message.header.stamp
        sample = corrector.correct(values, stamp_ns=stamp.sec * 1_000_000_000 + stamp.nanosec)
        if sample.wrench[0, 0] == sample.wrench[0, 0]:  # refused samples are NaN
            for vector, numbers in zip(vectors, sample.wrench[0].reshape(2, 3).tolist(), strict=True):
                vector.x, vector.y, vector.z = numbers
            publisher.publish(message)

    node.create_subscription(WrenchStamped, arguments.input, correct, qos_profile_sensor_data)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


if __name__ == "__main__":
    main()
