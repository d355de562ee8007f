# SPDX-License-Identifier: BSD-3-Clause
"""Readings of a simulated wrist sensor under loads, with known truth."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem, LoadRows

MASS, CENTRE = 1.3, np.array([0.01, -0.02, 0.06])
SIZES = np.array([0.05, 0.05, 0.08, 0.003, 0.003, 0.003])
"""White noise of the six axes; N, N m."""
GRAVITY = 9.80665


def poses(count: int, rng: np.random.Generator) -> np.ndarray:
    """Gravity along the sensor's axes in random still poses; m/s2."""
    directions = rng.normal(size=(count, 3))
    return GRAVITY * directions / np.linalg.norm(directions, axis=1, keepdims=True)


def weight(gravity: np.ndarray, mass: float = MASS, centre: np.ndarray = CENTRE) -> np.ndarray:
    """What a sensor that reads the wrench of the child on its parent says of a still load."""
    return np.hstack([mass * gravity, np.cross(centre, mass * gravity)])


def problem_of(
    wrench: np.ndarray, gravity: np.ndarray, *, loads: tuple[Load, ...] = (Load(name="tool"),), **fields: object
) -> LoadProblem:
    """A problem of poses in one session; fields are those of the rows, and of the problem."""
    own = {
        name: fields.pop(name)
        for name in ("direction", "drift", "mount", "tilt", "matrix_prior", "variables_named", "sessions", "blocks")
        if name in fields
    }
    rows = LoadRows.of_poses(wrench, -gravity, **fields)  # type: ignore[arg-type]
    sessions = own.pop("sessions", tuple(f"session {k}" for k in range(int(rows.session.max()) + 1)))
    return LoadProblem(
        rows=rows,
        loads=loads,
        sessions=sessions,
        blocks=own.pop("blocks", tuple(f"interval {k}" for k in range(int(rows.block.max()) + 1))),
        direction=own.pop("direction", MeasureDirection.CHILD_TO_PARENT),
        variables=own.pop("variables_named", ()),
        **own,  # type: ignore[arg-type]
    )


def slow(count: int, time_constant: float, rng: np.random.Generator) -> np.ndarray:
    """An Ornstein-Uhlenbeck process of variance 1, a step per second; shape (count,)."""
    kept = np.exp(-1.0 / time_constant)
    steps = np.sqrt(1.0 - kept**2) * rng.normal(size=count)
    values = np.empty(count)
    values[0] = rng.normal()
    for k in range(1, count):
        values[k] = kept * values[k - 1] + steps[k]
    return values


@dataclass(frozen=True, kw_only=True, eq=False)
class PowerUps:
    """Four power-ups of two minutes, a pose every five seconds: slow noise, drift, and a bias that jumps between."""

    seed: int
    jump: float = 18.0
    """Difference of the Fz bias of the last and the first power-up; N."""
    drifts: bool = True
    count: int = 4
    length: int = 120
    time_constant: float = 15.0
    bias: np.ndarray = field(init=False)
    drift: np.ndarray = field(init=False)
    problem: LoadProblem = field(init=False)

    def __post_init__(self) -> None:
        rng = np.random.default_rng(self.seed)
        n, s = self.length, self.count
        gravity = np.repeat(poses(s * n // 5, rng), 5, axis=0)
        bias = rng.normal(size=(s, 6)) * [5.0, 5.0, 5.0, 0.3, 0.3, 0.3]
        bias[:, 2] = bias[0, 2] + self.jump * np.linspace(0.0, 1.0, s)
        drift = rng.normal(size=(s, 6)) * SIZES * 5.0 / n if self.drifts else np.zeros((s, 6))
        time = np.arange(float(n))
        reading = weight(gravity)
        for k in range(s):
            noise = rng.normal(size=(n, 6)) + np.column_stack([slow(n, self.time_constant, rng) for _ in range(6)])
            reading[k * n : (k + 1) * n] += bias[k] + np.outer(time - time.mean(), drift[k]) + SIZES * noise
        session = np.repeat(np.arange(s), n)
        problem = problem_of(reading, gravity, session=session, time_s=np.tile(time, s), block=session)
        for name, value in (("bias", bias), ("drift", drift), ("problem", problem)):
            object.__setattr__(self, name, value)
