# SPDX-License-Identifier: BSD-3-Clause
"""From counts to frames: rest and noise of the same power-up, and only taxels that surely fell are active."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.skin.contact.pressure_frame import WAKING, PatchReader
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PressureTable
from forcetorque.skin.wrench.pressures_over_recording import stuck_taxels
from tests.skin.layout.skins import plane_layout

TAXELS: Final = 2000
SLOPE_PA: Final = 1000.0
TABLE: Final = PressureTable(
    patch="plate",
    columns=TAXELS + 3,
    taxels=np.arange(TAXELS) + 3,
    live=np.arange(TAXELS) != 7,
    values=np.where(np.arange(TAXELS) != 7, SLOPE_PA * np.arange(256.0)[:, None], 0.0),
    range_counts=np.full(TAXELS, 40.0),
    error=np.full(TAXELS, 300.0),
    hysteresis=np.full(TAXELS, 1500.0),
)


def messages(fall: float, number: int, seed: int = 1) -> np.ndarray:
    """Messages in which every taxel fell so far, with noise."""
    noise = np.random.default_rng(seed).normal(0.0, 0.65, (number, TAXELS + 3))
    return np.rint(240.0 - fall + noise)


@pytest.fixture(scope="module", name="reader")
def reader_at_rest() -> PatchReader:
    """Rest and noise from a hundred messages."""
    return PatchReader.at_rest(TABLE, messages(0.0, 100))


def test_rest_and_noise_are_those_of_the_messages(reader: PatchReader) -> None:
    """Noise includes what rounding adds; a taxel that never changes has rounding at least."""
    np.testing.assert_allclose(reader.rest, 240.0, atol=0.35)
    np.testing.assert_allclose(reader.noise.mean(), np.hypot(0.65, 1.0 / np.sqrt(12.0)), rtol=0.02)
    still = PatchReader.at_rest(TABLE, np.full((20, TAXELS + 3), 240.0))
    np.testing.assert_allclose(still.noise, 1.0 / np.sqrt(12.0))


@pytest.mark.parametrize("number", [1, 10])
def test_few_idle_taxels_wake(reader: PatchReader, number: int) -> None:
    """Of fifty frames of two thousand idle taxels, about one in 14 000 by chance; never the dead one."""
    frames = [reader.frame(messages(0.0, number, seed)) for seed in range(2, 52)]
    awake = sum(int(frame.active.sum()) for frame in frames)
    assert awake < 5 * 50 * TAXELS / 14_000
    assert not any(frame.active[7] for frame in frames)


def test_means_wake_at_less(reader: PatchReader) -> None:
    """A fall of 1.5 counts is lost in the noise of one message, and plain in the mean of ten."""
    one, ten = (reader.frame(messages(1.5, number)[0] if number == 1 else messages(1.5, number)) for number in (1, 10))
    assert one.active.mean() < 0.2
    assert ten.active.mean() > 0.95


def test_pressures_and_what_they_are_worth(reader: PatchReader) -> None:
    """Pressure by the table, noise by its slope; where a taxel is active the table's error and hysteresis."""
    frame = reader.frame(messages(20.0, 10))
    live = reader.live
    np.testing.assert_allclose(frame.pressures[live].mean(), 20.0 * SLOPE_PA, rtol=0.01)
    noise = SLOPE_PA * reader.noise[reader.table.taxels] * np.sqrt(1.0 / 10.0 + 1.0 / 100.0)
    np.testing.assert_allclose(frame.sd_Pa[live], np.hypot(noise, 300.0)[live])
    np.testing.assert_allclose(frame.hysteresis_Pa[live], 1500.0)
    assert not frame.beyond_range.any()
    idle = reader.frame(messages(0.0, 10))
    asleep = ~idle.active & live
    np.testing.assert_allclose(idle.sd_Pa[asleep], noise[asleep])
    np.testing.assert_array_equal(idle.hysteresis_Pa[asleep], 0.0)
    assert reader.frame(messages(45.0, 1)).beyond_range[live].all()
    assert WAKING > 3.0


def test_what_does_not_belong_is_refused(reader: PatchReader) -> None:
    """Too few messages at rest, messages of another length, zeros, the layout of another patch."""
    with pytest.raises(SkinError, match="expected at least 10 messages, got 9"):
        PatchReader.at_rest(TABLE, messages(0.0, 9))
    with pytest.raises(ValueError, match="counts"):
        PatchReader.at_rest(TABLE, np.zeros((20, 5)))
    with pytest.raises(SkinError, match="a message of zeros"):
        reader.frame(np.zeros(TAXELS + 3))
    with pytest.raises(SkinError, match="every patch has its own table"):
        reader.require_layout(plane_layout())


@pytest.mark.parametrize(("number", "noise", "is_stuck"), [(100, 0.52, True), (99, 0.52, False), (100, 0.48, False)])
def test_a_taxel_is_stuck_where_the_others_are_too_noisy_for_chance(number: int, noise: float, is_stuck: bool) -> None:
    """From 100 messages and a median noise of 0.5 counts on; one that is not live is not named."""
    counts = messages(0.0, number)
    counts[:, [3 + 5, 3 + 7]] = 240.0
    reader = PatchReader.at_rest(TABLE, counts)
    others = np.arange(TAXELS + 3) != 3 + 5
    reader = replace(reader, noise=np.where(others, noise, 1.0 / np.sqrt(12.0)))
    assert stuck_taxels(reader, counts).tolist() == ([3 + 5] if is_stuck else [])


@pytest.mark.parametrize(("sure", "wakes"), [(3.75, False), (3.85, True)])
def test_a_taxel_wakes_at_its_deviations(sure: float, wakes: bool) -> None:
    """Of its noise, of the mean of ten messages and of the rest together: 3.8 of them, one in 14 000 by chance."""
    reader = replace(PatchReader.at_rest(TABLE, messages(0.0, 100)), noise=np.full(TAXELS + 3, 2.0))
    deviation = 2.0 * np.sqrt(1.0 / 10.0 + 1.0 / 100.0)
    counts = np.tile(reader.rest - sure * deviation, (10, 1))
    active = reader.frame(counts).active
    assert active.any() == wakes
    assert active.sum() in (0, TAXELS - 1)
