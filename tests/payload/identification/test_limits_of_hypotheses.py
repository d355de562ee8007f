# SPDX-License-Identifier: BSD-3-Clause
"""What is named, and what is said to be hardly told, on either side of its limit."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.payload.identification.axis_and_mount_errors import _gain_words, _mount_words, axis_errors
from forcetorque.payload.identification.bias_drift_and_jumps import _places
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem
from forcetorque.payload.identification.frame_unit_and_clock_errors import (
    _lag,
    _moves,
    _of_nothing,
    _reversed,
    unexplained,
)
from forcetorque.payload.identification.load_estimates import HypothesisRow
from forcetorque.payload.identification.loads_with_intervals import _vague, spanned_directions
from forcetorque.payload.identification.parameter_vector import Kind
from forcetorque.payload.identification.robust_fit import fit, plain_fit, scales
from forcetorque.robot.mount_estimate import rotation_vector
from tests.payload.identification.payloads import CENTRE, GRAVITY, MASS, SIZES, poses, problem_of, weight

COUNT = 40
DOWN = poses(COUNT, np.random.default_rng(91))
NOISE = SIZES * np.random.default_rng(92).normal(size=(COUNT, 6))


def _about_down(share: float) -> FloatArray:
    """Gravity that is off its mean by a share of itself, root mean square; m/s2."""
    angle = np.arcsin(share)
    turns = np.linspace(0.0, 2.0 * np.pi, COUNT, endpoint=False)
    ring = [np.sin(angle) * np.cos(turns), np.sin(angle) * np.sin(turns), np.full(COUNT, np.cos(angle))]
    return GRAVITY * np.stack(ring, axis=1)


@pytest.mark.parametrize(("share", "moves"), [(0.0099, False), (0.0101, True)])
def test_a_load_moves_from_a_hundredth_of_gravity_on(share: float, moves: bool) -> None:
    """About its mean in every power-up; between power-ups it may be anywhere. Another load on the hook moves too."""
    down = _about_down(share)
    assert _moves(problem_of(weight(down), down).rows) == moves
    two, session = np.vstack([down, down @ Rotation.from_rotvec([1.0, 0.0, 0.0]).as_matrix()]), np.repeat([0, 1], COUNT)
    assert _moves(problem_of(weight(two), two, session=session, block=session).rows) == moves
    loads = (Load(name="tool"), Load(name="weight"))
    assert _moves(problem_of(weight(down), down, load=np.repeat([0, 1], COUNT // 2), loads=loads).rows)


def _mass_in_half_widths(count: float, down: FloatArray) -> LoadProblem:
    """Readings of a mass whose estimate is so many of its half-widths; what noise makes of it is taken off."""
    alone = fit(problem_of(NOISE, down), drift=False)
    (k,) = alone.guess.index[Kind.MASS, 0]
    mass = count * alone.half_width[k] - alone.guess.values[k]
    return problem_of(weight(down, mass, np.zeros(3)) + NOISE, down)


@pytest.mark.parametrize(("count", "names"), [(-2.02, ["reversed direction"]), (-1.98, []), (2.02, [])])
def test_a_mass_two_half_widths_below_zero_reverses_the_sense(count: float, names: list[str]) -> None:
    """By the estimate and its interval."""
    assert [row.name for row in _reversed(fit(_mass_in_half_widths(count, DOWN), drift=False))] == names


@pytest.mark.parametrize(
    ("count", "share", "names"),
    [
        (0.98, 1.0, ["no load"]),
        (-0.98, 1.0, ["no load"]),
        (1.02, 1.0, []),
        (0.98, 0.101, ["no load"]),
        (0.98, 0.099, []),
    ],
)
def test_nothing_hangs_where_gravity_turns_and_no_mass_is_told(count: float, share: float, names: list[str]) -> None:
    """Within one half-width of 0, with gravity that is a tenth of itself off its mean."""
    down = DOWN if share == 1.0 else _about_down(share)
    fitted = fit(_mass_in_half_widths(count, down), drift=False)
    assert [row.name for row in _of_nothing(fitted)] == names


def _accounts(factor: float, noise: float = 0.0, **fields: Any) -> list[HypothesisRow]:
    load = (Load(name="tool", mass=MASS, centre_of_mass=CENTRE),)
    reading = weight(DOWN) * np.repeat([factor, 1.0], 3) + noise * NOISE
    problem = problem_of(reading, DOWN, loads=load, **fields)
    return list(scales(problem, plain_fit(problem, drift=False)[0], other_sizes=True))


@pytest.mark.parametrize(
    ("factor", "name"),
    [
        (1.99, None),
        (2.01, "another size"),
        (0.503, None),
        (0.497, "another size"),
        (4.4482216 * 1.019, "mixed units"),
        (4.4482216 * 0.981, "mixed units"),
        (4.4482216 * 1.021, "another size"),
        (4.4482216 * 0.979, "another size"),
    ],
)
def test_readings_are_of_another_size_beyond_a_factor_of_two_and_of_a_unit_within_two_percent(
    factor: float, name: str | None
) -> None:
    """Of forces alone, without noise; moments are as they should be."""
    assert [row.name for row in _accounts(factor)] == ([] if name is None else [name])


def test_another_size_is_four_standard_errors_beyond_the_factor() -> None:
    """By the scatter of five readings in each of two power-ups about the multiple, in closed form."""
    down, session = DOWN[:10], np.repeat([0, 1], 5)
    flat, noise = (
        np.concatenate([part - part.mean(axis=0) for part in (one[:5, :3], one[5:, :3])])
        for one in (weight(down), 20.0 * NOISE[:10])
    )
    noise -= flat * (flat * noise).sum() / (flat**2).sum()  # the multiple itself is exact
    # thirty values, six biases and a multiple
    error = np.sqrt((noise**2).sum() / 23.0 / (flat**2).sum())
    for beyond, is_named in ((3.9, False), (4.1, True)):
        reading = weight(down)
        reading[:, :3] = (2.0 + beyond * error) * reading[:, :3] + noise
        load = (Load(name="tool", mass=MASS, centre_of_mass=CENTRE),)
        problem = problem_of(reading, down, loads=load, session=session, block=session)
        rows = list(scales(problem, plain_fit(problem, drift=False)[0], other_sizes=True))
        assert bool(rows) == is_named


def test_what_is_left_of_the_change_of_the_readings_is_that_of_forces_and_moments_alike() -> None:
    """By hand: 30 % of the forces and 40 % of the moments are 35 % in root mean square; a constant is no change."""
    reading = weight(DOWN) + [100.0, 0.0, -50.0, 3.0, 1.0, 2.0]
    rows = problem_of(reading, DOWN).rows
    left = (reading - reading.mean(axis=0)) * np.repeat([0.3, 0.4], 3)
    assert unexplained(rows, left) == pytest.approx(np.sqrt(0.5 * (0.3**2 + 0.4**2)), rel=1e-12)


def _swinging(largest: float, lag: float = 0.5) -> LoadProblem:
    """Gravity that turns by a share of itself from row to row where it turns fastest, and readings that lag it."""
    time = 0.5 * np.arange(60.0)
    rate = np.pi * (1.0 + np.sin(0.7 * time))
    step = 2.0 * np.arcsin(0.5 * largest)

    def down(at: FloatArray) -> FloatArray:
        angle = np.interp(at, time, np.cumsum(rate) / rate.max() * step)
        return GRAVITY * np.stack([np.cos(angle), np.sin(angle) * 0.0, np.sin(angle)], axis=1)

    return problem_of(weight(down(time - lag)), down(time), time_s=time)


@pytest.mark.parametrize(("largest", "names"), [(0.49, ["lag"]), (0.51, [])])
def test_a_lag_is_looked_for_where_gravity_turns_by_less_than_half_of_itself(largest: float, names: list[str]) -> None:
    """From one row to the next; poses one after the other have none."""
    problem = _swinging(largest)
    assert [row.name for row in _lag(problem, plain_fit(problem, drift=False)[1], drift=False)] == names


def test_few_rows_name_no_axis() -> None:
    """With four rows beyond the unknowns of an axis a gain is looked for, with fewer any cause explains them."""
    rng = np.random.default_rng(93)
    for count, is_named in ((5, False), (6, True)):
        down = poses(count, rng)
        reading = weight(down) + 1e-6 * SIZES * rng.normal(size=(count, 6))
        reading[:, 2] *= 1.3
        fitted = fit(problem_of(reading, down), drift=False)
        # ten unknowns of six axes are 1.7 rows
        assert bool(list(axis_errors(fitted, permuted=False, drift=False))) == is_named


@pytest.mark.parametrize(("count", "told"), [(1.98, False), (2.02, True), (-2.02, True)])
def test_a_mass_is_told_from_two_half_widths_on(count: float, told: bool) -> None:
    """Its interval is as wide as half of it, of either sign."""
    fitted = fit(_mass_in_half_widths(count, DOWN), drift=False)
    assert any(words.startswith("the mass of 'tool' is told only to") for words in _vague(fitted)) != told


@pytest.mark.parametrize(("share", "told"), [(0.98, True), (1.02, False)])
def test_a_centre_of_mass_is_told_to_five_centimetres(share: float, told: bool) -> None:
    """Half-width of the first moment over the mass, of a stated mass and of an estimated one, along each axis."""
    for loads in ((Load(name="tool", mass=MASS),), (Load(name="tool"),)):
        once = fit(problem_of(weight(DOWN) + NOISE, DOWN, loads=loads), drift=False)
        places = once.guess.index[Kind.FIRST_MOMENT, 0]
        factor = share * 0.05 * MASS / once.half_width[places].max()
        noise = NOISE * np.repeat([1.0, factor], 3)
        fitted = fit(problem_of(weight(DOWN) + noise, DOWN, loads=loads), drift=False)
        named = [words for words in _vague(fitted) if words.startswith("the centre of mass of 'tool' along")]
        assert bool(named) != told
        assert told or "is told only to 51 mm" in named[0]


@pytest.mark.parametrize(("share", "count"), [(1.02e-3, 2), (0.98e-3, 1)])
def test_a_direction_of_wrench_is_spanned_from_a_thousandth_of_the_strongest(share: float, count: int) -> None:
    """About the mean of every power-up."""
    signs = np.array([1.0, -1.0, 1.0, -1.0]), np.array([1.0, 1.0, -1.0, -1.0])
    wrench = np.zeros((4, 6))
    wrench[:, 1], wrench[:, 2] = 50.0 * signs[0], 50.0 * share * signs[1]
    assert spanned_directions(wrench, np.zeros(4, dtype=np.int64)) == count
    assert spanned_directions(wrench + 7.0, np.zeros(4, dtype=np.int64)) == count


def test_a_jump_is_looked_for_from_the_third_row_to_the_third_last() -> None:
    """Not at the first and last two, which any row that disagrees would be; at 400 places of a long recording."""
    for count in (6, 20, 400):
        np.testing.assert_array_equal(_places(count), np.arange(3, count - 2))
    assert 400 <= len(_places(1000)) < 800
    assert np.ptp(np.diff(_places(1000))) == 0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_gain_is_named_from_two_of_its_half_widths_on(sign: float) -> None:
    """By the fit of one coefficient that is free; gains on either side are found from its estimate at two others."""

    def refit(gain: float) -> tuple[LoadProblem, float]:
        reading = weight(DOWN) + NOISE
        reading[:, 2] *= 1.0 + gain
        problem = problem_of(reading, DOWN)
        prior = np.tile(1e-12 * np.eye(6), (6, 1, 1))
        prior[2, 2, 2] = 1.0
        fitted = fit(replace(problem, matrix_prior=prior), drift=False)
        place = fitted.guess.index[Kind.MATRIX, 2][2]
        return problem, float(fitted.guess.values[place] / fitted.half_width[place])

    cause: Any = SimpleNamespace(axes=(2,), words="fz changes by {gain}")
    none, some = refit(0.0)[1], refit(0.02 * sign)[1]
    for count, is_named in ((1.95, False), (2.05, True)):
        gain = 0.02 * sign * (sign * count - none) / (some - none)
        problem, ratio = refit(gain)
        assert ratio == pytest.approx(sign * count, abs=0.045)
        assert (_gain_words(problem, cause, drift=False) is not None) == is_named


@pytest.mark.parametrize("axis", range(3))
def test_a_mount_is_named_from_two_of_its_half_widths_on(axis: int) -> None:
    """In the component of its rotation that is surest."""
    cause: Any = SimpleNamespace(words="turned by {turn}", problem=None)
    squares = np.ones(6), np.ones(6)
    rotation = np.eye(3)[axis]

    def surest(angle: float) -> tuple[LoadProblem, float]:
        turned = Rotation.from_rotvec(angle * rotation).apply(DOWN)
        problem = replace(problem_of(weight(turned) + NOISE, DOWN), mount=True)
        fitted = fit(problem, drift=False)
        own = fitted.guess.index[Kind.MOUNT, 0]
        return problem, float(np.abs(rotation_vector(fitted.guess.rotation) / fitted.half_width[own]).max())

    angles = np.array([0.01, 0.06])
    ratios = np.array([surest(float(angle))[1] for angle in angles])
    for count, is_named in ((1.95, False), (2.05, True)):
        angle = float(angles[0] + (count - ratios[0]) / (ratios[1] - ratios[0]) * (angles[1] - angles[0]))
        problem, ratio = surest(angle)
        assert ratio == pytest.approx(count, abs=0.045)
        cause.problem = problem
        assert (_mount_words(cause, squares, drift=False) is not None) == is_named
