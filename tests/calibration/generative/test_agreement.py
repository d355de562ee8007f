# SPDX-License-Identifier: BSD-3-Clause
"""Recordings that do not agree are found by their residuals, and named."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE, MOMENT, WRENCH_COMPONENTS
from forcetorque.calibration.generative.agreement import (
    disagreements,
    require_response,
    require_sensor,
    require_unmirrored,
    unmoved_directions,
)
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.experiment.calibration.sensor_model import WrenchModel

TRUTH = np.diag([100.0, 100.0, 100.0, 1500.0, 1500.0, 1500.0])
"""Counts per newton and newton metre."""
ACCURACY = np.zeros(6)


def _recording(name: str, response: FloatArray = TRUTH, *, means: int = 60, session: str = "") -> WindowMeans:
    rng = np.random.default_rng(sum(map(ord, name)))
    wrench = rng.normal(size=(means, 6)) * [10.0, 10.0, 10.0, 1.0, 1.0, 1.0]
    return WindowMeans(
        label=name,
        session=session or name,
        recording=name,
        time_s=np.arange(float(means)),
        count=np.full(means, 100.0),
        raw=wrench @ response.T + rng.uniform(-5e3, 5e3, 6) + rng.normal(size=(means, 6)),
        reference=wrench,
        flattening=np.zeros((means, 6)),
        variables=np.zeros((means, 0)),
    )


def _model(response: FloatArray = TRUTH) -> WrenchModel:
    return WrenchModel(matrix=np.linalg.inv(response), offset=np.zeros(6))


def test_recordings_of_one_sensor_agree() -> None:
    """Each with its own offset and noise; a single recording has nobody to disagree with."""
    stretches = [_recording(name) for name in "abcd"]
    assert disagreements(stretches, _model(), ACCURACY) == ()
    assert disagreements([_recording("a", 1.1 * TRUTH)], _model(), ACCURACY) == ()


def test_another_sensor_is_named() -> None:
    """Its gain is 5 % off: hundreds of times what its own data leave. The worst comes first."""
    worse, other = TRUTH @ np.diag([1.2, 1.0, 1.0, 1.0, 1.0, 1.0]), 1.05 * TRUTH
    stretches = [_recording("a"), _recording("b", other), _recording("c"), _recording("d", worse)]
    named = disagreements(stretches, _model(), ACCURACY)
    assert [one.recording for one in named] == ["d", "b"]
    assert named[0].residual[0] > 20.0 * named[0].own[0]


def test_what_the_reference_is_good_for_is_no_disagreement() -> None:
    """Where the reference is accurate to a newton, 5 % of 10 N is nothing."""
    stretches = [_recording("a"), _recording("b", 1.05 * TRUTH)]
    assert [one.recording for one in disagreements(stretches, _model(), ACCURACY)] == ["b"]
    assert disagreements(stretches, _model(), np.repeat([1.0, 0.1], 3)) == ()


def test_a_short_recording_is_given_the_benefit_of_the_doubt() -> None:
    """A line through ten means leaves nothing to compare with."""
    stretches = [_recording("a"), _recording("b", 1.05 * TRUTH, means=10)]
    assert disagreements(stretches, _model(), ACCURACY) == ()


@pytest.mark.parametrize(("gain", "is_refused"), [(0.31, False), (0.29, True)])
def test_a_sensor_answers_with_three_tenths_of_its_prior(gain: float, is_refused: bool) -> None:
    """Less of it is refused, with the direction."""
    response = np.diag([1.0, gain, 1.0, 1.2, 1.0, 0.9])
    if is_refused:
        with pytest.raises(FitError, match=r"the sensor answers to fy with 0\.29 of what its prior says"):
            require_sensor(response)
    else:
        require_sensor(response)


@pytest.mark.parametrize("part", [FORCE, MOMENT])
def test_a_sensor_does_not_answer_in_reverse(part: slice) -> None:
    """One or three reversed components are named, two exchanged ones refused; half a turn of the frame is not."""
    x, y, z = WRENCH_COMPONENTS[part]
    for block, words in (
        (np.diag([-1, -1, -1]), f"answers to {x}, {y}, {z} with the reverse of what its prior says"),
        (np.diag([1, -1, 1]), f"answers to {y} with the reverse of"),
        (np.eye(3)[[1, 0, 2]], "as in a mirror, other than what its prior says"),
        (np.diag([-1, -1, 1]), ""),
    ):
        response = np.eye(6)
        response[part, part] = block
        if words:
            with pytest.raises(FitError, match=words):
                require_unmirrored(response)
        else:
            require_unmirrored(response)


@pytest.mark.parametrize(("share", "is_refused"), [(0.49, False), (0.51, True)])
def test_a_response_is_known_by_half(share: float, is_refused: bool) -> None:
    """The standard deviation of the response to one load over that response, over all rows together."""
    wrench = np.random.default_rng(1).normal(size=(200, 6)) * [30.0, 30.0, 30.0, 2.0, 2.0, 2.0]
    covariance = np.zeros((6, 6, 6))
    covariance[:, 2, 2] = (share * 4.0) ** 2 / 6.0
    if is_refused:
        with pytest.raises(FitError, match="the loads hardly move fz, the response to it is not known by half"):
            require_response(4.0 * np.eye(6), covariance, wrench)
    else:
        require_response(4.0 * np.eye(6), covariance, wrench)


def test_directions_that_do_not_move_are_those_of_no_interval() -> None:
    """A load that differs between intervals alone moves nothing: their offsets may differ as well."""
    rng = np.random.default_rng(2)
    wrench = rng.normal(size=(60, 6)) * [30.0, 30.0, 30.0, 2.0, 2.0, 2.0]
    wrench[:, 5] = np.repeat([1.0, -1.0], 30)
    assert unmoved_directions(wrench, [30, 30]) == ("tz",)
    assert unmoved_directions(wrench, [60]) == ()
