# SPDX-License-Identifier: BSD-3-Clause
"""Corrections of sensors in wholebodydynamics: secondary matrix, offset, temperature; its XML read and written."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element
from xml.sax.saxutils import quoteattr

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_last_axis
from forcetorque.base.errors import FitError, FormatError, MissingFileError, RecordingError, ShapeError, quoted
from forcetorque.base.input_file import read_xml
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.units import DECIMAL_NUMBER
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import WrenchModel, is_invertible, secondary_model

# The device gets "(NAME (NUMBERS))" as text and splits it again, so the name must come out as one
# word of text: these characters end or quote a word, and these words become numbers or booleans.
_SPLITS_A_NAME = re.compile(r"[\s,()\[\]{}\"\\]")
_READS_AS_A_VALUE = re.compile(r"[-+.0-9][-+.0-9eE]*|[-+0]+[xX][-+.0-9a-fA-F]*|true|false|null|nan|-?inf")
_TEMPERATURE = ("temperature", "degC")
"""Name and unit of the only variable that the device knows."""
_UNKNOWN = "identity"
"""Source of the prior of a calibration of readings, in the experiment file."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorCorrection:
    """How wholebodydynamics corrects one sensor: `f = S f_in + c (T - T0) + offset`.

    The offset is ADDED, and it stands in the file with the same sign: the README of the device says that
    FT_OFFSET is subtracted, but its code takes `-FT_OFFSET` as the offset that it then subtracts.
    """

    sensor: str
    """Name of the sensor in the device's robot model."""
    secondary_matrix: FloatArray
    """S, for the sensor's own calibrated readings `f_in`; shape (6, 6)."""
    offset: FloatArray
    """What is added; shape (6,); N, N m. Six zeros mean that the device keeps the offset that it found itself."""
    temperature_coefficients: FloatArray | None = None
    """c; shape (6,); N/degC, N m/degC; None for a sensor without."""
    reference_temperature: float | None = None
    """T0; degC; given where the coefficients are."""

    def __post_init__(self) -> None:
        _require_usable_name(self.sensor)
        for name, shape in (("secondary_matrix", (6, 6)), ("offset", (6,)), ("temperature_coefficients", (6,))):
            if (values := getattr(self, name)) is not None:
                object.__setattr__(self, name, _finite(values, name=f"{self.sensor!r}: {name}", shape=shape))
        if (self.temperature_coefficients is None) is not (self.reference_temperature is None):
            raise FormatError(
                f"{self.sensor!r}: expected temperature coefficients and a reference temperature, got only one of them"
            )
        if self.reference_temperature is not None:
            _finite(self.reference_temperature, name=f"{self.sensor!r}: reference_temperature", shape=())


def corrected(correction: SensorCorrection, f_in: Any, temperature: Any = None) -> FloatArray:
    """Correct readings as wholebodydynamics does once it was told `usePreEstimatedOffset`.

    The device computes `S f_in - offset + c (T - T0)` with `offset = -FT_OFFSET` [1]. Where FT_OFFSET is six
    zeros it keeps the offset that it found itself, which nobody else knows; here nothing is added then.

    Args:
        correction: Correction of the sensor.
        f_in: Readings of the sensor, made with its own matrix; shape (..., 6); N, N m.
        temperature: Temperature of the sensor, one for all or one per reading; shape () or (...); degC.

    Returns:
        Corrected wrenches; shape (..., 6); N, N m.

    Raises:
        ShapeError: If the shapes are not these.
        RecordingError: If the correction needs a temperature and there is none.

    References:
        [1] whole-body-estimators, devices/wholeBodyDynamics: `filt` in SixAxisForceTorqueMeasureHelpers.cpp and
        `usePreEstimatedOffset` in WholeBodyDynamicsDevice.cpp.
    """
    readings = np.asarray(f_in, dtype=np.float64)
    require_last_axis(readings, name="f_in", length=6)
    internal_offset = -correction.offset
    wrench: FloatArray = readings @ correction.secondary_matrix.T - internal_offset
    if correction.temperature_coefficients is None or correction.reference_temperature is None:
        return wrench
    if temperature is None:
        raise RecordingError(
            f"temperature: expected that of sensor {correction.sensor!r} in degC, because its correction depends on "
            "it, got none; the device takes 0 degC where no temperature sensor is named to it"
        )
    degrees = np.asarray(temperature, dtype=np.float64)
    if degrees.shape not in ((), readings.shape[:-1]):
        raise ShapeError(f"temperature: expected shape () or {readings.shape[:-1]}, got {degrees.shape}")
    change = degrees - correction.reference_temperature
    return wrench + change[..., np.newaxis] * correction.temperature_coefficients


def from_calibration(
    calibration: Calibration, *, sensor_name: str | None = None, stream: Calibration | None = None
) -> SensorCorrection:
    """Give the correction that turns the sensor's present readings into those of a calibration.

    The sensor sends `f_in = C_prior raw`, and the calibration is `f = C raw + c (T - T0) + o`; so
    `f = S f_in + c (T - T0) + o` with `S = C C_prior^-1` (5.20). A stream that is already made with another
    calibration, offset and temperature included, is taken back to raw counts first.

    Args:
        calibration: Calibration whose prior is the matrix that the sensor holds, or whose sensor `stream` is of.
        sensor_name: Name of the sensor in the device's robot model; that of the calibration if None.
        stream: Calibration that makes the readings now; None for the prior matrix alone.

    Returns:
        The correction.

    Raises:
        FormatError: If the calibration has no prior of six channels, or a variable that the device does not know;
            if it and the stream's are not for the same readings.
        FitError: If the matrix of the stream cannot be inverted.
        SerialNumberError: If the stream is of another sensor.
    """
    where = f"sensor {calibration.sensor.name!r} ({calibration.sensor.serial!r})"
    of_stream = _made_with(calibration, stream, where)
    if of_stream.matrix.shape != (6, 6) or calibration.matrix.shape != (6, 6):
        raise FormatError(
            f"{where}: expected a matrix and a prior matrix of shape (6, 6), got {calibration.matrix.shape} and "
            f"{of_stream.matrix.shape}; calibrated readings can be corrected only if the matrix that made them is known"
        )
    if not is_invertible(of_stream.matrix):
        raise FitError(f"{where}: expected a prior matrix that can be inverted, got a singular one")
    variables = [(variable.name, variable.unit) for variable in calibration.variables]
    if variables not in ([], [_TEMPERATURE]):
        raise FormatError(
            f"{where}: expected no variable but {_TEMPERATURE[0]!r} in {_TEMPERATURE[1]}, got {variables}; "
            "wholebodydynamics knows no other; use --to coefficients"
        )
    if stream is not None and stream.variables and [(v.name, v.unit) for v in stream.variables] != variables:
        raise FormatError(f"{where}: the stream depends on variables that the calibration does not have; fit with them")
    correction = secondary_model(calibration.model, of_stream)
    return SensorCorrection(
        sensor=calibration.sensor.name if sensor_name is None else sensor_name,
        secondary_matrix=correction.matrix,
        offset=correction.offset,
        temperature_coefficients=correction.coefficients[:, 0] if variables else None,
        reference_temperature=float(correction.reference_values[0]) if variables else None,
    )


def _made_with(calibration: Calibration, stream: Calibration | None, where: str) -> WrenchModel:
    """The model with which the present readings are made."""
    if stream is not None:
        stream.require_serial(calibration.sensor.serial)
        if _corrects_readings(stream) is not _corrects_readings(calibration):
            raise FormatError(
                f"{where}: expected two calibrations of the same readings, but only one of them has the prior "
                f"{_UNKNOWN!r}, which corrects a calibrated stream in place of counts; fit both in one way"
            )
        return stream.model
    if calibration.prior is None:
        raise FormatError(
            f"{where}: expected a matrix and a prior matrix of shape (6, 6), got none; "
            "calibrated readings can be corrected only if the matrix that made them is known"
        )
    return WrenchModel(matrix=calibration.prior.matrix, offset=np.zeros(6))


def _corrects_readings(calibration: Calibration) -> bool:
    """Whether it was fitted to readings that were calibrated with an unknown matrix, not to counts."""
    return calibration.prior is not None and calibration.prior.source == _UNKNOWN


def _require_usable_name(name: str) -> None:
    if not name or not name.isprintable() or _SPLITS_A_NAME.search(name) or _READS_AS_A_VALUE.fullmatch(name):
        raise FormatError(
            f"sensor: expected a name that YARP reads as one word of text, got {name!r}; "
            "the device looks for it in its robot model"
        )


def _finite(values: Any, *, name: str, shape: tuple[int, ...]) -> FloatArray:
    array = read_only(values, name=name, shape=shape)
    if not np.isfinite(array).all():
        raise FormatError(f"{name}: expected finite numbers, got {array[~np.isfinite(array)][0]}")
    return array


class Group(StrEnum):
    """A group, by the name that it has in the file."""

    SECONDARY_CALIBRATION = "FT_SECONDARY_CALIBRATION"
    TEMPERATURE_COEFFICIENTS = "FT_TEMPERATURE_COEFFICIENTS"
    OFFSET = "FT_OFFSET"

    @property
    def length(self) -> int:
        """How many numbers a sensor has in the group."""
        return _LENGTHS[self]


_LENGTHS = {Group.SECONDARY_CALIBRATION: 36, Group.TEMPERATURE_COEFFICIENTS: 7, Group.OFFSET: 6}


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
