# SPDX-License-Identifier: BSD-3-Clause
"""Calibrating by the generative model: several recordings, what was kept of them, sessions, and what disagrees."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FitError, FormatError, MissingFileError
from forcetorque.calibration.calibrate import calibrate_for_file, calibrate_sensor, fit_doubts
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.calibration.calibration_file import (
    GENERATIVE,
    Calibration,
    read_calibration,
    write_calibration,
)
from forcetorque.experiment.calibration.stored_moments import RecordingMoments, read_moments
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.study.candidate_errors import push_error
from tests.scenes.experiments import MOUNTED, PARQUET, RATE_HZ, edit
from tests.scenes.studies import CALIBRATION, SENSOR, VALIDATION


def _runs(folder: Path, files: Sequence[str] = CALIBRATION) -> list[SensorRun]:
    return [SensorRun(load_experiment(folder / file), SENSOR) for file in files]


def _calibrated(runs: Sequence[SensorRun] | None, moments: Sequence[RecordingMoments] = ()) -> Calibration:
    return calibrate_sensor(runs, code_version="1", created="now", moments=moments)


@pytest.mark.long
def test_recordings_together_teach_more_than_each(recorded: Path) -> None:
    """On days with offsets of their own, all four beat each alone; and every load direction is better known."""
    every = _calibrated(_runs(recorded))
    assert every.estimation_type == GENERATIVE
    assert every.posterior is not None
    shares = every.posterior.learnt_shares()
    assert shares is not None
    judged = Campaign(_runs(recorded, VALIDATION))

    def error(calibration: Calibration) -> float:
        rows = evaluate(judged, {"new": calibration}).verdicts
        (row,) = (row for row in rows if (row.calibration, row.offset) == ("new", "judged-mean"))
        return row.force_error_mean_N

    together = error(every)
    for run in _runs(recorded):
        alone = _calibrated([run])
        assert alone.posterior is not None
        assert together < error(alone)
        own = alone.posterior.learnt_shares()
        assert own is not None
        assert (shares > own - 1e-3).all()
    assert [i.experiment for i in every.provenance.intervals] == [run.experiment.name for run in _runs(recorded)]


@pytest.mark.long
def test_every_session_has_its_offset(days: Path) -> None:
    """Two days in one fit: their offsets differ by the change of the power-up, and have errors."""
    for file in VALIDATION:
        edit(days / file, 'use = "validation"', 'use = "calibration"')
    fitted = _calibrated(_runs(days, VALIDATION))
    assert [session.name for session in fitted.sessions] == ["power-up 1", "power-up 2"]
    first, second = (session.offset for session in fitted.sessions)
    assert np.array_equal(fitted.offset, second)
    assert np.abs(first - second)[:3].max() > 0.5  # N
    for session in fitted.sessions:
        assert session.standard_error is not None
        assert (session.standard_error > 0.0).all()
    assert np.array_equal(fitted.in_session("power-up 1").offset, first)
    assert fitted.in_session("elsewhere") is fitted


@pytest.mark.long
def test_what_was_kept_of_recordings_gives_the_same_fit(recorded: Path, tmp_path: Path) -> None:
    """Moments in a file, with runs or alone, come to the matrix of the recordings themselves, to the digits of JSON."""
    runs = _runs(recorded)
    whole = _calibrated(runs)
    kept = []
    for moments in recording_moments(Campaign(runs)):
        moments.save(tmp_path / f"{len(kept)}.json")
        kept.append(read_moments(tmp_path / f"{len(kept)}.json"))
    for calibration in (_calibrated(None, kept), _calibrated(runs[2:], kept[:2])):
        np.testing.assert_allclose(calibration.matrix, whole.matrix, rtol=1e-9)
        assert {i.label for i in calibration.provenance.intervals} == {i.label for i in whole.provenance.intervals}
        assert calibration.provenance.samples == whole.provenance.samples
    assert np.abs(_calibrated(None, kept[:2]).matrix / whole.matrix - 1.0).max() > 1e-6  # negative control


def test_moments_are_refused_that_are_not_of_the_sensor(recorded: Path, tmp_path: Path) -> None:
    """Another serial number, a recording twice, a type of the thesis, a damaged and a missing file."""
    runs = _runs(recorded)
    kept = recording_moments(Campaign(runs))
    other = kept[0].model_copy(update={"sensor": kept[0].sensor.model_copy(update={"serial": "SIM009"})})
    with pytest.raises(FitError, match=r"expected the serial number of 'arm grid_cold', SIM001, got SIM009"):
        _calibrated(None, [kept[0], other])
    with pytest.raises(FitError, match=r"interval 'grid_cold' of 'arm grid_cold' comes twice"):
        _calibrated(runs, kept[:1])
    with pytest.raises(FitError, match="stored moments are fitted by the generative model"):
        calibrate_sensor(runs[1:], code_version="1", created="now", moments=kept[:1], regularisation=5.0)
    with pytest.raises(FitError, match="stored moments are fitted by the generative model"):
        calibrate_sensor(None, code_version="1", created="now", moments=kept, regularisation=5.0)
    with pytest.raises(FitError, match="stored moments are fitted by the generative model"):
        calibrate_sensor(None, code_version="1", created="now", moments=kept, kind="OwTrTO")
    file = tmp_path / "moments.json"
    with pytest.raises(MissingFileError, match="expected a file of moments"):
        read_moments(file)
    kept[0].save(file)
    file.write_text(file.read_text(encoding="utf-8")[:-100], encoding="utf-8")
    with pytest.raises(FormatError, match="expected JSON"):
        read_moments(file)
    file.write_text(json.dumps({"schema": "forcetorque/moments/2"}), encoding="utf-8")
    with pytest.raises(FormatError, match="sensor: expected this key, there is none"):
        read_moments(file)


def test_the_posterior_is_in_the_file(recorded: Path, tmp_path: Path) -> None:
    """Written and read again, it predicts the same errors; loads that were not moved are predicted worse."""
    fitted = _calibrated(_runs(recorded, CALIBRATION[:1]))
    write_calibration(tmp_path / "c.json", fitted)
    again = read_calibration(tmp_path / "c.json")
    assert fitted.posterior is not None
    assert again.posterior is not None
    wrenches = np.vstack([10.0 * np.eye(6)[:3], np.eye(6)[3:]])
    mine, theirs = (c.posterior.error_covariance(wrenches) for c in (fitted, again) if c.posterior is not None)
    np.testing.assert_allclose(mine, theirs, rtol=1e-12)
    before = fitted.posterior.prior_error_covariance(wrenches)
    assert before is not None
    learnt = fitted.posterior.learnt_error_covariance(wrenches)
    assert (np.einsum("kii->k", learnt) < np.einsum("kii->k", before)).all()
    with_offset = fitted.posterior.error_covariance(wrenches, session="power-up 0")
    assert with_offset.shape == (6, 6, 6)


def test_the_answer_shows_sessions_and_what_was_learnt(days: Path, tmp_path: Path) -> None:
    """A table of offsets by session, and words for every load direction."""
    for file in VALIDATION:
        edit(days / file, 'use = "validation"', 'use = "calibration"')
    result = calibrate_for_file(_runs(days, VALIDATION), tmp_path / "c.json", code_version="1", created="now")
    text = result.text(120)
    assert "offset of every session" in text
    assert "information gained: fx " in text
    (entry,) = result.calibrations
    assert entry.information_gain is not None
    assert [row.direction for row in entry.information_gain] == ["fx", "fy", "fz", "tx", "ty", "tz"]


def test_another_sensor_is_refused(days: Path) -> None:
    """Every sensor has its own matrix."""
    edit(days / CALIBRATION[1], 'serial = "SIM001"', 'serial = "SIM777"')
    with pytest.raises(ExperimentError, match="expected the serial number of .*, SIM001, got SIM777"):
        Campaign(_runs(days))


def test_a_thesis_type_warns_where_loads_leave_it_alone(intact: Path) -> None:
    """Raw directions without load are noise to it; the default keeps the prior there and has nothing to warn of."""
    run = SensorRun(load_experiment(intact / PARQUET), "arm_ft")
    assert len(run.samples(Use.CALIBRATION)) == 1
    of_thesis = calibrate_sensor(run, code_version="1", created="now", regularisation=0.0)
    excited = of_thesis.validity.model_copy(update={"excited": (True,) * 5 + (False,)})
    words = [*fit_doubts(of_thesis.model_copy(update={"validity": excited}))]
    assert any("along them OnTdTO leaves the prior for noise" in sentence for sentence in words)
    default = calibrate_sensor(run, code_version="1", created="now")
    assert not [*fit_doubts(default.model_copy(update={"validity": excited}))]


@pytest.mark.long
def test_a_contact_that_nobody_stated_is_left_out_and_said(arm: Path, tmp_path: Path) -> None:
    """Three seconds with 24 N on the hand: counted, and named with their seconds in the artefact and its file."""
    file = edit(arm / PARQUET, "start_s = 14.5\nend_s = 23.5", "start_s = 23.5\nend_s = 23.9")
    experiment = load_experiment(edit(file, "end_s = 14.0", "end_s = 23.5"))
    stream = experiment.recording.stream("arm_ft")
    time = (stream.stamp_ns - experiment.recording.start_ns) * 1e-9
    counts = stream.signal("raw").values.copy()
    counts[(time > 9.0) & (time < 12.0)] += np.linalg.solve(MOUNTED, [20.0, 10.0, -10.0, 1.0, -1.0, 0.5])
    signals = dict(stream.signals) | {"raw": replace(stream.signal("raw"), values=counts)}
    streams = dict(experiment.recording.streams) | {"arm_ft": replace(stream, signals=signals)}
    touched = replace(experiment, recording=replace(experiment.recording, streams=streams))
    clean, fitted = _calibrated([SensorRun(experiment, "arm_ft")]), _calibrated([SensorRun(touched, "arm_ft")])
    assert not any("is left out" in doubt for doubt in clean.warnings)
    assert clean.provenance.dropped == 0
    (doubt,) = (doubt for doubt in fitted.warnings if "is left out" in doubt)
    assert doubt.startswith(
        "interval 'fit': 7.51 to 13.48 s is left out: the readings disagree there with all others, by"
    )
    assert fitted.provenance.dropped == clean.provenance.samples - fitted.provenance.samples == 6.0 * RATE_HZ
    assert fitted.validity.raw_maximum_counts == pytest.approx(clean.validity.raw_maximum_counts, rel=0.2)
    write_calibration(tmp_path / "fitted.json", fitted)
    assert doubt in read_calibration(tmp_path / "fitted.json").warnings
    errors = [push_error(one.matrix, MOUNTED).force_N for one in (clean, fitted)]
    assert errors[1] < 1.5 * errors[0]
    keeping = replace(touched, processing=replace(touched.processing, keep=frozenset({"disagreeing"})))
    kept = _calibrated([SensorRun(keeping, "arm_ft")])
    assert kept.provenance.dropped == 0
    assert not any("is left out" in one for one in kept.warnings)
