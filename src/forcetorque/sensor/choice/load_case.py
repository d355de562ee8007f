# SPDX-License-Identifier: BSD-3-Clause
"""Loads that a sensor is chosen for: a force at a point and a moment, from a file or from options."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, ValidationError, model_validator

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, SensorError
from forcetorque.base.toml_file import Finite, Table, Text, first_error, read_toml
from forcetorque.base.units import parsed_numbers

Three = tuple[Finite, Finite, Finite]

_LEAST, _MOST = 1e-9, 1e12
"""Loads beyond these are errors of the unit, and their squares soon no numbers; N, N m."""
_SHORTEST_M, _LONGEST_M = 1e-3, 1.0
"""Lever below which the moment of a load is negligible, and above which its force is (chosen)."""


class LoadCase(Table):
    """One load on the sensor, in its frame."""

    name: Text
    """Name."""
    force_N: Three = (0.0, 0.0, 0.0)
    """Force; N."""
    lever_m: Three = (0.0, 0.0, 0.0)
    """Point at which the force acts, from the origin of the sensor's frame; m."""
    moment_Nm: Three = (0.0, 0.0, 0.0)
    """Moment beside that of the force; N m."""

    @model_validator(mode="after")
    def _some_load(self) -> LoadCase:
        if not any((*self.force_N, *self.moment_Nm)):
            raise ValueError("expected a force_N or moment_Nm that is not zero")
        with np.errstate(over="ignore", invalid="ignore"):
            largest = float(np.abs(self.wrench).max())
        if not _LEAST <= largest <= _MOST:
            raise ValueError(
                f"expected a load of {_LEAST:g} to {_MOST:g} N or N m in its largest component, got {largest:g}"
            )
        return self

    @property
    def wrench(self) -> FloatArray:
        """What the sensor bears, about the origin of its frame; shape (6,); N, N m."""
        force = np.array(self.force_N)
        return np.concatenate([force, np.array(self.moment_Nm) + np.cross(self.lever_m, force)])


def load_case(name: str, *, force: Three, lever: Three, moment: Three) -> LoadCase:
    """Give a load of numbers that no file has checked.

    Args:
        name: Name.
        force: Force; N.
        lever: Point at which it acts; m.
        moment: Moment beside that of the force; N m.

    Returns:
        The load.

    Raises:
        SensorError: If one is not three finite numbers, or the load none that a sensor could hold.
    """
    try:
        return LoadCase(name=name, force_N=force, lever_m=lever, moment_Nm=moment)
    except ValidationError as error:
        raise SensorError(first_error(error, whole=name)) from error


def considerable_sizes(wrenches: FloatArray) -> tuple[float | None, float | None]:
    """Give the largest force and the largest moment of loads.

    Args:
        wrenches: Loads; shape (n, 6), not all zero; N, N m.

    Returns:
        The norms, N and N m; None for one that is negligible beside the other: a moment below that of the force at
        1 mm, or a force below that of the moment at 1 m.
    """
    force, moment = (float(np.linalg.norm(part, axis=1).max()) for part in (wrenches[:, :3], wrenches[:, 3:]))
    return (
        None if force * _LONGEST_M < moment else force,
        None if moment < force * _SHORTEST_M else moment,
    )


class LoadCaseFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/load_cases/1"] = Field(alias="schema")
    """Form of the file."""
    load: Annotated[tuple[LoadCase, ...], Field(min_length=1)]
    """Loads; the sensor has to hold each of them."""

    @model_validator(mode="after")
    def _names_differ(self) -> LoadCaseFile:
        names = [load.name for load in self.load]
        if len(set(names)) < len(names):
            raise ValueError(f"expected each name of a load once, got {names}")
        return self


def read_load_cases(path: Path | str) -> tuple[LoadCase, ...]:
    """Read the file.

    Args:
        path: TOML file with `[[load]]` tables.

    Returns:
        The loads.
    """
    return read_toml(path, LoadCaseFile, what="a file of loads").load


def three_numbers(option: str, text: str) -> tuple[float, float, float]:
    """Read three numbers between commas.

    Args:
        option: Option that they were typed at, for the message.
        text: Such as `0,0,500`.

    Returns:
        The numbers.

    Raises:
        ForceTorqueError: If there are not three finite numbers.
    """
    numbers = tuple(parsed_numbers(text.split(",")))
    if len(numbers) != 3 or not np.isfinite(numbers).all():
        raise ForceTorqueError(f"{option} {text}: expected three numbers x,y,z with commas between them, as 0,0,500")
    return numbers
