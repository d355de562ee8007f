# SPDX-License-Identifier: BSD-3-Clause
"""Calibration devices, for scripts and notebooks."""

from __future__ import annotations

from pathlib import Path

from forcetorque import analysis
from forcetorque.exsitu.device import DEFAULT_DEVICE, DeviceFile, read_device


def design_device(device: DeviceFile | Path | str = DEFAULT_DEVICE) -> analysis.DeviceDesign:
    """Check a calibration device by computation.

    Args:
        device: The device, or its file; the one that comes with the library if left out.

    Returns:
        What the command line shows; its `picture` has the motion, and `forcetorque.analysis.write_device` writes it.
    """
    return analysis.device(device if isinstance(device, DeviceFile) else read_device(device))
