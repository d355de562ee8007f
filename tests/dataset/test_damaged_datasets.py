# SPDX-License-Identifier: BSD-3-Clause
"""Damaged datasets: both commands refuse or read them, with our errors of one line alone, and no output is left."""

from __future__ import annotations

import random
import shutil
import warnings
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.dataset import check_dataset, compensate, compensate_dataset
from tests.dataset.test_compensate import EPISODES, STATED, tool  # noqa: F401 - a fixture
from tests.formats.fuzzed import damaged
from tests.formats.lerobot.datasets import write_dataset
from tests.fuzzing import sampled

FILES = {
    "frames": ("v3.0", "data/chunk-000/file-000.parquet"),
    "episodes": ("v3.0", "meta/episodes/chunk-000/file-000.parquet"),
    "statistics": ("v3.0", "meta/stats.json"),
    "description": ("v2.1", "meta/info.json"),
    "statistics of episodes": ("v2.1", "meta/episodes_stats.jsonl"),
}


@pytest.mark.fuzz
@pytest.mark.parametrize("name", FILES)
def test_damaged_datasets_are_refused_or_read(
    tmp_path: Path,
    name: str,
    tool: Any,  # noqa: F811
    monkeypatch: pytest.MonkeyPatch,
    request: pytest.FixtureRequest,
) -> None:
    """Flipped bits, huge counts, cuts and repeats in each file that is read; the tool is known, for speed."""
    monkeypatch.setattr(compensate, "_identified", lambda *args: tool)
    version, file = FILES[name]
    root = write_dataset(tmp_path / "d", EPISODES[:2], version=version)
    original = (root / file).read_bytes()
    rng = random.Random(f"{name} {request.config.getoption('hypothesis_seed')}")
    outcomes: Counter[str] = Counter()
    output = tmp_path / "out"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what NumPy finds odd in damaged numbers is no error of ours
        for number in range(sampled(1000) + 1):
            # the first is whole: what refuses everything would pass
            (root / file).write_bytes(damaged(original, rng.randrange(2**63)) if number else original)
            for run in (
                lambda: check_dataset(root, sense="sensor_to_world"),
                lambda: compensate_dataset(root, output, **STATED),
            ):
                try:
                    run()
                except ForceTorqueError as error:
                    outcomes["refused" if "\n" not in str(error) else f"of several lines: {error}"] += 1
                else:
                    outcomes["done"] += 1
            for left in (output, tmp_path / "out.part"):
                shutil.rmtree(left, ignore_errors=True)
    assert set(outcomes) <= {"refused", "done"}
    assert sum(outcomes.values()) == 2 * (sampled(1000) + 1)
    assert outcomes["done"] >= 2
