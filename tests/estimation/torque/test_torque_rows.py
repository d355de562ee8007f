# SPDX-License-Identifier: BSD-3-Clause
"""Rows and pictures of fused torques, by hand from sources and fusion."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, cast

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.estimation.section import FusionTable
from forcetorque.estimation.torque.covariance_fusion import Conflict, Disagreement, Fusion, Innovation
from forcetorque.estimation.torque.experiment_fusion import (
    MOST_JOINTS,
    IntervalFusion,
    TorqueFusion,
    summarise_fusion,
    torque_picture,
)
from forcetorque.estimation.torque.experiment_sources import SKIN_NOISE_SHARE, _errors
from forcetorque.estimation.torque.motor_torque import Friction
from forcetorque.estimation.torque.torque_source import TorqueSource
from forcetorque.robot.model import JointType

if TYPE_CHECKING:
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.recording.recording import Interval

WIDE = 1.959964
"""Standard deviations in half a 95 % interval of a normal distribution."""
START_NS = 5_000_000_000


def _experiment(**types: JointType) -> Experiment:
    model = SimpleNamespace(joints={name: SimpleNamespace(type=kind) for name, kind in types.items()})
    experiment = SimpleNamespace(
        name="arm",
        model=model,
        sensors=(),
        recording=SimpleNamespace(start_ns=START_NS),
        section=lambda _: FusionTable(model_deviation=0.1, false_alarm=0.02),
    )
    return cast("Experiment", experiment)


def _disagreement(chi2: float, degrees: int) -> Disagreement:
    """A fifth of it, with one degree of freedom, by what lasts."""
    return Disagreement(
        lasting=Innovation(chi2=0.2 * chi2, degrees_of_freedom=1),
        passing=Innovation(chi2=0.8 * chi2, degrees_of_freedom=degrees - 1),
    )


def _conflict(*suspects: str) -> Conflict:
    return Conflict(
        is_there=bool(suspects),
        everyone=_disagreement(60.0, 20),
        without={"ft": _disagreement(12.0, 8), "skin": _disagreement(50.0, 10)},
        suspects=suspects,
    )


def _fusion(torques: dict[str, FloatArray], joints: tuple[str, ...], start_ns: int = START_NS) -> IntervalFusion:
    """Each source has the variance 0.04 k^2 of the k-th joint; the last entry is the fused torque, with 0.01 k^2."""
    sizes = np.diag(np.arange(1.0, len(joints) + 1.0) ** 2)
    *names, fused = torques
    stamp_ns = start_ns + np.arange(len(torques[fused])) * 10_000_000
    sources = tuple(
        TorqueSource(
            name=name,
            joints=joints,
            stamp_ns=stamp_ns,
            torque=torques[name],
            noise=np.broadcast_to(0.03 * sizes, (len(stamp_ns), *sizes.shape)),
            lasting=np.broadcast_to(0.1 * np.sqrt(sizes), (len(stamp_ns), *sizes.shape)),
        )
        for name in names
    )
    fusion = Fusion(
        joints=joints,
        stamp_ns=stamp_ns,
        torque=torques[fused],
        covariance=np.broadcast_to(0.01 * sizes, (len(stamp_ns), *sizes.shape)),
        used=tuple(names),
        conflict=_conflict("ft"),
        windows=(_conflict("ft"), _conflict(), _conflict("ft", "skin"), _conflict("ft"), _conflict("skin")),
    )
    return IntervalFusion(interval=cast("Interval", SimpleNamespace(label="fit")), sources=sources, fusion=fusion)


def _summary() -> TorqueFusion:
    """Two joints, of which one slides; the skin is silent on the second, and in one sample on the first."""
    ft, skin = np.array([[1.0, 2.0], [3.0, 5.0], [8.0, 5.0]]), np.full((3, 2), np.nan)
    skin[:2, 0] = [2.0, 5.0]
    fused = np.array([[1.5, 2.0], [4.0, 5.0], [8.0, 4.0]])
    friction = Friction(
        joint="knee",
        coefficients=np.array([1.5, 0.6, 0.08, 0.1]),
        covariance=np.diag([0.04, 0.0009, 1.0, 1.0]),
        variance=0.25,
        noise_time_s=0.0,
        standstill=0.02,
    )
    one = _fusion({"ft": ft, "skin": skin, "fused": fused}, ("knee", "slide"))
    return summarise_fusion(_experiment(knee=JointType.REVOLUTE, slide=JointType.PRISMATIC), [one], (friction,))


def test_rows_of_torques_by_hand() -> None:
    """Means, half of the intervals of a sample, and differences from the fused torque, over what a source knows."""
    summary = _summary()
    assert summary.false_alarm == 0.02
    by_hand = {
        ("knee", "ft"): (3, 4.0, 0.2, np.sqrt((0.25 + 1.0) / 3.0)),
        ("knee", "skin"): (2, 3.5, 0.2, np.sqrt((0.25 + 1.0) / 2.0)),
        ("knee", "fused"): (3, 4.5, 0.1, 0.0),
        ("slide", "ft"): (3, 4.0, 0.4, np.sqrt(1.0 / 3.0)),
        ("slide", "skin"): (0, None, None, None),
        ("slide", "fused"): (3, 11.0 / 3.0, 0.2, 0.0),
    }
    assert [(row.joint, row.source) for row in summary.torques] == list(by_hand)
    for row, (samples, mean, deviation, apart) in zip(summary.torques, by_hand.values(), strict=True):
        assert row.unit == {"knee": "N m", "slide": "N"}[row.joint]
        assert row.samples == samples
        values = (row.mean, row.half_width_95, row.from_fused)
        if mean is None or deviation is None:
            assert values == (None, None, None)
        else:
            assert values == pytest.approx((mean, WIDE * deviation, apart), rel=1e-5)


def test_rows_of_sources_by_hand() -> None:
    """What the disagreement has more with a source than without it, and the share of windows that name it alone."""
    ft, skin = _summary().sources
    assert (ft.innovation, ft.degrees_of_freedom) == (pytest.approx((60.0 - 12.0) / 12.0), 12)
    assert (skin.innovation, skin.degrees_of_freedom) == (pytest.approx((60.0 - 50.0) / 10.0), 10)
    assert (ft.windows_percent, skin.windows_percent) == (pytest.approx(40.0), pytest.approx(20.0))
    assert (ft.verdict, skin.verdict) == ("in conflict, left out", "used")


def test_rows_of_friction_by_hand() -> None:
    """Coefficients in the order of the model, half of their intervals, and the standard deviation of what is left."""
    (row,) = _summary().friction
    assert (row.joint, row.coulomb, row.viscous, row.inertia, row.offset) == ("knee", 1.5, 0.6, 0.08, 0.1)
    half_widths = (row.coulomb_half_width_95, row.viscous_half_width_95)
    assert half_widths == pytest.approx((WIDE * 0.2, WIDE * 0.03), rel=1e-5)
    assert row.deviation == 0.5


def test_a_picture_has_the_joints_that_change_most() -> None:
    """Eight rotary joints, two with little change; both intervals in order of time with a gap after each."""
    joints = tuple(f"j{k}" for k in range(8))
    sizes = np.array([3.0, 0.1, 5.0, 2.0, 8.0, 0.2, 6.0, 4.0])
    first, second = (sizes * np.array([[0.0], [1.0], [sign]]) for sign in (1.0, -1.0))
    early, late = (
        _fusion({"ft": torque, "fused": 10.0 + torque}, joints, START_NS + round(seconds * 1e9))
        for torque, seconds in ((first, 2.0), (second, 7.0))
    )
    kinds = dict.fromkeys(joints, JointType.REVOLUTE)
    picture = torque_picture(_experiment(**kinds), fusions=[late, early])
    drawn = [0, 2, 3, 4, 6, 7]
    assert len(picture.joints) == MOST_JOINTS
    assert picture.joints == tuple(joints[k] for k in drawn)
    assert picture.left_out == ("j1", "j5")
    np.testing.assert_allclose(picture.seconds, [2.0, 2.01, 2.02, 2.02, 7.0, 7.01, 7.02, 7.02], rtol=1e-9)
    gap = np.full((1, 6), np.nan)
    expected = np.concatenate([first[:, drawn], gap, second[:, drawn], gap])
    np.testing.assert_array_equal(picture.torques["ft"], expected)
    np.testing.assert_array_equal(picture.torques["fused"], 10.0 + expected)
    deviations = np.where(np.isnan(expected), np.nan, 0.2 * (1.0 + np.array(drawn)))
    np.testing.assert_allclose(picture.deviations["ft"], deviations)


def test_errors_of_a_wrench_are_stated_as_standard_deviations() -> None:
    """Their squares are the variances of the noise; each lasting error acts on its own component."""
    deviations = np.array([0.1, 0.2, 0.3, 0.01, 0.02, 0.03])
    noise, lasting = _errors("sensor", deviations, 2.0 * deviations)
    np.testing.assert_allclose(noise, np.diag([0.01, 0.04, 0.09, 1e-4, 4e-4, 9e-4]))
    np.testing.assert_allclose(lasting, np.diag(2.0 * deviations))


def test_neither_part_of_the_error_of_skin_is_far_too_small() -> None:
    """If all of it were noise, or all lasting, its standard deviation is stated too small by 1.41 at most."""
    assert max(SKIN_NOISE_SHARE**-0.5, (1.0 - SKIN_NOISE_SHARE) ** -0.5) == pytest.approx(1.41, abs=0.005)
