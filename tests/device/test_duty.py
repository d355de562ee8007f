# SPDX-License-Identifier: BSD-3-Clause
"""Torques of motors: (6.1) is an average over the path, in closed form, at any speed."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.device.motors_hinge_and_envelope import MotorRow, average_torque, motor_row, path_rad

HALF_SINE = (4.0 / (3.0 * np.pi)) ** (1.0 / 3.0)
"""Cubic mean of a half-sine over its peak, in closed form: 0.7515."""
TRAPEZOID = 1e-5
"""A trapezoid rule of 500 steps over a half-sine is off by less, of the peak."""


def _swing(law: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """An arm that swings from below to above by a law of motion from 0 to 1."""
    angle = -0.5 * np.pi + np.pi * law
    return 131.0 * np.cos(angle), angle


def _duty(torque: np.ndarray, position: np.ndarray, time: np.ndarray) -> MotorRow:
    return motor_row("pitch", torque, position, time, moving_peak_Nm=0.0, limit_Nm=160.0)


def test_half_a_turn_of_an_arm_averages_to_the_closed_form() -> None:
    """0.7515 of the peak."""
    torque, angle = _swing(np.linspace(0.0, 1.0, 501))
    assert average_torque(torque, angle) == pytest.approx(131.0 * HALF_SINE, rel=TRAPEZOID)
    assert pytest.approx(0.7515, abs=5e-5) == HALF_SINE


@pytest.mark.parametrize("power", [1, 2, 5])
def test_the_profile_of_the_speed_drops_out(power: int) -> None:
    """Speed times time is the path: any law of motion gives one average, while the root mean square differs."""
    time = np.linspace(0.0, 1.0, 4001)
    law = time**power * (1.0 + power * (1.0 - time))  # ends at rest
    duty = _duty(*_swing(law), 3.0 * time)
    assert duty.average_Nm == pytest.approx(131.0 * HALF_SINE, rel=TRAPEZOID)
    assert duty.average_over_peak == pytest.approx(HALF_SINE, rel=TRAPEZOID)
    even = _duty(*_swing(time), 3.0 * time)
    assert even.rms_Nm == pytest.approx(131.0 / np.sqrt(2.0), rel=TRAPEZOID)
    assert abs(duty.rms_Nm - even.rms_Nm) > 1.0


def test_holding_and_coming_back_change_nothing() -> None:
    """Path counts both ways, and a hold has none; the holding torque is that of the hold."""
    torque, angle = _swing(np.linspace(0.0, 1.0, 501))
    level = 250
    stops = np.r_[0:level, np.full(900, level), level:501, 500:-1:-1]
    duty = _duty(torque[stops], angle[stops], np.arange(len(stops), dtype=float))
    assert duty.average_Nm == pytest.approx(131.0 * HALF_SINE, rel=TRAPEZOID)
    assert path_rad(angle[stops]) == pytest.approx(2.0 * np.pi)
    assert duty.holding_Nm == duty.peak_Nm == 131.0
    assert duty.rms_Nm > 1.1 * 131.0 / np.sqrt(2.0)


def test_the_time_of_day_changes_nothing() -> None:
    """A motion that begins an hour later has the same root mean square."""
    torque, angle = _swing(np.linspace(0.0, 1.0, 501))
    time = np.linspace(0.0, 3.0, 501)
    assert _duty(torque, angle, time + 3600.0).rms_Nm == pytest.approx(_duty(torque, angle, time).rms_Nm, rel=1e-9)


def test_an_average_over_time_is_another_number() -> None:
    """Negative control: without the path, a hold at the peak moves the average."""
    torque, angle = _swing(np.linspace(0.0, 1.0, 501))
    held = np.r_[torque[:250], np.full(900, torque[250]), torque[250:]]
    over_time = float(np.mean(np.abs(held) ** 3) ** (1.0 / 3.0))
    assert over_time > 1.1 * average_torque(torque, angle)


def test_a_motion_that_only_holds_has_no_average() -> None:
    """Its path is nothing."""
    held = _duty(np.full(10, 131.0), np.zeros(10), np.arange(10.0))
    assert (held.average_Nm, held.holding_Nm, held.rms_Nm) == (None, 131.0, 131.0)
    with pytest.raises(SensorError, match=r"expected a motion to average over by \(6\.1\), got 10 samples that all"):
        average_torque(np.full(10, 131.0), np.zeros(10))


def test_a_motor_that_never_holds_holds_nothing() -> None:
    """And one that holds little holds that, not a newton metre."""
    torque, angle = _swing(np.linspace(0.0, 1.0, 501))
    assert _duty(torque, angle, np.arange(501.0)).holding_Nm == 0.0
    small = np.array([0.3, 0.2, 0.2, -0.1])
    assert _duty(small, np.array([0.0, 1.0, 1.0, 2.0]), np.arange(4.0)).holding_Nm == 0.2
