# SPDX-License-Identifier: BSD-3-Clause
"""Calibration devices, for scripts and notebooks."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from forcetorque import analysis

if TYPE_CHECKING:  # what a device needs takes long to import, and most scripts have none
    from forcetorque.exsitu.device import DeviceFile


def design_device(device: DeviceFile | Path | str | None = None) -> analysis.DeviceDesign:
    """Check a calibration device by computation.

    Args:
        device: The device, or its file; the one that comes with the library if None.

    Returns:
        What the command line shows; its `picture` has the motion, and `forcetorque.analysis.write_device` writes it.
    """
    from forcetorque.exsitu.device import DEFAULT_DEVICE, DeviceFile, read_device

    if not isinstance(device, DeviceFile):
        device = read_device(DEFAULT_DEVICE if device is None else device)
    return analysis.design_device(device)
