# SPDX-License-Identifier: BSD-3-Clause
"""A simulated arm with a load, as libfranka writes its states."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import make_pose

GRAVITY = 9.80665
MASS = 0.65
CENTRE = np.array([0.005, -0.004, 0.085])
ZERO = np.array([0.4, -0.3, 0.2, 0.05, 0.02, -0.01])
"""Wrench that is estimated without a load, along the axes of the flange."""
FLANGE_H_EE = make_pose(Rotation.from_euler("z", -45.0, degrees=True).as_matrix(), [0.0, 0.0, 0.1034])
EE_H_K = make_pose(Rotation.from_euler("x", 30.0, degrees=True).as_matrix(), [0.0, 0.01, 0.02])


def by_columns(pose: FloatArray) -> list[float]:
    """As libfranka has a pose."""
    return [float(value) for value in pose.T.ravel()]


def states(
    *, declared: float = 0.0, declared_centre: FloatArray | None = None, poses: int = 8, samples: int = 6, seed: int = 1
) -> list[dict[str, Any]]:
    """Give states of poses at rest, with a load that the controller knows in part, and one lost estimate."""
    rng = np.random.default_rng(seed)
    centre = np.zeros(3) if declared_centre is None else declared_centre
    flange_H_k = FLANGE_H_EE @ EE_H_K
    made = []
    for number, rotation in enumerate(Rotation.random(poses, random_state=seed)):
        base_H_flange = make_pose(rotation.as_matrix(), rng.uniform(-0.4, 0.4, 3))
        gravity = rotation.inv().apply([0.0, 0.0, -GRAVITY])
        # the robot on its environment holds the load up
        wrench = ZERO - np.hstack([(MASS - declared) * gravity, np.cross(MASS * CENTRE - declared * centre, gravity)])
        moment = wrench[3:] - np.cross(flange_H_k[:3, 3], wrench[:3])
        along_k = np.hstack([flange_H_k[:3, :3].T @ wrench[:3], flange_H_k[:3, :3].T @ moment])
        base_R_k = base_H_flange[:3, :3] @ flange_H_k[:3, :3]
        along_base = np.hstack([base_R_k @ along_k[:3], base_R_k @ along_k[3:]])
        for k in range(samples):
            lost = number == 2 and k == 0
            made.append(
                {
                    "O_T_EE": by_columns(base_H_flange @ FLANGE_H_EE),
                    "F_T_EE": by_columns(FLANGE_H_EE),
                    "EE_T_K": by_columns(EE_H_K),
                    "m_ee": 0.73,
                    "m_load": declared,
                    "F_x_Cload": centre.tolist(),
                    "q": [0.1 * number] * 7,
                    "dq": [0] * 7,
                    "tau_J": [float(k)] * 7,
                    "tau_ext_hat_filtered": [0.1] * 7,
                    "O_F_ext_hat_K": [0] * 6 if lost else along_base.tolist(),
                    "K_F_ext_hat_K": [0.0] * 6 if lost else along_k.tolist(),
                    "robot_mode": "Idle",
                    "time": 1000 + 2000 * number + k,
                }
            )
    return made


def write_states(path: Path, made: list[dict[str, Any]]) -> Path:
    """As `std::cout << state << std::endl` writes them."""
    path.write_text("".join(json.dumps(state) + "\n" for state in made), encoding="ascii")
    return path


def write_table(path: Path, made: list[dict[str, Any]]) -> Path:
    """As `logToCSV` writes them: joints alone."""
    fields = ("q", "dq", "tau_J", "tau_ext_hat_filtered")
    names = ["time", "success_rate", *(f"state.{field}[{k}]" for field in fields for k in range(7))]
    rows = [[state["time"], 1, *(value for field in fields for value in state[field])] for state in made]
    path.write_text("\n".join([",".join(names), *(",".join(map(str, row)) for row in rows)]) + "\n", encoding="ascii")
    return path
