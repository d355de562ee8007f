# SPDX-License-Identifier: BSD-3-Clause
"""A source of joint torques with its covariance, also from wrenches of force-torque sensors or skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, names
from forcetorque.base.errors import EstimationError
from forcetorque.estimation.uncertain.estimate import estimate_with_covariance
from forcetorque.estimation.uncertain.uncertainty import Uncertainty, square_root
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.question import Question
from forcetorque.robot.motion import JointMotion, RootMotion


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueSource(ArrayRecord):
    """Torques of one source over one interval: `torque = truth + lasting @ z + shared @ w + noise`.

    z and w are normal with variance 1. Noise averages out, what lasts does not: an offset, a motor constant, a friction
    that was fitted. A source that lumps both together makes conflicts look surer, or less sure, than they are. The
    errors w are those of the robot model. They enter all sources that use the model with one sign, so that no number of
    such sources averages them out.
    """

    name: str
    """What it is called, such as `ft`."""
    joints: tuple[str, ...] = field(metadata=names("j"))
    """Names of j joints."""
    stamp_ns: IntArray = field(metadata=array("n", dtype="int"))
    """Instants; increasing; shape (n,); ns."""
    torque: FloatArray = field(metadata=array("n", "j"))
    """Torques along +q, NaN where it says nothing; shape (n, j); N m, N where prismatic."""
    noise: FloatArray = field(metadata=array("n", "j", "j"))
    """Covariance of what differs from sample to sample; shape (n, j, j); (N m)^2."""
    lasting: FloatArray = field(metadata=array("n", "j", None))
    """What one standard deviation of each of p independent errors that last the interval adds; shape (n, j, p); N m."""
    noise_time_s: float = 0.0
    """Time over which the noise repeats itself, the integral of its autocorrelation for times above 0; s."""
    shared: FloatArray = field(default_factory=lambda: np.zeros((0, 0, 0)), metadata=array("n", "j", None))
    """What one standard deviation of each of s errors adds that last and that sources have in common; shape (n, j, s),
    with the same s errors in all sources that have any; none if left out; N m."""

    def __post_init__(self) -> None:
        if not np.size(self.shared):
            object.__setattr__(self, "shared", np.zeros((*np.shape(self.torque), 0)))
        check_arrays(self)
        if not len(self) or (np.diff(self.stamp_ns) <= 0).any():
            raise EstimationError(f"source {self.name!r}: expected instants that increase, got {len(self)} that do not")
        if not 0.0 <= self.noise_time_s < np.inf:
            raise EstimationError(
                f"source {self.name!r}: noise_time_s: expected at least 0 s, got {self.noise_time_s}; "
                "what repeats itself all along is lasting"
            )
        self._require_variance()

    def _require_variance(self) -> None:
        """Wherever it says something, its noise has a variance, and what lasts is a number."""
        known = np.isfinite(self.torque)
        pairs = known[:, :, None] & known[:, None, :]
        # outside what is known a unit matrix: a source need not say how far off nothing is
        noise = np.where(pairs, self.noise, np.eye(len(self.joints)))
        scale = np.abs(np.einsum("njj->nj", noise)).max(axis=1)
        odd = ~np.isfinite(noise).all(axis=(1, 2))
        odd |= np.abs(noise - noise.transpose(0, 2, 1)).max(axis=(1, 2)) > _ROUNDING * scale
        for columns in (self.lasting, self.shared):
            odd |= ~np.where(known[:, :, None], np.isfinite(columns), True).all(axis=(1, 2))
        smallest = np.full(len(noise), np.nan)
        smallest[~odd] = np.linalg.eigvalsh(noise[~odd])[:, 0]
        odd |= ~(smallest > 0.0)
        if odd.any():
            row = int(np.flatnonzero(odd)[0])
            raise EstimationError(
                f"source {self.name!r}, sample {row}: noise: expected a symmetric covariance with positive variances, "
                f"and lasting errors that are numbers, got the variances {np.diag(self.noise[row])} and the smallest "
                f"eigenvalue {smallest[row]:.3g}; give NaN as torque where the source says nothing"
            )

    @classmethod
    def of_covariance(
        cls,
        name: str,
        joints: Sequence[str],
        stamp_ns: IntArray,
        torque: FloatArray,
        covariance: FloatArray,
        *,
        noise_share: float,
    ) -> Self:
        """Take a covariance that does not say which of the errors last.

        Args:
            name: What the source is called.
            joints: Names of j joints.
            stamp_ns: Instants; increasing; shape (n,); ns.
            torque: Torques along +q, NaN where it says nothing; shape (n, j); N m.
            covariance: Covariance of the torques of each sample; shape (n, j, j); (N m)^2.
            noise_share: Share of it that differs from sample to sample; the rest lasts; above 0, at most 1.

        Returns:
            The source.

        Raises:
            EstimationError: If the share is none, or the covariance is none where a torque is known.
        """
        if not 0.0 < noise_share <= 1.0:
            raise EstimationError(f"source {name!r}: noise_share: expected above 0 and at most 1, got {noise_share}")
        lasting = square_root((1.0 - noise_share) * np.nan_to_num(covariance))
        noise = noise_share * covariance
        return cls(name=name, joints=tuple(joints), stamp_ns=stamp_ns, torque=torque, noise=noise, lasting=lasting)

    def __len__(self) -> int:
        return len(self.stamp_ns)

    @property
    def independent(self) -> TorqueSource:
        """The same source, with the errors that it shares counted as noise of its own."""
        return replace(
            self, noise=self.noise + self.shared @ self.shared.transpose(0, 2, 1), shared=np.zeros((0, 0, 0))
        )

    @property
    def own_covariance(self) -> FloatArray:
        """Covariance of one sample, without the errors shared with other sources; shape (n, j, j); (N m)^2."""
        return self.noise + self.lasting @ self.lasting.transpose(0, 2, 1)

    @property
    def covariance(self) -> FloatArray:
        """Covariance of one sample, of all that may be off together; shape (n, j, j); (N m)^2."""
        return self.own_covariance + self.shared @ self.shared.transpose(0, 2, 1)


_ROUNDING = 1e-9
"""Share of the largest variance by which rounding may make a covariance unsymmetric."""


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

    Torques that are not determined, as of a joint between two unknown contacts, are left to other sources.

    Args:
        name: Name of the source.
        question: What is estimated; its torques are those of the source, summed up inside sub-models.
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
    uncertain = estimate_with_covariance(
        question, joints, root, measured=measured, known=known, uncertainty=uncertainty, must_be_determined=False
    )
    lasting = np.nan_to_num(uncertain.torque_lasting)
    noise = np.nan_to_num(uncertain.torque_covariance) - lasting @ lasting.transpose(0, 2, 1)
    return TorqueSource(
        name=name,
        joints=question.torques,
        stamp_ns=stamp_ns,
        torque=uncertain.torques,
        noise=noise + OWN_MODEL_SHARE * np.diag(model_deviation**2),
        lasting=lasting,
        noise_time_s=noise_time_s,
        shared=np.broadcast_to(np.diag(model_deviation), (len(stamp_ns), len(model_deviation), len(model_deviation))),
    )
