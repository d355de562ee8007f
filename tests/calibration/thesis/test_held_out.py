# SPDX-License-Identifier: BSD-3-Clause
"""The choice of lambda on held-out blocks, and the uncertainty from leaving out blocks."""

from __future__ import annotations

import math

import numpy as np
import pytest

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.calibration.thesis.calibrate import HeldOut, calibrate
from forcetorque.calibration.thesis.lambda_choice import (
    FLOOR,
    RULE,
    candidate_lambdas,
    choose_lambda,
    jackknife_errors,
    lambda_floor,
)
from forcetorque.experiment.calibration.estimation_type import Estimation, EstimationType
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.sensor_model import LinearVariable

TRUTH = 0.02 * (np.eye(6) + 0.2 * np.random.default_rng(1).normal(size=(6, 6)))
PRIOR = TRUTH * (1.0 + 0.1 * np.random.default_rng(2).normal(size=(6, 6)))


def _blocks(*, matrix: np.ndarray, drift: float, seed: int = 3, count: int = 5, amplitude: float = 1000.0) -> list:
    """Blocks around different postures; drift moves the reading of each block by a constant of its own."""
    rng = np.random.default_rng(seed)
    blocks = []
    for _ in range(count):
        raw = amplitude * rng.normal(size=6) + amplitude * rng.normal(size=(200, 6))
        reference = raw @ matrix.T + drift * rng.normal(size=6) + 0.05 * rng.normal(size=(200, 6))
        blocks.append((raw, reference))
    return blocks


def _moments(blocks: list) -> list[Moments]:
    return [Moments.of(raw, reference) for raw, reference in blocks]


def test_good_data_overrule_a_wrong_prior() -> None:
    """With rich blocks and little noise the choice is a lambda that recovers the true matrix."""
    blocks = _moments(_blocks(matrix=TRUTH, drift=0.0))
    curve = choose_lambda(blocks, Estimation(prior=PRIOR))
    fit = calibrate([DataSet(label="a", raw=r, reference=f) for r, f in _blocks(matrix=TRUTH, drift=0.0)], PRIOR)
    assert math.isfinite(curve.chosen)
    assert np.linalg.norm(fit.fit.matrix - TRUTH) < 0.02 * np.linalg.norm(PRIOR - TRUTH)


def test_a_right_prior_is_kept_against_disturbed_data() -> None:
    """Where the prior is the truth and blocks hardly move but drift, the choice stays with the prior."""
    blocks = _moments(_blocks(matrix=TRUTH, drift=5.0, amplitude=30.0, seed=4))
    curve = choose_lambda(blocks, Estimation(prior=TRUTH))
    matrix_error = np.linalg.norm(
        calibrate(
            [
                DataSet(label=str(k), raw=r, reference=f)
                for k, (r, f) in enumerate(_blocks(matrix=TRUTH, drift=5.0, amplitude=30.0, seed=4))
            ],
            TRUTH,
        ).fit.matrix
        - TRUTH
    )
    assert curve.chosen > 1e3 * candidate_lambdas(blocks[0])[0]
    assert matrix_error < 0.05 * np.linalg.norm(TRUTH)


def test_no_block_gets_worse_than_with_the_prior() -> None:
    """The chosen lambda harms no held-out block, which smaller ones do on disturbed data."""
    blocks = _moments(_blocks(matrix=TRUTH, drift=3.0, amplitude=100.0, seed=6))
    curve = choose_lambda(blocks, Estimation(prior=PRIOR))
    chosen = int(np.flatnonzero(curve.regularisations == curve.chosen)[0])
    assert curve.worst_ratio[chosen] <= 1.0
    assert curve.worst_ratio.max() > 1.0
    assert curve.regularisations[-1] == math.inf


def test_the_choice_is_the_smallest_harmless_mean() -> None:
    """The rule as stated, evaluated again from the curve."""
    curve = choose_lambda(_moments(_blocks(matrix=TRUTH, drift=0.5, seed=7)), Estimation(prior=PRIOR))
    harmless = curve.worst_ratio <= 1.0
    best = curve.regularisations[harmless][np.argmin(curve.held_out_error[harmless])]
    assert curve.chosen == best


def test_lambda_follows_the_unit_of_counts() -> None:
    """Counts in other units choose the same lambda in the new unit."""
    blocks = _blocks(matrix=TRUTH, drift=0.5, seed=8)
    one = choose_lambda(_moments(blocks), Estimation(prior=PRIOR)).chosen
    other = choose_lambda(_moments([(8.0 * r, f) for r, f in blocks]), Estimation(prior=PRIOR / 8.0)).chosen
    assert other == pytest.approx(64.0 * one, rel=1e-9)


def _noisy(*, noise: float, per_degree: float = 0.0) -> list[tuple]:
    """Blocks of raw, reference and temperature of a rigid limb: forces turn, and moments follow from them."""
    rng = np.random.default_rng(21)
    blocks = []
    for k in range(5):
        force = 20.0 * (rng.normal(size=3) + rng.normal(size=(400, 3)))
        reference = np.hstack([force, np.cross([0.05, 0.02, -0.2], force)])
        temperature = 30.0 + k + rng.normal(size=(400, 1))
        raw = reference @ np.linalg.inv(TRUTH).T + noise * rng.normal(size=(400, 6)) + per_degree * temperature
        blocks.append((raw, reference, temperature))
    return blocks


@pytest.mark.parametrize("noise", [1.0, 8.0])
def test_the_floor_is_fifty_times_the_noise_of_the_counts(noise: float) -> None:
    """The variance that neither loads nor offset explain is that of the noise that was put in."""
    total = pooled(Moments.of(*block[:2]) for block in _noisy(noise=noise))
    assert lambda_floor(total) == pytest.approx(50.0 * noise**2, rel=0.05)
    assert "at least 50 times" in RULE


def test_readings_that_follow_the_reference_exactly_have_no_floor() -> None:
    """Rounding is not noise, and is never a negative lambda."""
    total = pooled(Moments.of(*block[:2]) for block in _noisy(noise=0.0))
    assert 0.0 <= lambda_floor(total) < 1e-9 * candidate_lambdas(total)[-2]


def test_a_variable_that_is_fitted_is_no_noise() -> None:
    """Drift with a temperature that is fitted leaves the floor; drift that nothing explains raises it."""
    blocks = [Moments.of(*block) for block in _noisy(noise=2.0, per_degree=30.0)]
    temperature = LinearVariable(name="temperature", unit="degC")
    given = {"prior": PRIOR, "variables": (temperature,), "reference_values": np.zeros(1)}
    fitted = choose_lambda(blocks, Estimation(kind=EstimationType(with_variables=True), **given))
    left_out = choose_lambda(blocks, Estimation(**given))
    assert fitted.floor == pytest.approx(FLOOR * 4.0, rel=0.05)
    assert left_out.floor > 100.0 * fitted.floor


def test_a_choice_below_the_floor_is_raised_to_it() -> None:
    """One posture loads three of six directions; below the floor the prior is lost along the other three."""
    blocks = _noisy(noise=3.0)
    curve = choose_lambda([Moments.of(*block[:2]) for block in blocks], Estimation(prior=PRIOR))
    free = (curve.worst_ratio <= 1.0) & (curve.regularisations != curve.floor)
    unfloored = float(curve.regularisations[free][np.argmin(curve.held_out_error[free])])
    assert curve.chosen == curve.floor
    assert curve.floor in curve.regularisations
    data = [DataSet(label=str(k), raw=raw, reference=reference) for k, (raw, reference, _) in enumerate(blocks)]
    along = np.linalg.svd(np.vstack([reference for _, reference, _ in blocks]))[2][3:] @ np.linalg.inv(TRUTH).T
    lost = [
        np.linalg.norm((fit.fit.matrix - PRIOR) @ along.T) / np.linalg.norm(PRIOR @ along.T)
        for fit in (calibrate(data, PRIOR), calibrate(data, PRIOR, regularisation=unfloored))
    ]
    assert lost[0] < 0.2
    assert lost[1] > 0.5
    # a lambda given by hand stays as it is
    assert calibrate(data, PRIOR, regularisation=unfloored).fit.regularisation == unfloored < 0.1 * curve.floor


@pytest.mark.long
def test_jackknife_covers_the_truth() -> None:
    """Over 60 simulated data sets, errors of the matrix are of the size that the jackknife says."""
    ratios = []
    for seed in range(60):
        blocks = _moments(_blocks(matrix=TRUTH, drift=0.2, seed=100 + seed))
        fit = calibrate(
            [DataSet(label="a", raw=r, reference=f) for r, f in _blocks(matrix=TRUTH, drift=0.2, seed=100 + seed)],
            None,
            regularisation=0.0,
        )
        error = jackknife_errors(blocks, Estimation(), 0.0).matrix
        ratios.append(((fit.fit.matrix - TRUTH) ** 2).sum() / (error**2).sum())
    # five blocks leave a factor of about two in the estimate of a variance
    assert 0.3 < float(np.median(ratios)) < 3.0


def test_the_error_of_a_mean_is_that_of_block_means() -> None:
    """With the prior kept the offset is a mean, whose jackknife error is the scatter of block means over root n."""
    blocks = _moments(_blocks(matrix=TRUTH, drift=1.0, seed=12))
    error = jackknife_errors(blocks, Estimation(prior=PRIOR), math.inf).offset
    means = np.stack([block.reference_mean - PRIOR @ block.raw_mean for block in blocks])
    np.testing.assert_allclose(error, means.std(axis=0, ddof=1) / np.sqrt(len(blocks)), rtol=1e-10)


def test_blocks_too_small_to_fit_alone_are_refused() -> None:
    """Seven samples of six channels fit exactly and say nothing: no lambda is chosen on them."""
    short = [(raw[:7], reference[:7]) for raw, reference in _blocks(matrix=TRUTH, drift=0.1)]
    with pytest.raises(FitError, match="at least 8 samples in each of 5 blocks"):
        choose_lambda(_moments(short), Estimation(prior=PRIOR))


def test_two_blocks_of_the_fewest_samples_are_enough() -> None:
    """Eight samples of six channels in each of two blocks: a choice is made, and of a candidate."""
    least = [(raw[:8], reference[:8]) for raw, reference in _blocks(matrix=TRUTH, drift=0.1, count=2)]
    curve = choose_lambda(_moments(least), Estimation(prior=PRIOR))
    assert curve.chosen in curve.regularisations


def test_candidates_are_four_per_decade_of_the_strongest_direction() -> None:
    """From 1e-8 to 1e3 times the largest variance, then infinity: 46 in all."""
    raw, reference = _blocks(matrix=TRUTH, drift=0.0)[0]
    candidates = candidate_lambdas(Moments.of(raw, reference))
    largest = np.linalg.eigvalsh(np.cov(raw.T, bias=True))[-1]
    np.testing.assert_allclose(candidates[:-1], largest * 10.0 ** (np.arange(-32, 13) / 4), rtol=1e-9)
    assert candidates[-1] == math.inf


def test_the_prior_is_kept_where_nothing_else_is_harmless() -> None:
    """A prior without any error cannot be improved: lambda is infinite, and no ratio is a number out of 0 / 0."""
    blocks = []
    for raw, _ in _blocks(matrix=TRUTH, drift=0.0):
        whole = np.rint(raw)
        blocks.append((whole, whole @ np.eye(6)))
    exact = choose_lambda(_moments(blocks), Estimation(prior=np.eye(6)))
    assert not np.isnan(exact.worst_ratio).any()
    assert exact.worst_ratio[-1] == 1.0
    disturbed = _blocks(matrix=TRUTH, drift=50.0, amplitude=30.0, seed=4)
    curve = choose_lambda(_moments(disturbed), Estimation(prior=TRUTH))
    assert (curve.worst_ratio[:-1] > 1.0).all()
    assert curve.chosen == math.inf


def test_one_block_has_no_choice_and_no_spread() -> None:
    """A choice needs two blocks; a single sample cannot be divided."""
    raw, reference = _blocks(matrix=TRUTH, drift=0.0)[0]
    with pytest.raises(FitError, match="two blocks"):
        choose_lambda([Moments.of(raw, reference)], Estimation(prior=PRIOR))
    fit = calibrate([DataSet(label="a", raw=raw[:1], reference=reference[:1])], PRIOR, regularisation=math.inf)
    assert fit.standard_errors is None


def test_an_axis_needs_as_many_samples_as_it_has_unknowns() -> None:
    """Six coefficients and an offset; the offset alone where the matrix is the prior's."""
    raw, reference = _blocks(matrix=TRUTH, drift=0.0)[0]
    few, enough = (DataSet(label="a", raw=raw[:n], reference=reference[:n]) for n in (6, 7))
    with pytest.raises(FitError, match="at least 7 samples for 7 unknowns of every axis, got 6"):
        calibrate([few], PRIOR, regularisation=1.0)
    assert np.isfinite(calibrate([enough], PRIOR, regularisation=1.0).fit.matrix).all()
    np.testing.assert_allclose(calibrate([few], PRIOR, regularisation=math.inf).fit.matrix, PRIOR)


def test_bad_requests_are_refused() -> None:
    """No data, different channels, a choice without prior, and readings that never change."""
    raw, reference = _blocks(matrix=TRUTH, drift=0.0)[0]
    data = DataSet(label="a", raw=raw, reference=reference)
    with pytest.raises(FitError, match="at least one"):
        calibrate([], PRIOR)
    with pytest.raises(FitError, match="without a prior"):
        calibrate([data], None)
    with pytest.raises(ShapeError, match="channels"):
        calibrate([data, DataSet(label="b", raw=raw[:, :5], reference=reference)], PRIOR)
    with pytest.raises(FitError, match="do not change"):
        calibrate([DataSet(label="c", raw=np.ones((50, 6)), reference=reference[:50])], PRIOR)


def _recorded(blocks: list, names: str) -> list[DataSet]:
    """A data set per block, of the recordings with these letters."""
    return [
        DataSet(label=f"{k}", raw=raw, reference=reference, recording=name)
        for k, ((raw, reference), name) in enumerate(zip(blocks, names, strict=True))
    ]


def test_recordings_are_held_out_whole() -> None:
    """With two or more, lambda is that of blocks that are recordings, each with all its intervals."""
    blocks = _blocks(matrix=TRUTH, drift=20.0, seed=4)
    moments = _moments(blocks)
    made = calibrate(_recorded(blocks, "aabba"), PRIOR)
    whole = choose_lambda([pooled([moments[k] for k in ks]) for ks in ([0, 1, 4], [2, 3])], Estimation(prior=PRIOR))
    assert made.held_out is HeldOut.RECORDINGS
    assert made.curve is not None
    np.testing.assert_allclose(made.curve.held_out_error, whole.held_out_error, rtol=1e-9)
    # negative control: the same samples as one recording are held out in pieces, with another error
    pieces = calibrate(_recorded(blocks, "aaaaa"), PRIOR)
    assert pieces.held_out is HeldOut.PIECES
    assert pieces.curve is not None
    np.testing.assert_allclose(
        pieces.curve.held_out_error, choose_lambda(moments, Estimation(prior=PRIOR)).held_out_error, rtol=1e-9
    )
    assert not np.allclose(pieces.curve.held_out_error, whole.held_out_error, rtol=1e-3)


def test_the_floor_stays_where_recordings_are_held_out() -> None:
    """It is of all samples, however they are divided."""
    data = [(raw, reference) for raw, reference in _blocks(matrix=TRUTH, drift=0.0, seed=4)]
    floors = [calibrate(_recorded(data, names), PRIOR).curve for names in ("aabba", "aaaaa")]
    assert floors[0] is not None
    assert floors[1] is not None
    assert floors[0].floor == pytest.approx(floors[1].floor, rel=1e-9)
    assert floors[0].floor > 0.0
    assert floors[0].chosen >= floors[0].floor


def test_a_recording_too_short_to_be_fitted_alone_goes_with_its_neighbour() -> None:
    """It costs no choice where two others are long enough; where one is, its intervals are held out as before."""
    blocks = _blocks(matrix=TRUTH, drift=1.0, seed=4)
    short = [(raw[:7], reference[:7]) for raw, reference in blocks[:1]]
    made = calibrate(_recorded([*short, *blocks[1:4]], "abcb"), PRIOR)
    moments = _moments([*short, *blocks[1:4]])
    whole = choose_lambda([pooled([moments[k] for k in ks]) for ks in ([0, 1, 3], [2])], Estimation(prior=PRIOR))
    assert made.held_out is HeldOut.RECORDINGS
    assert made.curve is not None
    np.testing.assert_allclose(made.curve.held_out_error, whole.held_out_error, rtol=1e-9)
    with pytest.raises(FitError, match="at least 8 samples in each of 5 blocks"):
        calibrate(_recorded([*short, *blocks[1:]], "abbbb"), PRIOR)


def test_nothing_is_held_out_where_lambda_is_given() -> None:
    """Recordings or not."""
    made = calibrate(_recorded(_blocks(matrix=TRUTH, drift=1.0), "abcde"), PRIOR, regularisation=1.0)
    assert (made.held_out, made.curve) == (None, None)
