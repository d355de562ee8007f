# SPDX-License-Identifier: BSD-3-Clause
"""Experiment files that contradict themselves, the robot or the recording are refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import (
    ExperimentError,
    ForceTorqueError,
    FormatError,
    MissingFileError,
    RecordingError,
    RobotError,
)
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.recording.stream import Signal, Stream
from tests.scenes.experiments import PARQUET, SECOND_SENSOR, TWO, YARP, add, edit

Damage = Callable[[Path], object]


def _in(form: str, old: str, new: str) -> tuple[str, Damage]:
    return form, lambda arm: edit(arm / form, old, new)


def _after(form: str, text: str) -> tuple[str, Damage]:
    return form, lambda arm: add(arm / form, text)


TAGGED = '\njoint = "arm_ft_joint"\nmeasure_direction = "child_to_parent"'
CONTRADICTIONS: dict[str, tuple[tuple[str, Damage], type[ForceTorqueError], str]] = {
    "sensor not in the robot": (
        _in(PARQUET, 'name = "arm_ft"', 'name = "arm_tf"'),
        RobotError,
        r"sensor\[0\]: robot 'arm' has no force-torque sensor 'arm_tf'; did you mean \"arm_ft\"",
    ),
    "tag and joint": (
        _in(PARQUET, 'serial = "SIM001"', f'serial = "SIM001"{TAGGED}'),
        RobotError,
        r"sensor\[0\]: sensor 'arm_ft' at 'arm_ft_joint': the robot has the sensor 'arm_ft' already",
    ),
    "joint that moves": (
        _in(TWO, '"tool_joint"', '"elbow"'),
        RobotError,
        r"sensor\[1\]: sensor 'tool_ft': expected a fixed joint, 'elbow' is revolute",
    ),
    "unknown joint": (
        _in(TWO, '"tool_joint"', '"tool_jiont"'),
        RobotError,
        r"sensor\[1\]: robot 'arm' has no joint 'tool_jiont'; did you mean \"tool_joint\"",
    ),
    "frame of a tag": (
        _in(TWO, '"tool_joint"', '"tool_joint"\nframe = "sensor"'),
        RobotError,
        r"sensor\[1\]: sensor 'tool_ft': without a tag there is no origin; the frame must be child or parent",
    ),
    "sensor twice": (
        _after(PARQUET, '[[sensor]]\nname = "arm_ft"\nstream = "tool_ft"\nserial = "2"\n'),
        ExperimentError,
        r"sensor\[1\]: 'arm_ft' is listed twice; keep one",
    ),
    "stream of another sensor": (
        _after(PARQUET, SECOND_SENSOR.replace('stream = "tool_ft"', 'stream = "arm_ft"')),
        ExperimentError,
        r"sensor\[1\]: 'tool_ft' reads the stream 'arm_ft', as does 'arm_ft'; every sensor has its own",
    ),
    "unknown stream": (
        _in(PARQUET, 'stream = "arm_ft"', 'stream = "arm"'),
        RecordingError,
        r"sensor\[0\]: the recording has no stream 'arm'; did you mean \"arm_ft\"\? known: arm_ft, joints, tool_ft",
    ),
    "stream of joints": (
        _in(PARQUET, 'stream = "arm_ft"', 'stream = "joints"'),
        ExperimentError,
        r"sensor\[0\]: expected a stream with raw or wrench, 'joints' holds position",
    ),
    "wrenches without prior": (
        _in(YARP, 'prior = "matrix_SIM001.txt"\n', ""),
        ExperimentError,
        r"sensor\[0\]: expected prior, the matrix file that 'arm_ft' was calibrated with; raw counts cannot",
    ),
    "stream name twice": (
        _in(YARP, 'name = "joints"', 'name = "arm_ft"'),
        ExperimentError,
        r"recording: two streams are named 'arm_ft'",
    ),
    "stream that nobody reads": (
        _in(YARP, 'name = "arm_ft"\nport', 'name = "leg_ft"\nport'),
        ExperimentError,
        r"recording\.stream\[0\]: no \[\[sensor\]\] reads the stream 'leg_ft'; add one or leave it out",
    ),
    "joint twice": (
        _in(YARP, '"elbow", "wrist"', '"elbow", "elbow"'),
        RecordingError,
        r"recording\.stream\[1\]: position: expected at least one column and each name once",
    ),
    "another number of joints": (
        _in(YARP, '"elbow", "wrist"', '"elbow"'),
        FormatError,
        r"recording\.stream\[1\]: .*data\.log:1: expected 4 numbers of position because so many joints were named",
    ),
    "unknown support": (
        _in(PARQUET, 'frame = "base"', 'frame = "bse"'),
        ExperimentError,
        r"support\[0\]: robot 'arm' has no link 'bse'; did you mean \"base\"",
    ),
    "support twice": (
        _after(PARQUET, '[[support]]\nframe = "base"\ngravity_direction = [0.0, 0.0, 1.0]\n'),
        ExperimentError,
        r"support\[1\]: the frame 'base' is listed twice; keep one",
    ),
    "no direction": (_in(PARQUET, "-1.0]", "0.0]"), RecordingError, r"support\[0\]: .* other than zero, got \[0\.0"),
    "interval without its support": (
        _after(PARQUET, '[[interval]]\nlabel = "x"\nstart_s = 14\nend_s = 14.5\nuse = "ignore"\nsupport = "hand"\n'),
        ExperimentError,
        r"interval\[2\] 'x': no \[\[support\]\] has the frame 'hand'; known: base",
    ),
    "interval without support": (
        _after(PARQUET, '[[interval]]\nlabel = "x"\nstart_s = 14\nend_s = 14.5\nuse = "validation"\n'),
        RecordingError,
        r"interval\[2\]: interval 'x': its use is validation, which needs a support frame",
    ),
    "fitted and judged": (
        _in(PARQUET, "start_s = 14.5", "start_s = 13.999"),
        ExperimentError,
        r"the intervals 'fit' \(calibration\) and 'judge' \(validation\) overlap; a sample is fitted or judged once",
    ),
    "after the log": (_in(PARQUET, "end_s = 23.5", "end_s = 24.5"), ExperimentError, r"\[1\] 'judge': expected a span"),
    "far after the log": (_in(PARQUET, "end_s = 23.5", "end_s = 1e300"), ExperimentError, r"got 14\.5 to 1e\+300 s"),
    "start far after the log": (_in(PARQUET, "start_s = 14.5", "start_s = 1e300"), ExperimentError, "got 1e.300 to 23"),
    "before the log": (
        _in(PARQUET, "start_s = 0.5", "start_s = -0.5"),
        ExperimentError,
        r"\[0\] 'fit': expected a span",
    ),
    "empty interval": (
        _in(PARQUET, "start_s = 0.5", "start_s = 14"),
        RecordingError,
        r"\[0\]: interval 'fit': expected",
    ),
    "label twice": (
        _in(PARQUET, '"judge"', '"fit"'),
        RecordingError,
        "2 intervals are labelled 'fit'; give each its own",
    ),
    "prior of another sensor": (
        _in(PARQUET, "matrix_SIM001.txt", "other/matrix_SN026.txt"),
        ExperimentError,
        r"sensor\[0\]: expected the prior matrix of the sensor 'SIM001', got that of 'SN026' \(other/matrix_SN026\.txt",
    ),
    "no prior file": (
        _in(PARQUET, "matrix_SIM001", "none"),
        MissingFileError,
        r"none\.txt: expected a calibration matr",
    ),
}


@pytest.mark.parametrize("name", CONTRADICTIONS)
def test_what_contradicts_is_refused(arm: Path, name: str) -> None:
    """The error names the file, the table and what to do; nothing is guessed."""
    (form, damage), error, message = CONTRADICTIONS[name]
    load_experiment(arm / form)
    damage(arm)
    with pytest.raises(error, match=message) as caught:
        load_experiment(arm / form)
    assert str(arm) in str(caught.value)


def test_a_recording_without_samples_is_refused(arm: Path) -> None:
    """Without a stamp no second can be counted."""
    empty = Stream(
        name="arm_ft",
        clock="none",
        stamp_ns=np.empty(0, dtype=np.int64),
        signals={"raw": Signal(quantity="raw", values=np.empty((0, 1)), columns=("ch0",), units=("counts",))},
    )
    write_recording(arm / "recording", Recording(streams={"arm_ft": empty}))
    with pytest.raises(RecordingError, match=r"toml: recording: the recording holds no sample in any stream"):
        load_experiment(arm / PARQUET)
