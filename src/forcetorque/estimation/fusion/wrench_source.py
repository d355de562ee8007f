# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques from wrenches with errors: of force-torque sensors, or of skin that knows what touches it."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import IntArray
from forcetorque.estimation.fusion.source import TorqueSource
from forcetorque.estimation.question import Question
from forcetorque.estimation.uncertain import Uncertainty, estimate_determined
from forcetorque.robot import JointMotion, RootMotion
from forcetorque.robot.wrenches import Wrenches


def wrench_source(
    name: str,
    question: Question,
    joints: JointMotion,
    root: RootMotion,
    stamp_ns: IntArray,
    *,
    uncertainty: Uncertainty,
    floor: float,
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
        floor: Standard deviation of what masses and motion leave open in every torque, sample by sample; N m, N.
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
        noise=noise + floor**2 * np.eye(len(question.torques)),
        lasting=lasting,
        noise_time_s=noise_time_s,
    )
