# SPDX-License-Identifier: BSD-3-Clause
"""Mounted sensors pass the gate, whatever their matrices; the same sensors under a wrong model do not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.errors import FitError
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.inspection.plausibility.compared_wrenches import Doubt
from forcetorque.inspection.plausibility.gate import examine
from tests.calibration.push_error import Case, cases

ALONE: dict[str, Sequence[str]] = {"grid": ["grid"], "tz": ["tz"], "bsl": ["bsl"]}
POOLED = ["grid", "grid_2", "tz", "tz_2", "bsl", "bsl_2", "bnsl", "bnsl_2"]
STEP_S, LATE = 0.01, 10
"""Step of the simulated recordings, and a delay of 0.1 s in such steps."""

Wrong = Callable[[DataSet], DataSet]


def _scaled(factor: float) -> Wrong:
    return lambda data: replace(data, reference=factor * data.reference)


REFUSED: dict[str, tuple[Wrong, str]] = {
    "masses in grams": (_scaled(1e3), "which no sensor does; are the masses in grams"),
    "half the mass": (_scaled(0.5), "which no sensor does; does the model have half of the true mass"),
    "reversed": (_scaled(-1.0), "is opposite to the expected force, .*gravity_direction .*measure_direction"),
}


def _timed(case: Case) -> list[DataSet]:
    return [replace(data, time_s=STEP_S * np.arange(len(data.raw))) for data in case.data]


def _late(data: DataSet) -> DataSet:
    """The reading 0.1 s late."""
    time = data.time_s[LATE:]
    return DataSet(
        label=data.label,
        raw=data.raw[:-LATE],
        reference=data.reference[LATE:],
        variables=data.variables[LATE:],
        time_s=time,
    )


def _require_judged(case: Case) -> None:
    """No doubt as it is; a refusal, or a doubt of the right kind, of everything that is wrong."""
    good = _timed(case)
    assert examine(good, case.prior) == (), case.name
    for wrong, words in REFUSED.values():
        with pytest.raises(FitError, match=words):
            examine([wrong(data) for data in good], case.prior)
    (heavier,) = examine([_scaled(1.25)(data) for data in good], case.prior)
    assert heavier.kind == "scale", case.name
    (late,) = examine([_late(data) for data in good], case.prior)
    assert late.kind == "delay", case.name
    assert abs(_delay_ms(late) - 100.0) <= 30.0, (case.name, late)


def _delay_ms(doubt: Doubt) -> float:
    words = doubt.message.split()
    assert words[words.index("ms") + 1] == "later"
    return float(words[words.index("ms") - 1])


@pytest.mark.long
def test_two_specimens_of_four_sensors_pass_and_their_wrong_models_do_not() -> None:
    """Coefficients are off by 4 to 22 % of their row, so that forces are off by up to 50 % in single directions."""
    every = [*ALONE]
    moved = {"l_leg_ft": every, "l_foot_ft": every, "r_leg_ft": ["bsl"], "l_arm_ft": ["bsl"]}
    for case in cases(ALONE, moved, range(401, 403)):
        _require_judged(case)


@pytest.mark.long
def test_twenty_specimens_pass_and_their_wrong_models_do_not() -> None:
    """In each motion, and in all recordings together."""
    every = [*ALONE, "all"]
    moved = {"l_leg_ft": every, "l_foot_ft": every, "r_leg_ft": ["bsl", "all"], "l_arm_ft": ["bsl", "all"]}
    for case in cases({**ALONE, "all": POOLED}, moved, range(403, 423)):
        _require_judged(case)
