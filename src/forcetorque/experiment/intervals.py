# SPDX-License-Identifier: BSD-3-Clause
"""Supports and intervals of an experiment, on the clock of its recording; also those stated once for every file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from forcetorque.base.arrays import BoolArray, IntArray
from forcetorque.base.errors import ExperimentError, known_names, require_known
from forcetorque.experiment import experiment_file as schema
from forcetorque.experiment.experiment_file import EACH_FILE, ExperimentFile
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.section import require_link
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support, Use
from forcetorque.robot.mechanics.root_motion import imu_frame, imu_streams
from forcetorque.robot.model import RobotModel

_FAR_S = 1e9
"""Longer than any log; larger ends are cut to it before they become nanoseconds."""


def read_supports(
    entries: Sequence[schema.Support], file: Path, recording: Recording, model: RobotModel
) -> dict[str, Support | MovingSupport]:
    """Match every support frame to the robot and, where it moves, to the streams of an IMU.

    Args:
        entries: Supports of the experiment file.
        file: The experiment file, for messages.
        recording: The streams.
        model: The robot.

    Returns:
        Supports by frame.

    Raises:
        ExperimentError: If a frame is not in the robot or listed twice.
    """
    supports: dict[str, Support | MovingSupport] = {}
    for index, entry in enumerate(entries):
        where = f"{file}: support[{index}]"
        require_link(model, entry.frame, where)
        if entry.frame in supports:
            raise ExperimentError(f"{where}: the frame {entry.frame!r} is listed twice; keep one")
        with stated_in(where):
            if entry.gravity_direction is not None:
                supports[entry.frame] = Support(frame=entry.frame, gravity_direction=entry.gravity_direction)
                continue
            supports[entry.frame] = MovingSupport(frame=entry.frame, motion_streams=entry.imu or ())
            for name in entry.imu or ():
                recording.stream(name)
    return supports


def read_intervals(
    parsed: schema.ExperimentFile,
    file: Path,
    recording: Recording,
    supports: Mapping[str, Support | MovingSupport],
    model: RobotModel | None,
    *,
    loads: Mapping[str, MovingSupport] | None,
) -> list[Interval]:
    """Bring the intervals to the clock of the recording.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The streams, whose earliest stamp is second 0.
        supports: Supports by frame.
        model: The robot; None for the load of a wrist sensor.
        loads: Support of the intervals of each load by its name, for a wrist sensor.

    Returns:
        Intervals in the order of the file.

    Raises:
        ExperimentError: If an interval names no known support or link, lies outside the log, or overlaps another, or
            links are touched in it and no IMU tells how the robot moves.
    """
    with stated_in(f"{file}: recording"):
        start, end = recording.span_ns
    intervals = []
    for index, span in enumerate(parsed.interval):
        where = f"{file}: interval[{index}] {span.label!r}"
        if span.support is not None and span.support not in supports:
            raise ExperimentError(
                f"{where}: no [[support]] has the frame {span.support!r}; {known_names(span.support, supports)}"
            )
        start_ns, end_ns = span_ns(where, span, start, end)
        with stated_in(f"{file}: interval[{index}]"):
            interval = Interval(
                label=span.label,
                start_ns=start_ns,
                end_ns=end_ns,
                use=span.use,
                support=_support(span, supports, recording, model, loads),
            )
        intervals.append(interval)
    refuse_overlap(file, intervals)
    return intervals


def _support(
    span: schema.Interval,
    supports: Mapping[str, Support | MovingSupport],
    recording: Recording,
    model: RobotModel | None,
    loads: Mapping[str, MovingSupport] | None,
) -> Support | MovingSupport | None:
    if loads is not None:
        return next(iter(loads.values())) if span.load is None else loads[span.load]
    # which of several touched links stands for the support does not matter to parts that nothing touches
    if span.contact_links is None or model is None:
        return None if span.support is None else supports[span.support]
    for link in span.contact_links:
        require_link(model, link, "contact_links")
    imu = imu_streams(recording)
    if not imu:
        raise ExperimentError(
            "contact_links: expected an IMU in the recording, which tells how the robot moves whatever touches it; "
            "without one name the link that stands still as support"
        )
    support = MovingSupport(frame=span.contact_links[0], motion_streams=imu)
    imu_frame(model, recording, support)  # of several IMUs the file must name one
    return support


def span_ns(where: str, span: schema.Interval, start: int, end: int) -> tuple[int, int]:
    """Bring a span to the clock of the recording.

    Args:
        where: File and table, for messages.
        span: The span; s from the earliest stamp.
        start: Earliest stamp of the recording; ns.
        end: Latest stamp; ns.

    Returns:
        First instant, and first instant after it; ns.

    Raises:
        ExperimentError: If it lies outside the log.
    """
    log_s = (end - start) // 1_000_000 / 1000  # rounded down, so that who copies it from the message stays inside
    end_ns = end + 1 if span.end_s is None else start + round(min(span.end_s, _FAR_S) * 1e9)
    if span.start_s < 0.0 or max(span.start_s * 1e9, end_ns - start) > end - start + 1.5:
        raise ExperimentError(
            f"{where}: expected a span inside the log, 0 to {log_s:.3f} s, "
            f"got {span.start_s:g} to {(end_ns - start) * 1e-9 if span.end_s is None else span.end_s:g} s"
        )
    return start + round(span.start_s * 1e9), end_ns


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedSpan:
    """A span of time, start included and end excluded; it needs no support frame."""

    label: str
    """Name of the interval."""
    start_ns: int
    """First instant; ns."""
    end_ns: int
    """First instant after it; ns."""
    use: Use
    """What it is for."""

    def holds(self, stamp_ns: IntArray) -> BoolArray:
        """Tell which instants lie in the interval.

        Args:
            stamp_ns: Instants; shape (n,); ns on the recording's clock.

        Returns:
            Whether each does; shape (n,).
        """
        return (stamp_ns >= self.start_ns) & (stamp_ns < self.end_ns)


def refuse_overlap(file: Path, intervals: Sequence[Interval | RecordedSpan]) -> None:
    """Refuse samples that would be fitted and judged, or fitted twice.

    Args:
        file: The experiment file, for messages.
        intervals: Its intervals.

    Raises:
        ExperimentError: If two that are used overlap.
    """
    used = [interval for interval in intervals if interval.use is not Use.IGNORE]
    for k, first in enumerate(used):
        for second in used[k + 1 :]:
            if first.start_ns < second.end_ns and second.start_ns < first.end_ns:
                raise ExperimentError(
                    f"{file}: the intervals {first.label!r} ({first.use}) and {second.label!r} ({second.use}) overlap; "
                    "a sample is fitted or judged once"
                )


def read_spans(parsed: schema.ExperimentFile, file: Path, recording: Recording) -> tuple[RecordedSpan, ...]:
    """Bring the intervals of a file to the clock of its recording.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The streams.

    Returns:
        The spans in the order of the file, one for each file of an interval with `files`.
    """
    with stated_in(f"{file}: recording"):
        first, last = recording.span_ns
    parsed = with_intervals_of_files(parsed, file, recording)
    spans = []
    for index, span in enumerate(parsed.interval):
        start_ns, end_ns = span_ns(f"{file}: interval[{index}] {span.label!r}", span, first, last)
        spans.append(RecordedSpan(label=span.label, start_ns=start_ns, end_ns=end_ns, use=span.use))
    refuse_overlap(file, spans)
    return tuple(spans)


_AFTER_S = 1e-9
"""Time after the last sample of a file at which its interval ends, itself excluded; one step of the clock."""


def with_intervals_of_files(parsed: ExperimentFile, file: Path, recording: Recording) -> ExperimentFile:
    """Replace every interval with `files` by one for each file of its stream.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The streams, with the files that they were put together of.

    Returns:
        The content with intervals in the order of the files.

    Raises:
        ExperimentError: If there is no such stream of files, a file is shorter, or [[clock]] moves samples.
    """
    if all(span.files is None for span in parsed.interval):
        return parsed
    spans = [
        one
        for index, span in enumerate(parsed.interval)
        for one in ([span] if span.files is None else _of_files(f"{file}: interval[{index}]", parsed, span, recording))
    ]
    return parsed.model_copy(update={"interval": tuple(spans)})


def _of_files(
    where: str, parsed: ExperimentFile, span: schema.Interval, recording: Recording
) -> Iterator[schema.Interval]:
    stream = span.files or ""
    require_known(
        stream, recording.files, ExperimentError, f"{where}: files: expected a stream of text tables, got {stream!r}"
    )
    if parsed.clock:
        raise ExperimentError(f"{where}: files: expected no [[clock]] beside it; state start_s and end_s of each file")
    files, stamps = recording.files[stream], recording.stream(stream).stamp_ns
    stems = [PurePosixPath(name).stem for name, _ in files]
    same = [stem for stem, count in Counter(stems).items() if count > 1]
    if same:
        raise ExperimentError(f"{where}: files: expected names that differ, got {same[0]!r} in several folders")
    first = 0
    for stem, (name, rows) in zip(stems, files, strict=True):
        own = stamps[first : first + rows]
        first += rows
        if not len(own):
            raise ExperimentError(f"{where}: files: {name} has no sample; take it away")
        start_s, last_s = (1e-9 * (int(stamp) - recording.start_ns) for stamp in (own[0], own[-1]))
        end_s = last_s + _AFTER_S if span.end_s is None else start_s + span.end_s
        if not span.start_s + start_s <= last_s or end_s > last_s + 2.0 * _AFTER_S:
            raise ExperimentError(
                f"{where}: {name} has samples of {last_s - start_s:.6g} s, expected as many as from start_s = "
                f"{span.start_s:g} to end_s = {'its end' if span.end_s is None else format(span.end_s, 'g')}"
            )
        yield span.model_copy(
            update={
                "label": span.label.replace(EACH_FILE, stem),
                "files": None,
                "start_s": start_s + span.start_s,
                "end_s": end_s,
            }
        )
