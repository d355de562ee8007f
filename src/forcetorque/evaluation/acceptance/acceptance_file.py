# SPDX-License-Identifier: BSD-3-Clause
"""The acceptance file: what a sensor must reach. Every number is a limit; what is left out is not evaluated."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self, get_args

from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from forcetorque.base.toml_file import Positive, Table, Text, read_toml
from forcetorque.evaluation.section import LoadCaseTable
from forcetorque.experiment.free_sub_model import OtherSensors

Component = Literal["fx", "fy", "fz", "tx", "ty", "tz"]
_COMPONENTS: tuple[Component, ...] = get_args(Component)

_NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False, strict=True)]
_Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False, strict=True)]


def _by_component(value: Any) -> Any:
    if not isinstance(value, list):
        return value
    if len(value) != len(_COMPONENTS):
        raise ValueError(f"expected six numbers, {' '.join(_COMPONENTS)}, or a table such as {{ fz = 2.0 }}")
    return dict(zip(_COMPONENTS, value, strict=True))


_NUMBER = {"type": "number", "minimum": 0}
PerAxis = Annotated[
    dict[Component, _NotNegative],
    BeforeValidator(_by_component),
    Field(min_length=1),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "array", "items": _NUMBER, "minItems": 6, "maxItems": 6},
                {
                    "type": "object",
                    "properties": dict.fromkeys(_COMPONENTS, _NUMBER),
                    "additionalProperties": False,
                    "minProperties": 1,
                },
            ]
        }
    ),
]
"""One limit per component, N and N m: six numbers fx fy fz tx ty tz, or a table with some of them by name."""


def _refuse_old_word(instead: str) -> BeforeValidator:
    """Refuse the word that older files have for either of two offsets."""

    def refuse(value: Any) -> Any:
        if value == "re-estimated":
            raise ValueError(f"this word meant two different offsets; write {instead}")
        return value

    return BeforeValidator(refuse)


_ErrorOffset = Annotated[
    Literal["fitted", "judged-mean"], _refuse_old_word('"judged-mean" for the mean of the validation samples')
]
_ContactOffset = Annotated[
    Literal["first-second", "fitted"], _refuse_old_word('"first-second" for that of the first second of every interval')
]


class _Limits(Table):
    """A table of limits; one without any would look like a criterion that holds."""

    settings: ClassVar[frozenset[str]] = frozenset()
    """Keys that are no limits."""

    @model_validator(mode="after")
    def _states_a_limit(self) -> Self:
        limits = [field for field in type(self).model_fields if field not in self.settings]
        if all(getattr(self, field) is None for field in limits):
            raise ValueError(f"expected at least one limit: {', '.join(sorted(limits))}")
        return self


class Evaluate(_Limits):
    """Errors on the validation intervals, as `forcetorque evaluate` has them; at most."""

    settings: ClassVar[frozenset[str]] = frozenset({"offset"})
    offset: _ErrorOffset = "fitted"
    """Offset of the fitted data, or the mean of the evaluated samples."""
    force_error_mean_N: _NotNegative | None = None
    """Mean norm of the force error."""
    force_error_largest_N: _NotNegative | None = None
    """Largest norm of the force error."""
    moment_error_mean_Nm: _NotNegative | None = None
    """Mean norm of the moment error."""
    moment_error_largest_Nm: _NotNegative | None = None
    """Largest norm of the moment error."""
    rmse: PerAxis | None = None
    """Root mean square error."""
    bias: PerAxis | None = None
    """Magnitude of the mean error."""
    largest: PerAxis | None = None
    """Largest absolute error."""


class Improvement(_Limits):
    """Errors of the calibration over those of its prior, on the validation intervals; at most."""

    settings: ClassVar[frozenset[str]] = frozenset({"offset"})
    offset: _ErrorOffset = "fitted"
    """Offset of the fitted data, or the mean of the evaluated samples."""
    force_error_ratio: _NotNegative | None = None
    """Ratio of the mean norms of the force error."""
    moment_error_ratio: _NotNegative | None = None
    """Ratio of the mean norms of the moment error."""


class Validate(_Limits):
    """Contact wrench where nothing touches, as `forcetorque study validate` has it; at most."""

    settings: ClassVar[frozenset[str]] = frozenset({"offset", "other_sensors"})
    offset: _ContactOffset = "first-second"
    """Offset from the first second of every validation interval, or that of the candidate."""
    other_sensors: Literal["model", "measured"] = OtherSensors.MODEL.value
    """What the other sensors of the part read: what the model expects, or what they measured."""
    force_mean_N: _NotNegative | None = None
    """Mean norm of the force."""
    moment_mean_Nm: _NotNegative | None = None
    """Mean norm of the moment."""
    mean_absolute: PerAxis | None = None
    """Mean absolute value."""


class Matrix(_Limits):
    """The matrix by itself."""

    condition: Positive | None = None
    """Condition of the matrix with its rows over the full scale; at most."""
    full_scale: PerAxis | None = None
    """Load that is reached in both directions before a channel saturates, offset included; at least."""
    resolution_worst: PerAxis | None = None
    """Change of a component when all channels are off by one count with the worst signs; at most."""
    resolution_rms: PerAxis | None = None
    """The same when they err by themselves; at most."""


class Population(_Limits):
    """The matrix among those of other serial numbers (`--population`)."""

    robust_z: _NotNegative | None = None
    """Magnitude of the robust z-score of the most unusual feature; at most."""
    quantiles: tuple[_Share, _Share] | None = None
    """Lowest and highest quantile at which any feature may stand."""
    at_least_sensors: Annotated[int, Field(ge=1, strict=True)] | None = None
    """Number of other sensors; at least."""

    @model_validator(mode="after")
    def _in_order(self) -> Population:
        if self.quantiles is not None and self.quantiles[0] >= self.quantiles[1]:
            raise ValueError("quantiles: expected the lower one first")
        return self


class RecordingLimits(_Limits):
    """What the log lacks, by the worst of the intervals that are not ignored; at most."""

    saturated_share: _Share | None = None
    """Share of samples that were held or at the limit."""
    missing_share: _Share | None = None
    """Share of samples without a reading."""
    lost_share: _Share | None = None
    """Share of messages that were lost by their sequence numbers."""


class OffsetLimits(_Limits):
    """How the offset changes between the intervals; what a fitted temperature explains is not in it; at most."""

    change: PerAxis | None = None
    """Largest less smallest offset."""
    force_change_N: _NotNegative | None = None
    """Largest norm of the difference of two offsets."""
    per_degree: PerAxis | None = None
    """Magnitude of the slope against temperature; per degC."""


class Uncertainty(_Limits):
    """Standard errors of the calibration; at most."""

    matrix_relative: _NotNegative | None = None
    """Standard error of a row of the matrix over the row, both as norms; the largest of six."""
    offset: PerAxis | None = None
    """Standard error of the offset."""


class Excitation(_Limits):
    """What the fitted data moved."""

    directions: Annotated[int, Field(ge=1, strict=True)] | None = None
    """Directions of the raw readings that loads moved more than anything else; at least."""
    condition: Positive | None = None
    """Largest over smallest deviation over the raw directions; at most."""


class InformationGainLimits(_Limits):
    """By how much the recordings made the uncertainty of loads along each direction narrower, 0 to 1; at least."""

    fx: _Share | None = None
    """Forces along x."""
    fy: _Share | None = None
    """Forces along y."""
    fz: _Share | None = None
    """Forces along z."""
    tx: _Share | None = None
    """Moments about x."""
    ty: _Share | None = None
    """Moments about y."""
    tz: _Share | None = None
    """Moments about z."""


class WorkbenchLimits(_Limits):
    """Known loads on a workbench (`forcetorque bench workbench --spec`)."""

    held_out: PerAxis | None = None
    """Root mean square error of positions that are left out one by one; at most."""
    rank: Annotated[int, Field(ge=1, le=6, strict=True)] | None = None
    """Directions of load that the positions move; at least."""
    faults: Annotated[int, Field(ge=0, strict=True)] | None = None
    """Faults of the bench that are seen; at most."""
    invalid_blocks: Annotated[int, Field(ge=0, strict=True)] | None = None
    """Blocks with findings; at most."""


class AcceptanceFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/acceptance/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the specification."""
    evaluate: Evaluate | None = None
    """Errors on data that was not fitted."""
    improvement: Improvement | None = None
    """The same over those of the prior."""
    validate_: Validate | None = Field(default=None, alias="validate")
    """Contact wrench where nothing touches."""
    matrix: Matrix | None = None
    """The matrix by itself."""
    population: Population | None = None
    """The matrix among others."""
    recording: RecordingLimits | None = None
    """What the log lacks."""
    offset: OffsetLimits | None = None
    """How the offset changes."""
    uncertainty: Uncertainty | None = None
    """Standard errors."""
    excitation: Excitation | None = None
    """What the data moved, in raw directions."""
    information_gain: InformationGainLimits | None = None
    """What the data taught of loads; for calibrations of the generative model."""
    workbench: WorkbenchLimits | None = None
    """Known loads on a workbench, which `accept` does not judge."""
    load_case: tuple[LoadCaseTable, ...] = ()
    """What the sensor is to be used for: the verdict on each must be `use`."""

    @model_validator(mode="after")
    def _states_something(self) -> AcceptanceFile:
        tables = [key for key in type(self).model_fields if key not in {"schema_name", "name"}]
        if all(not getattr(self, key) for key in tables):
            known = ", ".join(sorted(key.rstrip("_") for key in tables))
            raise ValueError(f"expected at least one table of limits: {known}")
        return self


def read_acceptance(path: Path | str) -> AcceptanceFile:
    """Read an acceptance file.

    Args:
        path: TOML file.

    Returns:
        Its content.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not TOML, or a key is unknown, missing or has a wrong value.
    """
    return read_toml(path, AcceptanceFile, what="an acceptance file")
