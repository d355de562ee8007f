# SPDX-License-Identifier: BSD-3-Clause
"""XML to corrections; a group that the device would refuse is refused."""

from __future__ import annotations

import math
import re
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.decimal_text import DECIMAL_NUMBER
from forcetorque.errors import FormatError, MissingFileError, quoted
from forcetorque.exchange.wholebodydynamics.correction import SensorCorrection
from forcetorque.exchange.wholebodydynamics.group import Group
from forcetorque.xml_file import read_xml

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
