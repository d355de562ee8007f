# SPDX-License-Identifier: BSD-3-Clause
"""Changes of an answered experiment file that the recording speaks for, each tried before it is proposed.

A change is written to a copy of the file, which is read as any other; it is proposed if less of the measured wrench
stays unexplained then. So neither its sign nor its unit can be wrong unnoticed.
"""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import temporary_beside, write_bytes_atomically
from forcetorque.base.run_files import files_of_one_run
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_mount import SensorMount
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison import Comparison, compared
from forcetorque.inspection.diagnosis import diagnosed
from forcetorque.inspection.draft.contact_free import FreeTime, free_time
from forcetorque.inspection.draft.edits import Edit, interval_edit, key_edit, table_edit
from forcetorque.inspection.draft.gravity import SHORTEST_S
from forcetorque.inspection.draft.intervals import divided
from forcetorque.inspection.fault_messages import fault_text, remedy
from forcetorque.inspection.findings import whole_log_samples
from forcetorque.inspection.plausibility.evidence import Evidence
from forcetorque.inspection.plausibility.hypotheses import Explanation
from forcetorque.recording.recording import Interval, Support, Use
from forcetorque.robot.mounting import rotation_by, rotation_vector

_EXPLAINS: Final = 0.8
"""Part of the residual of force or moment that is left at most by a change that is proposed."""
_FREES: Final = 0.5
"""The same of intervals: shorter ones have smaller errors of the robot model too."""
_WORSENS: Final = 1.2
"""Part of the residual of force or moment that is left at most by any change."""
_TOUCHED_S: Final = 0.5
"""Time of intervals in which something touches, from which on other intervals are proposed; s."""
_OFFERS: Final = 2
"""How often one thing is proposed, since other changes may change it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Residual:
    """What the expected wrench leaves of the measured one in intervals in use, the offset taken out."""

    plain: FloatArray
    """Root mean square of force and moment; shape (2,); N, N m."""
    beside_matrix: FloatArray
    """The same beside likely errors of the prior matrix; shape (2,); N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Improvement:
    """Residuals of a file as it is, and with a change."""

    before: FloatArray
    """Residual force and moment of the file as it is; shape (2,); N, N m."""
    after: FloatArray
    """The same with the change; shape (2,); N, N m."""
    beside_matrix: bool
    """Whether likely errors of the prior matrix are taken out of both."""

    @property
    def text(self) -> str:
        """Both residuals."""
        beside = " beside errors of the matrix" if self.beside_matrix else ""
        (force, moment), (new_force, new_moment) = self.before, self.after
        return f"residual{beside} {force:.2g} -> {new_force:.2g} N, {moment:.2g} -> {new_moment:.2g} N m"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Proposal:
    """A change of an experiment file."""

    kind: str
    """`interval`, or the kind of the fault that it corrects."""
    about: str
    """Sensor, joint, stream or support that it is about."""
    text: str
    """What is wrong, or what is proposed."""
    edit: Edit | None
    """The change; None where a person has to change another file, as `text` says."""
    residuals: Improvement | None = None
    """What the change does to the residual; None where it was not tried."""

    @property
    def key(self) -> tuple[str, str]:
        """What makes two proposals the same, however their numbers differ."""
        return self.kind, self.about

    @property
    def sentence(self) -> str:
        """The proposal with its line and its residuals."""
        words = self.text if self.edit is None else f"{self.text}: {self.edit.text}"
        return words if self.residuals is None else f"{words}; {self.residuals.text}"


def proposals(file: Path, settled: Collection[tuple[str, str]] = ()) -> tuple[Proposal, ...]:
    """Propose changes of an experiment file without open questions.

    Args:
        file: The file.
        settled: Keys of proposals that are not made again.

    Returns:
        Corrections of what the file states; intervals where there is none, since a wrong model looks like contacts.

    Raises:
        ForceTorqueError: If the file, or what it points to, cannot be read.
    """
    text = file.read_text(encoding="utf-8-sig")
    experiment = load_experiment(file)
    runs = [SensorRun(experiment, sensor) for sensor in experiment.sensors]
    runs = [run for run in runs if run.sensor.quantity == "wrench" or run.sensor.prior is not None]
    faults = tuple(one for one in _faults(file, text, runs) if one.key not in settled)
    if faults or not runs or ("interval", "") in settled:
        return faults
    interval = _interval_proposal(file, text, experiment, runs)
    return () if interval is None else (interval,)


def settle(file: Path, accepts: Callable[[str], bool]) -> tuple[Proposal, ...]:
    """Offer the proposals one by one, and write each that is accepted at once.

    Args:
        file: The file, which is rewritten.
        accepts: Shows a proposal, and gives whether it is accepted.

    Returns:
        What was declined, or is to be changed by hand.
    """
    offers: Counter[tuple[str, str]] = Counter()
    left: dict[tuple[str, str], Proposal] = {}
    while True:
        settled = {*left, *(key for key, count in offers.items() if count >= _OFFERS)}
        with files_of_one_run():  # the file is rewritten, so that it is no input of what goes on after this
            proposal = next(iter(proposals(file, settled)), None)
        if proposal is None:
            return tuple(left.values())
        offers[proposal.key] += 1
        if proposal.edit is not None and accepts(proposal.sentence):
            text = proposal.edit.applied(file.read_text(encoding="utf-8-sig"))
            write_bytes_atomically(file, text.encode())
        else:
            left[proposal.key] = proposal


def _loaded(file: Path, text: str) -> Experiment | None:
    """The experiment of another content of the file; None where it cannot be read."""
    with temporary_beside(file) as copy:
        copy.write_text(text, encoding="utf-8")
        try:
            return load_experiment(copy)
        except ForceTorqueError:
            return None


def _comparison(run: SensorRun, samples_of: SensorRun | None = None) -> Comparison | None:
    """Compare a sensor with the model, with the samples of the whole log that another run has of the same recording."""
    correction = run.read_by(None, None).bare
    try:
        part = whole_log_samples(samples_of or run, correction)
        return compared(run, correction, whole=part)
    except ForceTorqueError:
        return None


def _residual(comparisons: Iterable[Comparison | None]) -> Residual | None:
    """The residual of sensors together; None where one cannot be compared."""
    squares = []
    for comparison in comparisons:
        if comparison is None:
            return None
        sensor = comparison.run.sensor
        seconds = (comparison.at_ns - comparison.at_ns[0]) * 1e-9
        prior = None if sensor.prior_source == "identity" else sensor.prior
        evidence = Evidence.of(comparison.measured, comparison.expected, seconds, prior)
        fit = evidence.fit(comparison.expected)
        squares.append([evidence.left(fit) ** 2, evidence.left(fit, beside_matrix=True) ** 2])
    if not squares:
        return None
    plain, beside = np.sqrt(np.mean(squares, axis=0))
    return Residual(plain=plain, beside_matrix=beside)


def _improvement(before: Residual | None, after: Residual | None, most: float = _EXPLAINS) -> Improvement | None:
    """Residuals before and after a change that leaves at most a part of force or moment, and of neither more."""
    if before is None or after is None:
        return None
    pairs = [(before.plain, after.plain, False), (before.beside_matrix, after.beside_matrix, True)]
    helps = [
        Improvement(before=old, after=new, beside_matrix=beside)
        for old, new, beside in pairs
        if (new < most * old).any() and (new < _WORSENS * old).all()
    ]
    return min(helps, key=lambda one: float(np.prod(one.after / one.before)), default=None)


def _interval_proposal(file: Path, text: str, experiment: Experiment, runs: Sequence[SensorRun]) -> Proposal | None:
    used = [one for one in experiment.recording.intervals if one.use is not Use.IGNORE]
    if not used or any(one.support is None for one in used):
        return None
    free = free_time(runs)
    pieces = _pieces(experiment, free)
    if not free.spans or not any(pieces.values()):
        return None
    touched_ns = sum((one.end_ns - one.start_ns) - _shared_ns(one, free) for one in used)
    if touched_ns < _TOUCHED_S * 1e9 and not _lacks_validation(used):
        return None
    tables = tomllib.loads(text)["interval"]
    by_label = {one["label"]: _changes(one, pieces.get(one["label"], ()), experiment) for one in tables}
    edit = interval_edit(text, [by_label[one["label"]] for one in tables])
    if edit is None:
        return None
    changed = _loaded(file, edit.applied(text))
    if changed is None:
        return None
    own = [run for run in runs if run.sensor.name in free.sensors]
    after = _residual(_comparison(SensorRun(changed, run.sensor.name), run) for run in own)
    before = _residual(map(_comparison, own))
    improved = _improvement(before, after, _FREES)
    if after is None or (improved is None and not _lacks_validation(used)):
        return None
    start = experiment.recording.start_ns
    shown = ", ".join(
        f"{(first - start) * 1e-9:.1f}-{(last - start) * 1e-9:.1f} s {use}"
        for spans in pieces.values()
        for first, last, use in spans
    )
    by = f" for {', '.join(free.sensors)}" if free.left_out else ""
    what = "intervals free of contact" if improved else "no interval validates the fit; one of both uses"
    return Proposal(kind="interval", about="", text=f"{what}{by}: {shown}", edit=edit, residuals=improved)


def _lacks_validation(used: Sequence[Interval]) -> bool:
    """Whether one interval is all that is used, to fit: other recordings are seldom cut by it."""
    return [one.use for one in used] == [Use.CALIBRATION]


def _shared_ns(interval: Interval, free: FreeTime) -> int:
    return sum(max(0, min(interval.end_ns, b) - max(interval.start_ns, a)) for a, b in free.spans)


def _pieces(experiment: Experiment, free: FreeTime) -> dict[str, list[tuple[int, int, str]]]:
    """Free parts of every interval in use, with their use: that of the interval, or both where it is the only one."""
    used = [one for one in experiment.recording.intervals if one.use is not Use.IGNORE]
    spans = {
        one.label: [
            (max(a, one.start_ns), min(b, one.end_ns))
            for a, b in free.spans
            if min(b, one.end_ns) - max(a, one.start_ns) >= SHORTEST_S * 1e9
        ]
        for one in used
    }
    if not _lacks_validation(used):
        return {one.label: [(a, b, str(one.use)) for a, b in spans[one.label]] for one in used}
    owners = {span: label for label, own in spans.items() for span in own}
    pieces: dict[str, list[tuple[int, int, str]]] = {one.label: [] for one in used}
    for first, last, use in divided(sorted(owners)):
        owner = next(label for (a, b), label in owners.items() if a <= first and last <= b)
        pieces[owner].append((first, last, use))
    return pieces


def _changes(
    table: dict[str, object], pieces: Sequence[tuple[int, int, str]], experiment: Experiment
) -> list[dict[str, object]]:
    """Keys of the pieces of an interval; one without a free part is ignored, one that is ignored stays."""
    if table["use"] == Use.IGNORE:
        return [{}]
    if not pieces:
        return [{"use": str(Use.IGNORE)}]
    start = experiment.recording.start_ns
    label = table["label"]
    return [
        {
            "label": label if len(pieces) == 1 else f"{label} {number}",
            "start_s": float(np.ceil((first - start) * 1e-8) / 10.0),
            "end_s": float(np.floor((last - start) * 1e-8) / 10.0),
            "use": use,
        }
        for number, (first, last, use) in enumerate(pieces, start=1)
    ]


def _faults(file: Path, text: str, runs: Sequence[SensorRun]) -> Iterator[Proposal]:
    """Faults of every sensor, each once."""
    keys: set[tuple[str, str]] = set()
    for run in runs:
        comparison = _comparison(run)
        diagnosis = None if comparison is None else diagnosed(comparison)
        if comparison is None or diagnosis is None:
            continue
        before = _residual([comparison])
        tried = [_tried(file, text, comparison, one, before) for one in diagnosis.faults]
        for proposal in [one for one in tried if one.edit is not None] or tried[:1]:
            if proposal.key not in keys:
                keys.add(proposal.key)
                yield proposal


def _tried(file: Path, text: str, comparison: Comparison, fault: Explanation, before: Residual | None) -> Proposal:
    """The proposal that corrects a fault; without a change where the file cannot, or it does not help."""
    name = comparison.run.sensor.name
    about, words = _about(comparison, fault), f"{name}: {fault_text(comparison, fault)}"
    edit = _edit_of(text, comparison, fault)
    changed = None if edit is None else _loaded(file, edit.applied(text))
    after = None if changed is None else _residual([_comparison(SensorRun(changed, name))])
    improved = _improvement(before, after)
    if edit is None or improved is None:
        return Proposal(kind=fault.kind, about=about, text=f"{words}; {remedy(comparison, fault)}", edit=None)
    return Proposal(kind=fault.kind, about=about, text=words, edit=edit, residuals=improved)


def _about(comparison: Comparison, fault: Explanation) -> str:
    support = comparison.parts[0].interval.support
    if fault.kind == "gravity" and support is not None:
        return support.frame
    return fault.about or comparison.run.sensor.name


def _edit_of(text: str, comparison: Comparison, fault: Explanation) -> Edit | None:
    """The change of the file that corrects a fault; None where the file does not state what is wrong."""
    content, run = tomllib.loads(text), comparison.run
    sensors = [one.get("name") for one in content.get("sensor", ())]
    index = sensors.index(run.sensor.name) if run.sensor.name in sensors else None
    if index is None:
        return None
    if fault.kind == "gravity" and fault.vector is not None:
        return _gravity_edit(text, content, comparison, fault.vector)
    if fault.kind == "reversed":
        return _sense_edit(text, content, index)
    if fault.kind == "mount":
        return _mount_edit(text, run, index, fault.turn[:3, :3])
    if fault.kind == "delay" and fault.value is not None:
        return _delay_edit(text, content, run, fault)
    return None


def _gravity_edit(text: str, content: dict[str, object], comparison: Comparison, down: FloatArray) -> Edit | None:
    support = comparison.parts[0].interval.support
    tables = content.get("support", ())
    frames = [one.get("frame") for one in tables] if isinstance(tables, list) else []
    if not isinstance(support, Support) or support.frame not in frames:
        return None
    rounded = [float(value) for value in np.round(down, 4) + 0.0]
    return key_edit(text, "support", frames.index(support.frame), "gravity_direction", rounded)


def _sense_edit(text: str, content: dict[str, object], index: int) -> Edit | None:
    load, sensors = content.get("load"), content.get("sensor")
    stated = sensors[index] if isinstance(sensors, list) else {}
    place = ("sensor", index, stated) if "measure_direction" in stated else ("load", 0, load)
    table, number, values = place
    if not isinstance(values, dict) or "measure_direction" not in values:
        return None
    other = {one for one in MeasureDirection if one != values["measure_direction"]}
    return key_edit(text, table, number, "measure_direction", str(other.pop()))


def _mount_edit(text: str, run: SensorRun, index: int, turn: FloatArray) -> Edit | None:
    """`turn` takes components along the stated axes to those along the axes of the sensor: the inverse of its pose."""
    stated = run.experiment.mounts.get(run.sensor.name)
    rotation = np.eye(3) if stated is None else rotation_by(np.deg2rad(stated.rotation_deg))
    mount = SensorMount(
        rotation_deg=np.rad2deg(rotation_vector(rotation @ turn.T)),
        shift_mm=np.zeros(3) if stated is None else stated.shift_mm,
    )
    return key_edit(text, "sensor", index, "mount", tomllib.loads(mount.table)["mount"])


def _delay_edit(text: str, content: dict[str, object], run: SensorRun, fault: Explanation) -> Edit | None:
    holders = dict.fromkeys(stream.name for stream, _ in run.experiment.recording.joint_signals("position").values())
    late = fault.about or run.sensor.stream
    other = run.sensor.stream if fault.about else next(iter(holders), None)
    if other is None or other == late or fault.value is None:
        return None
    clocks = content.get("clock", [])
    for number, clock in enumerate(clocks if isinstance(clocks, list) else []):
        if late in (clock["stream"] if isinstance(clock["stream"], list) else [clock["stream"]]):
            known = clock["delay_s"]
            total = None if isinstance(known, str) else round(float(known) + fault.value, 4)
            return None if total is None else key_edit(text, "clock", number, "delay_s", total)
    return table_edit(text, "clock", {"stream": late, "to": other, "delay_s": round(fault.value, 4)}, before="sensor")
