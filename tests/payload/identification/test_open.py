# SPDX-License-Identifier: BSD-3-Clause
"""What rows leave open is named, in words, and nothing is refused for it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, cast

import numpy as np
import pytest

from forcetorque.payload.identification.estimation_problem import Load
from forcetorque.payload.identification.loads_with_intervals import (
    _untold,
    solve,
    spanned_directions,
    vector_words,
)
from forcetorque.payload.identification.parameter_vector import Kind, Parameter
from forcetorque.payload.identification.robust_fit import directions_of
from tests.payload.identification.payloads import CENTRE, GRAVITY, MASS, SIZES, poses, problem_of, weight

if TYPE_CHECKING:
    from forcetorque.payload.identification.robust_fit import Fit


def _noise(count: int, seed: int) -> np.ndarray:
    return SIZES * np.random.default_rng(seed).normal(size=(count, 6))


def test_one_pose_tells_mass_and_bias_only_together() -> None:
    """Along the gravity of the pose; the centre of mass is told together with the bias of the moment."""
    gravity = np.tile([0.0, 0.0, -GRAVITY], (10, 1))
    solution = solve(problem_of(weight(gravity) + _noise(10, 1), gravity))
    words = solution.open_directions
    assert any(
        one.startswith("the mass of 'tool' and the bias along z are told only together: turn the sensor")
        for one in words
    )
    told = [one.split(":")[0] for one in words]
    assert told == [
        "the mass of 'tool' and the bias along z are told only together",
        "the centre of mass of 'tool' along x, y and the bias in moment are told only together",
        "the centre of mass of 'tool' along z is not told",
    ]
    (load,) = solution.loads
    assert np.isnan(load.mass)
    assert np.isinf(load.mass_half_width)
    assert np.isinf(load.centre_of_mass_half_width).all()
    assert not load.is_determined
    bias = solution.sessions[0]
    assert None not in bias.bias[:2]
    assert bias.bias[2] is None


@pytest.mark.parametrize("bias", [1.0, 50.0])
@pytest.mark.parametrize(("share", "named"), [(0.9e-5, False), (1.1e-3, True)])
def test_an_unknown_has_part_in_a_direction_by_its_share_of_the_largest(bias: float, share: float, named: bool) -> None:
    """A mass and a bias trade off; the tilt that moves along is rounding, or not, whatever the unit of the bias is."""
    kinds = (Kind.MASS, Kind.TILT, Kind.BIAS)
    listed = [Parameter(kind=kind, owner=0, component=0, name=kind.value) for kind in kinds]
    problem = SimpleNamespace(loads=[SimpleNamespace(name="tool")], sessions=["morning"])
    fitted = SimpleNamespace(
        guess=SimpleNamespace(parameters=listed),
        problem=problem,
        unobservable=np.array([[1.0], [share * bias], [bias]]),
    )
    (words,) = _untold(cast("Fit", fitted))
    tilt = " and the tilt" if named else ""
    assert words.split(":")[0] == f"the mass of 'tool'{tilt} and the bias along x are told only together"


@pytest.mark.parametrize("kind", [Kind.BIAS, Kind.DRIFT])
@pytest.mark.parametrize("sessions", [["morning"], ["morning", "noon"]])
def test_an_open_bias_is_named_by_its_axes_and_power_up(kind: Kind, sessions: list[str]) -> None:
    """A force along and a moment about its axis; several at once as forces, as moments, or as both."""
    owner = len(sessions) - 1
    listed = [Parameter(kind=kind, owner=owner, component=k, name=f"{kind} {k}") for k in range(6)]
    problem = SimpleNamespace(loads=[], sessions=sessions)
    session = " of session 'noon'" if owner else ""
    for components, words in (
        *(((k,), f"along {axis}") for k, axis in enumerate("xyz")),
        *(((3 + k,), f"about {axis}") for k, axis in enumerate("xyz")),
        ((0, 2), "in force"),
        ((3, 4), "in moment"),
        ((2, 3), "in force and moment"),
    ):
        fitted = SimpleNamespace(
            guess=SimpleNamespace(parameters=listed), problem=problem, unobservable=np.eye(6)[:, components]
        )
        (text,) = _untold(cast("Fit", fitted))
        assert text.startswith(f"the {kind}{session} {words} is not told: ")


def test_poses_that_turn_leave_nothing_open() -> None:
    """Negative control; about one level axis is enough."""
    angle = np.linspace(0.0, 5.0, 12)
    for gravity in (
        poses(12, np.random.default_rng(2)),
        GRAVITY * np.column_stack([np.sin(angle), np.zeros(12), np.cos(angle)]),
    ):
        solution = solve(problem_of(weight(gravity) + _noise(12, 2), gravity))
        assert solution.open_directions == ()
        assert solution.loads[0].is_determined


def test_poses_that_hardly_turn_have_a_wide_interval() -> None:
    """A turn by a hundredth of a degree is not refused: the interval says what it is worth, and so do words."""
    gravity = poses(1, np.random.default_rng(3)) + 0.002 * poses(12, np.random.default_rng(4))
    solution = solve(problem_of(weight(gravity) + _noise(12, 3), gravity))
    (load,) = solution.loads
    assert np.isfinite(load.mass)
    assert load.mass_half_width > 0.5 * MASS
    assert any("is told only to" in text for text in solution.open_directions)


def test_a_load_that_no_row_has_is_open() -> None:
    """It is neither guessed nor an error."""
    gravity = poses(8, np.random.default_rng(5))
    solution = solve(problem_of(weight(gravity), gravity, loads=(Load(name="a"), Load(name="b"))))
    assert np.isnan(solution.loads[1].mass)
    assert solution.loads[0].mass == pytest.approx(MASS, abs=1e-6)


def test_an_inertia_needs_a_motion() -> None:
    """Still poses do not tell it, and the words say what would."""
    gravity = poses(8, np.random.default_rng(6))
    still = np.zeros((8, 3))
    loads = (Load(name="tool", inertia="unknown"),)
    problem = problem_of(weight(gravity), gravity, loads=loads, angular_velocity=still, angular_acceleration=still)
    (entry,) = solve(problem).open_directions
    assert entry.startswith("the inertia of 'tool' is not told: turn the load with changing speed")


def test_unknown_masses_and_an_unknown_matrix_leave_the_scale_open() -> None:
    """Words say that a known mass gives it; with one it does."""
    gravity = poses(20, np.random.default_rng(7))
    wide = np.array([1e6 * np.eye(6)] * 6)
    reading = weight(gravity) + _noise(20, 7)
    solution = solve(problem_of(reading, gravity, matrix_prior=wide))
    assert any("known masses give the scale" in text for text in solution.open_directions)
    known = (Load(name="tool", mass=MASS, centre_of_mass=CENTRE),)
    stated = solve(problem_of(reading, gravity, matrix_prior=wide, loads=known))
    assert not any("known masses give the scale" in text for text in stated.open_directions)


@pytest.mark.parametrize(
    ("centres", "count"),
    [
        ([[0.0, 0.0, 0.06]], 3),
        ([[0.0, 0.0, 0.06], [0.05, 0.0, 0.06]], 5),
        ([[0.0, 0.0, 0.06], [0.05, 0.0, 0.06], [0.1, 0.0, 0.06]], 5),
        ([[0.0, 0.0, 0.06], [0.05, 0.0, 0.06], [0.0, 0.05, 0.06]], 6),
    ],
    ids=["one", "two", "three on a line", "three"],
)
def test_centres_of_mass_span_directions(centres: list[list[float]], count: int) -> None:
    """One spans three of six directions of wrench, two span five, three that are not on a line six."""
    rng = np.random.default_rng(8)
    wrench = np.vstack([weight(poses(10, rng), 1.0, np.array(centre)) for centre in centres])
    assert spanned_directions(wrench, np.zeros(len(wrench), dtype=np.int64)) == count


def test_directions_are_counted_alike_for_loads_of_any_size() -> None:
    """A billionth of the loads spans what they span; no load spans nothing."""
    gravity = poses(10, np.random.default_rng(9))
    wrench = np.vstack([weight(gravity, 1.0, np.array(centre)) for centre in ([0.0, 0.0, 0.06], [0.05, 0.0, 0.06])])
    session = np.repeat([0, 1], 10)
    for size in (1e-9, 1.0, 1e9):
        assert spanned_directions(size * wrench, session) == 5
    assert spanned_directions(np.zeros((20, 6)), session) == 0


@pytest.mark.parametrize(("moment_Nm", "count"), [(2e-3, 6), (0.5e-3, 3)])
def test_a_moment_counts_as_its_force_at_a_tenth_of_a_metre(moment_Nm: float, count: int) -> None:
    """Beside forces of 10 N along all axes: from a thousandth of them on, which is 1 mN m."""
    wrench = np.diag([10.0, 10.0, 10.0, moment_Nm, moment_Nm, moment_Nm])
    assert spanned_directions(np.vstack([wrench, -wrench]), np.zeros(12, dtype=np.int64)) == count


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_direction_is_named_by_its_axis_or_its_unit_vector(size: float) -> None:
    """Whatever its length and sense; within 1.8 degrees of an axis it is that axis."""
    assert vector_words(size * np.array([0.0, -1.0, 0.0])) == "y"
    assert vector_words(size * np.array([0.03, 0.0, 1.0])) == "z"
    assert vector_words(size * np.array([0.034, 0.0, 1.0])) == "(0.03, 0.00, 1.00)"
    assert vector_words(size * np.array([-3.0, 0.0, 4.0])) == "(-0.60, 0.00, 0.80)"
    assert vector_words(size * np.array([3.0, 0.0, -4.0])) == "(-0.60, 0.00, 0.80)"


@pytest.mark.parametrize(("apart", "count"), [(1.8e-6, 1), (2.2e-6, 2)])
@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_two_unknowns_are_determined_from_two_millionths_apart(apart: float, count: int, unit: float) -> None:
    """Unit columns of which the difference has half of that share of their sum, in any unit of the second unknown."""
    first, other = np.linalg.qr(np.random.default_rng(31).normal(size=(60, 2)))[0].T
    design = np.stack([first, unit * (first + apart * other)], axis=1).reshape(10, 6, 2)
    known, unknown = directions_of(design, np.zeros((2, 2)))
    assert (known.shape[1], unknown.shape[1]) == (count, 2 - count)
    if count == 1:
        change, size = design.reshape(-1, 2) @ unknown[:, 0], np.abs(unknown[:, 0]) * [1.0, unit]
        np.testing.assert_allclose(size[0], size[1], rtol=1e-3)
        assert np.linalg.norm(change) < 1e-5 * size[0]


def test_what_neither_rows_nor_prior_touch_is_open() -> None:
    """All of it; with a prior nothing is."""
    for design in (np.zeros((4, 6, 3)), np.empty((0, 6, 3))):
        assert [one.shape for one in directions_of(design, np.zeros((3, 3)))] == [(3, 0), (3, 3)]
        assert [one.shape for one in directions_of(design, np.eye(3))] == [(3, 3), (3, 0)]
