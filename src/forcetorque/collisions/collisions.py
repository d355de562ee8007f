# SPDX-License-Identifier: BSD-3-Clause
"""Detect, locate and identify contacts beyond a sensor that the experiment file does not state (thesis 2.5)."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.collisions.contact_free_model import FreeChanges, matrix_errors
from forcetorque.collisions.detection import (
    Contact,
    Threshold,
    detect,
    noticed_square,
    smallest_force,
    statistics_of,
    threshold_of,
)
from forcetorque.collisions.location import locate, noticed_on_links
from forcetorque.collisions.result import CollisionCurve, CollisionRow, Collisions, LinkSensitivityRow, SensitivityRow
from forcetorque.collisions.sensor_residual import WARM_UP_S, WINDOW_S, Signals, changes_of, signals_of
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.inspection.residual_findings import UNEXPLAINED
from forcetorque.recording.recording import Interval, Use

SHORT_S: Final = 0.5
"""Length below which a contact is a collision."""
_RATES: Final = (1e-6, 3600.0)
"""Rates of false alarms that a threshold can be set for; per hour."""
_LEAST_FREE_S: Final = 10.0
"""Time without contact below which noise is not known."""
_ENOUGH_FREE_S: Final = 60.0
"""Time without contact that shows how heavy the tail of the noise is."""
_POSTURES: Final = 50
"""Windows of an interval that show what is noticed on which link."""
_MARGIN_S: Final = 0.5
"""Time before and after a contact in which noise and errors are not learnt."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Looked:
    """An interval that was looked at."""

    interval: Interval
    signals: Signals
    model: FreeChanges
    """What changes of the residual are without a contact, under the load of the interval."""
    contacts: tuple[Contact, ...]
    """Contacts in the order of time."""
    excess: FloatArray
    """What the sensor reads too much in every window, the level held during contacts; NaN while there is no level;
    shape (w, 6); N, N m."""
    covariances: FloatArray
    """Its covariance without a contact, of the k windows with a level; shape (k, 6, 6)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Search:
    """A search for contacts beyond a sensor."""

    run: SensorRun
    threshold: Threshold
    free: tuple[str, ...]
    """Labels of the intervals from which noise was learnt."""
    looked: tuple[_Looked, ...]
    """Intervals that were looked at, at least one."""
    short: tuple[str, ...]
    """Labels of those that are too short."""

    def rows(self) -> list[CollisionRow]:
        """Give the contacts in the order of time."""
        rows = [
            _row(self.run, one, contact, self.threshold)
            for one in self.looked
            for contact in one.contacts
            if contact.windows
        ]
        return sorted(rows, key=lambda row: row.start_s)


def find_collisions(
    run: SensorRun, correction: Correction, intervals: Collection[str], free: Collection[str], alarms_per_hour: float
) -> Collisions:
    """Look for contacts beyond a sensor.

    Args:
        run: The sensor.
        correction: How it is read; its offset does not matter.
        intervals: Labels of the intervals to look at; all that are not ignored if there is none.
        free: Labels of intervals in which nothing touches the robot beyond the sensor; those for calibration if there
            is none.
        alarms_per_hour: Rate of false alarms that the threshold is set for.

    Returns:
        Contacts, and what can be noticed.

    Raises:
        ExperimentError: If there is no interval to look at, too little time without contact, or the rate is not above
            0.
    """
    search = _searched(run, correction, intervals, free, alarms_per_hour)
    rows = search.rows()
    return Collisions(
        experiment=run.experiment.name,
        collisions=tuple(rows),
        sensitivity=(_sensitivity(run, search.looked, search.threshold),),
        by_link=tuple(_by_link(run, search.looked, search.threshold)),
        curves=(_curve(run, search.looked),),
        warnings=tuple(_warnings(search, rows)),
    )


def collision_rows(run: SensorRun, correction: Correction, alarms_per_hour: float) -> Sequence[CollisionRow]:
    """Give the contacts of `find_collisions` in all intervals, without what can be noticed, which takes longer.

    Args:
        run: The sensor.
        correction: As of `find_collisions`.
        alarms_per_hour: As of `find_collisions`.

    Returns:
        Contacts in the order of time.

    Raises:
        ExperimentError: As of `find_collisions`.
    """
    return _searched(run, correction, (), (), alarms_per_hour).rows()


def _searched(
    run: SensorRun, correction: Correction, intervals: Collection[str], free: Collection[str], alarms_per_hour: float
) -> _Search:
    if not _RATES[0] <= alarms_per_hour <= _RATES[1]:
        raise ExperimentError(
            f"alarms per hour: expected a number from {_RATES[0]:g} to {_RATES[1]:g}, got {alarms_per_hour:g}"
        )
    _require_rate(run)
    watched = [
        interval
        for _, interval in chosen_intervals([run], intervals)
        if interval.support is not None and not run.touched_beyond(interval)
    ]
    if not watched:
        raise ExperimentError(
            f"sensor {run.sensor.name!r}: expected an interval with a support in which nothing that the file states "
            "touches the robot beyond it; it has none; what soles bear that the ground cannot do: `robot balance`"
        )
    learnt = _free(run, free)
    needed = {one.label: one for one in (*watched, *learnt)}
    signals = {label: signals_of(run, correction, one) for label, one in needed.items()}
    names = tuple(dict.fromkeys(name for one in signals.values() for name in one.of_model))
    signals = {label: one.with_terms(names) for label, one in signals.items()}
    model, threshold = _learnt(run, correction, [signals[one.label] for one in learnt], alarms_per_hour)
    every = [_looked(one, signals[one.label], model, threshold) for one in watched]
    looked = [one for one in every if len(one.covariances)]
    short = [one.interval.label for one in every if not len(one.covariances)]
    if not looked:
        lengths = ", ".join(f"{one.label!r} of {1e-9 * (one.end_ns - one.start_ns):.2g} s" for one in watched)
        raise ExperimentError(
            f"sensor {run.sensor.name!r}: expected an interval with more than {WARM_UP_S:g} s of readings in a "
            f"row, in which the level is found first, got {lengths}; name another by --interval, from Python intervals"
        )
    return _Search(
        run=run, threshold=threshold, free=tuple(one.label for one in learnt), looked=tuple(looked), short=tuple(short)
    )


def _looked(interval: Interval, signals: Signals, model: FreeChanges, threshold: Threshold) -> _Looked:
    loaded = model.under_load(signals.unmodelled)
    contacts, excess, covariances = detect(signals, loaded, threshold.value)
    return _Looked(
        interval=interval, signals=signals, model=loaded, contacts=contacts, excess=excess, covariances=covariances
    )


def _require_rate(run: SensorRun) -> None:
    """Refuse a stream of which some windows have no sample."""
    period_s = float(np.median(np.diff(run.stream.stamp_ns))) * 1e-9 if len(run.stream) > 1 else np.inf
    if period_s > 1.01 * WINDOW_S:
        raise ExperimentError(
            f"sensor {run.sensor.name!r}: expected readings at {1.0 / WINDOW_S:g} Hz at least, for contacts are looked "
            f"for in windows of {WINDOW_S:g} s, got {1.0 / period_s:.3g} Hz; record it faster"
        )


def _learnt(
    run: SensorRun, correction: Correction, free: Sequence[Signals], alarms_per_hour: float
) -> tuple[FreeChanges, Threshold]:
    """What is learnt from windows without contact."""
    changes = changes_of(_untouched(run, free))
    free_s = len(changes) * WINDOW_S
    if free_s < _LEAST_FREE_S:
        raise ExperimentError(
            f"sensor {run.sensor.name!r}: expected at least {_LEAST_FREE_S:g} s in which nothing touches the robot "
            f"beyond it, got {free_s:.2g} s; name longer intervals by --free, from Python free"
        )
    unmodelled = np.max([one.unmodelled for one in free], axis=0)
    model = FreeChanges.of(changes, unmodelled, matrix_errors(run, correction.model.matrix))
    statistic = statistics_of(changes, model)
    return model, threshold_of(statistic, model.free.correlation_s, alarms_per_hour=alarms_per_hour)


def _untouched(run: SensorRun, free: Sequence[Signals]) -> Sequence[Signals]:
    """Windows without what `inspect` finds unexplained, which needs no free interval; all if a minute is not left."""
    start_ns = run.experiment.recording.start_ns
    found = inspect_experiment(run.experiment, with_causes=False, sensors=[run.sensor.name], computed=run)
    spans = [
        (one.start_ns - start_ns, one.end_ns - start_ns)
        for one in found
        if one.kind in UNEXPLAINED and one.start_ns is not None and one.end_ns is not None
    ]
    kept = []
    for one in free:
        marks = np.ones(len(one), dtype=np.bool_)
        for first, last in spans:
            marks &= (one.time_s < 1e-9 * first - _MARGIN_S) | (one.time_s > 1e-9 * last + _MARGIN_S)
        kept.append(one.kept(marks))
    return kept if sum(map(len, kept)) * WINDOW_S >= _ENOUGH_FREE_S else free


def _free(run: SensorRun, labels: Collection[str]) -> list[Interval]:
    """Intervals without contact: those that are named, else those for calibration."""
    chosen = [one for _, one in chosen_intervals([run], labels)] if labels else list(run.intervals(Use.CALIBRATION))
    known = [one for one in chosen if one.support is not None and not run.touched_beyond(one)]
    if not known:
        raise ExperimentError(
            f"sensor {run.sensor.name!r}: expected an interval in which nothing touches the robot beyond it, from "
            "which noise and errors of the model are learnt; name one by --free, from Python free"
        )
    return known


def _row(run: SensorRun, looked: _Looked, contact: Contact, threshold: Threshold) -> CollisionRow:
    strongest = contact.strongest
    at_s = looked.signals.time_s
    start_ns = run.experiment.recording.start_ns
    location = locate(
        run,
        looked.interval,
        start_ns + round(float(at_s[contact.windows[strongest]]) * 1e9),
        *looked.model.contact(contact.wrenches[strongest], contact.covariances[strongest]),
    )
    force = float(np.linalg.norm(location.wrench[:3]))
    first, last = float(at_s[contact.windows[0]]), float(at_s[contact.windows[-1]])
    sizes = np.linalg.norm(np.array(contact.wrenches)[:, :3], axis=1)
    x, y, z = (location.wrench[:3] / force).tolist()
    return CollisionRow(
        sensor=run.sensor.name,
        interval=looked.interval.label,
        kind=_kind(contact, last - first),
        start_s=first - 0.5 * WINDOW_S,
        end_s=last + 0.5 * WINDOW_S,
        force_N=force,
        force_half_width_95_N=location.force_half_width_95_N,
        direction=(x, y, z),
        frame=looked.interval.support.frame if looked.interval.support is not None else "",
        impulse_Ns=float(sizes.sum() * WINDOW_S),
        couple_Nm=location.couple_Nm,
        couple_half_width_95_Nm=location.couple_half_width_95_Nm,
        link=location.link,
        other_links=location.others,
        distance_mm=1e3 * location.distance_m,
        distance_half_width_95_mm=1e3 * location.distance_half_width_95_m,
        point_mm=tuple((1e3 * location.point).tolist()),
        over_threshold=max(contact.statistics) / threshold.value,
    )


def _kind(contact: Contact, duration_s: float) -> Literal["collision", "contact", "new_level"]:
    if contact.stays:
        return "new_level"
    return "collision" if duration_s < SHORT_S else "contact"


def _sensitivity(run: SensorRun, looked: Sequence[_Looked], threshold: Threshold) -> SensitivityRow:
    covariances = [one.covariances for one in looked]
    return SensitivityRow(
        sensor=run.sensor.name,
        smallest_force_N=max(smallest_force(one, threshold.value) for one in covariances),
        threshold=threshold.value,
        tail_decides=threshold.by_tail is not None and threshold.value <= threshold.by_tail,
        alarms_per_hour=threshold.alarms_per_hour,
        free_s=threshold.free_s,
        looked_at_s=sum(map(len, covariances)) * WINDOW_S,
    )


def _by_link(run: SensorRun, looked: Sequence[_Looked], threshold: Threshold) -> Iterator[LinkSensitivityRow]:
    square = noticed_square(threshold.value)
    forces: dict[str, float] = {}
    for one in looked:
        every = max(len(one.covariances) // _POSTURES, 1)
        at_s = one.signals.time_s[np.isfinite(one.excess[:, 0])][::every]
        at_ns: IntArray = run.experiment.recording.start_ns + np.round(at_s * 1e9).astype(np.int64)
        covariances = one.covariances[::every]
        for link, values in noticed_on_links(run, one.interval, at_ns, covariances, square).items():
            forces[link] = max(float(np.median(values)), forces.get(link, 0.0))
    for link, force in forces.items():
        yield LinkSensitivityRow(sensor=run.sensor.name, link=link, smallest_force_N=force)


def _curve(run: SensorRun, looked: Sequence[_Looked]) -> CollisionCurve:
    rows = [np.column_stack([one.signals.time_s, np.linalg.norm(one.excess[:, :3], axis=1)]) for one in looked]
    time_and_force = np.concatenate([*rows, np.zeros((0, 2))])
    known = time_and_force[np.isfinite(time_and_force[:, 1])]
    return CollisionCurve(sensor=run.sensor.name, time_s=known[:, 0], force_N=known[:, 1])


def _warnings(search: _Search, rows: Sequence[CollisionRow]) -> list[str]:
    name, threshold, warnings = search.run.sensor.name, search.threshold, []
    if search.short:
        warnings.append(
            f"{name}: not looked at: {', '.join(search.short)}, with at most {WARM_UP_S:g} s of readings in a "
            "row, in which the level is found first"
        )
    touched = [label for label in search.free if any(row.interval == label for row in rows)]
    if touched:
        warnings.append(
            f"{name}: contacts in {', '.join(touched)}, from which noise is learnt: what touches there is "
            "noticed less; name intervals without contact by --free"
        )
    if threshold.free_s < _ENOUGH_FREE_S:
        warnings.append(
            f"{name}: more false alarms may come: {threshold.free_s:.3g} s without contact do not show the "
            f"tail of the noise; name at least {_ENOUGH_FREE_S:g} s by --free"
        )
    return warnings
