# SPDX-License-Identifier: BSD-3-Clause
"""Who computes on a machine that has nothing compiled yet."""

from __future__ import annotations

import sys
from pathlib import Path

import numba
import pytest

from forcetorque.robot.compiled import run
from forcetorque.robot.mechanics.estimate import Evaluator, evaluator_of_samples


@pytest.mark.parametrize("is_compiled", [True, False])
def test_a_first_result_waits_for_no_compiler(monkeypatch: pytest.MonkeyPatch, *, is_compiled: bool) -> None:
    """Without a copy NumPy answers for an hour at 100 Hz; much work is compiled for, little never."""
    monkeypatch.setattr(sys.modules["forcetorque.robot.mechanics.estimate"], "_is_compiled", lambda: is_compiled)
    hour = Evaluator.COMPILED if is_compiled else Evaluator.READABLE
    assert evaluator_of_samples(360_000, expected_only=True) is hour
    assert evaluator_of_samples(90_000) is hour
    for expected_only in (True, False):
        assert evaluator_of_samples(2_160_000, expected_only=expected_only) is Evaluator.COMPILED
        assert evaluator_of_samples(19_999, expected_only=expected_only) is Evaluator.READABLE


def test_a_copy_on_disk_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the file that the compiler writes, in the folder where it looks for it."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    new = run.driver.__wrapped__()
    monkeypatch.setattr(run, "driver", lambda: new)
    assert not run.has_copy()
    folder, name = Path(new.stats.cache_path), new._cache._cache_file._index_name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "run.other-1.py311.nbi").touch()
    assert not run.has_copy()
    (folder / name).touch()
    assert run.has_copy()
