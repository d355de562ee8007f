# SPDX-License-Identifier: BSD-3-Clause
"""Collisions as findings, which viewer, recordings for other viewers and report show as events."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import get_args

from forcetorque.base.errors import ForceTorqueError
from forcetorque.collisions.collisions import collision_rows
from forcetorque.collisions.residual import WINDOW_S
from forcetorque.collisions.result import CollisionRow
from forcetorque.collisions.soles import events_on_soles, soles_beyond
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.residual_findings import UNEXPLAINED
from forcetorque.locomotion.answers import event_texts
from forcetorque.locomotion.standing.sole_limits import EventKind
from forcetorque.recording.recording import Finding, Use
from forcetorque.results.number_text import plus_minus
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches

ALARMS_PER_HOUR = 1.0
"""Rate of false alarms that they are for, that of `robot collisions`."""
LONGEST_S = 1800.0
"""Time beyond which the search, which holds a few kilobytes for every 50 ms, is left to the command."""
_MARGIN_NS = 500_000_000
"""How far begin and end may differ by the smoothing of `inspect`; ns."""


def with_collisions(
    inspect: Callable[[], Sequence[Finding]], experiment: Experiment, calibrations: Mapping[str, Calibration]
) -> tuple[Finding, ...]:
    """Add collisions of every sensor, in place of the same by `inspect`, and what soles bear that the ground cannot do.

    Of a sensor without a look the reason is added.

    Args:
        inspect: Gives other findings, after the search, whose samples `inspect_experiment` need not compute again. Of
            these, what `inspect` cannot explain is left out where half of it or more lies in collisions of its sensor.
            A `step` stays beside a `new_level`, which may be that step.
        experiment: The experiment.
        calibrations: By what sensors are read, by their names; by prior or as logged without.

    Returns:
        All in the order of time, those without a time first.
    """
    collisions = list(_collisions(experiment, calibrations))
    on_links = [one for one in collisions if one.kind not in get_args(EventKind)]
    found = [*(one for one in inspect() if not _is_in(one, on_links)), *collisions]
    return tuple(sorted(found, key=lambda finding: finding.start_ns or 0))


def _is_in(finding: Finding, collisions: Sequence[Finding]) -> bool:
    if finding.kind not in UNEXPLAINED or finding.start_ns is None or finding.end_ns is None:
        return False
    overlaps_ns = [
        min(one.end_ns + _MARGIN_NS, finding.end_ns) - max(one.start_ns - _MARGIN_NS, finding.start_ns)
        for one in collisions
        if one.stream == finding.stream
        and finding.sensor in (None, one.sensor)
        and one.start_ns is not None
        and one.end_ns is not None
        and (one.kind, finding.kind) != ("new_level", "step")
    ]
    shared_ns = [overlap for overlap in overlaps_ns if overlap >= 0]
    return bool(shared_ns) and 2 * sum(shared_ns) >= finding.end_ns - finding.start_ns


def _collisions(experiment: Experiment, calibrations: Mapping[str, Calibration]) -> Iterator[Finding]:
    recording = experiment.recording
    watched_s = 1e-9 * sum(one.end_ns - one.start_ns for one in recording.intervals if one.use is not Use.IGNORE)
    if watched_s > LONGEST_S:
        soles: dict[str, list[str]] = {}
        for sensor in experiment.sensors:
            frames = [entry.sole.frame for entry in soles_beyond(SensorRun(experiment, sensor))]
            soles.setdefault(sensor.stream, []).extend(frames)
        for stream, frames in soles.items():
            text = f"no look for collisions in {watched_s:.0f} s, more than {LONGEST_S:g} s"
            text += "; see `robot collisions --interval`"
            if frames:
                text += f"; no test of what presses on {', '.join(frames)}; see `robot balance`"
            yield Finding(stream=stream, kind="not_compared", message=text, count=0)
        return
    shared = SharedWrenches(recording, {sensor.name: sensor.stream for sensor in experiment.sensors})
    for sensor in experiment.sensors:
        run = SensorRun(experiment, sensor, shared=shared)
        yield from _on_links(run, calibrations.get(sensor.name))
        yield from _on_soles(run, calibrations.get(sensor.name))


def _on_links(run: SensorRun, calibration: Calibration | None) -> Iterator[Finding]:
    start_ns, sensor = run.experiment.recording.start_ns, run.sensor
    try:
        rows = collision_rows(run, run.read_by(None, calibration).bare, ALARMS_PER_HOUR)
    except ForceTorqueError as error:
        text = f"no look for collisions: {error}"
        yield Finding(stream=sensor.stream, kind="not_compared", message=text, count=0, sensor=sensor.name)
        return
    for row in rows:
        yield Finding(
            stream=sensor.stream,
            kind=row.kind,
            message=_message(row),
            count=round((row.end_s - row.start_s) / WINDOW_S),
            start_ns=start_ns + round(row.start_s * 1e9),
            end_ns=start_ns + round(row.end_s * 1e9),
            size=row.force_N,
            unit="N",
            sensor=sensor.name,
        )


def _on_soles(run: SensorRun, calibration: Calibration | None) -> Iterator[Finding]:
    """What soles bear that the ground cannot do, where the file states their outline or friction."""
    start_ns, sensor = run.experiment.recording.start_ns, run.sensor
    try:
        events, untested = events_on_soles(run, None if calibration is None else ("", calibration), ())
    except ForceTorqueError as error:
        events, untested = (), (f"no look at what soles bear: {error}",)
    for text in untested:
        yield Finding(stream=sensor.stream, kind="not_compared", message=text, count=0, sensor=sensor.name)
    for event in events:
        (text,) = event_texts([event])
        yield Finding(
            stream=sensor.stream,
            kind=event.kind,
            message=f"{sensor.name}: {text}; see `robot balance`",
            count=1,
            start_ns=start_ns + round(event.start_s * 1e9),
            end_ns=start_ns + round(event.end_s * 1e9),
            sensor=sensor.name,
        )


def _message(row: CollisionRow) -> str:
    force = plus_minus(row.force_N, row.force_half_width_95_N, "N")
    new = "a new level: a contact, its end, or a step"
    what = new if row.kind == "new_level" else "which the file does not state"
    return f"{row.sensor}: {force} on {' or '.join((row.link, *row.other_links))}, {what}; see `robot collisions`"
