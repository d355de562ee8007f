# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file adds to its log: clocks, frames of wrenches, fixed joints; each becomes a warning."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import wraps
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.experiment import experiment_file as schema
from forcetorque.experiment.clocks import aligned_clocks
from forcetorque.experiment.experiment_file_tables import PoseTable, TransformTable
from forcetorque.experiment.named_files import stated_in
from forcetorque.recording.joint_jumps import without_joint_jumps
from forcetorque.recording.orientation import orientation_at, pose_at, wrench_in_frame
from forcetorque.recording.recording import Finding, Recording
from forcetorque.recording.stream_faults import FAILED_TEMPERATURES, glitched_values
from forcetorque.results.number_text import counted
from forcetorque.results.result import Result, UnusableSamples
from forcetorque.robot.model import RobotModel


def follow_recipes(
    parsed: schema.ExperimentFile,
    file: Path,
    logged: Recording,
    model: RobotModel | None,
    *,
    clocks_must_tell: bool = True,
) -> Recording:
    """Make of what was logged what it is taken for.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        logged: The streams as they were logged.
        model: The robot, with its joints that stand still; None for a wrist sensor.
        clocks_must_tell: Whether a delay that the recording does not determine is refused.

    Returns:
        The recording, with a finding for everything that was added.

    Raises:
        ExperimentError: If the file contradicts itself or the log.
    """
    fixed = {} if parsed.robot is None else parsed.robot.fixed
    _require_not_logged(fixed, file, logged)
    recording = aligned_clocks(parsed, file, logged, model, must_tell=clocks_must_tell)
    if "joint_jumps" not in parsed.processing.keep:
        # behind the clocks: its findings state instants
        recording = with_continuous_joints(recording, () if model is None else model.joints)
    for index, entry in enumerate(parsed.transform):
        with stated_in(f"{file}: transform[{index}]"):
            recording = _transformed(recording, entry)
    if "glitches" not in parsed.processing.keep:
        recording = _without_glitches(parsed, recording)
    findings = (*recording.findings, *_standing(fixed, parsed), *_corrected(parsed), *_kept(parsed))
    return replace(recording, findings=findings)


def _require_not_logged(fixed: Mapping[str, float], file: Path, logged: Recording) -> None:
    with stated_in(str(file)):
        holders = logged.joint_signals("position") if fixed else {}
    for joint in fixed:
        if joint in holders:
            raise ExperimentError(
                f"{file}: robot: fixed: joint {joint!r} is logged, in the stream {holders[joint][0].name!r}; leave it "
                "out of one of them"
            )


def _standing(fixed: Mapping[str, float], parsed: schema.ExperimentFile) -> Sequence[Finding]:
    if not fixed:
        return ()
    values = ", ".join(f"{joint} at {value:g}" for joint, value in fixed.items())
    text = (
        f"not logged, taken to stand still all along (rad, m): {values}; what they weigh and do elsewhere is an error"
    )
    return (Finding(stream=parsed.name, kind="fixed_joint", message=text, count=len(fixed)),)


def _corrected(parsed: schema.ExperimentFile) -> Sequence[Finding]:
    if parsed.robot is None or parsed.robot.tolerance == "exact" or parsed.robot.tolerance.found_by is None:
        return ()
    text = f"the robot model is corrected by the masses, centres and joint zeros of {parsed.robot.tolerance.found_by}"
    return (Finding(stream=parsed.name, kind="corrected_robot", message=text, count=1),)


def with_continuous_joints(recording: Recording, joints: Collection[str] | None = None) -> Recording:
    """Take lost turns, wrong rows and slips off the joints of a recording.

    Args:
        recording: What was logged.
        joints: Names of the joints of the robot; all positions if None.

    Returns:
        The recording, with the findings of `without_joint_jumps`.
    """
    repaired = {
        name: without_joint_jumps(stream, recording.start_ns, joints)
        for name, stream in recording.streams.items()
        if len(stream)
    }
    found = [finding for _, findings in repaired.values() for finding in findings]
    if not found:
        return recording
    streams = {**recording.streams, **{name: stream for name, (stream, _) in repaired.items()}}
    return replace(recording, streams=streams, findings=(*recording.findings, *found))


def _kept(parsed: schema.ExperimentFile) -> Sequence[Finding]:
    if not parsed.processing.keep:
        return ()
    kept = ", ".join(parsed.processing.keep)
    text = f"used although left out by default, as keep of [processing] states: {kept}"
    return (Finding(stream=parsed.name, kind="kept", message=text, count=len(parsed.processing.keep)),)


def _without_glitches(parsed: schema.ExperimentFile, recording: Recording) -> Recording:
    """The recording without single values of the sensors' variables that are nowhere near the others."""
    columns = {
        (variable.stream or sensor.stream, variable.quantity, variable.column)
        for sensor in parsed.sensor
        for variable in sensor.variable
    }
    for name, quantity, column in sorted(columns, key=str):
        stream = recording.streams.get(name)
        signal = None if stream is None else stream.signals.get(quantity)
        if stream is None or signal is None or column not in (None, *signal.columns):
            continue  # whoever reads the variable says so
        place = 0 if column is None else signal.columns.index(column)
        values = signal.values[:, place]
        glitched, more = glitched_values(values, FAILED_TEMPERATURES if quantity == "temperature" else ())
        about = f"{signal.columns[place]} ({signal.units[place]})"
        if more:
            message = (
                f"{about}: {more} of {len(values)} values are nowhere near the others for a moment, too many to tell "
                "which are wrong: they are used; correct the log, or leave the variable out"
            )
            finding = Finding(stream=name, kind="glitch", message=message, count=more, channel=signal.columns[place])
            recording = replace(recording, findings=(*recording.findings, finding))
        if not glitched.any():
            continue
        rows, kept = np.flatnonzero(glitched), values[np.isfinite(values) & ~glitched]
        message = (
            f"{about}: left out {counted(len(rows), 'value')} of {len(values)} "
            f"that {'is' if len(rows) == 1 else 'are'} nowhere near the others: "
            f"{', '.join(f'{value:.4g}' for value in np.unique(values[rows])[:3])}"
        ) + (f"; the others lie from {kept.min():.4g} to {kept.max():.4g}" if len(kept) else "")
        ends, channel = rows[[0, -1]].tolist(), signal.columns[place]
        finding = Finding.over(name, stream.stamp_ns, "glitch", message, *ends, count=len(rows), channel=channel)
        without = signal.values.copy()
        without[rows, place] = np.nan
        signals = {**stream.signals, quantity: replace(signal, values=without)}
        recording = replace(
            recording,
            streams={**recording.streams, name: replace(stream, signals=signals)},
            findings=(*recording.findings, finding),
        )
    return recording


def _transformed(recording: Recording, entry: TransformTable) -> Recording:
    stream = recording.stream(entry.stream)
    own = stream.signal("wrench").frame
    by = "a pose that does not change" if entry.orientation is None else f"the orientation of {entry.orientation!r}"
    moved = wrench_in_frame(stream, entry.to, _pose_of_wrench(recording, entry))
    point = {
        "sensor": f"the origin of {entry.to!r}",
        "own_frame": f"the origin of {own!r}",
        "point": f"a point that moves with {entry.to!r}",
    }[entry.moment_about]
    text = f"the wrench is logged along the axes of {own!r}, its moment about {point}: moved into {entry.to!r} by {by}"
    finding = Finding(stream=entry.stream, kind="transformed", message=text, count=len(stream))
    return replace(
        recording, streams={**recording.streams, entry.stream: moved}, findings=(*recording.findings, finding)
    )


def _pose_of_wrench(recording: Recording, entry: TransformTable) -> FloatArray:
    """Axes of the wrench in the frame of the sensor, and there the point that its moment is about; ([n,] 4, 4); m."""
    if entry.orientation is not None:
        stream, source = recording.stream(entry.stream), recording.stream(entry.orientation)
        pose = (pose_at if entry.moment_about == "own_frame" else orientation_at)(stream, source, entry.to)
    else:
        pose = _pose(entry.pose)
    if entry.point_m is not None:
        pose[..., :3, 3] = entry.point_m
    return pose


def _pose(table: PoseTable | None) -> FloatArray:
    if table is None:
        raise ExperimentError("expected pose, or orientation")
    return make_pose(rotation_from_rpy(table.rpy_rad), np.zeros(3) if table.position_m is None else table.position_m)


Options = ParamSpec("Options")
Answer = TypeVar("Answer", bound=Result)

ADDED = {"clock", "transformed", "fixed_joint", "corrected_robot", "stated_rate", "skipped_rows", "glitch", "kept"}
"""Kinds of findings that say what the experiment file adds to its log, or what is left out of it for all."""


def added_to(recording: Recording) -> tuple[str, ...]:
    """Say what an experiment file adds to its log.

    Returns:
        A sentence for every clock, frame, joint, rate or line.
    """
    return tuple(f"{finding.stream}: {finding.message}" for finding in recording.findings if finding.kind in ADDED)


def with_recording_notes(analysis: Callable[Options, Answer]) -> Callable[Options, Answer]:
    """Let the result of an analysis report what is added to the recordings that it is given, and what is left out.

    The first are warnings of the result; the second are records of it.

    Args:
        analysis: A function whose arguments hold experiments, their sensors, or many of these.

    Returns:
        The function; its result has a warning for every addition that no warning of it names yet, and unusable samples.
    """

    @wraps(analysis)
    def noted(*args: Options.args, **options: Options.kwargs) -> Answer:
        return with_notes(analysis(*args, **options), (*args, *options.values()))

    return noted


def with_notes(result: Answer, arguments: Sequence[Any]) -> Answer:
    """Let a result state what is added to the recordings that it is made of, and what is left out.

    Args:
        result: The result.
        arguments: What the analysis was given: experiments, their sensors, many of these, and options.

    Returns:
        The result, with a warning for every addition that no warning of it names yet, and unusable samples.
    """
    untold = tuple(_untold(arguments, result.warnings))
    left_out = result.unusable_samples
    if result.interval_uses is not None:
        left_out = (*left_out, *_left_out(arguments, result.interval_uses))
    if not untold and not left_out:
        return result
    notes = {"warnings": (*result.warnings, *untold), "unusable_samples": tuple(dict.fromkeys(left_out))}
    return result.model_copy(update=notes)


def _untold(arguments: Iterable[Any], told: Iterable[str]) -> Iterator[str]:
    """What no warning says yet; of several recordings with the name of each."""
    recordings = dict.fromkeys((experiment.name, experiment.recording) for experiment, _ in _experiments(arguments))
    said = tuple(told)
    for name, recording in recordings:
        for sentence in added_to(recording):
            if not any(sentence in warning for warning in said):
                yield sentence if len(recordings) == 1 else f"{name}: {sentence}"


def _left_out(arguments: Iterable[Any], uses: Collection[str]) -> Iterator[UnusableSamples]:
    """What is left out of the sensors that were read."""
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.experiment.sample_quality import unusable_samples

    for experiment, sensor in dict.fromkeys(_experiments(arguments)):
        if isinstance(experiment, Experiment):
            yield from unusable_samples(experiment, sensor=sensor, uses=uses)


def _experiments(argument: Any, sensor: str | None = None) -> Iterator[tuple[Any, str | None]]:
    """Experiments, with the name of the only sensor that is asked about; of sensors in them, and of many of these."""
    if isinstance(getattr(argument, "recording", None), Recording):
        yield argument, sensor
    elif hasattr(argument, "runs"):
        yield from _experiments(argument.runs)
    elif hasattr(argument, "experiment"):
        yield from _experiments(argument.experiment, getattr(getattr(argument, "sensor", None), "name", None))
    elif isinstance(argument, Mapping | Sequence) and not isinstance(argument, str | bytes):
        for entry in argument.values() if isinstance(argument, Mapping) else argument:
            yield from _experiments(entry)
