# SPDX-License-Identifier: BSD-3-Clause
"""A simulated UR5 that moves between postures with a tool, as its controller sends it over RTDE."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray

GRAVITY = 9.80665
RATE_HZ = 125.0
FORCE = [f"actual_TCP_force_{k}" for k in range(3)]
MOMENT = [f"actual_TCP_force_{k}" for k in range(3, 6)]
_LENGTHS_D = (0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823)
_LENGTHS_A = (0.0, -0.425, -0.39225, 0.0, 0.0, 0.0)
_TWISTS = (np.pi / 2, 0.0, 0.0, np.pi / 2, -np.pi / 2, 0.0)
"""Denavit-Hartenberg parameters that the maker publishes; m, rad."""
_NOISE = np.repeat([0.08, 0.006], 3)
"""White noise of each sample; N, N m."""
_SLOW = 0.3
"""Size of slow noise, which forgets itself in a second, beside the white one."""


@dataclass(frozen=True, kw_only=True)
class Recording:
    """A recording, and the truth of its tool."""

    columns: dict[str, FloatArray]
    """Columns of the log."""
    pose: FloatArray
    """Poses of the flange in the base; shape (n, 4, 4); m."""
    reading: FloatArray
    """Wrench at the flange as it is logged, along the axes of the flange; shape (n, 6); N, N m."""
    raw: FloatArray
    """The same before the declared payload is subtracted."""
    mass: float
    """kg."""
    centre: FloatArray
    """In the flange; shape (3,); m."""


def flange_poses(joints: FloatArray) -> FloatArray:
    """Pose of the flange in the base of a UR5; joints of shape (n, 6), rad; shape (n, 4, 4); m."""
    pose = np.broadcast_to(np.eye(4), (len(joints), 4, 4))
    for angle, d, a, twist in zip(joints.T, _LENGTHS_D, _LENGTHS_A, _TWISTS, strict=True):
        c, s, ct, st = np.cos(angle), np.sin(angle), np.cos(twist), np.sin(twist)
        zero, one = np.zeros_like(c), np.ones_like(c)
        rows = [[c, -s * ct, s * st, a * c], [s, c * ct, -c * st, a * s], [zero, st * one, ct * one, d * one]]
        step = np.stack([np.stack(row, axis=-1) for row in (*rows, [zero, zero, zero, one])], axis=1)
        pose = pose @ step
    return pose


def load_on_flange(rng: np.random.Generator, pose: FloatArray, mass: float, centre: FloatArray) -> FloatArray:
    """Wrench of a moving tool on the flange with noise; poses of shape (n, 4, 4); shape (n, 6); N, N m."""
    turn, place = Rotation.from_matrix(pose[:, :3, :3]), pose[:, :3, 3]
    of_mass = place + turn.apply(centre)
    acceleration = np.gradient(np.gradient(of_mass, 1.0 / RATE_HZ, axis=0), 1.0 / RATE_HZ, axis=0)
    force = mass * turn.inv().apply([0.0, 0.0, -GRAVITY] - acceleration)
    white = rng.normal(size=(len(pose), 12))
    slow = lfilter([np.sqrt(1.0 - np.exp(-2.0 / RATE_HZ))], [1.0, -np.exp(-1.0 / RATE_HZ)], white[:, 6:], axis=0)
    return np.hstack([force, np.cross(centre, force)]) + _NOISE * (white[:, :6] + _SLOW * slow)


def held_and_moved(held: FloatArray) -> FloatArray:
    """Angles of postures that are held for a second, with a smooth second between them; shape (n, d); rad."""
    t = np.linspace(0.0, 1.0, round(RATE_HZ))[:, None]
    smooth = 10 * t**3 - 15 * t**4 + 6 * t**5
    parts = [np.repeat(held[:1], len(t), axis=0)]
    for before, after in zip(held[:-1], held[1:], strict=True):
        parts += [before + (after - before) * smooth, np.repeat(after[None], len(t), axis=0)]
    return np.concatenate(parts)


def simulated(seed: int, *, declared_shares: Sequence[float] = (0.0, 0.5, 1.5), postures: int = 12) -> Recording:
    """Simulate a recording whose tool, TCP, zero and declared payload, a share of the mass, are drawn."""
    rng = np.random.default_rng(seed)
    mass, centre = rng.uniform(0.3, 3.0), np.append(rng.uniform(-0.03, 0.03, 2), rng.uniform(0.03, 0.12))
    zero = rng.normal(size=6) * np.repeat([3.0, 0.3], 3)
    offset = np.append(rng.uniform(-0.05, 0.05, 2), [rng.uniform(0.05, 0.2), *rng.uniform(-1.0, 1.0, 3)])
    declared = mass * rng.choice(declared_shares)
    joints = held_and_moved(rng.uniform(-1.5, 1.5, (postures, 6)) + [0.0, -1.5, 1.2, 0.0, 1.5, 0.0])
    pose = flange_poses(joints)
    turn, place = Rotation.from_matrix(pose[:, :3, :3]), pose[:, :3, 3]
    load = load_on_flange(rng, pose, mass, centre)
    known = declared * turn.inv().apply([0.0, 0.0, -GRAVITY])
    reading = load + zero - np.hstack([known, np.cross([0.0, 0.0, 0.05], known)])
    tcp_turn = turn * Rotation.from_rotvec(offset[3:])
    fields = {
        "actual_q": joints,
        "actual_TCP_pose": np.hstack([place + turn.apply(offset[:3]), tcp_turn.as_rotvec()]),
        "actual_TCP_force": np.hstack([turn.apply(reading[:, :3]), turn.apply(reading[:, 3:])]),
        "tcp_offset": np.tile(offset, (len(joints), 1)),
        "payload_cog": np.tile([0.0, 0.0, 0.05], (len(joints), 1)),
    }
    columns = {"timestamp": np.arange(len(joints)) / RATE_HZ, "payload": np.full(len(joints), declared)}
    columns |= {f"{field}_{k}": values[:, k] for field, values in fields.items() for k in range(values.shape[1])}
    return Recording(columns=columns, pose=pose, reading=reading, raw=load + zero, mass=mass, centre=centre)


def with_columns(recording: Recording, **columns: FloatArray) -> Recording:
    """The recording with other columns."""
    return replace(recording, columns=recording.columns | columns)


def reaction(recording: Recording) -> Recording:
    """The force on the tool in place of that on the arm."""
    return with_columns(recording, **{name: -recording.columns[name] for name in (*FORCE, *MOMENT)})


def tool_axes(recording: Recording) -> Recording:
    """The force along the axes of the flange, as a program may have turned it."""
    tcp, offset = (
        Rotation.from_rotvec(np.column_stack([recording.columns[f"{field}_{k}"] for k in (3, 4, 5)]))
        for field in ("actual_TCP_pose", "tcp_offset")
    )
    turn = tcp * offset.inv()
    columns: dict[str, FloatArray] = {}
    for names in (FORCE, MOMENT):
        turned = turn.inv().apply(np.column_stack([recording.columns[name] for name in names]))
        columns |= dict(zip(names, turned.T, strict=True))
    return with_columns(recording, **columns)


def newton_millimetres(recording: Recording) -> Recording:
    """Moments in N mm."""
    return with_columns(recording, **{name: 1e3 * recording.columns[name] for name in MOMENT})


def millimetres(recording: Recording) -> Recording:
    """Positions in mm."""
    names = [f"actual_TCP_pose_{k}" for k in range(3)]
    return with_columns(recording, **{name: 1e3 * recording.columns[name] for name in names})


def about_tcp(recording: Recording) -> Recording:
    """The moment about the tool centre point, as an external sensor has it, where that about the flange is stated."""
    offset, turn = np.split(np.column_stack([recording.columns[f"tcp_offset_{k}"] for k in range(6)]), 2, axis=1)
    rotation = Rotation.from_rotvec(np.column_stack([recording.columns[f"actual_TCP_pose_{k}"] for k in (3, 4, 5)]))
    lever = (rotation * Rotation.from_rotvec(turn).inv()).apply(offset)
    force, moment = (np.column_stack([recording.columns[name] for name in names]) for names in (FORCE, MOMENT))
    return with_columns(recording, **dict(zip(MOMENT, (moment - np.cross(lever, force)).T, strict=True)))


def with_raw_wrench(recording: Recording) -> Recording:
    """The reading of the sensor beside it, as e-Series has it."""
    return with_columns(recording, **{f"ft_raw_wrench_{k}": values for k, values in enumerate(recording.raw.T)})
