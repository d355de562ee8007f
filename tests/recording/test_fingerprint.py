# SPDX-License-Identifier: BSD-3-Clause
"""Samples are known again in any log that holds them, and others are not taken for them."""

from __future__ import annotations

from itertools import pairwise

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


@pytest.mark.parametrize("rows", [2, 5, 60])
def test_readings_that_the_log_repeats_are_known_again(rows: int) -> None:
    """Of a sensor that is slower than its log: in a copy that is cut, in one of another rate, not with other noise."""
    first, second = _reading(1, 1000), _reading(1, 1000) + 0.05 * np.random.default_rng(2).normal(size=(1000, 6))
    logged = first.repeat(rows, axis=0)
    assert len(kept_hashes(fingerprint(logged))) == KEPT
    assert _found(logged, logged[501 * rows + 1 :]) > 0
    assert _found(logged, first) == KEPT
    assert _found(logged, second.repeat(rows, axis=0)) == 0


@pytest.mark.parametrize("channels", [1, 6])
def test_steps_of_a_converter_that_a_slow_load_crosses_are_not_known(channels: int) -> None:
    """Without noise: other logs cross the same steps."""
    slow = np.rint(_reading(1, 20_000, noise=0.0))
    slow[:, channels:] = 0.0
    assert len(window_hashes(slow)) == 0
    assert len(window_hashes(slow[np.append(True, np.diff(slow, axis=0).any(axis=1))])) > 0, "control: steps alone"


@pytest.mark.long
def test_other_samples_of_the_same_motion_are_others() -> None:
    """Of a hundred recordings that differ in their noise alone none is taken for another."""
    values = _reading(1)
    rng = np.random.default_rng(2)
    assert sum(_found(values, values + 0.05 * rng.normal(size=values.shape)) for _ in range(100)) == 0


def test_a_resting_sensor_of_few_counts_is_no_other() -> None:
    """Counts that go up and down by one come again by chance, windows of them do not."""
    rng = np.random.default_rng(3)
    resting = [np.array(1000.0 + rng.integers(0, 2, size=(4000, 6))) for _ in range(20)]
    assert all(_found(resting[0], other) == 0 for other in resting[1:])
    assert _found(resting[0], resting[0][500:]) > 0


@pytest.mark.parametrize("channels", [1, 2, 3, 6])
def test_a_still_sensor_is_no_copy_of_its_other_logs(channels: int) -> None:
    """Of a still sensor few channels change, by one count, so that windows come again by chance: none is kept then."""
    rng = np.random.default_rng(4)
    logs = [np.tile([12345.0, -23456.0, 3456.0, -30123.0, 1234.0, 8765.0], (20000, 1)) for _ in range(3)]
    for log in logs:
        log[:, :channels] = 1000.0 + rng.integers(0, 2, size=(len(log), channels))
    assert all(_found(one, other) == 0 for one, other in pairwise(logs))
    windows = [
        {part.tobytes() for part in np.lib.stride_tricks.sliding_window_view(log[:, :channels], WINDOW, axis=0)}
        for log in logs[:2]
    ]
    assert bool(windows[0] & windows[1]) == (channels == 1), "control: such windows do come again"
    if channels == 6:
        assert _found(logs[0], logs[0][500:]) > 0, "control: a copy is found where the sensor says enough"


@pytest.mark.parametrize("noise", [0.3, 1.0, 3.0])
def test_a_still_sensor_with_noise_is_known_again(noise: float) -> None:
    """Six channels of counts: a copy that is cut at the front is found, another log of the same sensor is not."""
    rng = np.random.default_rng(5)
    mean = np.array([-2345.0, 456.0, 3456.0, -123.0, 1234.0, 8765.0])
    first, second = (np.round(mean + noise * rng.normal(size=(20000, 6))) for _ in range(2))
    assert _found(first, first[5000:]) > 0
    assert _found(first, second) == 0


@pytest.mark.parametrize("values", [np.ones((100, 6)), _reading(1, WINDOW - 1), np.full((100, 6), np.nan)])
def test_what_hardly_changes_is_not_known(values: np.ndarray) -> None:
    """A sensor that is stuck, too few samples, none that is whole."""
    assert fingerprint(values) == ""
