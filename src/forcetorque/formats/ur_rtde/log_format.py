# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of RTDE as a format of logs: the wrench at the flange, its orientation, and the joints [1].

`actual_TCP_force` is the external force on the tool along the axes of the base, less the declared payload. Its moment
is about the flange on e-Series, and about the TCP on CB3 and with an external sensor, which the log does not say.
`ft_raw_wrench` is the measurement before zero and payload, along the axes of the flange by what its users do.

References:
[1] Universal Robots, RTDE guide; Universal_Robots_ROS2_Driver, issues 1287, 1615 and 1849 on the reference point.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.pose import cross
from forcetorque.base.rows_on_disk import computed_rows, row_blocks
from forcetorque.base.toml_file import checked_tables
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.arm_log import FLANGE, LoggedWrist, declared_loads, motions, repeats_finding, weight_of
from forcetorque.formats.arm_log_table import ArmLogTable
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading
from forcetorque.formats.ur_rtde.moment_point_axes_and_gravity import (
    agreeing_point,
    is_about_other_point,
    require_gravity_as_felt,
    turned_by,
)
from forcetorque.formats.ur_rtde.recorded_fields import RecordedFields, heading_of, read_fields
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

CLOCK = "controller"
"""Clock of the stamps: seconds since the controller started."""
WRIST = "wrist"
"""Stream with the wrench, orientation and position of the flange."""
BASE = "base"
"""Frame of the controller's base, which ur_description calls so too; `base_link` there is turned by pi about z."""
TOOL = "tool"
"""Frame of the accelerometer in the tool flange."""
JOINTS = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
)
"""Joints in the order of `actual_q`, by their names in ur_description."""
_FARTHEST_M = 5.0
"""No arm of this make reaches so far; m."""


class MomentPoint(StrEnum):
    """Point about which `actual_TCP_force` has its moment."""

    FLANGE = "flange"
    """Origin of the flange: e-Series with its own sensor."""
    TCP = "tcp"
    """Tool centre point: CB3, and an external sensor."""


class UrRtdeLog(ArmLogTable):
    """A recording of the real-time data exchange of Universal Robots."""

    format: Literal["ur_rtde"]
    """Format of the recording."""
    path: Path
    """File of record.py, or of startFileRecording of ur_rtde."""
    reading: Literal["actual_TCP_force", "ft_raw_wrench"] = "actual_TCP_force"
    """Field with the wrench."""
    moment_about: MomentPoint | None = None
    """Point about which `actual_TCP_force` has its moment: `flange` on e-Series, `tcp` on CB3 or with an external
    sensor; needed unless the TCP is the flange."""
    tcp_offset: Annotated[FloatArray, ArrayField((6,), form="[x, y, z, rx, ry, rz] in m and rad")] | None = None
    """Pose of the TCP in the flange, m and rotation vector in rad, of a log without `tcp_offset`."""


_QUESTIONS = {
    "moment_about": "point about which actual_TCP_force has its moment: flange on e-Series with its own sensor, tcp on "
    "CB3 or with an external sensor",
    "tcp_offset": "pose of the TCP in the flange while this was recorded, [x, y, z, rx, ry, rz] in m and rad as the "
    "installation has it; record the field tcp_offset to have it in the log",
    "payload_kg": "mass that was set as payload, which the controller subtracts; 0.0 where none was set; record the "
    "field payload to have it in the log",
    "payload_cog_m": "centre of mass of that payload in the flange, [x, y, z] in m; record the field payload_cog to "
    "have it in the log",
}


_FIELDS = {"tcp_offset": "tcp_offset", "payload_kg": "payload", "payload_cog_m": "payload_cog"}
"""Field of the log by the key that states the same."""


class UrRtdeFormat:
    """Recordings of RTDE, text or binary, whose field names fix units, frames and signs."""

    table = UrRtdeLog
    sign = "a recording of RTDE (Universal Robots)"
    controller = "ur"

    def recognises(self, path: Path) -> bool:
        """Look at the names in the first line."""
        return heading_of(path) is not None

    def describe(self, path: Path) -> LogDescription:
        """Read all of it; the wrench stays along the axes of the base where a key is undetermined."""
        return self.describe_specified(path, {})

    def describe_specified(self, path: Path, specified: Mapping[str, object]) -> LogDescription:
        """Read all of it, with keys of the table that the log lacks."""
        fields = read_fields(path)
        reading = "actual_TCP_force" if "actual_TCP_force" in fields.values else "ft_raw_wrench"
        table = checked_tables({"format": "ur_rtde", "path": path, "reading": reading, **specified}, UrRtdeLog, path)
        undetermined = {key: _QUESTIONS[key] for key in _undetermined(table, fields)}
        flange = _flange(table, fields)  # without a tcp_offset that of the TCP, which moves when the flange does
        if list(undetermined) == ["moment_about"] and flange.agreeing is not None:
            table, undetermined = table.model_copy(update={"moment_about": flange.agreeing}), {}
        return LogDescription(
            table=table,
            reading=_reading(table, fields, flange, undetermined),
            undetermined=undetermined,
            wrist=_wrist(table, fields, flange),
        )

    def read(self, specified: UrRtdeLog, context: LogContext) -> LogReading:
        """Read the streams with the wrench in the frame of the flange."""
        fields = read_fields(context.file(specified.path))
        if undetermined := _undetermined(specified, fields):
            key = undetermined[0]
            raise FormatError(f"{specified.path}: recording: {key}: expected {_QUESTIONS[key]}; got none")
        return _reading(specified, fields, _flange(specified, fields), {})


def _undetermined(table: UrRtdeLog, fields: RecordedFields) -> list[str]:
    """Keys that are needed and neither in the log nor in the table."""
    table.require_lacking(fields.values, _FIELDS)
    lacking = []
    if table.reading not in fields.values:
        raise FormatError(
            f"{table.path}: expected the field {table.reading}, which reading names, got {', '.join(fields.values)}"
        )
    if "actual_TCP_pose" not in fields.values:
        raise FormatError(
            f"{table.path}: expected the field actual_TCP_pose, which turns the wrench into the flange, got "
            f"{', '.join(fields.values)}; add it to the recipe and record again"
        )
    offset = fields.values.get("tcp_offset", table.tcp_offset)
    if offset is None:
        lacking.append("tcp_offset")
    if table.reading == "actual_TCP_force":
        has_distance = offset is None or any(rows[:, :3].any() for (rows,) in row_blocks(np.atleast_2d(offset)))
        if table.moment_about is None and has_distance:
            lacking.append("moment_about")
        if "payload" not in fields.values and table.payload_kg is None:
            lacking.append("payload_kg")
        elif "payload_cog" not in fields.values and table.payload_cog_m is None and _has_payload(table, fields):
            lacking.append("payload_cog_m")
    return lacking


def _payload(table: UrRtdeLog, fields: RecordedFields) -> tuple[FloatArray, FloatArray]:
    """Mass, shape (n,), and centre of mass, shape (n, 3), that the controller subtracts; zero where nothing is said."""
    count = len(fields.stamp_ns)
    if table.reading == "ft_raw_wrench":
        return np.broadcast_to(0.0, (count,)), np.broadcast_to(0.0, (count, 3))
    logged = fields.values.get("payload")
    mass = np.broadcast_to(table.payload_kg or 0.0, (count,)) if logged is None else logged[:, 0]
    centre = fields.values.get("payload_cog")
    if centre is None:
        stated = np.zeros(3) if table.payload_cog_m is None else table.payload_cog_m
        centre = np.broadcast_to(stated, (count, 3))
    return mass, centre


def _has_payload(table: UrRtdeLog, fields: RecordedFields) -> bool:
    return any(mass.any() for (mass,) in row_blocks(_payload(table, fields)[0]))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Flange:
    """The flange in the base, and the wrench at it."""

    base_R_flange: FloatArray
    """Orientations; shape (n, 3, 3)."""
    base_p_flange: FloatArray
    """Positions; shape (n, 3); m."""
    gravity: FloatArray
    """Along the axes of the flange; shape (n, 3); m/s2."""
    points: Mapping[MomentPoint, FloatArray]
    """Wrench with the declared payload if the logged moment is about either point; shape (n, 6); N, N m; none of
    `ft_raw_wrench`."""
    agreeing: MomentPoint | None
    """Point about which the moment changes as that of `ft_raw_wrench`; None where that says nothing."""
    other_axes: str
    """Text about a flange that is turned against `ft_raw_wrench`; empty for none."""


def _flange(table: UrRtdeLog, fields: RecordedFields) -> _Flange:
    pose, offset = fields.values["actual_TCP_pose"], fields.values.get("tcp_offset")
    if offset is None:
        offset = np.broadcast_to(np.zeros(6) if table.tcp_offset is None else table.tcp_offset, pose.shape)
    logged = [] if table.reading == "ft_raw_wrench" else [fields.values["actual_TCP_force"]]

    def compute(pose: FloatArray, offset: FloatArray, *wrench: FloatArray) -> tuple[FloatArray, ...]:
        for name, values in (("actual_TCP_pose", pose), ("tcp_offset", offset)):
            _require_units(table.path, name, values)
        turn = _rotations(pose[:, 3:]) @ _rotations(offset[:, 3:]).transpose(0, 2, 1)
        gravity = np.einsum("nji,j->ni", turn, table.world_gravity)
        place = pose[:, :3] - np.einsum("nij,nj->ni", turn, offset[:, :3])
        return turn, place, gravity, *_by_point(turn, gravity, offset[:, :3], *wrench)

    load = _payload(table, fields) if logged else ()
    turn, place, gravity, *wrenches = computed_rows(compute, pose, offset, *logged, *load)
    points = dict(zip(MomentPoint, wrenches, strict=bool(wrenches)))
    raw = fields.values.get("ft_raw_wrench")
    agreeing = agreeing_point(raw, points) if points else None
    return _Flange(
        base_R_flange=turn,
        base_p_flange=place,
        gravity=gravity,
        points=points,
        agreeing=None if agreeing is None else MomentPoint(agreeing),
        other_axes=_other_axes(turned_by(raw, points[MomentPoint.FLANGE]) if points else None),
    )


def _by_point(
    base_R_flange: FloatArray, gravity: FloatArray, flange_p_tcp: FloatArray, *logged: FloatArray
) -> tuple[FloatArray, ...]:
    """Wrench at the flange, (n, 6), N, N m, by the logged one, mass and centre; for either point of its moment."""
    if not logged:
        return ()
    wrench, mass, centre = logged
    flange = weight_of(mass, centre, gravity)
    force, moment = (np.einsum("nji,nj->ni", base_R_flange, part) for part in (wrench[:, :3], wrench[:, 3:]))
    flange[:, :3] += force
    flange[:, 3:] += moment
    tcp = flange.copy()
    tcp[:, 3:] += cross(flange_p_tcp, force)
    return flange, tcp


def _require_units(path: Path, name: str, values: FloatArray) -> None:
    """Refuse millimetres and degrees, which make values that no arm has."""
    farthest, turn = (float(np.nanmax(np.abs(part), initial=0.0)) for part in (values[:, :3], values[:, 3:]))
    if farthest > _FARTHEST_M:
        raise FormatError(
            f"{path}: {name}: expected a position in m, got {farthest:.4g}, farther than an arm reaches: it is in mm; "
            "record the field as the controller sends it"
        )
    if turn > 2.0 * np.pi:
        raise FormatError(
            f"{path}: {name}: expected a rotation vector in rad, got {turn:.4g}, more than a turn: it is in deg, or "
            "no rotation vector; record the field as the controller sends it"
        )


def _rotations(vectors: FloatArray) -> FloatArray:
    """Rotation matrices of rotation vectors; shape (n, 3, 3); NaN where a number lacks."""
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    known = np.isfinite(vectors).all(axis=1)
    matrices = np.full((len(vectors), 3, 3), np.nan)
    if known.any():
        matrices[known] = Rotation.from_rotvec(vectors[known]).as_matrix()
    return matrices


def _require_no_contradiction(table: UrRtdeLog, fields: RecordedFields, flange: _Flange) -> None:
    if table.moment_about is not None and flange.agreeing not in (None, table.moment_about):
        raise FormatError(
            f"{table.path}: moment_about: expected {flange.agreeing}, about which the moment of actual_TCP_force "
            f"changes as that of ft_raw_wrench in the log, got {table.moment_about}"
        )
    felt = fields.values.get("actual_tool_accelerometer")
    require_gravity_as_felt(table.path, felt, flange.base_R_flange, table.world_gravity / table.gravity)


def _other_axes(turn: FloatArray | None) -> str:
    if turn is None:
        return ""
    return (
        f"the flange is turned by ({', '.join(f'{angle:.0f}' for angle in turn)}) deg (rotation vector) against "
        "ft_raw_wrench: check the rotation in tcp_offset, and whether the wrench was turned before it was recorded"
    )


def _other_point(table: UrRtdeLog, fields: RecordedFields, flange: _Flange) -> str:
    """Text about a moment that is about the other point by the force in motion; empty for none."""
    taken, offset = table.moment_about, fields.values.get("tcp_offset", table.tcp_offset)
    # whether a controller subtracts forces of acceleration of a declared payload is not known
    if taken is None or offset is None or not flange.points or _has_payload(table, fields):
        return ""
    flange_p_tcp = np.atleast_2d(offset)[0, :3]
    if any((rows[:, :3] != flange_p_tcp).any() for (rows,) in row_blocks(np.atleast_2d(offset))):
        return ""
    other, sign = (MomentPoint.FLANGE, -1.0) if taken is MomentPoint.TCP else (MomentPoint.TCP, 1.0)
    if not is_about_other_point(
        fields.stamp_ns,
        flange.base_R_flange,
        flange.base_p_flange,
        table.world_gravity,
        flange.points[taken],
        sign * flange_p_tcp,
    ):
        return ""
    return (
        f"moment about another point: expected moment_about = {other}, by the centre of mass that the force in motion "
        f"shows, got {taken}"
    )


def _wrist(table: UrRtdeLog, fields: RecordedFields, flange: _Flange) -> LoggedWrist:
    mass, centre = _payload(table, fields)
    assumed = [f"{table.reading} is the force of the tool on the arm"]
    if table.reading == "ft_raw_wrench":
        assumed.append("along the axes of the flange")
    elif table.moment_about is not None:
        agrees = ", as ft_raw_wrench in the log" if flange.agreeing is table.moment_about else ""
        assumed.append(f"moment about the {table.moment_about}{agrees}")
    return LoggedWrist(
        controller=UrRtdeFormat.controller,
        stream=WRIST,
        sensor=WRIST,
        measure_direction=MeasureDirection.CHILD_TO_PARENT,
        declared=declared_loads(fields.stamp_ns, mass, centre),
        moving=motions(fields.stamp_ns, flange.base_R_flange, flange.base_p_flange),
        assumed=tuple(assumed),
        contradictions=tuple(filter(None, (flange.other_axes, _other_point(table, fields, flange)))),
    )


def _reading(table: UrRtdeLog, fields: RecordedFields, flange: _Flange, undetermined: Mapping[str, str]) -> LogReading:
    signals: dict[str, Signal] = {}
    findings = _findings(fields, undetermined)
    if undetermined:
        frame = BASE if table.reading == "actual_TCP_force" else FLANGE
        signals["wrench"] = Signal.of_fixed("wrench", fields.values[table.reading], frame=frame)
    else:
        _require_no_contradiction(table, fields, flange)
        about = table.moment_about or MomentPoint.FLANGE
        wrench = flange.points[about] if flange.points else fields.values[table.reading]
        signals["wrench"] = Signal.of_fixed("wrench", wrench, frame=FLANGE)
        signals["orientation"] = Signal.of_fixed("orientation", flange.base_R_flange.reshape(-1, 9), frame=FLANGE)
        signals["gravity"] = Signal.of_fixed("gravity", flange.gravity, frame=FLANGE)
        signals["translation"] = Signal.of_fixed("translation", flange.base_p_flange, frame=FLANGE)
        if words := flange.other_axes:
            findings = (*findings, Finding(stream=WRIST, kind="other_axes", message=words, count=len(fields.stamp_ns)))
    streams = {WRIST: signals}
    motion = {"actual_q": ("position", "rad"), "actual_qd": ("velocity", "rad/s")}
    joints = {
        quantity: Signal(quantity=quantity, values=fields.values[field], columns=JOINTS, units=(unit,) * len(JOINTS))
        for field, (quantity, unit) in motion.items()
        if field in fields.values
    }
    if "position" in joints:
        streams["joints"] = joints
    if (felt := fields.values.get("actual_tool_accelerometer")) is not None:
        acceleration = Signal.of_fixed("proper_acceleration", felt, frame=TOOL)
        streams["tool_accelerometer"] = {"proper_acceleration": acceleration}
    return LogReading(
        streams=tuple(
            Stream(name=name, clock=CLOCK, stamp_ns=fields.stamp_ns, signals=signals)
            for name, signals in streams.items()
        ),
        findings=findings,
    )


def _findings(fields: RecordedFields, undetermined: Mapping[str, str]) -> tuple[Finding, ...]:
    findings = [
        Finding(stream=WRIST, kind="undetermined", message=f"{key}: neither log nor format says: {words}", count=1)
        for key, words in undetermined.items()
    ]
    findings += repeats_finding(WRIST, fields.repeated)
    if fields.cut_bytes:
        text = f"the last row is cut after {fields.cut_bytes} bytes, and left out"
        findings.append(Finding(stream=WRIST, kind="cut_row", message=text, count=1))
    return tuple(findings)
