# SPDX-License-Identifier: BSD-3-Clause
"""An arm with the geometry of a Franka, moved by MuJoCo, with pushes on its links: what it logs, and the truth.

Joint frames are those of the data sheet (modified Denavit-Hartenberg), masses and centres those of Gaz et al., Dynamic
identification of the Franka Emika Panda robot, 2019; moments of inertia are those of solid cylinders, ours.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray

RATE_HZ, STEP_S = 250, 0.001
_HALF = np.pi / 2.0
_FRAMES = (
    ("0 0 0.333", 0.0),
    ("0 0 0", -_HALF),
    ("0 -0.316 0", _HALF),
    ("0.0825 0 0", _HALF),
    ("-0.0825 0.384 0", -_HALF),
    ("0 0 0", _HALF),
    ("0.088 0 0", _HALF),
)
"""Origin and turn about x of each joint in the one before."""
_MASSES = np.array([4.970684, 0.646926, 3.228604, 3.587895, 1.225946, 1.666555, 0.735522])
_CENTRES = np.array(
    [
        [0.003875, 0.002081, -0.04762],
        [-0.003141, -0.02872, 0.003495],
        [0.027518, 0.039252, -0.066502],
        [-0.05317, 0.104419, 0.027454],
        [-0.011953, 0.041065, -0.038437],
        [0.060149, -0.014117, -0.010517],
        [0.010517, -0.004252, 0.061597],
    ]
)
_HOME = np.array([0.0, -0.6, 0.0, -2.0, 0.0, 1.6, 0.6])
_SWING = np.array([0.7, 0.4, 0.6, 0.5, 0.7, 0.6, 0.8])
_COULOMB = np.array([0.5, 0.5, 0.4, 0.4, 0.2, 0.2, 0.15])
_VISCOUS = np.array([0.4, 0.4, 0.3, 0.3, 0.15, 0.15, 0.1])
"""Friction of the joints, which no model states; N m, N m s."""
_STIFF, _DAMPING = 100.0, 20.0
"""Of the controller: 1/s2, 1/s."""
TORQUE_NOISE, VELOCITY_NOISE = 0.03, 5e-4
"""Of a sample; N m, rad/s."""
JOINTS = tuple(f"joint{k}" for k in range(1, 8))
LINKS = tuple(f"link{k}" for k in range(1, 8))
PERIOD_S, PUSH_S = 4.0, 0.4


@dataclass(frozen=True, slots=True, kw_only=True)
class Push:
    """What pushes a link."""

    start_s: float
    """Begin; s."""
    link: str
    """The link."""
    force_N: float
    """Size of the force; N."""


def urdf_text(masses: FloatArray) -> str:
    """Write the arm with masses; shape (7,); kg."""
    parts = ['<robot name="franka_like"><link name="link0"/>']
    before = "link0"
    for k, (origin, turn) in enumerate(_FRAMES):
        mass, (x, y, z) = masses[k], _CENTRES[k]
        across, along = mass * (0.06**2 / 4.0 + 0.25**2 / 12.0), mass * 0.06**2 / 2.0
        parts.append(
            f'<link name="{LINKS[k]}"><inertial><origin xyz="{x} {y} {z}"/><mass value="{mass}"/>'
            f'<inertia ixx="{across}" ixy="0" ixz="0" iyy="{across}" iyz="0" izz="{along}"/></inertial></link>'
            f'<joint name="{JOINTS[k]}" type="revolute"><parent link="{before}"/><child link="{LINKS[k]}"/>'
            f'<origin xyz="{origin}" rpy="{turn} 0 0"/><axis xyz="0 0 1"/>'
            '<limit lower="-3" upper="4" effort="90" velocity="3"/></joint>'
        )
        before = LINKS[k]
    return "".join([*parts, "</robot>"])


def pushes(seed: int, duration_s: float, first_s: float, forces_N: tuple[float, ...]) -> tuple[Push, ...]:
    """Draw a push every four seconds, of the sizes in turn, on links 3 to 7."""
    rng = np.random.default_rng((seed, 5))
    starts = np.arange(first_s, duration_s - PERIOD_S, PERIOD_S) + rng.uniform(0.5, 2.0)
    return tuple(
        Push(start_s=float(start), link=LINKS[int(rng.integers(2, 7))], force_N=forces_N[k % len(forces_N)])
        for k, start in enumerate(starts)
    )


def write_arm(
    folder: Path,
    seed: int,
    duration_s: float,
    planted: tuple[Push, ...],
    *,
    free_s: float,
    mass_error: float = 0.02,
    friction: float = 1.0,
    noise: float = 1.0,
) -> Path:
    """Move the arm, and write its log and experiment file; the URDF has masses that are off.

    Args:
        folder: Where to; made.
        seed: Of motion, noise, and errors of the masses.
        duration_s: Length; s.
        planted: Pushes.
        free_s: End of the interval `free`, in which nothing touches; s.
        mass_error: Standard deviation of the masses of the URDF, relative.
        friction: Times the friction of the joints.
        noise: Times the noise of torques and velocities.

    Returns:
        The experiment file.
    """
    import mujoco

    rng = np.random.default_rng((seed, 1))
    model = mujoco.MjModel.from_xml_string(urdf_text(_MASSES))
    model.opt.timestep = STEP_S
    model.dof_damping[:], model.dof_frictionloss[:] = friction * _VISCOUS, friction * _COULOMB
    data = mujoco.MjData(model)
    rates, phases = rng.uniform(0.15, 0.35, (3, 7)) * np.array([[1.0], [1.7], [2.9]]), rng.uniform(0, 6.28, (3, 7))
    shares = np.array([[0.6], [0.3], [0.1]])

    def wanted(time_s: float) -> tuple[FloatArray, FloatArray]:
        turn = 2.0 * np.pi * rates * time_s + phases
        position = _HOME + _SWING * (shares * np.sin(turn)).sum(axis=0)
        return position, _SWING * (shares * 2.0 * np.pi * rates * np.cos(turn)).sum(axis=0)

    data.qpos[:], data.qvel[:] = wanted(0.0)
    directions = [_unit(rng) for _ in planted]
    bodies = {link: mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, link) for link in LINKS}
    driven = np.zeros(7)
    truth: list[FloatArray] = []
    rows, every = [], round(1.0 / (RATE_HZ * STEP_S))
    for k in range(round(duration_s / STEP_S)):
        time_s = k * STEP_S
        mujoco.mj_forward(model, data)
        position, velocity = wanted(time_s)
        mujoco.mj_mulM(model, data, driven, _STIFF * (position - data.qpos) + _DAMPING * (velocity - data.qvel))
        torque = data.qfrc_bias + driven
        data.qfrc_applied[:] = torque
        data.xfrc_applied[:] = 0.0
        pushed = np.zeros(7)
        for push, direction in zip(planted, directions, strict=True):
            if push.start_s <= time_s < push.start_s + PUSH_S:
                ramp = min(1.0, (time_s - push.start_s) / 0.03, (push.start_s + PUSH_S - time_s) / 0.03)
                body = bodies[push.link]
                data.xfrc_applied[body, :3] = ramp * push.force_N * direction
                mujoco.mj_applyFT(model, data, data.xfrc_applied[body, :3], np.zeros(3), data.xipos[body], body, pushed)
        if k % every == 0:
            rows.append(np.concatenate([[time_s], data.qpos, data.qvel, torque]))
            truth.append(np.concatenate([[time_s], pushed]))
        mujoco.mj_step(model, data)
    log = np.array(rows)
    log[:, 8:15] += noise * VELOCITY_NOISE * rng.standard_normal((len(log), 7))
    log[:, 15:] += noise * TORQUE_NOISE * rng.standard_normal((len(log), 7))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "arm.urdf").write_text(urdf_text(_MASSES * (1.0 + mass_error * rng.standard_normal(7))), encoding="utf-8")
    names = ["t", *(f"{kind}{k}" for kind in ("q", "dq", "tau") for k in range(1, 8))]
    np.savetxt(folder / "log.csv", log, delimiter=",", header=",".join(names), comments="", fmt="%.7f")
    np.savetxt(folder / "truth.csv", np.array(truth), delimiter=",")
    file = folder / "arm.toml"
    file.write_text(_experiment(free_s, duration_s), encoding="utf-8")
    return file


def true_torques(folder: Path) -> tuple[FloatArray, FloatArray]:
    """Give the joint torques of the pushes, by MuJoCo's own Jacobians; instants, s, and shape (n, 7), N m."""
    values = np.loadtxt(folder / "truth.csv", delimiter=",")
    return values[:, 0], values[:, 1:]


def _unit(rng: Any) -> FloatArray:
    direction = rng.standard_normal(3)
    return np.asarray(direction / np.linalg.norm(direction))


def _experiment(free_s: float, duration_s: float) -> str:
    def signal(quantity: str, columns: str, unit: str) -> str:
        names = ", ".join(f'"{joint}"' for joint in JOINTS)
        given = ", ".join(f'"{columns}{k}"' for k in range(1, 8))
        units = ", ".join(f'"{unit}"' for _ in JOINTS)
        return f'  {{ quantity = "{quantity}", columns = [{given}], names = [{names}], units = [{units}] }},\n'

    return (
        'schema = "forcetorque/experiment/1"\nname = "arm with pushes"\n\n[robot]\nurdf = "arm.urdf"\n\n'
        '[recording]\nformat = "tabular"\npath = "."\n\n[[recording.stream]]\nname = "joints"\nfile = "log.csv"\n'
        'stamp = { column = "t", unit = "s" }\nsignal = [\n'
        + signal("position", "q", "rad")
        + signal("velocity", "dq", "rad/s")
        + signal("torque", "tau", "N m")
        + ']\n\n[[support]]\nframe = "link0"\ngravity_direction = [0.0, 0.0, -1.0]\n\n'
        f'[[interval]]\nlabel = "free"\nstart_s = 0.5\nend_s = {free_s}\nuse = "calibration"\nsupport = "link0"\n\n'
        f'[[interval]]\nlabel = "watched"\nstart_s = {free_s}\nend_s = {duration_s - 0.1:g}\nuse = "validation"\n'
        'support = "link0"\n'
    )
