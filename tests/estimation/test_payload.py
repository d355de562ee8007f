# SPDX-License-Identifier: BSD-3-Clause
"""Payload identification: exact on exact data, honest about noise, and equal to a real sensor's known load."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.errors import FitError, ShapeError
from forcetorque.estimation import identify_payload
from forcetorque.exchange.tabular import TableLayout, TableSignal, read_table
from forcetorque.robot import ForceTorqueSensor, JointMotion, RobotModel, RootMotion, build_tree, expected_wrenches
from forcetorque.robot.model import Joint, JointType, SensorFrame
from forcetorque.spatial import Inertia, MeasureDirection

MASS, CENTRE = 1.3, np.array([0.01, -0.02, 0.06])
BIAS = np.array([5.0, -3.0, 12.0, 0.5, -0.2, 0.1])
EXACT = 1e-10
"""kg, m, N, N m: rounding of a least-squares problem of condition below 100."""
DIRECTIONS = list(MeasureDirection)


def _poses(count: int, seed: int) -> np.ndarray:
    """Proper accelerations of still poses in random directions."""
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    return 9.81 * directions / np.linalg.norm(directions, axis=1, keepdims=True)


def _reading(acceleration: np.ndarray, direction: MeasureDirection) -> np.ndarray:
    """What the library's own dynamics expect of a sensor with this load, plus the bias."""
    load = Inertia.about_centre_of_mass(mass=MASS, centre_of_mass=CENTRE, second_moment=np.zeros((3, 3)))
    joint = Joint(
        name="mount", type=JointType.FIXED, parent="flange", child="load", parent_H_child=np.eye(4), axis=[1.0, 0, 0]
    )
    sensor = ForceTorqueSensor(
        name="ft", joint="mount", frame=SensorFrame.CHILD, direction=direction, child_H_sensor=np.eye(4)
    )
    model = RobotModel(
        name="load", links={"flange": Inertia.zero(), "load": load}, joints={"mount": joint}, sensors={"ft": sensor}
    )
    still = np.zeros_like(acceleration)
    root = RootMotion(proper_acceleration=acceleration, angular_velocity=still, angular_acceleration=still)
    joints = JointMotion.at_rest((), np.empty((len(acceleration), 0)))
    return expected_wrenches(build_tree(model, "flange"), joints, root)["ft"] + BIAS


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_exact_data_give_the_exact_load(direction: MeasureDirection) -> None:
    """Mass, centre of mass and bias come back for both senses of the reading."""
    acceleration = _poses(8, 1)
    payload = identify_payload(_reading(acceleration, direction), acceleration, np.arange(8.0), direction=direction)
    assert payload.mass == pytest.approx(MASS, abs=EXACT)
    np.testing.assert_allclose(payload.centre_of_mass, CENTRE, atol=EXACT)
    np.testing.assert_allclose(payload.bias, BIAS, atol=EXACT)
    assert payload.residual_rms.max() < EXACT
    np.testing.assert_allclose(payload.inertia().first_moment, MASS * CENTRE, atol=EXACT)


def test_the_wrong_sense_is_refused() -> None:
    """Negative control: the other sense of the reading needs a negative mass."""
    acceleration = _poses(8, 2)
    reading = _reading(acceleration, MeasureDirection.CHILD_TO_PARENT)
    with pytest.raises(FitError, match="positive"):
        identify_payload(reading, acceleration, np.arange(8.0), direction=MeasureDirection.PARENT_TO_CHILD)


def test_standard_errors_are_those_of_repeated_measurements() -> None:
    """Over 300 noisy repetitions the scatter of mass and centre is what each one said of itself."""
    acceleration = _poses(20, 3)
    clean = _reading(acceleration, MeasureDirection.CHILD_TO_PARENT)
    rng = np.random.default_rng(4)
    found = [
        identify_payload(
            clean + rng.normal(size=clean.shape) * [0.2, 0.2, 0.2, 0.01, 0.01, 0.01],
            acceleration,
            None,
            direction=MeasureDirection.CHILD_TO_PARENT,
        )
        for _ in range(300)
    ]
    # the standard deviation of 300 values is known to 4 %, three times that is allowed
    assert np.std([p.mass for p in found]) == pytest.approx(np.mean([p.mass_error for p in found]), rel=0.13)
    scatter = np.std([p.centre_of_mass for p in found], axis=0)
    np.testing.assert_allclose(scatter, np.mean([p.centre_of_mass_error for p in found], axis=0), rtol=0.13)


@pytest.mark.parametrize(
    "acceleration",
    [
        np.tile([0.0, 0.0, 9.81], (10, 1)),
        9.81 * np.array([[0, 0, 1], [0, 0, -1], [0, 0, 1], [0, 0, -1.0]]),
        _poses(3, 5),
    ],
    ids=["one pose", "one axis", "three poses"],
)
def test_too_few_turns_are_refused(acceleration: np.ndarray) -> None:
    """Poses that leave the centre of mass open are an error that says what to do."""
    with pytest.raises(FitError, match="turn the sensor about two axes"):
        identify_payload(
            np.zeros((len(acceleration), 6)), acceleration, None, direction=MeasureDirection.CHILD_TO_PARENT
        )


def test_shapes_are_checked() -> None:
    """Arrays that do not fit each other are refused."""
    with pytest.raises(ShapeError, match="expected reading"):
        identify_payload(np.zeros((5, 6)), np.zeros((4, 3)), None, direction=MeasureDirection.CHILD_TO_PARENT)


@pytest.mark.real_data
def test_a_real_wrist_sensors_load(data_dir: Path) -> None:
    """24 still poses of an ATI Gamma: 0.932 kg, 44 mm along z, residuals of .13 .05 .06 N."""
    layout = TableLayout(
        stamp=None,
        signals=(
            TableSignal(
                quantity="wrench",
                columns=("fx", "fy", "fz", "tx", "ty", "tz"),
                units=("N", "N", "N", "N m", "N m", "N m"),
                frame="ft",
            ),
            TableSignal(quantity="gravity", columns=("gx", "gy", "gz"), units=("m/s2",) * 3, frame="ft"),
        ),
    )
    path = data_dir / "ati_gamma_kuka_med14_skrede" / "0-calibration_fts-accel.csv"
    (table,) = read_table(path, layout, stream="wrist", clock="none").streams
    payload = identify_payload(
        table.signal("wrench").values,
        -table.signal("gravity").values,
        None,
        direction=MeasureDirection.CHILD_TO_PARENT,
    )
    assert payload.count == 24
    assert payload.mass == pytest.approx(0.932, abs=0.0005)
    np.testing.assert_allclose(payload.centre_of_mass, [0.0003, 0.0, 0.0439], atol=1e-4)
    np.testing.assert_allclose(payload.residual_rms[:3], [0.13, 0.05, 0.06], atol=0.005)
