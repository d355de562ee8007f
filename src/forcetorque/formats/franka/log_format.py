# SPDX-License-Identifier: BSD-3-Clause
"""Robot states of libfranka as a format of logs: the wrench at the flange, its orientation, and joint torques [1].

Poses are 16 numbers column by column. The external wrench is that of the robot on its environment, about the origin of
the stiffness frame K, estimated from joint torques less the model of arm, end effector and declared load. It is exactly
zero near singularities, where it is not estimated.

References:
[1] frankarobotics/libfranka, include/franka/robot_state.h, robot.h; issue 26 and franka_ros issue 254 on the sign.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, BoolArray, FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.toml_file import Text, checked_tables
from forcetorque.base.wrench import FORCE, MOMENT, MeasureDirection, transform_wrench
from forcetorque.formats.arm_log import ArmLogTable
from forcetorque.formats.franka.kinematics import joint_frames
from forcetorque.formats.franka.logged_states import LoggedStates, is_logged_states, read_states
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading
from forcetorque.formats.logged_torques import LoggedTorques, holding_torques
from forcetorque.formats.logged_wrist import (
    FLANGE,
    LoggedWrist,
    declared_loads,
    motions,
    repeats_finding,
    weight_of,
)
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
        return LogDescription(
            table=table,
            reading=_reading(table, states, undetermined),
            undetermined=undetermined,
            wrist=_wrist(table, states) if has_wrench else None,
            wrist_lacks="" if has_wrench else _LACKS_WRENCH,
            torques=None if has_wrench else _torques(table, states),
        )

    def read(self, specified: FrankaLog, context: LogContext) -> LogReading:
        """Read the streams with the wrench in the frame of the flange, as far as the log has one."""
        states = read_states(context.file(specified.path))
        for key in _undetermined(specified, states):
            raise FormatError(f"{specified.path}: recording: {key}: expected {_QUESTIONS[key]}; got none")
        return _reading(specified, states, {})


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
    elif "F_x_Cload" not in states.values and table.payload_cog_m is None and _payload(table, states)[0].any():
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
    mass = np.full(count, table.payload_kg or 0.0) if known is None else known[:, 0]
    stated = np.zeros(3) if table.payload_cog_m is None else table.payload_cog_m
    return mass, states.values.get("F_x_Cload", np.broadcast_to(stated, (count, 3)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Poses:
    """Poses of the frames of the wrench."""

    base_H_flange: FloatArray
    """Shape (n, 4, 4); m."""
    flange_H_k: FloatArray
    """Pose of the stiffness frame; shape (n, 4, 4); m."""


def _poses(table: FrankaLog, states: LoggedStates) -> _Poses:
    base_H_ee, flange_H_ee, ee_H_k = (_pose(table, states, field) for field in ("O_T_EE", "F_T_EE", "EE_T_K"))
    inverse = np.zeros_like(flange_H_ee)
    inverse[:, :3, :3] = flange_H_ee[:, :3, :3].transpose(0, 2, 1)
    inverse[:, :3, 3] = -np.einsum("nji,nj->ni", flange_H_ee[:, :3, :3], flange_H_ee[:, :3, 3])
    inverse[:, 3, 3] = 1.0
    return _Poses(base_H_flange=base_H_ee @ inverse, flange_H_k=flange_H_ee @ ee_H_k)


def _pose(table: FrankaLog, states: LoggedStates, field: str) -> FloatArray:
    """Matrices of a field, of the table where the log lacks it, the identity where that does too; shape (n, 4, 4)."""
    stated = getattr(table, field, None)
    numbers = states.values.get(field)
    if numbers is None:
        numbers = np.broadcast_to(np.eye(4).ravel() if stated is None else stated, (len(states.stamp_ns), 16))
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
    for row in np.flatnonzero(~(off < _ROUNDING))[:1]:
        raise FormatError(
            f"{table.path}: state {row + 1}: {field}: expected a rotation in the first three rows, got one that is off "
            f"by {off[row]:.3g}"
        )
    return matrices


def _lost(states: LoggedStates) -> BoolArray:
    """States whose wrench was not estimated: all six numbers are exactly zero; shape (n,)."""
    fields = [states.values[field] for field in ("K_F_ext_hat_K", "O_F_ext_hat_K") if field in states.values]
    lost: BoolArray = (np.hstack(fields) == 0.0).all(axis=1)
    return lost


def _flange_wrench(table: FrankaLog, states: LoggedStates, poses: _Poses) -> FloatArray:
    """Wrench of the robot on the load beyond the flange, declared load included; shape (n, 6); N, N m."""
    base_R_k = poses.base_H_flange[:, :3, :3] @ poses.flange_H_k[:, :3, :3]
    along_k = states.values.get("K_F_ext_hat_K")
    along_base = states.values.get("O_F_ext_hat_K")
    if along_base is not None:
        turned = np.hstack([np.einsum("nji,nj->ni", base_R_k, along_base[:, part]) for part in (FORCE, MOMENT)])
        if along_k is not None:
            _require_agreement(table.path, turned, along_k)
        along_k = turned if along_k is None else along_k
    if along_k is None:
        raise FormatError(f"{table.path}: expected O_F_ext_hat_K or K_F_ext_hat_K, got none")
    wrench = transform_wrench(poses.flange_H_k, along_k)
    mass, centre = _payload(table, states)
    gravity = np.einsum("nji,j->ni", poses.base_H_flange[:, :3, :3], table.world_gravity)
    wrench = wrench - weight_of(mass, centre, gravity)  # the robot holds up the weight
    wrench[_lost(states)] = np.nan
    return wrench


_DISAGREES = 0.5
"""Share of the force by which its two forms may differ (heuristic); a transposed rotation makes more."""


def _require_agreement(path: Path, turned: FloatArray, along_k: FloatArray) -> None:
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        parts = (turned[:, FORCE] - along_k[:, FORCE], along_k[:, FORCE])
        difference, size = (float((part**2).sum()) for part in parts)
    if difference > _DISAGREES**2 * size:
        share = f"by {100 * np.sqrt(difference / size):.0f} %" if size else "where the second is zero throughout"
        raise FormatError(
            f"{path}: expected O_F_ext_hat_K to be K_F_ext_hat_K turned by O_T_EE and EE_T_K, got forces that differ "
            f"{share}: one of them has other axes, or the poses are transposed"
        )


def _wrist(table: FrankaLog, states: LoggedStates) -> LoggedWrist:
    poses = _poses(table, states)
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
        moving=motions(states.stamp_ns, poses.base_H_flange[:, :3, :3], poses.base_H_flange[:, :3, 3]),
        assumed=tuple(assumed),
    )


def _reading(table: FrankaLog, states: LoggedStates, undetermined: Mapping[str, str]) -> LogReading:
    streams: dict[str, dict[str, Signal]] = {}
    if _has_wrench(states) and not undetermined:
        poses = _poses(table, states)
        orientation = poses.base_H_flange[:, :3, :3]
        gravity = np.einsum("nji,j->ni", orientation, table.world_gravity)
        streams[WRIST] = {
            "wrench": Signal.of_fixed("wrench", _flange_wrench(table, states, poses), frame=FLANGE),
            "orientation": Signal.of_fixed("orientation", orientation.reshape(-1, 9), frame=FLANGE),
            "gravity": Signal.of_fixed("gravity", gravity, frame=FLANGE),
            "translation": Signal.of_fixed("translation", poses.base_H_flange[:, :3, 3], frame=FLANGE),
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
    if _has_wrench(states) and (count := int(_lost(states).sum())):
        message = f"{count} wrench(es) of exactly zero, which the controller did not estimate, near a singularity"
        yield Finding(stream=stream, kind="lost_samples", message=message, count=count)
