# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches of a board are in steps of its full scales, and show by which matrix they were sent."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.icub_wrench_steps import full_scales_of_steps, is_in_steps

SCALES = (1587, 1823, 2113, 37, 38, 24)
OTHERS = np.array([1728.0, 1998.0, 2021.0, 37.0, 38.0, 26.0])


def _sent(seed: int = 1, decimals: int = 6) -> FloatArray:
    """Wrenches of a tenth of full scale at most, as a board sends and a log writes them."""
    step = np.array(SCALES) / 2**15
    codes = np.random.default_rng(seed).integers(-3276, 3276, size=(900, 6))
    return np.round(codes * step, decimals)


@pytest.mark.parametrize("decimals", [6, 12])
def test_steps_show_the_full_scales(decimals: int) -> None:
    """Those of the board, and of no other."""
    wrench = _sent(decimals=decimals)
    assert full_scales_of_steps(wrench) == SCALES
    assert is_in_steps(wrench, np.array(SCALES, dtype=float))
    assert not is_in_steps(wrench, OTHERS)


def test_components_that_rest_show_nothing() -> None:
    """The others do; where most rest, or samples lack, none is shown."""
    wrench = _sent()
    wrench[:, 4] = 0.0
    wrench[5] = np.nan
    assert full_scales_of_steps(wrench) == (*SCALES[:4], None, SCALES[5])
    wrench[:, :3] = 0.0
    assert full_scales_of_steps(wrench) is None


@pytest.mark.parametrize("kind", ["noise", "turned", "filtered"])
def test_other_wrenches_are_in_no_steps(kind: str) -> None:
    """Those of another device, after a rotation, and after a filter."""
    wrench = _sent()
    if kind == "noise":
        wrench = np.random.default_rng(2).normal(size=(900, 6))
    elif kind == "turned":
        wrench[:, :2] = wrench[:, :2] @ np.array([[0.8, 0.6], [-0.6, 0.8]])
    else:
        wrench = np.stack([np.convolve(one, [0.2, 0.5, 0.3], "valid") for one in wrench.T], axis=1)
    assert full_scales_of_steps(wrench) is None
    assert not is_in_steps(wrench, np.array(SCALES, dtype=float))


@pytest.mark.parametrize("decimals", [2, 3, 4])
def test_few_decimals_show_no_steps_of_small_moments(decimals: int) -> None:
    """Moments of some steps, as of a leg at rest, are then not in steps of their matrix, nor of a larger one."""
    codes = np.round(np.random.default_rng(3).normal(0.0, 20.0, size=(2000, 6)))
    assert full_scales_of_steps(codes * np.array(SCALES) / 2**15) == SCALES
    wrench = np.round(codes * np.array(SCALES) / 2**15, decimals)
    assert not is_in_steps(wrench, np.array(SCALES, dtype=float))
    assert full_scales_of_steps(wrench) is None


@pytest.mark.parametrize("kind", ["at rest", "tenths", "whole numbers"])
def test_wrenches_of_another_device_show_no_full_scales(kind: str) -> None:
    """Noise that is smaller than any step, and decimals that are steps themselves."""
    rng = np.random.default_rng(4)
    if kind == "at rest":
        wrench = rng.normal(size=(900, 6)) * 1e-3
        wrench[:, 2] = -9.81
    elif kind == "tenths":
        wrench = np.round(rng.normal(size=(900, 6)) * [20.0, 20.0, 20.0, 2.0, 2.0, 2.0], 1)
    else:
        wrench = rng.integers(-300, 300, size=(900, 6)).astype(float)
    assert full_scales_of_steps(wrench) is None
