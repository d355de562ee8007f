# SPDX-License-Identifier: BSD-3-Clause
"""What a correction does to readings, and how it comes from a calibration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, FormatError, RecordingError, SerialNumberError, ShapeError
from forcetorque.calibration.export.wholebodydynamics import SensorCorrection, corrected, from_calibration
from forcetorque.experiment.calibration.calibration_file import Calibration
from tests.calibration.export.wholebodydynamics.device import bottle
from tests.scenes.calibrations import FACTORY, MOUNTED, make_calibration, make_variable

SOLVE_ROUNDING = 1e-10
"""Relative to the largest wrench: eps times the condition number of the prior, about 1e4 with rows in N and N m."""

READING = np.array([1.0, 10.0, 100.0, 2.0, 4.0, 8.0])


def _correction(**changes: object) -> SensorCorrection:
    """Correction with one entry off the diagonal, so that rows and columns differ."""
    matrix = np.diag([2.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    matrix[0, 1] = 0.5
    arguments: dict[str, object] = {"sensor": "leg_ft", "secondary_matrix": matrix, "offset": [1, 2, 3, 4, 5, 6]}
    return SensorCorrection(**(arguments | changes))  # type: ignore[arg-type]


def test_a_correction_by_hand() -> None:
    """Fx = 2 * 1 + 0.5 * 10 + 1 = 8; every other component is the reading plus its offset."""
    np.testing.assert_array_equal(corrected(_correction(), READING), [8.0, 12.0, 103.0, 6.0, 9.0, 14.0])


def test_the_temperature_acts_from_its_reference() -> None:
    """Three degrees above 20 add three times the coefficients; 20 degrees add nothing."""
    plain = corrected(_correction(), READING)
    warm = _correction(temperature_coefficients=[0.5, 0, 0, 0, 0, -1], reference_temperature=20.0)
    np.testing.assert_array_equal(corrected(warm, READING, 20.0), plain)
    np.testing.assert_array_equal(corrected(warm, READING, 23.0) - plain, [1.5, 0, 0, 0, 0, -3])


def test_many_readings_are_corrected_like_one() -> None:
    """Readings and temperatures keep their axes; a temperature may stand for all readings."""
    warm = _correction(temperature_coefficients=np.arange(6.0), reference_temperature=25.0)
    rng = np.random.default_rng(1)
    readings, temperatures = rng.normal(size=(3, 4, 6)), rng.normal(size=(3, 4))
    many, at_once = corrected(warm, readings, temperatures), corrected(warm, readings, 30.0)
    compared = 0
    for index in np.ndindex(3, 4):
        np.testing.assert_allclose(many[index], corrected(warm, readings[index], temperatures[index]), rtol=1e-14)
        np.testing.assert_allclose(at_once[index], corrected(warm, readings[index], 30.0), rtol=1e-14)
        compared += 1
    assert compared == 12


def test_a_temperature_that_is_needed_must_be_given() -> None:
    """The device would take 0 degC; nothing is guessed here. Without coefficients none is needed."""
    warm = _correction(temperature_coefficients=np.ones(6), reference_temperature=25.0)
    with pytest.raises(RecordingError, match=r"temperature: expected that of sensor 'leg_ft' in degC.*got none"):
        corrected(warm, READING)
    with pytest.raises(ShapeError, match=r"temperature: expected shape \(\) or \(5,\), got \(4,\)"):
        corrected(warm, np.zeros((5, 6)), np.zeros(4))
    with pytest.raises(ShapeError, match="f_in"):
        corrected(_correction(), np.zeros(5))
    corrected(_correction(), READING)


def test_the_corrected_stream_is_what_the_calibration_says() -> None:
    """Readings made with the prior, corrected, are the wrenches of the calibration: f = S (C_prior raw) + o."""
    calibration = make_calibration()
    raw = np.random.default_rng(2).normal(size=(50, 6)) * 1000
    stream, expected = raw @ FACTORY.T, calibration.apply(raw, serial="SN001")
    correction = from_calibration(calibration)
    assert correction.sensor == "leg_ft"
    scale = np.abs(expected).max()
    np.testing.assert_allclose(corrected(correction, stream), expected, rtol=0, atol=SOLVE_ROUNDING * scale)
    wrong = {
        "offset subtracted": SensorCorrection(
            sensor="leg_ft", secondary_matrix=correction.secondary_matrix, offset=-correction.offset
        ),
        "matrix transposed": SensorCorrection(
            sensor="leg_ft", secondary_matrix=correction.secondary_matrix.T, offset=correction.offset
        ),
        "factors swapped": SensorCorrection(
            sensor="leg_ft", secondary_matrix=np.linalg.solve(FACTORY, MOUNTED), offset=correction.offset
        ),
    }
    for name, other in wrong.items():
        assert np.abs(corrected(other, stream) - expected).max() > 0.01 * scale, name
    assert len(wrong) == 3


COLD, WARM = 22.0, 41.0
"""Temperatures that differ from every reference value here; degC."""
STREAM = make_calibration(
    matrix=1.1 * FACTORY + 0.001,
    offset=np.array([-30.0, 12.0, 5.0, -1.0, 0.5, 0.7]),
    variables=(make_variable(reference_value=35.0, coefficients=np.array([0.5, -0.2, 0.9, -0.03, 0.02, 0.01])),),
)
"""An earlier calibration of the same sensor, with an offset, coefficients and reference of its own."""
NEW = make_calibration(variables=(make_variable(),))


def _readings() -> tuple[FloatArray, FloatArray]:
    rng = np.random.default_rng(6)
    return rng.normal(size=(50, 6)) * 1000, rng.uniform(COLD, WARM, size=50)


def test_temperature_and_prior_give_the_wrenches_of_the_calibration() -> None:
    """A stream of the prior matrix alone, corrected at each temperature, is what the calibration says there."""
    raw, degrees = _readings()
    expected = NEW.apply(raw, serial="SN001", variables={"temperature": degrees})
    correction = from_calibration(NEW)
    assert correction.reference_temperature == NEW.variables[0].reference_value
    close = SOLVE_ROUNDING * np.abs(expected).max()
    np.testing.assert_allclose(corrected(correction, raw @ FACTORY.T, degrees), expected, rtol=0, atol=close)
    assert np.abs(corrected(correction, raw @ FACTORY.T, 29.3) - expected).max() > 1.0  # negative control


def test_a_stream_that_is_calibrated_with_temperature_is_taken_back_first() -> None:
    """With offset, coefficients and another reference in the stream the result is the new calibration's, exactly."""
    raw, degrees = _readings()
    expected = NEW.apply(raw, serial="SN001", variables={"temperature": degrees})
    stream = STREAM.apply(raw, serial="SN001", variables={"temperature": degrees})
    correction = from_calibration(NEW, stream=STREAM)
    close = SOLVE_ROUNDING * np.abs(expected).max()
    np.testing.assert_allclose(corrected(correction, stream, degrees), expected, rtol=0, atol=close)
    assert correction.temperature_coefficients is not None
    secondary, (old,), (new,) = correction.secondary_matrix, STREAM.variables, NEW.variables
    wrong = {
        "offset of the stream forgotten": {"offset": NEW.offset},
        "coefficients of the stream forgotten": {"temperature_coefficients": new.coefficients},
        "references taken for one": {"offset": NEW.offset - secondary @ STREAM.offset},
        "reference of the stream": {"reference_temperature": old.reference_value},
        "as if the stream were the prior's": {"secondary_matrix": from_calibration(NEW).secondary_matrix},
    }
    for name, change in wrong.items():
        other = corrected(replace(correction, **change), stream, degrees)  # type: ignore[arg-type]
        assert np.abs(other - expected).max() > 0.1, name
    assert len(wrong) == 5


def test_a_stream_without_temperature_may_get_one() -> None:
    """An earlier calibration without variables is taken back by its matrix and offset."""
    raw, degrees = _readings()
    plain = STREAM.model_copy(update={"variables": ()})
    expected = NEW.apply(raw, serial="SN001", variables={"temperature": degrees})
    made = corrected(from_calibration(NEW, stream=plain), plain.apply(raw, serial="SN001"), degrees)
    np.testing.assert_allclose(made, expected, rtol=0, atol=SOLVE_ROUNDING * np.abs(expected).max())


def test_a_stream_needs_no_prior() -> None:
    """The matrix that made the readings is the stream's; a first calibration has no other."""
    first = NEW.model_copy(update={"prior": None})
    np.testing.assert_array_equal(
        from_calibration(first, stream=STREAM).secondary_matrix, from_calibration(NEW, stream=STREAM).secondary_matrix
    )


@pytest.mark.parametrize(
    ("calibration", "stream", "error", "message"),
    [
        (
            NEW,
            make_calibration(serial="SN002"),
            SerialNumberError,
            "sensor 'SN002': expected readings of .* got 'SN001'",
        ),
        (
            make_calibration(variables=(make_variable(name="supply", unit="V"),)),
            None,
            FormatError,
            r"no variable but 'temperature' in degC, got \[\('supply', 'V'\)\]; .* use --to coefficients",
        ),
        (make_calibration(variables=(make_variable(unit="K"),)), None, FormatError, r"\('temperature', 'K'\)"),
        (
            make_calibration(variables=(make_variable(), make_variable(name="supply", unit="V"))),
            None,
            FormatError,
            "wholebodydynamics knows no other",
        ),
        (make_calibration(), STREAM, FormatError, "the stream depends on variables that the calibration does not have"),
        (
            NEW,
            make_calibration(variables=(make_variable(name="supply", unit="V"),)),
            FormatError,
            "the stream depends on variables that the calibration does not have; fit with them",
        ),
        (NEW, make_calibration(matrix=np.eye(6, k=1)), FitError, "expected a prior matrix that can be inverted"),
        (
            make_calibration(prior=np.eye(6), prior_source="identity"),
            make_calibration(),
            FormatError,
            "two calibrations of the same readings, but only one of them has the prior 'identity'",
        ),
        (
            make_calibration(),
            make_calibration(prior=np.eye(6), prior_source="identity"),
            FormatError,
            "two calibrations of the same readings, but only one of them has the prior 'identity'",
        ),
    ],
)
def test_streams_and_variables_that_do_not_fit_are_refused(
    calibration: Calibration, stream: Calibration | None, error: type[Exception], message: str
) -> None:
    """Another sensor, a variable that the device does not know, or readings that are not the same."""
    with pytest.raises(error, match=message):
        from_calibration(calibration, stream=stream)


def test_the_name_can_be_that_of_the_robot() -> None:
    """The device looks for the name in its own model, which may call the sensor otherwise."""
    assert from_calibration(make_calibration(), sensor_name="l_leg_ft_sensor").sensor == "l_leg_ft_sensor"


def test_a_calibration_without_an_invertible_prior_is_refused() -> None:
    """Without the matrix that made the readings they cannot be corrected; the message names the sensor."""
    seven = np.hstack([MOUNTED, np.ones((6, 1))])
    with pytest.raises(FormatError, match=r"sensor 'leg_ft' \('SN001'\): .* shape \(6, 6\), got none; "):
        from_calibration(make_calibration(prior=None))
    with pytest.raises(FormatError, match=r"got \(6, 7\) and \(6, 7\); "):
        from_calibration(make_calibration(matrix=seven, prior=seven))
    with pytest.raises(FormatError, match=r"got \(6, 6\) and \(6, 7\); "):
        from_calibration(make_calibration(prior=seven))
    singular = FACTORY.copy()
    singular[5] = singular[4]
    for prior in (singular, np.zeros((6, 6))):
        with pytest.raises(FitError, match=r"'leg_ft'.*expected a prior matrix that can be inverted"):
            from_calibration(make_calibration(prior=prior))


@pytest.mark.parametrize(
    "name", ["l_leg_ft_sensor", "ft-1/left.foot:o", "1_ft", "a&b<c>'d", "e5", "1abc", "0b1x", "truely", "fuß"]
)
def test_names_that_reach_the_device_are_accepted(name: str) -> None:
    """The device gets one word of text, the name itself."""
    assert _correction(sensor=name).sensor == name
    assert bottle(name) == [name]


@pytest.mark.parametrize(
    "name",
    ["", "a b", "a\tb", "a,b", "a(b", "a)b", '"a"', "a\\b", "12", "-1.5", "1e5", "0x1F", ".", "-inf", "true", "null"],
)
def test_names_that_do_not_reach_the_device_are_refused(name: str) -> None:
    """A blank, a bracket or a number is another word, or more than one, by the time that the device gets it."""
    with pytest.raises(FormatError, match="sensor: expected a name that YARP reads as one word") as refusal:
        _correction(sensor=name)
    assert "\n" not in str(refusal.value)
    if name not in (".", "a)b", "a(b"):  # a single point and a lone bracket are refused out of caution
        assert bottle(name) != [name]


def test_line_breaks_in_a_name_stay_out_of_the_message() -> None:
    """A name with a line break is refused in one line."""
    with pytest.raises(FormatError, match=r"got 'a\\nb'") as refusal:
        _correction(sensor="a\nb")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        ({"secondary_matrix": np.eye(5)}, ShapeError, "'leg_ft': secondary_matrix: expected an array of shape"),
        ({"offset": np.zeros(5)}, ShapeError, "'leg_ft': offset: expected an array of shape"),
        ({"offset": [0, 0, np.nan, 0, 0, 0]}, FormatError, "'leg_ft': offset: expected finite numbers, got nan"),
        ({"secondary_matrix": np.full((6, 6), np.inf)}, FormatError, "secondary_matrix: expected finite numbers"),
        ({"temperature_coefficients": np.ones(6)}, FormatError, "got only one of them"),
        ({"reference_temperature": 20.0}, FormatError, "got only one of them"),
        (
            {"temperature_coefficients": np.ones(6), "reference_temperature": np.nan},
            FormatError,
            "reference_temperature: expected finite numbers",
        ),
    ],
)
def test_wrong_numbers_are_refused(changes: dict[str, object], error: type[Exception], message: str) -> None:
    """Shape, finiteness, and temperature coefficients with their reference."""
    with pytest.raises(error, match=message):
        _correction(**changes)


def test_a_correction_holds_copies() -> None:
    """Changing the caller's array, or the held one, does not change the correction."""
    offset = np.ones(6)
    correction = _correction(offset=offset)
    offset[0] = 9.0
    assert correction.offset[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        correction.offset[0] = 2.0
