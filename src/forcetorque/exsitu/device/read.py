# SPDX-License-Identifier: BSD-3-Clause
"""Devices from files, and the one that comes with the library."""

from __future__ import annotations

from pathlib import Path

from forcetorque.exsitu.device.file import DeviceFile
from forcetorque.toml_table import read_toml

DEFAULT_DEVICE = Path(__file__).with_name("default.toml")
"""A device with the figures that the thesis prints; what it does not print is ours."""


def read_device(path: Path | str = DEFAULT_DEVICE) -> DeviceFile:
    """Read what a device is made of, how it moves and what is simulated of it.

    Args:
        path: TOML file; the device that comes with the library if left out.

    Returns:
        The device.
    """
    return read_toml(path, DeviceFile, what="a device file")
