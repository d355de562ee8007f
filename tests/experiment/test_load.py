# SPDX-License-Identifier: BSD-3-Clause
"""From the experiment file to robot, recording, intervals and sensors."""

from __future__ import annotations

import hashlib
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.loading import load_experiment
from forcetorque.formats.icub_matrix import read_matrix_file, write_matrix_file
from forcetorque.recording.recording import Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.robot.model import SensorFrame
from tests.scenes.experiments import ARM_LOG, FT_LOG, JOINTS, PARQUET, TWO, YARP, add, edit, edit_line


@pytest.mark.parametrize("form", [PARQUET, YARP])
def test_a_complete_experiment_is_loaded(arm: Path, form: str) -> None:
    """Robot, sensor, prior, intervals and filters are those of the file."""
    experiment = load_experiment(arm / form)
    (sensor,) = experiment.sensors
    assert (experiment.name, experiment.model.name) == ("small arm", "arm")
    assert (sensor.name, sensor.serial, sensor.stream) == ("arm_ft", "SIM001", "arm_ft")
    assert sensor.quantity == ("raw" if form == PARQUET else "wrench")
    assert sensor.prior is not None
    assert np.array_equal(sensor.prior, read_matrix_file(arm / "matrix_SIM001.txt").matrix)
    assert sensor.prior_source == "matrix_SIM001.txt"
    assert experiment.fit_options.regularisation is None
    assert experiment.processing.gravity == 9.80665
    assert [interval.label for interval in experiment.intervals(Use.CALIBRATION)] == ["fit"]


@pytest.mark.parametrize("form", [PARQUET, YARP])
def test_seconds_count_from_the_earliest_stamp(arm: Path, form: str) -> None:
    """Second 0 is the first sample of whichever stream began first."""
    experiment = load_experiment(arm / form)
    earliest = min(int(stream.stamp_ns[0]) for stream in experiment.recording.streams.values())
    (fit,), (judge,) = experiment.intervals(Use.CALIBRATION), experiment.intervals(Use.VALIDATION)
    assert (fit.start_ns - earliest, fit.end_ns - earliest) == (500_000_000, 14_000_000_000)
    assert (judge.start_ns - earliest, judge.end_ns - earliest) == (14_500_000_000, 23_500_000_000)


def test_both_forms_hold_the_same_recording(arm: Path) -> None:
    """Stamps agree to the nanosecond and joints to the digits of the log, degrees turned into radians."""
    own, yarp = (load_experiment(arm / form).recording for form in (PARQUET, YARP))
    assert np.array_equal(own.stream("joints").stamp_ns, yarp.stream("joints").stamp_ns)
    assert np.array_equal(own.stream("arm_ft").stamp_ns, yarp.stream("arm_ft").stamp_ns)
    ours, theirs = (r.stream("joints").signal("position").values for r in (own, yarp))
    assert np.abs(ours - theirs).max() < 1e-11  # twelve digits of up to 126 degrees
    assert yarp.stream("joints").signal("position").columns == JOINTS


def test_settings_of_the_file_arrive(arm: Path) -> None:
    """Gravity, filters and lambda are not silently those of the library."""
    edit(arm / PARQUET, "[robot]", "[robot]\ngravity = 9.81")
    add(arm / PARQUET, "\n[processing]\nderivatives = { window_s = 0.4, order = 4 }\n")
    add(arm / PARQUET, "smoothing = { window_s = 0.5, order = 2 }\n[calibration]\nlambda_counts2 = 7\n")
    experiment = load_experiment(arm / PARQUET)
    processing = experiment.processing
    assert (processing.gravity, experiment.fit_options.regularisation, processing.logged_derivatives) == (
        9.81,
        7.0,
        False,
    )
    assert (processing.derivative_window.window_s, processing.derivative_window.order) == (0.4, 4)
    assert processing.smoothing is not None
    assert (processing.smoothing.window_s, processing.smoothing.order) == (0.5, 2)


def test_paths_are_relative_to_the_file(arm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The working folder does not matter, a path may lead upwards, and may be absolute."""
    folder = arm / "files"
    folder.mkdir()
    shutil.move(arm / PARQUET, folder / PARQUET)
    edit(folder / PARQUET, 'urdf = "arm.urdf"', 'urdf = "../arm.urdf"')
    edit(folder / PARQUET, 'path = "recording"', 'path = "../recording"')
    edit(folder / PARQUET, "matrix_SIM001.txt", str(arm / "matrix_SIM001.txt"))
    expected = load_experiment(folder / PARQUET).inputs_sha256
    assert "../recording/recording.json" in expected
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    assert load_experiment(folder / PARQUET).inputs_sha256 == expected
    monkeypatch.chdir(folder)
    assert load_experiment(PARQUET).inputs_sha256 == expected


@pytest.mark.parametrize(
    ("form", "inputs"),
    [
        (PARQUET, ["recording/arm_ft.parquet", "recording/joints.parquet", "recording/tool_ft.parquet"]),
        (YARP, [ARM_LOG, FT_LOG, ARM_LOG.replace("data", "info"), FT_LOG.replace("data", "info")]),
    ],
)
def test_every_input_is_hashed(arm: Path, form: str, inputs: list[str]) -> None:
    """Each file that was read is there under the name that the experiment has for it, and no other."""
    expected = [
        form,
        "arm.urdf",
        "matrix_SIM001.txt",
        *inputs,
        *(["recording/recording.json"] if form == PARQUET else []),
    ]
    hashes = load_experiment(arm / form).inputs_sha256
    assert sorted(hashes) == sorted(expected)
    for name in expected:
        assert hashes[name] == hashlib.sha256((arm / name).read_bytes()).hexdigest()
    add(arm / "arm.urdf", "\n")
    changed = load_experiment(arm / form).inputs_sha256
    assert {name for name in hashes if hashes[name] != changed[name]} == {"arm.urdf"}


def test_a_sensor_without_a_tag_is_declared_by_its_joint(arm: Path) -> None:
    """Name, direction and frame are those of the file; the child's frame unless it says otherwise."""
    experiment = load_experiment(arm / TWO)
    assert [sensor.name for sensor in experiment.sensors] == ["arm_ft", "tool_ft"]
    declared = experiment.model.sensor("tool_ft")
    assert (declared.joint, declared.frame) == ("tool_joint", SensorFrame.CHILD)
    assert declared.direction is MeasureDirection.PARENT_TO_CHILD
    add(arm / TWO, 'frame = "parent"\n')
    assert load_experiment(arm / TWO).model.sensor("tool_ft").frame is SensorFrame.PARENT


def test_a_prior_named_after_its_own_sensor_is_taken(arm: Path) -> None:
    """The factory's name for the file holds the serial number; it is a reason to refuse only where it is another's."""
    shutil.copyfile(arm / "matrix_SIM001.txt", arm / "matrix_SN026.txt")
    edit(arm / PARQUET, '"matrix_SIM001.txt"', '"matrix_SN026.txt"')
    (sensor,) = load_experiment(edit(arm / PARQUET, '"SIM001"', '"SN026"')).sensors
    assert (sensor.serial, sensor.prior_source) == ("SN026", "matrix_SN026.txt")


def test_the_matrix_of_another_board_is_refused(arm: Path) -> None:
    """A log in steps of full scales shows by which matrix it was sent; one without steps shows none."""
    file = read_matrix_file(arm / "matrix_SIM001.txt")
    load_experiment(arm / YARP)  # wrenches that were not rounded
    step = np.array(file.full_scale) / 2**15
    lines = [line.split() for line in (arm / FT_LOG).read_text().splitlines()]
    wrench = np.round(np.array([line[2:] for line in lines], dtype=float) / step) * step
    sent = [[*line[:2], *(f"{value:.6f}" for value in row)] for line, row in zip(lines, wrench, strict=True)]
    (arm / FT_LOG).write_text("\n".join(map(" ".join, sent)) + "\n")
    load_experiment(arm / YARP)
    scales = (file.full_scale[0] + 111, *file.full_scale[1:])
    write_matrix_file(arm / "matrix_SIM001.txt", replace(file, full_scale=scales))
    sizes = [", ".join(map(str, one)) for one in (file.full_scale, scales)]
    with pytest.raises(ExperimentError, match=f"steps of the full scales {sizes[0]} N, .* with {sizes[1]}; name"):
        load_experiment(arm / YARP)


def test_a_sensor_is_found_by_any_of_its_names(arm: Path) -> None:
    """The name of the simulator's tag serves in the file and when the sensor is asked for."""
    tag = (
        '<gazebo reference="arm_ft_joint"><sensor name="simulated_ft" type="force_torque"><force_torque>'
        "<frame>child</frame><measure_direction>child_to_parent</measure_direction></force_torque></sensor></gazebo>"
    )
    edit(arm / "arm.urdf", "</robot>", f"{tag}</robot>")
    edit(arm / PARQUET, 'name = "arm_ft"', 'name = "simulated_ft"')
    experiment = load_experiment(arm / PARQUET)
    assert experiment.sensor("simulated_ft") is experiment.sensor("arm_ft") is experiment.sensors[0]
    with pytest.raises(
        ExperimentError, match=r"experiment 'small arm' has no sensor 'arm_tf'; did you mean \"arm_ft\""
    ):
        experiment.sensor("arm_tf")


@pytest.mark.parametrize("cut_ns", [0, 400_000, 900_000])  # decides which way the third digit would be rounded
def test_an_interval_may_end_with_the_log(arm: Path, cut_ns: int) -> None:
    """The end that the error message offers is accepted, one millisecond more is not."""
    recording = read_recording(arm / "recording")
    start, end = recording.span_ns
    streams = {
        name: replace(stream, stamp_ns=np.minimum(stream.stamp_ns, end - cut_ns))
        for name, stream in recording.streams.items()
    }
    write_recording(arm / "recording", replace(recording, streams=streams))
    length_ms = (end - cut_ns - start) // 1_000_000
    edit(arm / PARQUET, "end_s = 23.5", f"end_s = {(length_ms + 1) / 1000}")
    with pytest.raises(ExperimentError, match=rf"expected a span inside the log, 0 to {length_ms / 1000:.3f} s, got"):
        load_experiment(arm / PARQUET)
    edit(arm / PARQUET, f"end_s = {(length_ms + 1) / 1000}", f"end_s = {length_ms / 1000:.3f}")
    assert load_experiment(arm / PARQUET).intervals(Use.VALIDATION)[0].end_ns == start + length_ms * 1_000_000


@pytest.mark.parametrize(("fit", "judge"), [((0.5, 14.0), (14.0, 23.5)), ((14.0, 23.5), (0.5, 14.0))])
def test_intervals_may_touch_and_ignored_ones_may_overlap(
    arm: Path, fit: tuple[float, float], judge: tuple[float, float]
) -> None:
    """An end is excluded, so another may begin there, before or after; an ignored interval may lie anywhere."""
    edit(arm / PARQUET, "start_s = 14.5\nend_s = 23.5", f"start_s = {judge[0]}\nend_s = {judge[1]}")
    edit(arm / PARQUET, '"fit"\nstart_s = 0.5\nend_s = 14.0', f'"fit"\nstart_s = {fit[0]}\nend_s = {fit[1]}')
    add(arm / PARQUET, '[[interval]]\nlabel = "bump"\nstart_s = 13.0\nend_s = 15.0\nuse = "ignore"\n')
    uses = [interval.use for interval in load_experiment(arm / PARQUET).recording.intervals]
    assert uses == [Use.CALIBRATION, Use.VALIDATION, Use.IGNORE]


def test_what_a_reader_finds_goes_with_the_recording(arm: Path) -> None:
    """Findings of every port are kept: here two quantities that the board does not estimate, and one failure."""
    edit_line(arm / ARM_LOG, 9, lambda line: line.replace("[ok]", "[fail]", 1))
    findings = load_experiment(arm / YARP).recording.findings
    assert [(finding.stream, finding.kind, finding.channel) for finding in findings] == [
        ("joints", "failed_group", "position"),
        ("joints", "not_estimated", "velocity"),
        ("joints", "not_estimated", "acceleration"),
    ]
