# SPDX-License-Identifier: BSD-3-Clause
"""Robots that ship with the library."""

from collections.abc import Sequence
from pathlib import Path

from forcetorque.base.errors import MissingExtraError
from forcetorque.robot.installed_robots import installed_robot

ARM_URDF = Path(__file__).parent / "arm.urdf"
"""A small arm; its sensor is `arm_ft`, its base stands level."""

BIPED_URDF = Path(__file__).parent / "biped.urdf"
"""A small humanoid; its sensors are `l_arm_ft`, `l_leg_ft`, `l_foot_ft` and those of the right side, its soles
`l_sole` and `r_sole`, its IMU reads in `imu`."""

__all__ = ["ARM_URDF", "BIPED_URDF", "named_robot"]


def named_robot(names: Sequence[str]) -> Path:
    """Find the first robot of a list that is installed.

    Args:
        names: `arm`, `biped`, or names of installed robots.

    Returns:
        Its URDF file.

    Raises:
        MissingExtraError: If none is installed.
    """
    own = {"arm": ARM_URDF, "biped": BIPED_URDF}
    missing = MissingExtraError("expected the name of a robot, got none")
    for name in names:
        if name in own:
            return own[name]
        try:
            return installed_robot(name, others=own).urdf
        except MissingExtraError as error:
            missing = error
    raise missing
