# SPDX-License-Identifier: BSD-3-Clause
"""What counts as determined by a joint calibration, and which sentences of doubt its numbers lead to."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.calibration.joint.result import JointOutcome, ModelErrorRow, SensorErrorRow, SubModelRow, _middle
from forcetorque.experiment.calibration.calibration_file import CalibratedVariable


def _sensor(
    *, before_percent: float = 10.0, after_percent: float = 0.5, load_N: float = 300.0, offset_N: float = 1.0
) -> SensorErrorRow:
    return SensorErrorRow(
        sensor="leg_ft",
        load_N=load_N,
        error_before_N=1.0,
        error_after_N=1.0,
        gain_error_before_percent=before_percent,
        gain_error_after_percent=after_percent,
        error_with_offset_N=offset_N,
    )


def _part(name: str, share: float, *, mass_kg: float = 4.0) -> SubModelRow:
    return SubModelRow(
        sub_model=name,
        sensors=(name,),
        root_link="pelvis",
        interval="sway",
        windows=9,
        left_out=0,
        mass_kg=mass_kg,
        force_before_N=1.0,
        force_after_N=share * STANDARD_GRAVITY * mass_kg,
        moment_before_Nm=None,
        moment_after_Nm=None,
    )


def _error(value: float, deviation: float) -> ModelErrorRow:
    return ModelErrorRow(name="mass of shank", unit="", value=value, deviation=deviation, prior_deviation=1.0)


def _doubts(
    sensors: Sequence[SensorErrorRow] = (), parts: Sequence[SubModelRow] = (), errors: Sequence[ModelErrorRow] = ()
) -> list[str]:
    outcome = JointOutcome.model_construct(
        sensors=tuple(sensors), sub_models=tuple(parts), model_errors=tuple(errors), without_windows=()
    )
    return list(outcome.doubts())


def test_errors_of_a_sensor_are_those_of_its_covariances() -> None:
    """Of 300 N along z: the gain is what errs along the load, the force error all three axes."""

    class Known:
        load_centre = np.array([0.0, 0.0, -300.0, 1.0, 2.0, 3.0])
        sessions = ("first", "last")

        def prior_error_covariance(self, load: np.ndarray) -> np.ndarray:
            return np.diag([4.0, 4.0, 36.0, 9.0, 9.0, 9.0])

        def error_covariance(
            self, load: np.ndarray, *, variables: np.ndarray | None = None, session: str | None = None
        ) -> np.ndarray:
            assert variables is None or variables.tolist() == [7.0]
            offset = {None: 0.0, "first": 1e3, "last": 5.0}[session]
            return np.diag([1.0, 1.0, 9.0, 1.0, 1.0, 1.0]) + offset * np.eye(6)

    row = SensorErrorRow.of("leg_ft", Known(), np.array([7.0]))  # type: ignore[arg-type]
    assert row.load_N == pytest.approx(300.0)
    assert (row.gain_error_before_percent, row.gain_error_after_percent) == pytest.approx((2.0, 1.0))
    assert (row.error_before_N, row.error_after_N) == pytest.approx((np.sqrt(44.0), np.sqrt(11.0)))
    assert row.error_with_offset_N == pytest.approx(np.sqrt(26.0))


@pytest.mark.parametrize(
    ("before_percent", "after_percent", "known"),
    [
        (4.0, 1.5, True),  # below half of the prior's
        (4.0, 2.5, False),  # above half of it: mostly by the prior
        (1.0, 0.9, True),  # small, by whatever
        (20.0, 2.5, True),  # below 3 %
        (20.0, 3.5, False),  # far below the prior, and still too large
    ],
)
def test_a_gain_is_known_that_recordings_told(before_percent: float, after_percent: float, known: bool) -> None:
    """By at least half of the prior's deviation, or within one percent; never from three percent."""
    row = _sensor(before_percent=before_percent, after_percent=after_percent)
    assert row.gain_known is known
    assert any("stance gain not determined: leg_ft" in words for words in _doubts([row])) is not known


@pytest.mark.parametrize(
    ("load_N", "offset_N", "known"), [(300.0, 25.0, True), (300.0, 35.0, False), (10.0, 4.5, True), (10.0, 5.5, False)]
)
def test_an_offset_is_known_within_a_tenth_of_the_load(load_N: float, offset_N: float, known: bool) -> None:
    """And within five newtons where the load is small."""
    row = _sensor(load_N=load_N, offset_N=offset_N)
    assert row.offset_known is known
    assert any("offset not determined: leg_ft" in words for words in _doubts([row])) is not known


def test_an_error_of_the_model_is_a_finding_where_chance_is_not_enough() -> None:
    """What is found varies by the prior's variance less what is left: three times its root is far."""
    left = 0.6
    found = np.sqrt(1.0 - left**2)
    assert _error(3.1 * found, left).is_far
    assert not _error(2.9 * found, left).is_far
    assert _error(-3.1 * found, left).is_far
    assert not _error(10.0, 0.95).is_far  # the recordings tell less than a fifth of its variance
    assert _error(0.0, 0.4).learnt
    assert not _error(0.0, 0.6).learnt
    assert _error(0.0, 3.1).is_wide
    assert not _error(0.0, 2.9).is_wide
    (one,) = _doubts(errors=[_error(5.0, 0.1), _error(0.1, 0.1)])
    assert one.startswith(
        "mass of shank: off by 5.0000 ±0.1000, where the model is trusted to 1; look at the robot model"
    )


def test_errors_are_predicted_in_the_middle_of_what_variables_reached() -> None:
    """Less the value at which a variable adds nothing."""
    temperature = CalibratedVariable.model_construct(minimum=20.0, maximum=34.0, reference_value=22.0)
    supply = CalibratedVariable.model_construct(minimum=4.0, maximum=5.0, reference_value=6.0)
    np.testing.assert_allclose(_middle([temperature, supply]), [5.0, -1.5])


def test_wide_errors_of_the_model_are_counted_by_kind() -> None:
    """In whichever order they come; one alone is named."""
    for deviations in ((4.0, 40.0), (40.0, 4.0)):
        (one,) = _doubts(errors=[_error(0.0, deviation) for deviation in deviations])
        assert "2 numbers of the kind mass up to 40 times. " in one
    assert "mass of shank 4 times. " in next(iter(_doubts(errors=[_error(0.0, 4.0)])))


def test_parts_that_keep_a_tenth_of_their_weight_disagree() -> None:
    """The IMU is in question where most do; a light part says nothing."""
    assert _doubts(parts=[_part("left", 0.08), _part("right", 0.08)]) == []
    assert _doubts(parts=[_part("left", 0.08), _part("hand", 0.5, mass_kg=0.4)]) == []
    (one,) = _doubts(parts=[_part("left", 0.12), _part("right", 0.08)])
    assert "forces of these parts do not agree with their motion, others' do: left" in one
    (most,) = _doubts(parts=[_part("left", 0.12), _part("right", 0.12), _part("arm", 0.08)])
    assert "forces of most parts do not agree" in most
    assert "pelvis" in most
