# SPDX-License-Identifier: BSD-3-Clause
"""The closed loop does what is wanted, is shifted by offsets, and swings where the linear loop says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ControlError
from forcetorque.locomotion.torque_control.balancing_controller import Phase, Timing, standing, switching
from forcetorque.locomotion.torque_control.biped_in_mujoco import SENSORS, Biped
from forcetorque.locomotion.torque_control.closed_loop import (
    PRINTED,
    LoopRun,
    LoopSetting,
    SensorErrors,
    drawn_matrices,
    run_loop,
)
from forcetorque.locomotion.torque_control.linear_robot import LinearRobot, linear_robot, require_stable
from forcetorque.locomotion.torque_control.torque_loop_file import PERIOD_S, DriveTable, SensorTable, TorqueLoopFile

pytest.importorskip("mujoco")

LEVER_M = 0.07
FRICTIONLESS = TorqueLoopFile(drive=DriveTable(coulomb_Nm=0.0, viscous_Nms=0.0), sensor=SensorTable(noise_N=0.0))
LIFT_M = 0.03


@pytest.fixture(scope="module")
def biped() -> Biped:
    """The robot on level soles."""
    return Biped.on_soles(0.0)


@pytest.fixture(scope="module")
def setting(biped: Biped) -> LoopSetting:
    """Default gains without friction, which has no linear part."""
    return FRICTIONLESS.setting(biped, 1.0)


def errors_of(matrix: FloatArray, bias: FloatArray | None = None) -> SensorErrors:
    """Sensors without noise and steps."""
    none = np.zeros((len(matrix), len(SENSORS), 6))
    return SensorErrors(matrix=matrix, bias=none if bias is None else bias, noise=np.zeros(6), resolution=np.zeros(6))


def pushed(
    biped: Biped, setting: LoopSetting, phase: Phase, errors: SensorErrors, *, seconds: float, push_N: float = 20.0
) -> LoopRun:
    """Stand still and be pushed."""
    still = standing(biped, phase, round(seconds / PERIOD_S), LIFT_M, PERIOD_S)
    return run_loop(biped, setting, still, errors, rng=np.random.default_rng(1), push_N=push_N)


@pytest.mark.long
def test_without_errors_it_changes_its_support_and_stands(biped: Biped, setting: LoopSetting) -> None:
    """On the left foot, on both, on the right: torques are tracked within 0.2 N m, the centre of mass within 10 mm."""
    reference = switching(biped, Timing(hold_s=0.1, shift_s=0.8, single_s=0.4, lift_m=0.02), PERIOD_S)
    run = run_loop(biped, setting, reference, SensorErrors.none(1), rng=np.random.default_rng(1))
    assert set(reference.phases) == set(Phase)
    assert run.fallen[0] == len(reference)
    assert run.tracking_rms[0] < 0.2
    assert np.abs(run.centre_error).max() < 0.01


def test_a_constant_offset_shifts_the_posture_and_does_not_swing(biped: Biped, setting: LoopSetting) -> None:
    """10 N and 1 N m too much on all sensors: it comes to rest elsewhere."""
    bias = np.tile(np.repeat([10.0, 1.0], 3), (1, len(SENSORS), 1))
    run = pushed(biped, setting, Phase.DOUBLE, errors_of(np.zeros((1, 4, 6, 6)), bias), seconds=1.4, push_N=0.0)
    shift_mm = 1e3 * run.centre_error[0]
    assert np.abs(shift_mm[-1]).max() > 1.0
    assert np.ptp(shift_mm[-500:], axis=0).max() < 0.5


def test_gains_that_are_unstable_alone_are_refused(biped: Biped) -> None:
    """The linear loop says so before anything is simulated; the default gains pass."""
    still = standing(biped, Phase.LEFT, 2, LIFT_M, PERIOD_S)
    require_stable(linear_robot(biped, FRICTIONLESS.setting(biped, 1.0), still, 0))
    with pytest.raises(ControlError, match=r"unstable without any sensor error: it grows by .* 1/s at 1\d\d Hz"):
        require_stable(linear_robot(biped, FRICTIONLESS.setting(biped, 5.0), still, 0))


def _balanced(robot: LinearRobot, matrices: FloatArray) -> SensorErrors:
    """None, and errors with the offsets that make up for them at rest: what is left is what they do to the loop."""
    matrices = np.concatenate([np.zeros_like(matrices[:1]), matrices])
    at_rest = robot.wrenches_at_rest.reshape(len(SENSORS), 6)
    return errors_of(matrices, -np.einsum("bsij,sj->bsi", matrices, at_rest))


def _ends_unstable(run: LoopRun) -> BoolArray:
    """Whether each copy but the first, which has no E, fell, or swings more in the last quarter than in the second."""
    steps = run.centre_error.shape[1]
    fell = run.fallen < steps
    second, last = (
        np.where(fell[:, None, None], 0.0, run.centre_error[:, part]).std(axis=1).max(axis=1)
        for part in (slice(steps // 4, steps // 2), slice(3 * steps // 4, steps))
    )
    return (fell | (last > second))[1:]


@pytest.mark.long
@pytest.mark.parametrize("phase", [Phase.DOUBLE, Phase.LEFT])
def test_the_linear_loop_says_from_which_size_on_it_swings(biped: Biped, setting: LoopSetting, phase: Phase) -> None:
    """Of twelve draws ten at least die away at 0.8 of the predicted size, and grow or fall at 1.2 of it.

    The push is small, so that feet stay on the ground, as the linear loop takes them.
    """
    robot = linear_robot(biped, setting, standing(biped, phase, 2, LIFT_M, PERIOD_S), 0)
    unit = drawn_matrices(PRINTED["workbench"], LEVER_M, np.random.default_rng(78), 12)
    scales = [robot.onset(matrix, largest=40.0) for matrix in unit]
    matrices = np.array([one.scale * matrix for one, matrix in zip(scales, unit, strict=True) if one is not None])
    assert len(matrices) >= 10
    below, above = (
        _ends_unstable(pushed(biped, setting, phase, _balanced(robot, share * matrices), seconds=16.0, push_N=2.0))
        for share in (0.8, 1.2)
    )
    assert below.mean() <= 0.2, below
    assert above.mean() >= 0.8, above


@pytest.mark.long
def test_one_draw_swings_above_the_predicted_size_and_not_below(biped: Biped, setting: LoopSetting) -> None:
    """The quick one of the long test: at half of the size a push dies away, at twice it does not."""
    robot = linear_robot(biped, setting, standing(biped, Phase.LEFT, 2, LIFT_M, PERIOD_S), 0)
    (unit,) = drawn_matrices(PRINTED["workbench"], LEVER_M, np.random.default_rng(3), 1)
    predicted = robot.onset(unit, largest=40.0)
    assert predicted is not None
    matrices = predicted.scale * np.array([0.5 * unit, 2.0 * unit])
    run = pushed(biped, setting, Phase.LEFT, _balanced(robot, matrices), seconds=2.5, push_N=2.0)
    assert _ends_unstable(run).tolist() == [False, True]


def test_friction_delay_and_steps_can_be_taken_away_singly(biped: Biped) -> None:
    """Each changes what the file settles, and nothing else."""
    default = TorqueLoopFile().setting(biped, 1.0)
    without = TorqueLoopFile.model_validate({"drive": {"coulomb_Nm": 0.0}}).setting(biped, 1.0)
    assert (default.drive.coulomb, without.drive.coulomb) == (0.5, 0.0)
    assert (default.gains.coulomb > 0.0).all()
    assert not without.gains.coulomb.any()
    assert (without.delay_steps, without.hold_steps, without.balance) == (1, 1, default.balance)
    late = TorqueLoopFile.model_validate({"estimator": {"delay_s": 0.0}}).setting(biped, 1.0)
    assert (default.delay_steps, late.delay_steps) == (1, 0)
    rough = errors_of(np.zeros((1, 4, 6, 6)))
    wrench = np.full((1, 4, 6), 0.123)
    rng = np.random.default_rng(1)
    np.testing.assert_array_equal(rough.reading(wrench, rng), wrench)
    np.testing.assert_allclose(replace(rough, resolution=np.full(6, 0.05)).reading(wrench, rng), 0.1)
