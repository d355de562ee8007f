# SPDX-License-Identifier: BSD-3-Clause
"""Pooled trials: one shape with a centre for each, against the mean of the trials and against pooling as they stand."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from forcetorque.base.errors import FitError, ForceTorqueError, ShapeError
from forcetorque.evaluation.sphere.affine_fit import fit_mapped
from forcetorque.evaluation.sphere.ellipsoid import TOLERANCE, Ellipsoid, ellipsoid_of_map
from forcetorque.evaluation.sphere.pooled_fit import PooledSphere, fit_with_own_centres, pool_trials
from forcetorque.evaluation.sphere.resampling import jackknife_margin
from forcetorque.evaluation.sphere.sensor_sphere import SphereAnalysis, analyse_sphere
from tests.cases import some_cases
from tests.evaluation.sphere.clouds import DEFORMED, WEIGHT, grid, map_of, whole_sphere

OFFSETS = np.array([[12.0, -30.0, 55.0], [4.0, -22.0, 60.0], [-6.0, -35.0, 48.0]])
"""What a sensor reads without force after three power-ups; N."""
NOISE = 0.5
"""White noise of a reading; N."""
EXACT = 1e-6
"""Convergence of the geometric fit, 1e-7 of some 50 N, with room."""
TRUE_INDEX = float(np.std(DEFORMED.axis_intersections, ddof=1))
NEARLY_GOOD = ellipsoid_of_map(np.diag([1.0, 1.001, 0.999]), centre=np.zeros(3), radius=WEIGHT)
"""A calibrated sensor, whose index is below what noise makes of it in one short trial."""


def _trials(
    rng: np.random.Generator, parts: list[np.ndarray], *, noise: float = NOISE, of: Ellipsoid = DEFORMED
) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Forces and references of trials that go over these directions, each with its offset."""
    forces = [
        directions @ map_of(of).T + offset + noise * rng.normal(size=directions.shape)
        for directions, offset in zip(parts, OFFSETS, strict=False)
    ]
    return forces, [WEIGHT * directions for directions in parts]


def _whole_grids(count: int = 700) -> list[np.ndarray]:
    return [grid(count, 110.0)] * 3


def _caps(count: int = 700, half_deg: float = 45.0) -> list[np.ndarray]:
    """Grids about three axes, none of which says much by itself."""
    part = grid(count, half_deg)
    return [part, part[:, [2, 0, 1]], part[:, [1, 2, 0]]]


def _analysed(force: np.ndarray, reference: np.ndarray) -> SphereAnalysis:
    wrench, expected = (np.hstack([f, 0.1 * f[:, ::-1]]) for f in (force, reference))
    return analyse_sphere(wrench, expected, gravity=9.81)


def _error(pooled: PooledSphere) -> tuple[float, float]:
    assert pooled.mapped is not None
    return pooled.free.index - TRUE_INDEX, pooled.mapped.index - TRUE_INDEX


def test_exact_forces_give_the_ellipsoid_and_every_centre() -> None:
    """Without noise nothing is left: shape, index and the three offsets, with the model and without."""
    forces, references = _trials(np.random.default_rng(1), _whole_grids(), noise=0.0)
    pooled = pool_trials(forces, references, weight=WEIGHT)
    # the true map takes the unit sphere there, and symmetric or not, it is the same ellipsoid
    for fit in (pooled.free, pooled.mapped):
        assert fit is not None
        assert fit.identifiable
        assert fit.ellipsoid is not None
        np.testing.assert_allclose(fit.ellipsoid.axis_intersections, DEFORMED.axis_intersections, atol=EXACT)
        np.testing.assert_allclose(fit.ellipsoid.half_widths, DEFORMED.half_widths, atol=EXACT)
        np.testing.assert_allclose(fit.ellipsoid.centre, 0.0, atol=EXACT)
    np.testing.assert_allclose(pooled.mapped_centres, OFFSETS, atol=EXACT)
    np.testing.assert_allclose(pooled.free_centres, OFFSETS, atol=EXACT)


def test_with_the_model_it_is_the_regression_with_an_offset_for_each() -> None:
    """Against least squares with indicator columns; trials of any length and coverage."""
    rng = np.random.default_rng(2)
    parts = [grid(300, 40.0), grid(211, 70.0)[:, [1, 2, 0]], whole_sphere(97)]
    forces, references = _trials(rng, parts)
    pooled = pool_trials(forces, references, weight=WEIGHT)
    belongs = np.repeat(np.eye(3), [len(part) for part in parts], axis=0)
    columns, measured = np.hstack([np.concatenate(references), belongs]), np.concatenate(forces)
    solved = np.linalg.lstsq(columns, measured, rcond=None)[0]
    expected = ellipsoid_of_map(solved[:3].T, centre=np.zeros(3), radius=WEIGHT)
    assert pooled.mapped is not None
    assert pooled.mapped.ellipsoid is not None
    np.testing.assert_allclose(pooled.mapped.ellipsoid.shape, expected.shape, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(pooled.mapped_centres, solved[3:], rtol=1e-10)
    left = measured - columns @ solved
    assert pooled.mapped.rms == pytest.approx(np.sqrt((left**2).sum(axis=1).mean()), rel=1e-9)
    assert pooled.free.rms < pooled.mapped.rms  # along the surface nothing is left


def test_pooling_as_they_stand_is_wrong() -> None:
    """Negative control: one centre for all three trials misses the index by 0.5 N, own centres by less than 0.3 N."""
    forces, references = _trials(np.random.default_rng(3), _caps())
    errors = _error(pool_trials(forces, references, weight=WEIGHT))
    together = _analysed(np.concatenate(forces), np.concatenate(references))
    assert together.mapped is not None
    assert np.abs(errors).max() < 0.3
    assert abs(together.mapped.fit.index - TRUE_INDEX) > 0.5
    assert abs(together.free.index - TRUE_INDEX) > 0.5
    on_the_same_grid = np.concatenate(_trials(np.random.default_rng(3), _whole_grids())[0])
    same = _analysed(on_the_same_grid, np.concatenate([WEIGHT * part for part in _whole_grids()]))
    assert abs(same.free.index - TRUE_INDEX) > 0.5


@pytest.mark.long
def test_trials_that_cover_parts_are_known_together() -> None:
    """Without the model no cap determines an ellipsoid; the three do, and the truth lies in their interval."""
    held, errors = 0, []
    for seed in range(4):
        forces, references = _trials(np.random.default_rng(seed), _caps(400))
        singles = [_analysed(force, reference) for force, reference in zip(forces, references, strict=True)]
        assert not any(single.free.identifiable for single in singles)
        pooled = pool_trials(forces, references, weight=WEIGHT)
        assert pooled.free.identifiable
        held += pooled.free.index_low <= TRUE_INDEX <= pooled.free.index_high
        mean = np.mean([single.free.index for single in singles])
        errors.append((pooled.free.index - TRUE_INDEX, mean - TRUE_INDEX))
    assert held >= 3
    pooled_error, mean_error = np.sqrt(np.mean(np.square(errors), axis=0))
    assert pooled_error < 0.5 * mean_error


@pytest.mark.long
def test_the_mean_of_good_sensors_is_too_large() -> None:
    """An index is no less than zero, so noise only adds to it: the mean keeps that, the pooled fit has much less.

    Where the sensor is deformed, noise goes both ways, and the mean is as good as the pooled fit.
    """
    good, deformed = [], []
    for seed in range(12):
        for found, ellipsoid in ((good, NEARLY_GOOD), (deformed, DEFORMED)):
            truth = float(np.std(ellipsoid.axis_intersections, ddof=1))
            forces, references = _trials(np.random.default_rng(seed), _whole_grids(150), noise=1.0, of=ellipsoid)
            pooled = pool_trials(forces, references, weight=WEIGHT)
            assert pooled.mapped is not None
            singles = [
                fit_mapped(f, r, radius=WEIGHT, tolerance=TOLERANCE) for f, r in zip(forces, references, strict=True)
            ]
            mean = np.mean([single.fit.index for single in singles if single is not None])
            found.append((pooled.mapped.index - truth, mean - truth))
    bias = np.mean(good, axis=0)
    assert bias[1] > 0.05
    assert bias[0] < 0.75 * bias[1]
    spread = np.sqrt(np.mean(np.square(deformed), axis=0))
    assert spread[0] == pytest.approx(spread[1], rel=0.2)


@pytest.mark.long
def test_intervals_hold_the_truth() -> None:
    """Of 30 intervals of lengths of short trials 28.5 are expected to, two standard deviations less do at least."""
    held = np.zeros(2)
    for seed in range(10):
        forces, references = _trials(np.random.default_rng(seed), _whole_grids(200))
        pooled = pool_trials(forces, references, weight=WEIGHT)
        truth = DEFORMED.axis_intersections
        for k, fit in enumerate((pooled.free, pooled.mapped)):
            assert fit is not None
            held[k] += np.count_nonzero((fit.low <= truth) & (truth <= fit.high))
    assert (held >= 26).all()


def test_intervals_of_unknown_centres_are_those_without_a_tenth_of_every_trial() -> None:
    """The jackknife over ten fits, in each of which every trial lacks the same tenth."""
    forces, references = _trials(np.random.default_rng(5), _caps(300))
    pooled = pool_trials(forces, references, weight=WEIGHT)
    tenths = [np.array_split(np.arange(len(force)), 10) for force in forces]
    fits = [
        fit_with_own_centres([np.delete(f, cut[k], axis=0) for f, cut in zip(forces, tenths, strict=True)])
        for k in range(10)
    ]
    assert all(fits)
    whole, inverse = fit_with_own_centres(forces), [1.0 / fit.ellipsoid.axis_intersections for fit in fits if fit]
    assert whole is not None
    margin = jackknife_margin(np.array(inverse))
    np.testing.assert_allclose(1.0 / pooled.free.low, 1.0 / whole.ellipsoid.axis_intersections + margin, rtol=1e-4)
    np.testing.assert_allclose(1.0 / pooled.free.high, 1.0 / whole.ellipsoid.axis_intersections - margin, rtol=1e-4)


def test_unknown_centres_cost_something() -> None:
    """The interval is wider than that of a cloud whose centres are given, and never narrower."""
    forces, references = _trials(np.random.default_rng(5), _caps())
    pooled = pool_trials(forces, references, weight=WEIGHT)
    known = pool_trials([np.concatenate([f - o for f, o in zip(forces, OFFSETS, strict=True)])])
    assert pooled.free.index_high - pooled.free.index_low > 1.2 * (known.free.index_high - known.free.index_low)


@pytest.mark.long
def test_the_order_of_trials_does_not_matter() -> None:
    """Every order gives the same numbers to the bit; centres go with their trials."""
    forces, references = _trials(np.random.default_rng(6), [grid(300, 100.0), grid(255, 90.0), grid(300, 80.0)])
    first = pool_trials(forces, references, weight=WEIGHT)
    assert first.mapped is not None
    assert first.free_centres is not None
    assert first.mapped_centres is not None
    orders = list(permutations(range(3)))[1:]
    assert len(orders) == 5
    for order in orders:
        other = pool_trials([forces[k] for k in order], [references[k] for k in order], weight=WEIGHT)
        assert other.mapped is not None
        for mine, its in ((first.free, other.free), (first.mapped, other.mapped)):
            assert (mine.index, mine.index_low, mine.index_high) == (its.index, its.index_low, its.index_high)
            np.testing.assert_array_equal(mine.low, its.low)
        np.testing.assert_array_equal(first.free_centres[list(order)], other.free_centres)
        np.testing.assert_array_equal(first.mapped_centres[list(order)], other.mapped_centres)


def test_one_trial_is_itself() -> None:
    """A pool of one gives the ellipsoids of the analysis."""
    forces, references = _trials(np.random.default_rng(7), _whole_grids()[:1])
    pooled, single = pool_trials(forces, references, weight=WEIGHT), _analysed(forces[0], references[0])
    assert single.mapped is not None
    assert pooled.mapped is not None
    assert pooled.free.index == pytest.approx(single.free.index, abs=EXACT)
    assert pooled.mapped.index == pytest.approx(single.mapped.fit.index, rel=1e-6)
    np.testing.assert_allclose(pooled.mapped.low, single.mapped.fit.low, rtol=1e-6)


def test_what_pools_cannot_tell() -> None:
    """Planes and small caps stay unknown however many there are; quick motion has no sphere without the model."""
    rng = np.random.default_rng(8)
    small = _trials(rng, [grid(300, 10.0)] * 3, noise=1.0)
    pooled = pool_trials(*small, weight=WEIGHT)
    assert not pooled.free.identifiable
    assert pooled.free.why
    assert pooled.free.index_high == np.inf
    turn = np.linspace(0.0, 6.0, 200)
    flat = WEIGHT * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(200)])
    plane = pool_trials([flat, flat + 5.0], [flat, flat], weight=WEIGHT)
    assert not plane.free.identifiable
    assert plane.mapped is None
    forces, references = _trials(rng, _whole_grids())
    quick = 1.0 + 0.3 * np.sin(np.arange(700))[:, None]
    shaken = pool_trials([quick * f for f in forces], [quick * r for r in references], weight=WEIGHT)
    assert not shaken.free.identifiable
    assert "no one size in a trial, it scatters by 21.2 %" in shaken.free.why[0]  # 0.3 / sqrt(2)


@some_cases("noise", np.geomspace(1e-6, 3.0, 7))
def test_limbs_that_hardly_move_have_no_pooled_ellipsoid(noise: float) -> None:
    """What noise makes of references that move by a hundredth of a degree is not shown, nor are its centres."""
    forces, references = _trials(np.random.default_rng(12), [grid(700, 1e-2)] * 3, noise=noise)
    pooled = pool_trials(forces, references, weight=WEIGHT)
    extent = max(2.0 * float(np.linalg.norm(force - force.mean(axis=0), axis=1).max()) for force in forces)
    for fit, centres in ((pooled.free, pooled.free_centres), (pooled.mapped, pooled.mapped_centres)):
        assert fit is None or (fit.ellipsoid is None) == (centres is None)
        if fit is not None and fit.ellipsoid is not None:
            assert fit.ellipsoid.principal_radii[0] <= 5.0 * max(extent, WEIGHT)


def test_wrong_input_is_refused() -> None:
    """What is missing is named with its trial."""
    forces, references = _trials(np.random.default_rng(9), _whole_grids(50))
    with pytest.raises(ForceTorqueError, match="trials: expected at least one, got none"):
        pool_trials([])
    with pytest.raises(ForceTorqueError, match="weight: expected a positive number with references, got None"):
        pool_trials(forces, references)
    with pytest.raises(FitError, match="force of trial 2: expected at least 10 points, got 7"):
        pool_trials([forces[0], forces[1][:7]])
    with pytest.raises(FitError, match="reference of trial 2: expected a cloud, got 50 times one point"):
        pool_trials(forces, [references[0], np.tile(references[0][:1], (50, 1)), references[2]], weight=WEIGHT)
    with pytest.raises(ShapeError, match="reference of trial 3"):
        pool_trials(forces, [*references[:2], references[2][:-1]], weight=WEIGHT)
