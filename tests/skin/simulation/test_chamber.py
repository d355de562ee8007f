# SPDX-License-Identifier: BSD-3-Clause
"""A simulated pressure chamber records what its taxels are made of."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.skin.taxels.taxel_faults import TaxelFault
from tests.scenes.chambers import HIGHEST_PA, TAXELS, chamber, responses


def test_counts_are_those_of_the_responses() -> None:
    """While loading, to noise and rounding; the pressure rises to its peak and falls to nothing."""
    taxels = responses()
    recording = chamber(taxels, 5)
    counts = recording.stream("counts").signal("taxel_counts").values
    pressure = recording.stream("chamber").signal("pressure").values[:, 0]
    assert counts.shape == (len(pressure), TAXELS)
    np.testing.assert_array_equal(counts, np.rint(counts))
    loading = np.arange(len(pressure)) <= np.argmax(pressure)
    expected = taxels.rest - taxels.fall(np.maximum(pressure, 0.0)[:, None] * np.ones(TAXELS))
    error = (counts - expected)[loading]
    assert np.abs(error.mean(axis=0)).max() < 0.2
    assert np.std(error) == pytest.approx(np.hypot(taxels.noise[0], np.sqrt(1.0 / 12.0)), rel=0.05)
    assert pressure.max() == pytest.approx(HIGHEST_PA, rel=0.01)
    assert np.abs(pressure[-100:]).max() < 100.0


def test_hysteresis_lowers_counts_while_unloading() -> None:
    """Negative control: without it, loading and unloading read the same."""
    lags = []
    for hysteresis in (True, False):
        counts = chamber(responses(hysteresis=hysteresis), 5).stream("counts").signal("taxel_counts").values
        half = len(counts) // 4 + 62  # half of the pressure, going up
        up, down = (counts[place - 25 : place + 25].mean() for place in (half, len(counts) - half))
        lags.append(up - down)
    assert lags[0] > 1.0
    assert abs(lags[1]) < 0.3


@pytest.mark.parametrize("fault", TaxelFault)
def test_a_broken_taxel_sends_whole_counts_of_a_byte(fault: TaxelFault) -> None:
    """Whatever is wrong with it, and where its level runs out of the range too."""
    broken = chamber(responses(), 5, broken={3: fault, 40: fault}, highest_pa=5.0 * HIGHEST_PA)
    counts = broken.stream("counts").signal("taxel_counts").values[:, [3, 40]]
    np.testing.assert_array_equal(counts, np.rint(counts))
    assert 0.0 <= counts.min() <= counts.max() <= 255.0


def test_a_taxel_that_is_not_there_cannot_break() -> None:
    """It is named."""
    with pytest.raises(SkinError, match="broken: expected taxels of 0 to 59, got 60"):
        chamber(responses(), 5, broken={60: TaxelFault.JUMPS})
