# SPDX-License-Identifier: BSD-3-Clause
"""Changes of an answered experiment file that the recording speaks for, each tried before it is proposed.

A change is written to a copy of the file, which is read as any other; it is proposed if less of the measured wrench
stays unexplained then, and not more of that of any other sensor. That finds no wrong sign where two changes leave the
same, as the sense of a sensor and the direction of gravity do in held poses: these are named, and a person chooses.
"""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import temporary_beside
from forcetorque.base.run_files import files_of_one_run
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.intervals import with_intervals_of_files
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison_with_model import Comparison, compared
from forcetorque.inspection.diagnosis import diagnosed, fault_text, remedy
from forcetorque.inspection.draft.fault_corrections import correction_of
from forcetorque.inspection.draft.gravity_fit import SHORTEST_S
from forcetorque.inspection.draft.intervals_and_clocks import (
    NOT_ENOUGH_MOTION,
    FreeTime,
    MovingLoad,
    divided,
    free_time,
)
from forcetorque.inspection.draft.toml_edits import Edit, interval_edit
from forcetorque.inspection.draft.toml_lines import line, tables_of, text_of, write_text_of
from forcetorque.inspection.findings import whole_log_samples
from forcetorque.inspection.plausibility.evidence import Evidence
from forcetorque.inspection.plausibility.fault_hypotheses import Explanation
from forcetorque.recording.recording import Interval, Use

EXPLAINS: Final = 0.8
"""Part of the residual of force or moment that is left at most by a change that is proposed."""
_WORSENS: Final = 1.2
"""Part of the residual of force or moment that is left at most by any change."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Residual:
    """What the expected wrench leaves of the measured one in intervals in use, the offset taken out."""

    plain: FloatArray
    """Root mean square of force and moment; shape (2,); N, N m."""
    beside_matrix: FloatArray
    """The same beside likely errors of the prior matrix; shape (2,); N, N m."""

    @classmethod
    def of(cls, comparisons: Iterable[Comparison | None]) -> Residual | None:
        """Compute the residual of sensors together.

        Args:
            comparisons: Of each sensor; None where it cannot be compared.

        Returns:
            The residual; None where one cannot be compared, or there is none.
        """
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
        return cls(plain=plain, beside_matrix=beside)

    def is_worse_than(self, other: Residual) -> bool:
        """Compare with another residual of the same sensors.

        Returns:
            Whether force or moment has clearly more, by the matrix as it is or beside its errors.
        """
        pairs = ((self.plain, other.plain), (self.beside_matrix, other.beside_matrix))
        return any(bool((own > _WORSENS * less).any()) for own, less in pairs)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Improvement:
    """Residuals of a file as it is, and with a change."""

    before: FloatArray
    """Residual force and moment of the file as it is; shape (2,); N, N m."""
    after: FloatArray
    """The same with the change; shape (2,); N, N m."""
    beside_matrix: bool
    """Whether likely errors of the prior matrix are taken out of both."""

    @classmethod
    def between(cls, before: Residual | None, after: Residual | None, most: float = EXPLAINS) -> Improvement | None:
        """Compare the residuals before and after a change.

        Args:
            before: Residual of the file as it is.
            after: Residual with the change.
            most: Part of the residual of force or moment that is left at most.

        Returns:
            Both; None where more of force and moment is left, or clearly more of one than before.
        """
        if before is None or after is None:
            return None
        pairs = [(before.plain, after.plain, False), (before.beside_matrix, after.beside_matrix, True)]
        helps = [
            cls(before=old, after=new, beside_matrix=beside)
            for old, new, beside in pairs
            if (new < most * old).any() and (new < _WORSENS * old).all()
        ]
        return min(helps, key=lambda one: float(np.prod(one.after / one.before)), default=None)

    @property
    def text(self) -> str:
        """Both residuals."""
        beside = " beside errors of the matrix" if self.beside_matrix else ""
        (force, moment), (new_force, new_moment) = self.before, self.after
        return f"residual{beside} {force:.2g} -> {new_force:.2g} N, {moment:.2g} -> {new_moment:.2g} N m"


def experiment_of(file: Path, content: Mapping[str, Any]) -> Experiment | None:
    """Read an experiment file with another content.

    Args:
        file: The file, from whose folder paths count; it stays as it is.
        content: Its tables.

    Returns:
        The experiment; None where it cannot be read.
    """
    with temporary_beside(file) as copy:
        copy.write_text("".join(f"{line(key, value)}\n" for key, value in content.items()), encoding="utf-8")
        try:
            return load_experiment(copy)
        except ForceTorqueError:
            return None


def comparison_of(run: SensorRun, samples_of: SensorRun | None = None) -> Comparison | None:
    """Compare a sensor with the robot model.

    Args:
        run: The sensor.
        samples_of: Run of the same recording whose samples of the whole log are taken; the run itself if None.

    Returns:
        The comparison; None where the sensor cannot be compared.
    """
    correction = run.read_by(None, None).bare
    try:
        return compared(run, correction, whole=whole_log_samples(samples_of or run, correction))
    except ForceTorqueError:
        return None


_FREES: Final = 0.5
"""Part of the residual of force or moment that is left at most by intervals that are proposed: shorter ones have
smaller errors of the robot model too."""
_TOUCHED_S: Final = 0.5
"""Time of intervals in which something touches, from which on other intervals are proposed; s."""
_OFFERS: Final = 2
"""How often one thing is proposed, since other changes may change it."""


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
    text = text_of(file)
    content = tomllib.loads(text)
    if tables_of(content, "patch") and not tables_of(content, "sensor"):
        return ()  # of skin alone nothing is proposed
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

    Nothing is written where another program changed the file since it was read: a proposal is then made again.

    Args:
        file: The file, which is rewritten.
        accepts: Shows a proposal, and gives whether it is accepted.

    Returns:
        What was declined, or is to be changed by hand.
    """
    offers: Counter[tuple[str, str]] = Counter()
    left: dict[tuple[str, str], Proposal] = {}
    changed = ""
    while True:
        settled = {*left, *(key for key, count in offers.items() if count >= _OFFERS)}
        text = text_of(file)
        with files_of_one_run():  # the file is rewritten, so that it is no input of what goes on after this
            proposal = next(iter(proposals(file, settled)), None)
        if proposal is None:
            return tuple(left.values())
        offers[proposal.key] += 1
        if proposal.edit is None or not accepts(f"{changed}{proposal.sentence}"):
            left[proposal.key] = proposal
        elif text_of(file) == text:
            write_text_of(file, proposal.edit.applied(text))
            changed = ""
        else:
            changed = f"{file}: was changed meanwhile, nothing was written\n"
            if offers[proposal.key] >= _OFFERS:
                left[proposal.key] = proposal


def _interval_proposal(file: Path, text: str, experiment: Experiment, runs: Sequence[SensorRun]) -> Proposal | None:
    used = [one for one in experiment.recording.intervals if one.use is not Use.IGNORE]
    if not used or any(one.support is None for one in used):
        return None
    free = free_time(runs)
    own = [run for run in runs if run.sensor.name in free.sensors]
    compared = [one for one in map(comparison_of, own) if one is not None]
    loads = [MovingLoad(stamp_ns=one.at_ns, load=one.expected) for one in compared]
    pieces = _pieces(experiment, free, loads)
    if not free.spans or not any(pieces.values()):
        return None
    touched_ns = sum((one.end_ns - one.start_ns) - _shared_ns(one, free) for one in used)
    if touched_ns < _TOUCHED_S * 1e9 and not _lacks_validation(used):
        return None
    content = tomllib.loads(text)
    parsed = parse_experiment(file)
    cut = with_intervals_of_files(parsed, file, experiment.recording)
    tables = tables_of(content, "interval")
    if cut is not parsed:  # each file has its own parts free of contact
        tables = [one.model_dump(mode="json", exclude_unset=True, exclude_none=True) for one in cut.interval]
    changes = [_changes(one, pieces.get(one["label"], ()), experiment) for one in tables]
    content["interval"] = [{**one, **change} for one, own in zip(tables, changes, strict=True) for change in own]
    changed = experiment_of(file, content)
    if changed is None:
        return None
    after = Residual.of(comparison_of(SensorRun(changed, run.sensor.name), run) for run in own)
    before = Residual.of(compared)
    improved = Improvement.between(before, after, _FREES)
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
    edit = interval_edit(text, changes) if cut is parsed else None
    edit = edit if edit is not None and edit.results_in(content, text) else None
    flat = [piece for own_pieces in pieces.values() for piece in own_pieces]
    if _lacks_validation(used) and not all(load.moves(flat) for load in loads):
        shown += f"; {NOT_ENOUGH_MOTION}"
    hand = "" if edit is not None else "; write label, start_s, end_s and use of each in interval by hand"
    return Proposal(kind="interval", about="", text=f"{what}{by}: {shown}{hand}", edit=edit, residuals=improved)


def _lacks_validation(used: Sequence[Interval]) -> bool:
    """Whether one interval is all that is used, to fit: other recordings are seldom cut by it."""
    return [one.use for one in used] == [Use.CALIBRATION]


def _shared_ns(interval: Interval, free: FreeTime) -> int:
    return sum(max(0, min(interval.end_ns, b) - max(interval.start_ns, a)) for a, b in free.spans)


def _pieces(
    experiment: Experiment, free: FreeTime, loads: Sequence[MovingLoad]
) -> dict[str, list[tuple[int, int, str]]]:
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
    for first, last, use in divided(sorted(owners), loads):
        owner = next(label for (a, b), label in owners.items() if a <= first and last <= b)
        pieces[owner].append((first, last, use))
    return pieces


def _changes(
    table: Mapping[str, object], pieces: Sequence[tuple[int, int, str]], experiment: Experiment
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Trial:
    """A fault, and what its correction does to the residuals."""

    proposal: Proposal
    """What is proposed if no other fault explains the measurements alike; the change is what was tried."""
    cause: str
    """What is wrong."""
    step: str
    """The change, or what to do by hand."""
    worsens: str
    """How the correction increases residuals of other sensors; empty if it does not."""


def _faults(file: Path, text: str, runs: Sequence[SensorRun]) -> Iterator[Proposal]:
    """Faults of every sensor, each once."""
    keys: set[tuple[str, str]] = set()
    comparisons = [one for one in map(comparison_of, runs) if one is not None]
    for comparison in comparisons:
        diagnosis = diagnosed(comparison)
        trials: dict[tuple[str, str], _Trial] = {}
        for fault in () if diagnosis is None else diagnosis.faults:
            key = fault.kind, _about(comparison, fault)
            if key not in trials:
                trials[key] = _tried(file, text, comparison, fault, comparisons)
        if trials and (proposal := _proposal(comparison, list(trials.values()))).key not in keys:
            keys.add(proposal.key)
            yield proposal


def _proposal(comparison: Comparison, trials: Sequence[_Trial]) -> Proposal:
    """The correction of the only fault that makes no sensor worse; else no change, since the log does not choose."""
    possible = [one for one in trials if not one.worsens]
    if len(possible) == 1:
        return possible[0].proposal
    first, name = trials[0].proposal, comparison.run.sensor.name
    if not possible:
        words = f"{name}: {trials[0].cause}; no correction is proposed, since it {trials[0].worsens}"
        return replace(first, text=words, edit=None, residuals=None)
    choices = ", or ".join(f"{one.cause} ({one.step})" for one in possible)
    words = f"{name}: {choices}: the log does not separate these; correct by hand the one that is wrong"
    return Proposal(kind=possible[0].proposal.kind, about=name, text=words, edit=None)


def _tried(
    file: Path, text: str, comparison: Comparison, fault: Explanation, comparisons: Sequence[Comparison]
) -> _Trial:
    """Correct a fault in a copy of the file: of its sensor, and of all others that the change reaches."""
    name, about = comparison.run.sensor.name, _about(comparison, fault)
    content, cause = tomllib.loads(text), fault_text(comparison, fault)
    correction = correction_of(content, comparison, fault)
    changed = None if correction is None else experiment_of(file, correction.content(content, correction.tried))
    improved, worse = None, []
    for one in comparisons if changed is not None and correction is not None and correction.is_shared else [comparison]:
        before = Residual.of([one])
        after = None if changed is None else Residual.of([comparison_of(SensorRun(changed, one.run.sensor.name))])
        if one is comparison:
            improved = Improvement.between(before, after)
        elif before is not None and (after is None or after.is_worse_than(before)):
            worse.append(_worsening(one.run.sensor.name, before, after))
    edit = None if correction is None or improved is None else correction.edit(text, content)
    if correction is None or improved is None:
        step = remedy(comparison, fault)
    else:
        cause = correction.cause or cause
        step = f"{correction.by_hand} by hand" if edit is None else edit.text
    words = f"{name}: {cause}; {step}" if edit is None else f"{name}: {cause}"
    proposal = Proposal(kind=fault.kind, about=about, text=words, edit=edit, residuals=improved)
    return _Trial(proposal=proposal, cause=cause, step=step, worsens=", and ".join(worse))


def _worsening(name: str, before: Residual, after: Residual | None) -> str:
    if after is None:
        return f"leaves {name!r} without a comparison"
    (force, moment), (new_force, new_moment) = before.plain, after.plain
    return f"worsens {name!r}: residual {force:.2g} -> {new_force:.2g} N, {moment:.2g} -> {new_moment:.2g} N m"


def _about(comparison: Comparison, fault: Explanation) -> str:
    support = comparison.parts[0].interval.support
    if fault.kind == "gravity" and support is not None:
        return support.frame
    return fault.about or comparison.run.sensor.name
