# SPDX-License-Identifier: BSD-3-Clause
"""Errors of wrenches reach torques by the one linear map of the estimator, and what is not determined is left out."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError
from forcetorque.estimation.torque.torque_source import OWN_MODEL_SHARE, TorqueSource, wrench_source
from forcetorque.estimation.uncertain.input_errors import Uncertainty
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question, TorqueSum
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF

JOINTS = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow")
SAMPLES = 5
ROUNDING = 1e-12
"""Products of matrices of some newton metres, summed over six bodies, err by some 1e-15 each."""
MODEL = np.array([0.02, 0.1, 0.05, 0.2])
"""Deviations of the model, by joint; N m."""


def _motion(rng: np.random.Generator) -> tuple[JointMotion, RootMotion]:
    names = (*JOINTS, "wrist")
    position, velocity, acceleration = rng.uniform(-1.0, 1.0, (3, SAMPLES, len(names)))
    joints = JointMotion(names=names, position=position, velocity=velocity, acceleration=acceleration)
    return joints, RootMotion.fixed([0.0, 0.0, -1.0], gravity=9.81)


def _question(*contacts: Contact, ft: bool) -> Question:
    return Question(
        tree=build_tree(read_urdf(ARM_URDF), "base"),
        measured=("arm_ft",) if ft else (),
        contacts=(Contact(link="base"), *contacts),
        torques=JOINTS,
        torque_sum=TorqueSum.SUB_MODEL,
        minimum_norm=MinimumNorm(length_scale=1.0),
    )


def _source(question: Question, name: str, wrench: FloatArray, uncertainty: Uncertainty, seed: int) -> TorqueSource:
    joints, root = _motion(np.random.default_rng(seed))
    given = Wrenches.of({name: wrench})
    return wrench_source(
        "some",
        question,
        joints,
        root,
        np.arange(SAMPLES) * 1_000_000,
        uncertainty=uncertainty,
        model_deviation=MODEL,
        measured=given if name == "arm_ft" else None,
        known=None if name == "arm_ft" else given,
    )


@pytest.mark.parametrize("name", ["arm_ft", "push"])
def test_errors_go_to_torques_as_estimator_runs_say(name: str) -> None:
    """Six runs of the plain estimator, one more unit of each component each, tell the same torques and covariances."""
    rng = np.random.default_rng(4)
    wrench, root_of_noise, lasting = rng.normal(size=(SAMPLES, 6)), rng.normal(size=(6, 6)), rng.normal(size=(6, 2))
    noise = root_of_noise @ root_of_noise.T
    ft = name == "arm_ft"
    touched = Contact(link="forearm", name="push", type=ContactType.WRENCH if ft else ContactType.KNOWN)
    question = _question(touched, ft=ft)
    stated = Uncertainty(
        measured={name: noise} if ft else {}, known={} if ft else {name: noise}, lasting={name: lasting}
    )
    source = _source(question, name, wrench, stated, seed=5)
    joints, root = _motion(np.random.default_rng(5))

    def torques(values: FloatArray) -> FloatArray:
        given = Wrenches.of({name: values})
        return estimate(question, joints, root, measured=given if ft else None, known=None if ft else given).torques

    before = torques(wrench)
    effects = np.stack([torques(wrench + unit) - before for unit in np.eye(6)], axis=2)  # (n, j, 6)
    np.testing.assert_allclose(source.torque, before, atol=ROUNDING)
    own = OWN_MODEL_SHARE * np.diag(MODEL**2)
    np.testing.assert_allclose(source.noise, effects @ noise @ effects.transpose(0, 2, 1) + own, atol=ROUNDING)
    np.testing.assert_allclose(source.shared, np.tile(np.diag(MODEL), (SAMPLES, 1, 1)), atol=ROUNDING)
    np.testing.assert_allclose(source.lasting, effects @ lasting, atol=ROUNDING)
    # negative control: an error there is seen in the torques
    assert np.abs(effects).max() > 0.1


def _stated(noise: FloatArray, shared: FloatArray) -> TorqueSource:
    samples, joints, _ = noise.shape
    return TorqueSource(
        name="some",
        joints=JOINTS[:joints],
        stamp_ns=np.arange(samples),
        torque=np.zeros((samples, joints)),
        noise=noise,
        lasting=np.random.default_rng(2).normal(size=(samples, joints, 2)),
        shared=shared,
    )


def test_the_covariance_of_a_source_is_that_of_all_its_errors() -> None:
    """Noise, what lasts and what is shared are independent; counted as noise of its own, what is shared stays."""
    rng = np.random.default_rng(3)
    roots, shared = rng.normal(size=(SAMPLES, 3, 3)), rng.normal(size=(SAMPLES, 3, 2))
    source = _stated(roots @ roots.swapaxes(1, 2) + np.eye(3), shared)
    by_hand = [
        sum(np.outer(column, column) for matrix in (lasting, common) for column in matrix.T) + noise
        for noise, lasting, common in zip(source.noise, source.lasting, shared, strict=True)
    ]
    np.testing.assert_allclose(source.covariance, by_hand, atol=ROUNDING)
    np.testing.assert_allclose(source.own_covariance + shared @ shared.swapaxes(1, 2), by_hand, atol=ROUNDING)
    alone = source.independent
    assert alone.shared.shape == (SAMPLES, 3, 0)
    np.testing.assert_allclose(alone.own_covariance, by_hand, atol=ROUNDING)
    np.testing.assert_array_equal(alone.lasting, source.lasting)


@pytest.mark.parametrize("size", [1e-8, 1.0, 1e8])
def test_rounding_is_told_from_an_asymmetry_of_noise_in_any_unit(size: float) -> None:
    """Noise of any size may be as unsymmetric as rounding makes it, and no more."""
    noise = np.eye(2)[None].repeat(SAMPLES, axis=0)
    noise[1, 0, 1] = 1e-13
    np.testing.assert_array_equal(_stated(size * noise, np.zeros((0, 0, 0))).noise, size * noise)
    noise[1, 0, 1] = 1e-4
    with pytest.raises(EstimationError, match="sample 1: noise: expected a symmetric covariance"):
        _stated(size * noise, np.zeros((0, 0, 0)))


def test_a_torque_that_is_not_determined_is_left_to_others() -> None:
    """Beyond the sensor two links may be touched anyhow: joints between them are silent, those inboard are not."""
    wrench = np.random.default_rng(6).normal(size=(SAMPLES, 6))
    ends = [Contact(link=link, name=link) for link in ("upper_arm", "hand")]
    source = _source(_question(*ends, ft=True), "arm_ft", wrench, Uncertainty(), seed=7)
    silent = np.isnan(source.torque).all(axis=0)
    assert dict(zip(JOINTS, silent.tolist(), strict=True))["elbow"]
    assert not silent[:2].any()


def test_an_error_of_a_wrench_that_is_not_given_is_refused() -> None:
    """By its name."""
    with pytest.raises(EstimationError, match=r"uncertainty.lasting: the question has none of 'palm'"):
        _source(
            _question(Contact(link="forearm", name="push", type=ContactType.KNOWN), ft=False),
            "push",
            np.zeros((SAMPLES, 6)),
            Uncertainty(lasting={"palm": np.zeros((6, 1))}),
            seed=1,
        )
