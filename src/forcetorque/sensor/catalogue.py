# SPDX-License-Identifier: BSD-3-Clause
"""Six-axis sensors as the thesis lists them: Tables 1.2, A.1 and A.2, and the text around them."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from enum import StrEnum
from functools import cache
from importlib import resources
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from forcetorque.base.errors import FormatError, SensorError, known_names
from forcetorque.base.validation_text import first_error

_Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False, strict=True)]
_Text = Annotated[str, Field(min_length=1)]


class Technology(StrEnum):
    """How a sensor senses, as far as it is specified."""

    STRAIN_GAUGE = "strain_gauge"
    SILICON_STRAIN_GAUGE = "silicon_strain_gauge"
    FOIL_STRAIN_GAUGE = "foil_strain_gauge"
    CAPACITIVE = "capacitive"
    OPTICAL = "optical"


class _Record(BaseModel):
    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True)


class Axes(_Record):
    """One number for each group of axes; what is not printed is left out."""

    fxy: _Positive
    """Forces along x and y; N."""
    fz: _Positive
    """Force along z; N."""
    txy: _Positive
    """Moments about x and y; N m."""
    tz: _Positive
    """Moment about z; N m."""


class Calibration(_Record):
    """One range that a sensor is calibrated for."""

    range: Axes
    """Largest magnitude of each component."""
    has_sign: bool = True
    """Whether the table prints a plus-minus sign; without one it does not say if both directions are meant."""
    resolution: Axes | None = None
    """Smallest step of each component."""


class CatalogueSensor(_Record):
    """A sensor, with what the thesis prints about it and nothing else."""

    name: _Text
    """Model, as printed."""
    maker: _Text
    """Company."""
    source: Annotated[tuple[_Text, ...], Field(min_length=1)]
    """Tables and sections of the thesis that the figures are from."""
    technology: Technology | None = None
    """How it senses; left out where the table does not say."""
    calibrations: tuple[Calibration, ...] = ()
    """Ranges, the widest first; empty if no range is printed."""
    dimensions: Annotated[tuple[_Positive, ...], Field(min_length=2, max_length=2)] | None = None
    """Two dimensions in the order printed; m. The table does not say which is the height; where the text
    gives both, the height comes first."""
    mass: _Positive | None = None
    """Mass; kg."""
    bandwidth_hz: _Positive | None = None
    """Largest bandwidth; Hz."""
    lowest_gain: _Positive | None = None
    """Least gain that its amplifiers can be set to."""
    highest_gain: _Positive | None = None
    """Greatest gain that its amplifiers can be set to."""
    accuracy: _Text | None = None
    """As printed: makers do not mean the same by it."""
    nonlinearity: _Text | None = None
    """As printed."""
    note: _Text | None = None
    """What else is printed, or uncertain."""


@cache
def sensor_catalogue() -> tuple[CatalogueSensor, ...]:
    """Give all sensors of the catalogue.

    Returns:
        The sensors, in the order of the tables.

    Raises:
        FormatError: If the catalogue that came with the library was changed to something else.
    """
    text = resources.files(__package__).joinpath("catalogue.toml").read_text(encoding="utf-8")
    return read_catalogue(text)


def read_catalogue(text: str) -> tuple[CatalogueSensor, ...]:
    """Read a catalogue: a TOML text with one `[[sensor]]` table per sensor.

    Args:
        text: The text.

    Returns:
        The sensors, in the order of the text.

    Raises:
        FormatError: If the text is no TOML, a table is not a sensor, or two have one name.
    """
    try:
        tables = tomllib.loads(text).get("sensor", [])
        sensors = tuple(CatalogueSensor.model_validate(table) for table in tables)
    except tomllib.TOMLDecodeError as error:
        raise FormatError(f"catalogue of sensors: {error}") from error
    except ValidationError as error:
        raise FormatError(f"catalogue of sensors: {first_error(error)}") from error
    names = [sensor.name.lower() for sensor in sensors]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise FormatError(f"catalogue of sensors: expected one sensor per name, got several of {', '.join(twice)}")
    return sensors


def find_sensor(name: str) -> CatalogueSensor:
    """Look a sensor up by its name.

    Args:
        name: Model, in capital or small letters.

    Returns:
        The sensor.

    Raises:
        SensorError: If the catalogue has no such sensor; the message lists those it has.
    """
    for sensor in sensor_catalogue():
        if sensor.name.lower() == name.lower():
            return sensor
    raise SensorError(
        f"no sensor {name!r} in the catalogue; {known_names(name, (sensor.name for sensor in sensor_catalogue()))}"
    )


def sensors_with_range(
    *,
    fxy: float = 0.0,
    fz: float = 0.0,
    txy: float = 0.0,
    tz: float = 0.0,
    among: Iterable[CatalogueSensor] | None = None,
) -> tuple[CatalogueSensor, ...]:
    """Find the sensors with a calibration that covers given loads, component by component.

    Ranges hold for one component at a time; a sensor that covers each may still saturate under all.

    Args:
        fxy: Largest force along x or y; N.
        fz: Largest force along z; N.
        txy: Largest moment about x or y; N m.
        tz: Largest moment about z; N m.
        among: Sensors to look at; the whole catalogue if left out.

    Returns:
        The sensors, those with the narrowest such range first (by the force along z, then the others).
    """
    wanted = (fz, fxy, txy, tz)
    suitable = []
    for sensor in sensor_catalogue() if among is None else among:
        ranges = [(c.range.fz, c.range.fxy, c.range.txy, c.range.tz) for c in sensor.calibrations]
        wide = [range_ for range_ in ranges if all(has >= needs for has, needs in zip(range_, wanted, strict=True))]
        if wide:
            suitable.append((min(wide), sensor))
    return tuple(sensor for _, sensor in sorted(suitable, key=lambda pair: pair[0]))
