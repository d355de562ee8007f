# SPDX-License-Identifier: BSD-3-Clause
"""Every quantity of a load by joint torques changes with units, signs and order as that quantity must."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.arm_log import LoggedTorques, holding_torques
from forcetorque.formats.franka.kinematics import joint_frames
from forcetorque.payload.load_by_joint_torques import TorqueLoad, load_of_torques
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
