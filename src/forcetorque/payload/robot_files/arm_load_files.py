# SPDX-License-Identifier: BSD-3-Clause
"""Loads read back from what is written for controllers of arms: calls and variables with numbers, each in its units."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import read_text
from forcetorque.base.pose import rotation_from_rpy
from forcetorque.base.units import DECIMAL_NUMBER
from forcetorque.payload.robot_files.formats import LoadFormat
from forcetorque.payload.robot_files.robot_load import FlangeLoad

_SYMMETRIC = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])
"""Places of xx, yy, zz, xy, xz, yz in a tensor."""


def _ur(values: FloatArray) -> FlangeLoad:
    return _load(values[0], values[1:4], values[4:][_SYMMETRIC])


def _franka(values: FloatArray) -> FlangeLoad:
    return _load(values[0], values[1:4], values[4:].reshape(3, 3).T)


def _kuka(values: FloatArray) -> FlangeLoad:
    # Z, Y', X'' in that order are yaw, pitch, roll
    turn = rotation_from_rpy(np.deg2rad(values[[6, 5, 4]]))
    return _load(values[0], 1e-3 * values[1:4], turn @ np.diag(values[7:]) @ turn.T)


def _load(mass: float, centre: FloatArray, inertia: FloatArray) -> FlangeLoad:
    return FlangeLoad(mass=float(mass), centre_of_mass=centre, inertia=inertia, has_inertia=bool(inertia.any()))


def _call(*counts: int) -> str:
    """A mass and lists of so many numbers."""
    return "(" + ", ".join(["#", *("[" + ", ".join("#" * count) + "]" for count in counts)]) + ")"


_FORMS: dict[LoadFormat, tuple[str, Callable[[FloatArray], FlangeLoad]]] = {
    LoadFormat.UR: ("set_target_payload" + _call(3, 6), _ur),
    LoadFormat.FRANKA: ("robot.set_load" + _call(3, 9), _franka),
    LoadFormat.KUKA: ("LOAD_DATA[1]={M #, CM {X #, Y #, Z #, A #, B #, C #}, J {X #, Y #, Z #}}", _kuka),
}
"""Line of a load, with # for numbers, and what makes the load of them."""
READABLE_ARMS = tuple(_FORMS)
"""Forms of arms that are read back."""


def read_arm_load(path: Path | str, form: LoadFormat) -> FlangeLoad:
    """Read the load that a controller is given.

    Args:
        path: The file.
        form: One of `READABLE_ARMS`.

    Returns:
        The load in the flange.

    Raises:
        FormatError: If there is no such line, or several, or its numbers are none.
    """
    line, load_of = _FORMS[form]
    pattern = re.escape(line).replace(r"\#", f"({DECIMAL_NUMBER.pattern})").replace(r",\ ", r",\s*")
    loads = re.findall(rf"^\s*{pattern}\s*$", read_text(Path(path), f"a load for {form}"), re.MULTILINE)
    if len(loads) != 1:
        raise FormatError(f"{path}: expected one line as {line} with numbers for #, got {len(loads)}")
    values = np.array([float(number) for number in loads[0]])
    if not np.isfinite(values).all() or values[0] < 0.0:
        raise FormatError(f"{path}: expected finite numbers and a mass of 0 kg or more, got {loads[0]}")
    return load_of(values)
