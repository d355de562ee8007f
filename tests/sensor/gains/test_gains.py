# SPDX-License-Identifier: BSD-3-Clause
"""Gains from whole experiments: which samples count, where counts come from, and the posture to take up again."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import recover_raw
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.recording.recording import Use
from forcetorque.sensor.gains.amplifier_gains import MARGIN, GainChange
from forcetorque.sensor.gains.gains import Gains, SensorGains, select_gains
from forcetorque.sensor.gains.result import SensorRow
from tests.results.showing import require_shown
from tests.scenes.experiments import JOINTS, PARQUET, TWO, YARP, add, edit

GAINS = "amplifier_gain = [24, 24, 24, 36, 36, 36]\nallowed_gains = [8, 16, 24, 36, 48]\n"
SERIAL = 'serial = "SIM001"\n'


def _run(experiment: Experiment) -> SensorRun:
    return SensorRun(experiment, experiment.sensors[0])


def _selected(
    run: SensorRun, *, margin: float = MARGIN, calibration: tuple[str, Calibration] | None = None
) -> SensorRow:
    (row,) = select_gains(run, margin=margin, calibration=None if calibration is None else dict([calibration])).sensors
    return row


def _drawn(experiment: Experiment) -> SensorGains:
    (drawn,) = select_gains(_run(experiment)).drawn
    return drawn


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
    plain, drawn = _selected(_run(experiment)), _drawn(experiment)
    inside = [_row(experiment, 0.5), _row(experiment, 14.0), _row(experiment, 14.5), _row(experiment, 23.5)]
    assert len(drawn.time_s) == plain.samples == inside[1] - inside[0] + inside[3] - inside[2]
    raw = experiment.recording.stream("arm_ft").signal("raw").values
    used = np.concatenate([raw[inside[0] : inside[1]], raw[inside[2] : inside[3]]])
    np.testing.assert_array_equal(drawn.counts, used)
    assert [channel.smallest_counts for channel in plain.channels] == used.min(axis=0).tolist()
    assert [channel.largest_counts for channel in plain.channels] == used.max(axis=0).tolist()
    outside = _with_counts(experiment, {(_row(experiment, t), 2): 32767.0 for t in (0.1, 14.2, 23.8)})
    assert _selected(_run(outside)).channels == plain.channels
    peak = _with_counts(experiment, {(_row(experiment, 5.0), 2): 32767.0})
    saturated = _selected(_run(peak))
    assert saturated.channels[2].saturated_share == 1 / saturated.samples
    assert (plain.repeat, saturated.repeat) == (False, True)


def test_an_ignored_interval_takes_its_samples_out(arm: Path) -> None:
    """Also where another interval covers it."""
    add(arm / PARQUET, '\n[[interval]]\nlabel = "bumped"\nstart_s = 4.0\nend_s = 6.0\nuse = "ignore"\n')
    experiment = load_experiment(arm / PARQUET)
    peak = _with_counts(experiment, {(_row(experiment, 5.0), 2): 32767.0})
    assert not _selected(_run(peak)).repeat
    time_s = _drawn(peak).time_s
    assert not ((time_s >= 4.0) & (time_s < 6.0)).any()
    ignored = tuple(replace(i, use=Use.IGNORE) for i in peak.recording.intervals)
    nothing = replace(peak, recording=peak.recording.with_intervals(ignored))
    with pytest.raises(ExperimentError, match="expected an interval that is not ignored, it has none"):
        select_gains(_run(nothing))


def test_the_same_log_through_wrenches_gives_the_same_counts(arm: Path) -> None:
    """The YARP form logs wrenches: counts recovered through the prior are those of the project's form."""
    raw, wrench = (load_experiment(arm / name) for name in (PARQUET, YARP))
    assert [_selected(_run(experiment)).recovered for experiment in (raw, wrench)] == [False, True]
    direct, through = _drawn(raw), _drawn(wrench)
    # 12 printed digits of wrenches through an inverse of condition 1e3, on counts of up to 3e4
    np.testing.assert_allclose(through.counts, direct.counts, atol=1e-4)
    for one, other in zip(direct.channels, through.channels, strict=True):
        assert one.factor == pytest.approx(other.factor, rel=1e-6)


def test_gains_of_the_file_lead_to_gains(arm: Path) -> None:
    """Each channel by the rule: the largest allowed gain with which its peak leaves a fifth of the limit."""
    edit(arm / PARQUET, SERIAL, SERIAL + GAINS)
    experiment = load_experiment(arm / PARQUET)
    run, counts = _run(experiment), _drawn(experiment).counts
    chosen = []
    for readings, channel, present in zip(counts.T, _selected(run).channels, (24, 24, 24, 36, 36, 36), strict=True):
        expected = max(g for g in (8, 16, 24, 36, 48) if np.abs(readings).max() * g / present <= 0.8 * 32767)
        assert (channel.present_gain, channel.recommended_gain) == (present, expected)
        chosen.append(channel.change)
    assert GainChange.RAISE in chosen
    generous = _selected(run, margin=0.95)
    assert all(channel.change is not GainChange.RAISE for channel in generous.channels)


def test_resolution_comes_from_the_prior_or_a_calibration(arm: Path) -> None:
    """The rows of the matrix that is named; with the recommended factors each column is worth less."""
    experiment = load_experiment(arm / PARQUET)
    run = _run(experiment)
    prior, factors = read_matrix_file(arm / "matrix_SIM001.txt").matrix, _drawn(experiment).factors
    own = _selected(run)
    assert own.matrix == "matrix_SIM001.txt"
    np.testing.assert_allclose([axis.worst for axis in own.resolution], np.abs(prior).sum(axis=1), rtol=1e-14)
    expected_rms = [axis.expected_rms for axis in own.resolution]
    np.testing.assert_allclose(expected_rms, np.linalg.norm(prior / factors, axis=1), rtol=1e-14)
    fitted = calibrate_sensor(run, code_version="1", created="now")
    other = _selected(run, calibration=("fitted.json", fitted))
    assert other.matrix == "fitted.json"
    rms = np.array([axis.rms for axis in other.resolution])
    np.testing.assert_allclose(rms, np.linalg.norm(fitted.matrix, axis=1), rtol=1e-14)
    assert (rms != [axis.rms for axis in own.resolution]).all()
    alone = _selected(SensorRun(experiment, replace(run.sensor, prior=None, prior_source=None)))
    assert (alone.matrix, alone.resolution) == (None, ())


def test_the_strongest_sample_carries_the_posture(arm: Path) -> None:
    """Its counts are the peak, and its joints are interpolated at its instant; a gap in a joint is nothing."""
    experiment = load_experiment(arm / PARQUET)
    row = _row(experiment, 9.0)
    peak = _with_counts(experiment, {(row, 3): -30000.0})
    strongest, drawn = _selected(_run(peak)).strongest, _drawn(peak)
    assert [sample.channel for sample in strongest] == [f"ch{k}" for k in range(6)] + [None]
    sample = strongest[3]
    stream = peak.recording.stream("arm_ft")
    assert sample.stamp_ns == stream.stamp_ns[row]
    assert sample.time_s == pytest.approx(9.0, abs=0.03)
    assert sample.counts[3] == -30000.0
    joints = peak.recording.stream("joints")
    for joint, held in zip(JOINTS, sample.joints, strict=True):
        by_hand = np.interp(stream.stamp_ns[row], joints.stamp_ns, joints.signal("position").column(joint))
        assert (held.joint, held.unit) == (joint, "rad")
        assert held.position == pytest.approx(by_hand, abs=1e-6)
    norms = np.linalg.norm(drawn.counts, axis=1)
    assert strongest[-1].time_s == drawn.time_s[norms.argmax()]
    away = (joints.stamp_ns < sample.stamp_ns - 10**9) | (joints.stamp_ns > sample.stamp_ns + 10**9)
    position = joints.signal("position")
    holed = replace(
        joints,
        stamp_ns=joints.stamp_ns[away],
        signals={"position": replace(position, values=position.values[away])},
    )
    gap = replace(peak, recording=replace(peak.recording, streams={**peak.recording.streams, "joints": holed}))
    missing = _selected(_run(gap)).strongest[3].joints
    assert len(missing) == len(JOINTS)
    assert all(held.position is None for held in missing)
    apart = replace(holed, clock="another")
    other = replace(gap, recording=replace(gap.recording, streams={**gap.recording.streams, "joints": apart}))
    assert _selected(_run(other)).strongest[3].joints == ()


def test_a_frozen_reading_asks_for_a_repetition(arm: Path) -> None:
    """Some boards repeat their last value when they saturate: 100 equal samples are counted, and missing ones too."""
    experiment = load_experiment(arm / PARQUET)
    start = _row(experiment, 6.0)
    raw = experiment.recording.stream("arm_ft").signal("raw").values[start]
    frozen = {(row, k): raw[k] for row in range(start, start + 100) for k in range(6)}
    held = select_gains(_run(_with_counts(experiment, frozen)))
    assert (held.sensors[0].frozen, held.sensors[0].repeat) == (100, True)
    (warning,) = held.warnings
    assert warning.startswith("arm_ft: 100 samples repeat one reading, as a board does that saturates")
    holes = {(row, 1): np.nan for row in range(start, start + 7)}
    holed = _selected(_run(_with_counts(experiment, holes)))
    assert (holed.missing, holed.frozen) == (7, 0)
    assert holed.samples == _selected(_run(experiment)).samples - 7
    nothing = {(row, 1): np.nan for row in range(len(experiment.recording.stream("arm_ft")))}
    with pytest.raises(ExperimentError, match="none of .* samples of 'arm_ft' has a reading"):
        select_gains(_run(_with_counts(experiment, nothing)))


def test_a_wrench_of_an_unknown_matrix_has_no_counts(arm: Path) -> None:
    """`identity` takes the reading for counts, which says nothing about the converter."""
    edit(arm / YARP, '"matrix_SIM001.txt"', '"identity"')
    experiment = load_experiment(arm / YARP)
    with pytest.raises(ExperimentError, match="expected raw counts, or the matrix file with which its wrench was made"):
        select_gains(_run(experiment))


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
    first, second = (_selected(SensorRun(experiment, sensor)) for sensor in experiment.sensors)
    assert first.channels[0].present_gain == 24.0
    assert second.channels[0].present_gain is None
    assert first.channels[0].largest_counts != second.channels[0].largest_counts


def test_gains_show_themselves(arm: Path) -> None:
    """In a narrow terminal, on a page and in a cell; two sensors are put together with all that is doubtful."""
    edit(arm / YARP, SERIAL, SERIAL + GAINS)
    gains = select_gains(_run(load_experiment(arm / YARP)))
    require_shown(gains)
    assert [sentence for sentence in gains.warnings if "counts were recovered through matrix_SIM001.txt" in sentence]
    two = load_experiment(arm / TWO)
    both = Gains.together(select_gains(SensorRun(two, sensor)) for sensor in two.sensors)
    require_shown(both)
    assert [row.sensor for row in both.sensors] == ["arm_ft", "tool_ft"]


@pytest.mark.real_data
def test_a_leg_sensor_of_a_real_robot(data_dir: Path, tmp_path: Path) -> None:
    """The leg of a balancing iCub: one channel is 6 % from its limit, others use a fifth of the range at most."""
    text = (Path(__file__).parents[3] / "examples" / "02_icub_yoga_forward.toml").read_text(encoding="utf-8")
    (tmp_path / "yoga.toml").write_text(text.replace("../../shared/data", data_dir.as_posix()))
    experiment = load_experiment(tmp_path / "yoga.toml")
    sensor = experiment.sensors[0]
    run = SensorRun(experiment, replace(sensor, amplifier_gain=(24.0,) * 6, allowed_gains=(8.0, 16.0, 24.0, 48.0)))
    row = _selected(run)
    assert row.samples > 3000
    wrench = experiment.recording.stream(sensor.stream).signal("wrench").values
    assert sensor.prior is not None
    everywhere = recover_raw(wrench, sensor.prior)
    assert (everywhere.min(axis=0) <= [channel.smallest_counts for channel in row.channels]).all()
    headroom = np.array([min(channel.headroom_below, channel.headroom_above) for channel in row.channels])
    assert headroom[3] == pytest.approx(0.058, abs=0.002)
    assert headroom[[0, 1, 2, 5]].min() > 0.8
    assert [channel.recommended_gain for channel in row.channels] == [48.0, 48.0, 48.0, 16.0, 24.0, 48.0]
    assert not row.repeat
    np.testing.assert_allclose([axis.rms for axis in row.resolution[:3]], [0.0335, 0.0340, 0.0367], rtol=0.01)
    joints = {held.joint: held.position for held in row.strongest[-1].joints}
    assert len(joints) == 12
    assert row.strongest[-1].time_s == pytest.approx(37.84, abs=0.02)
    assert joints["r_hip_roll"] == pytest.approx(1.239, abs=0.002)


def _held_still(experiment: Experiment) -> Experiment:
    """The arm stays where it was at 3 s, and its sensor reads noise about what it read there."""
    streams = dict(experiment.recording.streams)
    sensor, joints = streams["arm_ft"], streams["joints"]
    raw, position = sensor.signal("raw"), joints.signal("position")
    noise = np.random.default_rng(4).normal(scale=4.0, size=raw.values.shape)
    streams["arm_ft"] = replace(sensor, signals={"raw": replace(raw, values=np.round(raw.values[150] * 0.01 + noise))})
    streams["joints"] = replace(
        joints, signals={"position": replace(position, values=np.tile(position.values[150], (len(joints), 1)))}
    )
    return replace(experiment, recording=replace(experiment.recording, streams=streams))


@pytest.mark.parametrize("drift_counts", [0.0, 200.0])
@pytest.mark.parametrize("gains", ["", GAINS], ids=["factors", "gains"])
def test_a_limb_that_does_not_move_gets_no_advice(arm: Path, drift_counts: float, gains: str) -> None:
    """Readings far from the limit that stay, or drift, do not say how far they go; those near a limit are lowered."""
    edit(arm / PARQUET, SERIAL, SERIAL + gains)
    still = _held_still(load_experiment(arm / PARQUET))
    stream = still.recording.stream("arm_ft")
    raw = stream.signal("raw").values + np.linspace(0.0, drift_counts, len(stream))[:, None]
    raw[:, 2] += 31000.0
    experiment = _with_counts(still, {(row, k): raw[row, k] for row in range(len(raw)) for k in range(6)})
    result = select_gains(_run(experiment))
    channels = result.sensors[0].channels
    assert [channel.change for channel in channels] == [
        GainChange.LOWER if k == 2 else GainChange.UNKNOWN for k in range(6)
    ]
    assert {(channels[k].recommended_gain, channels[k].largest_factor) for k in (0, 1, 3, 4, 5)} == {(None, None)}
    assert channels[0].expected_largest_counts == channels[0].largest_counts
    assert "none: static" in result.text()
    assert any("ch0, ch1, ch3, ch4, ch5 did not move" in warning for warning in result.warnings)
    moved = select_gains(_run(load_experiment(arm / PARQUET))).sensors[0].channels
    assert GainChange.UNKNOWN not in {channel.change for channel in moved}


def test_advice_without_a_contact_says_so(arm: Path) -> None:
    """A limb in the air does not show what it bears in use; with a contact beyond the sensor the advice stands."""
    free = select_gains(_run(load_experiment(arm / PARQUET)))
    raised = [channel for channel in free.sensors[0].channels if channel.change is GainChange.RAISE]
    assert (free.sensors[0].contact_specified, bool(raised)) == (False, True)
    assert "no contact is specified distal to the sensor: whether operating loads were recorded" in " ".join(
        free.text().split()
    )
    add(arm / PARQUET, '\n[[contact]]\nframe = "hand"\nintervals = ["fit"]\n')
    touched = select_gains(_run(load_experiment(arm / PARQUET)))
    assert touched.sensors[0].contact_specified
    assert "no contact is specified" not in " ".join(touched.text().split())
