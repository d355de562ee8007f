# SPDX-License-Identifier: BSD-3-Clause
"""Errors of a calibration on the validation intervals of recordings, from stored moments and means over seconds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.paired_comparison import SquaredErrors
from forcetorque.base.noise.window_means import joined_times, mean_error
from forcetorque.evaluation.load_cases.validation_evidence import SecondMeans
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.fleet.sensor_record import SensorRecord
from forcetorque.fleet.stored_validation_data import StoredEvaluation


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BlockErrors:
    """Errors of one calibration in the b blocks of one recording."""

    samples: IntArray
    """Samples of every block; shape (b,)."""
    mean: FloatArray
    """Mean errors; shape (b, 6); N, N m."""
    variance: FloatArray
    """Mean squares about them; shape (b, 6); N2, N2 m2."""

    @classmethod
    def of(cls, stored: StoredEvaluation, correction: Correction) -> Self:
        """Compute the errors of a linear calibration.

        Args:
            stored: The recording.
            correction: How the sensor is read.

        Returns:
            Its errors.
        """
        names = {one.session: one.session_names for one in stored.sessions}
        sessions = {one.label: one.session for one in stored.intervals}
        rows = {session: _error_rows(stored, correction.in_session(own)) for session, own in names.items()}
        matrices, offsets = zip(*(rows[sessions[block.interval]] for block in stored.blocks), strict=True)
        matrix, mean = np.array(matrices), np.array([block.mean for block in stored.blocks])
        second = np.array([block.second_moment for block in stored.blocks])
        return cls(
            samples=np.array([block.samples for block in stored.blocks]),
            mean=np.einsum("bij,bj->bi", matrix, mean) + np.array(offsets),
            variance=np.maximum(np.einsum("bij,bij->bi", matrix @ second, matrix), 0.0),
        )

    def without_mean(self) -> BlockErrors:
        """Take the mean error of the recording off.

        Returns:
            The errors with the offset of the evaluated samples themselves.
        """
        return BlockErrors(
            samples=self.samples,
            mean=self.mean - np.average(self.mean, axis=0, weights=self.samples),
            variance=self.variance,
        )

    @property
    def squares(self) -> FloatArray:
        """Sums of squared errors; shape (b, 6); N2, N2 m2."""
        return self.samples[:, None] * (self.variance + self.mean**2)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BlockPair:
    """Errors of a calibration and its prior in one recording."""

    first: BlockErrors
    """Of the calibration."""
    second: BlockErrors
    """Of the prior."""

    @property
    def samples(self) -> int:
        """Number of samples."""
        return int(self.first.samples.sum())

    def of_quantity(self, axes: slice) -> SquaredErrors:
        """Sum up squared errors.

        Args:
            axes: Components, of force or of moment.

        Returns:
            Sums over the blocks, of the calibration and of the prior.
        """
        sums = np.stack([errors.squares[:, axes].sum(axis=1) for errors in (self.first, self.second)])
        return SquaredErrors(ends=np.cumsum(self.first.samples), sums=sums)


@dataclass(frozen=True, slots=True, kw_only=True)
class LargerError:
    """Error of a calibration that blocks find larger than that of its prior."""

    quantity: Literal["force", "moment"]
    """What the error is of."""
    unit: Literal["N", "N m"]
    """Its unit."""
    mean: float
    """Root mean square of its norm."""
    prior_mean: float
    """The same of the prior."""


def _error_rows(stored: StoredEvaluation, correction: Correction) -> tuple[FloatArray, FloatArray]:
    """What turns means of raw channels, variables and expected wrench into a mean error: rows (6, m), offset (6,)."""
    model, known = correction.model, [variable.name for variable in stored.sensor.variables]
    coefficients = np.zeros((6, len(known)))
    coefficients[:, [known.index(name) for name in correction.variables]] = model.coefficients
    offset = model.offset - model.coefficients @ model.reference_values
    return np.hstack([model.matrix, coefficients, -np.eye(6)]), offset


def second_means(record: SensorRecord, name: str, correction: Correction) -> list[SecondMeans]:
    """Compute the errors of a linear calibration in means over seconds.

    Args:
        record: The recording, with a validation interval.
        name: Name of the session where the file names none.
        correction: How the sensor is read.

    Returns:
        The errors in every session.
    """
    stored, made = evaluation_of(record), []
    for means in stored.sessions:
        rows, offset = _error_rows(stored, correction.in_session(means.session_names))
        variables = means.variables if means.variables.size else np.zeros((len(means.time_s), 0))
        error = np.hstack([means.raw, variables, means.reference]) @ rows.T + offset
        made.append(
            SecondMeans(session=means.session or name, time_s=means.time_s, error=error, reference=means.reference)
        )
    return made


def evaluation_of(record: SensorRecord) -> StoredEvaluation:
    """Give what is kept of the validation intervals of a recording.

    Args:
        record: The recording.

    Returns:
        What is kept.

    Raises:
        ExperimentError: If it has no validation interval.
    """
    if record.evaluation is None:
        raise ExperimentError(f'{record.file}: expected an interval with use = "validation", got none')
    return record.evaluation


def error_interval(means: Sequence[SecondMeans], axes: slice, *, tared: bool) -> tuple[float, float, float]:
    """Compute the root mean square of the norm of an error, in means over seconds.

    Args:
        means: Errors of one calibration in every session of all recordings.
        axes: Components, of force or of moment.
        tared: Whether the mean error of every session is taken off.

    Returns:
        The root mean square and the ends of its 95 % interval, the upper infinite where too few data determine it; N or
        N m.
    """
    errors = [one.error[:, axes] - (one.error[:, axes].mean(axis=0) if tared else 0.0) for one in means]
    square = np.concatenate([(error**2).sum(axis=1) for error in errors])
    width = float(mean_error(square[:, None], joined_times([one.time_s for one in means])).half_width[0])
    mean, width = float(square.mean()), width if np.isfinite(width) else np.inf
    return mean**0.5, max(mean - width, 0.0) ** 0.5, (mean + width) ** 0.5
