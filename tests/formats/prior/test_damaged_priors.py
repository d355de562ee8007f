# SPDX-License-Identifier: BSD-3-Clause
"""Files of calibrations under damage: a matrix or our error, at once; 21 000 cases in the long run."""

from __future__ import annotations

import random
import re
import time
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import ForceTorqueError
from forcetorque.formats.prior.registry import read_prior_file
from tests.formats.fuzzed import damaged
from tests.formats.prior.test_prior_files import write_priors
from tests.fuzzing import sampled

SLOWEST_S = 5.0
"""Seconds of one case: milliseconds were the slowest of thousands, on a machine that seven others shared."""
FORMS = ("v3.dat", "v2.dat", "a.cal", "b.cal", "model.xml", "plain.txt", "sn.txt")
WORDS = ("nan", "1e999", "-1e308", "0", "", "9" * 400, "0x", "é", "ffffffff", "(1 2)")


def changed(data: bytes, seed: int) -> bytes:
    """Damage bytes, or put a word that is no number, or none that is possible, in place of one."""
    rng = random.Random(seed)
    if rng.random() < 0.5:
        return damaged(data, seed)
    numbers = list(re.finditer(rb"[-+0-9.a-fx]+", data))
    place = rng.choice(numbers)
    return data[: place.start()] + rng.choice(WORDS).encode() + data[place.end() :]


@pytest.mark.fuzz
@pytest.mark.parametrize("name", FORMS)
def test_damaged_calibrations_are_refused_or_read(tmp_path: Path, name: str) -> None:
    """What is read is finite, with six rows; both outcomes must have been met."""
    path = write_priors(tmp_path / "priors")[name]
    original = path.read_bytes()
    units = {"force_unit": "N", "moment_unit": "N m"} if name == "plain.txt" else {}
    outcomes: Counter[str] = Counter()
    drawn = sampled(3000)

    @settings(max_examples=drawn, deadline=None, database=None)
    @given(seed=st.integers(0, 2**63))
    def run(seed: int) -> None:
        path.write_bytes(changed(original, seed))
        start = time.perf_counter()
        try:
            matrix = read_prior_file(path, **units).matrix
        except ForceTorqueError as error:
            assert "\n" not in str(error)  # noqa: PT017 - both outcomes are allowed
            outcomes["refused"] += 1
        else:
            assert len(matrix) == 6
            assert np.isfinite(matrix).all()
            outcomes["read"] += 1
        assert time.perf_counter() - start < SLOWEST_S

    run()
    assert sum(outcomes.values()) >= min(drawn, 5)
    assert outcomes["refused"] > 0
    path.write_bytes(original)
    read_prior_file(path, **units)
