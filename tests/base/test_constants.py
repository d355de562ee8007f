# SPDX-License-Identifier: BSD-3-Clause
"""Constants that statistics rest on, against the distributions that define them."""

from __future__ import annotations

import pytest
from scipy.special import ndtri

from forcetorque.base.units import MAD_TO_DEVIATION, NORMAL_95

STATED_DIGITS = 5e-5
"""Half a step of the last of the digits that the factor of medians is stated with, over 1."""


def test_quantiles_are_those_of_the_normal_distribution() -> None:
    """95 % of a normal distribution lie within one, half of it within the median absolute deviation."""
    assert ndtri(0.975) == pytest.approx(NORMAL_95, rel=1e-15)
    assert 1.0 / ndtri(0.75) == pytest.approx(MAD_TO_DEVIATION, abs=STATED_DIGITS)
