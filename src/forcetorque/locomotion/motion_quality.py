# SPDX-License-Identifier: BSD-3-Clause
"""How a robot moves: whether it oscillates, how long it takes to settle, how well it tracks (thesis 8.3)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.errors import ExperimentError, RecordingError
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.locomotion.logged_signals import MotionSignal
from forcetorque.locomotion.oscillation.oscillation import OscillationSearch, find_oscillations
from forcetorque.locomotion.oscillation.settling import (
    SettlingRow,
    TrackingRow,
    command_steps,
    settlings,
    tracking_error,
)
from forcetorque.locomotion.oscillation.spectrum import ResampledSignal, resampled
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import FloatOrNull, Row, Shown, Table, Values, optional_table, table_of


class OscillationRow(Row):
    """One oscillation of a column, or that it has none; half-widths are of 95 % intervals."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    column: Annotated[str, Shown("column")]
    """Name of the column; `A - B` is a tracking error."""
    oscillates: Annotated[bool, Shown("oscillates")]
    """Whether an oscillation stands out of the noise; if not, numbers of it are null."""
    frequency_hz: Annotated[float | None, Shown("frequency", "Hz", digits=4, error="frequency_half_width_95_hz")]
    """Its frequency."""
    frequency_half_width_95_hz: float | None
    """Half-width of that."""
    amplitude: Annotated[float | None, Shown("amplitude", digits=5, error="amplitude_half_width_95")]
    """Half of peak to peak of a steady oscillation with its mean square, in `unit`."""
    amplitude_half_width_95: float | None
    """Half-width of that."""
    unit: Annotated[str, Shown("unit")]
    """Unit of the column."""
    damping: Annotated[float | None, Shown("damping", digits=4, error="damping_half_width_95")]
    """Damping ratio; about 0 of an oscillation that stays, below 0 of one that grows; null of one that does not keep
    its phase."""
    damping_half_width_95: float | None
    """Half-width of that."""
    phase_kept_s: Annotated[float | None, Shown("phase kept", "s", digits=1)]
    """Time over which it keeps its phase: that of the interval, or of a part of it."""
    seen_amplitude: Annotated[FloatOrNull, Shown("seen from", digits=5)]
    """Amplitude from which on a further steady swing of that frequency would be seen in 95 % of such records; where
    nothing oscillates, one of any frequency that was looked at."""
    seen_amplitude_middle: float
    """The same at the geometric middle of the frequencies that were looked at: slow drift hides slow oscillations
    most."""
    lowest_hz: float
    """Lowest frequency that was looked at."""
    highest_hz: float
    """Highest frequency that was looked at."""
    samples: int
    """Samples of the interval."""
    duration_s: float
    """How long it lasts."""


class MotionCurve(Row):
    """A column with its oscillations, for the figure."""

    title: str
    """Interval and column."""
    unit: str
    """Unit of the column."""
    time_s: Values
    """Instants; shape (n,); s."""
    values: Values
    """The column; shape (n,)."""
    swing: Values | None
    """Mean, trend and all oscillations; shape (n,); null where it does not oscillate."""


BAND_SHARE = 0.05
"""Half of the band of settling over the step."""
NEAR_LIMIT = 1.25
"""Times the amplitude that would be seen below which an amplitude is doubted: a smaller one is only seen when noise
adds to it."""


class Motion(DrawnResult):
    """What columns of a motion do."""

    drawn_by: ClassVar[str] = "forcetorque.locomotion.figures:motion_figure"
    answered_by: ClassVar[str | None] = "forcetorque.locomotion.answers:motion_answers"

    schema_name: Literal["forcetorque/motion/1"] = Field(default="forcetorque/motion/1", alias="schema")
    """Form of the result."""
    oscillations: tuple[OscillationRow, ...]
    """Oscillations of every interval and column, the largest first; one row that says so where there is none."""
    settling: tuple[SettlingRow, ...]
    """A row for every step."""
    tracking: tuple[TrackingRow, ...]
    """A row for every column of which something was wanted."""
    band_percent: float
    """Half of the band of settling, of the step."""
    curves: tuple[MotionCurve, ...] = Field(default=(), exclude=True, repr=False)
    """Columns with their oscillations, for the figure."""

    def blocks(self) -> Iterator[Table | str]:
        """Give tables of oscillations, settling times and tracking errors.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.oscillations, "oscillations; ±: half a 95 % interval")
        for row in self.oscillations:
            if not row.oscillates:
                middle_hz = math.sqrt(row.lowest_hz * row.highest_hz)
                yield (
                    f"{row.interval}: {row.column}: no oscillation from {row.lowest_hz:.3g} to {row.highest_hz:.4g} "
                    f"Hz; a steady one of {row.seen_amplitude:.3g} {row.unit} or more would be seen, at "
                    f"{middle_hz:.2g} Hz one of {row.seen_amplitude_middle:.2g} {row.unit}"
                )
        yield from optional_table(
            self.settling, f"after steps: when it stays within {self.band_percent:g} % of the step; 95 % intervals"
        )
        yield from optional_table(self.tracking, "tracking errors; 95 % intervals that count how long errors go on")

    def records(self) -> list[dict[str, object]]:
        """Give oscillations, settling times and tracking errors as flat lines.

        Returns:
            One line per row, with its kind.
        """
        kinds = (("oscillation", self.oscillations), ("settling", self.settling), ("tracking", self.tracking))
        return [{"kind": kind, **row.flat()} for kind, rows in kinds for row in rows]


@with_recording_notes
def motion(signals: Sequence[MotionSignal], *, steps_s: Sequence[float] = (), band_share: float = BAND_SHARE) -> Motion:
    """Analyse the motion of columns: `motion(motion_signals("walk.toml", ["com.y"]))`.

    Of a column of which something was wanted the difference is looked at too: a command that swings is no oscillation
    of the robot.

    Args:
        signals: Columns, of a log (`motion_signals`) or of arrays (`motion_signals_of_arrays`).
        steps_s: Instants of steps, from the start of the recording; those of what was wanted, where that goes in steps,
            if none is named; s.
        band_share: Half of the band of settling over the step.

    Returns:
        Oscillations, which may be none, settling times and tracking errors, all with intervals.

    Raises:
        ExperimentError: If there is no signal, or a step lies in no interval.
        RecordingError: If a column never changes, or is too short for a period.
    """
    if not signals:
        raise ExperimentError("expected a column at least, got none")
    if not 0.0 < band_share < 1.0:
        raise ExperimentError(f"band: expected more than 0 and less than 100 % of the step, got {100 * band_share:g} %")
    for step in steps_s:
        if not any(len(one.time_s) and one.time_s[0] <= step <= one.time_s[-1] for one in signals):
            raise ExperimentError(
                f"step at {step:g} s: expected an instant within an interval, from the first sample on"
            )
    analysed = [_SignalMotion.of(signal, sorted(steps_s), band_share) for signal in signals]
    return Motion(
        oscillations=tuple(row for column in analysed for row in column.oscillations),
        settling=tuple(row for column in analysed for row in column.settling),
        tracking=tuple(column.tracking for column in analysed if column.tracking is not None),
        band_percent=100.0 * band_share,
        curves=tuple(curve for column in analysed for curve in column.curves),
        warnings=(
            *dict.fromkeys(warning for column in analysed for warning in column.warnings),
            *dict.fromkeys(sentence for signal in signals for sentence in signal.added),
        ),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _SignalMotion:
    """What one signal does."""

    oscillations: tuple[OscillationRow, ...]
    settling: tuple[SettlingRow, ...]
    tracking: TrackingRow | None
    curves: tuple[MotionCurve, ...]
    warnings: tuple[str, ...]

    @classmethod
    def of(cls, signal: MotionSignal, steps_s: Sequence[float], band_share: float) -> _SignalMotion:
        own = resampled(signal.time_s, signal.values, name=signal.name)
        searched = [(signal.column, own, find_oscillations(own, name=signal.name))]
        desired = signal.desired_values
        if desired is not None:
            error = signal.values - desired
            if np.nanmax(error, initial=-math.inf) > np.nanmin(error, initial=math.inf):
                name = f"{signal.column} - {signal.desired}"
                left = resampled(signal.time_s, error, name=f"{signal.interval}: {name}")
                searched.append((name, left, find_oscillations(left, name=f"{signal.interval}: {name}")))
        settling, refused = _settled(signal, own, steps_s, band_share)
        return cls(
            oscillations=tuple(
                row for name, even, search in searched for row in _oscillation_rows(signal, name, even, search)
            ),
            settling=tuple(settling),
            tracking=None if desired is None else tracking_error(signal),
            curves=tuple(_curve(signal, name, even, search) for name, even, search in searched),
            warnings=(*(warning for entry in searched for warning in _warnings(signal, *entry)), *refused),
        )


def _settled(
    signal: MotionSignal, even: ResampledSignal, steps_s: Sequence[float], band_share: float
) -> tuple[list[SettlingRow], list[str]]:
    """What it did after each step, or why that is not determined."""
    try:
        return settlings(signal, even, _steps(signal, steps_s), band_share=band_share), []
    except RecordingError as error:
        return [], [f"no settling time: {error}"]


def _steps(signal: MotionSignal, steps_s: Sequence[float]) -> list[float]:
    """Instants of steps in the interval: those that are specified, else those of what was wanted."""
    if steps_s:
        return [step for step in steps_s if signal.time_s[0] <= step <= signal.time_s[-1]]
    if signal.desired_values is None:
        return []
    known = np.isfinite(signal.desired_values)
    name = f"{signal.interval}: {signal.desired}"
    return [float(at) for at in command_steps(signal.time_s[known], signal.desired_values[known], name=name)]


def _oscillation_rows(
    signal: MotionSignal, name: str, even: ResampledSignal, search: OscillationSearch
) -> Iterator[OscillationRow]:
    nothing = OscillationRow(
        interval=signal.interval,
        column=name,
        oscillates=False,
        frequency_hz=None,
        frequency_half_width_95_hz=None,
        amplitude=None,
        amplitude_half_width_95=None,
        unit=signal.unit,
        damping=None,
        damping_half_width_95=None,
        phase_kept_s=None,
        seen_amplitude=float(search.sensitivity[1].max()),
        seen_amplitude_middle=search.seen_amplitude(math.sqrt(search.lowest_hz * search.highest_hz)),
        lowest_hz=search.lowest_hz,
        highest_hz=search.highest_hz,
        samples=len(signal.values),
        duration_s=even.duration_s,
    )
    if not search.oscillations:
        yield nothing
    for one in search.oscillations:
        frequency, amplitude, damping = one.half_width.tolist()
        steady = math.isfinite(one.damping)
        yield nothing.model_copy(
            update={
                "oscillates": True,
                "frequency_hz": one.frequency_hz,
                "frequency_half_width_95_hz": frequency,
                "amplitude": one.amplitude,
                "amplitude_half_width_95": amplitude,
                "damping": one.damping if steady else None,
                "damping_half_width_95": damping if steady else None,
                "phase_kept_s": one.coherence_s,
                "seen_amplitude": search.seen_amplitude(one.frequency_hz),
            }
        )


def _curve(signal: MotionSignal, name: str, even: ResampledSignal, search: OscillationSearch) -> MotionCurve:
    swing = None
    if search.oscillations:
        line = np.polynomial.Polynomial.fit(even.time_s, even.values, 1)
        swing = line(even.time_s) + np.sum([one.fitted for one in search.oscillations], axis=0)
    return MotionCurve(
        title=f"{signal.interval}: {name}", unit=signal.unit, time_s=even.time_s, values=even.values, swing=swing
    )


def _warnings(signal: MotionSignal, name: str, even: ResampledSignal, search: OscillationSearch) -> Iterator[str]:
    where = f"{signal.interval}: {name}"
    if not even.even:
        yield (
            f"{where}: the clock is uneven, with up to {even.longest_step_s:.3g} s between samples: only oscillations "
            f"of up to {even.highest_hz:.3g} Hz are looked at; log without pauses to see faster ones"
        )
    for one in search.oscillations:
        if not math.isfinite(one.damping):
            yield (
                f"{where}: the oscillation of {one.frequency_hz:.4g} Hz keeps its phase for some {one.coherence_s:.3g} "
                "s only, or comes and goes: no damping is determined, and its amplitude is that of what keeps its "
                "phase so long; choose a shorter interval to see more"
            )
        elif one.amplitude < NEAR_LIMIT * search.seen_amplitude(one.frequency_hz):
            yield (
                f"{where}: the oscillation of {one.frequency_hz:.4g} Hz hardly stands out of the noise: what is seen "
                "at that limit is larger than it is, as a smaller one would not have been seen; record longer"
            )
