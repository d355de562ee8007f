# SPDX-License-Identifier: BSD-3-Clause
"""Corrections to XML, in a form that YARP reads back to the last bit."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.atomic import write_bytes_atomically
from forcetorque.errors import FormatError
from forcetorque.exchange.wholebodydynamics.correction import SensorCorrection
from forcetorque.exchange.wholebodydynamics.group import Group

_HEAD = """\
<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE params PUBLIC "-//YARP//DTD yarprobotinterface 3.0//EN" "http://www.yarp.it/DTD/yarprobotinterfaceV3.0.dtd">
<!--
  Corrections of force-torque sensors, f = S f_in + FT_OFFSET{temperature_term}, in N and N m; S by rows.
  Include this file inside the device of type wholebodydynamics with an xi:include element, or copy the groups there.

  FT_OFFSET is ADDED. The README of wholebodydynamics says that it is subtracted, but its code takes -FT_OFFSET as
  the offset that it subtracts. The device uses it only after the RPC command usePreEstimatedOffset; until then, and
  after every command of the calib family, it subtracts an offset of its own. It ignores an FT_OFFSET of six zeros.

  f_in are the readings that the sensor makes with the matrix that was in it when it was calibrated. Once another
  matrix is loaded into the sensor, FT_SECONDARY_CALIBRATION must go.{temperature_note}
-->
<params>
"""
_TEMPERATURE_NOTE = """

  FT_TEMPERATURE_COEFFICIENTS holds c, then T0 in degC. The device must be given the temperature T of the sensor:
  without it, it takes 0 degC."""


def write_groups(path: Path | str, corrections: Iterable[SensorCorrection]) -> None:
    """Write corrections of one or several sensors; on any error the file keeps what it held before.

    FT_OFFSET is written with the sign of `SensorCorrection.offset`, which is added: the device subtracts
    `-FT_OFFSET`, against what its README says. A comment in the file says so.

    The file can be included in the configuration of the device (`xi:include`), or its groups copied there.

    Args:
        path: File to write or to replace, in an existing folder.
        corrections: Corrections; every sensor once.

    Raises:
        FormatError: If there is no sensor, or one twice.
    """
    chosen = list(corrections)
    names = [correction.sensor for correction in chosen]
    if not names:
        raise FormatError(f"{path}: expected at least one sensor to write, got none; YARP refuses empty groups")
    if repeated := [name for name in dict.fromkeys(names) if names.count(name) > 1]:
        raise FormatError(f"{path}: expected every sensor once, got {repeated[0]!r} {names.count(repeated[0])} times")
    lists = {
        Group.SECONDARY_CALIBRATION: {c.sensor: c.secondary_matrix for c in chosen},
        Group.TEMPERATURE_COEFFICIENTS: {
            c.sensor: np.append(c.temperature_coefficients, c.reference_temperature)
            for c in chosen
            if c.temperature_coefficients is not None and c.reference_temperature is not None
        },
        Group.OFFSET: {c.sensor: c.offset for c in chosen},
    }
    with_temperature = bool(lists[Group.TEMPERATURE_COEFFICIENTS])
    text = _HEAD.format(
        temperature_term=" + c (T - T0)" if with_temperature else "",
        temperature_note=_TEMPERATURE_NOTE if with_temperature else "",
    )
    text += "".join(_group_text(group, params) for group, params in lists.items() if params)
    write_bytes_atomically(Path(path), (text + "</params>\n").encode())


def _group_text(group: Group, params: dict[str, FloatArray]) -> str:
    lines = [f'  <group name="{group}">']
    for sensor, values in params.items():
        rows = np.atleast_2d(values).tolist()
        numbers = ",\n      ".join(", ".join(_number(value) for value in row) for row in rows)
        lines += [f"    <param name={quoteattr(sensor)}>(", f"      {numbers})</param>"]
    return "\n".join([*lines, "  </group>\n"])


def _number(value: float) -> str:
    """Shortest digits that read back exactly, with a point and without an exponent."""
    # Without a point YARP reads an integer, and its early versions took a number with a negative
    # exponent for a word, which counts as zero.
    return np.format_float_positional(value, unique=True, trim="0")
