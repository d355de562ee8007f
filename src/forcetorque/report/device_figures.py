# SPDX-License-Identifier: BSD-3-Clause
"""All figures of a calibration device, in one folder."""

from __future__ import annotations

from pathlib import Path

from forcetorque.analysis import DeviceDesign
from forcetorque.new_folder import new_folder
from forcetorque.report.figures import (
    device_figure,
    envelope_figure,
    reference_error_figure,
    remedies_figure,
    space_figure,
)
from forcetorque.report.figures.canvas import png_bytes


def write_device_figures(design: DeviceDesign, output: Path) -> DeviceDesign:
    """Draw a device, all or nothing.

    Args:
        design: The device.
        output: Folder to make, for `motion.png` (figures 6.5 and 6.9 of the thesis), `space.png` (6.6 and 6.7),
            `remedies.png` (predicted errors by direction), `envelope.png` (6.13) and `errors.png` (Table 6.3).

    Returns:
        The design with the names of the files.
    """
    picture, demands = design.picture, design.demands
    torques = {joint: picture.answer.torque(joint) for joint in picture.answer.joints}
    figures = {
        "motion.png": device_figure(picture.time_s, picture.motion, torques),
        "space.png": space_figure(picture.clouds),
        "remedies.png": remedies_figure(design.span.directions),
        "envelope.png": envelope_figure(demands.silhouettes),
        "errors.png": reference_error_figure(demands.grades),
    }
    with new_folder(output) as folder:
        for name, figure in figures.items():
            (folder / name).write_bytes(png_bytes(figure))
    return design.model_copy(update={"figures": tuple(str(output / name) for name in figures)})
