# SPDX-License-Identifier: BSD-3-Clause
"""From known loads to a matrix, and what held-out positions say of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, SensorError, ShapeError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.generative import model as evidence
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.workbench.known_loads import BenchLoads, Weights
from forcetorque.workbench.matrix_fit import fit_bench, fit_means
from forcetorque.workbench.position_means import Bench, Placement
from forcetorque.workbench.sensor_fit import held_out_errors, one_by_one, rms, whole_series
from forcetorque.workbench.simulated_benches import simulate_bench
from tests.cases import some_cases
from tests.scenes.benches import PLACEMENT, thesis_loads

NO_ERROR = Placement(angle_rad=0.0, position_m=0.0)
SAME_SIZES = 0.05
"""Share by which leaving out in closed form differs from fitting again: sizes of deviations are kept in one."""
NOISE_FLOOR = 1.2
"""Error on operating loads over that of the noise of their measurement alone."""


def test_the_true_matrix_is_found_without_errors() -> None:
    """With and without a nominal matrix, as far as the noise of a hundredth of a count lets it."""
    for with_prior in (True, False):
        rng = np.random.default_rng(4)
        specimen = simulate_bench(thesis_loads(), NO_ERROR, rng, noise_counts=0.01, with_prior=with_prior)
        matrix = fit_bench(specimen.bench).fit.model.matrix
        np.testing.assert_allclose(matrix @ specimen.response, np.eye(6), atol=2e-4)


@some_cases("with_prior", [True, False])
def test_leaving_out_in_closed_form_is_fitting_again(with_prior: bool) -> None:
    """For single positions and for parts of five."""
    specimen = simulate_bench(thesis_loads(), PLACEMENT, np.random.default_rng(2), with_prior=with_prior)
    fitted = fit_bench(specimen.bench)
    for parts in ([np.array([0]), np.array([6])], [np.array([1, 7, 13, 18, 23])]):
        errors = held_out_errors(fitted, parts)
        for part in parts:
            again = _without(fitted.means, part)
            model = fit_means(fitted.bench, again).model
            expected = model.wrench(fitted.means.raw[part]) - fitted.means.reference[part]
            scale = np.repeat([np.abs(expected[:, half]).max() for half in (slice(3), slice(3, 6))], 3)
            np.testing.assert_allclose((errors[part] - expected) / scale, 0.0, atol=SAME_SIZES)
    in_sample = rms(fitted.fit.model.wrench(fitted.means.raw) - fitted.means.reference)
    assert (one_by_one(fitted) > in_sample).all()  # negative control: left out is not in sample


def _without(means: WindowMeans, part: np.ndarray[tuple[int], np.dtype[np.int64]]) -> WindowMeans:
    fields = ("time_s", "count", "raw", "reference", "flattening", "variables")
    return replace(means, **{field: np.delete(getattr(means, field), part, axis=0) for field in fields})


def test_a_noisy_block_counts_less() -> None:
    """Its weight falls with its own standard error, and the matrix is better for it."""
    specimen = simulate_bench(thesis_loads(), PLACEMENT, np.random.default_rng(3))
    rng = np.random.default_rng(8)
    bench = specimen.bench
    error = np.full(bench.raw.shape, 0.5)
    error[[4, 11]] = 300.0
    raw = bench.raw + error * rng.standard_normal(error.shape)
    weighed = fit_bench(replace(bench, raw=raw, standard_error=error))
    assert weighed.means.count[[4, 11]].max() < 0.1 * np.delete(weighed.means.count, [4, 11]).min()
    plain = fit_bench(replace(bench, raw=raw, standard_error=None))
    size = [np.abs(one.fit.model.matrix @ specimen.response - np.eye(6))[:3, :3].max() for one in (weighed, plain)]
    assert size[0] < 0.5 * size[1]


def test_a_series_that_alone_moves_a_direction_is_not_predicted() -> None:
    """Without a prior the others do not tell it, and say so; the reason names the direction."""
    loads = BenchLoads(
        names=tuple("abcdefghijklmn"),
        wrench=np.vstack([np.eye(6), -np.eye(6), np.eye(6)[:2]]) * [10.0, 10.0, 10.0, 1.0, 1.0, 1.0],
        series=tuple("x" if k % 6 == 2 else "rest" for k in range(14)),
    )
    response = np.random.default_rng(1).standard_normal((6, 6)) + 4.0 * np.eye(6)
    noise = 0.01 * np.random.default_rng(2).standard_normal((14, 6))
    bench = Bench(
        sensor="ft",
        serial="S",
        loads=loads,
        raw=loads.wrench @ response.T + noise,
        full_scale=np.full(6, 100.0),
    )
    outcome = whole_series(fit_bench(bench))
    assert isinstance(outcome["x"], str)
    assert "fz" in outcome["x"]


def _payloads(rng: np.random.Generator, centres: FloatArray) -> BenchLoads:
    """Forty postures of a mass of 2 kg at each of several centres of mass."""
    count = 40
    direction = rng.standard_normal((count * len(centres), 3))
    weights = Weights(
        mass_kg=np.full(len(direction), 2.0),
        structure_kg=np.zeros(len(direction)),
        position_m=np.repeat(centres, count, axis=0),
        direction=direction,
        gravity=9.80665,
    )
    names = [f"{k}" for k in range(len(direction))]
    return BenchLoads.of_weights(names, weights, measure_direction=MeasureDirection.CHILD_TO_PARENT)


def test_eight_channels_without_prior_reach_the_noise_floor_on_a_fourth_payload() -> None:
    """Three payloads not on a line, the fourth among them; three on a line leave one direction open, which is named."""
    rng = np.random.default_rng(11)
    response = rng.standard_normal((8, 6)) * [40.0, 40.0, 40.0, 900.0, 900.0, 900.0]
    centres = np.array([[0.1, 0.0, 0.02], [0.0, 0.1, 0.05], [-0.05, -0.05, 0.12]])
    learnt = simulate_bench(_payloads(rng, centres), NO_ERROR, rng, response=response, noise_counts=2.0)
    fit = fit_bench(learnt.bench).fit
    fourth = simulate_bench(
        _payloads(rng, np.array([[0.04, 0.03, 0.08]])), NO_ERROR, rng, response=response, noise_counts=2.0
    )
    errors = fit.model.wrench(fourth.bench.raw) - fourth.bench.loads.wrench
    floor = 2.0 * np.linalg.norm(fit.model.matrix, axis=1)  # of the noise alone, with a true matrix
    ratio = np.array([np.linalg.norm(rms(errors)[half]) / np.linalg.norm(floor[half]) for half in _HALVES])
    assert (ratio < NOISE_FLOOR).all()
    on_a_line = np.array([[0.1, 0.0, 0.02], [0.2, 0.0, 0.04], [0.3, 0.0, 0.06]])
    open_one = simulate_bench(_payloads(rng, on_a_line), NO_ERROR, rng, response=response, noise_counts=2.0)
    with pytest.raises(FitError, match="move 5 of 6 directions"):
        fit_bench(open_one.bench)


_HALVES = (slice(3), slice(3, 6))


def test_measurements_that_cannot_be_used() -> None:
    """Too few channels, and positions without data."""
    loads = thesis_loads()
    with pytest.raises(ShapeError, match="at least 6 channels"):
        Bench(sensor="ft", serial="S", loads=loads, raw=np.ones((24, 5)), full_scale=np.ones(5))
    empty = Bench(sensor="ft", serial="S", loads=loads, raw=np.full((24, 6), np.nan), full_scale=np.ones(6))
    with pytest.raises(SensorError, match="known load and raw samples, got none"):
        fit_bench(empty)
    with pytest.raises(SensorError, match="angle_rad"):
        Placement(angle_rad=-0.1, position_m=0.0)


PRIOR_ROWS = {
    "force rows times 2": (slice(0, 3), 2.0),
    "force rows times 3": (slice(0, 3), 3.0),
    "all rows times 2": (slice(0, 6), 2.0),
    "moment rows times 2": (slice(3, 6), 2.0),
    "fx times 1.5": (slice(0, 1), 1.5),
    "fx times 0.6": (slice(0, 1), 0.6),
    "fz times 1.5": (slice(2, 3), 1.5),
    "ty times 1.5": (slice(4, 5), 1.5),
}


@pytest.mark.parametrize("placement", [NO_ERROR, PLACEMENT], ids=["no errors", "placement"])
@some_cases("change", PRIOR_ROWS)
def test_a_prior_that_is_off_by_a_factor_does_not_turn_loads_into_noise(change: str, placement: Placement) -> None:
    """Loads of rank 6 determine the matrix: the fit is as good as with the prior as it is; it was 4 to 107 N wrong."""
    rng = np.random.default_rng(5)
    specimen = simulate_bench(thesis_loads(), placement, rng, noise_counts=0.01, with_prior=True)
    bench, (rows, factor) = specimen.bench, PRIOR_ROWS[change]
    assert bench.prior is not None
    prior = bench.prior.copy()
    prior[rows] *= factor
    pushes = rng.normal(size=(50, 6)) * [30.0, 30.0, 30.0, 3.0, 3.0, 3.0]
    with_wrong, with_true = (
        rms(pushes @ (fit_bench(one).fit.model.matrix @ specimen.response - np.eye(6)).T)
        for one in (replace(bench, prior=prior), bench)
    )
    assert (with_wrong < 1.1 * with_true + [1e-3] * 6).all()


@pytest.mark.parametrize("seed", range(3))
def test_a_second_start_changes_nothing_where_the_prior_is_true(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: to the last bit as without it."""
    bench = simulate_bench(thesis_loads(), PLACEMENT, np.random.default_rng(seed), with_prior=True).bench
    both = fit_bench(bench).fit
    monkeypatch.setattr(evidence, "_have_rank", lambda products: False)
    np.testing.assert_array_equal(both.model.matrix, fit_bench(bench).fit.model.matrix)
