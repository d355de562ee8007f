# SPDX-License-Identifier: BSD-3-Clause
"""What is true of a simulated sensor, as `forcetorque simulate` writes it beside the experiment files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Final, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import FormatError, ShapeError
from forcetorque.base.run_files import declare_input

TRUTH_FILE: Final = "truth.json"
"""Name of the file."""
TRUTH_SCHEMA: Final = "forcetorque/truth/1"
"""Name and version of its form."""


class _Sensor(BaseModel):
    model_config = ConfigDict(defer_build=True, arbitrary_types_allowed=True)

    serial: str
    matrix: Annotated[FloatArray, ArrayField((6, None))]


class _Truth(BaseModel):
    schema_name: Literal["forcetorque/truth/1"] = Field(alias="schema")
    sensors: dict[str, _Sensor]


def true_matrix(experiment: Path, *, sensor: str, serial: str) -> FloatArray | None:
    """Find the true matrix of a sensor.

    Args:
        experiment: Experiment file.
        sensor: Name of the sensor.
        serial: Its serial number.

    Returns:
        The matrix, shape (6, c), N/count, N m/count; None where no truth is beside the file, or none of this sensor.

    Raises:
        FormatError: If the file beside it is not of this form.
    """
    file = experiment.parent / TRUTH_FILE
    if not file.is_file():
        return None
    declare_input(file)
    try:
        truth = _Truth.model_validate(json.loads(file.read_text(encoding="utf-8")))
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError, ShapeError) as error:
        raise FormatError(f"{file}: expected the truth of a simulation, got {error}; remove the file") from error
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(place) for place in first["loc"])
        raise FormatError(f"{file}: {where}: {first['msg']}; the file was changed by hand, remove it") from error
    known = truth.sensors.get(sensor)
    return known.matrix if known is not None and known.serial == serial else None
