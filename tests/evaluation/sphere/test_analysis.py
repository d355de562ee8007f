# SPDX-License-Identifier: BSD-3-Clause
"""The whole analysis on a sensor whose matrix is known, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import FitError, ForceTorqueError, ShapeError, UnitError
from forcetorque.evaluation.sphere.cloud import share_of_directions
from forcetorque.evaluation.sphere.ellipsoid import ellipsoid_of_map
from forcetorque.evaluation.sphere.sensor_sphere import SphereAnalysis, analyse_sphere
from tests.cases import some_cases
from tests.evaluation.sphere.clouds import grid, slow_noise, whole_sphere

GRAVITY, MASS = 9.81, 4.733288
CENTRE_OF_MASS = np.array([0.01, 0.02, -0.21])
"""Of what hangs on the sensor, in its frame; m."""
OFFSET = np.array([12.0, -30.0, 55.0, 0.4, -0.2, 1.1])
"""What the sensor reads without load; N, N m."""
DEFORMATION = np.eye(6) + np.array(
    [
        [0.12, 0.08, -0.05, 0.4, 0.2, 0.0],
        [-0.04, 0.35, 0.10, -0.3, 0.1, 0.2],
        [0.06, 0.02, 0.03, 0.1, 0.0, -0.2],
        [0.001, 0.002, 0.0, 0.10, 0.02, 0.0],
        [0.0, -0.002, 0.001, 0.05, -0.08, 0.0],
        [0.002, 0.0, 0.0, 0.0, 0.02, 0.30],
    ]
)
"""What the sensor makes of a true wrench."""


def _lever(vector: np.ndarray) -> np.ndarray:
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _reference(directions: np.ndarray) -> np.ndarray:
    force = MASS * GRAVITY * directions
    return np.hstack([force, force @ _lever(CENTRE_OF_MASS).T])


def _measured(reference: np.ndarray, noise: float = 0.0, seed: int = 1) -> np.ndarray:
    rng = np.random.default_rng(seed)
    extra = np.hstack([slow_noise(rng, len(reference), size, 0.9) for size in (noise, 0.02 * noise)])
    measured: np.ndarray = reference @ DEFORMATION.T + OFFSET + extra
    return measured


FORCE_MAP = DEFORMATION[:3] @ np.vstack([np.eye(3), _lever(CENTRE_OF_MASS)])
"""What it makes of the force, with the moment of a stiff limb; shape (3, 3)."""
MOMENT_MAP = DEFORMATION[3:] @ np.vstack([np.eye(3), _lever(CENTRE_OF_MASS)])
TRUTH = ellipsoid_of_map(FORCE_MAP, centre=OFFSET[:3], radius=MASS * GRAVITY)


def _analysed(half: float = 60.0, noise: float = 0.2) -> SphereAnalysis:
    reference = _reference(grid(1500, half))
    return analyse_sphere(_measured(reference, noise), reference, gravity=GRAVITY)


def test_without_noise_both_ways_find_the_deformation() -> None:
    """Masses, errors, index and offset are those of the sensor, with the model and without."""
    found = _analysed(noise=0.0)
    assert found.mapped is not None
    np.testing.assert_allclose(found.mapped.matrix, FORCE_MAP, atol=1e-9)
    np.testing.assert_allclose(found.mapped.centre, OFFSET[:3], atol=1e-9)
    assert found.mapped.radius == pytest.approx(MASS * GRAVITY, rel=1e-12)
    assert found.mass == pytest.approx(MASS, rel=1e-12)
    for fit, accuracy in ((found.free, 1e-6), (found.mapped.fit, 1e-10)):
        assert fit.identifiable
        masses, errors = found.masses(fit), found.errors(fit)
        assert masses is not None
        assert errors is not None
        assert fit.ellipsoid is not None
        np.testing.assert_allclose(masses, TRUTH.axis_intersections / GRAVITY, rtol=accuracy)
        np.testing.assert_allclose(errors, TRUTH.axis_intersections - MASS * GRAVITY, atol=1e3 * accuracy)
        assert fit.index / GRAVITY == pytest.approx(np.std(masses, ddof=1), rel=1e-12)
        np.testing.assert_allclose(fit.ellipsoid.centre, OFFSET[:3], atol=1e3 * accuracy)


def test_with_noise_the_truth_lies_in_the_intervals() -> None:
    """Of masses, index and half-widths; the model makes them narrower."""
    found = _analysed(noise=0.3)
    assert found.mapped is not None
    widths = []
    for fit in (found.free, found.mapped.fit):
        assert fit.identifiable
        assert ((fit.low < TRUTH.axis_intersections) & (TRUTH.axis_intersections < fit.high)).all()
        assert fit.index_low < np.std(TRUTH.axis_intersections, ddof=1) < fit.index_high
        widths.append((fit.high - fit.low).max())
    assert widths[1] < 0.5 * widths[0]


def test_the_model_sees_what_the_cloud_alone_does_not() -> None:
    """On a cap of 20 degrees the ellipsoid is identifiable with the model and not without."""
    found = _analysed(half=20.0, noise=0.1)
    assert found.mapped is not None
    assert not found.free.identifiable
    assert found.mapped.fit.identifiable
    assert (found.mapped.fit.low < TRUTH.axis_intersections).all()
    assert (found.mapped.fit.high > TRUTH.axis_intersections).all()


def test_moments_with_the_model() -> None:
    """Half-widths of the disc that the moments fill, by the sensor and by the model, worked out from the matrices."""
    found = _analysed(noise=0.1).moment
    assert found is not None
    x, y, z = CENTRE_OF_MASS
    levers = np.sqrt([y**2 + z**2, x**2 + z**2, x**2 + y**2])
    np.testing.assert_allclose(found.expected_half_width_Nm, MASS * GRAVITY * levers, rtol=1e-10)
    reach = MASS * GRAVITY * np.linalg.norm(MOMENT_MAP, axis=1)
    assert ((found.low_Nm < reach) & (reach < found.high_Nm)).all()
    np.testing.assert_allclose(found.error_Nm, reach - found.expected_half_width_Nm, atol=0.01)
    np.testing.assert_allclose(found.centre_Nm, OFFSET[3:], atol=0.01)
    assert found.identifiable
    assert found.stray_share < 1e-10


def test_moments_of_a_loose_limb_are_not_believed() -> None:
    """Where the centre of mass moves, the moment is no function of the force, and that is said."""
    reference = _reference(grid(1500, 60.0))
    moving = reference.copy()
    along = 0.1 * np.sin(np.linspace(0.0, 60.0, 1500))[:, None] * np.array([0.0, 1.0, 0.5])
    moving[:, 3:] += np.cross(along, reference[:, :3])
    found = analyse_sphere(moving @ DEFORMATION.T, moving, gravity=GRAVITY).moment
    assert found is not None
    assert not found.identifiable
    assert any("the limb is not stiff" in reason for reason in found.why)


def test_a_fast_motion_draws_no_sphere() -> None:
    """Where the model says that the force has no one size, only the fit with the model is believed: it knows why."""
    slow = _reference(grid(1500, 60.0))
    fast = slow * (1.0 + 0.3 * np.sin(np.linspace(0.0, 40.0, 1500)))[:, None]
    found = analyse_sphere(_measured(fast, 0.1), fast, gravity=GRAVITY, mass=MASS)
    assert found.scatter is not None
    assert found.scatter == pytest.approx(0.3 / np.sqrt(2.0), rel=0.1)
    assert not found.free.identifiable
    assert not found.radius.identifiable
    for fit in (found.free, found.radius):
        assert "the force has no one size, it scatters by" in fit.why[0]
    assert found.mapped is not None
    assert found.mapped.fit.identifiable
    assert found.mapped.radius == pytest.approx(MASS * GRAVITY, rel=1e-12)
    assert (found.mapped.fit.low < TRUTH.axis_intersections).all()
    assert (found.mapped.fit.high > TRUTH.axis_intersections).all()
    calm = _analysed()
    assert calm.scatter is not None
    assert calm.scatter < 1e-12


def test_moments_without_the_model_lie_on_a_disc() -> None:
    """A stiff limb makes no ellipsoid in the space of moments: the cloud is called flat or open."""
    found = _analysed(noise=0.2).free_moment
    assert found is not None
    assert not found.identifiable
    reference = _reference(grid(1500, 60.0))
    exact = analyse_sphere(reference, gravity=GRAVITY).free_moment
    assert exact is not None
    assert exact.ellipsoid is None
    assert exact.why == ("the cloud lies in a plane",)


def test_moments_that_fill_a_space_are_fitted() -> None:
    """Where a moment does draw an ellipsoid, it is found as that of forces is."""
    directions = np.random.default_rng(2).permutation(whole_sphere(800))
    wrench = np.hstack([40.0 * directions, directions * [2.0, 3.0, 1.5]])
    found = analyse_sphere(wrench, gravity=GRAVITY).free_moment
    assert found is not None
    assert found.identifiable
    assert found.ellipsoid is not None
    np.testing.assert_allclose(found.ellipsoid.axis_intersections, [2.0, 3.0, 1.5], rtol=1e-8)
    silent = analyse_sphere(np.hstack([40.0 * directions, np.zeros((800, 3))]), gravity=GRAVITY)
    assert silent.free_moment is None


def test_without_a_model_there_are_masses_and_no_errors() -> None:
    """A known mass alone gives errors; without it the masses stand for themselves."""
    measured = _measured(_reference(grid(1500, 60.0)), 0.2)
    bare, weighed = (analyse_sphere(measured, gravity=GRAVITY, mass=mass) for mass in (None, MASS))
    assert (bare.mapped, bare.moment, bare.mass) == (None, None, None)
    assert bare.errors(bare.free) is None
    masses, errors = weighed.masses(weighed.free), weighed.errors(weighed.free)
    assert masses is not None
    assert errors is not None
    np.testing.assert_allclose(errors, (masses - MASS) * GRAVITY, atol=1e-12)


def test_a_reference_in_a_plane_gives_no_map() -> None:
    """One joint alone turns the force in a plane; across it nothing is known, with a model or without."""
    angle = np.linspace(0.0, 3.0, 400)
    reference = _reference(np.column_stack([np.sin(angle), np.zeros(400), np.cos(angle)]))
    found = analyse_sphere(_measured(reference, 0.3), reference, gravity=GRAVITY)
    assert found.mapped is None
    assert found.moment is None
    assert not found.free.identifiable


@pytest.mark.long
@settings(max_examples=10)
@given(seed=st.integers(0, 2**16))
def test_with_the_model_the_order_and_the_zero_do_not_matter(seed: int) -> None:
    """Samples within a block, and offsets, change nothing."""
    rng = np.random.default_rng(seed)
    reference = _reference(grid(400, 50.0))
    measured = _measured(reference, 0.2)
    order = np.concatenate([rng.permutation(block) for block in np.array_split(np.arange(400), 10)])
    plain = analyse_sphere(measured, reference, gravity=GRAVITY).mapped
    mixed = analyse_sphere(measured[order] + 100.0 * rng.normal(size=6), reference[order], gravity=GRAVITY).mapped
    assert plain is not None
    assert mixed is not None
    np.testing.assert_allclose(mixed.fit.low, plain.fit.low, rtol=1e-9)
    np.testing.assert_allclose(mixed.matrix, plain.matrix, atol=1e-10)


def test_directions_are_counted() -> None:
    """All of them, a half, and hardly any."""
    points = whole_sphere(20_000)
    assert share_of_directions(points, np.zeros(3)) == 1.0
    assert share_of_directions(points[points[:, 2] > 0.0], np.zeros(3)) == pytest.approx(0.55, abs=0.05)
    assert share_of_directions(np.ones((30, 3)), np.zeros(3)) == 1 / 200
    assert share_of_directions(np.ones((30, 3)), np.ones(3)) == 0.0
    found = _analysed(half=60.0)
    assert found.directions is not None
    # a grid of 120 by 120 degrees is a quarter of all directions, and parts at its edge count whole
    assert found.directions == pytest.approx(0.3, abs=0.05)


@pytest.mark.parametrize(
    ("damage", "error", "match"),
    [
        (lambda w: w[:9], FitError, "force: expected at least 10 points, got 9"),
        (lambda w: np.tile(w[:1], (50, 1)), FitError, "force: expected a cloud, got 50 times one point"),
        (lambda w: w[:, :3], ShapeError, r"wrench: expected shape \(n, 6\), got \(300, 3\)"),
        (
            lambda w: np.where(w == w[7], np.nan, w),
            ShapeError,
            "in 1 of 300 samples; leave out gaps",
        ),
        (lambda w: np.where(w == w[7], np.inf, w), ShapeError, "in 1 of 300 samples; leave out gaps"),
        (lambda w: np.round(300.0 * w), UnitError, "expected N, got whole numbers .* can only be counts"),
        (lambda w: 1000.0 * w, UnitError, "expected N, got values .* can only be counts; multiply"),
    ],
)
def test_what_cannot_be_forces_is_refused(damage: object, error: type[Exception], match: str) -> None:
    """Too few, no motion, gaps, counts: each with what was expected, what came and what to do."""
    wrench = _measured(_reference(grid(300, 60.0)), 0.2)
    with pytest.raises(error, match=match):
        analyse_sphere(damage(wrench), gravity=GRAVITY)  # type: ignore[operator]


@some_cases("seed", range(5))
@pytest.mark.parametrize("noise", [1e-6, 0.01, 0.3, 3.0])
def test_a_limb_that_stands_still_to_rounding_is_refused(noise: float, seed: int) -> None:
    """The force by the model moves in its last digits, which is one point as well; a ten-millionth of it is a cloud."""
    rng = np.random.default_rng(seed)
    still = np.tile(_reference(np.array([[0.6, 0.0, -0.8]])), (300, 1))
    measured = still + noise * rng.normal(size=still.shape)
    for size in (0.0, 1e-16, 1e-15, 1e-12):
        with pytest.raises(FitError, match="reference force: expected a cloud, got 300 times one point"):
            analyse_sphere(measured, still * (1.0 + size * rng.normal(size=still.shape)), gravity=9.81)
    analyse_sphere(measured, still * (1.0 + 1e-7 * rng.normal(size=still.shape)), gravity=9.81)


def test_a_moment_that_changes_by_rounding_is_none() -> None:
    """It does not cost the analysis of the forces."""
    reference = _reference(grid(300, 60.0))
    reference[:, 3:] = 0.3 * (1.0 + 1e-16 * np.random.default_rng(3).normal(size=(300, 3)))
    found = analyse_sphere(reference, reference, gravity=9.81)
    assert found.free_moment is None
    assert found.mapped is not None


def test_counts_are_noticed_against_the_model_too() -> None:
    """Readings that move by hundreds of times the weight are counts, even where they are no whole numbers."""
    reference = _reference(grid(300, 60.0))
    with pytest.raises(UnitError, match="values that move by .* times the weight .* can only be counts"):
        analyse_sphere(250.3 * reference, reference, gravity=GRAVITY)
    with pytest.raises(ShapeError, match="reference: expected one for each of 300 wrenches, got 299"):
        analyse_sphere(reference, reference[1:], gravity=GRAVITY)


@pytest.mark.parametrize("name", ["gravity", "mass", "tolerance"])
@pytest.mark.parametrize("value", [0.0, -9.81, np.nan, np.inf])
def test_numbers_that_make_no_sense_are_refused(name: str, value: float) -> None:
    """Gravity, mass and tolerance are positive."""
    options = {"gravity": GRAVITY, name: value}
    with pytest.raises(ForceTorqueError, match=f"{name}: expected a positive number"):
        analyse_sphere(_measured(_reference(grid(300, 60.0))), **options)
