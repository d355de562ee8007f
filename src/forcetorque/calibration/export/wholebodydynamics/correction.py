# SPDX-License-Identifier: BSD-3-Clause
"""What wholebodydynamics does to the measurements of a sensor: secondary matrix, offset, temperature."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_last_axis
from forcetorque.base.errors import FitError, FormatError, RecordingError, ShapeError
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibration.secondary import secondary_model
from forcetorque.experiment.calibration.sensor_model import WrenchModel, is_invertible

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
