# SPDX-License-Identifier: BSD-3-Clause
"""Columns of a log over an interval, and what `balance` makes of it; the signals of all measures of motion."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import ExperimentError, RecordingError, UnitError, require_known
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.intervals import RecordedSpan
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.recording_notes import added_to
from forcetorque.experiment.robot_and_streams import RecordedLog, load_recorded
from forcetorque.locomotion.section import SOLES
from forcetorque.locomotion.standing.balance import Balance, balance
from forcetorque.locomotion.standing.foot_wrenches import has_foot_forces, load_foot_forces
from forcetorque.recording.alignment import require_overlap, seconds_since, usable_samples
from forcetorque.recording.named_columns import column_units, find_column, known_columns
from forcetorque.recording.recording import Use

_POINTS = ("cop", "zmp", "com", "com_acceleration")
"""What begins the names of columns that `balance` may refuse to compute."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MotionSignal(ArrayRecord):
    """One column over one interval, and what was wanted of it."""

    interval: str
    """Label of the interval, with the recording where there are several."""
    column: str
    """Name of the column."""
    unit: str
    """Its unit."""
    time_s: FloatArray = field(metadata=array("n"))
    """Instants, from the start of the recording; shape (n,); s."""
    values: FloatArray = field(metadata=array("n"))
    """Samples; shape (n,); NaN where there is none."""
    desired: str | None = None
    """Name of the column of what was wanted; None if nothing was."""
    desired_values: FloatArray | None = field(default=None, metadata=array("n"))
    """What was wanted at those instants; shape (n,)."""
    added: tuple[str, ...] = ()
    """What the experiment file adds to the log, in sentences."""

    @property
    def name(self) -> str:
        """What it is, for messages."""
        return f"{self.interval}: {self.column}"


def motion_signals_of_arrays(
    time_s: Any,
    columns: Mapping[str, Any],
    units: Mapping[str, str],
    *,
    desired: Mapping[str, Any] | None = None,
) -> list[MotionSignal]:
    """Make signals of arrays, such as columns of a data frame or of a simulation.

    Args:
        time_s: Instants; shape (n,); s.
        columns: Samples by name; shape (n,) each.
        units: Unit of each.
        desired: What was wanted of some of them, by their names; shape (n,) each.

    Returns:
        A signal for each column.

    Raises:
        UnitError: If one has no unit.
        ExperimentError: If something was wanted of a column that is not there.
    """
    for name in columns:
        if name not in units:
            raise UnitError(f"column {name!r}: expected its unit, got none; units are never guessed")
    wanted = {} if desired is None else dict(desired)
    for name in wanted:
        require_known(name, columns, ExperimentError, f"desired: no column {name!r}")
    return [
        MotionSignal(
            interval="arrays",
            column=name,
            unit=units[name],
            time_s=time_s,
            values=values,
            desired=f"desired {name}" if name in wanted else None,
            desired_values=wanted.get(name),
        )
        for name, values in columns.items()
    ]


def motion_signals(
    path: Path | str,
    columns: Sequence[str],
    *,
    desired: Sequence[str] = (),
    intervals: Collection[str] = (),
    calibrations: Mapping[str, Calibration] | None = None,
) -> list[MotionSignal]:
    """Read columns of a log or of an experiment, and columns that `balance` computes from it.

    Args:
        path: Experiment file, with or without sensors, or a log that is recognised.
        columns: Names: `column`, `stream.column` or `stream.quantity.column` of the log; or, of an experiment with
            soles, a column of `balance`, such as `com.y`, `zmp.x` or `share.l_sole`.
        desired: Columns of the log with what was wanted, one for each of the first; none if nothing was.
        intervals: Labels of the intervals that are taken; all that are not to be ignored if none is named.
        calibrations: Calibrations that read the sensors for `balance`, by name.

    Returns:
        A signal for each interval and column.

    Raises:
        RecordingError: If there is no such column, or several are meant.
        ExperimentError: If there is no such interval, no column that is computed, or not one desired column for each.
        UnitError: If a column and what was wanted of it have different units.
    """
    log = load_recorded(path)
    if not columns:
        raise ExperimentError(f"{path}: expected a column, got none; {known_columns('', column_units(log.recording))}")
    if desired and len(desired) != len(columns):
        raise ExperimentError(
            f"desired: expected a column for each of {', '.join(columns)}, or none, got {', '.join(desired)}"
        )
    spans = _chosen(log, intervals)
    pairs = zip_longest(columns, desired)
    computed: Balance | None = None
    signals: list[MotionSignal] = []
    for column, wanted in pairs:
        try:
            find_column(log.recording, column)
        except RecordingError:
            if not _has_soles(path):
                raise
            computed = computed or _balance(path, calibrations or {})
            signals += _computed(computed, log, spans, column, wanted)
            continue
        signals += [_logged(log, span, column, wanted) for span in spans]
    return [replace(signal, added=added_to(log.recording)) for signal in signals]


def _chosen(log: RecordedLog, labels: Collection[str]) -> list[RecordedSpan]:
    known = [span.label for span in log.intervals]
    for label in labels:
        require_known(label, known, ExperimentError, f"no interval is labelled {label!r}")
    spans = [span for span in log.intervals if (span.label in labels if labels else span.use is not Use.IGNORE)]
    if not spans:
        raise ExperimentError(
            f"{log.name}: expected an interval that is not to be ignored; name one by --interval, from Python intervals"
        )
    return spans


def _logged(log: RecordedLog, span: RecordedSpan, column: str, desired: str | None) -> MotionSignal:
    source = find_column(log.recording, column)
    stream = log.recording.stream(source.stream)
    usable = usable_samples(stream.stamp_ns)
    usable = usable[span.holds(stream.stamp_ns[usable])]
    at_ns = stream.stamp_ns[usable]
    return MotionSignal(
        interval=span.label,
        column=column,
        unit=source.unit(log.recording),
        time_s=seconds_since(at_ns, log.recording.start_ns),
        values=stream.signal(source.quantity).column(source.column)[usable],
        desired=desired,
        desired_values=_desired(log, desired, at_ns, column, source.unit(log.recording), source.stream),
    )


def _desired(
    log: RecordedLog, desired: str | None, at_ns: Any, column: str, unit: str, stream: str | None
) -> FloatArray | None:
    if desired is None:
        return None
    source = find_column(log.recording, desired)
    if source.unit(log.recording) != unit:
        raise UnitError(
            f"desired {desired!r}: expected {unit}, the unit of {column!r}, got {source.unit(log.recording)}; "
            "convert one of them when reading"
        )
    if stream is not None:
        require_overlap(log.recording.stream(stream), log.recording.stream(source.stream))
    return source.at(log.recording, at_ns)


def _has_soles(path: Path | str) -> bool:
    return Path(path).suffix == ".toml" and bool(parse_experiment(path).table(SOLES))


def _balance(path: Path | str, calibrations: Mapping[str, Calibration]) -> Balance:
    if has_foot_forces(path):
        return balance([load_foot_forces(path)])
    experiment = load_experiment(path)
    return balance([experiment], [corrections_of(experiment, calibrations)])


def _computed(
    computed: Balance, log: RecordedLog, spans: Sequence[RecordedSpan], column: str, desired: str | None
) -> Iterator[MotionSignal]:
    by_label = {interval.label: interval for interval in computed.intervals}
    for span in spans:
        if span.label not in by_label:
            raise ExperimentError(f"interval {span.label!r}: {column!r} is computed only where it is not to be ignored")
        interval = by_label[span.label]
        columns = {name: (unit, values) for name, unit, values in interval.columns()}
        if column not in columns:
            known = column_units(log.recording) | {name: unit for name, (unit, _) in columns.items()}
            untold = "".join(f"{words}; " for words in interval.refused if column.split(".")[0] in _POINTS)
            raise ExperimentError(
                f"interval {span.label!r}: no column {column!r}; {untold}{known_columns(column, known)}"
            )
        unit, values = columns[column]
        yield MotionSignal(
            interval=span.label,
            column=column,
            unit=unit,
            time_s=interval.time_s,
            values=np.asarray(values, dtype=np.float64),
            desired=desired,
            desired_values=_desired(log, desired, interval.stamp_ns, column, unit, None),
        )
