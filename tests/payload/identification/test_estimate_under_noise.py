# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns under noise of forces and moments apart: degrees of freedom by hand, and units that change nothing."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import chi2

from forcetorque.base.noise.slow_noise import SlowNoise
from forcetorque.payload.identification.estimate_under_noise import estimate, groups_of, noise_sizes
from forcetorque.payload.identification.estimation_problem import LoadRows
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.identification.robust_fit import row_distances
from tests.payload.identification.payloads import SIZES, poses, problem_of, slow, weight

WHITE = SlowNoise(time_constant_s=0.0, ratio=0.0)
COUNT = 10


@pytest.mark.parametrize("unit", [1.0, 1e-4, 1e4])
def test_degrees_of_freedom_are_those_of_satterthwaite_in_any_unit(unit: float) -> None:
    """What only forces tell has their 30 values less two unknowns; what both tell has some of each, by information."""
    rng = np.random.default_rng(1)
    design = np.zeros((COUNT, 6, 2))
    design[:, :3, 0] = rng.normal(size=(COUNT, 3))
    design[:, :, 1] = rng.normal(size=(COUNT, 6))
    values = rng.normal(size=(COUNT, 6))
    rows = LoadRows.of_poses(np.zeros((COUNT, 6)), rng.normal(size=(COUNT, 3)))
    groups = groups_of(rows, unit * design, values, np.ones(6), np.ones(COUNT))
    nothing = np.zeros((2, 2)), np.zeros(2)
    result = estimate(groups, np.eye(2), nothing, (WHITE,))
    information, left = [], []
    for axes, unknowns in ((slice(3), [0, 1]), (slice(3, 6), [1])):
        columns, read = design[:, axes].reshape(-1, 2)[:, unknowns], values[:, axes].ravel()
        residual = read - columns @ np.linalg.lstsq(columns, read, rcond=None)[0]
        left.append(3 * COUNT - len(unknowns))
        information.append(float((columns[:, -1] ** 2).sum() / ((residual @ residual) / left[-1])))
    share = np.array(information) / sum(information)
    both = 1.0 / (share**2 / left).sum()
    np.testing.assert_allclose(result.degrees_of_freedom, [28.0, both], rtol=1e-9)
    assert 28.0 < both < 57.0


def test_the_covariance_of_several_shapes_is_that_of_their_mixture() -> None:
    """As drawn from it: what shapes differ by widens it, and so does each by itself."""
    rng = np.random.default_rng(5)
    design, time = rng.normal(size=(COUNT, 6, 2)), np.arange(float(COUNT))
    values = rng.normal(size=(COUNT, 6)) + np.column_stack([slow(COUNT, 3.0, rng) for _ in range(6)])
    rows = LoadRows.of_poses(np.zeros((COUNT, 6)), rng.normal(size=(COUNT, 3)), time_s=time)
    groups = groups_of(rows, design, values, np.ones(6), np.ones(COUNT))
    shapes = (WHITE, SlowNoise(time_constant_s=3.0, ratio=1.0))
    result = estimate(groups, np.eye(2), (np.zeros((2, 2)), np.zeros(2)), shapes)
    assert result.weights.max() < 0.6
    np.testing.assert_allclose(result.weights @ result.apart, 0.0, atol=1e-12)
    # two points a standard deviation to each side have the covariance of a shape
    sides = np.concatenate([np.eye(2), -np.eye(2)])
    roots = np.linalg.cholesky(result.spreads)
    points = result.apart[:, None] + np.sqrt(2.0) * np.einsum("krs,ns->knr", roots, sides)
    drawn = np.einsum("k,knr,kns->rs", result.weights, points, points) / len(sides)
    np.testing.assert_allclose(result.covariance, drawn, rtol=1e-9)
    apart = np.einsum("k,kr->r", result.weights, result.apart**2)
    assert (apart > 0.01 * np.diag(result.covariance)).all()


def test_estimated_sizes_of_axes_widen_what_several_axes_tell() -> None:
    """As in Meier's weighted mean, by `1 + 4 sum s (1 - s) / degrees of freedom`; what one axis tells is not."""
    rng = np.random.default_rng(7)
    design = np.zeros((COUNT, 6, 2))
    design[:, :, 0] = rng.normal(size=(COUNT, 6))
    design[:, 0] = [[0.0, value] for value in rng.normal(size=COUNT)]
    values = rng.normal(size=(COUNT, 6))
    rows = LoadRows.of_poses(np.zeros((COUNT, 6)), rng.normal(size=(COUNT, 3)))
    groups = groups_of(rows, design, values, np.ones(6), np.ones(COUNT))
    result = estimate(groups, np.eye(2), (np.zeros((2, 2)), np.zeros(2)), (WHITE,))
    information = np.empty((6, 2))
    for axes, unknowns in ((slice(3), 2), (slice(3, 6), 1)):
        columns, read = design[:, axes].reshape(-1, 2)[:, :unknowns], values[:, axes].ravel()
        residual = read - columns @ np.linalg.lstsq(columns, read, rcond=None)[0]
        information[axes] = (design[:, axes] ** 2).sum(axis=0) * (3 * COUNT - unknowns) / (residual @ residual)
    share = information / information.sum(axis=0)
    factor = 1.0 + 4.0 * (share * (1.0 - share) / (COUNT - share.sum(axis=1, keepdims=True))).sum(axis=0)
    np.testing.assert_allclose(result.covariance, np.diag(factor / information.sum(axis=0)), rtol=1e-9)
    assert factor[0] > 1.2
    assert factor[1] == 1.0


def test_what_no_row_tells_has_no_degree_of_freedom() -> None:
    """It stays what the prior says, and its interval is infinite."""
    rng = np.random.default_rng(3)
    design = np.concatenate([rng.normal(size=(COUNT, 6, 1)), np.zeros((COUNT, 6, 1))], axis=2)
    rows = LoadRows.of_poses(np.zeros((COUNT, 6)), rng.normal(size=(COUNT, 3)))
    groups = groups_of(rows, design, rng.normal(size=(COUNT, 6)), np.ones(6), np.ones(COUNT))
    result = estimate(groups, np.eye(2), (np.diag([0.0, 4.0]), np.array([0.0, 12.0])), (WHITE,))
    assert result.mean[1] == pytest.approx(3.0)
    assert result.covariance[1, 1] == pytest.approx(0.25)
    assert result.degrees_of_freedom[0] > 29.0
    assert result.degrees_of_freedom[1] == 0.0
    first, second = result.half_widths(np.eye(2))
    # two halves of 60 values, nearly a normal distribution
    assert 1.96 < first / np.sqrt(result.covariance[0, 0]) < 2.1
    assert second == np.inf


@pytest.mark.parametrize(("noise", "least"), [(0.0, True), (1e-8, False)])
def test_exact_rows_have_noise_of_a_ten_billionth_of_their_size(noise: float, least: bool) -> None:
    """So that they have a covariance; noise above it is what 30 values less two unknowns say."""
    rng = np.random.default_rng(9)
    design, truth = rng.normal(size=(COUNT, 6, 2)), np.array([1.0, 2.0])
    error = noise * rng.normal(size=(COUNT, 6))
    rows = LoadRows.of_poses(np.zeros((COUNT, 6)), rng.normal(size=(COUNT, 3)))
    groups = groups_of(rows, design, design @ truth + error, np.ones(6), np.ones(COUNT))
    result = estimate(groups, np.eye(2), (np.zeros((2, 2)), np.zeros(2)), (WHITE,))
    np.testing.assert_allclose(result.mean, truth, atol=max(noise, 1e-14))
    for axes, variance in zip((slice(3), slice(3, 6)), result.variances, strict=True):
        columns, own = design[:, axes].reshape(-1, 2), error[:, axes].ravel()
        left = own - columns @ np.linalg.lstsq(columns, own, rcond=None)[0]
        assert variance == pytest.approx((30 * 1e-20 if least else left @ left) / 28, rel=1e-6)


def test_an_axis_has_at_least_a_tenth_of_the_noise_of_the_loudest() -> None:
    """Forces and moments apart; exact rows have the size 1."""
    residual = np.array([[3.0, 0.1, 1.0, 0.0, 0.0, 0.0], [-3.0, 0.1, -1.0, 0.0, 0.0, 0.0]])
    np.testing.assert_allclose(noise_sizes(residual), [3.0, 0.3, 1.0, 1.0, 1.0, 1.0], rtol=1e-12)
    np.testing.assert_allclose(noise_sizes(np.fliplr(residual)), [1.0, 1.0, 1.0, 1.0, 0.3, 3.0], rtol=1e-12)
    np.testing.assert_array_equal(noise_sizes(np.empty((0, 6))), np.ones(6))


@pytest.mark.parametrize(("sessions", "step_s"), [((0, 1, 2), 0.5), ((0, 0, 0), 0.5), ((0, 1, 2), 0.0)])
def test_forces_and_moments_are_stacked_axis_by_axis_in_time(sessions: tuple[int, ...], step_s: float) -> None:
    """Every value once, over its size; time counts in the usual step within a power-up, whatever lies between them.

    Rows at one instant have no step, and a usual step of all of them is none.
    """
    rng = np.random.default_rng(4)
    session = np.tile(sessions, 5)  # rows of three power-ups in turn, as logs of several sensors are
    time = step_s * np.repeat([0.0, 0.0, 0.0, 1.0, 2.0], 3) + 1000.0 * session
    count = len(session)
    values, design = rng.normal(size=(count, 6)), rng.normal(size=(count, 6, 4))
    sizes, weight, share = rng.uniform(0.5, 2.0, 6), rng.uniform(0.1, 1.0, count), rng.uniform(0.5, 1.0, count)
    rows = LoadRows.of_poses(
        np.zeros((count, 6)), rng.normal(size=(count, 3)), session=session.tolist(), time_s=time, share=share
    )
    groups = groups_of(rows, design, values, sizes, weight)
    for first, group in zip((0, 3), groups, strict=True):
        axis = np.repeat([first, first + 1, first + 2], count)
        assert sorted(zip(axis, group.order, strict=True)) == [
            (a, row) for a in range(first, first + 3) for row in range(count)
        ]
        np.testing.assert_allclose(group.values, values[group.order, axis] / sizes[axis])
        np.testing.assert_allclose(group.design, design[group.order, axis] / sizes[axis][:, None])
        np.testing.assert_allclose(group.line.share, (share * weight)[group.order])
        np.testing.assert_allclose((step_s or 1.0) * group.line.time_s, time[group.order])
        # slow noise goes on within one axis of one power-up, whose rows stand together
        chains = list(zip(axis, session[group.order], strict=True))
        for k, chain in enumerate(group.line.recording):
            assert [other == chain for other in group.line.recording] == [other == chains[k] for other in chains]
        assert np.count_nonzero(np.diff(group.line.recording)) == 3 * len(set(sessions)) - 1


@pytest.mark.long
def test_the_unit_of_time_does_not_change_what_slow_noise_makes_of_a_load() -> None:
    """Rows a second apart and rows an hour apart, in two power-ups, of which the second may be much later."""
    rng = np.random.default_rng(2)
    gravity = poses(40, rng)
    noise = rng.normal(size=(40, 6)) + np.column_stack([3.0 * slow(40, 6.0, rng) for _ in range(6)])
    session = np.repeat([0, 1], 20)
    reading, time = weight(gravity) + SIZES * noise, np.arange(40.0) + 500.0 * session
    fields = {"session": session, "block": session, "drift": False}
    first = solve(problem_of(reading, gravity, time_s=time, **fields)).loads[0]
    for other_time in (3600.0 * time, time + 9000.0 * session):
        second = solve(problem_of(reading, gravity, time_s=other_time, **fields)).loads[0]
        assert second.mass == pytest.approx(first.mass, rel=1e-9)
        assert second.mass_half_width == pytest.approx(first.mass_half_width, rel=1e-6)
    # negative control: rows that follow each other otherwise have another noise
    mixed = np.concatenate([rng.permutation(20), 20 + rng.permutation(20)])
    other = solve(problem_of(reading[mixed], gravity[mixed], time_s=time, **fields)).loads[0]
    assert abs(other.mass_half_width / first.mass_half_width - 1.0) > 0.01


def test_the_distance_of_a_row_is_that_of_its_values_from_what_all_others_foretell() -> None:
    """By leaving out one value at a time of the dense covariance: with slow noise, a prior and rows that count less.

    The value that is left out counts as one of full weight, so that a row is as far whatever it counted.
    """
    rng = np.random.default_rng(8)
    count, unknowns = 12, 3
    design, time = rng.normal(size=(count, 6, unknowns)), np.arange(float(count))
    values = rng.normal(size=(count, 6)) + np.column_stack([2.0 * slow(count, 3.0, rng) for _ in range(6)])
    share = rng.uniform(0.5, 1.0, count)
    rows = LoadRows.of_poses(np.zeros((count, 6)), rng.normal(size=(count, 3)), time_s=time, share=share)
    prior = np.diag([0.0, 1.0, 4.0]), np.array([0.0, 2.0, -3.0])
    shapes = (WHITE, SlowNoise(time_constant_s=3.0, ratio=1.0))
    weight = np.where(np.arange(count) % 4 == 1, 0.02, 1.0)
    result = estimate(groups_of(rows, design, values, np.ones(6), weight), np.eye(unknowns), prior, shapes)
    assert len(result.weights) > 1
    left = groups_of(rows, design, values - design @ result.mean, np.ones(6), weight)
    distance = row_distances(left, np.eye(unknowns), result, weight)

    flat = [np.moveaxis(one, 0, 1).reshape(6 * count, -1) for one in (design, values)]
    columns, read = flat[0], flat[1][:, 0]
    lag = np.abs(np.subtract.outer(time, time))
    slow_part = [np.exp(-lag / max(one.time_constant_s, 1e-9)) * one.ratio for one in result.shapes]
    variance = np.repeat(result.variances, 3)
    noise = np.zeros((6 * count, 6 * count))
    full = np.zeros(6 * count)
    for axis in range(6):
        own = slice(axis * count, (axis + 1) * count)
        noise[own, own] = variance[axis] * (np.diag(1.0 / (share * weight)) + slow_part[axis // 3])
        full[own] = variance[axis] * (1.0 / share + np.diag(slow_part[axis // 3]))
    wanted = np.zeros(6 * count)
    for place in range(6 * count):
        others = np.delete(np.arange(6 * count), place)
        inverse = np.linalg.inv(noise[np.ix_(others, others)])
        x, y = columns[others], read[others]
        covariance = np.linalg.inv(prior[0] + x.T @ inverse @ x)
        mean = covariance @ (prior[1] + x.T @ inverse @ y)
        along = noise[place, others] @ inverse
        change = columns[place] - along @ x
        foretold = columns[place] @ mean + along @ (y - x @ mean)
        spread = full[place] - along @ noise[others, place] + change @ covariance @ change
        wanted[place] = (read[place] - foretold) ** 2 / spread
    total = wanted.reshape(6, count).sum(axis=0)
    np.testing.assert_allclose(distance, total * chi2.median(6.0) / np.median(total), rtol=1e-4)
