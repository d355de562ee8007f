# SPDX-License-Identifier: BSD-3-Clause
"""Samples are estimated one by one, however many there are at once."""

from __future__ import annotations

import numpy as np

from forcetorque.estimation.uncertain.estimate_with_covariance import BY_SAMPLE, estimate_with_covariance
from forcetorque.estimation.uncertain.input_errors import Uncertainty
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question, TorqueSum
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF

SAMPLES = 600
JOINTS = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow", "wrist")


def test_a_long_recording_is_its_samples() -> None:
    """Estimates, errors and what is hidden of 600 samples are those of the same in pieces; two touch late only."""
    rng = np.random.default_rng(14)
    question = Question(
        tree=build_tree(read_urdf(ARM_URDF), "base"),
        measured=("arm_ft",),
        contacts=(Contact(link="base"), Contact(link="upper_arm"), Contact(link="hand")),
        torques=JOINTS[:4],
        torque_sum=TorqueSum.SUB_MODEL,
        minimum_norm=MinimumNorm(length_scale=1.0),
    )
    position, velocity, acceleration = rng.uniform(-1.0, 1.0, (3, SAMPLES, len(JOINTS)))
    joints = JointMotion(names=JOINTS, position=position, velocity=velocity, acceleration=acceleration)
    root = RootMotion.fixed([0.0, 0.0, -1.0], gravity=9.81)
    wrench, late = rng.normal(size=(SAMPLES, 6)), np.arange(SAMPLES) >= 570
    columns = rng.normal(size=(SAMPLES, 6, 2))

    def estimated(rows: slice):  # type: ignore[no-untyped-def]
        return estimate_with_covariance(
            question,
            joints.samples(rows),
            root,
            measured=Wrenches.of({"arm_ft": wrench[rows]}),
            active={"hand": late[rows]},
            uncertainty=Uncertainty(measured={"arm_ft": np.eye(6)}, lasting={"arm_ft": columns[rows]}),
            must_be_determined=False,
        )

    whole, pieces = estimated(slice(0, SAMPLES)), [estimated(slice(k, k + 100)) for k in range(0, SAMPLES, 100)]
    for name in BY_SAMPLE:
        together = np.concatenate([getattr(piece, name) for piece in pieces])
        np.testing.assert_allclose(getattr(whole, name), together, atol=1e-10)
    (hidden,) = whole.undetermined
    assert hidden.contacts == ("upper_arm", "hand")
    np.testing.assert_array_equal(hidden.samples, late)
    np.testing.assert_array_equal(whole.determined, ~late)
    assert hidden.directions == pieces[-1].undetermined[0].directions
    assert np.isnan(whole.contact("hand")[late]).any()
    assert np.isfinite(whole.contact("upper_arm")[~late]).all()
    # some of the samples: with what is hidden in them, and with nothing hidden where nothing is
    for kept, sets in ((np.arange(SAMPLES) >= 540, 1), (~late, 0)):
        some = whole.of_samples(kept)
        for name in BY_SAMPLE:
            np.testing.assert_array_equal(getattr(some, name), getattr(whole, name)[kept])
        assert [one.samples.tolist() for one in some.undetermined] == sets * [late[kept].tolist()]
    variances = np.diagonal(whole.torque_covariance, axis1=1, axis2=2)
    np.testing.assert_allclose(whole.torque_sd**2, variances, rtol=1e-12)
    assert (whole.torque_sd[~late] > 0.0).any()
