# SPDX-License-Identifier: BSD-3-Clause
"""Samples are known again in any log that holds them, and others are not taken for them."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.recording.fingerprint import KEPT, WINDOW, fingerprint, kept_hashes, window_hashes


def _reading(seed: int, count: int = 4000, noise: float = 0.05) -> np.ndarray:
    rng = np.random.default_rng(seed)
    load = 30.0 * np.sin(np.linspace(0.0, 9.0, count))[:, None] * rng.normal(size=6)
    return np.array(load + noise * rng.normal(size=(count, 6)))


def _found(fitted: np.ndarray, judged: np.ndarray) -> int:
    return int(np.isin(kept_hashes(fingerprint(fitted)), window_hashes(judged)).sum())


@pytest.mark.parametrize(
    "written",
    [
        pytest.param(lambda values: values, id="as it is"),
        pytest.param(lambda values: values.astype(np.float32).astype(float), id="in single precision"),
        pytest.param(lambda values: np.array([[float(f"{x:.8g}") for x in row] for row in values]), id="eight digits"),
        pytest.param(lambda values: values[1000:], id="cut at the front"),
        pytest.param(lambda values: values[1500:2500], id="a quarter of it"),
        pytest.param(lambda values: np.concatenate([_reading(9), values[3600:]]), id="its last tenth behind another"),
    ],
)
def test_samples_are_known_again(written: object) -> None:
    """However they were written, and wherever they stand."""
    values = _reading(1)
    assert len(kept_hashes(fingerprint(values))) == KEPT
    assert _found(values, written(values)) > 0  # type: ignore[operator]


@pytest.mark.long
def test_other_samples_of_the_same_motion_are_others() -> None:
    """Of a hundred recordings that differ in their noise alone none is taken for another."""
    values = _reading(1)
    rng = np.random.default_rng(2)
    assert sum(_found(values, values + 0.05 * rng.normal(size=values.shape)) for _ in range(100)) == 0


@pytest.mark.parametrize("channels", [1, 2, 3, 6])
def test_a_resting_sensor_of_few_counts_is_no_other(channels: int) -> None:
    """Counts of some channels that go up and down by one come again by chance; of six of them, not a window."""
    rng = np.random.default_rng(3)
    resting = [1000.0 + rng.integers(0, 2, size=(4000, 6)) * (np.arange(6) < channels) for _ in range(20)]
    assert all(_found(resting[0], other) == 0 for other in resting[1:])
    assert (_found(resting[0], resting[0][500:]) > 0) == (channels == 6)


@pytest.mark.parametrize("values", [np.ones((100, 6)), _reading(1, WINDOW - 1), np.full((100, 6), np.nan)])
def test_what_hardly_changes_is_not_known(values: np.ndarray) -> None:
    """A sensor that is stuck, too few samples, none that is whole."""
    assert fingerprint(values) == ""
