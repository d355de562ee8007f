# SPDX-License-Identifier: BSD-3-Clause
"""Rows of what is demanded of a calibration device: requirements, motors, locks, space, and errors of references."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

from forcetorque.result import Row, Shown, ShownWrench, WrenchValues


class Verdict(StrEnum):
    """What becomes of a requirement."""

    MET = "met"
    NOT_MET = "not met"
    NOT_COMPUTED = "not computed"


class RequirementRow(Row):
    """One requirement of the thesis (6.2.1)."""

    number: Annotated[int, Shown("no.")]
    """Its number."""
    requirement: Annotated[str, Shown("requirement")]
    """What is demanded."""
    verdict: Annotated[Verdict, Shown("verdict")]
    """Whether it is met."""
    value: Annotated[float | None, Shown("value", digits=3)] = None
    """What was computed; None where nothing was."""
    limit: Annotated[float | None, Shown("limit", digits=3)] = None
    """What it is held against."""
    unit: Annotated[str, Shown("unit")] = ""
    """Unit of both."""
    met_to_kg: Annotated[float | None, Shown("met up to", "kg", digits=1)] = None
    """Load up to which it is met, carrier included; None where no load meets it, or the load does not matter."""
    why: str
    """How it was judged, or why it was not."""


class MotorRow(Row):
    """What a motor bears."""

    joint: Annotated[str, Shown("motor")]
    """Joint that it turns."""
    peak_Nm: Annotated[float, Shown("peak", "N m", digits=2)]
    """Largest torque, of weight alone."""
    moving_peak_Nm: Annotated[float, Shown("moving", "N m", digits=2)]
    """Largest torque with what the motion adds."""
    average_Nm: Annotated[float | None, Shown("average (6.1)", "N m", digits=2)]
    """Average by path; None of a motor that only holds."""
    average_over_peak: Annotated[float | None, Shown("over peak", digits=3)]
    """Average over the peak; None of a motor that only holds, or bears nothing."""
    rms_Nm: Annotated[float, Shown("RMS", "N m", digits=2)]
    """Root mean square over time."""
    holding_Nm: Annotated[float, Shown("holding", "N m", digits=2)]
    """Largest torque while it stands still."""
    limit_Nm: Annotated[float, Shown("limit", "N m", digits=1)]
    """What it may give, as described."""


class UnwindingRow(Row):
    """How averages depend on how yaw gets back."""

    yaw_return: Annotated[str, Shown("yaw returns")]
    """How it does."""
    yaw_path_deg: Annotated[float, Shown("path of yaw", "deg", digits=0)]
    """Path of yaw, both ways counted."""
    pitch_over_peak: Annotated[float | None, Shown("pitch, average over peak", digits=3)]
    """Of the motor of pitch."""
    yaw_over_peak: Annotated[float | None, Shown("yaw, average over peak", digits=3)]
    """Of the motor of yaw."""


class HingeRow(Row):
    """What gravity does about the hinge on a way."""

    step: Annotated[int, Shown("step")]
    """Step that it belongs to."""
    hinge: Annotated[str, Shown("hinge")]
    """`locked` or `free`."""
    from_deg: Annotated[float, Shown("from", "deg", digits=1)]
    """Where the hinge is when it begins."""
    to_deg: Annotated[float, Shown("to", "deg", digits=1)]
    """Where it is when it ends."""
    least_Nm: Annotated[float, Shown("least", "N m", digits=2)]
    """Smallest moment about the hinge, towards larger angles; of a free one, kept where the way begins."""
    most_Nm: Annotated[float, Shown("most", "N m", digits=2)]
    """Largest."""


class LockRow(Row):
    """Whether a load gets to the other lock."""

    load: Annotated[str, Shown("load")]
    """The load."""
    reaches: Annotated[bool, Shown("reaches the lock")]
    """Whether gravity drives it to the other lock and never back, without friction."""
    holding_Nm: Annotated[float, Shown("lock holds", "N m", digits=2)]
    """Largest moment on a lock."""
    closing_Nm: Annotated[float, Shown("left 1 deg before", "N m", digits=3)]
    """Moment that is left 1 degree before the lock: more friction stops it farther away."""


class EnvelopeRow(Row):
    """What is swept in one view."""

    view: Annotated[str, Shown("seen from")]
    """View."""
    width_m: Annotated[float, Shown("width", "m", digits=3)]
    """Width of the rectangle around it."""
    height_m: Annotated[float, Shown("height", "m", digits=3)]
    """Its height."""
    rectangle_m2: Annotated[float, Shown("rectangle", "m2", digits=3)]
    """Its area."""
    hull_m2: Annotated[float, Shown("convex hull", "m2", digits=3)]
    """Area of the convex hull."""


class BudgetRow(Row):
    """What one quantity does to the reference of one sensor, the others being right."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor."""
    quantity: Annotated[str, Shown("quantity")]
    """Quantity that is off; `all` for all at once."""
    plus_minus: Annotated[float | None, Shown("+-", digits=3)]
    """How far it is off at most, half of a full width; None for all at once."""
    unit: Annotated[str, Shown("unit")]
    """Unit of that."""
    rms: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Root mean square over the motion; N, N m."""
    largest: WrenchValues
    """Largest magnitude of each component; N, N m."""
    force_N: Annotated[float, Shown("largest f", "N", digits=3)]
    """Largest norm of the error of the force."""
    moment_Nm: Annotated[float, Shown("largest t", "N m", digits=3)]
    """Largest norm of the error of the moment."""


class GradeRow(Row):
    """What a grade of encoders or of an inertial sensor does to the reference."""

    gravity_by: Annotated[str, Shown("gravity by")]
    """`encoders` of pitch and yaw, or `IMU`."""
    full_width: Annotated[float, Shown("width", digits=4)]
    """Full width of the error of each."""
    plus_minus: Annotated[float, Shown("+-", digits=4)]
    """Half of it."""
    unit: Annotated[str, Shown("unit")]
    """Unit of both."""
    rms: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Root mean square over the motion, as Table 6.3 has it; N, N m."""
    one_force_N: Annotated[float, Shown("one: f", "N", digits=2)]
    """Largest error of the force where one encoder, or one axis of the inertial sensor, is off alone."""
    one_moment_Nm: Annotated[float, Shown("one: t", "N m", digits=3)]
    """Of the moment."""
    largest: WrenchValues
    """Largest magnitude of each component with all of them off; N, N m."""
    largest_force_N: Annotated[float, Shown("all: f", "N", digits=2)]
    """Largest component of the force's error with all of them off: what requirement 6 limits."""
    largest_moment_Nm: Annotated[float, Shown("all: t", "N m", digits=3)]
    """Of the moment's."""
    force_norm_N: float
    """Largest norm of the force's error."""
    moment_norm_Nm: float
    """Largest norm of the moment's error."""
    force_met_to_kg: Annotated[float | None, Shown("0.5 N to", "kg", digits=1)]
    """Load up to which no component of the force is off by more than requirement 6 allows; None if none."""
    moment_met_to_kg: Annotated[float | None, Shown("0.02 N m to", "kg", digits=1)]
    """The same of the moment."""
