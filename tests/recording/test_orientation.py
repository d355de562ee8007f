# SPDX-License-Identifier: BSD-3-Clause
"""Orientations become gravity: every form and sense says the same of one rotation, and what is none is refused."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import FormatError, UnitError
from forcetorque.recording.orientation import (
    ROLL_PITCH_YAW,
    EulerAxes,
    OrientationForm,
    OrientationLayout,
    OrientationSense,
    orientation_signals,
)
from forcetorque.recording.stream import Signal

ROUNDING = 1e-12
"""A few products of numbers up to 10."""
WORLD_R_SENSOR = Rotation.random(20, random_state=5)
DOWN = np.array([0.0, 0.0, -9.80665])
FORMS = [
    (OrientationForm.QUAT_XYZW, None, None, "1", lambda r: r.as_quat()),
    (OrientationForm.QUAT_WXYZ, None, None, "1", lambda r: np.roll(r.as_quat(), 1, axis=1)),
    (OrientationForm.MATRIX_ROWS, None, None, "1", lambda r: r.as_matrix().reshape(-1, 9)),
    (OrientationForm.MATRIX_COLUMNS, None, None, "1", lambda r: r.as_matrix().transpose(0, 2, 1).reshape(-1, 9)),
    (OrientationForm.EULER, "zyx", EulerAxes.MOVING, "deg", lambda r: r.as_euler("ZYX", degrees=True)),
    (OrientationForm.EULER, "xyz", EulerAxes.FIXED, "rad", lambda r: r.as_euler("xyz")),
    (OrientationForm.EULER, "zxz", EulerAxes.FIXED, "rad", lambda r: r.as_euler("zxz")),
    (OrientationForm.ROTATION_VECTOR, None, None, "rad", lambda r: r.as_rotvec()),
    (OrientationForm.ROTATION_VECTOR, None, None, "deg", lambda r: r.as_rotvec(degrees=True)),
]


def _signals(numbers: np.ndarray, layout: OrientationLayout, unit: str = "1") -> dict[str, Signal]:
    return orientation_signals(numbers, layout, unit=unit, frame="ft", stream="pose")[0]


def _quaternions(sense: OrientationSense = OrientationSense.SENSOR_TO_WORLD) -> OrientationLayout:
    return OrientationLayout(form=OrientationForm.QUAT_XYZW, sense=sense)


@pytest.mark.parametrize("sense", OrientationSense)
@pytest.mark.parametrize(("form", "axes", "about", "unit", "written"), FORMS)
def test_every_form_and_sense_gives_the_same_gravity(form, axes, about, unit, written, sense) -> None:
    """Gravity in the sensor is what SciPy makes of the rotation, whatever the log wrote of it."""
    rotation = WORLD_R_SENSOR if sense is OrientationSense.SENSOR_TO_WORLD else WORLD_R_SENSOR.inv()
    layout = OrientationLayout(form=form, sense=sense, axes=axes, about=about)
    signals = _signals(written(rotation), layout, unit)
    np.testing.assert_allclose(signals["gravity"].values, WORLD_R_SENSOR.inv().apply(DOWN), atol=ROUNDING)
    np.testing.assert_allclose(
        signals["orientation"].values.reshape(-1, 3, 3), WORLD_R_SENSOR.as_matrix(), atol=ROUNDING
    )
    assert signals["gravity"].frame == "ft"


def test_order_and_sense_matter() -> None:
    """Negative control: read in another order, or in the other sense, the same numbers give another gravity."""
    right = _signals(WORLD_R_SENSOR.as_quat(), _quaternions())["gravity"].values
    other = OrientationLayout(form=OrientationForm.QUAT_WXYZ, sense=OrientationSense.SENSOR_TO_WORLD)
    assert np.abs(_signals(WORLD_R_SENSOR.as_quat(), other)["gravity"].values - right).max() > 5.0
    back = _signals(WORLD_R_SENSOR.as_quat(), _quaternions(OrientationSense.WORLD_TO_SENSOR))["gravity"].values
    assert np.abs(back - right).max() > 5.0


def test_gravity_of_the_world_is_stated() -> None:
    """A base that hangs from the ceiling falls along its +z, of a place with another gravity."""
    layout = OrientationLayout(
        form=OrientationForm.QUAT_XYZW,
        sense=OrientationSense.SENSOR_TO_WORLD,
        gravity_direction=np.array([0.0, 0.0, 2.0]),
        gravity=9.82,
    )
    np.testing.assert_allclose(_signals(np.array([[0.0, 0.0, 0.0, 1.0]]), layout)["gravity"].values, [[0, 0, 9.82]])


def test_the_orientation_that_is_kept_tells_the_other_sense_too() -> None:
    """R g is gravity of the world, and R of that is gravity in the sensor, were the sense the other one."""
    numbers = WORLD_R_SENSOR.as_quat()
    signals = _signals(numbers, _quaternions())
    kept, gravity = signals["orientation"].values.reshape(-1, 3, 3), signals["gravity"].values
    in_world = np.einsum("nij,nj->ni", kept, gravity)
    np.testing.assert_allclose(in_world, np.tile(DOWN, (len(numbers), 1)), atol=10 * ROUNDING)
    other = _signals(numbers, _quaternions(OrientationSense.WORLD_TO_SENSOR))["gravity"].values
    np.testing.assert_allclose(np.einsum("nij,nj->ni", kept, in_world), other, atol=10 * ROUNDING)


def test_missing_rows_are_missing() -> None:
    """A row of NaN is a gap in both signals; half a row is an error that names it."""
    numbers = WORLD_R_SENSOR.as_quat()
    numbers[3] = np.nan
    signals = _signals(numbers, _quaternions())
    assert np.isnan(signals["gravity"].values[3]).all()
    assert np.isnan(signals["orientation"].values[3]).all()
    assert np.isfinite(np.delete(signals["gravity"].values, 3, axis=0)).all()
    numbers[5, 0] = np.nan
    with pytest.raises(FormatError, match=r"row 6: orientation: expected 4 numbers.*got 3"):
        _signals(numbers, _quaternions())


def test_what_is_no_rotation_is_refused() -> None:
    """Norms, right angles, mirrors, counts and units are checked, and the row is named."""
    stretched = WORLD_R_SENSOR.as_quat()
    stretched[7] *= 1.05
    with pytest.raises(FormatError, match=r"row 8: orientation: expected a quaternion of norm 1, got one of 1\.05"):
        _signals(stretched, _quaternions())
    rows = OrientationLayout(form=OrientationForm.MATRIX_ROWS, sense=OrientationSense.SENSOR_TO_WORLD)
    matrices = WORLD_R_SENSOR.as_matrix()
    matrices[2, :, 0] *= -1.0
    with pytest.raises(FormatError, match=r"row 3: orientation: .* mirrors"):
        _signals(matrices.reshape(-1, 9), rows)
    matrices[1, 0, 0] += 0.3
    with pytest.raises(FormatError, match=r"row 2: orientation: expected a rotation matrix, of rows of length 1"):
        _signals(matrices.reshape(-1, 9), rows)
    with pytest.raises(FormatError, match="expected 9 numbers for each, got 4"):
        _signals(stretched, rows)
    with pytest.raises(UnitError, match="expected a unit that converts to 1, got 'deg'"):
        _signals(matrices.reshape(-1, 9), rows, "deg")
    with pytest.raises(FormatError, match=r"row 2: orientation: expected three angles, got \[0\.0, inf, 0\.0\]"):
        _signals(np.array([[0.0, 1.0, 2.0], [0.0, np.inf, 0.0]]), ROLL_PITCH_YAW, "rad")


def test_rounded_numbers_are_repaired() -> None:
    """Numbers of three decimals pass, and give gravity of the stated length."""
    gravity = _signals(np.round(WORLD_R_SENSOR.as_quat(), 3), _quaternions())["gravity"].values
    np.testing.assert_allclose(np.linalg.norm(gravity, axis=1), 9.80665, rtol=1e-12)


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        ({"form": OrientationForm.EULER}, "expected axes and about"),
        ({"form": OrientationForm.QUAT_XYZW, "axes": "zyx", "about": EulerAxes.FIXED}, "neither axes nor about"),
        ({"form": OrientationForm.EULER, "axes": "zzy", "about": EulerAxes.FIXED}, "no two alike in a row"),
        ({"form": OrientationForm.EULER, "axes": "ZYX", "about": EulerAxes.FIXED}, "three of x, y, z"),
        ({"form": OrientationForm.QUAT_XYZW, "gravity_direction": np.zeros(3)}, "that is not zero"),
        ({"form": OrientationForm.QUAT_XYZW, "gravity": np.nan}, "gravity above 0"),
    ],
)
def test_a_layout_says_all_and_no_more(stated, message) -> None:
    """Euler angles need their axes, nothing else has any, and gravity has a direction and a size."""
    with pytest.raises(FormatError, match=message):
        OrientationLayout(sense=OrientationSense.SENSOR_TO_WORLD, **stated)


def test_degrees_that_are_stated_as_rad_are_a_finding() -> None:
    """Angles of more than one turn in rad are doubted; the same numbers in degrees are not."""
    angles = WORLD_R_SENSOR.as_euler("ZYX", degrees=True)
    layout = OrientationLayout(
        form=OrientationForm.EULER, sense=OrientationSense.SENSOR_TO_WORLD, axes="zyx", about=EulerAxes.MOVING
    )
    _, (finding,) = orientation_signals(angles, layout, unit="rad", frame="ft", stream="pose")
    assert (finding.kind, finding.stream, finding.unit) == ("euler_units", "pose", "rad")
    assert finding.count == np.count_nonzero(np.abs(angles).max(axis=1) > 2 * np.pi)
    assert orientation_signals(angles, layout, unit="deg", frame="ft", stream="pose")[1] == ()
    assert orientation_signals(np.deg2rad(angles), layout, unit="rad", frame="ft", stream="pose")[1] == ()
