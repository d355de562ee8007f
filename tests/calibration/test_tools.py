# SPDX-License-Identifier: BSD-3-Clause
"""A wrist sensor of an arm that swings one, two or three tools, from the maker's matrix."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.expected_sensor_errors import ACCURACY_SHARE
from tests.calibration.generative.tools import Wrist
from tests.cases import some_cases

SPECIMENS = range(8)


def _errors(
    tools: int, *, length_m: float, accuracy: float = 0.0, seeds: range = SPECIMENS
) -> tuple[FloatArray, FloatArray]:
    """Push errors of specimens after and before, force and moment; shapes (n, 2); N, N m."""
    wrists = [Wrist(seed, length_m=length_m) for seed in seeds]
    after = [wrist.push_error(wrist.fitted(range(tools), accuracy=accuracy).model.matrix) for wrist in wrists]
    return np.array(after), np.array([wrist.push_error(wrist.prior) for wrist in wrists])


@some_cases(("length_m", "force_N"), [(0.067, 0.3), (0.1, 0.2), (0.3, 0.1)])
def test_one_tool_makes_a_push_read_better(length_m: float, force_N: float) -> None:
    """A push of 10 N errs by 0.45 N with the identity, 3 % off.

    Means of 20 specimens: with full scales of 164 N and 11 N m .27 N, 16 N m .16 N, 49 N m .07 N; the truth has 0.03
    in N, N m and N m per N alike, which a short length takes for unlikely. None is above its identity (at most .90).
    """
    after, before = _errors(1, length_m=length_m)
    assert before[:, 0].mean() == pytest.approx(0.45, abs=0.06)
    assert after[:, 0].mean() < force_N
    assert (after < before).all()


@pytest.mark.long
@pytest.mark.parametrize("accuracy", [0.0, ACCURACY_SHARE])
def test_three_tools_tell_all_of_the_matrix(accuracy: float) -> None:
    """Means of 20 specimens: .004 N and .0003 N m; two tools leave .12 N and .14 N m."""
    three, before = _errors(3, length_m=0.067, accuracy=accuracy, seeds=SPECIMENS[:4])
    assert three[:, 0].mean() < 0.006
    assert three[:, 1].mean() < 0.0004
    assert (three < 0.02 * before).all()
    two, _ = _errors(2, length_m=0.067, accuracy=accuracy, seeds=SPECIMENS[:4])
    assert (two < before).all()
    assert (two > 5.0 * three).all()
