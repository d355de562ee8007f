# SPDX-License-Identifier: BSD-3-Clause
"""Settling times of a known mass on a spring, and tracking errors of known size."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.locomotion.logged_signals import MotionSignal
from forcetorque.locomotion.oscillation.settling import (
    SettlingRow,
    TrackingRow,
    command_steps,
    settlings,
    tracking_error,
)
from forcetorque.locomotion.oscillation.spectrum import resampled
from tests.locomotion.oscillation.noises import noise

TIME_S = np.arange(2000) / 100.0


def step_response(since_s: FloatArray, frequency_hz: float, damping: float) -> FloatArray:
    """Unit step of one mass on one spring, 0 before."""
    late, turn = np.maximum(since_s, 0.0), 2.0 * np.pi * frequency_hz
    damped = turn * np.sqrt(1.0 - damping**2)
    swings = np.cos(damped * late) + damping / np.sqrt(1.0 - damping**2) * np.sin(damped * late)
    return np.asarray(1.0 - np.exp(-damping * turn * late) * swings)


def a_signal(time_s: FloatArray, values: FloatArray, desired: FloatArray | None = None) -> MotionSignal:
    """The column `q` of an interval, with its command."""
    return MotionSignal(
        interval="record",
        column="q",
        unit="rad",
        time_s=time_s,
        values=values,
        desired=None if desired is None else "q_d",
        desired_values=desired,
    )


def settled(
    time_s: FloatArray,
    values: FloatArray,
    steps_s: list[float],
    *,
    desired: FloatArray | None = None,
    band_share: float = 0.05,
) -> list[SettlingRow]:
    """Settling after steps of a column."""
    signal = a_signal(time_s, values, desired)
    return settlings(signal, resampled(time_s, values, name=signal.name), steps_s, band_share=band_share)


def tracked(time_s: FloatArray, desired: FloatArray, values: FloatArray) -> TrackingRow:
    """Tracking error of a column."""
    return tracking_error(a_signal(time_s, values, desired))


def settled_after(frequency_hz: float, damping: float, band: float) -> float:
    """Time after which the unit step stays within the band."""
    fine = np.arange(0.0, 20.0, 1e-4)
    return float(fine[np.flatnonzero(np.abs(step_response(fine, frequency_hz, damping) - 1.0) > band)[-1]])


@pytest.mark.parametrize(("frequency", "damping"), [(1.0, 0.2), (1.0, 0.7), (0.6, 0.2)])
def test_settling_is_that_of_the_formula(frequency: float, damping: float) -> None:
    """To one sample, and what smoothing does; overshoot is exp(-pi z / sqrt(1 - z^2))."""
    values = 3.0 - 2.0 * step_response(TIME_S - 5.0, frequency, damping)
    command = np.where(TIME_S < 5.0, 3.0, 1.0)
    (row,) = settled(TIME_S, values, [5.0], desired=command)
    assert row.settling_s == pytest.approx(settled_after(frequency, damping, 0.05), abs=0.02)
    assert row.step == pytest.approx(-2.0, abs=1e-3)
    assert row.left_error == pytest.approx(0.0, abs=1e-3)
    assert row.overshoot_percent / 100.0 == pytest.approx(
        np.exp(-np.pi * damping / np.sqrt(1.0 - damping**2)), abs=0.02
    )
    assert row.earliest_s <= row.settling_s <= row.latest_s


def test_noise_widens_the_interval() -> None:
    """The truth lies inside; with noise like the band nothing is settled for sure."""
    true = settled_after(1.0, 0.2, 0.05)
    values = step_response(TIME_S - 5.0, 1.0, 0.2)
    for seed in range(5):
        noisy = values + 0.01 * noise("ar 0.9", len(values), np.random.default_rng(seed))
        (row,) = settled(TIME_S, noisy, [5.0])
        assert row.earliest_s - 0.01 <= true <= (np.inf if row.latest_s is None else row.latest_s + 0.01)
    loud = values + 0.05 * noise("ar 0.9", len(values), np.random.default_rng(0))
    (row,) = settled(TIME_S, loud, [5.0])
    assert row.latest_s is None


def test_a_swing_that_goes_on_is_not_settled() -> None:
    """A self-sustained swing of twice the band behind the step."""
    values = step_response(TIME_S - 5.0, 1.0, 0.5) + np.where(TIME_S > 5.0, 0.1, 0.0) * np.sin(8.0 * TIME_S)
    (row,) = settled(TIME_S, values, [5.0])
    assert row.settling_s is None
    assert row.latest_s is None


def test_steps_are_found_in_a_command() -> None:
    """A ramp over three samples is one step; a sine is no staircase."""
    command = np.where(TIME_S < 4.0, 0.0, 1.0) - np.clip((TIME_S - 12.0) / 0.03, 0.0, 1.0)
    assert command_steps(TIME_S, command, name="q_d") == pytest.approx([4.0, 12.01], abs=0.011)
    rows = settled(TIME_S, command + 1e-4 * np.sin(TIME_S), [4.0, 12.0])
    assert [row.step for row in rows] == pytest.approx([1.0, -1.0], abs=1e-3)
    with pytest.raises(RecordingError, match=r"q_d: expected a command that goes in steps .* changes in 100 %"):
        command_steps(TIME_S, np.sin(TIME_S), name="q_d")
    with pytest.raises(RecordingError, match="a command with steps, got 0 throughout"):
        command_steps(TIME_S, 0.0 * TIME_S, name="q_d")


def test_steps_that_cannot_be_judged_are_refused() -> None:
    """Outside the record, too close to its end, or of a signal that does not go anywhere."""
    values = step_response(TIME_S - 5.0, 1.0, 0.5)
    with pytest.raises(
        RecordingError, match=r"record: q: step at 19.900 s: expected at least 30 samples before and behind it"
    ):
        settled(TIME_S, values, [19.9])
    with pytest.raises(RecordingError, match="band: expected a share of the step between 0 and 1, got 5"):
        settled(TIME_S, values, [5.0], band_share=5.0)
    static = np.random.default_rng(0).standard_normal(2000)
    with pytest.raises(RecordingError, match="expected a signal that goes somewhere"):
        settled(TIME_S, static, [5.0])


def test_tracking_error_is_root_mean_square_with_its_interval() -> None:
    """Of 1 N m of slow noise about 0.5 N m, sqrt(1.25); neighbouring samples count as few."""
    error = noise("ar 0.99", 6000, np.random.default_rng(3)) + 0.5
    time = np.arange(6000) / 100.0
    desired = np.sin(time)
    row = tracked(time, desired, desired + error)
    assert row.rms == pytest.approx(np.sqrt((error**2).mean()))
    assert row.rms_lower_95 < np.sqrt(1.25) < row.rms_upper_95
    assert row.mean_error == pytest.approx(error.mean())
    assert row.effective_samples < 120
    white = tracked(time, desired, desired + noise("white", 6000, np.random.default_rng(3)))
    assert white.rms_upper_95 - white.rms_lower_95 < 0.25 * (row.rms_upper_95 - row.rms_lower_95)


def test_a_constant_error_has_no_interval_and_a_missing_one_is_refused() -> None:
    """An offset is known exactly; a column of NaN is none."""
    row = tracked(TIME_S, np.zeros(2000), np.full(2000, 0.3))
    assert (row.rms_lower_95, row.rms, row.rms_upper_95) == pytest.approx((0.3, 0.3, 0.3))
    with pytest.raises(RecordingError, match="both a desired and a measured value, got 0"):
        tracked(TIME_S, np.zeros(2000), np.full(2000, np.nan))
