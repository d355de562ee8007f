# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of an arm by its joint torques: when, which joints, beyond which link."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, plus_minus
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, Values, table_of


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
        if self.contacts:
            yield table_of(self.contacts, "contacts that the file does not state; ±: half a 95 % interval")
        yield table_of(self.joints, "what the joints notice")


def _clearest(row: TorqueContactRow) -> str:
    torque = plus_minus(row.torque_Nm, row.half_width_95_Nm, "N m")
    return f"clearest: {row.start_s:.2f} to {row.end_s:.2f} s, {torque} on {row.joint}, on {row.link} or beyond"
