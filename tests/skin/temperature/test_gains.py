# SPDX-License-Identifier: BSD-3-Clause
"""What pads tell of taxels, by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains, TaxelHeat, ThermalGain, stuck_pads
from tests.scenes.patches import cylinder_patch
from tests.skin.layout.skins import plane_layout

LAYOUT = cylinder_patch(across=2, along=1).layout()
"""Two modules; pads 6 and 10, 18 and 22."""


def test_the_rule_of_the_firmware() -> None:
    """Thesis A.2.3: the mean change of the two pads of the module, whatever those of the other do."""
    gains = HeatGains.of_firmware(LAYOUT)
    assert gains.pads.tolist() == [6, 10, 18, 22]
    fall, sd = gains.fall(np.array([3.0, 5.0, 10.0, -2.0]))
    np.testing.assert_array_equal(fall, [4.0] * 10 + [4.0] * 10)
    assert not sd.any()
    fall, _ = gains.fall(np.array([3.0, 5.0, 10.0, 0.0]))
    np.testing.assert_array_equal(fall, [4.0] * 10 + [5.0] * 10)
    assert np.isnan(gains.rates).all()


def test_learned_gains_are_averaged_over_living_pads() -> None:
    """Each tells the taxel by itself, so that one is enough; with none the taxel is not told."""
    both = TaxelHeat(
        gains=(ThermalGain(pad=6, gain=2.0, sd=0.1), ThermalGain(pad=10, gain=0.5, sd=0.2)), rate_counts_per_s=0.02
    )
    gains = HeatGains.learned([both, TaxelHeat()])
    fall, sd = gains.fall(np.array([3.0, 8.0]))
    np.testing.assert_allclose(fall, [5.0, 0.0])
    np.testing.assert_allclose(sd, [(0.3 + 1.6) / 2.0, 0.0])
    assert gains.has_pad.tolist() == [True, False]
    np.testing.assert_array_equal(gains.rates, [0.02, np.nan])
    one = gains.without(np.array([True, False]))
    np.testing.assert_allclose(one.fall(np.array([255.0, 8.0]))[0], [4.0, 0.0])
    assert not gains.without(np.array([True, True])).has_pad.any()


def test_stuck_pads_are_told_only_where_others_change() -> None:
    """A pad that sends one number is dead beside pads that warm, but not in a short recording in which none does."""
    warm = 240.0 - np.rint(np.linspace(0.0, 12.0, 200))[:, None] * [1.0, 1.0, 0.0]
    assert stuck_pads(warm).tolist() == [False, False, True]
    assert not stuck_pads(np.full((200, 3), 240.0)).any()
    railed = warm.copy()
    railed[:, 0] = 255.0
    assert stuck_pads(railed)[0]


def test_without_pads_there_is_no_rule() -> None:
    """The layout has none."""
    with pytest.raises(SkinError, match="thermal_pads: expected at least one"):
        HeatGains.of_firmware(plane_layout())


def test_a_module_without_pads_takes_those_beside_it() -> None:
    """The layout may leave pads out."""
    lent = HeatGains.of_firmware(
        replace(LAYOUT, thermal_pads=LAYOUT.thermal_pads[:2], thermal_modules=LAYOUT.thermal_modules[:2])
    )
    np.testing.assert_array_equal(lent.fall(np.array([1.0, 3.0]))[0], np.full(20, 2.0))
