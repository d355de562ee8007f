# SPDX-License-Identifier: BSD-3-Clause
"""Where a torque loop begins to oscillate: closed forms, Nyquist, eigenvalues, and the controller itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest
from scipy.linalg import block_diag
from scipy.optimize import brentq

from forcetorque.base.errors import ControlError, ShapeError
from forcetorque.locomotion.torque_control.joint_torque_controller import TorqueGains
from forcetorque.locomotion.torque_control.stability import (
    TorqueLoop,
    delay_margin,
    error_in_torques,
    held_joints,
    moving_joints,
    onset,
    stability,
)
from tests.locomotion.torque_control.single_joint import DUTY_TORQUE, GAINS, LAG_S, PERIOD_S, closed_loop

DELAY = 5
ComplexArray = npt.NDArray[np.complex128]
LOOP = TorqueLoop(plant=held_joints(DUTY_TORQUE, LAG_S), gains=GAINS, period_s=PERIOD_S, delay_steps=DELAY)
BOUND = 1e-5
"""Relative: a loop counts as unstable when it grows by 1e-3 1/s, which is a little beyond where it does not decay."""


def _proportional(joint_gain: float, joints: int = 1) -> TorqueGains:
    names = [f"joint_{k}" for k in range(joints)]
    return TorqueGains.of(names, duty_torque=10.0, proportional=joint_gain / 10.0, derivative_time_s=0.0)


@pytest.mark.parametrize("delay", [0, 1, 7])
def test_without_lag_a_loop_gain_of_one_is_the_end(delay: int) -> None:
    """tau_k = -g tau_(k - 1 - delay): whatever the delay, it grows from g (1 + s) = 1 on."""
    loop = TorqueLoop(plant=held_joints(10.0), gains=_proportional(0.25), period_s=PERIOD_S, delay_steps=delay)
    end = onset(loop, 1.0, largest=10.0)
    assert end is not None
    assert end.scale == pytest.approx(3.0, rel=BOUND * (2 + delay))
    # -1 is an odd root: the swing takes twice the delay of one period or a part of that
    turns = end.frequency_hz * 2.0 * (1 + delay) * PERIOD_S
    assert turns == pytest.approx(round(turns), abs=1e-4)


def test_with_lag_and_one_step_of_delay_it_is_the_closed_form() -> None:
    """z^2 - a z + g (1 - a) has roots of size one from g = 1 / (1 - a) on, at the angle arccos(a / 2)."""
    plant, kept = held_joints(10.0, LAG_S), np.exp(-PERIOD_S / LAG_S)
    end = onset(TorqueLoop(plant=plant, gains=_proportional(1.0), period_s=PERIOD_S, delay_steps=1), 1.0, largest=20.0)
    assert end is not None
    assert 1.0 + end.scale == pytest.approx(1.0 / (1.0 - kept), rel=BOUND)
    assert end.frequency_hz == pytest.approx(np.arccos(kept / 2.0) / (2.0 * np.pi * PERIOD_S), rel=BOUND)


def _loop_gain(frequency_hz: float, delay: int) -> complex:
    """Of the joint of `single_joint`, at exp(j w T), from its formula."""
    z = np.exp(2j * np.pi * frequency_hz * PERIOD_S)
    kept, slow = np.exp(-PERIOD_S / GAINS.derivative_time_s), np.exp(-PERIOD_S / LAG_S)
    pid = (
        GAINS.proportional[0]
        + GAINS.integral[0] * PERIOD_S * z / (z - 1.0)
        + GAINS.derivative[0] * (1.0 - kept) / PERIOD_S * (z - 1.0) / (z - kept)
    )
    return complex(pid * DUTY_TORQUE * (1.0 - slow) / (z - slow) * z**-delay)


def test_a_whole_controller_ends_where_nyquist_says() -> None:
    """The first frequency at which the loop gain is negative real tells factor and frequency."""
    end = onset(LOOP, 1.0, largest=20.0)
    assert end is not None
    grid = np.linspace(2.0, 200.0, 400)
    phase = np.unwrap(np.angle([_loop_gain(f, DELAY) for f in grid]))
    k = int(np.flatnonzero(phase < -np.pi)[0])
    frequency = brentq(lambda f: _loop_gain(f, DELAY).imag, grid[k - 1], grid[k])
    assert end.frequency_hz == pytest.approx(frequency, rel=1e-4)
    assert 1.0 + end.scale == pytest.approx(-1.0 / _loop_gain(frequency, DELAY).real, rel=1e-4)


@pytest.mark.parametrize("hold", [1, 10])
@pytest.mark.parametrize(("factor", "grows"), [(0.98, False), (1.02, True)])
def test_the_controller_itself_oscillates_from_there_on(factor: float, grows: bool, hold: int) -> None:
    """Two per cent below the size the swing dies, above it grows, step by step, without the matrices."""
    loop = replace(LOOP, hold_steps=hold)
    end = onset(loop, 1.0, largest=20.0)
    assert end is not None
    gain = 1.0 + factor * end.scale
    desired = np.full(6000, 1e-9)  # far from the limit
    torque, _, _ = closed_loop(
        GAINS, LOOP.plant, desired, reading=lambda _, torque: gain * torque, delay=DELAY, hold=hold
    )
    early, late = np.ptp(torque[1000:2000]), np.ptp(torque[5000:])
    assert bool(late > early) is grows
    swing = torque[1000:2000] - torque[1000:2000].mean()
    crossings = np.count_nonzero(np.diff(np.sign(swing)) != 0.0)
    assert crossings / 2.0 == pytest.approx(end.frequency_hz, rel=0.1)
    mode = stability(loop, gain - 1.0)
    assert mode.stable is not grows
    assert np.log(late / early) / 4.0 == pytest.approx(mode.growth, rel=0.05)  # 4 s lie between equal places


def test_an_offset_alone_does_not_oscillate() -> None:
    """A constant wrench that is not there moves the torque and nothing else: it is no part of the loop."""
    desired = np.full(4000, 5.0)
    torque, _, _ = closed_loop(GAINS, LOOP.plant, desired, reading=lambda _, torque: torque + 3.0, delay=DELAY)
    assert torque[-1] == pytest.approx(2.0, abs=1e-3)
    assert np.ptp(torque[-500:]) < 1e-3


def test_of_joints_that_are_alike_the_eigenvalues_of_the_error_tell() -> None:
    """The loop of three joints has the modes of three loops of one, each with an eigenvalue of 1 + E as its gain."""
    rng = np.random.default_rng(2)
    error = 0.3 * rng.standard_normal((3, 3))
    fields = ("duty_torque", "proportional", "integral", "derivative")
    gains = TorqueGains.of(
        ["a", "b", "c"],
        **{field: getattr(GAINS, field)[0] for field in fields},
        derivative_time_s=GAINS.derivative_time_s,
    )
    plant = held_joints([DUTY_TORQUE] * 3, LAG_S)
    whole = np.linalg.eigvals(replace(LOOP, plant=plant, gains=gains).transition(error))

    def modes(values: ComplexArray) -> ComplexArray:
        # one step is linear in the gain, so that a complex one is a combination of two real ones
        none, unit = LOOP.transition(-1.0), LOOP.transition(0.0)
        return np.concatenate([np.linalg.eigvals(none + (1.0 + value) * (unit - none)) for value in values])

    assert len(whole) == 3 * len(LOOP.transition())
    slowest = np.sort(np.abs(whole))[-9:]
    assert np.sort(np.abs(modes(np.linalg.eigvals(error))))[-9:] == pytest.approx(slowest, abs=1e-9)
    assert np.abs(np.sort(np.abs(modes(np.diag(error).astype(np.complex128))))[-9:] - slowest).max() > 1e-3


def test_joints_that_differ_are_no_more_than_one_after_the_other() -> None:
    """Without an error across, the loop of two joints ends where the first of them does."""
    two = TorqueGains.of(["a", "b"], duty_torque=10.0, proportional=[0.1, 0.2])
    loop = TorqueLoop(plant=held_joints([10.0, 10.0], LAG_S), gains=two, period_s=PERIOD_S, delay_steps=3)
    ends = [
        onset(
            replace(
                loop, plant=held_joints(10.0, LAG_S), gains=TorqueGains.of(["x"], duty_torque=10.0, proportional=p)
            ),
            1.0,
            largest=50.0,
        )
        for p in (0.1, 0.2)
    ]
    both = onset(loop, 1.0, largest=50.0)
    assert both is not None
    assert ends[0] is not None
    assert ends[1] is not None
    assert both.scale == pytest.approx(ends[1].scale)
    assert ends[1].scale < ends[0].scale


def test_the_delay_margin_is_the_last_stable_delay() -> None:
    """One step more and it grows; a margin beyond what is looked at is none."""
    margin = delay_margin(LOOP, most=100)
    assert margin is not None
    assert margin > 0
    assert stability(replace(LOOP, delay_steps=DELAY + margin)).stable
    assert not stability(replace(LOOP, delay_steps=DELAY + margin + 1)).stable
    assert delay_margin(LOOP, most=margin - 1) is None


def test_a_free_joint_is_stable_and_its_loop_gain_is_less() -> None:
    """It may go on at any velocity, which is no growth; the rotor takes a part of the torque that the drive gives."""
    rotor, link = 0.3, 0.5
    free = moving_joints(DUTY_TORQUE, [[link]], rotor, lag_s=LAG_S)
    held = onset(LOOP, 1.0, largest=50.0)
    moving = onset(replace(LOOP, plant=free), 1.0, largest=50.0)
    assert held is not None
    assert moving is not None
    assert 1.0 + moving.scale == pytest.approx((1.0 + held.scale) * (link + rotor) / link, rel=0.01)
    assert stability(replace(LOOP, plant=free)).stable


def test_a_posture_loop_around_is_part_of_it() -> None:
    """A desired torque that holds a posture swings with the frequency of its stiffness, and is damped as stated."""
    stiffness, damping, link = 50.0, 2.0, 0.5
    plant = moving_joints(DUTY_TORQUE, [[link]], 0.0, lag_s=1e-4, demand=[[-stiffness, -damping, 0.0]])
    gains = TorqueGains.of(["a"], duty_torque=DUTY_TORQUE, proportional=0.0)
    mode = stability(TorqueLoop(plant=plant, gains=gains, period_s=1e-4))
    assert mode.growth == pytest.approx(-damping / (2.0 * link), rel=0.03)
    assert mode.frequency_hz == pytest.approx(
        np.sqrt(stiffness / link - (damping / (2.0 * link)) ** 2) / (2.0 * np.pi), rel=0.01
    )


def test_an_error_of_sensors_is_mapped_by_what_torques_do_to_them() -> None:
    """One sensor on a lever: an error of its moment is one of the torque, one of a force counts by the lever."""
    estimator = np.array([[0.0, 0.0, 0.4, 0.0, 1.0, 0.0]])  # torque from force z on a lever, and moment y
    wrenches = np.array([[0.0], [0.0], [1.0], [0.0], [0.6], [0.0]])  # what 1 N m is felt as: 0.4 * 1 + 0.6 = 1
    error = np.zeros((6, 6))
    error[4, 4] = 0.1
    assert error_in_torques(estimator, error, wrenches) == pytest.approx(np.array([[0.06]]))
    error[4, 2] = 0.05  # crosstalk
    assert error_in_torques(estimator, error, wrenches) == pytest.approx(np.array([[0.11]]))
    both = error_in_torques(block_diag(estimator, estimator), block_diag(error, error), block_diag(wrenches, wrenches))
    assert both == pytest.approx(0.11 * np.eye(2))
    with pytest.raises(ShapeError, match="wrenches_of_torques"):
        error_in_torques(estimator, error, wrenches.T)


def test_what_is_unstable_without_an_error_is_refused() -> None:
    """With growth and frequency, before any error is drawn."""
    with pytest.raises(ControlError, match=r"unstable without any error: it grows by .* 1/s at .* Hz; lower"):
        onset(replace(LOOP, gains=replace(GAINS, proportional=np.array([1.0]))), 1.0, largest=1.0)
    with pytest.raises(ControlError, match="expected 1 joints as in gains, got 2"):
        replace(LOOP, plant=held_joints([1.0, 2.0]))
    with pytest.raises(ControlError, match="lag_s"):
        held_joints(1.0, -1.0)
    with pytest.raises(ControlError, match="joints that move"):
        moving_joints(1.0, [[1.0]], 0.0, lag_s=0.0)
    assert onset(LOOP, 1.0, largest=0.1) is None
    assert delay_margin(replace(LOOP, gains=replace(GAINS, proportional=np.array([1.0]))), most=3) == -1
