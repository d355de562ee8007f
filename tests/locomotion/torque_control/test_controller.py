# SPDX-License-Identifier: BSD-3-Clause
"""The torque controller answers as its linear part does, and winds, saturates and changes calibrations as it says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import signal

from forcetorque.base.errors import ControlError, ShapeError
from forcetorque.locomotion.torque_control.joint_torque_controller import TorqueController, TorqueGains
from forcetorque.locomotion.torque_control.stability import held_joints, moving_joints
from tests.locomotion.torque_control.single_joint import DUTY_TORQUE, GAINS, LAG_S, PERIOD_S, closed_loop, transfer

ROUNDING = 1e-9
"""Of torques of 10 N m over a thousand steps of two ways to compute the same."""
PLANT = held_joints(DUTY_TORQUE, LAG_S)


@pytest.mark.parametrize("delay", [0, 3])
def test_a_step_is_answered_as_the_transfer_function_says(delay: int) -> None:
    """The controller step by step is the difference equation of its gains."""
    desired = np.full(600, 5.0)
    desired[0] = 0.0  # a controller has no slope in its first step
    torque, _, _ = closed_loop(GAINS, PLANT, desired, delay=delay)
    expected = signal.dlsim(transfer(delay=delay), desired)[1][:, 0]
    assert np.abs(torque - expected).max() < ROUNDING
    assert np.abs(torque - signal.dlsim(transfer(delay=delay + 1), desired)[1][:, 0]).max() > 0.01  # it can fail


def test_a_sine_is_followed_as_the_frequency_response_says() -> None:
    """After the transient, amplitude and phase are those at exp(j w T)."""
    frequency, n = 7.0, 3000
    time = PERIOD_S * np.arange(n)
    torque, _, _ = closed_loop(GAINS, PLANT, 5.0 * np.sin(2.0 * np.pi * frequency * time))
    angle = 2.0 * np.pi * frequency * PERIOD_S
    response = signal.dfreqresp(transfer(), w=[angle])[1][0]
    expected = 5.0 * np.abs(response) * np.sin(2.0 * np.pi * frequency * time + np.angle(response))
    assert np.abs(torque - expected)[-1000:].max() < ROUNDING
    assert np.abs(response) < 1.02
    assert np.degrees(np.angle(response)) < -5.0  # it is no trivial response


def test_in_small_steps_it_is_the_continuous_controller() -> None:
    """The error against `expm` of the continuous loop goes down with the period."""
    from scipy.linalg import expm

    integral, proportional = float(GAINS.integral[0]), float(GAINS.proportional[0])
    gain = DUTY_TORQUE / LAG_S
    # states: torque, integral of the error, desired torque
    loop = np.array(
        [
            [-1.0 / LAG_S - gain * proportional, gain * integral, gain * (1.0 / DUTY_TORQUE + proportional)],
            [-1.0, 0.0, 1.0],
            [0.0, 0.0, 0.0],
        ]
    )
    truth = 5.0 * (expm(0.03 * loop) @ [0.0, 0.0, 1.0])[0]
    errors = []
    for period in (1e-3, 1e-4):
        controller = TorqueController(replace(GAINS, derivative=np.zeros(1)), period)
        by_state, by_duty = PLANT.sampled(period)
        state = np.zeros(1)
        for _ in range(round(0.03 / period)):
            state = by_state @ state + by_duty @ controller.step(np.array([5.0]), state, np.zeros(1))
        errors.append(abs(state[0] - truth))
    assert errors[1] < 0.2 * errors[0] < 0.02


def test_the_output_stays_within_the_limit_and_says_so() -> None:
    """A torque that the drive cannot give is given as far as it goes."""
    gains = replace(GAINS, limit=np.array([0.1]))
    torque, duty, controller = closed_loop(gains, PLANT, np.full(500, 20.0))
    assert np.abs(duty).max() == 0.1
    assert torque[-1] == pytest.approx(0.1 * DUTY_TORQUE)
    assert controller.limited.all()
    assert not closed_loop(GAINS, PLANT, np.full(500, 20.0))[2].limited.any()


def test_the_integral_stops_at_the_limit() -> None:
    """After a demand that is too much the torque goes to the next one at once; a wound-up integral would not."""
    gains = replace(GAINS, limit=np.array([0.1]), derivative=np.zeros(1))
    desired = np.concatenate([np.full(2000, 20.0), np.full(400, 4.0)])
    torque, duty, _ = closed_loop(gains, PLANT, desired)
    assert abs(torque[2000 + 40] - 4.0) < 0.4
    # the same without stopping: clip behind a controller that knows no limit of 0.1
    free = TorqueController(replace(gains, limit=np.array([1.0])), PERIOD_S)
    by_state, by_duty = PLANT.sampled(PERIOD_S)
    state, wound = np.zeros(1), np.zeros(len(desired))
    for k, wanted in enumerate(desired):
        wound[k] = state[0]
        clipped = np.clip(free.step(np.array([wanted]), state, np.zeros(1)), -0.1, 0.1)
        state = by_state @ state + by_duty @ clipped
    assert abs(wound[2000 + 40] - 4.0) > 3.0
    assert (np.abs(duty) <= 0.1).all()


def test_the_integral_winds_back_from_the_limit() -> None:
    """Where the rest alone is beyond the limit, the integral may still go the other way."""
    gains = TorqueGains.of(["a"], duty_torque=10.0, proportional=0.1, integral=10.0, limit=0.5)
    controller = TorqueController(gains, PERIOD_S)
    for _ in range(100):
        controller.step(np.array([1.0]), np.zeros(1), np.zeros(1))
    assert controller.integral[0] == pytest.approx(0.5 - 0.1 - 0.1)  # exactly what the limit leaves
    before = controller.integral[0]
    controller.step(np.array([20.0]), np.array([21.0]), np.zeros(1))
    assert controller.integral[0] < before
    assert controller.limited[0]


@pytest.mark.long
def test_a_change_of_calibration_does_not_jump() -> None:
    """The step of the change gives what the old calibration would have given, and the new one wins in the end."""
    reading = {"old": lambda torque: 1.1 * torque + 2.0, "new": lambda torque: torque}
    desired = np.array([5.0])
    outputs: dict[str, list[float]] = {}
    for case in ("kept", "changed", "jumped"):
        controller = TorqueController(GAINS, PERIOD_S)
        by_state, by_duty = PLANT.sampled(PERIOD_S)
        state, outputs[case] = np.zeros(1), []
        for k in range(4000):
            old, new = reading["old"](state), reading["new"](state)
            if case == "changed" and k == 1000:
                controller.recalibrate(old, new)
            estimate = old if case == "kept" or k < 1000 else new
            duty = controller.step(desired, estimate, np.zeros(1))
            outputs[case].append(float(duty[0]))
            state = by_state @ state + by_duty @ duty
    kept, changed, jumped = (np.array(outputs[case]) for case in ("kept", "changed", "jumped"))
    assert changed[1000] == pytest.approx(kept[1000], abs=1e-14)
    assert jumped[1000] - kept[1000] > 0.04  # without it the output jumps by K_p times the change, and more
    assert np.abs(np.diff(changed[990:1400])).max() < 0.02 * (jumped[1000] - kept[1000])
    assert changed[-1] * DUTY_TORQUE == pytest.approx(5.0, abs=0.02)
    assert kept[-1] * DUTY_TORQUE == pytest.approx((5.0 - 2.0) / 1.1, abs=0.02)


def test_friction_and_feed_forward_are_added_as_torques() -> None:
    """Of a perfect estimate only the wanted torques are left."""
    gains = TorqueGains.of(["a", "b"], duty_torque=[10.0, 20.0], proportional=0.1, coulomb=[1.0, 0.0], bemf=0.02)
    duty = TorqueController(gains, PERIOD_S).step(
        np.array([2.0, 2.0]), np.array([2.0, 2.0]), np.array([5.0, -5.0]), np.array([0.5, 0.0])
    )
    assert duty == pytest.approx([(2.0 + 1.0 + 0.5) / 10.0 + 0.1, 2.0 / 20.0 - 0.1])


def test_back_emf_and_friction_of_a_moving_joint_are_made_up_for() -> None:
    """With K_bemf = viscous friction / K_PWM the drive gives the desired torque at any velocity."""
    plant = moving_joints(DUTY_TORQUE, [[0.5]], 0.0, viscous=2.0, lag_s=1e-4)
    exact = TorqueGains.of(["a"], duty_torque=DUTY_TORQUE, proportional=0.0, bemf=2.0 / DUTY_TORQUE)
    torque, _, _ = closed_loop(exact, plant, np.full(300, 1.0))
    without, _, _ = closed_loop(replace(exact, bemf=np.zeros(1)), plant, np.full(300, 1.0))
    assert torque[-1] == pytest.approx(1.0, abs=0.01)
    assert without[-1] < 0.5


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"proportional": -0.1}, r"joint 'a': proportional: expected 0 or more"),
        ({"duty_torque": 0.0}, r"joint 'a': duty_torque: expected a number above 0, got 0"),
        ({"limit": 95.0}, r"limit: expected a duty cycle of at most 1, .* divide percent by 100"),
        ({"blend_s": 0.0}, r"blend_s: expected more than 0 s"),
        ({"bemf": np.nan}, r"joint 'a': bemf: expected a finite number"),
    ],
)
def test_gains_that_are_none_are_refused(change: dict[str, float], message: str) -> None:
    """Each says the joint, the gain and what was expected."""
    with pytest.raises(ControlError, match=message):
        TorqueGains.of(["a", "b"], **{"duty_torque": 10.0, "proportional": 0.1, **change})  # type: ignore[arg-type]


def test_what_is_no_number_is_refused() -> None:
    """A missing estimate would stay in the integral for ever."""
    controller = TorqueController(GAINS, PERIOD_S)
    with pytest.raises(ControlError, match=r"joint 'knee': expected finite torques"):
        controller.step(np.array([1.0]), np.array([np.nan]), np.zeros(1))
    with pytest.raises(ShapeError, match="estimated"):
        controller.step(np.array([1.0]), np.zeros(2), np.zeros(1))
    with pytest.raises(ShapeError, match="one number or one for each of 2 joints"):
        TorqueGains.of(["a", "b"], duty_torque=[1.0, 2.0, 3.0], proportional=0.1)
