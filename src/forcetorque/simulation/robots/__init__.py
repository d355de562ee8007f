# SPDX-License-Identifier: BSD-3-Clause
"""Robots that ship with the library."""

from collections.abc import Sequence
from pathlib import Path

from forcetorque.base.errors import MissingExtraError, RobotError, install_line, known_names

ARM_URDF = Path(__file__).parent / "arm.urdf"
"""A small arm; its sensor is `arm_ft`, its base stands level."""

BIPED_URDF = Path(__file__).parent / "biped.urdf"
"""A small humanoid; its sensors are `l_arm_ft`, `l_leg_ft`, `l_foot_ft` and those of the right side, its soles
`l_sole` and `r_sole`, its IMU reads in `imu`."""

__all__ = ["ARM_URDF", "BIPED_URDF", "named_robot"]


def named_robot(names: Sequence[str]) -> Path:
    """Find the first robot of a list that is installed.

    Args:
        names: `arm`, `biped`, or robots of the package icub-models.

    Returns:
        Its URDF file.

    Raises:
        RobotError: If a package is installed and has no robot of that name.
        MissingExtraError: If none is installed.
    """
    own = {"arm": ARM_URDF, "biped": BIPED_URDF}
    for name in names:
        if name in own:
            return own[name]
        try:
            import icub_models
        except ImportError:
            continue
        known = icub_models.get_robot_names()
        if name not in known:
            raise RobotError(f"no robot is called {name!r}; {known_names(name, [*own, *known])}")
        return Path(icub_models.get_model_file(name))
    raise MissingExtraError(f"robot {', '.join(names)}: expected the package icub-models: {install_line('icub')}")
