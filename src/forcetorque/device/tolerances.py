# SPDX-License-Identifier: BSD-3-Clause
"""How far the quantities of a device may be off, and what its sensors then measure at rest, for many postures."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.device.description import AttachedLoad, Device
from forcetorque.device.expected_wrench import BRACKET_LENGTH, HINGE, LOAD_LENGTH, MASS, Reference
from forcetorque.robot.motion import JointMotion
from forcetorque.workbench.excitation import UncertainLoads

NOISE_REACH = 3.0
"""Standard deviations of noise that count as its largest error, as normal noise has no largest one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """Errors of one quantity, in its unit; full widths are twice what stands behind a plus-minus."""

    step: float = 0.0
    """Full width of an even error that is another at every reading: of a quantity in steps, one step."""
    noise: float = 0.0
    """Standard deviation of normal noise."""
    zero: float = 0.0
    """Full width of an even error that stays as it is over the motion."""
    fixed: float = 0.0
    """An error that is known to be there and is not corrected, with its sign."""

    def __post_init__(self) -> None:
        for field in ("step", "noise", "zero"):
            if not 0.0 <= getattr(self, field) < math.inf:
                raise SensorError(f"tolerance: {field}: expected a width of at least 0, got {getattr(self, field)}")
        if not math.isfinite(self.fixed):
            raise SensorError(f"tolerance: fixed: expected a finite number, got {self.fixed}")

    @property
    def variance(self) -> float:
        """Variance of what is random: a full width squared over 12 where it is even."""
        return (self.step**2 + self.zero**2) / 12.0 + self.noise**2

    @property
    def largest(self) -> float:
        """Largest magnitude of what is random: half of each width, and `NOISE_REACH` times the noise."""
        return 0.5 * (self.step + self.zero) + NOISE_REACH * self.noise

    @property
    def is_zero(self) -> bool:
        """Whether nothing is off."""
        return self == Tolerance()

    def drawn(self, rng: np.random.Generator, samples: int) -> FloatArray:
        """Draw the errors of one motion.

        Args:
            rng: Source of random numbers.
            samples: Number of readings, n.

        Returns:
            Errors; shape (n,).
        """
        anew = self.step * rng.uniform(-0.5, 0.5, samples) + rng.normal(0.0, self.noise, samples)
        return np.asarray(self.fixed + self.zero * rng.uniform(-0.5, 0.5) + anew, dtype=np.float64)


_STEP: Final = 1e-4
"""Step of the differences, in rad, m and shares: their own error is 1e-8 of a load."""
_SAME_RAD: Final = 1e-9
"""Samples that are no further apart are of one pose."""
_AT_LOCK_DEG: Final = 1e-4
"""A hinge that is no further from a lock is in it; deg."""
_FREE: Final = 999.0
"""Stands for a lock where the hinge hangs freely; deg."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerances:
    """How exact a device is."""

    encoder_deg: float = 0.1
    """Full width of a uniform error of pitch and yaw, as in Table 6.3: one at every pose, one that stays; of the angle
    of every lock, or of the encoder of the hinge, too; deg."""
    length_m: float = 1e-4
    """Standard deviation of the distances from sensor to hinge, and from hinge to the centre of every load; m."""
    mass_share: float = 5e-4
    """Standard deviation of the mass of every load, as a share."""

    def size_of(self, error: str) -> float:
        """Give the size of an error.

        Args:
            error: One of the names that `Poses.errors` gives.

        Returns:
            Its standard deviation; rad, m, or a share of the mass.
        """
        if error == "height" or error.startswith("distance of "):
            return self.length_m
        if error.startswith("mass of "):
            return self.mass_share
        return float(np.deg2rad(self.encoder_deg) / np.sqrt(12.0))

    def draw(self, error: str, rng: np.random.Generator) -> float:
        """Draw an error: uniform for angles, normal for lengths and masses.

        Args:
            error: One of the names that `Poses.errors` gives.
            rng: Source of it.

        Returns:
            True less stated value; rad, m, or a share of the mass.
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
        """Take samples that follow each other; those of one hold are one pose.

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
        return poses if device.hinge.encoder else poses.taken(poses._lock != _FREE)

    def taken(self, which: BoolArray) -> Poses:
        """Give some of the poses.

        Args:
            which: Whether to take each; shape (n,).

        Returns:
            These alone.
        """
        return replace(self, position=self.position[which], count=self.count[which])

    @property
    def errors(self) -> tuple[str, ...]:
        """Names of what may be wrong: joints, locks in use, lengths and mass; those of the load bear its name."""
        locks = sorted(set(self._lock.tolist()) - {_FREE})
        hinge = (HINGE,) if (self._lock == _FREE).any() else ()
        own = (f"distance of {self.load.name}", f"mass of {self.load.name}")
        return ("pitch", "yaw", *hinge, *(f"lock {lock:g}" for lock in locks), "height", *own)

    def wrench(
        self, sensor: str, errors: Mapping[str, float] | None = None, fresh_rad: FloatArray | None = None
    ) -> FloatArray:
        """Compute what a sensor feels.

        Args:
            sensor: Name of the sensor.
            errors: True less stated values of some of `errors`, the mass as a share; rad, m.
            fresh_rad: True less stated position of pitch, yaw and an unlocked hinge at every pose; shape (n, 3); rad.

        Returns:
            Wrenches; shape (n, 6); N, N m.
        """
        return self._reference(sensor).wrench(self._by_quantity(errors or {}, fresh_rad))

    def uncertain(self, sensor: str, tolerances: Tolerances) -> UncertainLoads:
        """Say what may be wrong with what a sensor is said to feel, to first order.

        Args:
            sensor: Name of the sensor.
            tolerances: How exact the device is.

        Returns:
            The loads.
        """
        reference = self._reference(sensor)
        stated = reference.wrench()
        systematic = {
            name: tolerances.size_of(name)
            * np.subtract(*(reference.wrench(self._by_quantity({name: step})) for step in (_STEP, -_STEP)))
            / (2.0 * _STEP)
            for name in self.errors
        }
        still = np.zeros_like(stated)
        return UncertainLoads(
            wrench=stated,
            count=self.count,
            systematic=systematic,
            independent=np.stack([systematic.get(joint, still) for joint in ("pitch", "yaw", "hinge")], axis=2),
        )

    def _reference(self, sensor: str) -> Reference:
        poses = JointMotion.at_rest(self.device.joint_names, self.position)
        return Reference(device=self.device, load=self.load, poses=poses, sensor=sensor)

    def _by_quantity(
        self, errors: Mapping[str, float], fresh_rad: FloatArray | None = None
    ) -> dict[str, FloatArray | float]:
        """Errors of the quantities of a reference."""
        pitch, yaw, hinge = np.zeros((3, len(self.position))) if fresh_rad is None else fresh_rad.T
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
        """Lock of every pose, `_FREE` where the hinge hangs; shape (n,); deg."""
        hinge = np.rad2deg(self.position[:, -1])
        locks = np.array(self.device.hinge.locks_deg)
        nearest = locks[np.abs(hinge[:, None] - locks).argmin(axis=1)]
        return np.where(np.abs(hinge - nearest) < _AT_LOCK_DEG, nearest, _FREE)


_THIRDS = np.deg2rad([-120.0, 0.0, 120.0])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RestTable:
    """Loads of one device with one load at its locks."""

    wrench: Mapping[float, FloatArray]
    """What pitch and yaw make of the load, by lock in deg; shapes (9, 6); N, N m."""
    systematic: Mapping[float, Mapping[str, FloatArray]]
    """The same of every error that stays, by lock in deg and name; shapes (9, 6); N, N m."""

    @classmethod
    def of(cls, device: Device, load: AttachedLoad, sensor: str, tolerances: Tolerances) -> RestTable:
        """Tabulate a device without a turn.

        Args:
            device: The device.
            load: Load attached to its hinge.
            sensor: Name of the sensor.
            tolerances: How exact the device is.

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
        """Give the loads of samples that follow each other, with what may be wrong of them.

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
