# SPDX-License-Identifier: BSD-3-Clause
"""The key of compiled functions follows their sources; compiling is announced once; arrays are of one kind."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest
from numba import njit

from forcetorque.base.compiled_functions import announced, frozen, source_digest


def test_any_change_of_a_source_changes_the_digest(tmp_path: Path) -> None:
    """Of any module in any of the folders; files that are no modules do not matter."""
    first, second = tmp_path / "first", tmp_path / "second"
    for folder in (first, second):
        folder.mkdir()
        (folder / "a.py").write_text("1", encoding="utf-8")
    before = source_digest(first, second)
    (first / "a.nbc").write_text("cached", encoding="utf-8")
    assert source_digest(first, second) == before
    (second / "a.py").write_text("2", encoding="utf-8")
    assert source_digest(first, second) != before
    assert source_digest(first) != source_digest(second)


def test_compiling_is_announced_once(caplog: pytest.LogCaptureFixture) -> None:
    """Two compilations make one line; where nothing is compiled there is none."""
    double = njit(lambda x: 2 * x)
    with caplog.at_level(logging.INFO, logger="forcetorque"):
        for _ in range(2):
            with announced("compiling"):
                assert (double(1), double(1.5)) == (2, 3.0)
    assert [record.message for record in caplog.records] == ["compiling"]


def test_a_frozen_view_shares_memory_and_leaves_its_base_writable() -> None:
    """C order without a copy where it is in that order already."""
    values = np.ones((3, 2))
    view = frozen(values)
    assert np.shares_memory(view, values)
    assert (view.flags.writeable, values.flags.writeable) == (False, True)
    turned = frozen(values.T)
    assert turned.flags.c_contiguous
    np.testing.assert_array_equal(turned, values.T)
