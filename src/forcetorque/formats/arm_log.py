# SPDX-License-Identifier: BSD-3-Clause
"""What the log of an arm holds of its load: the wrench at the flange, or the joint torques, and when it is at rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, names, true_runs
from forcetorque.base.errors import FormatError
from forcetorque.base.pose import cross
from forcetorque.base.rows_on_disk import row_blocks
from forcetorque.base.wrench import MeasureDirection
from forcetorque.recording.recording import Finding

FLANGE = "tool0"
"""Frame of the mechanical flange as the controller has it, which is that of an all-zero tool: z points out of the
flange. URDFs of ROS-Industrial call it so; their link `flange` has other axes."""
BAG = "ros"
"""Kind of the controller of a bag, which may be any."""
_MOVING_RAD_S = 0.05
"""Angular speed of the flange above which the arm moves; rad/s."""
_MOVING_M_S = 0.02
"""Speed of the flange above which the arm moves; m/s."""
_FEWEST_STEPS = 3
"""A motion has at least so many steps; a shorter one is a cut of the log between two poses."""
_SETTLING_NS = 100_000_000
"""Time after and before a motion in which the arm still shakes or accelerates already."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeclaredLoad(ArrayRecord):
    """A load that the controller knows, while it does not change."""

    start_ns: int
    """First stamp."""
    end_ns: int
    """First stamp after it."""
    mass: float
    """Mass; kg."""
    centre_of_mass: FloatArray = field(metadata=array(3))
    """Centre of mass along the axes of the flange from its origin; shape (3,); m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LoggedWrist:
    """What the format of a log fixes of the wrench at the flange of an arm."""

    controller: str
    """Kind of the controller, `ur` or `franka`; `BAG` of a bag."""
    stream: str
    """Stream with the wrench, and with orientation and gravity of its frame."""
    sensor: str
    """Name for the sensor."""
    frame: str = FLANGE
    """Frame of the wrench, about whose origin its moment is."""
    measure_direction: MeasureDirection
    """Who acts on whom in the wrench; the load is the child."""
    declared: tuple[DeclaredLoad, ...]
    """Loads that the controller subtracts and the reader adds, in the order of time; the last one ends after the
    log."""
    moving: tuple[tuple[int, int], ...] = ()
    """Start and end of motions, to which no load at rest is fitted; ns."""
    assumed: tuple[str, ...] = ()
    """What is taken from the format and not from the log, in a few words each."""
    contradictions: tuple[str, ...] = ()
    """What other fields of the log contradict."""


def first_of_repeats(stamp_ns: IntArray, where: Path) -> BoolArray:
    """Find the rows that a controller sent, where a recorder with a clock of its own wrote some of them twice.

    Args:
        stamp_ns: Time of each row by the clock of the controller; shape (n,); ns.
        where: The log, for messages.

    Returns:
        Rows whose time is not that of the row before; shape (n,).

    Raises:
        FormatError: If time goes back.
    """
    steps = np.diff(stamp_ns)
    for row in np.flatnonzero(steps < 0)[:1]:
        raise FormatError(
            f"{where}: row {row + 2}: expected a time after {1e-9 * stamp_ns[row]:.3f} s, got "
            f"{1e-9 * stamp_ns[row + 1]:.3f} s: the controller was started again; split the file there"
        )
    return np.concatenate([[True], steps > 0])


def repeats_finding(stream: str, count: int) -> tuple[Finding, ...]:
    """Report rows that were left out.

    Args:
        stream: Stream of the rows.
        count: Their number.

    Returns:
        One finding; none for no row.
    """
    text = f"{count} row(s) repeat the time of the row before, as recorders faster than the robot make; left out"
    return (Finding(stream=stream, kind="repeated_rows", message=text, count=count),) if count else ()


def weight_of(mass: FloatArray, centre_of_mass: FloatArray, gravity: FloatArray) -> FloatArray:
    """Give the wrench of loads at rest on a flange.

    Args:
        mass: Masses; shape (n,); kg.
        centre_of_mass: Along the axes of the flange from its origin; shape (n, 3); m.
        gravity: Along the axes of the flange, pointing down; shape (n, 3); m/s2.

    Returns:
        Wrench of the load on the flange, about its origin; shape (n, 6); N, N m.
    """
    force = mass[:, None] * gravity
    return np.hstack([force, cross(centre_of_mass, force)])


def declared_loads(stamp_ns: IntArray, mass: FloatArray, centre_of_mass: FloatArray) -> tuple[DeclaredLoad, ...]:
    """Divide a log where the load changes that the controller knows.

    Args:
        stamp_ns: Stamps, which do not fall; shape (n,), at least one; ns.
        mass: Declared masses; shape (n,); kg.
        centre_of_mass: Declared centres of mass; shape (n, 3); m.

    Returns:
        The loads in the order of time.
    """
    changed = [
        (masses[1:] != masses[:-1]) | (centres[1:] != centres[:-1]).any(axis=1)
        for masses, centres in row_blocks(mass, centre_of_mass, overlap=1)
    ]
    changes = np.flatnonzero(np.concatenate([np.zeros(0, dtype=bool), *changed])) + 1
    starts = [0, *changes.tolist()]
    # a border lies between two samples, so that seconds with a rounding error hold the same samples
    borders = [int(stamp_ns[0]), *((stamp_ns[changes - 1] + stamp_ns[changes]) // 2).tolist(), int(stamp_ns[-1]) + 1]
    return tuple(
        DeclaredLoad(
            start_ns=borders[k], end_ns=borders[k + 1], mass=float(mass[row]), centre_of_mass=centre_of_mass[row]
        )
        for k, row in enumerate(starts)
    )


def motions(stamp_ns: IntArray, base_R_flange: FloatArray, base_p_flange: FloatArray) -> tuple[tuple[int, int], ...]:
    """Find the spans in which a flange moves.

    Args:
        stamp_ns: Stamps, which rise; shape (n,); ns.
        base_R_flange: Orientations; shape (n, 3, 3).
        base_p_flange: Positions; shape (n, 3); m.

    Returns:
        Start and end of each motion, with the time in which the arm settles; ns.
    """
    if len(stamp_ns) < 2:
        return ()
    blocks = row_blocks(stamp_ns, base_R_flange, base_p_flange, overlap=1)
    is_moving = np.concatenate([_moving(*rows) for rows in blocks])
    spans: list[tuple[int, int]] = []
    for first, end_row in true_runs(is_moving):
        last = end_row + 1
        if last - first >= _FEWEST_STEPS:
            begin, end = int(stamp_ns[first]) - _SETTLING_NS, int(stamp_ns[last]) + _SETTLING_NS
            span = (max(begin, int(stamp_ns[0])), min(end, int(stamp_ns[-1]) + 1))
            if spans and span[0] <= spans[-1][1]:
                span = (spans.pop()[0], span[1])
            spans.append(span)
    return tuple(spans)


def _moving(stamp_ns: IntArray, base_R_flange: FloatArray, base_p_flange: FloatArray) -> BoolArray:
    """Whether the flange moves from each row to the next; shape (n - 1,)."""
    step_s = 1e-9 * np.diff(stamp_ns)
    # the norm of the difference of two close rotations is sqrt(2) times the angle between them
    angle = np.linalg.norm(np.diff(base_R_flange, axis=0), axis=(1, 2)) / np.sqrt(2.0)
    shift = np.linalg.norm(np.diff(base_p_flange, axis=0), axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        is_moving: BoolArray = (angle > _MOVING_RAD_S * step_s) | (shift > _MOVING_M_S * step_s)
    return is_moving


UNKNOWNS = ("mass", "centre of mass along x", "centre of mass along y", "centre of mass along z")
"""What the columns of `unit_torque` belong to."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoggedTorques(ArrayRecord):
    """What the format of a log fixes of torques without a wrench.

    At rest `torque + unit_torque (declared load) = unit_torque [m; m c] + bias`, with a bias of each joint.
    """

    controller: str
    """Kind of the controller, `franka`."""
    joints: tuple[str, ...] = field(metadata=names("d"))
    """Names of the joints."""
    stamp_ns: IntArray = field(metadata=array("n", dtype="int"))
    """Time since the controller started; shape (n,); ns."""
    position: FloatArray = field(metadata=array("n", "d"))
    """Angles; shape (n, d); rad."""
    is_still: BoolArray = field(metadata=array("n", dtype="bool"))
    """Where no joint moves; shape (n,)."""
    torque: FloatArray = field(metadata=array("n", "d"))
    """By which the arm holds what its controller does not know; shape (n, d); N m."""
    unit_torque: FloatArray = field(metadata=array("n", "d", 4))
    """By which it holds 1 kg at the origin of the flange, and a first moment of 1 kg m along each of its axes; shape
    (n, d, 4); N m."""
    declared_mass: FloatArray = field(metadata=array("n"))
    """Mass that the controller knows; shape (n,); kg."""
    declared_centre: FloatArray = field(metadata=array("n", 3))
    """Its centre along the axes of the flange from its origin; shape (n, 3); m."""
    undetermined: Mapping[str, str]
    """Keys of the table that neither log nor format determines, each with the question for it."""
    assumed: tuple[str, ...]
    """What is taken from the format and not from the log, in a few words each."""


def holding_torques(
    axes: FloatArray, joint_points: FloatArray, base_H_flange: FloatArray, gravity: FloatArray
) -> FloatArray:
    """Give the torques by which rotary joints hold a load at rest, per kg and per kg m.

    The torque about the axis z through p that holds a mass m at p_m against gravity g is `-z . ((p_m - p) x m g)`.

    Args:
        axes: Axes of the joints in the base; shape (n, d, 3).
        joint_points: A point on each axis; shape (n, d, 3); m.
        base_H_flange: Poses of the flange; shape (n, 4, 4); m.
        gravity: In the base, pointing down; shape (3,); m/s2.

    Returns:
        Of 1 kg at the origin of the flange, and of a first moment of 1 kg m along each of its axes; shape (n, d, 4);
        N m per kg, N m per kg m.
    """
    lever = base_H_flange[:, None, :3, 3] - joint_points
    of_mass = -np.einsum("ndk,ndk->nd", axes, np.cross(lever, gravity))
    turned = np.cross(base_H_flange[:, :3, :3].transpose(0, 2, 1), gravity)  # of each axis of the flange; (n, 3, 3)
    of_moment = -np.einsum("ndk,nak->nda", axes, turned)
    return np.concatenate([of_mass[:, :, None], of_moment], axis=2)
