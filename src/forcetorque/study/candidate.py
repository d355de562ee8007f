# SPDX-License-Identifier: BSD-3-Clause
"""One of the calibrations that a study compares."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.calibration import EstimationType, WrenchModel
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
    def table_lambda(self) -> float:
        """Lambda as the tables of the thesis count it, a sixth; counts2."""
        return self.lambda_counts2 / TABLE_FACTOR

    @property
    def name(self) -> str:
        """Data set, type and lambda of (5.4)."""
        return f"{self.data_set} {self.kind.name} lambda {lambda_text(self.lambda_counts2)}"
