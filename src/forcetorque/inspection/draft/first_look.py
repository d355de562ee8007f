# SPDX-License-Identifier: BSD-3-Clause
"""A first reading of a log by its drafted `[recording]`, also with likely values in place of questions."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from pathlib import Path

from pydantic import ValidationError

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.toml_file import expected_text, unanswered_keys
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.registry import format_named
from forcetorque.inspection.draft.recording_table import draft_log, recording_lines
from forcetorque.inspection.draft.sensors_and_supports import DraftedSensor, draft_sensors
from forcetorque.inspection.draft.toml_lines import Question, likeliest_text
from forcetorque.recording.recording import Recording
from forcetorque.robot.model import RobotModel


def read_drafted(
    text: str, folder: Path, sensors: Sequence[DraftedSensor], model: RobotModel | None
) -> tuple[Recording | None, str]:
    """Read a log by its drafted table.

    Args:
        text: The `[recording]` table.
        folder: Folder of the experiment file, from which paths count.
        sensors: Sensors of the log.
        model: The robot; None for a wrist sensor without one.

    Returns:
        The recording, where the table has no question; else None, and the reason why it cannot be read.
    """
    if unanswered_keys(text):
        return None, "the log is read once the questions of [recording] are answered"
    try:
        content = tomllib.loads(text)["recording"]
        known = format_named(content["format"])
        context = ExperimentContext(
            experiment=folder / "experiment.toml",
            inputs=Inputs(folder),
            sensors={sensor.stream: sensor.name for sensor in sensors},
            joint_units={} if model is None else {name: joint.type.unit for name, joint in model.joints.items()},
        )
        reading = known.read(known.table.model_validate(content), context)
    except ValidationError as error:
        return None, f"the log cannot be read yet: {expected_text(error.errors()[0])}"
    except ForceTorqueError as error:
        return None, f"the log cannot be read yet: {error}"
    return Recording(streams={stream.name: stream for stream in reading.streams}, findings=reading.findings), ""


MOST_ROWS = 3_600_000
"""Rows of a table of a sensor by itself that is read at once: an hour of 1 kHz takes a gigabyte."""


def first_look_at_sensor(path: Path, log_format: str | None) -> tuple[Recording, tuple[str, ...]] | None:
    """Read a table of one sensor and hardly anything else.

    Args:
        path: The file.
        log_format: Name of the format; it is recognised by what is there if None.

    Returns:
        The recording, and likely values that the file does not state, as lines of an experiment file; None for any
        other table, one of more rows than are read at once, or where no value is likely.
    """
    log = draft_log([path], None, log_format)
    if not all(stream.is_sensor_alone for stream in log.streams):
        return None
    if any(column.rows > MOST_ROWS for stream in log.streams if stream.table for column in stream.table.columns):
        return None
    sensors = draft_sensors(log.streams, None)[:1]
    lines = recording_lines(log, Path(), None, {sensor.stream: sensor.name for sensor in sensors})
    recording, _ = read_drafted(likeliest_text(lines), Path(), sensors, None)
    assumed = tuple(text.likeliest for text in lines if isinstance(text, Question) and text.likeliest is not None)
    return None if recording is None else (recording, assumed)
