# SPDX-License-Identifier: BSD-3-Clause
"""Robots that ship with the library."""

from pathlib import Path

ARM_URDF = Path(__file__).parent / "arm.urdf"
"""A small arm; its sensor is `arm_ft`, its base stands level."""

BIPED_URDF = Path(__file__).parent / "biped.urdf"
"""A small humanoid; its sensors are `l_arm_ft`, `l_leg_ft`, `l_foot_ft` and those of the right side, its soles
`l_sole` and `r_sole`, its IMU reads in `imu`."""

__all__ = ["ARM_URDF", "BIPED_URDF"]
