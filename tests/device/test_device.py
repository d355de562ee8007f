# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device as an answer: its loads, its motions, and what is drawn of it."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.device.demands import DeviceDemands
from forcetorque.device.design import DeviceDesign, design_device
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
