# SPDX-License-Identifier: BSD-3-Clause
"""Gains from whole experiments: which samples count, where counts come from, and the posture to take up again."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.analysis import calibrate_sensor, select_gains
from forcetorque.calibration import recover_raw
from forcetorque.errors import ExperimentError
from forcetorque.evaluation import GainChange
from forcetorque.exchange.icub import read_matrix_file
from forcetorque.experiment import Experiment, load_experiment
from forcetorque.recording import Use
from tests.experiments import JOINTS, PARQUET, TWO, YARP, add, edit

GAINS = "amplifier_gain = [24, 24, 24, 36, 36, 36]\nallowed_gains = [8, 16, 24, 36, 48]\n"
SERIAL = 'serial = "SIM001"\n'


def _with_counts(experiment: Experiment, change: dict[tuple[int, int], float]) -> Experiment:
    """The same experiment with some readings of its first sensor replaced, by row and channel."""
    sensor = experiment.sensors[0]
    stream = experiment.recording.stream(sensor.stream)
    signal = stream.signal(sensor.quantity)
    values = np.array(signal.values)
    for place, value in change.items():
        values[place] = value
    changed = replace(stream, signals={sensor.quantity: replace(signal, values=values)})
    streams = {**experiment.recording.streams, sensor.stream: changed}
    return replace(experiment, recording=replace(experiment.recording, streams=streams))


def _row(experiment: Experiment, seconds: float) -> int:
    """Row of the first sample of the sensor at or after a time of the experiment."""
    stamps = experiment.recording.stream("arm_ft").stamp_ns
    return int(np.searchsorted(stamps, experiment.recording.start_ns + round(seconds * 1e9)))


def test_ranges_are_over_the_intervals_that_are_used(arm: Path) -> None:
    """Peaks before, between and after the intervals change nothing; one inside does."""
    experiment = load_experiment(arm / PARQUET)
    plain = select_gains(experiment, experiment.sensors[0])
    inside = [_row(experiment, 0.5), _row(experiment, 14.0), _row(experiment, 14.5), _row(experiment, 23.5)]
    assert len(plain.time_s) == inside[1] - inside[0] + inside[3] - inside[2]
    raw = experiment.recording.stream("arm_ft").signal("raw").values
    used = np.concatenate([raw[inside[0] : inside[1]], raw[inside[2] : inside[3]]])
    np.testing.assert_array_equal(plain.counts, used)
    assert [each.smallest_counts for each in plain.ranges] == used.min(axis=0).tolist()
    assert [each.largest_counts for each in plain.ranges] == used.max(axis=0).tolist()
    outside = _with_counts(experiment, {(_row(experiment, t), 2): 32767.0 for t in (0.1, 14.2, 23.8)})
    assert select_gains(outside, outside.sensors[0]).ranges == plain.ranges
    peak = _with_counts(experiment, {(_row(experiment, 5.0), 2): 32767.0})
    found = select_gains(peak, peak.sensors[0])
    assert found.ranges[2].saturated_samples == 1
    assert (plain.must_repeat, found.must_repeat) == (False, True)


def test_an_ignored_interval_takes_its_samples_out(arm: Path) -> None:
    """Also where another interval covers it."""
    add(arm / PARQUET, '\n[[interval]]\nlabel = "bumped"\nstart_s = 4.0\nend_s = 6.0\nuse = "ignore"\n')
    experiment = load_experiment(arm / PARQUET)
    peak = _with_counts(experiment, {(_row(experiment, 5.0), 2): 32767.0})
    found = select_gains(peak, peak.sensors[0])
    assert not found.must_repeat
    assert not ((found.time_s >= 4.0) & (found.time_s < 6.0)).any()
    ignored = tuple(replace(i, use=Use.IGNORE) for i in peak.recording.intervals)
    nothing = replace(peak, recording=peak.recording.with_intervals(ignored))
    with pytest.raises(ExperimentError, match="expected an interval that is not ignored, it has none"):
        select_gains(nothing, nothing.sensors[0])


def test_the_same_log_through_wrenches_gives_the_same_counts(arm: Path) -> None:
    """The YARP form logs wrenches: counts recovered through the prior are those of the project's form."""
    raw, wrench = (load_experiment(arm / name) for name in (PARQUET, YARP))
    direct, through = (select_gains(e, e.sensors[0]) for e in (raw, wrench))
    assert (direct.recovered, through.recovered) == (False, True)
    # 12 printed digits of wrenches through an inverse of condition 1e3, on counts of up to 3e4
    np.testing.assert_allclose(through.counts, direct.counts, atol=1e-4)
    for one, other in zip(direct.advice, through.advice, strict=True):
        assert one.factor == pytest.approx(other.factor, rel=1e-6)


def test_gains_of_the_file_lead_to_gains(arm: Path) -> None:
    """Each channel by the rule: the largest allowed gain with which its peak leaves a fifth of the limit."""
    edit(arm / PARQUET, SERIAL, SERIAL + GAINS)
    experiment = load_experiment(arm / PARQUET)
    found = select_gains(experiment, experiment.sensors[0])
    chosen = []
    for channel, advice, present in zip(found.counts.T, found.advice, (24, 24, 24, 36, 36, 36), strict=True):
        expected = max(g for g in (8, 16, 24, 36, 48) if np.abs(channel).max() * g / present <= 0.8 * 32767)
        assert (advice.present, advice.recommended) == (present, expected)
        chosen.append(advice.change)
    assert GainChange.RAISE in chosen
    generous = select_gains(experiment, experiment.sensors[0], margin=0.95)
    assert all(advice.change is not GainChange.RAISE for advice in generous.advice)


def test_resolution_comes_from_the_prior_or_a_calibration(arm: Path) -> None:
    """The rows of the matrix that is named; with the recommended factors each column is worth less."""
    experiment = load_experiment(arm / PARQUET)
    sensor = experiment.sensors[0]
    prior = read_matrix_file(arm / "matrix_SIM001.txt").matrix
    found = select_gains(experiment, sensor)
    assert found.matrix_source == "matrix_SIM001.txt"
    assert found.resolution is not None
    assert found.expected_resolution is not None
    np.testing.assert_allclose(found.resolution.worst, np.abs(prior).sum(axis=1), rtol=1e-14)
    np.testing.assert_allclose(found.expected_resolution.rms, np.linalg.norm(prior / found.factors, axis=1), rtol=1e-14)
    fitted = calibrate_sensor(experiment, sensor, code_version="1", created="now")
    other = select_gains(experiment, sensor, calibration=("fitted.json", fitted))
    assert other.matrix_source == "fitted.json"
    assert other.resolution is not None
    np.testing.assert_allclose(other.resolution.rms, np.linalg.norm(fitted.matrix, axis=1), rtol=1e-14)
    assert (other.resolution.rms != found.resolution.rms).all()
    alone = select_gains(experiment, replace(sensor, prior=None, prior_source=None))
    assert (alone.matrix_source, alone.resolution, alone.expected_resolution) == (None, None, None)


def test_the_strongest_sample_carries_the_posture(arm: Path) -> None:
    """Its counts are the peak, and its joints are interpolated at its instant; a gap in a joint is NaN."""
    experiment = load_experiment(arm / PARQUET)
    row = _row(experiment, 9.0)
    peak = _with_counts(experiment, {(row, 3): -30000.0})
    found = select_gains(peak, peak.sensors[0])
    assert [sample.channel for sample in found.strongest] == [f"ch{k}" for k in range(6)] + [None]
    sample = found.strongest[3]
    stream = peak.recording.stream("arm_ft")
    assert sample.stamp_ns == stream.stamp_ns[row]
    assert sample.time_s == pytest.approx(9.0, abs=0.03)
    assert sample.counts[3] == -30000.0
    joints = peak.recording.stream("joints")
    for joint, held in zip(JOINTS, sample.joints, strict=True):
        by_hand = np.interp(stream.stamp_ns[row], joints.stamp_ns, joints.signal("position").column(joint))
        assert (held.joint, held.unit) == (joint, "rad")
        assert held.position == pytest.approx(by_hand, abs=1e-6)
    norms = np.linalg.norm(found.counts, axis=1)
    assert found.strongest[-1].time_s == found.time_s[norms.argmax()]
    away = (joints.stamp_ns < sample.stamp_ns - 10**9) | (joints.stamp_ns > sample.stamp_ns + 10**9)
    position = joints.signal("position")
    holed = replace(
        joints,
        stamp_ns=joints.stamp_ns[away],
        signals={"position": replace(position, values=position.values[away])},
    )
    gap = replace(peak, recording=replace(peak.recording, streams={**peak.recording.streams, "joints": holed}))
    missing = select_gains(gap, gap.sensors[0]).strongest[3].joints
    assert len(missing) == len(JOINTS)
    assert all(np.isnan(held.position) for held in missing)
    apart = replace(holed, clock="another")
    other = replace(gap, recording=replace(gap.recording, streams={**gap.recording.streams, "joints": apart}))
    assert select_gains(other, other.sensors[0]).strongest[3].joints == ()


def test_a_frozen_reading_asks_for_a_repetition(arm: Path) -> None:
    """Some boards repeat their last value when they saturate: 100 equal samples are counted, and missing ones too."""
    experiment = load_experiment(arm / PARQUET)
    start = _row(experiment, 6.0)
    raw = experiment.recording.stream("arm_ft").signal("raw").values[start]
    frozen = {(row, k): raw[k] for row in range(start, start + 100) for k in range(6)}
    found = select_gains(held := _with_counts(experiment, frozen), held.sensors[0])
    assert (found.frozen, found.must_repeat) == (100, True)
    holes = {(row, 1): np.nan for row in range(start, start + 7)}
    found = select_gains(held := _with_counts(experiment, holes), held.sensors[0])
    assert (found.missing, found.frozen) == (7, 0)
    assert len(found.time_s) == len(select_gains(experiment, experiment.sensors[0]).time_s) - 7
    nothing = {(row, 1): np.nan for row in range(len(experiment.recording.stream("arm_ft")))}
    with pytest.raises(ExperimentError, match="none of .* samples of 'arm_ft' has a reading"):
        select_gains(held := _with_counts(experiment, nothing), held.sensors[0])


def test_a_wrench_of_an_unknown_matrix_has_no_counts(arm: Path) -> None:
    """`identity` takes the reading for counts, which says nothing about the converter."""
    edit(arm / YARP, '"matrix_SIM001.txt"', '"identity"')
    experiment = load_experiment(arm / YARP)
    with pytest.raises(ExperimentError, match="expected raw counts, or the matrix file with which its wrench was made"):
        select_gains(experiment, experiment.sensors[0])


def test_gains_are_one_per_channel(arm: Path) -> None:
    """A file with five is refused when it is loaded, of a wrench stream too."""
    for name in (PARQUET, YARP):
        edit(arm / name, SERIAL, SERIAL + "amplifier_gain = [24, 24, 24, 24, 24]\n")
        with pytest.raises(ExperimentError, match=r"sensor\[0\]: expected amplifier_gain of 6 numbers, .* got 5"):
            load_experiment(arm / name)


def test_each_sensor_has_its_own(arm: Path) -> None:
    """Two sensors of one arm read differently, and only one has gains in the file."""
    edit(arm / TWO, SERIAL, SERIAL + GAINS)
    experiment = load_experiment(arm / TWO)
    first, second = (select_gains(experiment, sensor) for sensor in experiment.sensors)
    assert first.advice[0].present == 24.0
    assert second.advice[0].present is None
    assert first.ranges != second.ranges


@pytest.mark.real_data
def test_a_leg_sensor_of_a_real_robot(data_dir: Path, tmp_path: Path) -> None:
    """The leg of a balancing iCub: one channel is 6 % from its limit, others use a fifth of the range at most."""
    text = (Path(__file__).parents[2] / "examples" / "02_icub_yoga_forward.toml").read_text(encoding="utf-8")
    (tmp_path / "yoga.toml").write_text(text.replace("../../shared/data", data_dir.as_posix()))
    experiment = load_experiment(tmp_path / "yoga.toml")
    sensor = experiment.sensors[0]
    found = select_gains(experiment, replace(sensor, amplifier_gain=(24.0,) * 6, allowed_gains=(8.0, 16.0, 24.0, 48.0)))
    assert len(found.time_s) > 3000
    wrench = experiment.recording.stream(sensor.stream).signal("wrench").values
    assert sensor.prior is not None
    everywhere = recover_raw(wrench, sensor.prior)
    assert (everywhere.min(axis=0) <= [each.smallest_counts for each in found.ranges]).all()
    headroom = np.array([each.headroom for each in found.ranges])
    assert headroom[3] == pytest.approx(0.058, abs=0.002)
    assert headroom[[0, 1, 2, 5]].min() > 0.8
    assert [advice.recommended for advice in found.advice] == [48.0, 48.0, 48.0, 16.0, 24.0, 48.0]
    assert not found.must_repeat
    assert found.resolution is not None
    np.testing.assert_allclose(found.resolution.rms[:3], [0.0335, 0.0340, 0.0367], rtol=0.01)
    joints = {held.joint: held.position for held in found.strongest[-1].joints}
    assert len(joints) == 12
    assert found.strongest[-1].time_s == pytest.approx(37.84, abs=0.02)
    assert joints["r_hip_roll"] == pytest.approx(1.239, abs=0.002)
