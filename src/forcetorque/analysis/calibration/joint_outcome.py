# SPDX-License-Identifier: BSD-3-Clause
"""What a joint calibration says beside the calibrations of its sensors, in tables and in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Self

from pydantic import Field

from forcetorque.analysis.calibration.joint_rows import ModelErrorRow, PartRow, SensorErrorRow, TouchRow
from forcetorque.calibration import Calibration
from forcetorque.calibration.joint import JointFit, JointResult, PartResidual
from forcetorque.result import Row, Table, table_of, with_error

_DOUBTFUL_SHARE = 0.1
"""Force that may be left of an equation, of the weight of its part."""
_LIGHT_KG = 0.5
"""Mass below which noise is too large a share of the weight to say anything."""


class JointOutcome(Row):
    """A joint calibration beside the calibrations of its sensors."""

    file: str | None
    """File with the covariance of all unknowns; None where there is none."""
    sensors: tuple[SensorErrorRow, ...]
    """How far every sensor is to be trusted at the load that it bore."""
    parts: tuple[PartRow, ...]
    """What is left of the equation of every part."""
    model_errors: tuple[ModelErrorRow, ...]
    """What may be wrong with the model, and what was found."""
    touches: tuple[TouchRow, ...]
    """Spans that were left out because they disagree."""
    left_out: tuple[str, ...]
    """Parts that nothing touches, but whose joints were not logged, in words."""
    fit: JointFit = Field(exclude=True, repr=False)
    """The fit."""
    residuals: tuple[PartResidual, ...] = Field(exclude=True, repr=False)
    """What is left of the equations, window by window."""

    @classmethod
    def of(cls, result: JointResult, calibrations: Mapping[str, Calibration], file: str | None) -> Self:
        """Sum up a joint calibration.

        Args:
            result: The fit and what was left out.
            calibrations: Calibrations by the names of their sensors.
            file: File for the covariance of all unknowns.

        Returns:
            The same for people and files.
        """
        return cls(
            file=file,
            sensors=tuple(
                SensorErrorRow.of(name, calibration.posterior)
                for name, calibration in calibrations.items()
                if calibration.posterior is not None
            ),
            parts=tuple(PartRow.of(one) for one in result.residuals if one.kept.any()),
            model_errors=tuple(ModelErrorRow.of(*error) for error in result.fit.model_errors()),
            touches=tuple(map(TouchRow.of, result.touches)),
            left_out=result.left_out,
            fit=result.fit,
            residuals=result.residuals,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read of it.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.sensors, "predicted error at the mean load of these recordings, one s.d.")
        yield table_of(self.parts, "what is left of the equation of every part, root mean square")
        if learnt := [row for row in self.model_errors if row.learnt or row.is_far]:
            yield table_of(learnt, "what the recordings tell of the model, ± one s.d.")
        if self.touches:
            yield table_of(self.touches, "left out, because the part's equation does not hold: touched, or a knock")
        yield from self.left_out

    def doubts(self) -> Iterator[str]:
        """Say what makes the calibrations doubtful.

        Yields:
            Sentences.
        """
        yield from _open_loads(self.sensors)
        yield from _far_errors(self.model_errors)
        for interval, rows in groupby(self.parts, key=lambda row: row.interval):
            yield from _disagreeing(interval, [row for row in rows if row.mass_kg > _LIGHT_KG])


def _open_loads(sensors: Sequence[SensorErrorRow]) -> Iterator[str]:
    advice = (
        "add a recording in which that load changes by a known weight: squat, sway with tilts, lift the feet in turn, "
        "with all joints of torso and arms logged, or stand on one foot"
    )
    if unknown := [row for row in sensors if not row.gain_known]:
        words = ", ".join(f"{row.sensor} (± {row.gain_error_after_percent:.1f} %)" for row in unknown)
        yield f"stance gain not determined: {words} of the weight that they bear, mostly by their priors; {advice}"
    if unknown := [row for row in sensors if not row.offset_known]:
        words = ", ".join(f"{row.sensor} (± {row.error_with_offset_N:.0f} N of {row.load_N:.0f} N)" for row in unknown)
        yield f"offset not determined: {words}; only changes of load are known, or {advice}"


def _far_errors(errors: Sequence[ModelErrorRow]) -> Iterator[str]:
    for row in errors:
        if row.is_far:
            unit = f" {row.unit}" if row.unit else ""
            yield (
                f"{row.name}: off by {with_error(row.value, row.deviation, digits=4)}{unit}, where the model is "
                f"trusted to {row.prior_deviation:.2g}{unit}; look at the robot model"
            )


def _disagreeing(interval: str, rows: Sequence[PartRow]) -> Iterator[str]:
    far = [row for row in rows if row.share_of_weight > _DOUBTFUL_SHARE]
    if not far:
        return
    words = ", ".join(f"{row.part} ({row.force_after_N:.1f} N of {row.weight_N:.0f} N)" for row in far)
    if 2 * len(far) > len(rows) > 1:
        yield (
            f"interval {interval!r}: forces of most parts do not agree with their motion: {words}. Gravity and motion "
            f"come from {rows[0].root_link}: is the IMU on that link, with those axes, or does it stand still there?"
        )
    else:
        yield (
            f"interval {interval!r}: forces of these parts do not agree with their motion, others' do: {words}. "
            "Something touches them that the file does not name, or their joints or masses are not those of the model"
        )
