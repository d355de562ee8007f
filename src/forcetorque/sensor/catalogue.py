# SPDX-License-Identifier: BSD-3-Clause
"""Six-axis sensors as the thesis lists them, Tables 1.2, A.1 and A.2 and the text around them, and those of a file."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, SensorError, known_names
from forcetorque.base.toml_file import Positive, Table, Text, read_toml


class Technology(StrEnum):
    """How a sensor senses, as far as it is specified."""

    STRAIN_GAUGE = "strain_gauge"
    SILICON_STRAIN_GAUGE = "silicon_strain_gauge"
    FOIL_STRAIN_GAUGE = "foil_strain_gauge"
    CAPACITIVE = "capacitive"
    OPTICAL = "optical"


class Axes(Table):
    """One number for each group of axes; what is not printed is left out."""

    fxy: Positive
    """Forces along x and y; N."""
    fz: Positive
    """Force along z; N."""
    txy: Positive
    """Moments about x and y; N m."""
    tz: Positive
    """Moment about z; N m."""

    def components(self) -> FloatArray:
        """Give the numbers as those of a wrench.

        Returns:
            fx, fy, fz, tx, ty, tz; shape (6,); N, N m.
        """
        return np.array([self.fxy, self.fxy, self.fz, self.txy, self.txy, self.tz])


class Calibration(Table):
    """One range that a sensor is calibrated for."""

    range: Axes
    """Largest magnitude of each component."""
    has_sign: bool = True
    """Whether the table prints a plus-minus sign; without one it does not say if both directions are meant."""
    resolution: Axes | None = None
    """Smallest step of each component."""


class StatedError(Table):
    """The largest error that is printed, as a share of the range or as force and moment."""

    percent: Positive | None = None
    """Share of the range of each axis; %. Table 1.2 does not print of what; 1.5.1: usually it is the full scale."""
    force_N: Positive | None = None
    """Of each force."""
    moment_Nm: Positive | None = None
    """Of each moment."""

    @model_validator(mode="after")
    def _one_form(self) -> StatedError:
        absolute = (self.force_N is not None, self.moment_Nm is not None)
        if any(absolute) != all(absolute) or any(absolute) == (self.percent is not None):
            raise ValueError("expected percent, or force_N and moment_Nm")
        return self

    def components(self, range_: Axes) -> FloatArray:
        """Give the error of every axis.

        Args:
            range_: Range of the sensor.

        Returns:
            Errors of fx, fy, fz, tx, ty, tz; shape (6,); N, N m.
        """
        if self.percent is not None:
            return 0.01 * self.percent * range_.components()
        return np.repeat([self.force_N or 0.0, self.moment_Nm or 0.0], 3)


class CatalogueSensor(Table):
    """A sensor, with what the thesis prints about it and nothing else."""

    name: Text
    """Model, as printed."""
    maker: Text
    """Company."""
    source: Annotated[tuple[Text, ...], Field(min_length=1)]
    """Tables and sections of the thesis that the figures are from."""
    technology: Technology | None = None
    """How it senses; left out where the table does not say."""
    calibrations: tuple[Calibration, ...] = ()
    """Ranges, the widest first; empty if no range is printed."""
    dimensions: Annotated[tuple[Positive, ...], Field(min_length=2, max_length=2)] | None = None
    """Two dimensions in the order printed; m. The table does not say which is the height; where the text
    gives both, the height comes first."""
    mass: Positive | None = None
    """Mass; kg."""
    bandwidth_hz: Positive | None = None
    """Largest bandwidth; Hz."""
    lowest_gain: Positive | None = None
    """Least gain that its amplifiers can be set to."""
    highest_gain: Positive | None = None
    """Greatest gain that its amplifiers can be set to."""
    accuracy: Text | None = None
    """As printed: makers do not mean the same by it."""
    error: StatedError | None = None
    """The largest error that is printed of this sensor, else that of `accuracy`; left out where only a nonlinearity
    is."""
    nonlinearity: Text | None = None
    """As printed."""
    note: Text | None = None
    """What else is printed, or uncertain."""


class CatalogueFile(Table):
    """A file of sensors."""

    sensor: Annotated[tuple[CatalogueSensor, ...], Field(min_length=1)]
    """Sensors, with different names."""


@cache
def sensor_catalogue() -> tuple[CatalogueSensor, ...]:
    """Give all sensors of the catalogue that comes with the library.

    Returns:
        The sensors, in the order of the tables.

    Raises:
        FormatError: If the catalogue was changed to something else.
    """
    return read_catalogue(Path(__file__).with_name("catalogue.toml"))


def read_catalogue(path: Path | str) -> tuple[CatalogueSensor, ...]:
    """Read a catalogue: a TOML file with one `[[sensor]]` table per sensor.

    Args:
        path: The file.

    Returns:
        The sensors, in the order of the file.

    Raises:
        FormatError: If a table is not a sensor, or two have one name.
    """
    sensors = read_toml(path, CatalogueFile, what="a catalogue of sensors").sensor
    _require_one_each(sensors, str(path))
    return sensors


def catalogue_with(path: Path | str | None) -> tuple[CatalogueSensor, ...]:
    """Give the sensors of a file, then those of the library.

    Args:
        path: The file; None for the library alone.

    Returns:
        All sensors.

    Raises:
        FormatError: If a name of the file is one of the library: two entries of one sensor would be two ranges of it.
    """
    if path is None:
        return sensor_catalogue()
    sensors = (*read_catalogue(path), *sensor_catalogue())
    _require_one_each(sensors, f"{path} and the catalogue of the library")
    return sensors


def _require_one_each(sensors: Sequence[CatalogueSensor], where: str) -> None:
    names = [sensor.name.lower() for sensor in sensors]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise FormatError(f"{where}: expected one sensor per name, got several of {', '.join(twice)}; rename one")


def find_sensor(name: str, among: Sequence[CatalogueSensor] | None = None) -> CatalogueSensor:
    """Look a sensor up by its name.

    Args:
        name: Model, in capital or small letters.
        among: Sensors to look at; the catalogue of the library if left out.

    Returns:
        The sensor.

    Raises:
        SensorError: If there is no such sensor; the message lists those there are.
    """
    sensors = sensor_catalogue() if among is None else among
    for sensor in sensors:
        if sensor.name.lower() == name.lower():
            return sensor
    raise SensorError(f"no sensor {name!r} in the catalogue; {known_names(name, (sensor.name for sensor in sensors))}")
