# SPDX-License-Identifier: BSD-3-Clause
"""The result of a joint calibration: errors of sensors, residuals, errors of the robot model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Annotated, Self

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.joint.robust_fit import JointResult, PartResidual
from forcetorque.calibration.joint.unknowns import JointFit
from forcetorque.calibration.joint.windows import WINDOW_S
from forcetorque.experiment.calibration.calibration_file import CalibratedVariable, Calibration
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import JointPosterior, place_in_urdf
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm
from forcetorque.results.number_text import with_error
from forcetorque.results.table import Row, Shown, Table, optional_table, table_of

_GAIN_PERCENT = 3.0
"""Error of a gain from which it counts as not determined: as large as that of the masses that tell it."""
_SMALL_GAIN_PERCENT = 1.0
"""Error of a gain up to which it need not be told by the recordings."""
_OFFSET_SHARE, _OFFSET_N = 0.1, 5.0
"""Error of the load itself from which an offset counts as not determined: a share of the load, and the least of it."""
_KNOWN = 0.5
"""Share of the uncertainty before below which a gain or an error of the model counts as told by the recordings."""
_FAR = 3.0
"""Standard deviations from which an error of the model is a finding: by chance one in 400 is as far."""
_TOLD = 0.2
"""Share of the variance that recordings must have told of an error before it can be a finding."""


class SensorErrorRow(Row):
    """How far one sensor is to be trusted at the load that it bore."""

    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    load_N: Annotated[float, Shown("mean load", "N", digits=1)]
    """Magnitude of its mean force in the fitted windows."""
    error_before_N: Annotated[float, Shown("force error before", "N", digits=2)]
    """Predicted standard deviation of the force error of that load by the prior matrix, offset known."""
    error_after_N: Annotated[float, Shown("after", "N", digits=2)]
    """The same by the calibration."""
    gain_error_before_percent: Annotated[float, Shown("gain error before", "%", digits=2)]
    """Predicted standard deviation of the error along the load, of its magnitude, by the prior matrix."""
    gain_error_after_percent: Annotated[float, Shown("after", "%", digits=2)]
    """The same by the calibration."""

    error_with_offset_N: Annotated[float, Shown("with its offset", "N", digits=2)]
    """The same, of the load itself and not of a change, by the calibration with the offset of its last session."""

    @property
    def gain_known(self) -> bool:
        """Whether it is known what the sensor makes of the weight that it bears."""
        after = self.gain_error_after_percent
        told = after < max(_KNOWN * self.gain_error_before_percent, _SMALL_GAIN_PERCENT)
        return told and after < _GAIN_PERCENT

    @property
    def offset_known(self) -> bool:
        """Whether the load itself can be read, and not only its changes."""
        return self.error_with_offset_N < max(_OFFSET_SHARE * self.load_N, _OFFSET_N)

    @classmethod
    def of(cls, sensor: str, posterior: Posterior, variables: FloatArray) -> Self:
        """Predict the errors of a sensor.

        Args:
            sensor: Its name.
            posterior: What is known of it, with a prior.
            variables: Its variables in the middle of the recordings, less their reference values; shape (v,).

        Returns:
            The row.
        """
        load = posterior.load_centre
        size = max(float(np.linalg.norm(load[:3])), np.finfo(float).tiny)
        along = load[:3] / size
        prior = posterior.prior_error_covariance(load)
        after = posterior.error_covariance(load)[:3, :3]
        before = after if prior is None else prior[:3, :3]
        absolute = posterior.error_covariance(load, variables=variables, session=posterior.sessions[-1])[:3, :3]
        gains = [100.0 * float(np.sqrt(along @ one @ along)) / size for one in (before, after)]
        return cls(
            sensor=sensor,
            load_N=size,
            error_before_N=float(np.sqrt(np.trace(before))),
            error_after_N=float(np.sqrt(np.trace(after))),
            gain_error_before_percent=gains[0],
            gain_error_after_percent=gains[1],
            error_with_offset_N=float(np.sqrt(np.trace(absolute))),
        )


class SubModelRow(Row):
    """What is left of the equation of one part in one interval: root mean square over the windows that were fitted."""

    sub_model: Annotated[str, Shown("sub-model")]
    """Name of the part: the sensor at its base, or the link whose motion is known."""
    sensors: tuple[str, ...]
    """Its sensors."""
    root_link: str
    """Link whose motion is known, and about whose origin moments are."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    windows: Annotated[int, Shown("windows")]
    """Windows that were fitted."""
    left_out: Annotated[int, Shown("left out")]
    """Windows that disagree with the others."""
    mass_kg: Annotated[float, Shown("mass", "kg", digits=2)]
    """Mass of its bodies."""
    force_before_N: Annotated[float, Shown("force before", "N", digits=2)]
    """Sensors less what moves the bodies, by the prior matrices and the best offsets."""
    force_after_N: Annotated[float, Shown("after", "N", digits=2)]
    """The same by the calibrations."""
    moment_before_Nm: Annotated[float | None, Shown("moment before", "N m", digits=3)]
    """Moments about the root link, by the prior matrices and the best offsets; None where only weight counts."""
    moment_after_Nm: Annotated[float | None, Shown("after", "N m", digits=3)]
    """The same by the calibrations."""

    @property
    def share_of_weight(self) -> float:
        """Force that is left, over the weight of the bodies."""
        return self.force_after_N / max(self.weight_N, np.finfo(float).tiny)

    @property
    def weight_N(self) -> float:
        """Weight of the bodies."""
        return STANDARD_GRAVITY * self.mass_kg

    @classmethod
    def of(cls, residual: PartResidual) -> Self:
        """Sum up what is left of an equation.

        Args:
            residual: What is left, window by window.

        Returns:
            The row.
        """
        kept, with_moments = residual.kept, bool(residual.rows.all())
        sizes = [
            float(np.sqrt((values[kept][:, part] ** 2).sum(axis=1).mean()))
            for part in FORCE_AND_MOMENT
            for values in (residual.before, residual.after)
        ]
        return cls(
            sub_model=residual.part,
            sensors=residual.sensors,
            root_link=residual.root_link,
            interval=residual.label,
            windows=int(np.count_nonzero(kept)),
            left_out=int(np.count_nonzero(~kept)),
            mass_kg=residual.mass_kg,
            force_before_N=sizes[0],
            force_after_N=sizes[1],
            moment_before_Nm=sizes[2] if with_moments else None,
            moment_after_Nm=sizes[3] if with_moments else None,
        )


class ModelErrorRow(Row):
    """One number that the robot model or the IMU may have wrong."""

    name: Annotated[str, Shown("error of the model")]
    """What it is, such as `mass of l_upper_leg`."""
    unit: Annotated[str, Shown("unit")]
    """Its unit; empty for a share."""
    value: Annotated[float, Shown("found", digits=4, error="deviation")]
    """What is to be added to what the model says."""
    deviation: float
    """Its standard deviation."""
    prior_deviation: Annotated[float, Shown("tolerance", digits=4)]
    """Standard deviation before any data."""

    @property
    def learnt(self) -> bool:
        """Whether the recordings tell most of it."""
        return self.deviation < _KNOWN * self.prior_deviation

    @property
    def is_far(self) -> bool:
        """Whether it is farther from what the model says than it would be by chance, and the recordings tell it."""
        found_variance = (
            self.prior_deviation**2 - self.deviation**2
        )  # variance of what is found, if the tolerance is right
        return found_variance > _TOLD * self.prior_deviation**2 and self.value**2 > _FAR**2 * found_variance

    @property
    def is_wide(self) -> bool:
        """Whether evidence finds errors of its kind so large that even what the recordings leave is far above it."""
        return self.deviation > _FAR * self.prior_deviation

    @classmethod
    def of(cls, term: ErrorTerm, value: float, deviation: float) -> Self:
        """Hold an error of the model.

        Args:
            term: What it is.
            value: What was found.
            deviation: Its standard deviation.

        Returns:
            The row.
        """
        return cls(name=term.name, unit=term.unit, value=value, deviation=deviation, prior_deviation=term.deviation)


class ContactSpanRow(Row):
    """A span of time that was left out because a part's equation does not hold."""

    sub_model: Annotated[str, Shown("sub-model")]
    """Name of the part."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    start_s: Annotated[float, Shown("from", "s", digits=2)]
    """Start; s on the clock of the recording."""
    end_s: Annotated[float, Shown("to", "s", digits=2)]
    """End; s."""

    @classmethod
    def all_of(cls, residual: PartResidual) -> Iterator[Self]:
        """List the spans of a part that were left out of a fit.

        Args:
            residual: What is left of its equation.

        Yields:
            Windows that follow each other, each from its start to its end.
        """
        edges = np.flatnonzero(np.diff(np.r_[True, residual.kept, True].astype(int)))
        for start, end in zip(edges[::2], edges[1::2], strict=True):
            yield cls(
                sub_model=residual.part,
                interval=residual.label,
                start_s=float(residual.time_s[start]) - 0.5 * WINDOW_S,
                end_s=float(residual.time_s[end - 1]) + 0.5 * WINDOW_S,
            )


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
    sub_models: tuple[SubModelRow, ...]
    """What is left of the equation of every part."""
    model_errors: tuple[ModelErrorRow, ...]
    """What may be wrong with the model, and what was found."""
    contacts: tuple[ContactSpanRow, ...]
    """Spans that were left out because they disagree."""
    left_out: tuple[str, ...]
    """Parts that nothing touches, but whose joints were not logged, in words."""
    without_windows: tuple[str, ...]
    """Parts and intervals that never have all that they need at a time, in words."""
    fit: JointFit = Field(exclude=True, repr=False)
    """The fit."""
    posterior: JointPosterior | None = Field(exclude=True, repr=False)
    """What the file holds."""
    residuals: tuple[PartResidual, ...] = Field(exclude=True, repr=False)
    """What is left of the equations, window by window."""

    @classmethod
    def of(
        cls,
        result: JointResult,
        calibrations: Mapping[str, Calibration],
        file: str | None = None,
        posterior: JointPosterior | None = None,
    ) -> Self:
        """Sum up a joint calibration.

        Args:
            result: The fit and what was left out.
            calibrations: Calibrations by the names of their sensors.
            file: File for the covariance of all unknowns.
            posterior: What it is to hold.

        Returns:
            The same for people and files.
        """
        return cls(
            file=file,
            sensors=tuple(
                SensorErrorRow.of(name, calibration.posterior, _middle(calibration.variables))
                for name, calibration in calibrations.items()
                if calibration.posterior is not None
            ),
            sub_models=tuple(SubModelRow.of(one) for one in result.residuals if one.kept.any()),
            model_errors=tuple(ModelErrorRow.of(*error) for error in result.fit.model_errors()),
            contacts=tuple(span for one in result.residuals for span in ContactSpanRow.all_of(one)),
            left_out=result.left_out,
            without_windows=result.without_windows,
            fit=result.fit,
            posterior=posterior,
            residuals=result.residuals,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read of it.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.sensors, "predicted error at the mean load of these recordings, one s.d.")
        yield table_of(self.sub_models, "what is left of the equation of every part, root mean square")
        if learnt := [row for row in self.model_errors if row.learnt or row.is_far]:
            yield table_of(learnt, "what the recordings tell of the model, ± one s.d.")
        yield from optional_table(
            self.contacts, "left out, because the part's equation does not hold: touched, or a knock"
        )
        yield from self.left_out

    def doubts(self, urdf: Path | None = None) -> Iterator[str]:
        """Say what makes the calibrations doubtful.

        Args:
            urdf: File of the robot model, whose lines are named; None where there is none.

        Yields:
            Sentences.
        """
        yield from self.without_windows
        yield from _open_loads(self.sensors)
        yield from _far_errors(self.model_errors, urdf)
        yield from _wide_errors(self.model_errors, [row.root_link for row in self.sub_models])
        for interval, rows in groupby(self.sub_models, key=lambda row: row.interval):
            yield from _disagreeing(interval, [row for row in rows if row.mass_kg > _LIGHT_KG])


def _middle(variables: Sequence[CalibratedVariable]) -> FloatArray:
    return np.array([0.5 * (one.minimum + one.maximum) - one.reference_value for one in variables])


def _open_loads(sensors: Sequence[SensorErrorRow]) -> Iterator[str]:
    advice = (
        "add a recording in which that load changes by a known weight: squat, sway with tilts, lift the feet in turn, "
        "with all joints of torso and arms logged, or stand on one foot"
    )
    if unknown := [row for row in sensors if not row.gain_known]:
        unknown.sort(key=lambda row: row.gain_error_after_percent < _GAIN_PERCENT)  # those beyond the limit first
        words = ", ".join(f"{row.sensor} (± {row.gain_error_after_percent:.1f} %)" for row in unknown)
        yield f"stance gain not determined: {words} of the weight that they bear, mostly by their priors; {advice}"
    if unknown := [row for row in sensors if not row.offset_known]:
        words = ", ".join(f"{row.sensor} (± {row.error_with_offset_N:.0f} N of {row.load_N:.0f} N)" for row in unknown)
        yield f"offset not determined: {words}; only changes of load are known, or {advice}"


def _far_errors(errors: Sequence[ModelErrorRow], urdf: Path | None) -> Iterator[str]:
    for row in errors:
        if row.is_far:
            unit = f" {row.unit}" if row.unit else ""
            yield (
                f"{row.name}: off by {with_error(row.value, row.deviation, digits=4)}{unit}, where the model is "
                f"trusted to {row.prior_deviation:.2g}{unit}; look at the robot "
                f"model{place_in_urdf(urdf, row.name)}"
            )


def _wide_errors(errors: Sequence[ModelErrorRow], roots: Sequence[str]) -> Iterator[str]:
    wide = [row for row in errors if row.is_wide]
    if wide:
        units = dict.fromkeys(row.unit for row in wide)
        kinds = ", ".join(_kind(unit, [row for row in wide if row.unit == unit]) for unit in units)
        yield (
            f"errors of the robot model are by evidence far above their tolerances: {kinds}. "
            f"The model, or the motion, is not that of the robot. {_imu_question(roots)}"
        )


_KINDS = {"": "mass", "m": "centre of mass", "rad": "joint zero", "m/s2": "acceleration", "s": "delay"}
"""What a number of the model is, by its unit."""


def _kind(unit: str, rows: Sequence[ModelErrorRow]) -> str:
    worst = max(rows, key=lambda row: row.deviation / row.prior_deviation)
    times = f"{worst.deviation / worst.prior_deviation:.0f} times"
    return (
        f"{worst.name} {times}" if len(rows) == 1 else f"{len(rows)} numbers of the kind {_KINDS[unit]} up to {times}"
    )


def _imu_question(roots: Sequence[str]) -> str:
    links = " and ".join(dict.fromkeys(roots))
    return (
        f"Gravity and motion come from {links}: is the IMU on that link, with those axes, or does it stand still there?"
    )


def _disagreeing(interval: str, rows: Sequence[SubModelRow]) -> Iterator[str]:
    far = [row for row in rows if row.share_of_weight > _DOUBTFUL_SHARE]
    if not far:
        return
    words = ", ".join(f"{row.sub_model} ({row.force_after_N:.1f} N of {row.weight_N:.0f} N)" for row in far)
    if 2 * len(far) > len(rows) > 1:
        yield (
            f"interval {interval!r}: forces of most parts do not agree with their motion: {words}. "
            f"{_imu_question([rows[0].root_link])}"
        )
    else:
        yield (
            f"interval {interval!r}: forces of these parts do not agree with their motion, others' do: {words}. "
            "Something touches them that the file does not name, or their joints or masses are not those of the model"
        )
