# SPDX-License-Identifier: BSD-3-Clause
"""One of the calibrations that a study compares."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from forcetorque.arrays import FloatArray
from forcetorque.calibration import GENERATIVE, EstimationType, Posterior, WrenchModel
from forcetorque.study.lambdas import TABLE_FACTOR, lambda_text


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Candidate:
    """A fit of one data set, estimation type and lambda."""

    data_set: str
    """Name of the combination of calibration intervals."""
    kind: EstimationType
    """Estimation type."""
    lambda_counts2: float
    """Lambda of (5.4), as `calibrate` counts it; counts2."""
    relative_lambda: float
    """The same over the mean variance of the raw channels; 1."""
    determined: bool
    """Whether data or prior determine it: not so at lambda 0 where the loads leave a direction unexcited."""
    model: WrenchModel
    """The fitted model."""

    @property
    def type(self) -> str:
        """Name of the estimation type."""
        return self.kind.name

    @property
    def table_lambda(self) -> float:
        """Lambda as the tables of the thesis count it, a sixth; counts2."""
        return self.lambda_counts2 / TABLE_FACTOR

    @property
    def name(self) -> str:
        """Data set, type and lambda of (5.4)."""
        return f"{self.data_set} {self.kind.name} lambda {lambda_text(self.lambda_counts2)}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GenerativeCandidate:
    """The generative fit of one data set: it has no type of the thesis and no lambda."""

    data_set: str
    """Name of the combination of calibration intervals."""
    model: WrenchModel
    """The fitted model, with the offset of the last session."""
    offsets: Mapping[str, FloatArray]
    """Offset of every fitted session; shape (6,); N, N m."""
    squared_error: FloatArray
    """Mean squared error on the fitted samples, each with the offset of its session; shape (6,); N2, (N m)2."""
    posterior: Posterior
    """What the fit knows, from which the error of any reading follows."""

    @property
    def type(self) -> str:
        """What stands in the place of an estimation type."""
        return GENERATIVE

    @property
    def name(self) -> str:
        """Data set and type."""
        return f"{self.data_set} {self.type}"

    @property
    def determined(self) -> bool:
        """Whether it may be chosen: a fit that nothing determines is refused."""
        return True
