# SPDX-License-Identifier: BSD-3-Clause
"""The `[calibration]` section of the experiment file: how sensors are fitted."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from pydantic import (
    BeforeValidator,
    Field,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from forcetorque.base.errors import known_names
from forcetorque.base.toml_file import NotNegative, Table, Text
from forcetorque.experiment.calibration.artefact import GENERATIVE
from forcetorque.experiment.calibration.assumptions import REPEATABILITY
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, OffsetStrategy
from forcetorque.experiment.experiment import FitOptions


def _lambda(value: Any) -> Any:
    if isinstance(value, str) and value != "held-out":
        raise PydanticCustomError("lambda_word", "expected a number of at least 0 counts2 or `held-out`")
    return None if value == "held-out" else value


class Accuracy(Table):
    """Standard deviation of what neither model nor averaging takes away."""

    force_N: NotNegative
    """Of every force; N."""
    moment_Nm: NotNegative
    """Of every moment; N m."""


class CalibrationTable(Table):
    """How the sensor is fitted: by the generative model, or by a type of the thesis where one is asked for."""

    accuracy: Accuracy | None = None
    """Accuracy of the reference; 1e-3 of full scale if left out."""
    repeatability: Annotated[float, Field(ge=0.0, lt=1.0, strict=True)] = REPEATABILITY
    """Share of its response by which the sensor differs from one motion to the next (creep, hysteresis)."""
    drift: bool = False
    """Whether the offset of a session may move evenly in time."""
    nonlinear: bool = False
    """Whether quadratic terms may correct readings; they do where they win on recordings that were not fitted."""

    lambda_counts2: Annotated[
        Annotated[float, Field(ge=0.0, strict=True)] | None,
        BeforeValidator(_lambda),
        WithJsonSchema({"anyOf": [{"type": "number", "minimum": 0}, {"const": "held-out"}]}),
    ] = None
    """Lambda in the convention of thesis (5.4); `held-out` to choose it on held-out blocks."""
    type: Annotated[str, Field(json_schema_extra={"enum": [GENERATIVE, *ESTIMATION_TYPES]})] | None = None
    """`generative`, the default, or an estimation type by its name in the thesis, such as OwTrTO; in place of the next
    three, any of which stands for a thesis' type too, as does lambda."""
    offset: OffsetStrategy | None = None
    """How the offset is found: one-shot, the default, gives the same as centralised; sphere needs a grid motion."""
    with_variables: bool | None = None
    """Whether the variables of the sensors are fitted; by default where there are any."""
    from_reference: bool | None = None
    """Whether variables count from their reference value, the default, or from zero."""
    sphere_intervals: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """Labels of the grid motions that give the offset of the sphere types; may be left out if there is one interval."""

    @model_validator(mode="after")
    def _by_name_or_by_options(self) -> CalibrationTable:
        plain = (self.offset, self.with_variables, self.from_reference)
        if self.type is not None and any(option is not None for option in plain):
            raise PydanticCustomError(
                "type_twice", "type stands for offset, with_variables and from_reference; give the one or the others"
            )
        types = (GENERATIVE, *ESTIMATION_TYPES)
        if self.type is not None and self.type not in types:
            message = f"no estimation type is called {self.type!r}; {known_names(self.type, types)}"
            raise PydanticCustomError("type_name", "{message}", {"message": message})
        if self.with_variables is False and self.from_reference:
            raise PydanticCustomError("no_variables", "from_reference belongs to with_variables = true")
        if self.type == GENERATIVE and "lambda_counts2" in self.model_fields_set:
            raise PydanticCustomError("generative_lambda", "the generative model has no lambda; leave it out")
        if self.nonlinear and not self.generative:
            raise PydanticCustomError(
                "linear_type", "nonlinear belongs to the generative model; leave it out, or type, offset and lambda"
            )
        return self

    @property
    def generative(self) -> bool:
        """Whether the generative model is asked for: nothing of a thesis' type is."""
        of_thesis = {"lambda_counts2", "offset", "from_reference"} & self.model_fields_set
        return self.type == GENERATIVE or (self.type is None and not of_thesis)


def fit_options(table: CalibrationTable) -> FitOptions:
    """Settle the estimator.

    Args:
        table: What the file says.

    Returns:
        The estimator, as far as the file settles it.
    """
    if table.type in ESTIMATION_TYPES:
        kind = ESTIMATION_TYPES[table.type]
        return FitOptions(
            generative=False,
            offset=kind.offset,
            with_variables=kind.with_variables,
            from_reference=kind.from_reference,
            regularisation=table.lambda_counts2,
        )
    accuracy = table.accuracy
    return FitOptions(
        generative=table.generative,
        accuracy=None if accuracy is None else np.repeat([accuracy.force_N, accuracy.moment_Nm], 3),
        repeatability=table.repeatability,
        drift=table.drift,
        nonlinear=table.nonlinear,
        offset=table.offset or OffsetStrategy.ONE_SHOT,
        with_variables=table.with_variables,
        from_reference=table.from_reference,
        regularisation=table.lambda_counts2,
    )
