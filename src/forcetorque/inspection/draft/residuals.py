# SPDX-License-Identifier: BSD-3-Clause
"""What the expected wrench leaves of the measured one, by an experiment file as it is and by a change of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import temporary_beside
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison_with_model import Comparison, compared
from forcetorque.inspection.draft.toml_lines import line
from forcetorque.inspection.findings import whole_log_samples
from forcetorque.inspection.plausibility.evidence import Evidence

EXPLAINS: Final = 0.8
"""Part of the residual of force or moment that is left at most by a change that is proposed."""
_WORSENS: Final = 1.2
"""Part of the residual of force or moment that is left at most by any change."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Residual:
    """What the expected wrench leaves of the measured one in intervals in use, the offset taken out."""

    plain: FloatArray
    """Root mean square of force and moment; shape (2,); N, N m."""
    beside_matrix: FloatArray
    """The same beside likely errors of the prior matrix; shape (2,); N, N m."""

    @classmethod
    def of(cls, comparisons: Iterable[Comparison | None]) -> Residual | None:
        """Compute the residual of sensors together.

        Args:
            comparisons: Of each sensor; None where it cannot be compared.

        Returns:
            The residual; None where one cannot be compared, or there is none.
        """
        squares = []
        for comparison in comparisons:
            if comparison is None:
                return None
            sensor = comparison.run.sensor
            seconds = (comparison.at_ns - comparison.at_ns[0]) * 1e-9
            prior = None if sensor.prior_source == "identity" else sensor.prior
            evidence = Evidence.of(comparison.measured, comparison.expected, seconds, prior)
            fit = evidence.fit(comparison.expected)
            squares.append([evidence.left(fit) ** 2, evidence.left(fit, beside_matrix=True) ** 2])
        if not squares:
            return None
        plain, beside = np.sqrt(np.mean(squares, axis=0))
        return cls(plain=plain, beside_matrix=beside)

    def is_worse_than(self, other: Residual) -> bool:
        """Compare with another residual of the same sensors.

        Returns:
            Whether force or moment has clearly more, by the matrix as it is or beside its errors.
        """
        pairs = ((self.plain, other.plain), (self.beside_matrix, other.beside_matrix))
        return any(bool((own > _WORSENS * less).any()) for own, less in pairs)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Improvement:
    """Residuals of a file as it is, and with a change."""

    before: FloatArray
    """Residual force and moment of the file as it is; shape (2,); N, N m."""
    after: FloatArray
    """The same with the change; shape (2,); N, N m."""
    beside_matrix: bool
    """Whether likely errors of the prior matrix are taken out of both."""

    @classmethod
    def between(cls, before: Residual | None, after: Residual | None, most: float = EXPLAINS) -> Improvement | None:
        """Compare the residuals before and after a change.

        Args:
            before: Residual of the file as it is.
            after: Residual with the change.
            most: Part of the residual of force or moment that is left at most.

        Returns:
            Both; None where more of force and moment is left, or clearly more of one than before.
        """
        if before is None or after is None:
            return None
        pairs = [(before.plain, after.plain, False), (before.beside_matrix, after.beside_matrix, True)]
        helps = [
            cls(before=old, after=new, beside_matrix=beside)
            for old, new, beside in pairs
            if (new < most * old).any() and (new < _WORSENS * old).all()
        ]
        return min(helps, key=lambda one: float(np.prod(one.after / one.before)), default=None)

    @property
    def text(self) -> str:
        """Both residuals."""
        beside = " beside errors of the matrix" if self.beside_matrix else ""
        (force, moment), (new_force, new_moment) = self.before, self.after
        return f"residual{beside} {force:.2g} -> {new_force:.2g} N, {moment:.2g} -> {new_moment:.2g} N m"


def experiment_of(file: Path, content: Mapping[str, Any]) -> Experiment | None:
    """Read an experiment file with another content.

    Args:
        file: The file, from whose folder paths count; it stays as it is.
        content: Its tables.

    Returns:
        The experiment; None where it cannot be read.
    """
    with temporary_beside(file) as copy:
        copy.write_text("".join(f"{line(key, value)}\n" for key, value in content.items()), encoding="utf-8")
        try:
            return load_experiment(copy)
        except ForceTorqueError:
            return None


def comparison_of(run: SensorRun, samples_of: SensorRun | None = None) -> Comparison | None:
    """Compare a sensor with the robot model.

    Args:
        run: The sensor.
        samples_of: Run of the same recording whose samples of the whole log are taken; the run itself if None.

    Returns:
        The comparison; None where the sensor cannot be compared.
    """
    correction = run.read_by(None, None).bare
    try:
        return compared(run, correction, whole=whole_log_samples(samples_of or run, correction))
    except ForceTorqueError:
        return None
