# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device as an answer: its loads, its motions, and what is drawn of it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.device.components import device_load
from forcetorque.device.demands import DeviceDemands
from forcetorque.device.design import DeviceDesign, _load_row, design_device
from forcetorque.device.device_file import read_device
from forcetorque.device.excitation_and_predicted_errors import DeviceSpan
from forcetorque.device.figures import innermost_wrenches

BALL = 0.01
"""Share of the force that inertia adds at these speeds, at most."""

GAP_DEG = 3.0
"""What 4000 random directions may miss of a largest gap, in degrees: half their distance, some 2 degrees."""


@pytest.fixture(scope="module")
def design() -> DeviceDesign:
    """Three sensors in the stack, without what it excites and what is demanded of it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("forcetorque.device.design.device_demands", lambda _: DeviceDemands.model_construct())
        patch.setattr("forcetorque.device.design.device_span", lambda _: DeviceSpan.model_construct())
        return design_device(read_device().with_sensors(3))


def test_a_row_for_each_load(design: DeviceDesign) -> None:
    """Heavier loads make larger forces, moments and torques; with 35 kg the peaks are those of the thesis."""
    assert [row.load for row in design.loads] == ["empty carrier", *(f"{5 * k} kg" for k in range(1, 8))]
    for field in ("mass_kg", "force_N", "moment_Nm", "pitch_Nm", "yaw_Nm", "hinge_Nm"):
        values = [getattr(row, field) for row in design.loads]
        assert values == sorted(values)
    heaviest = design.loads[-1]
    assert (heaviest.pitch_Nm, heaviest.yaw_Nm) == pytest.approx((131.3495, 39.45), rel=BALL)


def test_peaks_are_weights_on_levers(design: DeviceDesign) -> None:
    """By hand: level, a load turns yaw and hinge by its centre of mass, and the innermost sensor by 245 mm."""
    assert len(design.loads) == 8
    for row in design.loads:
        level_Nm = STANDARD_GRAVITY * row.mass_kg * row.centre_m
        assert (row.yaw_Nm, row.hinge_Nm) == pytest.approx((level_Nm, level_Nm), rel=BALL), row.load
    heaviest = design.loads[-1]
    assert heaviest.moment_Nm == pytest.approx(STANDARD_GRAVITY * 35.0 * 0.245, rel=BALL)
    # the empty carrier weighs 2 kg of what the sensor bears; the other parts beyond it are in every row
    lightest = design.loads[0]
    assert heaviest.force_N - lightest.force_N == pytest.approx(STANDARD_GRAVITY * 33.0, rel=BALL)
    assert lightest.force_N > STANDARD_GRAVITY * 2.0


def test_the_largest_of_a_load_is_of_norms_at_the_innermost_sensor() -> None:
    """By hand: 3, 4, 12 have the norm 13, and 2, 3, 6 the norm 7; torques of motors count either way."""
    device = read_device().with_sensors(3)
    wrenches = {name: np.zeros((2, 6)) for name in device.sensor_names}
    wrenches["ft_1"] = np.array([[3.0, 4.0, 12.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 2.0, -3.0, 6.0]])
    torques = {"pitch": np.array([1.0, -9.0]), "yaw": np.array([5.0, 2.0]), "hinge": np.array([-0.5, 0.0])}
    response: Any = SimpleNamespace(wrenches=SimpleNamespace(of_name=wrenches.__getitem__), torque=torques.__getitem__)
    row = _load_row(device, device_load(device, 5.0), response)
    assert (row.force_N, row.moment_Nm) == pytest.approx((13.0, 7.0))
    assert (row.pitch_Nm, row.yaw_Nm, row.hinge_Nm) == (9.0, 5.0, 0.5)


def test_motions_have_the_heaviest_load_and_reach_the_largest_speeds(design: DeviceDesign) -> None:
    """A swing of half a turn is long enough for pitch to reach its 30 deg/s, a turn for yaw to reach its 60 deg/s."""
    assert len(design.trajectories) == len(design.motions) == 2
    for row, trajectory in zip(design.motions, design.trajectories.values(), strict=True):
        assert trajectory.load.mass_kg == pytest.approx(35.0)
        assert (row.pitch_deg_s, row.yaw_deg_s) == pytest.approx((30.0, 60.0), rel=1e-3)
        assert row.duration_s == trajectory.sampled(10.0)[0][-1]


def test_swapped_axes_reach_less_of_the_sphere(design: DeviceDesign) -> None:
    """With the same steps gravity leaves a larger gap between its directions (figure 6.6)."""
    assert [row.order for row in design.motions] == ["pitch, yaw, hinge", "yaw, pitch, hinge"]
    anywhere = np.random.default_rng(0).normal(size=(4000, 3))
    anywhere /= np.linalg.norm(anywhere, axis=1, keepdims=True)
    gaps = []
    for wrench in innermost_wrenches(design).values():
        reached = wrench[:, :3] / np.linalg.norm(wrench[:, :3], axis=1, keepdims=True)
        gaps.append(np.rad2deg(np.arccos((anywhere @ reached.T).max(axis=1).clip(-1.0, 1.0))).max())
    assert gaps[0] + GAP_DEG < gaps[1] < 90.0


def test_json_and_csv_hold_the_loads(design: DeviceDesign) -> None:
    """Numbers alone: motions and pictures are not part of it."""
    assert '"schema": "forcetorque/device/2"' in design.json_text()
    assert "trajectories" not in design.json_text()
    assert len(design.records()) == 8
