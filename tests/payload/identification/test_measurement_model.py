# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of a load by its unknowns, against differences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.payload.identification.estimation_problem import Load
from forcetorque.payload.identification.measurement_model import inertial
from forcetorque.payload.identification.parameter_vector import Guess, unknowns_of
from tests.payload.identification.payloads import CENTRE, MASS, poses, problem_of, weight

STEP = 1e-6
"""kg, kg m, kg m2."""
TOLERANCE = 1e-8
"""Third derivatives are below 1e3, so that a central difference errs by 1e-9; its rounding is 1e-10."""
STATED = np.diag([4e-3, 3e-3, 2e-3])


@pytest.mark.parametrize("mass", [None, MASS])
@pytest.mark.parametrize("centre", [None, CENTRE])
@pytest.mark.parametrize("inertia", [None, STATED, "unknown"], ids=["point", "stated", "unknown"])
def test_a_load_changes_with_its_unknowns_as_differences_say(
    mass: float | None, centre: np.ndarray | None, inertia: np.ndarray | str | None
) -> None:
    """Mass, first moment and inertia about the sensor, whatever of them is stated."""
    load = Load(name="tool", mass=mass, centre_of_mass=centre, inertia=inertia)  # type: ignore[arg-type]
    gravity = poses(6, np.random.default_rng(1))
    parameters = unknowns_of(problem_of(weight(gravity), gravity, loads=(load,)), drift=False)
    values = np.random.default_rng(2).uniform(0.5, 1.5, size=len(parameters))
    guess = replace(Guess.zero(parameters), values=values)
    own = [k for k, parameter in enumerate(parameters) if parameter.kind.name in ("MASS", "FIRST_MOMENT", "INERTIA")]
    _, change = inertial(load, 0, guess)
    assert change.shape == (10, len(own))
    for column, place in enumerate(own):
        step = STEP * np.eye(len(parameters))[place]
        ahead, behind = (inertial(load, 0, replace(guess, values=values + side * step))[0] for side in (1.0, -1.0))
        np.testing.assert_allclose(change[:, column], (ahead - behind) / (2.0 * STEP), atol=TOLERANCE)
    assert len(own) == 1 * (mass is None) + 3 * (centre is None) + 6 * isinstance(inertia, str)
