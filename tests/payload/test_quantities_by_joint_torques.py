# SPDX-License-Identifier: BSD-3-Clause
"""Every quantity of a load by joint torques changes with units, signs and order as that quantity must."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import f, t

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.formats.arm_log import UNKNOWNS, LoggedTorques, holding_torques
from forcetorque.formats.franka.kinematics import joint_frames
from forcetorque.payload.load_by_joint_torques import (
    TorqueLoad,
    _fit,
    _loads_differ,
    _postures,
    _require_postures,
    _stays,
    load_of_torques,
)
from tests.payload.simulated_panda import GRAVITY

SAME = 1e-9
"""Of the largest number of a quantity: rounding of sums in another order."""
MASS, CENTRE, BIAS = 1.7, np.array([0.01, -0.02, 0.08]), np.linspace(-0.3, 0.4, 7)
POSTURES, SAMPLES = 12, 5


def _log(seed: int = 1, *, mass: float = MASS, declared: float = 0.4, noise: float = 0.05) -> LoggedTorques:
    """Postures that an arm holds; of what hangs there, a part is declared."""
    rng = np.random.default_rng(seed)
    position = np.repeat(rng.uniform(-1.5, 1.5, (POSTURES, 7)), SAMPLES, axis=0)
    frames, flange = joint_frames(position)
    unit = holding_torques(frames[:, :, :3, 2], frames[:, :, :3, 3], flange, np.array([0.0, 0.0, -GRAVITY]))
    n = len(position)
    beyond = np.append(mass, mass * CENTRE) - declared * np.array([1.0, 0.0, 0.0, 0.1])
    error = noise * np.repeat(rng.normal(size=(POSTURES, 7)), SAMPLES, axis=0)
    return LoggedTorques(
        controller="franka",
        joints=tuple(f"joint_{k}" for k in range(1, 8)),
        stamp_ns=10_000_000 * np.arange(n),
        position=position,
        is_still=np.ones(n, dtype=bool),
        torque=unit @ beyond + BIAS + error,
        unit_torque=unit,
        declared_mass=np.full(n, declared),
        declared_centre=np.tile([0.0, 0.0, 0.1], (n, 1)),
        undetermined={},
        assumed=(),
    )


def _weighed(*logs: LoggedTorques) -> TorqueLoad:
    return load_of_torques(logs, (), "log")


def _numbers(weighed: TorqueLoad) -> dict[str, FloatArray]:
    load = weighed.load
    numbers = {
        "mass": load.mass_kg,
        "mass half-width": load.mass_half_width_95_kg,
        "centre": load.centre_of_mass_m,
        "centre half-width": load.centre_of_mass_half_width_95_m,
        "bias": [row.bias_Nm for row in weighed.joints],
        "residual": [row.residual_rms_Nm for row in weighed.joints],
        "postures": weighed.postures,
        "samples": weighed.samples,
    }
    return {name: np.array(values, dtype=np.float64) for name, values in numbers.items()}


def _heavier(log: LoggedTorques) -> LoggedTorques:
    return replace(log, torque=2.0 * log.torque, declared_mass=2.0 * log.declared_mass)


def _longer(log: LoggedTorques) -> LoggedTorques:
    """Lengths in a unit of half the size: a moment is twice as large, and that of a unit first moment is not."""
    unit = log.unit_torque * [2.0, 1.0, 1.0, 1.0]
    return replace(log, torque=2.0 * log.torque, unit_torque=unit, declared_centre=2.0 * log.declared_centre)


def _backwards(log: LoggedTorques) -> LoggedTorques:
    order = {name: getattr(log, name)[::-1] for name in ("position", "torque", "unit_torque")}
    return replace(log, **order)


def _other_joints(log: LoggedTorques) -> LoggedTorques:
    order = {name: getattr(log, name)[:, ::-1] for name in ("position", "torque", "unit_torque")}
    return replace(log, joints=log.joints[::-1], **order)


def _declared(log: LoggedTorques) -> LoggedTorques:
    """All is declared that was not: the controller holds it itself."""
    part = np.column_stack([log.declared_mass, log.declared_mass[:, None] * log.declared_centre])
    torque = log.torque + np.einsum("nda,na->nd", log.unit_torque, part)
    return replace(log, torque=torque, declared_mass=np.zeros(len(part)))


FORCES, LENGTHS = ("mass", "bias", "residual"), ("centre", "bias", "residual")
CHANGES: dict[str, tuple[Callable[[LoggedTorques], LoggedTorques], Callable[[str, FloatArray], FloatArray]]] = {
    "unit of force": (_heavier, lambda name, values: 2.0 * values if name.startswith(FORCES) else values),
    "unit of length": (_longer, lambda name, values: 2.0 * values if name.startswith(LENGTHS) else values),
    "order": (_backwards, lambda name, values: values),
    "joints": (_other_joints, lambda name, values: values[::-1] if name in ("bias", "residual") else values),
    "declared": (_declared, lambda name, values: values),
}


@pytest.mark.parametrize("change", CHANGES)
def test_quantities_change_with_units_and_order(change: str) -> None:
    """By the change of the quantity that its definition states, or not at all."""
    changed, expected = CHANGES[change]
    before, after = _numbers(_weighed(_log())), _numbers(_weighed(changed(_log())))
    for name, values in before.items():
        wanted = expected(name, values)
        np.testing.assert_allclose(after[name], wanted, rtol=SAME, atol=SAME * np.abs(wanted).max(), err_msg=name)


def test_torques_without_error_give_the_truth() -> None:
    """Mass, centre and biases, and nothing is left over."""
    weighed = _weighed(_log(noise=0.0))
    np.testing.assert_allclose(weighed.load.mass_kg, MASS, rtol=1e-9)
    np.testing.assert_allclose(weighed.load.centre_of_mass_m, CENTRE, atol=1e-9)
    np.testing.assert_allclose([row.bias_Nm for row in weighed.joints], BIAS, atol=1e-9)
    assert max(row.residual_rms_Nm for row in weighed.joints) < 1e-6
    assert (weighed.postures, weighed.samples) == (POSTURES, POSTURES * SAMPLES)


@pytest.mark.parametrize("largest_Nm", [0.01, 1.0, 100.0])
def test_joints_without_error_have_a_billionth_of_the_largest_torque(largest_Nm: float) -> None:
    """Of 1 N m at least, and the covariance is that of regression with this deviation."""
    log = _log(noise=0.0)
    unit = log.unit_torque[::SAMPLES]
    torque = unit @ np.append(MASS, MASS * CENTRE)
    values, covariance, deviation = _fit(torque * largest_Nm / np.abs(torque).max(), unit)
    least = 1e-9 * max(largest_Nm, 1.0)
    np.testing.assert_allclose(deviation, least, rtol=SAME)
    assert values[0] == pytest.approx(MASS * largest_Nm / np.abs(torque).max(), rel=SAME)
    design = (unit - unit.mean(axis=0)).reshape(-1, len(UNKNOWNS))
    np.testing.assert_allclose(covariance, np.linalg.inv(design.T @ design) * least**2, rtol=1e-6)


def test_errors_that_are_twice_as_large_make_intervals_twice_as_wide() -> None:
    """And leave twice as much over, of a size that is that of the errors."""
    once, twice = (_numbers(_weighed(_log(noise=noise))) for noise in (0.02, 0.04))
    for name in ("mass half-width", "residual"):
        np.testing.assert_allclose(twice[name], 2.0 * once[name], rtol=1e-6, err_msg=name)
    np.testing.assert_allclose(twice["centre half-width"], 2.0 * once["centre half-width"], rtol=0.02)
    np.testing.assert_allclose(np.sqrt((once["residual"] ** 2).mean()), 0.02, rtol=0.25)


def test_logs_of_two_loads_are_told_by_what_they_leave() -> None:
    """By less than a hundredth where the torques are nearly exact; logs of one load are not told."""
    (words,) = _weighed(_log(1, noise=1e-4), _log(2, mass=1.5 * MASS, noise=1e-4)).warnings
    assert words.endswith("a load of each log leaves 0 % of the residual")
    assert not _weighed(_log(1), _log(2)).warnings


def test_half_widths_are_those_of_the_dense_regression() -> None:
    """Of 80 postures whose joints have known errors of seven sizes: within a tenth, and residuals are these sizes."""
    sizes = np.array([0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1])
    rng = np.random.default_rng(21)
    log = _many(80, rng, sizes)
    weighed = _weighed(log)
    values, half, centre_half = _dense(log, sizes)
    np.testing.assert_allclose(weighed.load.mass_half_width_95_kg, half, rtol=0.1)
    np.testing.assert_allclose(weighed.load.centre_of_mass_half_width_95_m, centre_half, rtol=0.1)
    assert abs((weighed.load.mass_kg or 0.0) - values[0]) < 0.1 * half
    np.testing.assert_allclose([row.residual_rms_Nm for row in weighed.joints], sizes, rtol=0.25)


def _many(count: int, rng: np.random.Generator, sizes: FloatArray, mass: float = MASS) -> LoggedTorques:
    """Single samples in postures that are all others."""
    log = _log(int(rng.integers(1 << 30)), mass=mass, noise=0.0)
    position = rng.uniform(-1.5, 1.5, (count, 7))
    frames, flange = joint_frames(position)
    unit = holding_torques(frames[:, :, :3, 2], frames[:, :, :3, 3], flange, np.array([0.0, 0.0, -GRAVITY]))
    torque = unit @ np.append(mass, mass * CENTRE) + BIAS + sizes * rng.normal(size=(count, 7))
    return replace(
        log,
        stamp_ns=10_000_000 * np.arange(count),
        position=position,
        is_still=np.ones(count, dtype=bool),
        torque=torque,
        unit_torque=unit,
        declared_mass=np.zeros(count),
        declared_centre=np.zeros((count, 3)),
    )


def _design(unit: FloatArray) -> FloatArray:
    """Columns of the load, and one for the bias of each joint; a row for every torque."""
    return np.hstack([unit.reshape(-1, unit.shape[2]), np.tile(np.eye(7), (len(unit), 1))])


def _dense(log: LoggedTorques, sizes: FloatArray) -> tuple[FloatArray, float, FloatArray]:
    design, weight = _design(log.unit_torque), np.tile(1.0 / sizes, len(log.torque))
    covariance = np.linalg.inv((design * weight[:, None]).T @ (design * weight[:, None]))
    values = covariance @ (design.T @ (weight**2 * log.torque.ravel()))
    # by a difference of the quotient
    load, steps = values[:4], 1e-6 * np.eye(4)
    change = np.array([((load + one)[1:] / (load + one)[0] - load[1:] / load[0]) / 1e-6 for one in steps]).T
    error = np.sqrt(np.diag(change @ covariance[:4, :4] @ change.T))
    quantile = float(t.ppf(0.975, len(log.torque) - 1))
    return load, quantile * float(np.sqrt(covariance[0, 0])), quantile * error


@pytest.mark.parametrize(("count", "chance_decides"), [(2, True), (8, False)])
def test_loads_differ_where_the_f_test_and_the_residual_say_so(count: int, chance_decides: bool) -> None:
    """By the F test of nested regressions with a bias of each joint, 1 in 1000, and by less than 0.7 of the residual.

    Second loads that are heavier step by step: the first one that is told is the first one that both limits let pass.
    With two postures of each the chance decides, with eight the residual.
    """
    sizes, told, decided = np.full(7, 0.05), [], []
    for mass in MASS * np.geomspace(1.001, 1.5, 40):
        logs = [_many(count, np.random.default_rng(40 + k), sizes, own) for k, own in enumerate((MASS, mass))]
        parts = [_stays(log) for log in logs]
        torque = np.concatenate([log.torque for log in logs]).ravel() / 0.05
        unit = np.concatenate([log.unit_torque for log in logs]) / 0.05
        own = np.repeat([0, 1], count)
        both = np.concatenate([unit * (own == k)[:, None, None] for k in range(2)], axis=2)
        squares = [
            float(((torque - one @ np.linalg.pinv(one) @ torque) ** 2).sum()) for one in map(_design, (unit, both))
        ]
        freedom = torque.size - 7 - 8
        chance = f.sf((squares[0] - squares[1]) / 4 / (squares[1] / freedom), 4, freedom)
        share = np.sqrt(squares[1] / squares[0])
        told.append(bool(list(_loads_differ(parts, sizes))))
        decided.append((chance < 1e-3, share < 0.7))
        assert told[-1] == all(decided[-1])
    assert 0 < sum(told) < 40
    first = told.index(True)
    assert decided[first - 1] == ((False, True) if chance_decides else (True, False))


@pytest.mark.parametrize(("apart", "count"), [(0.0195, 6), (0.0205, 12)])
def test_postures_within_twenty_milliradians_are_one(apart: float, count: int) -> None:
    """Where one joint stands by less than that elsewhere, whether the arm goes there at once or comes back later."""
    rng = np.random.default_rng(71)
    first = rng.uniform(-1.5, 1.5, (6, 7))
    for order in (np.repeat(np.arange(6), 2), np.tile(np.arange(6), 2)):
        again = np.array([np.count_nonzero(order[:k] == one) for k, one in enumerate(order)])
        position = first[order] + apart * again[:, None] * np.eye(7)[3]
        log = replace(_many(12, rng, np.full(7, 0.01)), position=position)
        assert len(_postures(_stays(log)).torque) == count


def test_four_postures_are_enough_and_three_are_refused() -> None:
    """Three leave nothing to estimate an error from."""
    rng = np.random.default_rng(72)
    assert _weighed(_many(4, rng, np.full(7, 1e-3))).postures == 4
    with pytest.raises(FitError, match="at least 4 postures at rest, .*, got 3"):
        _weighed(_many(3, rng, np.full(7, 1e-3)))


@pytest.mark.parametrize(("share", "is_open"), [(0.9e-3, True), (1.2e-3, False)])
def test_a_load_is_open_where_postures_change_its_torques_by_a_thousandth(share: float, is_open: bool) -> None:
    """Of one unknown over the root of its squares, which is named; the others are as they were."""
    rng = np.random.default_rng(73)
    unit = rng.normal(size=(20, 7, 4))
    mean, change = unit[:, :, 2].mean(axis=0), unit[:, :, 2] - unit[:, :, 2].mean(axis=0)
    unit[:, :, 2] = mean + change * share * np.linalg.norm(mean) * np.sqrt(20.0) / np.linalg.norm(change)
    if is_open:
        with pytest.raises(FitError, match=f"leave open {UNKNOWNS[2]}"):
            _require_postures(unit, "log")
    else:
        _require_postures(unit, "log")
