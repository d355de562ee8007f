# SPDX-License-Identifier: BSD-3-Clause
"""A load that was weighed before: what a result of `forcetorque payload` says of it, and how surely."""

from __future__ import annotations

from dataclasses import dataclass
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
_ROUNDING = np.repeat([1e-4, 1e-5, 1e-6], [1, 3, 6])
"""kg, kg m, kg m2: nothing was weighed better. What was stated there, or follows from what was estimated as the inertia
of a point mass does, has a precision by this; one that is much larger hides from the numbers what is told at all."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeighedLoad:
    """A load that was weighed before."""

    load: Load
    """What is known of it."""
    serial: str
    """Serial number of the sensor that weighed it."""
    beside: tuple[str, ...]
    """Loads that were stated when it was weighed, which tell the scale of the sensor; itself if it was stated."""


class _Row(BaseModel):
    model_config = ConfigDict(frozen=True, arbitrary_types_allowed=True)

    load: str
    estimated: bool
    mass_kg: float | None
    link: str | None = None
    inertial: Annotated[FloatArray, ArrayField((INERTIAL,))] | None = None
    covariance: Annotated[FloatArray, ArrayField((INERTIAL, INERTIAL))] | None = None


class _Weighed(BaseModel):
    model_config = ConfigDict(frozen=True)

    serial: str
    loads: tuple[_Row, ...]


def read_weighed(file: Path, name: str, link: str) -> WeighedLoad:
    """Read a load from a result of `forcetorque payload`.

    Args:
        file: JSON file.
        name: Name of the load; if the file has one only, whatever its name.
        link: Link that it hangs on, in whose frame it was weighed.

    Returns:
        The load under this name, and what weighed it.

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
    stated = tuple(one.load for one in weighed.loads if not one.estimated and one.mass_kg)
    return WeighedLoad(load=load, serial=weighed.serial, beside=stated)
