# SPDX-License-Identifier: BSD-3-Clause
"""The space that a device sweeps, compared with circles and rectangles by hand."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.device.components import device_load
from forcetorque.device.device_file import read_device
from forcetorque.device.motion import Sequence, twelve_steps
from forcetorque.device.motors_hinge_and_envelope import ARM_RADIUS_M, EnvelopeRow, envelope

DEVICE = read_device().with_sensors(3)
LOAD = device_load(DEVICE, 35.0)
HINGE_M = 0.08 + 0.0189 + 3 * 0.04 + 0.04
"""From the axis of pitch to that of the hinge: both motors, three sensors, the bracket."""
CIRCLE = 0.006
"""Share by which a circle of 36 corners is smaller."""


def _swept(sequence: Sequence) -> dict[str, EnvelopeRow]:
    poses = sequence.still_poses(DEVICE, LOAD, spacing_deg=3.0)
    return {row.view: row for row in envelope(DEVICE, LOAD, poses)}


def test_a_straight_arm_that_stands_still() -> None:
    """From behind it is the disc of the plates; from above a rectangle from the motor to the last plate, and a cap."""
    swept = _swept(Sequence.of(DEVICE, "rest", [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]))
    weights = DEVICE.weights
    corners = 36  # of a regular polygon on the rim
    disc = 0.5 * corners * np.sin(2.0 * np.pi / corners) * weights.radius_m**2
    assert swept["behind"].hull_m2 == pytest.approx(disc, rel=1e-9)
    assert disc == pytest.approx(np.pi * weights.radius_m**2, rel=CIRCLE)
    length = ARM_RADIUS_M + HINGE_M + weights.foot_m + 7 * weights.height_m
    above = swept["above"]
    np.testing.assert_allclose([above.width_m, above.height_m], [length, 2.0 * weights.radius_m], atol=2e-3)


def test_the_motion_is_contained_in_a_square_metre_and_a_half() -> None:
    """Seen from the side, where it is largest: half a circle of the farthest corner of the plates, and the arm."""
    swept = _swept(twelve_steps(DEVICE))
    assert max(row.rectangle_m2 for row in swept.values()) == swept["the side"].rectangle_m2 < 1.5
    reach = np.hypot(HINGE_M + DEVICE.weights.foot_m + 7 * DEVICE.weights.height_m, DEVICE.weights.radius_m)
    assert swept["the side"].height_m == pytest.approx(2.0 * reach, rel=0.01)
    for row in swept.values():
        assert row.hull_m2 < row.rectangle_m2


def test_an_arm_three_times_as_long_is_not() -> None:
    """Negative control: the limit is no matter of course."""
    part = DEVICE.pitch.part.model_copy(update={"height_m": 0.6})
    longer = DEVICE.changed(pitch=DEVICE.pitch.model_copy(update={"part": part}))
    poses = twelve_steps(longer).still_poses(longer, LOAD, spacing_deg=10.0)
    assert max(row.rectangle_m2 for row in envelope(longer, LOAD, poses)) > 1.5


def test_a_view_is_measured_by_its_outline() -> None:
    """A right triangle of 3 by 4 in either order: its area is half of that of the rectangle around it."""
    corners = np.array([[1.0, 2.0], [4.0, 2.0], [1.0, 6.0]])
    for outline in (corners, corners[::-1]):
        row = EnvelopeRow.of("above", outline)
        assert (row.width_m, row.height_m) == (3.0, 4.0)
        assert (row.rectangle_m2, row.hull_m2) == (pytest.approx(12.0), pytest.approx(6.0))
