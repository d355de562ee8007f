# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques from motor current or PWM, less Coulomb and viscous friction and inertia."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array
from forcetorque.base.errors import EstimationError, FitError
from forcetorque.estimation.torque.torque_source import TorqueSource
from forcetorque.estimation.uncertain.input_errors import square_root

TERMS = ("coulomb", "viscous", "inertia", "offset")
"""Terms of the model, in the order of its coefficients."""

_FEWEST = 20
"""Samples per direction below which friction is not fitted."""

_BLOCK_S = 1.0
"""Length of the blocks whose means show how long errors repeat themselves; s."""

_LEAST_SHARE = 0.1
"""Share of the residual variance that is the drive's at least, however noisy the trusted source says it is."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Friction(ArrayRecord):
    """Friction of one joint: `coulomb sign(v) + viscous v + inertia a + offset`, in the direction of motion.

    No Stribeck effect, and no friction that grows with the load. At standstill friction is anything up to Coulomb's.
    """

    joint: str
    """Name of the joint."""
    coefficients: FloatArray = field(metadata=array(4))
    """Coulomb friction, N m; viscous friction, N m s/rad; inertia of the rotor seen from the joint, kg m2; offset of
    the motor's reading, N m; shape (4,). Of a prismatic joint N, N s/m, kg, N."""
    covariance: FloatArray = field(metadata=array(4, 4))
    """Covariance of the coefficients; shape (4, 4)."""
    variance: float
    """Of what the model leaves unexplained in a sample; (N m)^2."""
    noise_time_s: float
    """Time over which that repeats itself; s."""
    standstill: float
    """Speed below which nothing is said; rad/s, m/s."""
    shared: FloatArray = field(default_factory=lambda: np.zeros((4, 0)), metadata=array(4, None))
    """By how much one standard deviation of each of s errors that the trusted source shares with others moves the
    coefficients; part of their covariance; shape (4, s)."""

    def moves(self, velocity: FloatArray) -> BoolArray:
        """Find the samples in which the joint moves fast enough.

        Args:
            velocity: Velocities; shape (n,); rad/s.

        Returns:
            Whether it does; shape (n,).
        """
        return np.abs(velocity) >= self.standstill

    def torque(self, velocity: FloatArray, acceleration: FloatArray) -> FloatArray:
        """Give what the drive takes.

        Args:
            velocity: Velocities of the joint; shape (n,); rad/s.
            acceleration: Accelerations; shape (n,); rad/s2.

        Returns:
            Torque that the motor gives and the joint does not get; shape (n,); N m.
        """
        return friction_terms(velocity, acceleration) @ self.coefficients


def friction_terms(velocity: FloatArray, acceleration: FloatArray) -> FloatArray:
    """Give what one unit of each coefficient takes.

    Args:
        velocity: Velocities of the joint; shape (n,); rad/s.
        acceleration: Accelerations; shape (n,); rad/s2.

    Returns:
        Columns as `TERMS`; shape (n, 4).
    """
    return np.column_stack([np.sign(velocity), velocity, acceleration, np.ones_like(velocity)])


def fit_friction(
    joint: str,
    drive_torque: FloatArray,
    trusted_torque: FloatArray,
    velocity: FloatArray,
    acceleration: FloatArray,
    *,
    period_s: float,
    standstill: float,
    trusted_variance: FloatArray | None = None,
    trusted_lasting: FloatArray | None = None,
    trusted_shared: FloatArray | None = None,
) -> Friction:
    """Fit friction where another source of the joint's torque is trusted.

    Least squares; the covariance of the coefficients counts samples as often as their errors are new, which the means
    of blocks of a second show, and holds what the lasting errors of the trusted source move them by.

    Args:
        joint: Name of the joint.
        drive_torque: Torque of the motor times gear ratio; shape (n,); N m; NaN where it is not known.
        trusted_torque: Torque of the joint; shape (n,); N m; NaN likewise.
        velocity: Velocities of the joint; shape (n,); rad/s.
        acceleration: Accelerations; shape (n,); rad/s2.
        period_s: Time between samples; s.
        standstill: Speed below which samples are left out; rad/s, m/s.
        trusted_variance: Variance of the noise of the trusted torque; shape (n,); (N m)^2; none if None.
        trusted_lasting: What its lasting errors add per standard deviation; shape (n, p); N m; nothing if None.
        trusted_shared: What the errors add that it shares with other sources; shape (n, s); N m; nothing if None.

    Returns:
        The friction.

    Raises:
        FitError: If the joint does not move both ways for long enough, or motions do not separate the terms.
    """
    if not 0.0 < standstill < np.inf:
        raise FitError(f"joint {joint!r}: standstill: expected a positive speed in rad/s or m/s, got {standstill}")
    left = drive_torque - trusted_torque
    used = np.isfinite(left) & np.isfinite(velocity + acceleration) & (np.abs(velocity) >= standstill)
    _require_both_ways(joint, velocity[used], standstill)
    terms = friction_terms(velocity, acceleration)[used]
    scale = np.sqrt((terms**2).mean(axis=0))
    if np.linalg.matrix_rank(terms / np.where(scale > 0.0, scale, 1.0), tol=_RANK * np.sqrt(len(terms))) < len(TERMS):
        raise FitError(
            f"joint {joint!r}: expected motions that tell {', '.join(TERMS)} of a drive apart, got one speed or one "
            "acceleration; record faster and slower ones both ways"
        )
    inverse = np.linalg.pinv(terms)
    coefficients = inverse @ left[used]
    own, shared = (
        np.zeros((len(terms), 0)) if columns is None else columns[used] for columns in (trusted_lasting, trusted_shared)
    )
    lasting = np.hstack([own, shared])
    moved = inverse @ lasting
    scatter = _Scatter.of(
        used, left[used] - terms @ coefficients, lasting - terms @ moved, length=max(1, round(_BLOCK_S / period_s))
    )
    trusted = 0.0 if trusted_variance is None else float(np.mean(trusted_variance[used]))
    return Friction(
        joint=joint,
        coefficients=coefficients,
        covariance=scatter.variance * scatter.repeated * (inverse @ inverse.T) + moved @ moved.T,
        variance=max(scatter.variance - trusted, _LEAST_SHARE * scatter.variance),
        noise_time_s=0.5 * (scatter.repeated - 1.0) * period_s,
        standstill=standstill,
        # the coefficients take up what the trusted torque lacks
        shared=-moved[:, own.shape[1] :],
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Scatter:
    """What a fit leaves, without the part that lasting errors of the trusted source make of it."""

    variance: float
    """Of one sample; (N m)^2."""
    repeated: float
    """How many samples are as good as one."""

    @classmethod
    def of(cls, used: BoolArray, residual: FloatArray, lasting: FloatArray, *, length: int) -> _Scatter:
        """Compare means of blocks with samples: means of independent ones have the variance over their number."""
        both = np.zeros((len(used), 1 + lasting.shape[1]))
        both[used] = np.column_stack([residual, lasting])
        starts = np.arange(0, len(used), length)
        counts = np.add.reduceat(used, starts)
        sums = np.add.reduceat(both, starts)[counts > 0] / np.sqrt(counts[counts > 0])[:, None]
        degrees = max(1, len(residual) - len(TERMS))
        sample = (residual @ residual - (lasting**2).sum()) / degrees
        sample = max(sample, _LEAST_SHARE * (residual @ residual) / degrees)
        block = ((sums[:, 0] ** 2) - (sums[:, 1:] ** 2).sum(axis=1)).mean()
        return cls(variance=float(sample), repeated=float(np.clip(block / sample, 1.0, length)))


_RANK = 1e-3
"""Singular value per sample, of terms with a root mean square of one, below which two of them are the same."""


def _require_both_ways(joint: str, velocity: FloatArray, standstill: float) -> None:
    forth, back = int(np.count_nonzero(velocity > 0.0)), int(np.count_nonzero(velocity < 0.0))
    if min(forth, back) < _FEWEST:
        raise FitError(
            f"joint {joint!r}: expected at least {_FEWEST} samples that move faster than {standstill:g} rad/s either "
            f"way, got {forth} forth and {back} back; friction needs motions both ways"
        )


def drive_torque(joint: str, reading: FloatArray, *, torque_constant: float, gear_ratio: float) -> FloatArray:
    """Give the torque of a motor as its joint would have it without friction.

    Args:
        joint: Name of the joint.
        reading: Currents, or PWM duties; shape (n,); A, 1.
        torque_constant: Torque of the motor per ampere, or per whole PWM duty; N m/A, N m.
        gear_ratio: Turns of the motor per turn of the joint; negative where it turns the other way.

    Returns:
        Torques along +q; shape (n,); N m.

    Raises:
        EstimationError: If a factor is 0 or not finite.
    """
    for name, value in (("torque_constant", torque_constant), ("gear_ratio", gear_ratio)):
        if not np.isfinite(value) or value == 0.0:
            raise EstimationError(
                f"motor of joint {joint!r}: {name}: expected a number other than 0, got {value}; "
                "the torque cannot be computed from a motor without it"
            )
    return torque_constant * gear_ratio * np.asarray(reading)


def motor_source(
    name: str,
    frictions: Sequence[Friction],
    stamp_ns: IntArray,
    drive_torque: FloatArray,
    velocity: FloatArray,
    acceleration: FloatArray,
) -> TorqueSource:
    """Make a source of motors: what they give less what their drives take.

    Coefficients of friction last, and what friction leaves unexplained is noise. Errors that the source shares to which
    friction was fitted come back through the coefficients. A joint that stands says nothing: its friction is anything
    up to Coulomb's.

    Args:
        name: Name of the source, such as `current`.
        frictions: Friction of every joint.
        stamp_ns: Instants; shape (n,); ns.
        drive_torque: Torque of the motors times gear ratios; shape (n, j); N m.
        velocity: Velocities of the joints; shape (n, j); rad/s.
        acceleration: Accelerations; shape (n, j); rad/s2.

    Returns:
        The source.
    """
    n, j = drive_torque.shape
    torque, lasting = np.full((n, j), np.nan), np.zeros((n, j, j * 4))
    shared = np.zeros((n, j, frictions[0].shared.shape[1] if frictions else 0))
    for k, friction in enumerate(frictions):
        moving = friction.moves(velocity[:, k])
        lost = friction.torque(velocity[:, k], acceleration[:, k])
        torque[moving, k] = (drive_torque[:, k] - lost)[moving]
        terms = friction_terms(velocity[:, k], acceleration[:, k])
        own = friction.covariance - friction.shared @ friction.shared.T
        lasting[:, k, 4 * k : 4 * k + 4] = terms @ square_root(own)
        shared[:, k] = -terms @ friction.shared
    noise = np.diag([friction.variance for friction in frictions])
    return TorqueSource(
        name=name,
        joints=tuple(friction.joint for friction in frictions),
        stamp_ns=stamp_ns,
        torque=torque,
        noise=np.broadcast_to(noise, (n, j, j)),
        lasting=np.where(np.isfinite(lasting), lasting, 0.0),
        noise_time_s=max(friction.noise_time_s for friction in frictions),
        shared=np.where(np.isfinite(shared), shared, 0.0),
    )
