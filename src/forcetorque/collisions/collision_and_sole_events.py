# SPDX-License-Identifier: BSD-3-Clause
"""Collisions, and what soles bear that the ground cannot do, as findings: events of viewers and of the report."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import get_args

from forcetorque.base.errors import ForceTorqueError
from forcetorque.collisions.collisions import collision_rows
from forcetorque.collisions.result import CollisionRow
from forcetorque.collisions.sensor_residual import WINDOW_S
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.residual_findings import UNEXPLAINED
from forcetorque.locomotion.answers import event_texts
from forcetorque.locomotion.section import SOLES, ExperimentSole
from forcetorque.locomotion.standing.foot_wrenches import balance_of_sensors
from forcetorque.locomotion.standing.interval_balance import BalanceOptions
from forcetorque.locomotion.standing.sole_limits import EventKind, SoleEventRow, sole_events
from forcetorque.recording.recording import Finding, Use
from forcetorque.results.number_text import plus_minus
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches
from forcetorque.robot.sub_models import sub_models
from forcetorque.robot.tree import build_tree


def events_on_soles(
    run: SensorRun, calibration: tuple[str, Calibration] | None, intervals: Collection[str]
) -> tuple[tuple[SoleEventRow, ...], tuple[str, ...]]:
    """Look for forces and moments on the soles beyond a sensor that these do not explain.

    Args:
        run: The sensor.
        calibration: Name and calibration that read it; its prior with the offset of the calibration intervals if None.
        intervals: Labels of the intervals to look at; all that are not ignored if there is none.

    Returns:
        Events, and why soles could not be tested, as text.
    """
    soles = soles_beyond(run)
    if not soles:
        return (), ()
    experiment = run.experiment
    chosen = [interval for _, interval in chosen_intervals([run], intervals)]
    alone = replace(
        experiment,
        sensors=(run.sensor,),
        recording=experiment.recording.with_intervals(chosen),
        sections={**experiment.sections, SOLES.key: soles},
    )
    # the offset is that of all calibration intervals, whatever is looked at
    source = replace(experiment, sensors=(run.sensor,))
    try:
        corrections = corrections_of(source, {} if calibration is None else dict([calibration]))
        if corrections[run.sensor.name].removes_offset:
            return tuple(_events(alone, corrections)), ()
        reason = "its offset is not known; give a calibration of this session"
    except ForceTorqueError as error:
        reason = str(error)
    names = ", ".join(entry.sole.frame for entry in soles)
    return (), (f"{run.sensor.name}: no test of what presses on {names}: {reason}",)


def _events(experiment: Experiment, corrections: Mapping[str, Correction]) -> Iterator[SoleEventRow]:
    options = BalanceOptions()
    for balance in balance_of_sensors(experiment, corrections, options):
        yield from sole_events(balance, release_N=options.thresholds(balance.weight_N).release_N)


def soles_beyond(run: SensorRun) -> tuple[ExperimentSole, ...]:
    """Name the soles whose events a sensor tells.

    Args:
        run: The sensor.

    Returns:
        Those with an outline or a friction between which and the sensor there is no other one.
    """
    experiment = run.experiment
    if not experiment.section(SOLES):
        return ()
    tree = build_tree(experiment.model, experiment.model.root_link)
    parts = sub_models(tree, [sensor.name for sensor in experiment.sensors])
    bodies = next((part.bodies for part in parts if part.sensor == run.sensor.name), ())
    return tuple(
        entry
        for entry in experiment.section(SOLES)
        if (entry.sole.outline is not None or entry.sole.has_friction) and tree.frames[entry.sole.frame][0] in bodies
    )


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
