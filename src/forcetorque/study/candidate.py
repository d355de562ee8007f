# SPDX-License-Identifier: BSD-3-Clause
"""One of the calibrations that a study compares, and the lambdas of a sweep."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.experiment.calibration.artefact import GENERATIVE
from forcetorque.experiment.calibration.estimation_type import EstimationType
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.sensor_model import WrenchModel

TABLE_LAMBDAS: Final = (
    0.0, 1.0, 5.0, 10.0, 50.0, 100.0, 1000.0, 5000.0, 10000.0, 50000.0, 100000.0, 500000.0, 1000000.0,
)  # fmt: skip
"""The thirteen lambdas of thesis Tables 5.5 and 5.6, as printed there; counts2."""

TABLE_FACTOR: Final = 6.0
"""Lambda of equation (5.4) per lambda of the tables: their program took the mean over the six axes too."""

SWEEP_LAMBDAS: Final = tuple(TABLE_FACTOR * value for value in TABLE_LAMBDAS)
"""The same thirteen as equation (5.4) has them, which is how `calibrate` counts; counts2."""

CONVENTION: Final = "thesis (5.4): mean squared residual norm + lambda |C - C_prior|^2"
"""How every lambda is counted, unless it is called one of the tables; unit counts2."""


def relative_lambda(regularisation: float, moments: Moments) -> float:
    """Express a lambda in the scale of the sensor's own readings, so that sensors can be compared.

    Args:
        regularisation: Lambda of (5.4); counts2.
        moments: Moments of the fitted samples.

    Returns:
        Lambda over the mean variance of the raw channels; 1.

    Raises:
        FitError: If no raw channel ever changes.
    """
    variance = float(moments.raw_raw.trace()) / moments.channels
    if not variance > 0.0:
        raise FitError("raw readings: expected some that change, all channels hold one value; the sensor was not read")
    return regularisation / variance


def lambda_text(regularisation: float) -> str:
    """Write a lambda in full, 1000000 and not 1e+06.

    Args:
        regularisation: Lambda; counts2.

    Returns:
        All its digits that a person would type.
    """
    return f"{regularisation:.12g}"


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
