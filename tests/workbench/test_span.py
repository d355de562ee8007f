# SPDX-License-Identifier: BSD-3-Clause
"""Rank, missing moments and singular values of loads whose span is known by hand, and predicted errors of matrices."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import MeasureDirection, wrench_matrix
from forcetorque.device.excitation_options import least_excitation
from forcetorque.workbench.excitation import Span, UncertainLoads
from forcetorque.workbench.known_loads import THESIS_TABLE, read_loads
from forcetorque.workbench.position_means import Placement

ROUNDING = 1e-12
"""Of a singular value decomposition of numbers of order 1."""
DRAWN = 0.1
"""Share by which a standard deviation of 400 draws of 36 coefficients may be off."""

RNG = np.random.default_rng(3)
FORCES = 100.0 * RNG.standard_normal((30, 3))
FIRST, SECOND, THIRD = np.array([0.0, 0.0, 0.2]), np.array([0.1, 0.0, 0.1]), np.array([0.0, 0.1, 0.1])


def _weights(*places: FloatArray) -> FloatArray:
    return np.concatenate([np.hstack([FORCES, np.cross(place, FORCES)]) for place in places])


def _certain(wrench: FloatArray) -> UncertainLoads:
    """Loads without errors."""
    return UncertainLoads(
        wrench=wrench, count=np.ones(len(wrench)), systematic={}, independent=np.zeros((*wrench.shape, 0))
    )


@pytest.mark.parametrize(("places", "rank"), [((FIRST,), 3), ((FIRST, SECOND), 5), ((FIRST, SECOND, THIRD), 6)])
def test_a_centre_of_mass_spans_three_two_five_three_off_a_line_six(places: tuple[FloatArray, ...], rank: int) -> None:
    """The rank does not depend on where the sensor is: any frame sees the same."""
    loads = _weights(*places)
    assert Span.of(loads).rank == rank
    elsewhere = wrench_matrix(make_pose(rotation_from_rpy([0.3, -0.7, 1.1]), [0.2, -0.1, 0.05]))
    assert Span.of(loads @ elsewhere.T).rank == rank


def test_three_centres_on_a_line_still_miss_the_moment_about_it() -> None:
    """Negative control: a third place on the line of the other two adds nothing."""
    assert Span.of(_weights(FIRST, SECOND, 0.5 * (FIRST + SECOND))).rank == 5


def test_what_is_missing_is_the_moment_about_the_line_through_both_centres() -> None:
    """It passes through both, has no force along it, vanishes for all loads, and is stated as text."""
    loads = _weights(FIRST, SECOND)
    (line,) = Span.of(loads).missing
    assert abs(line.distance_m(FIRST)) < ROUNDING
    assert abs(line.distance_m(SECOND)) < ROUNDING
    assert line.distance_m(THIRD) > 0.01
    assert abs(line.pitch_m) < ROUNDING
    np.testing.assert_allclose(loads @ line.functional, 0.0, atol=1e-10)
    np.testing.assert_allclose(line.axis, np.array([1.0, 0.0, -1.0]) / np.sqrt(2.0), atol=ROUNDING)
    assert "through (100.0, 0.0, 100.0) mm along (0.707, 0.000, -0.707)" in line.text.replace("-0.0,", "0.0,")


def test_fewer_than_six_loads_are_refused() -> None:
    """Five loads say nothing of six directions."""
    with pytest.raises(ShapeError, match="at least six loads"):
        Span.of(FORCES[:5, [0, 1, 2, 0, 1, 2]])


def test_the_predicted_covariance_is_that_of_drawn_errors() -> None:
    """Systematic and independent errors and noise are drawn 400 times, each time with a least-squares fit."""
    loads = _weights(FIRST, SECOND, THIRD)
    systematic = 0.01 * RNG.standard_normal((2, *loads.shape))
    independent = 0.05 * RNG.standard_normal((*loads.shape, 2))
    uncertain = UncertainLoads(
        wrench=loads,
        count=np.full(len(loads), 4.0),
        systematic={"a": systematic[0], "b": systematic[1]},
        independent=independent,
    )
    noise = np.diag([0.2, 0.2, 0.2, 0.01, 0.01, 0.01]) ** 2
    predicted = np.sqrt(np.einsum("iaia->ia", uncertain.matrix_error(noise).covariance))
    moved = loads - loads.mean(axis=0)
    rng, shares = np.random.default_rng(8), []
    for _ in range(400):
        wrong = np.einsum("s,sni->ni", rng.standard_normal(2), systematic)
        wrong = wrong + np.einsum("nir,nr->ni", independent, rng.standard_normal((len(loads), 2)))
        wrong = wrong + rng.standard_normal(loads.shape) @ np.sqrt(noise) / 2.0
        shares.append(np.linalg.lstsq(moved, wrong - wrong.mean(axis=0), rcond=None)[0].T)
    np.testing.assert_allclose(np.std(shares, axis=0) / predicted, 1.0, atol=3.0 * DRAWN / np.sqrt(2.0))
    assert np.mean(np.std(shares, axis=0) / predicted) == pytest.approx(1.0, abs=DRAWN / 3.0)


def test_errors_are_without_end_only_where_a_load_has_what_is_missing() -> None:
    """The moment about a line in the xz plane has parts along fy, tx and tz, and none along the others."""
    loads = _weights(FIRST, SECOND)
    error = _certain(loads).matrix_error(np.eye(6))
    assert error.rank == 5
    assert error.volume == np.inf
    finite = np.isfinite(error.error(np.eye(6))).all(axis=1)
    assert finite.tolist() == [True, False, True, False, True, False]


def test_excitation_is_compared_in_the_worst_direction() -> None:
    """Loads of twice the size have twice the excitation; with one direction halved they have half; with none, none."""
    loads = _weights(FIRST, SECOND, THIRD)

    assert least_excitation(_certain(2.0 * loads), _certain(loads)) == pytest.approx(2.0)
    axes = np.vstack([np.eye(6), -np.eye(6)])
    assert least_excitation(_certain(axes * [1, 1, 1, 1, 1, 0.5]), _certain(axes)) == pytest.approx(0.5)
    assert least_excitation(_certain(_weights(FIRST, SECOND)), _certain(loads)) < 1e-6


def test_positions_of_the_workbench_are_uncertain_as_they_are_placed() -> None:
    """Errors grow with the placement, as nothing else is wrong with a bench."""
    bench = read_loads(THESIS_TABLE, measure_direction=MeasureDirection.CHILD_TO_PARENT)
    squares = [
        UncertainLoads.of_bench(bench, Placement(angle_rad=k * 1e-3, position_m=k * 1e-4), samples=24)
        .matrix_error(np.zeros((6, 6)))
        .mean_squares(np.eye(6))
        for k in (1, 2)
    ]
    np.testing.assert_allclose(np.array(squares[1]) / np.array(squares[0]), 4.0)
