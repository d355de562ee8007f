# SPDX-License-Identifier: BSD-3-Clause
"""Motions of joints whose velocities and accelerations are known exactly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import ShapeError
from forcetorque.robot.motion import JointMotion
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.stand import Stand

_HARMONICS = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SumOfSines:
    """A trajectory of joints that are sums of sines, each of its own."""

    names: tuple[str, ...]
    """Joints."""
    centre: FloatArray
    """Middle of every joint's range; shape (j,); rad or m."""
    amplitude: FloatArray
    """Amplitudes; shape (j, h); rad or m."""
    omega: FloatArray
    """Angular frequencies; shape (j, h); rad/s."""
    phase: FloatArray
    """Phases at 0 s; shape (j, h); rad."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(self.names))
        joints = len(self.names)
        object.__setattr__(self, "centre", read_only(self.centre, name="centre", shape=(joints,)))
        for name in ("amplitude", "omega", "phase"):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=(joints, _HARMONICS)))

    @classmethod
    def draw(
        cls, ranges: Mapping[str, tuple[float, float]], *, slowest_hz: float, rng: np.random.Generator
    ) -> SumOfSines:
        """Draw frequencies and phases; the amplitudes add up to half of the range.

        Args:
            ranges: Lowest and highest position of every joint; rad or m.
            slowest_hz: About the frequency of the slowest sine; Hz.
            rng: Source of amplitudes, frequencies and phases.

        Returns:
            The trajectory.
        """
        centre, amplitude, omega, phase = [], [], [], []
        for low, high in ranges.values():
            weights = rng.uniform(0.5, 1.0, _HARMONICS)
            amplitude.append(weights * (0.5 * (high - low) / weights.sum()))
            omega.append(2.0 * np.pi * slowest_hz * (np.arange(_HARMONICS) + rng.uniform(0.7, 1.3, _HARMONICS)))
            phase.append(rng.uniform(0.0, 2.0 * np.pi, _HARMONICS))
            centre.append(0.5 * (low + high))
        shape = (len(ranges), _HARMONICS)  # also of no joints
        return cls(
            names=tuple(ranges),
            centre=np.array(centre),
            amplitude=np.reshape(amplitude, shape),
            omega=np.reshape(omega, shape),
            phase=np.reshape(phase, shape),
        )

    def no_faster_than(self, speeds: FloatArray) -> SumOfSines:
        """Slow down the joints that could exceed a speed.

        Args:
            speeds: Largest speed of every joint; shape (j,); rad/s or m/s.

        Returns:
            The trajectory, with lower frequencies where needed.
        """
        fastest = np.abs(self.amplitude * self.omega).sum(axis=1)
        slower = np.minimum(1.0, speeds / np.where(fastest > 0.0, fastest, speeds))
        return replace(self, omega=self.omega * slower[:, None])

    def __call__(self, seconds: FloatArray) -> JointMotion:
        """Give the motion of the joints.

        Args:
            seconds: Instants; shape (n,); s.

        Returns:
            The motion with its exact derivatives; n samples.
        """
        position, velocity, acceleration = (np.empty((len(seconds), len(self.names))) for _ in range(3))
        for k, (amplitude, omega) in enumerate(zip(self.amplitude, self.omega, strict=True)):
            angle = seconds[:, None] * omega + self.phase[k]
            sine = np.sin(angle)
            position[:, k] = self.centre[k] + sine @ amplitude
            velocity[:, k] = np.cos(angle) @ (amplitude * omega)
            acceleration[:, k] = -sine @ (amplitude * omega**2)
        return JointMotion(names=self.names, position=position, velocity=velocity, acceleration=acceleration)


def random_smooth_motion(
    ranges: Mapping[str, tuple[float, float]], seconds: FloatArray, *, slowest_hz: float, rng: np.random.Generator
) -> JointMotion:
    """Move joints by sums of sines with random phases, inside given ranges.

    Args:
        ranges: Lowest and highest position of every joint; rad or m.
        seconds: Instants; shape (n,); s.
        slowest_hz: About the frequency of the slowest sine; Hz.
        rng: Source of phases and frequencies.

    Returns:
        The motion with its exact derivatives; n samples.
    """
    return SumOfSines.draw(ranges, slowest_hz=slowest_hz, rng=rng)(seconds)


def random_movement(
    stand: Stand,
    *,
    rng: np.random.Generator,
    duration_s: float,
    slowest_hz: float = 0.1,
    joints: Sequence[str] | None = None,
    name: str = "random",
) -> Movement:
    """Move joints smoothly and at random over their ranges, no faster than the stand allows.

    Args:
        stand: The robot on its support.
        rng: Source of amplitudes, frequencies and phases.
        duration_s: How long it takes; s.
        slowest_hz: About the frequency of the slowest sine of joints that are not slowed down; Hz.
        joints: Joints that move, the others rest; all free ones if None.
        name: Name of the movement.

    Returns:
        The movement; it neither starts nor ends at rest.

    Raises:
        ShapeError: If the frequency is not positive.
    """
    if not 0.0 < slowest_hz < np.inf:
        raise ShapeError(f"slowest_hz: expected a positive frequency in Hz, got {slowest_hz:g}")
    moving = stand.joints if joints is None else tuple(joints)
    stand.columns(moving)
    ranges = {
        joint: stand.range_of(joint) if joint in moving else (rest, rest)
        for joint, rest in zip(stand.joints, map(float, stand.rest), strict=True)
    }
    trajectory = SumOfSines.draw(ranges, slowest_hz=slowest_hz, rng=rng).no_faster_than(stand.speeds)
    return stand.movement(name, MovementKind.RANDOM, trajectory, duration_s)
