# SPDX-License-Identifier: BSD-3-Clause
"""Fused torques of a leg with skin over twenty seeds, by an experiment file: what is named, and what intervals hold.

`tests/estimation/leg_fusion_trials.py` prints what these tests hold.
"""

from __future__ import annotations

import pytest

from tests.estimation.leg_fusion_trials import FAULTS, SEEDS, rmse, trials

pytestmark = pytest.mark.long


@pytest.mark.parametrize("broken", FAULTS, ids=str)
def test_the_broken_source_is_named_and_no_other(broken: str | None) -> None:
    """In nine of ten; and without a broken one there is a conflict in at most one of twenty."""
    some = list(trials(broken))
    assert len(some) == SEEDS
    if broken is None:
        assert sum(trial.conflict for trial in some) <= 1  # 0.2 expected at the stated rate of 1 %
        assert rmse(some, "fused") < 1.05 * min(rmse(some, name) for name in ("ft", "skin", "current"))
        return
    assert sum(trial.named == broken for trial in some) >= 0.9 * SEEDS
    # negative control: by itself it is far worse than what is left without it
    assert rmse(some, broken) > 2.0 * rmse(some, "fused")
