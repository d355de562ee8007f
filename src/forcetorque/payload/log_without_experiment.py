# SPDX-License-Identifier: BSD-3-Clause
"""The experiment of a log alone: of an arm whose format fixes frame, units and sign of its wrench, or a bag with tf."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.errors import ExperimentError, MissingFileError
from forcetorque.base.rows_on_disk import row_blocks
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_tables
from forcetorque.experiment.named_files import InMemory, sha256_of
from forcetorque.formats.arm_log import BAG, LoggedTorques, LoggedWrist
from forcetorque.formats.log_format import ArmLoggingFormat, LogDescription, LogFormat
from forcetorque.formats.registry import format_name, log_formats, not_recognised, recognised_format
from forcetorque.inspection.draft.logged_robot import wrist_interval_lines, wrist_load_lines
from forcetorque.inspection.draft.recording_table import draft_of_description, recording_lines
from forcetorque.inspection.draft.toml_lines import line, toml_value
from forcetorque.payload.load_by_joint_torques import TorqueLoad, load_of_torques, postures_words
from forcetorque.payload.result import ArmLog, gravity_words
from forcetorque.results.number_text import amount

SERIAL = "not stated"
"""Serial number of a sensor that is part of the arm, in an experiment file of its log."""
_MOST_MOVING = 0.95
"""Share of a log in which an arm moves, from which on too little is left to weigh at rest (heuristic)."""


def is_experiment_file(path: Path) -> bool:
    """Check whether a file is an experiment file and no log.

    Returns:
        Whether its name ends in .toml, or there is no log there.
    """
    return path.suffix.lower() == ".toml" or not path.exists() or recognised_format(path) is None


def refuse_a_log_twice(logs: Sequence[Path]) -> None:
    """Refuse a copy of a log, whose samples would count twice.

    Args:
        logs: Files or folders of logs.

    Raises:
        ExperimentError: If two have the same content.
    """
    seen: dict[tuple[tuple[str, int, str], ...], Path] = {}
    sizes = [_file_sizes(log) for log in logs]
    for log, own in zip(logs, sizes, strict=True):
        if sizes.count(own) == 1:  # another size is another content, for which nothing need be read
            continue
        content = tuple((name, size, sha256_of(log / name)) for name, size in own)
        if content in seen:
            raise ExperimentError(
                f"{log}: expected every log once, got the content of {seen[content]} again; its samples would count "
                "twice; name one of the two"
            )
        seen[content] = log


def _file_sizes(log: Path) -> tuple[tuple[str, int], ...]:
    """Names and sizes of the files of a log; the name of a log that is a file is no part of it."""
    if not log.is_dir():
        return (("", log.stat().st_size),)
    files = sorted(path for path in log.rglob("*") if path.is_file())
    return tuple((str(path.relative_to(log)), path.stat().st_size) for path in files)


def described_log(path: Path, specified: Mapping[str, object]) -> LogDescription:
    """Read a log of an arm, with what is known beside it.

    Args:
        path: The log.
        specified: Values of keys of the `[recording]` table that neither log nor format determines; of a bag those of
            `WristTable`.

    Returns:
        The log with a wrench or, where it has none, with joint torques.

    Raises:
        MissingFileError: If there is no such log.
        FormatError: If it is damaged, or contradicts itself.
        ExperimentError: If its format does not fix frame and sign of a wrench, or a key is undetermined.
    """
    if not path.exists():
        raise MissingFileError(f"{path}: expected an experiment file or a log, there is none")
    known = _format_of(path)
    if not isinstance(known, ArmLoggingFormat):
        names = " or ".join(format_name(one) for one in log_formats() if isinstance(one, ArmLoggingFormat))
        raise ExperimentError(
            f"{path}: expected an experiment file, or a log whose format fixes frame and sign of a wrench ({names}), "
            f"got a log of the format {format_name(known)}; `forcetorque init {path}` begins an experiment file"
        )
    description = known.describe_specified(path, specified)
    undetermined = description.undetermined or (description.torques.undetermined if description.torques else {})
    if undetermined:
        wanted = "; ".join(f"{key}, {words}" for key, words in undetermined.items())
        example = next(iter(undetermined))
        if description.wrist is None and description.torques is not None:
            wanted += f"; {postures_words(description.torques)}"
        raise ExperimentError(
            f"{path}: expected what neither log nor format says: {wanted}; give each by --recording {example}=..."
        )
    if description.wrist is None and description.torques is None:
        raise ExperimentError(f"{path}: expected the wrench at the wrist of an arm, got {description.wrist_lacks}")
    return description


def _format_of(path: Path) -> LogFormat[Any]:
    known = recognised_format(path)
    if known is None:
        raise not_recognised(path)
    return known


def experiment_of_description(
    path: Path, description: LogDescription, specified: Mapping[str, object], folder: Path
) -> tuple[Experiment, str, ArmLog]:
    """Make the experiment of a log that was read.

    Args:
        path: The log.
        description: What `described_log` gives of it.
        specified: As of `described_log`.
        folder: Folder of the experiment file, from which its paths count.

    Returns:
        The experiment, with one sensor; its file, as TOML; what the log is of, and what was assumed.

    Raises:
        ExperimentError: If the log has no wrench.
    """
    wrist = description.wrist
    if wrist is None:
        raise ExperimentError(f"{path}: expected the wrench at the wrist of an arm, got {description.wrist_lacks}")
    content = "\n".join(_lines(path, description, wrist, folder)) + "\n"
    experiment = load_tables(tomllib.loads(content), InMemory(), folder=folder)
    arm = ArmLog(
        controller=wrist.controller,
        specified=_entries(specified),
        assumed=tuple(_assumed(path, wrist, experiment)),
        contradictions=wrist.contradictions,
    )
    return experiment, content, arm


def load_of_torque_logs(logs: Mapping[Path, LoggedTorques], specified: Mapping[str, object]) -> TorqueLoad:
    """Estimate the load that an arm holds by its joint torques.

    Args:
        logs: Logs without a wrench, of one arm with one load in one power cycle.
        specified: As of `described_log`.

    Returns:
        The load.
    """
    arms = []
    for torques in logs.values():
        masses = dict.fromkeys(mass for mass in torques.declared_mass.tolist() if mass > 0.0)
        declared = ", ".join(amount(mass, "kg") for mass in masses)
        words = (f"the declared payload of {declared} is part of the load",) if masses else ()
        assumed = (*torques.assumed, *words)
        arm = ArmLog(controller=torques.controller, specified=_entries(specified), assumed=assumed, contradictions=())
        arms.append(arm)
    return load_of_torques(tuple(logs.values()), arms, ", ".join(map(str, logs)))


def _entries(specified: Mapping[str, object]) -> tuple[str, ...]:
    return tuple(f"{key}={toml_value(value)}" for key, value in specified.items())


def _lines(path: Path, description: LogDescription, wrist: LoggedWrist, folder: Path) -> Sequence[str]:
    return [
        line("schema", "forcetorque/experiment/1"),
        line("name", path.stem),
        "",
        *recording_lines(draft_of_description(description), folder, None, {}),
        "",
        "[[sensor]]",
        line("name", wrist.sensor),
        line("stream", wrist.stream),
        line("serial", SERIAL, "of a sensor that a calibration is made of, its serial number"),
        line("prior", "identity"),
        "# full_scale = [fx, fy, fz, tx, ty, tz]  # range of the sensor, N and N m, which `calibrate` needs",
        *_load_lines(wrist),
        *wrist_interval_lines(wrist),
    ]


def _load_lines(wrist: LoggedWrist) -> Sequence[str]:
    if wrist.controller != BAG:
        return wrist_load_lines(wrist)
    return [
        "",
        "[load]",
        line("frame", wrist.frame),
        line("motion", [wrist.stream]),
        line("measure_direction", wrist.measure_direction.value),
    ]


def _assumed(path: Path, wrist: LoggedWrist, experiment: Experiment) -> Sequence[str]:
    gravity = experiment.recording.stream(wrist.stream).signal("gravity").values
    # readings before the first pose have none
    known = next(row for (rows,) in row_blocks(gravity) for row in rows[np.isfinite(rows).all(axis=1)][:1])
    size = float((known**2).sum() ** 0.5)
    masses = list(dict.fromkeys(declared.mass for declared in wrist.declared if declared.mass > 0.0))
    declared_masses = ", ".join(amount(mass, "kg") for mass in masses)
    words = [*wrist.assumed, gravity_words(size)]
    if masses:
        words.append(f"the declared payload of {declared_masses} is part of the load")
    start, end = wrist.declared[0].start_ns, wrist.declared[-1].end_ns
    moving = sum(last - first for first, last in wrist.moving)
    if moving > _MOST_MOVING * (end - start):
        raise ExperimentError(
            f"{path}: expected an arm at rest in several postures, got one that moves in "
            f"{100 * moving / (end - start):.0f} % of the log; hold it still in at least four postures, half a second "
            "each"
        )
    if moving:
        words.append(f"{1e-9 * moving:.1f} of {1e-9 * (end - start):.1f} s in motion are left out")
    return words
