# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques from wrenches with errors: of force-torque sensors, or of skin that knows what touches it."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.estimation.fusion.source import TorqueSource
from forcetorque.estimation.question import Question
from forcetorque.estimation.uncertain import Uncertainty, estimate_determined
from forcetorque.robot import JointMotion, RootMotion
from forcetorque.robot.wrenches import Wrenches

OWN_MODEL_SHARE: Final = 0.1
"""Share of the variance of the robot model that is noise of every source alone, beside the whole that they have in
common: each uses other links. It also keeps covariances invertible where torques are more than components of a wrench;
with 0.01 to 0.25 fused errors and intervals of simulated arms differ by less than a tenth."""


def wrench_source(
    name: str,
    question: Question,
    joints: JointMotion,
    root: RootMotion,
    stamp_ns: IntArray,
    *,
    uncertainty: Uncertainty,
    model_deviation: FloatArray,
    measured: Wrenches | None = None,
    known: Wrenches | None = None,
    noise_time_s: float = 0.0,
) -> TorqueSource:
    """Estimate torques, and carry the errors of wrenches to them.

    Torques that are not determined, as of a joint between two contacts that nobody knows, are left to other sources.

    Args:
        name: Name of the source.
        question: What is asked; its torques are those of the source, summed up inside sub-models.
        joints: Motion of the joints; n samples.
        root: Motion of the root link.
        stamp_ns: Instants; shape (n,); ns.
        uncertainty: Errors of the wrenches, by name of the sensor or known contact; those left out are exact.
        model_deviation: Standard deviation of what masses and motion leave open in the torque of each joint; shape
            (j,); N m, N. Other sources of the same robot share these errors.
        measured: Readings of the sensors.
        known: Wrenches of the known contacts.
        noise_time_s: Time over which their noise repeats itself; s.

    Returns:
        The source.

    Raises:
        EstimationError: If an error is of a wrench that is not given, or a covariance is none.
    """
    answer = estimate_determined(question, joints, root, measured=measured, known=known, uncertainty=uncertainty)
    lasting = np.nan_to_num(answer.torque_lasting)
    noise = np.nan_to_num(answer.torque_covariance) - lasting @ lasting.transpose(0, 2, 1)
    return TorqueSource(
        name=name,
        joints=question.torques,
        stamp_ns=stamp_ns,
        torque=answer.torques,
        noise=noise + OWN_MODEL_SHARE * np.diag(model_deviation**2),
        lasting=lasting,
        noise_time_s=noise_time_s,
        shared=np.broadcast_to(np.diag(model_deviation), (len(stamp_ns), len(model_deviation), len(model_deviation))),
    )
