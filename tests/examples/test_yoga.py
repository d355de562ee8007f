# SPDX-License-Identifier: BSD-3-Clause
"""The main job on a real log: a leg sensor of an iCub that balances on the other foot."""

from __future__ import annotations

import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.evaluation import CalibrationErrors, Evaluation
from forcetorque.evaluation.load_cases.validation_evidence import PriorComparison
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.plausibility.gate import examine
from forcetorque.recording.recording import Use
from forcetorque.recording.smoothing import smooth
from forcetorque.robot.mechanics.measured_and_expected_wrench import SensorSamples
from tests.cases import some_cases
from tests.page_scripts import printed

ROOT = Path(__file__).resolve().parents[2]
YOGA = sorted((ROOT / "examples").glob("0[2-5]_icub_yoga_*.toml"))

pytestmark = pytest.mark.real_data


@cache
def _load(path: Path, data_dir: Path) -> Experiment:
    """Load an example with the data where they are, once for all tests."""
    with TemporaryDirectory() as folder:
        copy = Path(folder) / path.name
        copy.write_text(path.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
        return load_experiment(copy)


@cache
def _evaluation(path: Path, data_dir: Path) -> Evaluation:
    """The calibration of an example's own sensor, judged."""
    experiment = _load(path, data_dir)
    run = SensorRun(experiment, experiment.sensors[0])
    return evaluate(run, {"new": calibrate_sensor(run, code_version="test", created="test")})


def _verdicts(path: Path, data_dir: Path) -> dict[tuple[str, str], CalibrationErrors]:
    return {(v.calibration, v.offset): v for v in _evaluation(path, data_dir).verdicts}


@some_cases("path", YOGA, ids=lambda path: path.name)
def test_no_worse_than_the_prior(path: Path, data_dir: Path) -> None:
    """On judged data neither force nor moment error is above that of the prior, with either offset."""
    verdicts = _verdicts(path, data_dir)
    for offset in ("fitted", "judged-mean"):
        prior, new = verdicts["prior", offset], verdicts["new", offset]
        assert new.samples > 1000
        assert new.force_error_mean_N <= prior.force_error_mean_N
        assert new.moment_error_mean_Nm <= prior.moment_error_mean_Nm
        assert not any(row.conclusion == "worse" for row in _judgements(path, data_dir).values())


@some_cases("path", YOGA, ids=lambda path: path.name)
def test_the_legs_log_raises_no_doubt(path: Path, data_dir: Path) -> None:
    """Fitted while it moves or is nearly static: the leg's sensor is one, and the masses beyond it are right."""
    experiment = _load(path, data_dir)
    parts = SensorRun(experiment, "r_leg_ft_sensor").samples(Use.CALIBRATION)
    assert examine([part.data_set for part in parts], experiment.sensors[0].prior) == ()


@pytest.mark.long
def test_the_free_foots_log_is_in_doubt(data_dir: Path) -> None:
    """It reads a fifth less than the model: what is fitted to that makes its reading of the robot's weight worse."""
    experiment = _load(ROOT / "examples" / "10_icub_yoga_study.toml", data_dir)
    parts = SensorRun(experiment, "r_foot_ft_sensor").samples(Use.CALIBRATION)
    (doubt,) = examine([part.data_set for part in parts], experiment.sensor("r_foot_ft_sensor").prior)
    assert doubt.kind == "scale"
    assert "the gain changed by -2" in doubt.message


@pytest.mark.long
def test_a_quiet_half_still_teaches(data_dir: Path) -> None:
    """Nearly static data: .86 to .60 N with the fitted offset, .76 to .45 N with the mean of what is judged."""
    verdicts = _verdicts(YOGA[2], data_dir)
    prior, new = verdicts["prior", "fitted"], verdicts["new", "fitted"]
    assert (prior.force_error_mean_N, new.force_error_mean_N) == pytest.approx((0.861, 0.597), abs=0.005)
    assert new.moment_error_mean_Nm < 0.95 * prior.moment_error_mean_Nm
    prior, new = verdicts["prior", "judged-mean"], verdicts["new", "judged-mean"]
    assert new.force_error_mean_N < 0.65 * prior.force_error_mean_N


@pytest.mark.long
def test_the_edges_of_a_judged_interval_are_smoothed_as_its_middle_is(data_dir: Path) -> None:
    """Over 43 to 58 s, whole or in pieces, as a longer interval has it; cut there, the reading was off by 1 N."""
    experiment = _load(ROOT / "examples" / "10_icub_yoga_study.toml", data_dir)
    window = experiment.processing.smoothing
    assert window is not None
    span, longer = _over(experiment, 43.0, 58.0), _over(experiment, 40.0, 59.5)
    pieces = [_over(experiment, *ends) for ends in ((43.0, 50.0), (50.0, 58.0))]
    columns = _columns(span)
    np.testing.assert_allclose(columns, _columns(longer)[np.isin(longer.stamp_ns, span.stamp_ns)], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(columns, np.vstack([_columns(piece) for piece in pieces]), rtol=0.0, atol=1e-9)
    plain = replace(experiment, processing=replace(experiment.processing, smoothing=None))
    alone = smooth(span.stamp_ns, _columns(_over(plain, 43.0, 58.0)), window)
    off = np.abs(alone - columns)  # negative control: the filter of what lies inside alone
    assert 0.9 < off.max() < 1.2
    assert off[100:-100].max() < 0.02


def _over(experiment: Experiment, first_s: float, last_s: float) -> SensorSamples:
    """Samples of the first sensor over a span that is judged."""
    start, end = (experiment.recording.start_ns + round(t * 1e9) for t in (first_s, last_s))
    like = experiment.intervals(Use.VALIDATION)[0]
    span = replace(like, label="span", start_ns=start, end_ns=end)
    return SensorRun(experiment, experiment.sensors[0]).interval_samples(span).samples


def _columns(samples: SensorSamples) -> FloatArray:
    return np.hstack([samples.reference, samples.reading.values])


def _judgements(path: Path, data_dir: Path) -> dict[tuple[str, str], PriorComparison]:
    return {(row.offset, row.quantity): row for row in _evaluation(path, data_dir).comparisons}


@pytest.mark.long
def test_the_reverse_is_better_where_the_offset_is_that_of_the_judged_half(data_dir: Path) -> None:
    """Force 3.8 to 0.7 N, better in every stretch: .18 of it. With the fitted offset one stretch is all there is."""
    rows = _judgements(YOGA[1], data_dir)
    for quantity in ("force", "moment"):
        row = rows["judged-mean", quantity]
        assert row.conclusion == "better"
        assert row.ratio_high is not None
        assert row.ratio_high < 0.5
        assert rows["fitted", quantity].conclusion == "inconclusive"
        assert rows["fitted", quantity].segments == 1
    assert rows["judged-mean", "force"].ratio == pytest.approx(0.18, abs=0.02)


@pytest.mark.long
def test_forward_with_the_offset_of_the_judged_half_is_not_better(data_dir: Path) -> None:
    """Negative control: .67 to .55 N, in some stretches more and in some less."""
    row = _judgements(YOGA[0], data_dir)["judged-mean", "force"]
    assert row.mean < row.prior_mean
    assert row.conclusion == "inconclusive"
    assert row.ratio_low is not None
    assert row.ratio_high is not None
    assert row.ratio_low < 1.0 < row.ratio_high


def test_half_the_error_where_the_fitted_part_moves(data_dir: Path) -> None:
    """Fitted on the moving half, the force error on the other is less than half of the prior's."""
    verdicts = _verdicts(YOGA[0], data_dir)
    assert verdicts["new", "fitted"].force_error_mean_N < 0.5 * verdicts["prior", "fitted"].force_error_mean_N


@pytest.mark.long
def test_the_prior_reproduces_the_known_error(data_dir: Path, tmp_path: Path) -> None:
    """The prior's error on unsmoothed data is what an independent static fit saw, 2.9 N forwards and 4.2 N back."""
    for path, seen in ((YOGA[0], 2.9), (YOGA[1], 4.2)):
        text = path.read_text(encoding="utf-8")
        plain = tmp_path / path.name
        plain.write_text(text.replace("smoothing = ", "# smoothing = "))
        verdicts = _verdicts(plain, data_dir)
        assert verdicts["prior", "fitted"].force_error_mean_N == pytest.approx(seen, abs=0.15)


def test_joints_that_the_sensor_does_not_need_may_be_absent(data_dir: Path) -> None:
    """The log holds neither arms nor, in the example, torso and head: the leg's sensor needs two legs."""
    experiment = _load(YOGA[0], data_dir)
    assert set(experiment.recording.streams) == {"right_leg_ft", "left_leg", "right_leg"}


@pytest.mark.long
def test_the_curve_script_shows_every_lambda(data_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The example script prints a row per candidate and marks one."""
    copy = tmp_path / YOGA[0].name
    copy.write_text(YOGA[0].read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
    script = ROOT / "examples" / "06_lambda_curve.py"
    monkeypatch.setattr(sys, "argv", [script.name, str(copy)])
    shown = printed(script.read_text(encoding="utf-8"), script.name)
    assert shown.count("<- chosen") == 1
    assert len(shown.splitlines()) > 40


@pytest.mark.long
def test_nothing_touches_the_free_leg(data_dir: Path) -> None:
    """The contact of the free leg is small, and ten times larger while the floor is touched."""
    experiment = _load(ROOT / "examples" / "08_icub_yoga_contacts.toml", data_dir)
    spans = {
        span.interval.label: span.estimates for span in estimate_experiment(experiment, corrections_of(experiment, {}))
    }
    for contact, limit in (("r_leg_ft_sensor", 5.0), ("r_foot_ft_sensor", 2.0)):
        force = {label: np.linalg.norm(found.contact(contact)[:, :3], axis=1) for label, found in spans.items()}
        mean = {label: np.nanmean(values) for label, values in force.items()}
        assert min(np.count_nonzero(np.isfinite(values)) for values in force.values()) > 700
        assert mean["free"] < limit
        assert min(mean["both feet down"], mean["down again"]) > 10.0 * mean["free"]
