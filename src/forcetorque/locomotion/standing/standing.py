# SPDX-License-Identifier: BSD-3-Clause
"""How a robot stands: support phases, centre of pressure, zero moment point and centre of mass (thesis 5.6)."""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.errors import ExperimentError
from forcetorque.base.output_file import refuse_output
from forcetorque.experiment.additions import with_recording_notes
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.formats.sample_table import SampleSpan, write_samples
from forcetorque.locomotion.standing.foot_wrenches import FootForces, balance_of_forces, balance_of_sensors
from forcetorque.locomotion.standing.ground_wrenches_by_motion import balance_by_motion, unused_forces
from forcetorque.locomotion.standing.interval_balance import BalanceOptions, IntervalBalance
from forcetorque.locomotion.standing.result import (
    FootPressureRow,
    PendulumRow,
    RobotPressureRow,
    SupportPhaseRow,
    foot_row,
    pendulum_row,
    phase_rows,
    robot_row,
)
from forcetorque.locomotion.standing.sole_limits import SoleEventRow, sole_events
from forcetorque.locomotion.standing.support_phases import NO_FOOT, require_support
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, optional_table, table_of

_LOG = logging.getLogger(__name__)

SAMPLES = "forcetorque/balance-samples/1"
"""Name and version of the table of samples."""

_DOUBTED_SHARE = 0.1
"""Share of the weight that feet may seem to bear more or less before it is a warning: sensors err by some percent."""


class Balance(DrawnResult):
    """How a robot stood over the intervals of experiments."""

    drawn_by: ClassVar[str] = "forcetorque.locomotion.figures:balance_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("first_standing",)
    answered_by: ClassVar[str | None] = "forcetorque.locomotion.answers:balance_answer"

    interval_uses = ()

    schema_name: Literal["forcetorque/balance/2"] = Field(default="forcetorque/balance/2", alias="schema")
    """Form of the result."""
    experiments: tuple[str, ...]
    """Names of the experiments that are counted."""
    weight_N: float | None
    """Weight of the robot; None where it is unknown, or robots differ."""
    contact_threshold_N: float | None
    """Force that a contact reaches; None where only intervals state contacts."""
    release_N: float | None
    """Force above which it lasts; None where only intervals state contacts."""
    dwell_s: float | None
    """Shortest contact, and shortest pause, that counts; None where only intervals state contacts."""
    least_load_N: float
    """Load below which there is no centre of pressure."""
    phases: tuple[SupportPhaseRow, ...]
    """One per set of feet that are down together."""
    by_motion: bool = False
    """Whether masses, joints and IMU gave the forces, and no force sensor."""
    feet: tuple[FootPressureRow, ...]
    """One per interval and sole, where wrenches are known."""
    robot: tuple[RobotPressureRow, ...]
    """One per interval, where wrenches were measured."""
    pendulum: tuple[PendulumRow, ...]
    """One per interval in which (5.22) was requested and holds."""
    events: tuple[SoleEventRow, ...] = ()
    """Times in which what is measured on a sole is beyond what the ground can do, or friction may not hold; of soles
    whose sensors have an offset removed."""
    refused: tuple[str, ...]
    """What cannot be determined, as text."""
    intervals: tuple[IntervalBalance, ...] = Field(default=(), exclude=True, repr=False)
    """Every sample, for files and pictures."""

    @property
    def first_standing(self) -> IntervalBalance:
        """The first interval in which a foot is down, which is drawn."""
        return next(interval for interval in self.intervals if interval.phases.down.any())

    def blocks(self) -> Iterator[Table | str]:
        """Give tables of phases, feet, robot and pendulum.

        Yields:
            Tables and sentences.
        """
        weight = "" if self.weight_N is None else f", weight {self.weight_N:.1f} N"
        by = " that the motion demands" if self.by_motion else ""
        yield table_of(
            self.phases,
            f"support phases of {', '.join(self.experiments)}{weight}; net force{by}: mean, "
            "± half its 95 % interval where it is stationary noise or the phase recurs",
            leave_out=() if any(row.logged_N is not None for row in self.phases) else ("logged_N",),
        )
        yield from optional_table(
            self.feet,
            "centre of pressure of each foot, on its sole; x, y: means; ± half a 95 % interval of one point",
        )
        yield from optional_table(
            self.events, "what the ground cannot do to a sole, and slips; ±: half a 95 % interval"
        )
        yield from optional_table(self.robot, "centre of pressure and of mass of the robot, in the frame of a sole")
        yield from optional_table(
            self.pendulum, "acceleration of the centre of mass by (5.22), beside that of the joints"
        )
        rule = "a foot is down as the intervals state"
        if self.contact_threshold_N is not None:
            rule = (
                f"a foot is down while it bears more than {self.release_N:.3g} N "
                f"and reaches {self.contact_threshold_N:.3g} N"
                + (f", for {self.dwell_s:g} s at least" if self.dwell_s else "")
                + (", without a stream as the intervals state" if self.by_motion else "")
            )
        yield (rule + (f"; no centre of pressure below {self.least_load_N:.3g} N" if self.feet else ""))

    def write(self, path: Path | str, *, force: bool = False) -> int:
        """Write every sample: the columns of `IntervalBalance.columns`, a row per instant.

        Args:
            path: File to write or to replace, ending in .parquet or .csv.
            force: Whether a file that is neither a result nor a figure may be replaced.

        Returns:
            Number of rows.
        """
        refuse_output(path, force=force)
        several = len(self.experiments) > 1
        spans = [
            SampleSpan(
                label=f"{one.recording}: {one.label}" if several else one.label,
                stamp_ns=one.stamp_ns,
                time_s=one.time_s,
                columns=one.columns(),
            )
            for one in self.intervals
        ]
        rows = write_samples(path, spans, schema=SAMPLES)
        _LOG.info("%s: %d rows", path, rows)
        return rows


@with_recording_notes
def balance(
    recordings: Sequence[Experiment | FootForces],
    corrections: Sequence[Mapping[str, Correction]] = (),
    options: BalanceOptions | None = None,
    *,
    by_motion: bool = False,
) -> Balance:
    """Compute how a robot stood, over all intervals that are not ignored.

    Recordings that hold the same forces, sample for sample, under two names are noticed, and counted once.

    Args:
        recordings: Experiments with soles: with force-torque sensors, or with vertical forces alone.
        corrections: How the sensors of each are read (`corrections_of`); none of vertical forces.
        options: What counts as a contact, as a point, and as a height that does not change.
        by_motion: Whether masses, joints and IMU give the forces, in place of force sensors.

    Returns:
        Phases, centres of pressure and of mass, and what cannot be determined.

    Raises:
        ExperimentError: If there is no recording, or one has no sole.
        EstimationError: If no foot is down in any interval, or thresholds cross.
    """
    chosen = BalanceOptions() if options is None else options
    if not recordings:
        raise ExperimentError("expected an experiment at least, got none")
    by_place = tuple(corrections) or ({},) * len(recordings)
    names: dict[str, str] = {}
    counted: list[IntervalBalance] = []
    events: list[SoleEventRow] = []
    warnings = []
    for content, reading in zip(recordings, by_place, strict=True):
        with stated_in(str(content.file)):
            intervals = tuple(_over(content, reading, chosen, by_motion=by_motion))
        mark = _fingerprint(intervals)
        if mark in names:
            warnings.append(f"{content.name}: its forces are those of {names[mark]}, sample for sample; counted once")
            continue
        names[mark] = content.name
        if by_motion and isinstance(content, Experiment) and (unused := unused_forces(content)) is not None:
            warnings.append(unused)
        biased = [sensor for sensor, correction in reading.items() if not correction.removes_offset]
        if biased:
            warnings.append(
                f"{content.name}: {', '.join(biased)}: no offset was removed, so that forces and points include the "
                "offsets of these sensors; give a calibration, or an interval for calibration"
            )
        if not by_motion:
            untested = {
                foot.sole.frame for one in intervals for foot in one.feet if not set(biased).isdisjoint(foot.sensors)
            }
            if untested:
                warnings.append(
                    f"{content.name}: no look for slips, and for what the ground cannot do, on "
                    f"{', '.join(sorted(untested))}: the offset of a sensor is not known"
                )
            events += _events(intervals, biased, chosen)
        counted += intervals
    return _summed_up(tuple(counted), tuple(names.values()), chosen, events, warnings, by_motion=by_motion)


def _events(
    intervals: Sequence[IntervalBalance], biased: Collection[str], options: BalanceOptions
) -> Iterator[SoleEventRow]:
    """Events of the soles of which no sensor is biased."""
    for one in intervals:
        feet = tuple(foot for foot in one.feet if set(biased).isdisjoint(foot.sensors))
        yield from sole_events(replace(one, feet=feet), release_N=options.thresholds(one.weight_N).release_N)


def _over(
    content: Experiment | FootForces, reading: Mapping[str, Correction], options: BalanceOptions, *, by_motion: bool
) -> Iterator[IntervalBalance]:
    if isinstance(content, FootForces):
        if by_motion:
            raise ExperimentError("expected an experiment with joints for its motion, got vertical forces alone")
        return balance_of_forces(content, options)
    return balance_by_motion(content, options) if by_motion else balance_of_sensors(content, reading, options)


def _summed_up(
    intervals: tuple[IntervalBalance, ...],
    names: tuple[str, ...],
    options: BalanceOptions,
    events: Sequence[SoleEventRow],
    warnings: Sequence[str],
    *,
    by_motion: bool,
) -> Balance:
    weights = {interval.weight_N for interval in intervals}
    weight_N = weights.pop() if len(weights) == 1 else None
    thresholds = options.thresholds(intervals[0].weight_N)
    require_support(
        [interval.phases for interval in intervals], [interval.forces for interval in intervals], thresholds
    )
    by_forces = not by_motion or any(interval.logged_net_N is not None for interval in intervals)
    robots = [(interval, interval.robot) for interval in intervals if interval.robot is not None]
    refused = tuple(dict.fromkeys(words for interval in intervals for words in interval.refused))
    phases = tuple(phase_rows(intervals))
    feet = tuple(foot_row(interval, foot) for interval in intervals for foot in interval.feet)
    return Balance(
        experiments=names,
        weight_N=weight_N,
        contact_threshold_N=thresholds.contact_threshold_N if by_forces else None,
        release_N=thresholds.release_N if by_forces else None,
        dwell_s=thresholds.dwell_s if by_forces else None,
        least_load_N=options.least_load_N(intervals[0].weight_N),
        phases=phases,
        feet=feet,
        robot=tuple(robot_row(interval, robot) for interval, robot in robots),
        pendulum=tuple(
            pendulum_row(interval, robot.com_acceleration, robot.com_acceleration_of_joints)
            for interval, robot in robots
            if robot.com_acceleration is not None
        ),
        events=tuple(events),
        refused=refused,
        intervals=intervals,
        by_motion=by_motion,
        # of motion no sensor is to blame; its rows and what it refuses say all
        warnings=(*warnings, *refused)
        if by_motion
        else (*warnings, *refused, *_warnings(feet), *_weight_warnings(phases, weight_N)),
    )


def _weight_warnings(phases: Sequence[SupportPhaseRow], weight_N: float | None) -> Iterator[str]:
    """Phases in which feet bear so much more or less than the robot weighs that their readings cannot be right."""
    for row in phases:
        if weight_N is None or row.net_N is None or row.phase == NO_FOOT:
            continue
        if abs(row.net_N - weight_N) > _DOUBTED_SHARE * weight_N:
            yield (
                f"{row.phase}: the feet bear {row.net_N:.1f} N in the mean, the robot weighs {weight_N:.1f} N: an "
                "offset was not removed, a matrix is wrong, or something else bears the robot; phases and points are "
                "as wrong"
            )


def _warnings(feet: Sequence[FootPressureRow]) -> Iterator[str]:
    for row in feet:
        where = f"{row.interval}: sole {row.sole}"
        if not row.samples:
            yield f"{where}: never bears the least load, so that it has no centre of pressure; in the air"
        if row.outside_percent:
            yield (
                f"{where}: {row.outside_percent:.1f} % of the points lie outside the outline, by up to "
                f"{row.beyond_mm:.1f} mm, where the ground cannot press: offset or matrix of {', '.join(row.sensors)}, "
                "or the outline, is wrong"
            )


def _fingerprint(intervals: Sequence[IntervalBalance]) -> str:
    """Mark of instants, forces and points, by which a recording is known under another name."""
    digest = hashlib.sha256()
    for interval in intervals:
        points = [] if interval.robot is None else [interval.robot.pressure.points]
        for values in (interval.stamp_ns, *interval.forces.values(), interval.net_N, *points):
            digest.update(np.ascontiguousarray(values).tobytes())
    return digest.hexdigest()
