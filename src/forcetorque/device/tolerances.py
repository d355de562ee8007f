# SPDX-License-Identifier: BSD-3-Clause
"""Tolerances of the quantities of a device, and their effect on the expected wrenches of its poses at rest."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.device.components import AttachedLoad, Device
from forcetorque.device.expected_wrench import BRACKET_LENGTH, HINGE, LOAD_LENGTH, MASS, ExpectedWrench
from forcetorque.robot.motion import JointMotion
from forcetorque.workbench.excitation import UncertainLoads

NOISE_REACH = 3.0
"""Standard deviations of noise that count as its largest error: normal noise has no bound."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """Errors of one quantity, in its unit; a full width is twice the number after a plus-minus."""

    step: float = 0.0
    """Full width of a uniform error that is independent at every sample: one step of a quantised value."""
    noise: float = 0.0
    """Standard deviation of normal noise."""
    zero: float = 0.0
    """Full width of a uniform error that is constant over the motion."""
    fixed: float = 0.0
    """A known error that is not corrected, with its sign."""

    def __post_init__(self) -> None:
        for name in ("step", "noise", "zero"):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise SensorError(f"tolerance: {name}: expected a width of at least 0, got {getattr(self, name)}")
        if not math.isfinite(self.fixed):
            raise SensorError(f"tolerance: fixed: expected a finite number, got {self.fixed}")

    @property
    def variance(self) -> float:
        """Variance of the random errors: a full width squared over 12 where they are uniform."""
        return (self.step**2 + self.zero**2) / 12.0 + self.noise**2

    @property
    def largest(self) -> float:
        """Largest magnitude of the random errors: half of each width, and `NOISE_REACH` times the noise."""
        return 0.5 * (self.step + self.zero) + NOISE_REACH * self.noise

    @property
    def is_zero(self) -> bool:
        """Whether there is no error."""
        return self == Tolerance()

    def drawn(self, rng: np.random.Generator, samples: int) -> FloatArray:
        """Draw the errors of one motion.

        Args:
            rng: Source of random numbers.
            samples: Number of samples, n.

        Returns:
            Errors; shape (n,).
        """
        independent = self.step * rng.uniform(-0.5, 0.5, samples) + rng.normal(0.0, self.noise, samples)
        return np.asarray(self.fixed + self.zero * rng.uniform(-0.5, 0.5) + independent, dtype=np.float64)


_STEP: Final = 1e-4
"""Step of the differences, in rad, m and relative mass: their truncation error is 1e-8 of a load."""
_SAME_RAD: Final = 1e-9
"""Largest distance of samples of one pose."""
_AT_LOCK_DEG: Final = 1e-4
"""Largest distance of a locked hinge from its lock; deg."""
_FREE: Final = 999.0
"""Marks poses with a free hinge, in place of a lock; deg."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerances:
    """Tolerances of a device."""

    encoder_deg: float = 0.1
    """Full width of uniform errors of pitch and yaw, as in Table 6.3: one independent at every pose, one constant. Also
    of the angle of every lock, or of the encoder of the hinge; deg."""
    length_m: float = 1e-4
    """Standard deviation of the distances from sensor to hinge, and from hinge to the centre of every load; m."""
    mass_share: float = 5e-4
    """Relative standard deviation of the mass of every load."""

    def size_of(self, error: str) -> float:
        """Compute the standard deviation of an error.

        Args:
            error: One of the names in `Poses.errors`.

        Returns:
            The standard deviation; rad, m, or relative to the mass.
        """
        if error == "height" or error.startswith("distance of "):
            return self.length_m
        if error.startswith("mass of "):
            return self.mass_share
        return float(np.deg2rad(self.encoder_deg) / np.sqrt(12.0))

    def draw(self, error: str, rng: np.random.Generator) -> float:
        """Draw an error: uniform for angles, normal for lengths and masses.

        Args:
            error: One of the names in `Poses.errors`.
            rng: Source of random numbers.

        Returns:
            True less specified value; rad, m, or relative to the mass.
        """
        if error == "height" or error.startswith(("distance of ", "mass of ")):
            return float(self.size_of(error) * rng.standard_normal())
        return float(np.deg2rad(self.encoder_deg) * rng.uniform(-0.5, 0.5))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Poses:
    """Poses at rest with one load on the hinge."""

    device: Device
    """The device."""
    load: AttachedLoad
    """The load."""
    position: FloatArray
    """Joints of the device; shape (n, j); rad."""
    count: FloatArray
    """Samples at every pose; shape (n,)."""

    @classmethod
    def of_samples(cls, device: Device, load: AttachedLoad, position: FloatArray) -> Poses:
        """Group consecutive samples into poses; samples of one hold are one pose.

        Without an encoder at the hinge, samples with an unlocked hinge are left out: the load's position is unknown.

        Args:
            device: The device.
            load: The load.
            position: Joints at every sample; shape (n, j); rad.

        Returns:
            The poses.
        """
        moved = np.append(True, np.abs(np.diff(position, axis=0)).max(axis=1) > _SAME_RAD)
        starts = np.flatnonzero(moved)
        poses = cls(
            device=device,
            load=load,
            position=position[starts],
            count=np.diff(np.append(starts, len(position))).astype(np.float64),
        )
        return poses if device.hinge.encoder else poses.select(poses._lock != _FREE)

    def select(self, mask: BoolArray) -> Poses:
        """Select poses.

        Args:
            mask: Whether to keep each pose; shape (n,).

        Returns:
            The selected poses.
        """
        return replace(self, position=self.position[mask], count=self.count[mask])

    @property
    def errors(self) -> tuple[str, ...]:
        """Names of possible errors: joints, locks in use, lengths and mass; those of the load have its name."""
        locks = sorted(set(self._lock.tolist()) - {_FREE})
        hinge = (HINGE,) if (self._lock == _FREE).any() else ()
        of_load = (f"distance of {self.load.name}", f"mass of {self.load.name}")
        return ("pitch", "yaw", *hinge, *(f"lock {lock:g}" for lock in locks), "height", *of_load)

    def wrench(
        self, sensor: str, errors: Mapping[str, float] | None = None, independent_rad: FloatArray | None = None
    ) -> FloatArray:
        """Compute the wrench on a sensor.

        Args:
            sensor: Name of the sensor.
            errors: True less specified values of some of `errors`, relative for the mass; rad, m.
            independent_rad: True less specified position of pitch, yaw and an unlocked hinge at every pose; shape
                (n, 3); rad.

        Returns:
            Wrenches; shape (n, 6); N, N m.
        """
        return self._expected(sensor).wrench(self._by_quantity(errors or {}, independent_rad))

    def uncertain(self, sensor: str, tolerances: Tolerances) -> UncertainLoads:
        """Propagate the tolerances to the expected wrench of a sensor, to first order.

        Args:
            sensor: Name of the sensor.
            tolerances: Tolerances of the device.

        Returns:
            The loads.
        """
        expected = self._expected(sensor)
        wrench = expected.wrench()
        systematic = {
            name: tolerances.size_of(name)
            * np.subtract(*(expected.wrench(self._by_quantity({name: step})) for step in (_STEP, -_STEP)))
            / (2.0 * _STEP)
            for name in self.errors
        }
        zero = np.zeros_like(wrench)
        return UncertainLoads(
            wrench=wrench,
            count=self.count,
            systematic=systematic,
            independent=np.stack([systematic.get(joint, zero) for joint in ("pitch", "yaw", "hinge")], axis=2),
        )

    def _expected(self, sensor: str) -> ExpectedWrench:
        poses = JointMotion.at_rest(self.device.joint_names, self.position)
        return ExpectedWrench(device=self.device, load=self.load, poses=poses, sensor=sensor)

    def _by_quantity(
        self, errors: Mapping[str, float], independent_rad: FloatArray | None = None
    ) -> dict[str, FloatArray | float]:
        """Errors by quantity of the expected wrench."""
        pitch, yaw, hinge = np.zeros((3, len(self.position))) if independent_rad is None else independent_rad.T
        hinge = np.where(self._lock == _FREE, hinge + errors.get(HINGE, 0.0), 0.0)
        for lock in set(self._lock.tolist()) - {_FREE}:
            hinge[self._lock == lock] = errors.get(f"lock {lock:g}", 0.0)
        return {
            "pitch": pitch + errors.get("pitch", 0.0),
            "yaw": yaw + errors.get("yaw", 0.0),
            HINGE: hinge,
            BRACKET_LENGTH: errors.get("height", 0.0),
            LOAD_LENGTH: errors.get(f"distance of {self.load.name}", 0.0),
            MASS: errors.get(f"mass of {self.load.name}", 0.0),
        }

    @property
    def _lock(self) -> FloatArray:
        """Lock of every pose, `_FREE` of a free hinge; shape (n,); deg."""
        hinge = np.rad2deg(self.position[:, -1])
        locks = np.array(self.device.hinge.locks_deg)
        nearest = locks[np.abs(hinge[:, None] - locks).argmin(axis=1)]
        return np.where(np.abs(hinge - nearest) < _AT_LOCK_DEG, nearest, _FREE)


_THIRDS = np.deg2rad([-120.0, 0.0, 120.0])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RestTable:
    """Trigonometric interpolation of the expected wrenches of a device with one load at its locks."""

    wrench: Mapping[float, FloatArray]
    """Coefficients of the wrench in the waves of pitch and yaw, by lock in deg; shapes (9, 6); N, N m."""
    systematic: Mapping[float, Mapping[str, FloatArray]]
    """The same of every systematic error, by lock in deg and name; shapes (9, 6); N, N m."""

    @classmethod
    def of(cls, device: Device, load: AttachedLoad, sensor: str, tolerances: Tolerances) -> RestTable:
        """Tabulate a device without the joint `turn`.

        Args:
            device: The device.
            load: Load attached to its hinge.
            sensor: Name of the sensor.
            tolerances: Tolerances of the device.

        Returns:
            The table.
        """
        pitch, yaw = (angles.ravel() for angles in np.meshgrid(_THIRDS, _THIRDS))
        inverse = np.asarray(np.linalg.inv(_basis(pitch, yaw)), dtype=np.float64)
        wrench: dict[float, FloatArray] = {}
        systematic: dict[float, dict[str, FloatArray]] = {}
        for lock in device.hinge.locks_deg:
            position = np.column_stack([pitch, yaw, np.full(len(pitch), np.deg2rad(lock))])
            poses = Poses(device=device, load=load, position=position, count=np.ones(len(pitch)))
            loads = poses.uncertain(sensor, tolerances)
            wrench[lock] = inverse @ loads.wrench
            systematic[lock] = {name: inverse @ change for name, change in loads.systematic.items()}
        return cls(wrench=wrench, systematic=systematic)

    def loads(self, position: FloatArray) -> UncertainLoads:
        """Compute the expected wrenches of consecutive samples, with their errors.

        Args:
            position: Pitch, yaw and hinge, at a lock; shape (n, 3); rad.

        Returns:
            The loads; samples of one hold are one pose.
        """
        starts = np.flatnonzero(np.append(True, np.abs(np.diff(position, axis=0)).max(axis=1) > 0.0))
        poses = position[starts]
        basis, hinge = _basis(poses[:, 0], poses[:, 1]), np.rad2deg(poses[:, 2])
        names = dict.fromkeys(name for errors in self.systematic.values() for name in errors)
        wrench = np.zeros((len(poses), 6))
        systematic = {name: np.zeros_like(wrench) for name in names}
        for lock, table in self.wrench.items():
            at = np.abs(hinge - lock) < 1.0
            wrench[at] = basis[at] @ table
            for name, change in self.systematic[lock].items():
                systematic[name][at] = basis[at] @ change
        return UncertainLoads(
            wrench=wrench,
            count=np.diff(np.append(starts, len(position))),
            systematic=systematic,
            independent=np.stack([systematic["pitch"], systematic["yaw"]], axis=2),
        )


def _basis(pitch: FloatArray, yaw: FloatArray) -> FloatArray:
    """Products of the waves of both; shape (n, 9)."""
    waves = [np.column_stack([np.ones(len(angle)), np.cos(angle), np.sin(angle)]) for angle in (pitch, yaw)]
    return np.einsum("ni,nj->nij", *waves).reshape(len(pitch), 9)


def joined_loads(poses: list[Poses], sensor: str, tolerances: Tolerances) -> UncertainLoads:
    """Join the expected wrenches of several motions, with their errors.

    Args:
        poses: Poses with each load.
        sensor: Name of the sensor.
        tolerances: Tolerances of the device.

    Returns:
        The loads; errors of the device are the same with every load.
    """
    return UncertainLoads.join([segment.uncertain(sensor, tolerances) for segment in poses])
