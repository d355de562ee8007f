# SPDX-License-Identifier: BSD-3-Clause
"""XML of wholebodydynamics read and written; a group that the device would refuse is refused."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from pathlib import Path
from xml.etree.ElementTree import Element
from xml.sax.saxutils import quoteattr

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.decimal_text import DECIMAL_NUMBER
from forcetorque.base.errors import FormatError, MissingFileError, quoted
from forcetorque.base.files import write_bytes_atomically
from forcetorque.base.xml_file import read_xml
from forcetorque.calibration.export.wholebodydynamics.correction import Group, SensorCorrection

_LIST = re.compile(r"\(([^()]*)\)")
_SEPARATOR = re.compile(r"[\s,]+")

_Lists = dict[Group, dict[str, FloatArray]]


def read_groups(path: Path | str) -> tuple[SensorCorrection, ...]:
    """Read the corrections in a configuration of wholebodydynamics, or in any file that holds its groups.

    A sensor that a group lacks has what the device takes: the identity as secondary matrix, no temperature
    coefficients, and six zeros as offset, with which the device keeps the offset that it found itself.
    Files that this one includes are not followed.

    Args:
        path: XML file.

    Returns:
        One correction per sensor, in the order in which the sensors are first named.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not XML, has none of the groups, or a group is not what the device expects.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a configuration of wholebodydynamics, there is no such file")
    root = read_xml(file)
    try:
        lists = _read_lists(root)
        names = dict.fromkeys(name for params in lists.values() for name in params)
        return tuple(_correction(name, lists) for name in names)
    except FormatError as error:
        raise FormatError(f"{file}: {error}") from error


def _read_lists(root: Element | None) -> _Lists:
    lists: _Lists = {group: {} for group in Group}
    for element in () if root is None else root.iter("group"):
        for group, params in lists.items():
            if element.get("name") == group:
                _add_params(params, group, element)
    if not any(lists.values()):
        raise FormatError(
            f"expected at least one of the groups {', '.join(Group)}, got none; are they in another file?"
        )
    return lists


def _add_params(params: dict[str, FloatArray], group: Group, element: Element) -> None:
    if len(element) == 0:
        raise FormatError(f"{group}: expected a <param> for every corrected sensor, got none; remove the empty group")
    for child in element:
        name = child.get("name")
        if child.tag != "param" or name is None:
            raise FormatError(
                f"{group}: expected <param name=...>, got the element {quoted(child.tag)} with the name {name!r}"
            )
        where = f"{group}: {quoted(name)}"
        if name in params:  # groups of the same name are one to the device, so this holds over all of them
            raise FormatError(f"{where}: expected every sensor once, got it twice; the device would take the last")
        if len(child) > 0:
            raise FormatError(f"{where}: expected numbers in parentheses, got the element {quoted(child[0].tag)}")
        params[name] = _numbers(child.text or "", count=group.length, where=where)


def _numbers(text: str, *, count: int, where: str) -> FloatArray:
    content = _LIST.fullmatch(text.strip())
    if content is None:
        raise FormatError(f"{where}: expected {count} numbers in parentheses, got {quoted(text.strip())}")
    words = [word for word in _SEPARATOR.split(content[1]) if word]
    for word in words:
        if not DECIMAL_NUMBER.fullmatch(word):
            raise FormatError(f"{where}: expected {count} finite numbers such as -0.5, got {quoted(word)}")
    if len(words) != count:
        raise FormatError(f"{where}: expected {count} numbers, got {len(words)}; the device refuses to start with that")
    values = [float(word) for word in words]
    for word, value in zip(words, values, strict=True):
        if not math.isfinite(value):
            raise FormatError(f"{where}: expected {count} finite numbers, got {quoted(word)}, which is too large")
    return np.array(values)


def _correction(name: str, lists: _Lists) -> SensorCorrection:
    secondary = lists[Group.SECONDARY_CALIBRATION].get(name)
    temperature = lists[Group.TEMPERATURE_COEFFICIENTS].get(name)
    return SensorCorrection(
        sensor=name,
        secondary_matrix=np.eye(6) if secondary is None else secondary.reshape(6, 6),
        offset=lists[Group.OFFSET].get(name, np.zeros(6)),
        temperature_coefficients=None if temperature is None else temperature[:6],
        reference_temperature=None if temperature is None else float(temperature[6]),
    )


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
