# SPDX-License-Identifier: BSD-3-Clause
"""Robot states of libfranka as a format of logs: the wrench at the flange, its orientation, and joint torques [1].

Poses are 16 numbers column by column. The external wrench is that of the robot on its environment, about the origin of
the stiffness frame K, estimated from joint torques less the model of arm, end effector and declared load. It is exactly
zero near singularities, where it is not estimated.

References:
[1] frankarobotics/libfranka, include/franka/robot_state.h, robot.h; issue 26 and franka_ros issue 254 on the sign.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, BoolArray, FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.rows_on_disk import computed_rows, row_blocks
from forcetorque.base.toml_file import Text, checked_tables
from forcetorque.base.wrench import FORCE, MOMENT, MeasureDirection, transform_wrench
from forcetorque.formats.arm_log import (
    FLANGE,
    LoggedTorques,
    LoggedWrist,
    declared_loads,
    holding_torques,
    motions,
    repeats_finding,
    weight_of,
)
from forcetorque.formats.arm_log_table import ArmLogTable
from forcetorque.formats.franka.kinematics import joint_frames
from forcetorque.formats.franka.logged_states import LoggedStates, is_logged_states, read_states
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

CLOCK = "controller"
"""Clock of the stamps: time since the controller started."""
WRIST = "wrist"
"""Stream with the wrench, orientation and position of the flange."""
JOINTS = tuple(f"joint_{k}" for k in range(1, 8))
"""Joints in the order of `q`; URDFs put the name of the arm in front, which no state has."""
_DIRECTION = MeasureDirection.PARENT_TO_CHILD
"""The robot acts on its environment."""
_POSES = ("O_T_EE", "F_T_EE", "EE_T_K")
"""Fields of the poses from the base to the stiffness frame."""
_LAST_ROW = (3, 7, 11)
"""Places of zeros in a pose column by column; a translation row by row."""
_ROUNDING = 1e-3
"""By how much a rotation matrix may be off, as six digits make it."""


_POSE_FORM = "16 numbers in brackets, column by column: three and 0 for each axis, then x, y, z in m and 1"


class FrankaLog(ArmLogTable):
    """Robot states of libfranka."""

    format: Literal["franka"]
    """Format of the recording."""
    path: Path
    """File with a state as JSON in each line (`std::cout << state`), or the table of `logToCSV`."""
    joints: Annotated[tuple[Text, ...], Field(min_length=7, max_length=7)] = JOINTS
    """Names of the joints in the URDF, in the order of `q`."""
    F_T_EE: Annotated[FloatArray, ArrayField((16,), form=_POSE_FORM)] | None = None
    """Pose of the end effector in the flange, column by column, m, of a log without it."""
    EE_T_K: Annotated[FloatArray, ArrayField((16,), form=_POSE_FORM)] | None = None
    """Pose of the stiffness frame in the end effector, likewise."""


_POSE = "16 numbers column by column, m; log the field to have it in the log"
_QUESTIONS = {
    "F_T_EE": f"pose of the end effector in the flange, {_POSE}",
    "EE_T_K": f"pose of the stiffness frame in the end effector, {_POSE}; identity where setK was not called",
    "payload_kg": "mass of setLoad, which the controller subtracts; 0.0 where none was set; log the field m_load to "
    "have it in the log",
    "payload_cog_m": "centre of mass of setLoad in the flange, [x, y, z] in m; log the field F_x_Cload to have it in "
    "the log",
}
_LACKS_WRENCH = (
    "joint torques alone, neither a wrench (O_F_ext_hat_K or K_F_ext_hat_K) nor a pose (O_T_EE); log whole states, as "
    "`std::cout << state` writes them, a line each, or q and tau_ext_hat_filtered"
)
_STILL_RAD_S = 0.02
"""Speed of every joint below which an arm is at rest; rad/s (heuristic)."""


_FIELDS = {"F_T_EE": "F_T_EE", "EE_T_K": "EE_T_K", "payload_kg": "m_load", "payload_cog_m": "F_x_Cload"}
"""Field of a state by the key that states the same."""


class FrankaFormat:
    """States of libfranka as lines of JSON or as a table, whose field names fix units, frames and signs."""

    table = FrankaLog
    sign = "robot states of libfranka (Franka)"
    controller = "franka"

    def recognises(self, path: Path) -> bool:
        """Look at the first line."""
        return is_logged_states(path)

    def describe(self, path: Path) -> LogDescription:
        """Read all of it; joints alone where the pose of a frame lacks."""
        return self.describe_specified(path, {})

    def describe_specified(self, path: Path, specified: Mapping[str, object]) -> LogDescription:
        """Read all of it, with keys of the table that the log lacks."""
        states = read_states(path)
        table = checked_tables({"format": "franka", "path": path, **specified}, FrankaLog, path)
        undetermined = {key: _QUESTIONS[key] for key in _undetermined(table, states)}
        has_wrench = _has_wrench(states)
        flange = _flange(table, states, undetermined) if has_wrench else None
        return LogDescription(
            table=table,
            reading=_reading(table, states, flange, undetermined),
            undetermined=undetermined,
            wrist=None if flange is None else _wrist(table, states, flange),
            wrist_lacks="" if has_wrench else _LACKS_WRENCH,
            torques=None if has_wrench else _torques(table, states),
        )

    def read(self, specified: FrankaLog, context: LogContext) -> LogReading:
        """Read the streams with the wrench in the frame of the flange, as far as the log has one."""
        states = read_states(context.file(specified.path))
        for key in _undetermined(specified, states):
            raise FormatError(f"{specified.path}: recording: {key}: expected {_QUESTIONS[key]}; got none")
        flange = _flange(specified, states, {}) if _has_wrench(states) else None
        return _reading(specified, states, flange, {})


def _has_wrench(states: LoggedStates) -> bool:
    return "O_T_EE" in states.values and bool({"O_F_ext_hat_K", "K_F_ext_hat_K"} & set(states.values))


def _undetermined(table: FrankaLog, states: LoggedStates) -> list[str]:
    """Keys that are needed and neither in the log nor in the table."""
    table.require_lacking(states.values, _FIELDS)
    if not _has_wrench(states):
        return []
    lacking = [key for key in ("F_T_EE", "EE_T_K") if key not in states.values and getattr(table, key) is None]
    if "m_load" not in states.values and table.payload_kg is None:
        lacking.append("payload_kg")
    elif (
        "F_x_Cload" not in states.values
        and table.payload_cog_m is None
        and any(mass.any() for (mass,) in row_blocks(_payload(table, states)[0]))
    ):
        lacking.append("payload_cog_m")
    return lacking


def _torques(table: FrankaLog, states: LoggedStates) -> LoggedTorques | None:
    """What the external torques are; None of a log without them or without angles."""
    if not {"q", "tau_ext_hat_filtered"} <= set(states.values):
        return None
    position = states.values["q"]
    frames, base_H_flange = joint_frames(position)
    undetermined = [] if "m_load" in states.values or table.payload_kg is not None else ["payload_kg"]
    mass, centre = _payload(table, states)
    if mass.any() and "F_x_Cload" not in states.values and table.payload_cog_m is None:
        undetermined.append("payload_cog_m")
    assumed = [
        "tau_ext_hat_filtered is the torque of the joints on the load, with a constant error in each joint",
        "the geometry of Panda and Franka Research 3",
    ]
    if (end_effector := states.values.get("m_ee")) is None:
        assumed.append("beyond the end effector of Desk")
    elif end_effector[:, 0].any():
        assumed.append(f"beyond the end effector of {end_effector[-1, 0]:g} kg of Desk")
    return LoggedTorques(
        controller=FrankaFormat.controller,
        joints=table.joints,
        stamp_ns=states.stamp_ns,
        position=position,
        is_still=_still(states),
        torque=states.values["tau_ext_hat_filtered"],
        unit_torque=holding_torques(frames[:, :, :3, 2], frames[:, :, :3, 3], base_H_flange, table.world_gravity),
        declared_mass=mass,
        declared_centre=np.array(centre, dtype=np.float64),
        undetermined={key: _QUESTIONS[key] for key in undetermined},
        assumed=(*assumed, f"gravity {table.gravity:.6g} m/s2"),
    )


def _still(states: LoggedStates) -> BoolArray:
    """Where no joint moves, by `dq` or, of a log without it, by steps of the angles; shape (n,)."""
    speed: FloatArray = np.zeros_like(states.values["q"])
    if "dq" in states.values:
        speed = states.values["dq"]
    elif len(speed) > 1:
        step_s = np.maximum(1e-9 * np.gradient(states.stamp_ns.astype(np.float64)), 1e-9)
        speed = np.array(np.gradient(states.values["q"], axis=0), dtype=np.float64) / step_s[:, None]
    fastest: FloatArray = np.abs(speed).max(axis=1)
    return fastest < _STILL_RAD_S


def _payload(table: FrankaLog, states: LoggedStates) -> tuple[FloatArray, FloatArray]:
    """Mass, shape (n,), and centre of mass, shape (n, 3), of `setLoad`; zero where nothing is said."""
    count = len(states.stamp_ns)
    known = states.values.get("m_load")
    mass = np.broadcast_to(table.payload_kg or 0.0, (count,)) if known is None else known[:, 0]
    stated = np.zeros(3) if table.payload_cog_m is None else table.payload_cog_m
    return mass, states.values.get("F_x_Cload", np.broadcast_to(stated, (count, 3)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Flange:
    """The flange in the base, and the wrench at it."""

    base_R_flange: FloatArray
    """Orientations; shape (n, 3, 3)."""
    base_p_flange: FloatArray
    """Positions; shape (n, 3); m."""
    gravity: FloatArray
    """Along the axes of the flange; shape (n, 3); m/s2."""
    wrench: FloatArray | None
    """Of the robot on the load beyond the flange, declared load included; shape (n, 6); N, N m; None where the table
    leaves a key open."""


_WRENCHES = ("O_F_ext_hat_K", "K_F_ext_hat_K")


def _flange(table: FrankaLog, states: LoggedStates, undetermined: Mapping[str, str]) -> _Flange:
    fields = [field for field in _WRENCHES if field in states.values and not undetermined]
    rows = np.arange(len(states.stamp_ns))
    poses = [_pose_numbers(table, states, field) for field in _POSES]

    def compute(row: IntArray, *numbers: FloatArray) -> tuple[FloatArray, ...]:
        base_H_ee, flange_H_ee, ee_H_k = (
            _pose(table, field, values, row) for field, values in zip(_POSES, numbers[:3], strict=True)
        )
        inverse = np.zeros_like(flange_H_ee)
        inverse[:, :3, :3] = flange_H_ee[:, :3, :3].transpose(0, 2, 1)
        inverse[:, :3, 3] = -np.einsum("nji,nj->ni", flange_H_ee[:, :3, :3], flange_H_ee[:, :3, 3])
        inverse[:, 3, 3] = 1.0
        base_H_flange = base_H_ee @ inverse
        gravity = np.einsum("nji,j->ni", base_H_flange[:, :3, :3], table.world_gravity)
        parts = base_H_flange[:, :3, :3], base_H_flange[:, :3, 3], gravity
        if not fields:
            return parts
        mass, centre, *wrenches = numbers[3:]
        logged = dict(zip(fields, wrenches, strict=True))
        wrench, squares = _flange_wrench(logged, base_H_flange, flange_H_ee @ ee_H_k)
        wrench -= weight_of(mass, centre, gravity)  # the robot holds up the weight
        wrench[_is_lost(wrenches)] = np.nan
        return *parts, wrench, squares

    loads = [*_payload(table, states), *(states.values[field] for field in fields)]
    turn, place, gravity, *others = computed_rows(compute, rows, *poses, *loads)
    if others:
        with np.errstate(over="ignore"):  # damaged files hold huge numbers
            _require_agreement(table.path, others[1].sum(axis=0))
    return _Flange(base_R_flange=turn, base_p_flange=place, gravity=gravity, wrench=others[0] if others else None)


def _pose_numbers(table: FrankaLog, states: LoggedStates, field: str) -> FloatArray:
    """Numbers of a field, of the table where the log lacks it, the identity where that does too; shape (n, 16)."""
    stated = getattr(table, field, None)
    numbers = states.values.get(field)
    if numbers is None:
        numbers = np.broadcast_to(np.eye(4).ravel() if stated is None else stated, (len(states.stamp_ns), 16))
    return numbers


def _pose(table: FrankaLog, field: str, numbers: FloatArray, row: IntArray) -> FloatArray:
    """Matrices of numbers of a field, in these rows of the log; shape (n, 4, 4)."""
    if np.any(numbers[:, _LAST_ROW]) and not np.any(numbers[:, 12:15]):
        raise FormatError(
            f"{table.path}: {field}: expected 16 numbers column by column, as libfranka has them, got them row by row: "
            "transpose them"
        )
    if np.any(numbers[:, _LAST_ROW]) or np.any(numbers[:, 15] != 1.0):
        raise FormatError(f"{table.path}: {field}: expected a pose, whose last row is 0, 0, 0, 1; got another matrix")
    matrices = numbers.reshape(-1, 4, 4).transpose(0, 2, 1)
    rotation = matrices[:, :3, :3]
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        off = np.abs(rotation @ rotation.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
    for k in np.flatnonzero(~(off < _ROUNDING))[:1]:
        raise FormatError(
            f"{table.path}: state {row[k] + 1}: {field}: expected a rotation in the first three rows, got one that is "
            f"off by {off[k]:.3g}"
        )
    return matrices


def _is_lost(wrenches: Sequence[FloatArray]) -> BoolArray:
    """States whose wrench was not estimated: all numbers are exactly zero; shape (n,)."""
    lost: BoolArray = (np.hstack(wrenches) == 0.0).all(axis=1)
    return lost


def _lost_count(states: LoggedStates) -> int:
    fields = [states.values[field] for field in _WRENCHES if field in states.values]
    return sum(int(_is_lost(wrenches).sum()) for wrenches in row_blocks(*fields))


def _flange_wrench(
    logged: Mapping[str, FloatArray], base_H_flange: FloatArray, flange_H_k: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Wrench of the robot, (n, 6), and squares of the difference of its two forms and of the force, (n, 2), or zero."""
    along_base, along_k = (logged.get(field) for field in _WRENCHES)
    squares = np.zeros((len(flange_H_k), 2))
    if along_base is not None:
        base_R_k = base_H_flange[:, :3, :3] @ flange_H_k[:, :3, :3]
        turned = np.hstack([np.einsum("nji,nj->ni", base_R_k, along_base[:, part]) for part in (FORCE, MOMENT)])
        if along_k is not None:
            with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
                parts = (turned[:, FORCE] - along_k[:, FORCE], along_k[:, FORCE])
                squares = np.column_stack([(part**2).sum(axis=1) for part in parts])
        along_k = turned if along_k is None else along_k
    return transform_wrench(flange_H_k, along_k), squares


_DISAGREES = 0.5
"""Share of the force by which its two forms may differ (heuristic); a transposed rotation makes more."""


def _require_agreement(path: Path, squares: FloatArray) -> None:
    difference, size = map(float, squares)
    if difference > _DISAGREES**2 * size:
        share = f"by {100 * np.sqrt(difference / size):.0f} %" if size else "where the second is zero throughout"
        raise FormatError(
            f"{path}: expected O_F_ext_hat_K to be K_F_ext_hat_K turned by O_T_EE and EE_T_K, got forces that differ "
            f"{share}: one of them has other axes, or the poses are transposed"
        )


def _wrist(table: FrankaLog, states: LoggedStates, flange: _Flange) -> LoggedWrist:
    mass, centre = _payload(table, states)
    assumed = ["F_ext_hat_K is the force of the robot on the load"]
    if (end_effector := states.values.get("m_ee")) is not None and end_effector[:, 0].any():
        assumed.append(f"beyond the end effector of {end_effector[-1, 0]:g} kg of Desk")
    return LoggedWrist(
        controller=FrankaFormat.controller,
        stream=WRIST,
        sensor=WRIST,
        measure_direction=_DIRECTION,
        declared=declared_loads(states.stamp_ns, mass, centre),
        moving=motions(states.stamp_ns, flange.base_R_flange, flange.base_p_flange),
        assumed=tuple(assumed),
    )


def _reading(
    table: FrankaLog, states: LoggedStates, flange: _Flange | None, undetermined: Mapping[str, str]
) -> LogReading:
    streams: dict[str, dict[str, Signal]] = {}
    if flange is not None and flange.wrench is not None:
        streams[WRIST] = {
            "wrench": Signal.of_fixed("wrench", flange.wrench, frame=FLANGE),
            "orientation": Signal.of_fixed("orientation", flange.base_R_flange.reshape(-1, 9), frame=FLANGE),
            "gravity": Signal.of_fixed("gravity", flange.gravity, frame=FLANGE),
            "translation": Signal.of_fixed("translation", flange.base_p_flange, frame=FLANGE),
        }
    elif _has_wrench(states):
        field, frame = ("O_F_ext_hat_K", "base") if "O_F_ext_hat_K" in states.values else ("K_F_ext_hat_K", "stiffness")
        streams[WRIST] = {"wrench": Signal.of_fixed("wrench", states.values[field], frame=frame)}
    joints = {"q": ("position", "rad"), "dq": ("velocity", "rad/s"), "tau_J": ("torque", "N m")}
    if signals := _joint_signals(table, states, joints):
        streams["joints"] = signals
    if signals := _joint_signals(table, states, {"tau_ext_hat_filtered": ("torque", "N m")}):
        streams["external_torques"] = signals
    if not streams:
        raise FormatError(
            f"{table.path}: expected a wrench, or q, dq or tau_J, in each state, got {', '.join(states.values)}"
        )
    return LogReading(
        streams=tuple(
            Stream(name=name, clock=CLOCK, stamp_ns=states.stamp_ns, signals=signals)
            for name, signals in streams.items()
        ),
        findings=tuple(_findings(states, undetermined, next(iter(streams)))),
    )


def _joint_signals(table: FrankaLog, states: LoggedStates, fields: Mapping[str, tuple[str, str]]) -> dict[str, Signal]:
    return {
        quantity: Signal(quantity=quantity, values=states.values[field], columns=table.joints, units=(unit,) * 7)
        for field, (quantity, unit) in fields.items()
        if field in states.values
    }


def _findings(states: LoggedStates, undetermined: Mapping[str, str], stream: str) -> Iterator[Finding]:
    for key, words in undetermined.items():
        message = f"{key}: neither log nor format says: {words}"
        yield Finding(stream=stream, kind="undetermined", message=message, count=1)
    yield from repeats_finding(stream, states.repeated)
    if states.is_cut:
        yield Finding(stream=stream, kind="cut_row", message="the last state is cut, and left out", count=1)
    if _has_wrench(states) and (count := _lost_count(states)):
        message = f"{count} wrench(es) of exactly zero, which the controller did not estimate, near a singularity"
        yield Finding(stream=stream, kind="lost_samples", message=message, count=count)
