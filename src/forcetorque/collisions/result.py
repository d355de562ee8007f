# SPDX-License-Identifier: BSD-3-Clause
"""Contacts that nobody expected, by a sensor or by joint torques: when, how strong, from where, on which link."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.locomotion.answers import event_texts
from forcetorque.locomotion.standing.sole_limits import SoleEventRow
from forcetorque.results.answer import FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import amount, plus_minus
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, Values, optional_table, table_of


class CollisionRow(Row):
    """One contact; half-widths are of 95 % intervals."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor that noticed it."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    kind: Annotated[Literal["collision", "contact", "new_level"], Shown("kind")]
    """Shorter than half a second; longer; or still there when looking for it ended: something leans on the robot, what
    leant on it before has gone, with the opposite force, or the reading stepped."""
    start_s: Annotated[float, Shown("from", "s", digits=2)]
    """Begin, from the start of the recording."""
    end_s: Annotated[float, Shown("to", "s", digits=2)]
    """End."""
    force_N: Annotated[float, Shown("largest force", "N", digits=1, error="force_half_width_95_N")]
    """Largest force on the robot, mean over 50 ms."""
    force_half_width_95_N: float
    """Its half-width."""
    direction: tuple[float, float, float]
    """Unit vector of that force, in the axes of `frame`."""
    frame: str
    """Support frame."""
    impulse_Ns: Annotated[float, Shown("impulse", "N s", digits=2)]
    """Sum of the size of the force over time."""
    couple_Nm: Annotated[float, Shown("couple", "N m", digits=2, error="couple_half_width_95_Nm")]
    """Moment about the line of the force, which a single force at a point does not have."""
    couple_half_width_95_Nm: float
    """Its half-width."""
    link: Annotated[str, Shown("link")]
    """Link whose axis is nearest to the line of the force."""
    other_links: Annotated[tuple[str, ...], Shown("or")]
    """Links that may be as near."""
    distance_mm: Annotated[float, Shown("line to axis", "mm", digits=0, error="distance_half_width_95_mm")]
    """Distance of the line from that axis."""
    distance_half_width_95_mm: float
    """Its half-width."""
    point_mm: tuple[float, float, float]
    """Point of the line that is nearest to the axis, in the frame of the link."""
    over_threshold: Annotated[float, Shown("over threshold", digits=1)]
    """Largest statistic over its threshold."""


class SensitivityRow(Row):
    """What a sensor can notice."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor."""
    smallest_force_N: Annotated[float, Shown("noticed from", "N", digits=1)]
    """Force that a window of 50 ms notices with a probability of 95 %, whatever its direction and place; median over
    an interval, of the interval that needs the largest."""
    threshold: Annotated[float, Shown("threshold", digits=1)]
    """Threshold of the squared residual over its covariance."""
    tail_decides: Annotated[bool, Shown("set by the tail")]
    """Whether values of the free samples set it, whose tail is heavier than that of normal noise."""
    alarms_per_hour: Annotated[float, Shown("false alarms per hour", digits=2)]
    """Rate of false alarms that it is set for."""
    free_s: Annotated[float, Shown("learnt from", "s", digits=0)]
    """Time without contact that errors and noise are learnt from."""
    looked_at_s: Annotated[float, Shown("looked at", "s", digits=0)]
    """Time that was looked at, without that in which the level is found."""


class LinkSensitivityRow(Row):
    """What a sensor can notice on one link."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor."""
    link: Annotated[str, Shown("link")]
    """Link beyond it."""
    smallest_force_N: Annotated[float, Shown("noticed from", "N", digits=1)]
    """Force on the axis of the link that a window of 50 ms notices with a probability of 95 %, whatever its direction
    and its place on the axis; median over an interval, of the interval that needs the largest."""


class CollisionCurve(Row):
    """The force that a sensor reads too much over time, for the figure."""

    sensor: str
    """Sensor."""
    time_s: Values
    """Middle of each window; shape (w,); s."""
    force_N: Values
    """Size of the force that the sensor reads too much; shape (w,); N."""


class Collisions(DrawnResult):
    """Contacts that the file does not state."""

    drawn_by: ClassVar[str] = "forcetorque.collisions.figures:collisions_figure"

    schema_name: Literal["forcetorque/collisions/1"] = Field(default="forcetorque/collisions/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    collisions: tuple[CollisionRow, ...]
    """Contacts of every sensor in the order of time."""
    sensitivity: tuple[SensitivityRow, ...]
    """A row for every sensor."""
    by_link: tuple[LinkSensitivityRow, ...] = ()
    """A row for every link beyond each sensor."""
    sole_events: tuple[SoleEventRow, ...] = ()
    """Times in which what presses on a sole beyond a sensor is not what the ground can do, or friction may not hold."""
    curves: tuple[CollisionCurve, ...] = Field(default=(), exclude=True, repr=False)
    """Forces over time, for the figure."""

    def answers(self) -> Iterator[Answer]:
        """Say what every sensor noticed.

        Yields:
            One answer per sensor.
        """
        for sensor in self.sensitivity:
            rows = [row for row in self.collisions if row.sensor == sensor.sensor]
            strongest = max(rows, key=lambda row: row.over_threshold, default=None)
            count = f"{len(rows)} CONTACT{'S' if len(rows) > 1 else ''}" if rows else "NO CONTACT"
            soles = list(event_texts([event for event in self.sole_events if sensor.sensor in event.sensors]))
            yield Answer(
                subject=f"{sensor.sensor}, {self.experiment}",
                verdict=f"{count} in {sensor.looked_at_s:.3g} s",
                why=(*([_strongest(strongest)] if strongest is not None else []), *soles, _noticed(sensor)),
                step="look at the log around it" if rows or soles else "",
                command=typed("view", FIRST_EXPERIMENT) if rows or soles else "",
                concern=Concern.UNCERTAIN if rows or soles else Concern.NONE,
            )

    def blocks(self) -> Iterator[Table | str]:
        """Give contacts, and what the sensors can notice.

        Yields:
            Tables.
        """
        yield from optional_table(self.collisions, "contacts that the file does not state; ±: half a 95 % interval")
        yield from optional_table(
            self.sole_events, "what the ground cannot do to a sole, and slips; ±: half a 95 % interval"
        )
        yield table_of(self.sensitivity, "what is noticed")
        yield from optional_table(self.by_link, "on which link, in its worst direction and place")

    def records(self) -> list[dict[str, object]]:
        """Give the contacts as flat lines.

        Returns:
            One line per contact.
        """
        return [row.flat() for row in self.collisions]


def _strongest(row: CollisionRow) -> str:
    link = row.link if not row.other_links else f"{row.link} (or {', '.join(row.other_links[:2])})"
    stays = ", and stays, or an earlier contact ended" if row.kind == "new_level" else ""
    force = plus_minus(row.force_N, row.force_half_width_95_N, "N")
    return f"clearest: {row.start_s:.2f} to {row.end_s:.2f} s, {force} on {link}{stays}"


def _noticed(sensor: SensitivityRow) -> str:
    return (
        f"noticed: any force from {sensor.smallest_force_N:.2g} N; threshold for a false alarm rate of "
        f"{sensor.alarms_per_hour:g} per hour, from {sensor.free_s:.3g} s without contact"
    )


class TorqueContactRow(Row):
    """One contact."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    start_s: Annotated[float, Shown("from", "s", digits=2)]
    """Begin, from the start of the recording."""
    end_s: Annotated[float, Shown("to", "s", digits=2)]
    """End."""
    link: Annotated[str, Shown("on or beyond")]
    """Link that the outermost joint with an external torque moves: the contact is on it or further out."""
    joint: Annotated[str, Shown("clearest joint")]
    """Joint whose torque is furthest over its threshold."""
    torque_Nm: Annotated[float, Shown("external torque", "N m", digits=2, error="half_width_95_Nm")]
    """Largest external torque of that joint, mean over 50 ms; N where it is prismatic."""
    half_width_95_Nm: float
    """Half of its 95 % interval."""
    over_threshold: Annotated[float, Shown("over threshold", digits=1)]
    """Largest torque over its threshold."""


class JointRow(Row):
    """What one joint can notice."""

    joint: Annotated[str, Shown("joint")]
    """Joint."""
    threshold_Nm: Annotated[float, Shown("threshold", "N m", digits=3)]
    """External torque from which there is a contact; median over what was looked at."""
    noise_Nm: Annotated[float, Shown("noise", "N m", digits=3)]
    """Standard deviation that noise and what no term explains leave in a window without contact."""
    explained_Nm: Annotated[float, Shown("explained", "N m", digits=3)]
    """Root mean square of what friction, offset and masses explain without contact."""


class TorqueCurve(Row):
    """The external torque of a joint over time, for the figure."""

    joint: str
    """Joint."""
    time_s: Values
    """Middle of each window; shape (w,); s."""
    over_threshold: Values
    """External torque over its threshold; shape (w,)."""


class JointCollisions(DrawnResult):
    """Contacts of an arm that the file does not state."""

    drawn_by: ClassVar[str] = "forcetorque.collisions.figures:joint_collisions_figure"

    schema_name: Literal["forcetorque/joint_collisions/1"] = Field(
        default="forcetorque/joint_collisions/1", alias="schema"
    )
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    contacts: tuple[TorqueContactRow, ...]
    """Contacts in the order of time."""
    joints: tuple[JointRow, ...]
    """Joints with a logged torque, from the base."""
    alarms_per_hour: float
    """Rate of false alarms of all joints together that thresholds are set for."""
    free_s: float
    """Time without contact that errors and noise are learnt from."""
    looked_at_s: float
    """Time that was looked at."""
    curves: tuple[TorqueCurve, ...] = Field(default=(), exclude=True, repr=False)
    """External torques over time, for the figure."""

    def answers(self) -> Iterator[Answer]:
        """Give the answer.

        Yields:
            One.
        """
        clearest = max(self.contacts, key=lambda row: row.over_threshold, default=None)
        least = min(self.joints, key=lambda row: row.threshold_Nm)
        most = max(self.joints, key=lambda row: row.threshold_Nm)
        count = f"{len(self.contacts)} CONTACT{'S' * (len(self.contacts) > 1)}" if self.contacts else "NO CONTACT"
        found = () if clearest is None else (_clearest(clearest),)
        yield Answer(
            subject=f"{self.experiment}, {len(self.joints)} joint torques",
            verdict=f"{count} in {self.looked_at_s:.3g} s",
            why=(
                *found,
                f"noticed: external torques from {amount(least.threshold_Nm, 'N m')} on {least.joint} to "
                f"{amount(most.threshold_Nm, 'N m')} on {most.joint}; set for a false alarm rate "
                f"of {self.alarms_per_hour:g} per hour, from {self.free_s:.3g} s without contact",
            ),
            step="see all by --details, and the torques over time by --figure" if self.contacts else "",
            written=(self.figure_file,),
            concern=Concern.UNCERTAIN if self.contacts else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Give contacts, and what the joints notice.

        Yields:
            Tables.
        """
        yield from optional_table(self.contacts, "contacts that the file does not state; ±: half a 95 % interval")
        yield table_of(self.joints, "what the joints notice")


def _clearest(row: TorqueContactRow) -> str:
    torque = plus_minus(row.torque_Nm, row.half_width_95_Nm, "N m")
    return f"clearest: {row.start_s:.2f} to {row.end_s:.2f} s, {torque} on {row.joint}, on {row.link} or beyond"
