# SPDX-License-Identifier: BSD-3-Clause
"""The arithmetic of thesis Table 4.1."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.evaluation.sphere.ellipsoid import spread_index
from forcetorque.evaluation.sphere.sensor_sphere import apparent_masses, axis_errors

GRAVITY = 9.81
"""What the thesis used; m/s2."""
MASS = 4.733288
"""The leg of its robot; kg."""
TABLE_4_1 = {
    "SN169": ((5.9484, 24.5433, 2.6872), 1.2019),
    "SN140": ((9.5884, 15.1658, 1.6366), 0.6931),
    "SN138": ((-6.5550, 17.4981, 2.5578), 1.2379),
    "SN233": ((2.2601, 11.4800, 2.4087), 0.5383),
    "SN106571": ((19.1296, 15.0756, 2.7308), 0.8707),
    "SN333 1": ((5.8339, 17.7120, 4.1286), 0.7543),
    "SN333 2": ((5.6101, 18.7182, 4.2647), 0.8139),
    "SN334 1": ((7.5575, 19.7817, 4.5297), 0.8231),
    "SN334 2": ((8.5443, 19.1929, 4.3815), 0.7787),
    "SN282 1": ((9.1065, 26.9490, 7.0502), 1.1155),
    "SN282 2": ((9.0371, 25.5854, 6.4697), 1.0576),
    "SN282 in situ 1": ((0.4174, 1.6623, 2.7594), 0.1194),
    "SN282 in situ 2": ((0.8401, 1.5680, 3.3363), 0.1309),
    "ATI 1": ((8.0796, 15.3603, 3.1578), 0.6258),
    "ATI 2": ((8.2997, 14.6807, 5.3031), 0.4882),
}
"""Errors of the axes, N, and standard deviation, kg, of every sensor."""
PRINTED = 0.00006
"""Half of the last printed digit, and the same again for the printed errors that it is computed from."""


@pytest.mark.parametrize("sensor", TABLE_4_1)
def test_the_index_of_every_row(sensor: str) -> None:
    """Errors of a row give its standard deviation to the printed digits, whatever the mass was."""
    errors, index = TABLE_4_1[sensor]
    for mass in (MASS, 1.0):
        masses = mass + np.array(errors) / GRAVITY
        assert spread_index(masses) == pytest.approx(index, abs=PRINTED)
        np.testing.assert_allclose(axis_errors(masses, reference_mass=mass, gravity=GRAVITY), errors, atol=1e-12)


def test_another_standard_deviation_does_not_give_the_table() -> None:
    """Negative control: with n in place of n - 1, or in N, every row is missed."""
    missed = 0
    for errors, index in TABLE_4_1.values():
        missed += abs(np.std(np.array(errors) / GRAVITY) - index) > PRINTED
        missed += abs(spread_index(np.array(errors)) - index) > PRINTED
    assert missed == 2 * len(TABLE_4_1)


def test_the_worked_example() -> None:
    """Masses of 5.227913, 6.971536, 4.942367 kg against 4.733288 kg are errors of 4.852, 21.957, 2.051 N."""
    masses = [5.227913, 6.971536, 4.942367]
    errors = axis_errors(masses, reference_mass=MASS, gravity=GRAVITY)
    np.testing.assert_allclose(errors, [4.852, 21.957, 2.051], atol=0.0005)
    np.testing.assert_allclose(apparent_masses(np.array(masses) * GRAVITY, gravity=GRAVITY), masses, rtol=1e-15)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_gravity_and_mass_are_positive(bad: float) -> None:
    """Nothing is divided by what is no gravity."""
    with pytest.raises(ForceTorqueError, match="gravity: expected a positive number"):
        apparent_masses([1.0, 1.0, 1.0], gravity=bad)
    with pytest.raises(ForceTorqueError, match="reference_mass: expected a positive number"):
        axis_errors([1.0, 1.0, 1.0], reference_mass=bad, gravity=GRAVITY)
