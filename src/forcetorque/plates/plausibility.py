# SPDX-License-Identifier: BSD-3-Clause
"""Messages of the plausibility checks of the workbench for a force plate, which has no file of a sensor."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from forcetorque.inspection.plausibility.compared_wrenches import WORKBENCH

_CHANNELS = "SCALE, GEN_SCALE and CAL_MATRIX of the C3D file"
CHECK_CHANNELS: Final = f"check {_CHANNELS}"
"""Where to look if loads contradict the wrenches of the file."""
PLATE: Final = replace(
    WORKBENCH,
    gain_causes=(
        (300.0, 3000.0, "are weights given in t, or forces in kN?"),
        (7.0, 14.0, "are forces in kgf?"),
        (0.07, 0.14, "are weights in N given as masses in kg?"),
        (-0.1, 0.02, "are weights in g instead of kg?"),
    ),
    check_gain=f"check the weights, or the unit and the calibration of the load cell, and {_CHANNELS}",
    check_sign="is --measure-direction the right way round, or are --tip and --head exchanged?",
    check_axes="are CORNERS and CHANNEL of the C3D file in the order of the plate's axes?",
    check_moment="check the unit of lengths, POINT:UNITS of the C3D file or --recording length_unit=...",
    check_span="check that the loads are those of this trial, and --plate the one that bears them",
    give_mass="so nothing bears on the plate; give other loads",
)
"""A force plate under a pole or weights, whose measurements are wrenches already."""
