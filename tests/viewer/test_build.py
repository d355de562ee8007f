# SPDX-License-Identifier: BSD-3-Clause
"""The scene holds what the library computes, and says what is absent."""

from __future__ import annotations

import dataclasses
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ExperimentError, RecordingError, SerialNumberError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.interval_samples import samples_over
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Use
from forcetorque.recording.stream import Stream
from forcetorque.viewer.scene import ArrayRef, Sensor, WrenchSeries, scene_json
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene, build_scene
from tests.scenes.experiments import DURATION_S, JOINTS, PARQUET, RATE_HZ, TWO, YARP, add, edit

FLOAT32 = 2e-7
"""Rounding to 24 bits, relative."""
IGNORED = '\n[[interval]]\nlabel = "between"\nstart_s = 14.0\nend_s = 14.4\nuse = "ignore"\n'
EMPTY = '\n[[interval]]\nlabel = "nothing"\nstart_s = {:.6f}\nend_s = {:.6f}\nuse = "validation"\nsupport = "base"\n'


def _view(file: Path, calibrations: dict[str, Calibration] | None = None, **options: object) -> BuiltScene:
    return build_scene(load_experiment(file), calibrations or {}, **options)  # type: ignore[arg-type]


def _fitted(experiment: Experiment, *, regularisation: float | None) -> Calibration:
    return calibrate_sensor(
        SensorRun(experiment, experiment.sensors[0]),
        code_version="1",
        created="2020-01-01",
        regularisation=regularisation,
    )


def _series(sensor: Sensor, name: str) -> WrenchSeries:
    (found,) = (series for series in sensor.wrenches if series.name == name)
    return found


def _values(built: BuiltScene, name: str, sensor: int = 0) -> FloatArray:
    return read_array(built.block, _series(built.scene.sensors[sensor], name).values).astype(np.float64)


def _shown(built: BuiltScene, stream: Stream) -> BoolArray:
    """Which samples of a stream are shown; all but those before the first or after the last posture."""
    stamps = int(built.scene.start_ns) + np.round(read_array(built.block, built.scene.time_s) * 1e9).astype(np.int64)
    shown = np.isin(stream.stamp_ns, stamps)
    assert shown.sum() == built.scene.samples >= len(stream) - 2
    return shown


def _notes(built: BuiltScene) -> str:
    return "\n".join(built.scene.notes)


def _arrays(value: object) -> list[dict[str, object]]:
    if isinstance(value, dict):
        fields = {field.name for field in dataclasses.fields(ArrayRef)}
        return [value] if set(value) == fields else [a for v in value.values() for a in _arrays(v)]
    return [array for item in value for array in _arrays(item)] if isinstance(value, list) else []


def test_the_header_is_json_and_its_arrays_lie_in_the_block(built: BuiltScene) -> None:
    """Every array starts at a multiple of 8, none overlaps another, and all of them are the block."""
    header = json.loads(scene_json(built.scene))
    assert header["schema"] == "forcetorque/scene/1"
    arrays = sorted(_arrays(header), key=lambda array: array["offset"])
    assert len(arrays) >= 5
    end = 0
    for array in arrays:
        assert array["offset"] % 8 == 0
        assert array["offset"] == end
        assert array["packed_bytes"] is None
        end += -(-int(np.prod(array["shape"])) * np.dtype(array["dtype"]).itemsize // 8) * 8
    assert end == len(built.block)


def test_arrays_read_back(built: BuiltScene) -> None:
    """Times, coordinates and root have the shapes that they document; whoever reads an array cannot change it."""
    scene, n = built.scene, built.scene.samples
    assert DURATION_S * RATE_HZ - 2 <= n <= DURATION_S * RATE_HZ
    assert (scene.time_s.shape, scene.positions.shape, scene.root.shape) == ((n,), (n, len(JOINTS)), (n, 7))
    time_s = read_array(built.block, scene.time_s)
    assert (np.diff(time_s) > 0.0).all()
    with pytest.raises(ValueError, match="read-only"):
        time_s[0] = 1.0
    with pytest.raises(ValueError, match="size"):
        read_array(built.block, ArrayRef(offset=8, shape=(len(built.block),), dtype="float32"))


def test_the_whole_log_is_shown_with_the_logged_coordinates(intact: Path, built: BuiltScene) -> None:
    """Instants are those of the sensor, coordinates those of the log, also outside intervals."""
    recording = load_experiment(intact / PARQUET).recording
    stream, joints = recording.stream("arm_ft"), recording.stream("joints")
    stamps = stream.stamp_ns[_shown(built, stream)]
    assert built.scene.start_ns == str(recording.start_ns)
    assert built.scene.coordinates == joints.signal("position").columns
    logged = interpolate(joints, joints.signal("position").values, stamps)
    np.testing.assert_allclose(read_array(built.block, built.scene.positions), logged, rtol=FLOAT32, atol=1e-7)


def test_expected_wrenches_are_those_of_the_fit_inside_intervals_only(intact: Path, built: BuiltScene) -> None:
    """Where an interval states a support the model's reading is the library's reference; elsewhere there is none."""
    experiment = load_experiment(intact / PARQUET)
    stream = experiment.recording.stream("arm_ft")
    stamps = stream.stamp_ns[_shown(built, stream)]
    shown, inside = _values(built, "expected"), np.zeros(len(stamps), dtype=bool)
    for interval in experiment.recording.intervals:
        samples = samples_over(experiment, experiment.sensors[0], interval, smoothed=False).samples
        chosen = np.isin(stamps, samples.stamp_ns)
        np.testing.assert_allclose(shown[chosen], samples.reference, rtol=FLOAT32, atol=1e-5)
        inside |= chosen
    assert 0 < inside.sum() < len(inside)
    assert np.isnan(shown[~inside]).all()


def test_series_are_expected_prior_and_every_calibration(intact: Path) -> None:
    """In this order and under the names of their files; each is what its model makes of the counts."""
    experiment = load_experiment(intact / PARQUET)
    weak, strong = (_fitted(experiment, regularisation=value) for value in (0.0, 1e9))
    built = build_scene(experiment, {"weak.json": weak, "strong.json": strong})
    (sensor,) = built.scene.sensors
    assert [(series.name, series.role) for series in sensor.wrenches] == [
        ("expected", "expected"),
        ("prior", "measured"),
        ("weak.json", "measured"),
        ("strong.json", "measured"),
    ]
    stream = experiment.recording.stream("arm_ft")
    raw = stream.signal("raw").values[_shown(built, stream)]
    for name, model in (("weak.json", weak.model), ("strong.json", strong.model)):
        np.testing.assert_allclose(_values(built, name), model.wrench(raw), rtol=FLOAT32, atol=1e-4)
    assert experiment.sensors[0].prior is not None
    moved = _values(built, "prior") - raw @ experiment.sensors[0].prior.T
    np.testing.assert_allclose(moved, np.broadcast_to(moved[0], moved.shape), rtol=0, atol=1e-4)
    seconds = read_array(built.block, built.scene.time_s)
    inside = (seconds >= 0.5) & (seconds < 14.0)
    difference = (_values(built, "prior") - _values(built, "expected"))[inside].mean(axis=0)
    np.testing.assert_allclose(difference, 0.0, rtol=0, atol=1e-4)  # its offset is that of the calibration interval


def test_deviations_are_those_of_the_posterior_under_the_expected_load(intact: Path) -> None:
    """Where nothing is expected there is none; a series without a posterior has none at all."""
    experiment = load_experiment(intact / PARQUET)
    fitted = _fitted(experiment, regularisation=None)
    built = build_scene(experiment, {"fitted.json": fitted})
    (sensor,) = built.scene.sensors
    assert [series.calibrated for series in sensor.wrenches] == [False, False, True]
    assert _series(sensor, "prior").deviation is None
    reference = _series(sensor, "fitted.json").deviation
    assert reference is not None
    deviation, expected = read_array(built.block, reference), _values(built, "expected").astype(np.float64)
    known = np.flatnonzero(np.isfinite(expected).all(axis=1))
    assert np.array_equal(np.isfinite(deviation).all(axis=1), np.isfinite(expected).all(axis=1))
    assert fitted.posterior is not None
    for session, sample in zip(fitted.posterior.sessions[-1:] * 3, known[[0, len(known) // 2, -1]], strict=True):
        covariance = fitted.posterior.error_covariance(expected[sample], session=session)
        np.testing.assert_allclose(deviation[sample], np.sqrt(np.diag(covariance)), rtol=1e-5)


@pytest.mark.long
def test_sphere_and_ellipsoid_lie_in_the_clouds(intact: Path) -> None:
    """Expected forces lie about the sphere of the weight, those of a series on its ellipsoid, offset included."""
    experiment = load_experiment(intact / PARQUET)
    built = build_scene(experiment, {"fitted.json": _fitted(experiment, regularisation=0.0)})
    (sensor,) = built.scene.sensors
    sphere = _series(sensor, "expected").reference_force
    assert sphere is not None
    assert sphere.centre == (0.0, 0.0, 0.0)
    size = np.linalg.norm(_values(built, "expected")[:, :3], axis=1)
    assert np.nanmedian(size) == pytest.approx(sphere.radius, rel=0.1)  # it swings
    for name in ("prior", "fitted.json"):
        ellipsoid = _series(sensor, name).ellipsoid_force
        assert ellipsoid is not None
        points = _values(built, name)[:, :3] - np.array(ellipsoid.centre)
        unit = np.linalg.solve(np.reshape(ellipsoid.axes, (3, 3)), points.T)
        assert np.median(np.linalg.norm(unit, axis=0)) == pytest.approx(1.0, abs=0.1)


@pytest.mark.long
def test_ellipsoids_of_a_long_log_see_a_part_of_it(intact: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """From every third sample they are nearly the same, and the page says that they are."""
    whole = _view(intact / PARQUET)
    monkeypatch.setattr("forcetorque.viewer.sensor_wrenches._SPHERE_SAMPLES", 500)
    part = _view(intact / PARQUET)
    assert any(line.endswith("over 'fit', 'judge', from one sample in 3") for line in part.scene.provenance)
    for name in ("prior", "expected"):
        np.testing.assert_array_equal(_values(part, name), _values(whole, name))
    ours, theirs = (_series(scene.scene.sensors[0], "prior").ellipsoid_force for scene in (part, whole))
    assert ours is not None
    assert theirs is not None
    np.testing.assert_allclose(ours.centre, theirs.centre, rtol=0, atol=0.05)
    assert ours.centre != theirs.centre


def test_a_logged_wrench_is_shown_and_not_recovered(intact: Path) -> None:
    """A stream of wrenches gives the series `logged`, with the offset over the calibration interval."""
    built = _view(intact / YARP)
    stream = load_experiment(intact / YARP).recording.stream("arm_ft")
    moved = _values(built, "logged") - stream.signal("wrench").values[_shown(built, stream)]
    np.testing.assert_allclose(moved, np.broadcast_to(moved[0], moved.shape), rtol=0, atol=1e-4)
    assert any("arm_ft: logged is the logged wrench, offset over 'fit'" in line for line in built.scene.provenance)


def test_inputs_and_version_are_stated(intact: Path, built: BuiltScene) -> None:
    """Every file with its hash, and what made the scene."""
    hashes = load_experiment(intact / PARQUET).inputs_sha256
    assert hashes
    for name, digest in hashes.items():
        assert f"{name} sha256 {digest}" in built.scene.provenance
    assert any(line.startswith("forcetorque ") for line in built.scene.provenance)


@pytest.mark.long
def test_two_sensors_and_a_choice_of_them(intact: Path) -> None:
    """All sensors are shown, or those asked for; the frame of each is where the robot has it."""
    both = _view(intact / TWO)
    assert [sensor.name for sensor in both.scene.sensors] == ["arm_ft", "tool_ft"]
    chosen = _view(intact / TWO, sensors=["tool_ft"])
    assert [(sensor.name, sensor.link) for sensor in chosen.scene.sensors] == [("tool_ft", "tool")]
    middle = [(_values(scene, "expected", sensor=k)[300], scene) for scene, k in ((both, 1), (chosen, 0))]
    np.testing.assert_allclose(middle[0][0], middle[1][0], rtol=0, atol=0.5)  # at instants some ms apart


def test_an_unknown_sensor_is_refused_with_the_known_ones(intact: Path) -> None:
    """A name that the experiment does not have is an error, not an empty page."""
    with pytest.raises(ExperimentError, match="no sensor 'arm_fz'; did you mean \"arm_ft\""):
        _view(intact / PARQUET, sensors=["arm_fz"])


@pytest.mark.long
def test_series_have_the_names_of_files_without_folders(intact: Path) -> None:
    """But for as many as tell them apart, from each other and from what is read otherwise."""
    experiment = load_experiment(intact / PARQUET)
    files = ["/tmp/x/march/prior", "/tmp/x/may/fitted.json"]
    (sensor,) = build_scene(experiment, dict.fromkeys(files, _fitted(experiment, regularisation=0.0))).scene.sensors
    names = [series.name for series in sensor.wrenches]
    assert names == ["expected", "prior", "march/prior", "may/fitted.json"]


def test_a_calibration_of_another_sensor_is_refused(intact: Path) -> None:
    """What may not be applied is not drawn."""
    experiment = load_experiment(intact / PARQUET)
    fitted = _fitted(experiment, regularisation=0.0)
    other = fitted.model_copy(update={"sensor": fitted.sensor.model_copy(update={"serial": "SIM999"})})
    with pytest.raises(SerialNumberError, match="SIM999"):
        build_scene(experiment, {"other.json": other})


def test_contacts_are_those_at_the_sensors_unless_stated(arm: Path) -> None:
    """As `forcetorque estimate` has them: at the sensor and the support, or those of the file, in their own frames."""
    built = _view(arm / PARQUET)
    assert [(contact.name, contact.link) for contact in built.scene.contacts] == [
        ("base", "base"),
        ("arm_ft", "upper_arm"),
    ]
    add(arm / PARQUET, '\n[[contact]]\nframe = "hand"\nposition_m = [0.0, 0.0, -0.1]\ntype = "force"\n')
    stated = _view(arm / PARQUET)
    assert [contact.name for contact in stated.scene.contacts] == ["base", "hand"]
    pose = np.reshape(stated.scene.contacts[1].link_H_contact, (4, 4))
    np.testing.assert_array_equal(pose[:3, 3], [0.0, 0.0, -0.1])
    values = read_array(stated.block, stated.scene.contacts[1].values)
    expected = _values(stated, "expected")
    np.testing.assert_array_equal(np.isfinite(values).all(axis=1), np.isfinite(expected).all(axis=1))
    assert not np.nan_to_num(values)[:, 3:].any()


def test_contacts_have_the_gaps_of_the_log(intact: Path) -> None:
    """Where the sensor that times the estimates was silent, no old wrench stays at the contacts."""
    cut = _cut(load_experiment(intact / TWO), "arm_ft", lambda seconds: (seconds < 5.0) | (seconds > 6.0))
    built = build_scene(cut, {}, sensors=["tool_ft"])
    seconds = read_array(built.block, built.scene.time_s)
    silent = (seconds > 5.0 + 5 / RATE_HZ) & (seconds < 6.0)
    assert silent.sum() > 40, "the shown sensor goes on"
    for contact in built.scene.contacts:
        values = read_array(built.block, contact.values)
        assert np.isnan(values[silent]).all(), contact.name
        assert np.isfinite(values[(seconds > 2.0) & (seconds < 5.0 - 1 / RATE_HZ)]).all(), contact.name
    assert len(built.scene.contacts) == 3


@pytest.mark.parametrize("direction", list(MeasureDirection))
def test_it_is_said_who_acts_on_whom(intact: Path, direction: MeasureDirection) -> None:
    """The links change places with the sign of the reading."""
    experiment = load_experiment(intact / PARQUET)
    tag = experiment.model.sensor("arm_ft")
    joint = experiment.model.joints[tag.joint]
    model = replace(experiment.model, sensors={**experiment.model.sensors, "arm_ft": replace(tag, direction=direction)})
    (sensor,) = build_scene(replace(experiment, model=model), {}).scene.sensors
    ends = (joint.child, joint.parent) if direction == "child_to_parent" else (joint.parent, joint.child)
    assert (sensor.acting, sensor.acted_on) == ends


@pytest.mark.long
def test_intervals_and_findings_have_seconds(arm: Path) -> None:
    """Intervals count from the start of the recording, and what is wrong has its time."""
    built = _view(add(arm / PARQUET, IGNORED))
    spans = [(i.label, i.use, round(i.start_s, 6), round(i.end_s, 6), i.support) for i in built.scene.intervals]
    assert spans == [
        ("fit", "calibration", 0.5, 14.0, "base"),
        ("judge", "validation", 14.5, 23.5, "base"),
        ("between", "ignore", 14.0, 14.4, None),
    ]
    gap = _cut(load_experiment(arm / PARQUET), "arm_ft", lambda seconds: (seconds < 5.0) | (seconds > 6.0))
    (finding,) = (finding for finding in build_scene(gap, {}).scene.findings if finding.kind == "gap")
    assert finding.start_s == pytest.approx(5.0, abs=0.03)
    assert finding.end_s == pytest.approx(6.0, abs=0.03)


def _cut(experiment: Experiment, stream: str, keep: object) -> Experiment:
    """The same without some samples of a stream."""
    source = experiment.recording.stream(stream)
    chosen = keep((source.stamp_ns - experiment.recording.start_ns) * 1e-9)  # type: ignore[operator]
    signals = {name: replace(signal, values=signal.values[chosen]) for name, signal in source.signals.items()}
    streams = {
        **experiment.recording.streams,
        stream: replace(source, stamp_ns=source.stamp_ns[chosen], signals=signals),
    }
    return replace(experiment, recording=replace(experiment.recording, streams=streams))


def test_the_posture_is_held_in_gaps(intact: Path) -> None:
    """While the joints are not logged the robot keeps its last posture, and a note says for how long."""
    cut = _cut(load_experiment(intact / PARQUET), "joints", lambda s: (s < 5.0) | (s > 6.0))
    built = build_scene(cut, {})
    shown, seconds = read_array(built.block, built.scene.positions), read_array(built.block, built.scene.time_s)
    inside = (seconds > 5.01) & (seconds < 5.99)
    assert inside.sum() > 40
    assert np.unique(shown[inside], axis=0).shape == (1, len(JOINTS))
    (held,) = re.findall(r"stream 'joints': (\d+) sample\(s\) in gaps show the last posture before", _notes(built))
    assert inside.sum() <= int(held) <= inside.sum() + 5
    assert np.isfinite(shown).all()


def test_instants_are_those_at_which_joints_are_known(intact: Path) -> None:
    """A sensor that was logged for longer than the joints is shown while both were."""
    cut = _cut(load_experiment(intact / PARQUET), "joints", lambda s: (s > 2.0) & (s < 20.0))
    built = build_scene(cut, {})
    seconds = read_array(built.block, built.scene.time_s)
    assert 2.0 <= seconds[0] < 2.05
    assert 19.95 < seconds[-1] <= 20.0


def test_an_empty_interval_leaves_the_rest_as_it_is(arm: Path, built: BuiltScene) -> None:
    """An interval between two samples is drawn on the time axis and noted; everything else is there."""
    recording = load_experiment(arm / PARQUET).recording
    stamps = (recording.stream("arm_ft").stamp_ns - recording.start_ns) * 1e-9
    before, after = stamps[np.searchsorted(stamps, 14.1) - 1 :][:2]
    other = _view(add(arm / PARQUET, EMPTY.format(before + 1e-3, after - 1e-3)), urdf=arm / "arm.urdf")
    assert "interval 'nothing' is left out: it holds no sample" in _notes(other)
    assert [interval.label for interval in other.scene.intervals] == ["fit", "judge", "nothing"]
    np.testing.assert_array_equal(_values(other, "expected"), _values(built, "expected"))
    assert [contact.name for contact in other.scene.contacts] == [contact.name for contact in built.scene.contacts]


def test_without_the_joints_there_are_no_expected_wrenches(intact: Path) -> None:
    """A log that lacks what the model needs shows what was measured, and says which joints are missing."""
    experiment = load_experiment(intact / PARQUET)
    streams = {"arm_ft": experiment.recording.stream("arm_ft")}
    built = build_scene(replace(experiment, recording=replace(experiment.recording, streams=streams)), {})
    (sensor,) = built.scene.sensors
    assert [series.name for series in sensor.wrenches] == ["prior"]
    assert np.isfinite(_values(built, "prior")).all()
    assert built.scene.coordinates == ()
    notes = _notes(built)
    assert "no stream holds the position of 5 joint(s), which are drawn at zero: shoulder_yaw" in notes
    assert "sensor 'arm_ft': no expected wrench on 'base': no stream holds elbow" in notes or "no stream holds" in notes
    assert "no offset is removed from the prior reading" in notes


def test_ignored_intervals_alone_have_no_support(intact: Path) -> None:
    """Where nobody says what the robot stands on, its root is upright and there is nothing expected."""
    experiment = load_experiment(intact / PARQUET)
    intervals = [replace(i, use=Use.IGNORE, support=None) for i in experiment.recording.intervals]
    built = build_scene(replace(experiment, recording=experiment.recording.with_intervals(intervals)), {})
    assert "no interval states a support: the root link is drawn upright" in _notes(built)
    assert "no expected wrenches: no interval states a support" in _notes(built)
    np.testing.assert_array_equal(
        read_array(built.block, built.scene.root), np.tile([0, 0, 0, 1, 0, 0, 0], (built.scene.samples, 1))
    )


def test_a_joint_on_another_clock_is_not_shown(intact: Path) -> None:
    """What cannot be aligned is left out with the reason; the sensor is shown all the same."""
    experiment = load_experiment(intact / PARQUET)
    joints = replace(experiment.recording.stream("joints"), clock="another")
    streams = {**experiment.recording.streams, "joints": joints}
    built = build_scene(replace(experiment, recording=replace(experiment.recording, streams=streams)), {})
    assert "joints of 'joints' are not shown" in _notes(built)
    assert np.isfinite(_values(built, "prior")).all()


def test_raw_counts_without_a_matrix_are_noted(arm: Path) -> None:
    """Without prior and calibration there is no measured wrench, and the page says what to give."""
    built = _view(edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', ""))
    assert [series.name for series in built.scene.sensors[0].wrenches] == ["expected"]
    assert "raw counts become wrenches by a calibration or a prior matrix" in _notes(built)


def test_a_stream_without_samples_is_refused(intact: Path) -> None:
    """There is nothing to show."""
    empty = _cut(load_experiment(intact / PARQUET), "arm_ft", lambda seconds: seconds < 0.0)
    with pytest.raises(RecordingError, match="stream 'arm_ft': expected samples to show, got none"):
        build_scene(empty, {})
