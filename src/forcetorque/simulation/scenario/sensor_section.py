# SPDX-License-Identifier: BSD-3-Clause
"""What every sensor of a scenario is made of, and how its workbench matrix errs."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text


class WorkbenchError(Table):
    """How much the workbench matrix of one mounted sensor errs; the other sensors stay as they are drawn.

    Means of the absolute error over all recordings with `use = "validation"`, on the true loads, with an offset
    for each recording that leaves no mean error. What mounting does to the sensor is scaled to that.
    """

    sensor: Text
    """The sensor."""
    mean_force_N: Annotated[tuple[NotNegative, ...], Field(min_length=3, max_length=3)]
    """Of f_x, f_y and f_z; N."""
    mean_moment_Nm: Annotated[tuple[NotNegative, ...], Field(min_length=3, max_length=3)]
    """Of tau_x, tau_y and tau_z; N m."""

    @property
    def mean_absolute(self) -> tuple[float, ...]:
        """All six; N, N m."""
        return self.mean_force_N + self.mean_moment_Nm


class MatrixErrorSize(Table):
    """How wrong the workbench matrix of every mounted sensor is, in place of all that mounting does.

    It reads a true wrench w as `(1 + E) w`; E is drawn for each sensor, and has this size for each.
    """

    share: Annotated[float, Field(ge=0.0, lt=1.0, strict=True)]
    """Root mean square of the coefficients of E, moments over the lever taken for forces."""
    lever_m: Positive = 0.07
    """Moment over force, about that of the mean errors in thesis Table 5.7; m."""


class Sensors(Table):
    """What every sensor is made of; figures of the spread between sensors are standard deviations."""

    seed: Annotated[int, Field(ge=0, strict=True)] | None = None
    """Seed of the sensors, of their offsets and noise; that of the scenario, which also moves the robot, if left
    out."""
    names: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    """Sensors of the robot; all if left out."""
    family: Text = "standard"
    """Family that specimens are drawn from."""
    noise_counts: NotNegative = 3.0
    """White noise; counts."""
    noise_corner_hz: NotNegative = 0.0
    """Frequency below which 1/f noise prevails."""
    offset_counts: NotNegative = 3000.0
    """Spread of the offset of a channel between sensors."""
    power_up_counts: NotNegative = 100.0
    """Spread of its change from one power-up to the next."""
    drift_counts_per_degC: NotNegative = 0.0
    """Spread of the linear drift with temperature."""
    gradient_counts_per_degC: NotNegative = 0.0
    """Spread of the part with the difference between gauges."""
    hysteresis_counts_per_degC: NotNegative = 0.0
    """Spread of the part with hysteresis."""
    reference_degC: Finite = 25.0
    """Temperature without drift."""
    creep_share: Finite = 0.0
    """What creep adds in the end, relative to the load."""
    creep_time_s: Positive = 30.0
    """Time constant of creep."""
    crosstalk_counts: NotNegative = 0.0
    """Spread of the quadratic response at full scale."""
    screw_torque_Nm: Annotated[tuple[NotNegative, ...], Field(min_length=3)] = (2.0,) * 6
    """Torques of the screws around the rim, evenly spaced from the x axis on."""
    mounting_strength: NotNegative = 0.0
    """Relative change of an in-plane channel where the rim is tighter by 2 N m; even screws change nothing."""
    mounting_spread: NotNegative = 0.0
    """Random change of each coefficient that mounting adds, relative to its row."""
    step_counts: NotNegative = 1.0
    """Step of the converter; 0 for none."""
    limit_counts: Annotated[int, Field(gt=0, strict=True)] = 32767
    """Magnitude at which a channel is saturated."""
    workbench_error: WorkbenchError | None = None
    """How much the workbench matrix of one sensor errs; as it is drawn if left out."""
    matrix_error: MatrixErrorSize | None = None
    """Size of the error of every workbench matrix; what mounting makes of it if left out."""

    @model_validator(mode="after")
    def _one_error_of_the_matrix(self) -> Sensors:
        if self.matrix_error is not None and (
            self.mounting_spread or self.mounting_strength or self.workbench_error is not None
        ):
            raise PydanticCustomError(
                "matrix_error",
                "matrix_error stands for all that mounting does; leave it out, or mounting_spread, mounting_strength "
                "and workbench_error",
            )
        return self


LINEAR_ONLY: Mapping[str, Any] = MappingProxyType(
    {
        "limit_counts": 10_000_000,
        "gradient_counts_per_degC": 0.0,
        "hysteresis_counts_per_degC": 0.0,
        "creep_share": 0.0,
        "crosstalk_counts": 0.0,
    }
)
"""Changes of `Sensors` after which a matrix, an offset per power-up and a coefficient of the temperature tell all but
noise: nothing saturates, lags, creeps or is quadratic. Matrices, offsets and linear drift are drawn as without them."""


UNDISTURBED: Mapping[str, Any] = MappingProxyType(
    {**LINEAR_ONLY, "noise_counts": 0.0, "step_counts": 0.0, "drift_counts_per_degC": 0.0}
)
"""Changes of `Sensors` after which a matrix and an offset per power-up tell all."""
