# SPDX-License-Identifier: BSD-3-Clause
"""A calibration with several sessions is read in each interval with the offset of its session, everywhere."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.evaluation.validation.contact_force_errors import contact_forces
from forcetorque.experiment.calibration.calibration_file import Calibration, SessionOffset
from forcetorque.experiment.calibration.provenance import FittedInterval
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.experiment.calibration.quadratic_sensor import correction_of_steepness
from tests.scenes.experiments import PARQUET, TWO, edit

STEP = np.array([3.0, -2.0, 5.0, 0.2, -0.1, 0.05])
"""By how much the offset of the other session is another; N, N m."""
NAME = "arm.json"


def _sessions(calibration: Calibration, name: str) -> Calibration:
    """Add a session whose offsets are a step away."""
    prior = calibration.prior
    session = SessionOffset(
        name=name,
        offset=calibration.offset + STEP,
        standard_error=None,
        prior_offset=None if prior is None else prior.offset + STEP,
    )
    return calibration.model_copy(update={"sessions": (session,)})


def _run(folder: Path, file: str = PARQUET) -> SensorRun:
    return SensorRun(load_experiment(folder / file), "arm_ft")


@pytest.fixture
def fitted(arm: Path) -> Calibration:
    """Calibration of the small arm without sessions."""
    found = calibrate_sensor(_run(arm), code_version="test", created="test", regularisation=5.0)
    return found.model_copy(update={"sessions": ()})


def _bias(run: SensorRun, calibration: Calibration) -> dict[str, FloatArray]:
    rows = evaluate(run, {NAME: calibration}).verdicts
    return {row.calibration: row.bias for row in rows if row.offset == "fitted"}


@pytest.mark.long
def test_the_offset_of_the_session_is_used_and_of_no_other(arm: Path, fitted: Calibration) -> None:
    """Calibration and prior alike are a step away in the session, and as they were where it is another's."""
    edit(arm / PARQUET, 'label = "judge"\n', 'label = "judge"\nsession = "day 2"\n')
    run = _run(arm)
    plain = _bias(run, fitted)
    for name, step in (("day 2", STEP), ("day 3", np.zeros(6)), ("small arm", np.zeros(6))):
        shifted = _bias(run, _sessions(fitted, name))
        for candidate, bias in plain.items():
            assert np.allclose(shifted[candidate] - bias, step, rtol=0.0, atol=1e-9)


@pytest.mark.long
def test_a_recording_without_a_session_is_found_by_its_name(arm: Path, fitted: Calibration) -> None:
    """Also by the name that told it from others in the campaign; the file's name comes before the experiment's."""
    run = _run(arm)
    plain = _bias(run, fitted)[NAME]
    for name in ("small arm", "small arm (parquet)", f"small arm ({arm.name}/parquet)"):
        assert np.allclose(_bias(run, _sessions(fitted, name))[NAME] - plain, STEP, rtol=0.0, atol=1e-9)
    assert np.allclose(_bias(run, _sessions(fitted, "small arm (yarp)"))[NAME], plain, rtol=0.0, atol=1e-9)
    both = _sessions(fitted, "small arm (parquet)")
    other = both.sessions[0].model_copy(update={"name": "small arm", "offset": fitted.offset})
    both = both.model_copy(update={"sessions": (other, *both.sessions)})
    assert np.allclose(_bias(run, both)[NAME] - plain, STEP, rtol=0.0, atol=1e-9)


def _estimated(run: SensorRun, calibration: Calibration) -> dict[str, FloatArray]:
    spans = estimate_experiment(run.experiment, corrections_of(run.experiment, {NAME: calibration}))
    return {span.interval.label: span.measured.values[:, span.measured.names.index("arm_ft")] for span in spans}


def test_every_question_reads_the_session(arm: Path, fitted: Calibration) -> None:
    """Contact forces, spheres, estimates and instants of the whole log."""
    edit(arm / TWO, 'label = "judge"\n', 'label = "judge"\nsession = "day 2"\n')
    run, shifted = _run(arm, TWO), _sessions(fitted, "day 2")
    (judge,) = run.intervals(Use.VALIDATION)
    corrections = [Correction.of(NAME, calibration) for calibration in (fitted, shifted)]
    plain, stepped = (run.measured(judge, correction) for correction in corrections)
    assert np.allclose(stepped - plain, STEP, rtol=0.0, atol=1e-9)
    at_ns = run.stream.stamp_ns
    plain, stepped = (wrench_at(run.experiment, run.sensor, correction, at_ns) for correction in corrections)
    inside = judge.holds(at_ns)
    assert np.allclose((stepped - plain)[inside], STEP, rtol=0.0, atol=1e-9)
    assert np.array_equal(stepped[~inside], plain[~inside], equal_nan=True)
    forces = [
        next(
            row
            for row in contact_forces(run, {NAME: one}).verdicts
            if (row.calibration, row.offset) == (NAME, "fitted")
        )
        for one in (fitted, shifted)
    ]
    assert forces[1].force_mean_N > forces[0].force_mean_N + 1.0
    clouds = [spheres(run, {NAME: calibration}).analyses[-1] for calibration in (fitted, shifted)]
    moved = clouds[1].force - clouds[0].force
    assert {tuple(np.round(row, 9)) for row in moved} == {(0.0, 0.0, 0.0), tuple(STEP[:3])}
    plain, stepped = (_estimated(run, calibration) for calibration in (fitted, shifted))
    assert np.allclose(stepped["judge"] - plain["judge"], STEP, rtol=0.0, atol=1e-9)
    assert np.array_equal(stepped["fit"], plain["fit"])


def test_a_recording_that_is_one_session_is_read_alike_outside_its_intervals(arm: Path, fitted: Calibration) -> None:
    """The whole log, as the viewer shows it; a session that the file states reaches no farther than its intervals."""
    run = _run(arm)
    at_ns = run.stream.stamp_ns
    plain = wrench_at(run.experiment, run.sensor, Correction.of(NAME, fitted), at_ns)
    shifted = Correction.of(NAME, _sessions(fitted, "small arm"))
    stepped = wrench_at(run.experiment, run.sensor, shifted, at_ns)
    assert np.allclose(stepped - plain, STEP, rtol=0.0, atol=1e-9)
    edit(arm / PARQUET, 'label = "judge"\n', 'label = "judge"\nsession = "day 2"\n')
    run = _run(arm)
    (judge,) = run.intervals(Use.VALIDATION)
    stepped, inside = wrench_at(run.experiment, run.sensor, shifted, at_ns), judge.holds(at_ns)
    assert np.allclose((stepped - plain)[~inside], STEP, rtol=0.0, atol=1e-9)
    assert np.allclose(stepped[inside], plain[inside], rtol=0.0, atol=1e-9)


def test_a_quadratic_correction_is_of_the_reading_with_its_sessions_offset(arm: Path, fitted: Calibration) -> None:
    """In an interval and at its instants of the whole log alike; a step of the offset then moves more than itself."""
    edit(arm / TWO, 'label = "judge"\n', 'label = "judge"\nsession = "day 2"\n')
    run, shifted = _run(arm, TWO), _sessions(fitted, "day 2")
    (judge,) = run.intervals(Use.VALIDATION)
    curved = shifted.model_copy(update={"quadratic": correction_of_steepness(0.4)})
    model = replace(curved.model, offset=fitted.offset + STEP)
    at_ns = run.instants(judge).at_ns
    linear, measured = (run.measured(judge, Correction.of(NAME, one)) for one in (shifted, curved))
    assert model.quadratic is not None
    assert np.allclose(measured, model.quadratic.corrected(linear), rtol=0.0, atol=1e-9)
    assert np.abs(measured - linear).max() > 1.0
    assert np.array_equal(wrench_at(run.experiment, run.sensor, Correction.of(NAME, curved), at_ns), measured)
    plain = run.measured(judge, Correction.of(NAME, fitted.model_copy(update={"quadratic": curved.quadratic})))
    # negative control: adding the step of the offset to what was corrected without it
    assert np.abs(plain + STEP - measured).max() > 1e-3


def _fitted_elsewhere(calibration: Calibration, experiment: str | None, hashes: dict[str, str]) -> Calibration:
    """Say that a calibration was fitted on the whole of another recording, whose stamps count from the same time."""
    interval = FittedInterval(label="all", start_ns=0, end_ns=2**62, session="day 1", experiment=experiment)
    provenance = calibration.provenance.model_copy(update={"intervals": (interval,), "inputs_sha256": hashes})
    return calibration.model_copy(update={"provenance": provenance})


def test_stamps_of_another_recording_are_no_overlap(arm: Path, fitted: Calibration) -> None:
    """Unless its files went in, under whatever name; an old calibration does not say, so it is refused."""
    run = _run(arm)
    hashes = run.experiment.inputs_sha256
    others = {name: digest for name, digest in hashes.items() if "parquet" not in name}
    assert others
    assert evaluate(run, {NAME: _fitted_elsewhere(fitted, "other", others)}).verdicts
    for experiment, went_in in (("other", hashes), ("small arm", others), (None, others)):
        with pytest.raises(ExperimentError, match="was fitted on the interval 'all', which overlaps"):
            evaluate(run, {NAME: _fitted_elsewhere(fitted, experiment, went_in)})
