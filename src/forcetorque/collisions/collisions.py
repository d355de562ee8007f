# SPDX-License-Identifier: BSD-3-Clause
"""Detect, locate and identify contacts beyond a sensor that the experiment file does not state (thesis 2.5)."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.collisions.detection import (
    Contact,
    Detected,
    Threshold,
    detect,
    smallest_force,
    statistics_of,
    threshold_of,
)
from forcetorque.collisions.location import locate
from forcetorque.collisions.residual import WINDOW_S, FreeModel, Signals, changes_of, signals_of
from forcetorque.collisions.result import CollisionCurve, CollisionRow, Collisions, SensitivityRow
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval, Use

SHORT_S: Final = 0.5
"""Length below which a contact is a collision."""
_RATES: Final = (1e-6, 3600.0)
"""Rates of false alarms that a threshold can be set for; per hour."""
_LEAST_FREE_S: Final = 10.0
"""Time without contact below which noise is not known."""
_ENOUGH_FREE_S: Final = 60.0
"""Time without contact that shows how heavy the tail of the noise is."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Looked:
    """An interval that was looked at."""

    interval: Interval
    signals: Signals
    detected: Detected


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
            "touches the robot beyond it; it has none"
        )
    signals = {interval.label: signals_of(run, correction, interval) for interval in watched}
    learnt = [signals.get(one.label) or signals_of(run, correction, one) for one in _free(run, free)]
    model, threshold = _learnt(run, learnt, alarms_per_hour)
    looked = [
        _Looked(interval=one, signals=signals[one.label], detected=detect(signals[one.label], model, threshold.value))
        for one in watched
    ]
    rows = [
        _row(run, one, contact, model, threshold)
        for one in looked
        for contact in one.detected.contacts
        if contact.windows
    ]
    return Collisions(
        experiment=run.experiment.name,
        collisions=tuple(sorted(rows, key=lambda row: row.start_s)),
        sensitivity=(_sensitivity(run, looked, model, threshold),),
        curves=(_curve(run, looked),),
        warnings=tuple(_warnings(run, rows, threshold, [one.label for one in _free(run, free)])),
    )


def _require_rate(run: SensorRun) -> None:
    """Refuse a stream of which some windows have no sample."""
    period_s = float(np.median(np.diff(run.stream.stamp_ns))) * 1e-9 if len(run.stream) > 1 else np.inf
    if period_s > 1.01 * WINDOW_S:
        raise ExperimentError(
            f"sensor {run.sensor.name!r}: expected readings at {1.0 / WINDOW_S:g} Hz at least, for contacts are looked "
            f"for in windows of {WINDOW_S:g} s, got {1.0 / period_s:.3g} Hz; record it faster"
        )


def _learnt(run: SensorRun, free: Sequence[Signals], alarms_per_hour: float) -> tuple[FreeModel, Threshold]:
    """What is learnt from windows without contact."""
    changes = [changes_of(one) for one in free]
    residual = np.concatenate([one[0][one[2]] for one in changes])
    terms = np.concatenate([one[1][one[2]] for one in changes])
    free_s = len(residual) * WINDOW_S
    if free_s < _LEAST_FREE_S:
        raise ExperimentError(
            f"sensor {run.sensor.name!r}: expected at least {_LEAST_FREE_S:g} s in which nothing touches the robot "
            f"beyond it, got {free_s:.2g} s; name longer intervals by --free, from Python free"
        )
    model = FreeModel.of(residual, terms, np.max([one.unmodelled for one in free], axis=0))
    statistic = statistics_of(residual, terms, model)
    return model, threshold_of(statistic, model.correlation_s, alarms_per_hour=alarms_per_hour)


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


def _row(run: SensorRun, looked: _Looked, contact: Contact, model: FreeModel, threshold: Threshold) -> CollisionRow:
    strongest = contact.strongest
    at_s = looked.signals.time_s
    start_ns = run.experiment.recording.start_ns
    location = locate(
        run,
        looked.interval,
        start_ns + round(float(at_s[contact.windows[strongest]]) * 1e9),
        *model.contact(contact.wrenches[strongest], contact.covariances[strongest], looked.signals.of_load),
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


def _sensitivity(run: SensorRun, looked: Sequence[_Looked], model: FreeModel, threshold: Threshold) -> SensitivityRow:
    every = np.concatenate([_uncertainty(one.signals, model) for one in looked]) if looked else model.noise[None]
    return SensitivityRow(
        sensor=run.sensor.name,
        smallest_force_N=smallest_force(every, threshold.value),
        threshold=threshold.value,
        tail_decides=threshold.by_tail is not None and threshold.value <= threshold.by_tail,
        alarms_per_hour=threshold.alarms_per_hour,
        free_s=threshold.free_s,
        looked_at_s=sum(int(np.isfinite(one.detected.excess[:, 0]).sum()) for one in looked) * WINDOW_S,
    )


def _uncertainty(signals: Signals, model: FreeModel) -> FloatArray:
    """Covariance of what a sensor reads without a contact; shape (w, 6, 6)."""
    _, terms, known = changes_of(signals)
    own = terms[known]
    return model.noise + np.einsum("wip,pq,wjq->wij", own, model.covariance, own, optimize=True)


def _curve(run: SensorRun, looked: Sequence[_Looked]) -> CollisionCurve:
    rows = [np.column_stack([one.signals.time_s, np.linalg.norm(one.detected.excess[:, :3], axis=1)]) for one in looked]
    time_and_force = np.concatenate([*rows, np.zeros((0, 2))])
    known = time_and_force[np.isfinite(time_and_force[:, 1])]
    return CollisionCurve(sensor=run.sensor.name, time_s=known[:, 0], force_N=known[:, 1])


def _warnings(run: SensorRun, rows: Sequence[CollisionRow], threshold: Threshold, free: Sequence[str]) -> list[str]:
    warnings = []
    touched = [label for label in free if any(row.interval == label for row in rows)]
    if touched:
        warnings.append(
            f"{run.sensor.name}: contacts in {', '.join(touched)}, from which noise is learnt: what touches there is "
            "noticed less; name intervals without contact by --free"
        )
    if threshold.free_s < _ENOUGH_FREE_S:
        warnings.append(
            f"{run.sensor.name}: more false alarms may come: {threshold.free_s:.3g} s without contact do not show the "
            f"tail of the noise; name at least {_ENOUGH_FREE_S:g} s by --free"
        )
    return warnings
