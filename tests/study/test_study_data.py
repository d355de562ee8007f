# SPDX-License-Identifier: BSD-3-Clause
"""The data of a study: pooled over files, named apart, and refused where they are not of one sensor."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError, MissingFileError
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.recording.recording import Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.study.study_data import StudyData, read_study_data
from tests.scenes.experiments import PARQUET, TWO, add, edit
from tests.scenes.studies import CALIBRATION, FILES, SENSOR, SERIAL, VALIDATION, scenario

NANOSECOND = 1e-9 * 1.01
"""s; rounding of seconds."""

VARIABLE = '[[sensor.variable]]\nname = "temperature"\n'
SENSOR_SERIAL = f'serial = "{SERIAL}"'
PRIOR = f'prior = "matrix_{SERIAL}.txt"'


def _read(folder: Path, files: tuple[str, ...] = FILES, sensors: list[str] | None = None) -> StudyData:
    (data,) = read_study_data([folder / file for file in files], sensors)
    return data


def test_the_samples_are_those_of_the_files_in_their_order(recorded: Path) -> None:
    """Readings, references and temperatures of every interval, with its kind and session, and where it starts."""
    data = _read(recorded)
    intervals = (*data.calibration, *data.validation)
    assert [interval.label for interval in data.calibration] == ["grid_cold", "grid_warm", "move_cold", "move_warm"]
    assert [interval.kind for interval in data.calibration] == ["grid", "grid", "random", "random"]
    assert {interval.session for interval in data.calibration} == {"power-up 0"}
    assert [(i.label, i.session) for i in data.validation] == [("day_1", "power-up 1"), ("day_2", "power-up 2")]
    assert len(intervals) == len(FILES)
    for file, interval in zip(FILES, intervals, strict=True):
        experiment = load_experiment(recorded / file)
        use = Use.CALIBRATION if file in CALIBRATION else Use.VALIDATION
        (part,) = SensorRun(experiment, experiment.sensors[0]).samples(
            use, variables=[v.linear.name for v in experiment.sensors[0].variables]
        )
        fitted, judged = interval.data_set, interval.validation_set
        for arrays in (fitted, judged):
            assert arrays.label == file.removesuffix(".toml")
            assert np.array_equal(arrays.raw, part.raw)
            assert np.array_equal(arrays.reference, part.samples.reference)
            assert np.array_equal(arrays.variables, part.samples.variables)
        since = (part.samples.stamp_ns - experiment.recording.start_ns) * 1e-9
        assert np.abs(judged.time_s - since).max() < NANOSECOND
        assert judged.session == interval.session
        assert part.samples.variables.shape == (len(part.samples), 1)


def test_what_was_read_is_recorded(recorded: Path) -> None:
    """Sensor, experiments, and the hash of every input of every file under a path that can be opened."""
    data = _read(recorded)
    assert (data.sensor.name, data.identity.serial, data.identity.robot) == (SENSOR, SERIAL, "arm")
    assert data.experiments == tuple(f"arm {file.removesuffix('.toml')}" for file in FILES)
    assert data.sphere is None
    expected = {}
    for file in FILES:
        for name, digest in load_experiment(recorded / file).inputs_sha256.items():
            expected[(recorded / name).as_posix()] = digest
    assert data.inputs_sha256 == expected
    assert {Path(path).name for path in expected} >= {*FILES, "robot.urdf", f"matrix_{SERIAL}.txt"}
    assert all(Path(path).is_file() for path in expected)


def test_labels_that_repeat_get_the_name_of_their_file(days: Path) -> None:
    """The others stay as they are; the sphere of a file is that of its own interval."""
    edit(days / "move_warm.toml", 'label = "move_warm"', 'label = "move_cold"')
    edit(days / "grid_warm.toml", 'label = "grid_warm"', 'label = "grid_cold"')
    add(days / "grid_warm.toml", '[calibration]\nsphere_intervals = ["grid_cold"]\n')
    add(days / "move_cold.toml", '[calibration]\nsphere_intervals = ["move_cold"]\n')
    data = _read(days)
    assert [interval.label for interval in (*data.calibration, *data.validation)] == [
        "grid_cold/grid_cold", "grid_warm/grid_cold", "move_cold/move_cold", "move_warm/move_cold", "day_1", "day_2",
    ]  # fmt: skip
    assert data.sphere == ("grid_warm/grid_cold", "move_cold/move_cold")


def test_files_of_one_name_in_different_folders_are_told_apart(days: Path, tmp_path: Path) -> None:
    """As much of the path stands before the label as it takes; no samples of one hide those of the other."""
    other = Path(shutil.copytree(days, tmp_path / "again"))
    # another recording under the same name and label
    shutil.rmtree(other / "move_cold")
    shutil.copytree(days / "move_warm", other / "move_cold")
    (data,) = read_study_data([days / "move_cold.toml", other / "move_cold.toml", days / "day_1.toml"], None)
    assert [interval.label for interval in data.calibration] == [
        "days/move_cold/move_cold",
        "again/move_cold/move_cold",
    ]
    cold, warm = (interval.data_set.variables.mean() for interval in data.calibration)
    assert warm - cold > 5.0
    assert [interval.label for interval in data.validation] == ["day_1"]


def test_a_file_that_comes_twice_is_refused(recorded: Path) -> None:
    """Also by another way to it: its samples would count twice."""
    with pytest.raises(ExperimentError, match=r"grid_cold\.toml: expected every experiment file once, it comes twice"):
        _read(recorded, ("grid_cold.toml", "day_1.toml", "grid_cold.toml"))
    with pytest.raises(ExperimentError, match="it comes twice"):
        _read(recorded, ("grid_cold.toml", f"../{recorded.name}/grid_cold.toml"))


def test_a_sensor_that_is_asked_for_twice_is_read_once(recorded: Path) -> None:
    """Its samples do not count twice either."""
    once, twice = _read(recorded), _read(recorded, sensors=[SENSOR, SENSOR])
    assert [i.label for i in twice.calibration] == [i.label for i in once.calibration]


def test_the_first_file_says_which_sensors_unless_they_are_named(intact: Path) -> None:
    """Two sensors of one file are two studies; a file without one that is wanted is refused and named."""
    both = read_study_data([intact / TWO], None)
    assert [data.sensor.name for data in both] == ["arm_ft", "tool_ft"]
    assert [i.label for data in both for i in (*data.calibration, *data.validation)] == ["fit", "judge"] * 2
    (tool,) = read_study_data([intact / TWO], ["tool_ft"])
    assert tool.identity.serial == "SIM/002"
    with pytest.raises(
        ExperimentError, match=r"two\.toml: experiment 'small arm' has no sensor 'tol_ft'.*arm_ft, tool"
    ):
        read_study_data([intact / TWO], ["tol_ft"])
    with pytest.raises(ExperimentError, match=r"parquet\.toml: experiment 'small arm' has no sensor 'tool_ft'"):
        read_study_data([intact / TWO, intact / PARQUET], None)
    with pytest.raises(MissingFileError, match="absent"):
        read_study_data([intact / TWO, intact / "absent.toml"], None)


def _another_serial(file: Path) -> None:
    edit(file, SENSOR_SERIAL, 'serial = "SIM002"')


def _another_prior(file: Path) -> None:
    specimen = scenario().specimens[SENSOR]
    write_matrix_file(file.parent / "other.txt", encode_matrix(specimen.workbench * 1.01))
    edit(file, PRIOR, 'prior = "other.txt"')


def _no_prior(file: Path) -> None:
    edit(file, f"{PRIOR}\n", "")


def _no_variable(file: Path) -> None:
    edit(file, VARIABLE, "")


def _another_reference_value(file: Path) -> None:
    edit(file, VARIABLE, f"{VARIABLE}reference_value = 25.0\n")


def _prior_coefficients(file: Path) -> None:
    edit(file, VARIABLE, f"{VARIABLE}prior_coefficients = [0.0, 0.0, 0.1, 0.0, 0.0, 0.0]\n")


def _another_frame(file: Path) -> None:
    shutil.copyfile(file.parent / "robot.urdf", file.parent / "turned.urdf")
    edit(file.parent / "turned.urdf", "child_to_parent", "parent_to_child")
    edit(file, "robot.urdf", "turned.urdf")


def _another_gain(file: Path) -> None:
    edit(file, SENSOR_SERIAL, f"{SENSOR_SERIAL}\namplifier_gain = [24.0, 24.0, 24.0, 24.0, 24.0, 24.0]")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (_another_serial, "serial number of .*, SIM001, got SIM002; files are pooled for one sensor"),
        (_another_prior, "prior matrix of .*, got another; all data are fitted with one"),
        (_no_prior, "prior matrix of .*, got another"),
        (_no_variable, r"variables of .*temperature.* got \[\]"),
        (_another_reference_value, "variables of .*None, None.* got .*25.0, None"),
        (_prior_coefficients, r"variables of .*None, None.* got .*\[0.0, 0.0, 0.1, 0.0, 0.0, 0.0\]"),
        (_another_frame, "mounting .*child_to_parent.* got .*parent_to_child"),
        (_another_gain, "amplifier gain of .*, None, got .*24.0"),
    ],
)
def test_data_of_another_sensor_are_refused(days: Path, change: Callable[[Path], None], message: str) -> None:
    """Or of one that was mounted, read or described in another way; the message names both files."""
    change(days / "move_warm.toml")
    with pytest.raises(ExperimentError, match=message) as refused:
        _read(days, ("grid_cold.toml", "move_warm.toml"))
    text = str(refused.value)
    assert text.startswith(f"{days / 'move_warm.toml'}: sensor 'arm_ft': expected the ")
    assert str(days / "grid_cold.toml") in text


def test_samples_that_are_fitted_and_judged_are_refused(days: Path) -> None:
    """Another file may use the same recording, but not the same samples for both."""
    text = (days / "move_cold.toml").read_text(encoding="utf-8")
    again = text.replace('use = "calibration"', 'use = "validation"').replace('label = "move_cold"', 'label = "again"')
    assert again.count('"validation"') == 1
    overlapping = again.replace("start_s = 0.5", "start_s = 5.0")
    (days / "again.toml").write_text(overlapping, encoding="utf-8")
    first = edit(days / "move_cold.toml", "end_s = 7.5", "end_s = 5.1")
    message = (
        "'arm_ft': samples of the calibration interval 'move_cold' are validated in 'again' too; validate on data that"
    )
    with pytest.raises(ExperimentError, match=message):
        _read(days, (*CALIBRATION, "again.toml"))
    edit(first, "end_s = 5.1", "end_s = 5.0")  # the end itself is not in the interval
    data = _read(days, (*CALIBRATION, "again.toml"))
    assert [interval.label for interval in data.validation] == ["again"]


def test_stamps_that_coincide_are_no_overlap(days: Path) -> None:
    """Logs may count their stamps from one time: other readings are other samples, the same ones are refused."""
    recording = read_recording(days / "move_cold")
    shutil.rmtree(days / "day_1")
    shutil.copytree(days / "move_cold", days / "day_1")
    edit(days / "day_1.toml", "end_s = 8.5", "end_s = 7.5")
    with pytest.raises(ExperimentError, match="'move_cold' are validated in 'day_1' too"):
        _read(days, ("move_cold.toml", "day_1.toml"))
    stream = recording.stream(SENSOR)
    raw = stream.signal("raw")
    powered_up = replace(stream, signals={**stream.signals, "raw": replace(raw, values=raw.values + 7.0)})
    write_recording(days / "day_1", replace(recording, streams={**recording.streams, SENSOR: powered_up}))
    data = _read(days, ("move_cold.toml", "day_1.toml"))
    stamps = [interval.part.samples.stamp_ns for interval in (*data.calibration, *data.validation)]
    assert np.array_equal(*stamps)


def test_errors_say_in_which_file_they_are(days: Path) -> None:
    """A sensor without its stream in the second of many files."""
    edit(days / "grid_warm.toml", "start_s = 0.5", "start_s = 500.0")
    with pytest.raises(ForceTorqueError, match=r"grid_warm\.toml: interval\[0\]"):
        _read(days)


def test_files_may_have_data_of_one_use_only(recorded: Path) -> None:
    """Also all of them: what is missing is found where it is needed."""
    assert _read(recorded, CALIBRATION).validation == ()
    assert _read(recorded, VALIDATION).calibration == ()


def test_progress_names_every_file(recorded: Path) -> None:
    """People see which file is read."""
    said: list[str] = []
    read_study_data([recorded / file for file in VALIDATION], None, progress=said.append)
    assert said == [f"reading {recorded / file}" for file in VALIDATION]
