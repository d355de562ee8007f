# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `inspect`: findings grouped to events in time, and a sensor by its log alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, get_args

import numpy as np

from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.formats.log_format import not_read_message
from forcetorque.inspection.file_contents import NO_NUMBERS, sketch_text
from forcetorque.inspection.plausibility.fault_hypotheses import FaultKind
from forcetorque.inspection.sensor_alone import SensorAlone
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.number_text import amount

if TYPE_CHECKING:
    from forcetorque.inspection.file_contents import MakerCalibration
    from forcetorque.inspection.inspect import FindingRow, Inspection

_LEADING: Final = ("contact", "light_contact")
"""Kinds that make an event by themselves; what else is found meanwhile belongs to it."""
_FAULTS: Final = frozenset((*get_args(FaultKind), "implausible"))
"""Kinds that are about the file, the URDF or the log as a whole, and by more than a doubt."""
_CORRECTED: Final = frozenset({"gravity", "delay", "mount"})
"""Faults that a key of the experiment file corrects, whether or not it is there; a sense where the file states it."""
_APART_S: Final = 1.0
"""Time between findings of two events."""
_WHOLE: Final = 0.95
"""Share of the duration above which a finding is about the log as a whole."""
_MOST = 4
"""Events that are listed; the others are counted."""
_NEXT: Final = {
    True: "calibrate the sensors, or identify their load, and evaluate",
    False: "begin an experiment file for it; of a robot add --urdf FILE",
}
"""What follows, by whether it is an experiment file."""
_MOST_COLUMNS = 6
"""Columns of one quantity that are named; the others are counted."""
_CELLS = 50
"""Characters of the bar."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """Findings of one stream that belong together."""

    start_s: float
    """First instant; s from the earliest stamp of the recording."""
    end_s: float
    """Last instant; s."""
    findings: tuple[FindingRow, ...]
    """The findings; the leading one first."""

    @property
    def text(self) -> str:
        """Time, stream, and kinds with their channels and largest sizes."""
        kinds: dict[str, list[FindingRow]] = {}
        for row in self.findings:
            kinds.setdefault(row.kind, []).append(row)
        words = "; ".join(_kind_text(kind, rows) for kind, rows in kinds.items())
        return f"{self.start_s:.1f}-{self.end_s:.1f} s, {self.findings[0].stream}: {words}"

    def harm(self, in_use_s: Sequence[tuple[float, float]]) -> tuple[float, float, float]:
        """Estimate how much it spoils a fit and its validation (a heuristic).

        Args:
            in_use_s: Begin and end of the intervals for calibration and validation; s.

        Returns:
            What orders events: largest force times the time in these intervals in which it acts; the force; the time
            of the event. A step acts from its instant to the nearer end of an interval. Samples that every fit leaves
            out, as in a gap, spoil none.
        """
        forces = [(row, _force(row)) for row in self.findings if row.kind not in _LEFT_OUT]
        spoilt = max((force * sum(_acts_s(row, *one) for one in in_use_s) for row, force in forces), default=0.0)
        return spoilt, max((force for _, force in forces), default=0.0), self.end_s - self.start_s

    def spoils(self, in_use_s: Sequence[tuple[float, float]]) -> bool:
        """Check whether a fit or its validation has samples of it.

        Args:
            in_use_s: Begin and end of the intervals for calibration and validation; s.

        Returns:
            Whether a finding lies in one of them; samples that every fit leaves out do not count.
        """
        rows = [row for row in self.findings if row.kind not in _LEFT_OUT]
        return any(_acts_s(row, *interval) > 0.0 for row in rows for interval in in_use_s)

    def explains(self, wrong: Iterable[FindingRow], in_use_s: Sequence[tuple[float, float]]) -> bool:
        """Check whether it is a contact that may be why the robot model contradicts the stream (a heuristic).

        Args:
            wrong: Faults.
            in_use_s: As of `spoils`.

        Returns:
            Whether one of them is an implausible measurement of the same stream, and the contact takes at least a
            tenth of the time in use.
        """
        lead = self.findings[0]
        touched = sum(_acts_s(lead, *interval) for interval in in_use_s)
        lasts = touched >= _TOUCHED * sum(end - start for start, end in in_use_s)
        of_stream = any(row.kind == "implausible" and row.stream == lead.stream for row in wrong)
        return lead.kind in _LEADING and lasts and of_stream


_LEFT_OUT: Final = frozenset(
    {
        "gap",
        "frozen",
        "stuck",
        "saturation",
        "lost_messages",
        "missing",
        "repeated_stamp",
        "backward_stamp",
        "joint_spike",
    }
)
"""Kinds whose samples no fit has, or measures no force by."""
_COUNTED: Final = frozenset({"repeated_stamp", "backward_stamp", "joint_spike"})
"""Kinds that count single samples, of which one finding spans the time from the first to the last."""
_TOUCHED: Final = 0.1
"""Share of the time in use above which a contact may explain that a measurement is implausible."""
_LEVER_M: Final = 0.1
"""Lever by which a moment counts as a force."""
_SAMPLE_S: Final = 0.01
"""Time that an outlier acts for; s."""


def _force(row: FindingRow) -> float:
    """Size of a finding as a force; N; 0 of what is none."""
    size = abs(row.size or 0.0)
    return {"N": size, "N m": size / _LEVER_M}.get(row.unit or "", 0.0)


def _acts_s(row: FindingRow, start_s: float, end_s: float) -> float:
    """How long a finding acts in an interval; s."""
    first, last = row.start_s or 0.0, row.end_s or 0.0
    if not start_s <= last or not first <= end_s:
        return 0.0
    if row.kind == "step":
        return min(first - start_s, end_s - first)
    return max(min(last, end_s) - max(first, start_s), _SAMPLE_S)


def _kind_text(kind: str, rows: Sequence[FindingRow]) -> str:
    """Such as `step in fx, fy up to 25 N`."""
    channels = sorted({row.channel for row in rows if row.channel is not None})
    where = f" in {', '.join(channels)}" if channels else ""
    sizes: dict[str, float] = {}
    for row in rows:
        if row.size and row.unit is not None:
            sizes[row.unit] = max(sizes.get(row.unit, 0.0), abs(row.size))
    largest = " and ".join(amount(value, unit) for unit, value in sizes.items())
    size = f" up to {largest}" if largest else ""
    return f"{kind.replace('_', ' ')}{where}{size}"


def faults(findings: Iterable[FindingRow]) -> tuple[FindingRow, ...]:
    """Select what is wrong with the experiment file, the URDF or the log as a whole, by the robot model.

    Returns:
        Those of a fault that explains the measurements, and of what `calibrate` refuses; what it only warns of is none.
    """
    return tuple(row for row in findings if row.kind in _FAULTS)


def causes(inspection: Inspection) -> tuple[FindingRow, ...]:
    """Select the faults, and before them joints that jump in an interval in use, which may be why.

    Args:
        inspection: What was found by an experiment file.

    Returns:
        The jumps of all joints where a measurement is implausible, else of those that a fault is about, and the faults.
    """
    wrong = faults(inspection.findings)
    is_implausible = any(row.kind == "implausible" for row in wrong)
    about = {row.channel for row in wrong if row.kind in ("joint_offset", "joint_sign")}
    in_use = inspection.in_use_s or ((0.0, inspection.duration_s),)
    jumps = (
        row
        for row in inspection.findings
        if row.kind == "joint_jump"
        and (is_implausible or row.channel in about)
        and any(_acts_s(row, *interval) > 0.0 for interval in in_use)
    )
    return (*jumps, *wrong)


def has_proposal(inspection: Inspection) -> bool:
    """Find out whether `init --resume` tries a change of the experiment file.

    Args:
        inspection: What was found by the file.

    Returns:
        Whether a key of the file corrects one of the faults, as none corrects a mass of the URDF.
    """
    kinds = {row.kind for row in inspection.findings}
    return bool(kinds & _CORRECTED) or (inspection.states_sense and "reversed" in kinds)


def events(findings: Iterable[FindingRow], duration_s: float) -> tuple[Event, ...]:
    """Group findings.

    Args:
        findings: Findings.
        duration_s: Duration of the recording; s.

    Returns:
        Events in the order of time; findings about the whole log are in none.
    """
    found: list[Event] = []
    timed = [row for row in findings if not is_about_all(row, duration_s)]
    for row in sorted(timed, key=lambda row: (row.kind not in _LEADING, row.start_s)):
        start, end = row.start_s or 0.0, row.end_s or 0.0
        place = next((k for k, event in enumerate(found) if _belongs(row, event)), None)
        if place is None or row.kind in _LEADING:
            found.append(Event(start_s=start, end_s=end, findings=(row,)))
        else:
            event = found[place]
            found[place] = Event(
                start_s=min(event.start_s, start), end_s=max(event.end_s, end), findings=(*event.findings, row)
            )
    return tuple(sorted(found, key=lambda event: event.start_s))


def is_about_all(row: FindingRow, duration_s: float) -> bool:
    """Tell whether a finding is about the log as a whole.

    Args:
        row: The finding.
        duration_s: Duration of the recording; s.

    Returns:
        Whether it has no time, takes nearly all of it, or counts single samples that cost no more than themselves.
    """
    if row.kind in _COUNTED and row.count > 1:
        return True
    return row.start_s is None or row.end_s is None or row.end_s - row.start_s > _WHOLE * duration_s


def _belongs(row: FindingRow, event: Event) -> bool:
    if row.stream != event.findings[0].stream or row.start_s is None:
        return False
    lead = event.findings[0].kind in _LEADING
    return event.start_s - (0.0 if lead else _APART_S) <= row.start_s <= event.end_s + (0.0 if lead else _APART_S)


def inspection_answers(inspection: Inspection) -> Iterator[Answer]:
    """Give the answer for a recording, or the log of a sensor by itself.

    Yields:
        One answer.
    """
    if inspection.sensor is not None:
        yield sensor_answer(inspection.sensor, inspection.source, inspection.duration_s)
    elif inspection.calibration is not None:
        yield _calibration_answer(inspection.calibration, inspection.source)
    elif inspection.unread:
        yield _columns_answer(inspection)
    elif inspection.streams:
        yield inspection_answer(inspection)


def _calibration_answer(calibration: MakerCalibration, source: str) -> Answer:
    scales = [f"{amount(row.full_scale, row.unit)} in {row.component}" for row in calibration.rows if row.full_scale]
    channels = f"{len(calibration.rows[0].coefficients)} channels in {calibration.raw_unit}"
    return Answer(
        subject=f"{source}: {calibration.form}, serial number {calibration.serial or 'not stated'}",
        verdict="CALIBRATION",
        why=(f"{channels}, {calibration.date or 'no date'}; full scale {', '.join(scales) or 'not stated'}",),
        step="state it as prior of the [[sensor]] in an experiment file",
    )


def _columns_answer(inspection: Inspection) -> Answer:
    rows = max(row.rows for row in inspection.unread)
    quantities: dict[str, list[str]] = {}
    for row in inspection.unread:
        if row.looks_like not in (None, NO_NUMBERS):
            quantities.setdefault(row.looks_like, []).append(row.column)
    alike = "; ".join(f"{quantity}: {_few(names)}" for quantity, names in quantities.items())
    return Answer(
        subject=f"{inspection.source}: {rows} rows, {len(inspection.unread)} columns or arrays",
        verdict="NEEDS A FILE",
        why=(
            f"by their names, {alike}" if alike else "no name is that of a known quantity",
            sketch_text(inspection.unread),
            *((not_read_message(inspection.skipped_arrays),) if inspection.skipped_arrays else ()),
        ),
        step="begin an experiment file, which asks what the log does not state; of a robot add --urdf FILE",
        command=typed("init", inspection.source, "-o", "experiment.toml"),
        concern=Concern.UNCERTAIN,
    )


def _few(names: Sequence[str]) -> str:
    more = len(names) - _MOST_COLUMNS
    return ", ".join(names[:_MOST_COLUMNS]) + (f" and {more} more" if more > 0 else "")


def inspection_answer(inspection: Inspection) -> Answer:
    """Give the answer about a log.

    Args:
        inspection: What was found in it.

    Returns:
        Number of events, the most harmful of them first, and a bar of the time that none of them takes.
    """
    grouped = events(inspection.findings, inspection.duration_s)
    notes = [row.message for row in inspection.findings if is_about_all(row, inspection.duration_s)]
    source, is_experiment = inspection.source, inspection.source.endswith(".toml")
    begin, go_on = typed("init", source, "-o", "experiment.toml"), typed("run", source, "-o", "results")
    step = _NEXT[is_experiment]
    if inspection.to_calibrate is None:
        step, go_on = "state a [[sensor]] to calibrate, or an [[interval]] for the calibration of skin", ""
    elif inspection.to_calibrate == "no_interval":
        step, go_on = 'state an [[interval]] with use = "calibration", in which nothing unknown touches the limb', ""
    elif inspection.to_calibrate == "standing":
        step, go_on = "find which feet bear the robot", typed("robot", "balance", source)
    elif inspection.to_calibrate == "skin":
        step, go_on = "calibrate its taxels", typed("skin", "calibrate", source, "-o", "skin.json")
    subject = f"{source}: {inspection.duration_s:.1f} s, {len(inspection.streams)} stream(s)"
    in_use = inspection.in_use_s or ((0.0, inspection.duration_s),)
    spoiling = [event for event in grouped if event.spoils(in_use)]
    if wrong := faults(inspection.findings):
        touched = [event for event in spoiling if event.explains(wrong, in_use)] if is_experiment else []
        resumes = bool(touched) or (is_experiment and has_proposal(inspection))
        correct = "accept the change that corrects it" if resumes else "correct it, and inspect again"
        ordered = causes(inspection)
        return Answer(
            subject=subject,
            verdict=f"{len(wrong)} FAULT{'S' * (len(wrong) > 1)}",
            why=(
                *(f"{row.stream}: {row.message}" for row in ordered[: 1 if touched else 2]),
                *(f"in an interval that is used: {event.text}" for event in _most_harmful(touched, in_use)[:1]),
            ),
            step="leave the contact out of every [[interval]]" if touched else correct,
            command=typed("init", "--resume", source) if resumes else typed("inspect", source),
            concern=Concern.BAD,
        )
    more = (f"{len(notes)} remark(s) on the whole log: {notes[0]}",) if notes else ()
    if not grouped:
        return Answer(
            subject=subject,
            verdict="REMARKS" if notes else "NOTHING FOUND",
            why=more,
            step=step,
            command=go_on if is_experiment else begin,
            concern=Concern.UNCERTAIN if notes else Concern.NONE,
        )
    shown = [event.text for event in _most_harmful(grouped, in_use)[:_MOST]]
    rest = len(grouped) - len(shown)
    usable = _usable(grouped, inspection.duration_s)
    bar = f"0 s |{''.join('█' if cell else '░' for cell in usable)}| {inspection.duration_s:.0f} s; █ no event"
    return Answer(
        subject=subject,
        verdict=f"{len(grouped)} EVENT{'S' * (len(grouped) > 1)}",
        why=(*shown, *((f"{rest} less harmful one(s)",) if rest else ()), bar, *more),
        step=_step_of_events(spoiling, step) if is_experiment else step,
        command=(typed("init", "--resume", source) if spoiling else go_on) if is_experiment else begin,
        concern=Concern.UNCERTAIN,
    )


def _step_of_events(spoiling: Sequence[Event], step: str) -> str:
    if spoiling:
        return "leave these events out of every [[interval]]"
    return f"no interval uses a sample of these events: {step}"


def _most_harmful(grouped: Iterable[Event], in_use_s: Sequence[tuple[float, float]]) -> list[Event]:
    return sorted(grouped, key=lambda event: event.harm(in_use_s), reverse=True)


def _usable(grouped: Sequence[Event], duration_s: float) -> Iterator[bool]:
    """Which parts of the time no event takes."""
    step = max(duration_s, 1e-9) / _CELLS
    for k in range(_CELLS):
        yield not any(event.start_s < (k + 1) * step and event.end_s > k * step for event in grouped)


_MANY_REPEATS = 0.1
"""Share of samples that repeat the one before, from which on the sensor is slower than its log."""


def sensor_answer(sensor: SensorAlone, source: str, duration_s: float) -> Answer:
    """Give the answer about a sensor by itself.

    Args:
        sensor: What its log shows.
        source: The log.
        duration_s: Its duration; s.

    Returns:
        What is wrong with the log first, then rate, noise and drift.
    """
    wrong = [
        text
        for count, text in (
            (len(sensor.stuck), f"{', '.join(sensor.stuck)} stuck"),
            (sensor.missing_samples, f"{sensor.missing_samples} samples without a value"),
            (sensor.clipped_samples, f"{sensor.clipped_samples} samples clipped"),
            (len(sensor.tares_s), f"tared at {', '.join(f'{time:.2f} s' for time in sensor.tares_s[:4])}"),
            (sensor.lost_samples, f"{sensor.lost_samples} samples lost"),
            (sensor.repeated_stamps, f"{sensor.repeated_stamps} stamps repeated"),
        )
        if count
    ]
    share = sensor.repeated_samples / sensor.samples
    if share > _MANY_REPEATS:
        wrong.append(f"{100 * share:.0f} % of samples repeat the one before: {(1 - share) * sensor.rate_hz:.4g} Hz")
    assumed = (f"assumed, as the file does not state it: {'; '.join(sensor.assumed)}",) if sensor.assumed else ()
    return Answer(
        subject=f"{source}: {duration_s:.1f} s of {sensor.stream}",
        verdict=f"{sensor.rate_hz:.4g} Hz, {'; '.join(wrong)}" if wrong else f"{sensor.rate_hz:.4g} Hz, NOTHING LOST",
        why=(
            f"steps scatter by {sensor.jitter_ms:.2g} ms; {_noise_text(sensor)}",
            _drift_text(sensor),
            *assumed,
        ),
        step="begin an experiment file for it",
        command=typed("init", source, "-o", "experiment.toml"),
        concern=Concern.UNCERTAIN if wrong else Concern.NONE,
    )


def _noise_text(sensor: SensorAlone) -> str:
    return f"noise up to {' and '.join(_largest(sensor, sensor.noise))}"


def _drift_text(sensor: SensorAlone) -> str:
    if sensor.drift_per_hour is None or sensor.drift_half_width_95_per_hour is None:
        return "drift is not determined: the load changes, the log is shorter than ten seconds, or it has no noise"
    sure = [
        value if abs(value) > width else 0.0
        for value, width in zip(sensor.drift_per_hour, sensor.drift_half_width_95_per_hour, strict=True)
    ]
    bounds = " and ".join(_largest(sensor, sensor.drift_half_width_95_per_hour, per="/h"))
    if not any(sure):
        return f"no drift beyond the noise, which hides up to {bounds}"
    return f"drift up to {' and '.join(_largest(sensor, sure, per='/h'))} (95 %: ±{bounds}), if the load stays"


def _largest(sensor: SensorAlone, values: Sequence[float], *, per: str = "") -> Iterator[str]:
    """The largest magnitude of forces and of moments, or of channels."""
    groups = (FORCE, MOMENT) if len(set(sensor.units)) > 1 else (slice(None),)
    for group in groups:
        numbers = np.abs(values[group])
        place = int(numbers.argmax())
        yield f"{amount(float(numbers[place]), sensor.units[group][place] + per)} ({sensor.columns[group][place]})"
