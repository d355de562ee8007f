# SPDX-License-Identifier: BSD-3-Clause
"""What errors of force-torque sensors do to a robot that controls its joint torques by them (thesis 5.6)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.slow_noise import half_width
from forcetorque.base.progress import TimeLeft
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.locomotion.oscillation.oscillation import find_oscillations
from forcetorque.locomotion.oscillation.spectrum import resampled
from forcetorque.locomotion.torque_control.balancing_controller import Phase, Reference, standing, switching
from forcetorque.locomotion.torque_control.biped_in_mujoco import SENSORS, Biped
from forcetorque.locomotion.torque_control.closed_loop import (
    LoopRun,
    LoopSetting,
    SensorErrors,
    drawn_matrices,
    run_loop,
)
from forcetorque.locomotion.torque_control.linear_robot import LinearRobot, linear_robot, require_stable
from forcetorque.locomotion.torque_control.torque_loop_file import PERIOD_S, TorqueLoopFile
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, table_of


class TorqueLoopRow(Row):
    """Runs that differ in the draw of E alone."""

    tilt_deg: Annotated[float, Shown("soles", "deg", digits=0)]
    """How far the soles are turned."""
    gain_factor: Annotated[float, Shown("gains", "times", digits=2)]
    """Multiple of the gains of the file."""
    errors: Annotated[str, Shown("errors")]
    """Whose size; `none` without E."""
    scale: Annotated[float, Shown("scale", digits=2)]
    """Multiple of it."""
    force_error_N: Annotated[float, Shown("of weight", "N", digits=1)]
    """Standard deviation of the force error that the weight of the robot then makes on any axis."""
    runs: Annotated[int, Shown("runs")]
    """How many."""
    tracking_rms_Nm: Annotated[float, Shown("tracking", "N m", digits=2, error="tracking_half_width_95_Nm")]
    """Mean over runs of the root mean square of true less desired joint torque, until a fall."""
    tracking_half_width_95_Nm: float | None
    """Half of its 95 % interval over runs; None of a single one."""
    centre_rms_mm: Annotated[float, Shown("CoM off", "mm", digits=1)]
    """Root mean square of how far the centre of mass is from where it should be, until a fall."""
    falls: Annotated[int, Shown("falls")]
    """Runs that fell while the support changed."""
    falls_least_percent: Annotated[float, Shown("at least", "%", digits=0)]
    """Lower end of the 95 % interval of the share that falls (Clopper and Pearson)."""
    falls_most_percent: Annotated[float, Shown("at most", "%", digits=0)]
    """Its upper end."""
    oscillating: Annotated[int, Shown("swings on")]
    """Runs that, standing on the left foot, swing after a push and go on swinging, or fall."""
    oscillating_least_percent: Annotated[float, Shown("at least", "%", digits=0)]
    """Lower end of the 95 % interval of the share that swings on."""
    oscillating_most_percent: Annotated[float, Shown("at most", "%", digits=0)]
    """Its upper end."""
    amplitude_mm: Annotated[float | None, Shown("amplitude", "mm", digits=1)]
    """Median amplitude of the centre of mass where it goes on without a fall; None where none does."""


class TorqueLoopOnsetRow(Row):
    """From which size of E on the linear loop is unstable, over draws of E."""

    tilt_deg: Annotated[float, Shown("soles", "deg", digits=0)]
    """How far the soles are turned."""
    gain_factor: Annotated[float, Shown("gains", "times", digits=2)]
    """Multiple of the gains of the file."""
    errors: Annotated[str, Shown("errors")]
    """Whose size counts as 1."""
    support: Annotated[str, Shown("standing on")]
    """Which feet bear."""
    draws: Annotated[int, Shown("draws")]
    """How many."""
    least_scale: Annotated[float | None, Shown("least", digits=2)]
    """Smallest size of all draws; None where none up to the largest that was looked at is unstable."""
    median_scale: Annotated[float | None, Shown("median", digits=2)]
    """Median; None where it is beyond that."""
    median_force_error_N: Annotated[float | None, Shown("of weight", "N", digits=1)]
    """The median as force error that the weight of the robot makes on any axis."""
    below_one_percent: Annotated[float, Shown("unstable at 1", "%", digits=0)]
    """Share of draws that are unstable at their own size."""
    median_frequency_hz: Annotated[float | None, Shown("frequency", "Hz", digits=2)]
    """Median frequency at which they begin; 0 is a drift away without an oscillation."""
    largest_scale: float
    """Largest multiple that was looked at."""


NO_ERROR: Final = "none"
"""Name of the errors of sensors that read the truth."""
_LARGEST: Final = 20.0
"""Largest multiple of the largest size of E at which the linear loop is looked at."""
_STANDING_S, _SETTLED_S, _PUSH_N = 4.0, 1.0, 20.0
"""How long it stands on the left foot, from when on an oscillation counts, and the push before; s, N."""
_LEAST_SWING_M: Final = 1e-4
"""An oscillation of the centre of mass that is smaller is the trembling that noise of the sensors makes; m."""
_EVERY = 10
"""One of so many instants is looked at for swings: 100 Hz."""
_SUPPORTS: Final = {"both feet": Phase.DOUBLE, "the left foot": Phase.LEFT, "the right foot": Phase.RIGHT}


class TorqueLoopStudy(DrawnResult):
    """A robot that balances by torque control, with errors of its force-torque sensors."""

    answered_by: ClassVar[str | None] = "forcetorque.locomotion.answers:torque_loop_answers"
    drawn_by: ClassVar[str] = "forcetorque.locomotion.figures:torque_loop_figure"

    schema_name: Literal["forcetorque/torque_loop/1"] = Field(default="forcetorque/torque_loop/1", alias="schema")
    """Form of the result."""
    name: str
    """What the file is called."""
    weight_N: float
    """Weight of the robot."""
    duration_s: float
    """How long every run takes: both feet, left, both, right, both."""
    delay_s: float
    """Oldest estimate that a controller uses, less the step in which it is computed."""
    rows: tuple[TorqueLoopRow, ...]
    """One per robot, gains, kind and size of errors."""
    onsets: tuple[TorqueLoopOnsetRow, ...]
    """Where the linear loop becomes unstable."""

    def blocks(self) -> Iterator[Table | str]:
        """Give both tables.

        Yields:
            Tables and a sentence.
        """
        yield table_of(
            self.rows, f"{self.name}: {self.duration_s:.1f} s of changing support; mean ± half its 95 % interval"
        )
        yield table_of(self.onsets, "size of the error from which the linear loop is unstable, by draws of it")
        yield (
            f"an error of scale 1 reads the weight of {self.weight_N:.0f} N wrong on any axis by a random share, whose "
            f"size is that of its name; estimates are {1e3 * self.delay_s:g} ms late"
        )


def study_torque_loop(settings: TorqueLoopFile, progress: Callable[[str], None]) -> TorqueLoopStudy:
    """Let a small biped in MuJoCo change its support under torque control, with errors of its sensors.

    Drives, controllers and rates are settled by the file before any error is drawn, and proven stable without.

    Args:
        settings: What is tried.
        progress: Called with a line for people as work goes on.

    Returns:
        Tracking, oscillations and falls by size of error; and where the linear loop predicts that they begin.
    """
    rng = np.random.default_rng(settings.seed)
    unit = drawn_matrices(1.0, settings.sensor.lever_m, rng, settings.seeds)
    rows: list[TorqueLoopRow] = []
    onsets: list[TorqueLoopOnsetRow] = []
    for tilt_deg in settings.tilt_deg:
        biped = Biped.on_soles(tilt_deg)
        reference = switching(biped, settings.motion, PERIOD_S)
        for gain_factor in settings.gain_factors:
            setting = settings.setting(biped, gain_factor)
            case = _Case(file=settings, biped=biped, setting=setting, reference=reference, gain_factor=gain_factor)
            progress(f"soles at {tilt_deg:g} degrees, gains times {gain_factor:g}: the linear loop")
            robots = case.linear_robots()
            onsets += case.onset_rows(robots, unit)
            rows += case.rows(unit, rng, progress)
    weight_N = biped.mass * STANDARD_GRAVITY
    return TorqueLoopStudy(
        name=settings.name,
        weight_N=weight_N,
        duration_s=settings.motion.duration_s,
        delay_s=settings.estimator.delay_s + 1.0 / settings.estimator.rate_hz - PERIOD_S,
        rows=tuple(rows),
        onsets=tuple(onsets),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Case:
    """One robot with one set of gains."""

    file: TorqueLoopFile
    biped: Biped
    setting: LoopSetting
    reference: Reference
    gain_factor: float

    def linear_robots(self) -> Mapping[str, LinearRobot]:
        """The linear loop on either foot and on both, stable without errors."""
        robots = {}
        for words, phase in _SUPPORTS.items():
            still = standing(self.biped, phase, 2, self.file.motion.lift_m, self.setting.period_s)
            robots[words] = linear_robot(self.biped, self.setting, still, 0)
            require_stable(robots[words])
        return robots

    def onset_rows(self, robots: Mapping[str, LinearRobot], unit: FloatArray) -> Iterator[TorqueLoopOnsetRow]:
        """Where the loop becomes unstable, in sizes of every kind of error."""
        largest = _LARGEST * max(self.file.errors.values())
        weight_N = self.biped.mass * STANDARD_GRAVITY
        for words, robot in robots.items():
            onsets = [robot.onset(matrix, largest=largest) for matrix in unit]
            sizes = np.array([np.inf if one is None else one.scale for one in onsets])
            frequencies = [one.frequency_hz for one in onsets if one is not None]
            for errors, size in self.file.errors.items():
                scales = sizes / size
                median = float(np.median(scales))
                yield TorqueLoopOnsetRow(
                    tilt_deg=self.biped.tilt_deg,
                    gain_factor=self.gain_factor,
                    errors=errors,
                    support=words,
                    draws=len(scales),
                    least_scale=finite_or_none(float(scales.min())),
                    median_scale=finite_or_none(median),
                    median_force_error_N=finite_or_none(median * size * weight_N),
                    below_one_percent=100.0 * float(np.mean(scales < 1.0)),
                    median_frequency_hz=float(np.median(frequencies)) if frequencies else None,
                    largest_scale=largest / size,
                )

    def rows(
        self, unit: FloatArray, rng: np.random.Generator, progress: Callable[[str], None]
    ) -> Iterator[TorqueLoopRow]:
        """Run every size of every kind of error, and the robot without any: all copies at once."""
        sizes = [(NO_ERROR, 0.0, 0.0)]
        sizes += [(name, scale, scale * size) for name, size in self.file.errors.items() for scale in self.file.scales]
        drawn = self._errors(np.concatenate([size * unit for _, _, size in sizes]), rng)
        words = (
            f"soles at {self.biped.tilt_deg:g} degrees, gains times {self.gain_factor:g}, {len(drawn.matrix)} copies"
        )
        progress(f"{words}: changing support")
        left = TimeLeft(progress, f"{words}: changing support", len(self.reference))
        run = run_loop(self.biped, self.setting, self.reference, drawn, rng=rng, progress=left.at)
        steps = round(_STANDING_S / self.setting.period_s)
        still = standing(self.biped, Phase.LEFT, steps, self.file.motion.lift_m, self.setting.period_s)
        progress(f"{words}: pushed on the left foot")
        left = TimeLeft(progress, f"{words}: pushed on the left foot", steps)
        pushed = run_loop(self.biped, self.setting, still, drawn, rng=rng, push_N=_PUSH_N, progress=left.at)
        for k, (errors, scale, size) in enumerate(sizes):
            own = slice(k * len(unit), (k + 1) * len(unit))
            yield self._row(errors, scale, size, run.of(own), pushed.of(own))

    def _errors(self, matrix: FloatArray, rng: np.random.Generator) -> SensorErrors:
        sensor = self.file.sensor
        bias = np.repeat([sensor.bias_N, sensor.bias_Nm], 3) * rng.standard_normal((len(matrix), len(SENSORS), 6))
        return SensorErrors(
            matrix=matrix,
            bias=bias,
            noise=np.repeat([sensor.noise_N, sensor.noise_Nm], 3),
            resolution=np.repeat([sensor.resolution_N, sensor.resolution_Nm], 3),
        )

    def _row(self, errors: str, scale: float, size: float, run: LoopRun, pushed: LoopRun) -> TorqueLoopRow:
        rms = run.tracking_rms
        half = float(half_width(np.array([rms.std(ddof=1) / len(rms) ** 0.5]), np.array([len(rms) - 1.0]))[0])
        fell = run.fallen < len(run.reference)
        amplitudes = _amplitudes(pushed)
        swinging = np.isfinite(amplitudes) | (pushed.fallen < len(pushed.reference))
        falls, swings = (share_interval(int(happened.sum()), len(rms)) for happened in (fell, swinging))
        lasting = amplitudes[np.isfinite(amplitudes)]
        return TorqueLoopRow(
            tilt_deg=self.biped.tilt_deg,
            gain_factor=self.gain_factor,
            errors=errors,
            scale=scale,
            force_error_N=size * self.biped.mass * STANDARD_GRAVITY,
            runs=len(rms),
            tracking_rms_Nm=float(rms.mean()),
            tracking_half_width_95_Nm=finite_or_none(half),
            centre_rms_mm=1e3 * float(np.sqrt(np.nanmean((run.centre_error**2).sum(axis=-1)))),
            falls=int(fell.sum()),
            falls_least_percent=falls[0],
            falls_most_percent=falls[1],
            oscillating=int(swinging.sum()),
            oscillating_least_percent=swings[0],
            oscillating_most_percent=swings[1],
            amplitude_mm=1e3 * float(np.median(lasting)) if len(lasting) else None,
        )


def _amplitudes(pushed: LoopRun) -> FloatArray:
    """Amplitude of the largest swing of the centre of mass that does not die away; NaN of none, or a fall; (B,); m."""
    first, steps = round(_SETTLED_S / pushed.period_s), len(pushed.reference)
    time_s = pushed.period_s * np.arange(first, steps, _EVERY)
    amplitudes = np.full(len(pushed.fallen), np.nan)
    for k, fallen in enumerate(pushed.fallen):
        if fallen < steps:
            continue
        lasting = []
        for axis in (0, 1):
            signal = resampled(time_s, pushed.centre_error[k, first::_EVERY, axis], name="centre of mass")
            lasting += [
                swing.amplitude
                for swing in find_oscillations(signal, name="centre of mass").oscillations
                if swing.amplitude > _LEAST_SWING_M and not swing.damping - swing.half_width[2] > 0.0
            ]
        amplitudes[k] = max(lasting, default=np.nan)
    return amplitudes


def share_interval(count: int, runs: int) -> tuple[float, float]:
    """Give the 95 % interval of a share (Clopper and Pearson).

    Args:
        count: Runs in which it happened.
        runs: All runs.

    Returns:
        Both ends; percent.
    """
    from scipy.special import betaincinv  # here because importing it takes longer than most commands

    low = float(betaincinv(count, runs - count + 1, 0.025)) if count else 0.0
    high = float(betaincinv(count + 1, runs - count, 0.975)) if count < runs else 1.0
    return 100.0 * low, 100.0 * high
