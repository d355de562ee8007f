# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques from wrenches with errors: of force-torque sensors, or of skin that knows what touches it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only
from forcetorque.errors import EstimationError, known_names
from forcetorque.estimation.estimate import estimate
from forcetorque.estimation.fusion.source import TorqueSource
from forcetorque.estimation.question import Question
from forcetorque.robot import JointMotion, RootMotion
from forcetorque.robot.wrenches import Wrenches


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WrenchError:
    """How far a wrench may be off."""

    noise: FloatArray
    """Covariance of what differs from sample to sample; shape (6, 6), or (n, 6, 6) per sample; N, N m."""
    lasting: FloatArray
    """What one standard deviation of each of p independent errors that last adds; shape (6, p), or (n, 6, p); N, N
    m."""

    def __post_init__(self) -> None:
        for field, columns in (("noise", 6), ("lasting", None)):
            values = np.asarray(getattr(self, field), dtype=np.float64)
            shape = (6, columns) if values.ndim < 3 else (None, 6, columns)
            object.__setattr__(self, field, read_only(values, name=field, shape=shape))


def wrench_source(
    name: str,
    question: Question,
    joints: JointMotion,
    root: RootMotion,
    stamp_ns: IntArray,
    *,
    errors: dict[str, WrenchError],
    floor: float,
    measured: Wrenches | None = None,
    known: Wrenches | None = None,
    noise_time_s: float = 0.0,
) -> TorqueSource:
    """Estimate torques, and carry the errors of wrenches to them.

    Torques are linear in readings and known wrenches, so what a unit of each adds is exact.

    Args:
        name: Name of the source.
        question: What is asked; its torques are those of the source.
        joints: Motion of the joints; n samples.
        root: Motion of the root link.
        stamp_ns: Instants; shape (n,); ns.
        errors: Errors by name of the sensor or known contact; those left out are exact.
        floor: Standard deviation of what masses and motion leave open in every torque, sample by sample; N m, N.
        measured: Readings of the sensors.
        known: Wrenches of the known contacts.
        noise_time_s: Time over which their noise repeats itself; s.

    Returns:
        The source.

    Raises:
        EstimationError: If an error is of a wrench that is not given.
    """

    def torques(changed: Wrenches | None, given: Wrenches | None) -> FloatArray:
        return estimate(question, joints, root, measured=changed, known=given).torques

    torque = torques(measured, known)
    noise = np.broadcast_to(floor**2 * np.eye(torque.shape[1]), (*torque.shape, torque.shape[1])).copy()
    lasting = [np.zeros((*torque.shape, 0))]
    for wrench, error in errors.items():
        if measured is not None and wrench in measured.names:
            effects = _unit_effects(measured, wrench, lambda changed: torques(changed, known), torque)
        elif known is not None and wrench in known.names:
            effects = _unit_effects(known, wrench, lambda changed: torques(measured, changed), torque)
        else:
            given = [one for wrenches in (measured, known) if wrenches is not None for one in wrenches.names]
            raise EstimationError(
                f"source {name!r}: errors: no wrench {wrench!r} is given; {known_names(wrench, given)}"
            )
        noise += effects @ error.noise @ effects.transpose(0, 2, 1)
        lasting.append(effects @ error.lasting)
    return TorqueSource(
        name=name,
        joints=question.torques,
        stamp_ns=stamp_ns,
        torque=torque,
        noise=np.nan_to_num(noise),
        lasting=np.nan_to_num(np.concatenate(lasting, axis=2)),
        noise_time_s=noise_time_s,
    )


def _unit_effects(
    wrenches: Wrenches, name: str, torques: Callable[[Wrenches], FloatArray], before: FloatArray
) -> FloatArray:
    """What a unit of every component of a wrench adds to the torques; shape (n, j, 6)."""
    column = wrenches.names.index(name)
    effects = np.empty((*before.shape, 6))
    for k in range(6):
        values = np.array(wrenches.values)
        values[:, column, k] += 1.0
        effects[:, :, k] = torques(Wrenches(names=wrenches.names, values=values)) - before
    return effects
