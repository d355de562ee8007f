# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of a load by its unknowns, against differences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.payload.identification.estimation_problem import Load, LoadProblem
from forcetorque.payload.identification.measurement_model import changes, expected, inertial
from forcetorque.payload.identification.parameter_vector import Guess, Kind, unknowns_of
from forcetorque.robot.mount_estimate import rotation_by
from tests.payload.identification.payloads import CENTRE, MASS, poses, problem_of, weight
from tests.payload.identification.test_published_quantities import PROBLEMS

STEP = 1e-6
"""kg, kg m, kg m2."""
TOLERANCE = 1e-8
"""Third derivatives are below 1e3, so that a central difference errs by 1e-9; its rounding is 1e-10."""
STATED = np.diag([4e-3, 3e-3, 2e-3])
NEAR = 1e-5
"""Of the largest change: the library's step and this one leave the squares of them, 1e-10, and rounding over them."""


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


def _tilted() -> LoadProblem:
    """Poses by orientations in a world that may not be level, with a mount that may not be the stated one."""
    turns = Rotation.random(8, random_state=6).as_matrix()
    gravity = np.einsum("nji,j->ni", turns, [0.0, 0.0, -9.80665])
    return problem_of(weight(gravity), gravity, orientation=turns, tilt=True, mount=True)


EVERY_KIND = {**PROBLEMS, "tilted": _tilted}


@pytest.mark.parametrize("name", EVERY_KIND)
def test_expected_readings_change_with_every_unknown_as_differences_say(name: str) -> None:
    """About values other than zero, so that intervals are those of the unknowns: loads, matrix, mount, tilt, biases."""
    problem = EVERY_KIND[name]()
    parameters, rng = unknowns_of(problem, drift=True), np.random.default_rng(3)
    mount = rotation_by(np.array([0.3, -0.2, 0.5]))
    small = [one.kind in (Kind.MOUNT, Kind.TILT, Kind.MATRIX) for one in parameters]
    values = np.where(small, 0.05, 1.0) * rng.uniform(0.5, 1.5, size=len(parameters))
    guess = replace(Guess.zero(parameters, mount), values=values)
    change = changes(problem, guess)
    assert change.shape == (len(problem.rows), 6, len(parameters))
    for k, step in enumerate(1e-4 * np.eye(len(parameters))):
        ahead, behind = (expected(problem, replace(guess, values=values + side * step)) for side in (1.0, -1.0))
        difference = (ahead - behind) / 2e-4
        assert np.abs(difference).max() > 0.0
        np.testing.assert_allclose(
            change[:, :, k], difference, atol=NEAR * np.abs(difference).max(), err_msg=parameters[k].name
        )


def test_every_kind_of_unknown_is_in_a_problem() -> None:
    """So that the derivative by each is compared."""
    assert {one.kind for make in EVERY_KIND.values() for one in unknowns_of(make(), drift=True)} == set(Kind)
