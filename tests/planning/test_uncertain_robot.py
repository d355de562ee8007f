# SPDX-License-Identifier: BSD-3-Clause
"""Plans for a robot whose model may be wrong: against the covariance written out, and against true errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchmarks.planned_errors import LIMBS, Trial, followed
from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.expected_sensor_errors import QUADRATIC_ALONE, Assumptions
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm, ModelTolerance, TermKind
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning import planning
from forcetorque.planning.information import Knowledge, PlannedLoads, unfitted_posterior
from forcetorque.planning.planning import plan
from forcetorque.planning.posture_search import Choices, Criterion, pick
from forcetorque.planning.proposed_recordings import Effort
from forcetorque.planning.result import limits_of
from tests.planning.test_information import CASE, LOADS, MATRIX
from tests.planning.test_plan import BAR, PLAN
from tests.scenes.experiments import PARQUET

MASS = ErrorTerm(name="mass of hand", kind=TermKind.MASS, deviation=0.03, nominal=1.0)
SHORT = Effort(postures=60, swaps=5)
EXACT = 'tolerance = "exact"\n'
"""Line of the scene's experiment file."""
FORCE_N, MOMENT_NM = 2.829046703131845, 0.09581383082308176
"""Predicted errors after a short recording of the arm, before plans knew of tolerances of the robot model."""


@pytest.fixture
def before() -> Posterior:
    """A sensor that repeats itself, of which the prior matrix is known."""
    return unfitted_posterior(MATRIX, Assumptions.of_counts(6, 32767.0, repeatability=0.0))


def _recording(number: int, loads: FloatArray, mass: ErrorTerm = MASS) -> PlannedLoads:
    """A recording in which part of the load is due to a mass, and the acceleration has an error of its own."""
    own = ErrorTerm(name=f"acceleration in {number}", kind=TermKind.ACCELERATION, deviation=0.05)
    rng = np.random.default_rng(number)
    model = np.stack([0.7 * loads, rng.normal(size=loads.shape) * [5.0, 5.0, 5.0, 0.5, 0.5, 0.5]], axis=2)
    n = len(loads)
    return PlannedLoads(
        time_s=np.arange(0.5, n), wrench=loads, variables=np.zeros((n, 0)), terms=(mass, own), model=model
    )


def _written_out(before: Posterior, recordings: Sequence[PlannedLoads]) -> FloatArray:
    """Covariance of all coefficients, the errors of the model, and offsets by recording and row, as one system.

    Errors are the mass, then the acceleration of every recording.
    """
    count, errors = len(recordings), 1 + len(recordings)
    size = 36 + errors + 6 * count
    information = np.zeros((size, size))
    for row in range(6):
        own = slice(6 * row, 6 * row + 6)
        information[own, own] = np.linalg.inv(before.mean_covariance[row])
    deviations = [MASS.deviation, *(0.05 for _ in recordings)]
    information[range(36, 36 + errors), range(36, 36 + errors)] = 1.0 / np.square(deviations)
    for number, loads in enumerate(recordings):
        time = loads.time_s
        assert loads.model is not None
        for row, noise in enumerate(before.noise):
            slow = noise.ratio * np.exp(-np.abs(time[:, None] - time) / noise.time_constant_s)
            design = np.zeros((len(time), size))
            design[:, 6 * row : 6 * row + 6] = loads.wrench
            design[:, [36, 37 + number]] = loads.model[:, row]
            design[:, 36 + errors + 6 * number + row] = 1.0
            information += design.T @ np.linalg.solve(noise.white**2 * (np.eye(len(time)) + slow), design)
    scale = np.sqrt(np.diag(information))
    return np.linalg.inv(information / np.outer(scale, scale)) / np.outer(scale, scale)


def test_two_recordings_share_what_they_tell_of_the_robot(before: Posterior) -> None:
    """All rows and both recordings in one Gaussian inference; a mass that each had for itself would be another."""
    recordings = [_recording(1, LOADS[:25]), _recording(2, LOADS[15:])]
    after = Knowledge.of(before).updated(recordings[0]).updated(recordings[1])
    written = _written_out(before, recordings)
    offsets = len(written) - 6
    for row in range(6):
        places = [*range(6 * row, 6 * row + 6), offsets + row]
        expected = written[np.ix_(places, places)]
        size = np.sqrt(np.diag(expected))
        found = after.posterior.covariance[row]
        np.testing.assert_allclose(found / np.outer(size, size), expected / np.outer(size, size), atol=1e-6)
    np.testing.assert_allclose(after.model.term_covariance, written[36:39, 36:39], rtol=1e-5, atol=1e-12)
    apart = _recording(2, LOADS[15:], MASS.model_copy(update={"name": "another mass"}))
    fresh = Knowledge.of(before).updated(recordings[0]).updated(apart)
    assert Criterion(case=CASE).value(fresh.posterior) < 0.9 * Criterion(case=CASE).value(after.posterior)


def test_a_mass_that_looks_like_a_gain_stays(before: Posterior) -> None:
    """The same robot again and again: only that rows do not err alike tells it from a gain of the sensor.

    The error of a sensor on an exact robot goes to zero.
    """

    def errors(model: bool) -> list[float]:
        known, values = Knowledge.of(before), []
        for number in range(1, 6):
            loads = _recording(number, LOADS)
            only = None if loads.model is None else loads.model[:, :, :1] / 0.7
            loads = replace(loads, terms=(MASS,), model=only) if model else replace(loads, terms=(), model=None)
            known = known.updated(loads)
            values.append(float(np.sqrt(known.posterior.mean_covariance[2, 2, 2])))
        return values

    wrong, exact = errors(True), errors(False)
    assert 0.01 < wrong[-1] < MASS.deviation
    assert wrong[-1] > 0.95 * wrong[0]
    assert exact[-1] < 0.1 * wrong[-1]


def test_a_posterior_is_where_the_next_plan_begins(before: Posterior) -> None:
    """What unknowns owe to the robot stays in it: a recording adds to it as to what it was made of."""
    first, second = _recording(1, LOADS[:25]), _recording(2, LOADS[15:])
    known = Knowledge.of(before).updated(first)
    again = Knowledge.of(known.posterior).updated(second).posterior
    direct = known.updated(second).posterior
    np.testing.assert_allclose(again.covariance, direct.covariance, rtol=1e-6, atol=1e-12)


def test_a_posture_in_which_the_model_matters_is_picked_later(before: Posterior) -> None:
    """Of two postures with one load that whose load the model knows; without errors of the model the first."""
    loads = np.vstack([LOADS[:1], LOADS[1:2], LOADS[1:2]])
    model = np.zeros((3, 6, 1))
    model[1] = 200.0
    term = ErrorTerm(name="zero of joint", kind=TermKind.ZERO, deviation=0.01)
    exact = Choices(columns=loads, travel_s=lambda _: np.full(3, 2.0), hold_s=1.0, seconds=5.0)
    uncertain = Choices(columns=loads, travel_s=exact.travel_s, hold_s=1.0, seconds=5.0, terms=(term,), model=model)
    picked = [pick(before, Criterion(case=CASE), choices, haste=0.0)[1] for choices in (exact, uncertain)]
    assert picked == [1, 2]


def _planning(folder: Path, robot: str) -> SensorRun:
    text = (folder / PARQUET).read_text(encoding="utf-8").replace(EXACT, robot)
    (folder / "own.toml").write_text(text + PLAN + BAR, encoding="utf-8")
    return SensorRun(load_experiment(folder / "own.toml", Purpose.PLANNING), "arm_ft")


def test_an_exact_model_gives_the_plan_of_before_and_another_a_larger_error(
    arm: Path, before: Posterior, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And the assumption is said; what the model makes of the error is in the rows; for equal quadratic terms."""
    monkeypatch.setattr(planning, "quadratic_scale", lambda **_: QUADRATIC_ALONE)
    exact, usual = (
        plan(_planning(arm, robot), recordings=1, seconds=20.0, effort=SHORT) for robot in (EXACT, "tolerance = {}\n")
    )
    (of_exact,), (of_usual,) = exact.recordings, usual.recordings
    assert of_exact.force_after_N == pytest.approx(FORCE_N, rel=1e-9)
    assert of_exact.moment_after_Nm == pytest.approx(MOMENT_NM, rel=1e-9)
    assert (of_exact.force_by_model_N, of_exact.moment_by_model_Nm) == (0.0, 0.0)
    assert of_usual.force_after_N**2 > of_exact.force_after_N**2 + 0.5 * of_usual.force_by_model_N**2 > FORCE_N**2
    assert any("taken as exact" in words for words in exact.limits)
    assert any("masses 3 %, centres of mass 3 mm, joint zeros 0.5 deg" in words for words in usual.limits)
    assert any("cables to pull by 1 N/rad" in words for words in usual.limits)
    without = limits_of(calibrated=False, posterior=before, tolerance=ModelTolerance(cable_N_rad=0.0))
    assert any("joint zeros 0.5 deg, by the same" in words for words in without)


def test_a_calibration_without_cables_is_a_warning(arm: Path) -> None:
    """As of an earlier version, where the plan has cables; not where it has none, or the calibration has them."""

    def said(tolerance: str, calibrated_with: str) -> list[str]:
        run = _planning(arm, calibrated_with)
        posterior = calibrate_sensor(run, code_version="1", created="2020-01-01T00:00:00+00:00").posterior
        assert posterior is not None
        planned = _planning(arm, tolerance).experiment.fit_options.tolerance
        limits = limits_of(calibrated=True, posterior=posterior, tolerance=planned)
        return [words for words in limits if "does not know pulls of cables" in words]

    usual, none = "tolerance = {}\n", "tolerance = { cable_N_rad = 0.0 }\n"
    assert len(said(usual, none)) == 1
    assert not said(none, none)
    assert not said(usual, usual)


def test_a_calibration_that_took_the_model_as_exact_is_a_warning(arm: Path) -> None:
    """Only where the plan does not."""
    fitted = calibrate_sensor(
        SensorRun(load_experiment(arm / PARQUET), "arm_ft"), code_version="1", created="2020-01-01T00:00:00+00:00"
    )
    said = [
        any("took the robot model as exact" in words for words in planned.limits)
        for robot in (EXACT, "tolerance = {}\n")
        for planned in [plan(_planning(arm, robot), fitted, recordings=1, seconds=20.0, effort=SHORT)]
    ]
    assert said == [False, True]


def test_no_recording_is_looked_at_that_takes_too_long(arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its worth takes most of the time of a plan."""
    seconds: list[float] = []
    updated = Knowledge.updated

    def counted(known: Knowledge, loads: PlannedLoads) -> Knowledge:
        seconds.append(float(loads.time_s[-1]))
        return updated(known, loads)

    monkeypatch.setattr(Knowledge, "updated", counted)
    plan(_planning(arm, EXACT), recordings=1, seconds=20.0, effort=SHORT)
    assert seconds
    assert max(seconds) <= 20.0


SEEDS = range(401, 411)
"""Not used while the method was built."""


def _within(trials: Sequence[Trial]) -> float:
    return float(np.mean([np.less_equal(one.true, one.planned_at_most) for one in trials]))


@pytest.mark.long
@pytest.mark.parametrize("limb", LIMBS)
def test_the_error_after_a_planned_recording_is_what_was_predicted(tmp_path: Path, limb: str) -> None:
    """Robots off by the tolerances, calibrated by default; a plan that took the model as exact promises too much."""
    trials = [one for seed in SEEDS for one in followed(tmp_path / str(seed), seed, limb, stages=("next",))]
    true, planned = (np.median([getattr(one, kind) for one in trials], axis=0) for kind in ("true", "planned"))
    assert ((planned / true > 1.0 / 1.5) & (planned / true < 1.5)).all()
    assert 0.9 <= _within(trials) <= 1.0
