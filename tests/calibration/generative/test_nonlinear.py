# SPDX-License-Identifier: BSD-3-Clause
"""Quadratic terms correct a sensor that is quadratic, and are refused for one that is not."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.calibration.generative.fit import fit_generative
from forcetorque.calibration.generative.generative_calibration import corrected_fit, try_correction
from forcetorque.calibration.summary import calibration_blocks
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.moments import DataSet
from tests.calibration.synthetic import OFFSET, PRIOR, anyhow, assumptions, read_by
from tests.experiment.calibration.quadratic_sensor import ASSUMPTIONS, Specimen, calibrated, means_of
from tests.scenes.calibrations import FACTORY

CROSSTALK_COUNTS = 2000.0
"""Cross-talk of a sensor that a matrix does not tell: at a quarter of full scale some 0.5 % of it."""
RECORDINGS = 3
EXACT = 1e-6
"""Relative: what noise-free recordings leave of the prior; offsets that count are some 10, a hundredth would show."""


def _unseen(calibration: Calibration, data: DataSet) -> FloatArray:
    """Error of force and moment with its own offset removed; shape (2,); N, N m."""
    error = calibration.apply(data.raw, serial="SN001") - data.reference
    error = error - error.mean(axis=0)
    return np.sqrt([(error[:, part] ** 2).sum(axis=1).mean() for part in (slice(3), slice(3, 6))])


def _kept(seeds: range, crosstalk_counts: float) -> list[int]:
    """How many of force and moment are corrected, sensor by sensor, of two recordings and of three in turn."""
    counts = []
    for seed in seeds:
        sensor = Specimen(seed, crosstalk_counts)
        means = means_of([sensor.recording(k) for k in range(2 + seed % 2)])
        counts.append(len(try_correction(means, partial(fit_generative, prior=FACTORY, assumptions=ASSUMPTIONS)).kept))
    return counts


@pytest.mark.long
def test_a_linear_sensor_keeps_no_correction() -> None:
    """Of two recordings as of three; of quadratic ones, the negative control, both do."""
    assert _kept(range(100, 102), 0.0) == [0, 0]
    assert _kept(range(106, 108), CROSSTALK_COUNTS) == [2, 2]


@pytest.mark.long
def test_hardly_any_linear_sensor_keeps_a_correction() -> None:
    """Of 60 sensors, force and moment apart, at most 5 %, and all of 20 quadratic ones."""
    assert sum(_kept(range(300, 360), 0.0)) <= 6
    assert sum(_kept(range(400, 420), CROSSTALK_COUNTS)) == 40


@pytest.mark.long
@pytest.mark.parametrize("seeds", [range(200, 202), pytest.param(range(200, 204), marks=pytest.mark.long)])
def test_a_quadratic_sensor_is_corrected_and_reads_motions_better_that_were_not_fitted(seeds: range) -> None:
    """All keep it in force and moment; on other motions the error is a third, and at most half."""
    ratios = []
    for seed in seeds:
        sensor = Specimen(seed, CROSSTALK_COUNTS)
        data = [sensor.recording(k) for k in range(RECORDINGS)]
        corrected, linear = (calibrated(data, nonlinear=nonlinear) for nonlinear in (True, False))
        assert corrected.nonlinear is not None
        assert corrected.nonlinear.kept == ("force", "moment")
        shown = [block for block in calibration_blocks(corrected) if isinstance(block, str)]
        assert shown[-1].startswith(
            "the quadratic correction of the moment is kept: on recordings that were not fitted "
        )
        assert linear.quadratic is None
        assert linear.nonlinear is None
        unseen = sensor.recording(99)
        ratios.append(_unseen(corrected, unseen) / _unseen(linear, unseen))
    assert np.max(ratios) < 0.5
    assert np.median(ratios, axis=0).max() < 0.35


@pytest.mark.long
def test_a_refused_correction_leaves_the_linear_calibration() -> None:
    """The artefact has no terms, and the same matrix and offsets; it says by how much they lost."""
    sensor = Specimen(1, 0.0)
    data = [sensor.recording(k) for k in range(RECORDINGS)]
    asked, linear = (calibrated(data, nonlinear=nonlinear) for nonlinear in (True, False))
    assert asked.quadratic is None
    assert asked.nonlinear is not None
    assert np.array_equal(asked.matrix, linear.matrix)
    assert np.array_equal(asked.offset, linear.offset)
    force, moment = asked.nonlinear.refusals()
    assert force.startswith("the quadratic correction of the force is refused: on recordings that were not fitted the ")
    assert " N m with it and " in moment
    assert asked.nonlinear.successes() == []


@pytest.mark.long
def test_the_matrix_is_that_of_the_linear_fit_and_offsets_go_with_the_terms() -> None:
    """Fitted recordings have no mean error by their own session's offset; without the terms they have one."""
    sensor = Specimen(2, CROSSTALK_COUNTS)
    data = [sensor.recording(k) for k in range(RECORDINGS)]
    corrected, linear = (calibrated(data, nonlinear=nonlinear) for nonlinear in (True, False))
    assert np.array_equal(corrected.matrix, linear.matrix)
    assert (corrected.residual_rms < 0.25 * linear.residual_rms).all()
    for one in data:
        own = corrected.in_session(one.session)
        error = (own.apply(one.raw, serial="SN001") - one.reference).mean(axis=0)
        without = own.model_copy(update={"quadratic": None})
        bias = (without.apply(one.raw, serial="SN001") - one.reference).mean(axis=0)
        assert (np.linalg.norm(error[:3]), np.linalg.norm(error[3:])) < (0.3, 0.01)
        assert np.linalg.norm(error) < 0.2 * np.linalg.norm(bias)


def test_only_the_half_that_wins_is_corrected() -> None:
    """Rows of the other are zero: it is read as by the linear fit."""
    sensor = Specimen(3, CROSSTALK_COUNTS)
    means = means_of([sensor.recording(k) for k in range(RECORDINGS)])
    fit = fit_generative(means, FACTORY, ASSUMPTIONS)
    halved = corrected_fit(fit, means, ["moment"])
    quadratic = halved.model.quadratic
    assert quadratic is not None
    assert not quadratic.coefficients[:3].any()
    assert quadratic.coefficients[3:].all()
    assert np.array_equal(halved.offsets[:, :3], fit.offsets[:, :3])
    # the model reads by the offset of the last session, as that of the fit does
    for one in (fit, halved):
        np.testing.assert_array_equal(one.model.offset, one.offsets[-1])
    assert np.ptp(halved.offsets, axis=0).min() > 0.0
    assert np.allclose(halved.residual[:3], fit.residual[:3], rtol=1e-9)
    assert (halved.residual[3:] < 0.25 * fit.residual[3:]).all()


@pytest.mark.long
def test_fitted_loads_are_within_the_limits_and_larger_ones_are_not() -> None:
    """The limits are those of the means that were fitted, in their own principal directions."""
    sensor = Specimen(4, CROSSTALK_COUNTS)
    data = [sensor.recording(k) for k in range(RECORDINGS)]
    quadratic = calibrated(data, nonlinear=True).quadratic
    assert quadratic is not None
    for means in means_of(data):
        assert not quadratic.beyond(means.reference).any()
    assert quadratic.beyond(sensor.recording(9, reach=0.3).reference).mean() > 0.5


@pytest.mark.long
def test_a_sensor_that_is_linear_is_not_corrected_for_loads_that_hide_its_gain() -> None:
    """Where a foot is in the air or bears the robot, a term passes for a gain; a fit without terms shows it.

    The negative control is the comparison with the fit that has the terms: by that alone they would win.
    """
    sensor = Specimen(5, 0.0)
    data = []
    for k in range(RECORDINGS):
        load = sensor.recording(k, reach=0.003).reference
        load = (
            load - load.mean(axis=0) + np.outer(np.arange(len(load)) // 40 % 3 == 0, [0.0, 0.0, -300.0, 0.0, 0.0, 0.0])
        )
        raw = sensor.counts(load) + sensor.rng.standard_normal(load.shape)
        data.append(
            DataSet(
                label=f"{k}", raw=raw, reference=load, time_s=np.arange(len(load)) / 4.0, session="a", recording=f"{k}"
            )
        )
    means = means_of(data)
    trial = try_correction(means, partial(fit_generative, prior=FACTORY, assumptions=ASSUMPTIONS))
    assert trial.kept == ()
    fit = fit_generative(means, FACTORY, ASSUMPTIONS)
    corrected = corrected_fit(fit, means, ["force", "moment"])
    assert (corrected.residual / fit.residual).min() < 0.5


def test_errors_on_a_recording_that_was_not_fitted_are_those_of_its_readings() -> None:
    """Others are exact, so that they find the sensor: by samples, about the mean of each session; N, N m.

    Whatever the offsets are; a correction that the others do not need changes nothing.
    """
    rng = np.random.default_rng(0)
    parts, squares = [], []
    for k, (recording, session, sign) in enumerate(
        (("a", "a", 1), ("b", "b", -2), ("c", "early", 3), ("c", "late", -1))
    ):
        load = anyhow(seed=k)
        error = rng.normal(size=load.shape) * [3.0, 3.0, 3.0, 0.2, 0.2, 0.2] * (recording == "c")
        means = read_by(load + error, noise_counts=0.0, offset=sign * OFFSET, session=session, recording=recording)
        count = rng.integers(20, 100, size=len(load)).astype(np.float64)
        parts.append(replace(means, reference=load, count=count, time_s=means.time_s + 100.0 * k))
        squares.append((error - np.average(error, axis=0, weights=count)) ** 2)
    trial = try_correction(parts, partial(fit_generative, prior=PRIOR, assumptions=assumptions()))
    assert trial.recordings == ("a", "b", "c")
    samples = [one.count.sum() for one in parts]
    np.testing.assert_array_equal(trial.samples, [*samples[:2], sum(samples[2:])])
    weights = np.concatenate([one.count for one in parts[2:]])
    square = np.average(np.concatenate(squares[2:]), axis=0, weights=weights)
    expected = np.sqrt([square[:3].sum(), square[3:].sum()])
    np.testing.assert_allclose(trial.linear_rms[2], expected, rtol=EXACT)
    np.testing.assert_allclose(trial.corrected_rms[2], expected, rtol=EXACT)


def test_one_recording_is_not_enough() -> None:
    """There is nothing to judge on; the error says what to do."""
    means = means_of([Specimen(6, 0.0).recording(0)])
    with pytest.raises(FitError, match=r"at least two recordings, got 'recording 0' alone.*leave nonlinear out"):
        try_correction(means, partial(fit_generative, prior=FACTORY, assumptions=ASSUMPTIONS))


def test_a_recording_that_the_fit_cannot_do_without_is_named() -> None:
    """Without a prior the others must determine the matrix by themselves."""
    sensor = Specimen(7, 0.0)
    still = sensor.recording(1, reach=0.0)
    means = means_of([sensor.recording(0), still])
    with pytest.raises(FitError, match=r"^nonlinear: without recording 'recording 0': .*; leave nonlinear out$"):
        try_correction(means, partial(fit_generative, prior=None, assumptions=ASSUMPTIONS))


@pytest.mark.long
def test_moments_say_whether_and_the_caller_rules_over_them() -> None:
    """As the experiment file and the command line do."""
    sensor = Specimen(8, CROSSTALK_COUNTS)
    data = [sensor.recording(k) for k in range(2)]
    assert calibrated(data, nonlinear=None, stated=True).quadratic is not None
    assert calibrated(data, nonlinear=None).nonlinear is None
    assert calibrated(data, nonlinear=False, stated=True).nonlinear is None
