# SPDX-License-Identifier: BSD-3-Clause
"""A load that was weighed before: what a result of `forcetorque payload` says of it, and how surely."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.errors import ExperimentError, FormatError, known_names
from forcetorque.loads import Load
from forcetorque.loads.load import INERTIAL
from forcetorque.part import read_json

SCHEMA = "forcetorque/payload/2"
"""Form of the results that are read."""
_ROUNDING = np.repeat([1e-6, 1e-7, 1e-8], [1, 3, 6])
"""kg, kg m, kg m2: nothing was weighed better, so that what was stated there has a precision."""


class _Row(BaseModel):
    model_config = ConfigDict(frozen=True, arbitrary_types_allowed=True)

    load: str
    link: str | None = None
    inertial: Annotated[FloatArray, ArrayField((INERTIAL,))] | None = None
    covariance: Annotated[FloatArray, ArrayField((INERTIAL, INERTIAL))] | None = None


class _Weighed(BaseModel):
    model_config = ConfigDict(frozen=True)

    serial: str
    loads: tuple[_Row, ...]


def read_weighed(file: Path, name: str, link: str) -> tuple[Load, str]:
    """Read a load from a result of `forcetorque payload`.

    Args:
        file: JSON file.
        name: Name of the load; if the file has one only, whatever its name.
        link: Link that it hangs on, in whose frame it was weighed.

    Returns:
        The load under this name, and the serial number of the sensor that weighed it.

    Raises:
        FormatError: If it is no such result.
        ExperimentError: If it has no such load, or leaves it open, or weighed it in another frame.
    """
    content = read_json(file, expected="a result of `forcetorque payload FILE --format json`, there is none")
    if not isinstance(content, dict) or content.get("schema") != SCHEMA:
        raise FormatError(f"{file}: expected a result of `forcetorque payload FILE --format json`, schema {SCHEMA!r}")
    try:
        weighed = _Weighed.model_validate(content)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise FormatError(f"{file}: {place}: {first['msg']}") from error
    names = [row.load for row in weighed.loads]
    if name not in names and len(names) != 1:
        raise ExperimentError(f"{file}: no load {name!r}; {known_names(name, names)}")
    row = weighed.loads[names.index(name) if name in names else 0]
    if row.link is None:
        raise ExperimentError(
            f"{file}: expected a load that was weighed on a link of a robot, got {row.load!r} in the frame of a "
            "sensor; state mass_kg and centre_of_mass_m in the frame of the link"
        )
    if row.link != link:
        raise ExperimentError(f"{file}: expected a load on the link {link!r}, got {row.load!r} on {row.link!r}")
    if row.inertial is None or row.covariance is None:
        raise ExperimentError(f"{file}: the load {row.load!r} was left open there; weigh it again, or state mass_kg")
    covariance = row.covariance + np.diag(_ROUNDING**2)
    if not np.array_equal(covariance, covariance.T) or np.linalg.eigvalsh(covariance)[0] <= 0.0:
        raise FormatError(f"{file}: loads: covariance: expected a symmetric positive matrix of {row.load!r}")
    load = Load(
        name=name,
        inertia="unknown",
        expected=row.inertial,
        precision=np.asarray(np.linalg.inv(covariance), dtype=np.float64),
    )
    return load, weighed.serial
