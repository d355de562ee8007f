# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor feels at rest, and what errors make of it, for many postures at once.

At a lock every component is a sum of products of 1, cos and sin of pitch with 1, cos and sin of yaw, as gravity in the
frame of the sensor and its derivatives are. So nine postures tell all others exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.device.description import Device, HungLoad
from forcetorque.device.tolerances import Poses, Tolerances
from forcetorque.workbench.uncertain_loads import UncertainLoads

_THIRDS = np.deg2rad([-120.0, 0.0, 120.0])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RestTable:
    """Loads of one device with one load at its locks."""

    wrench: Mapping[float, FloatArray]
    """What pitch and yaw make of the load, by lock in deg; shapes (9, 6); N, N m."""
    lasting: Mapping[float, Mapping[str, FloatArray]]
    """The same of every error that stays, by lock in deg and name; shapes (9, 6); N, N m."""

    @classmethod
    def of(cls, device: Device, load: HungLoad, sensor: str, tolerances: Tolerances) -> RestTable:
        """Tabulate a device without a turn.

        Args:
            device: The device.
            load: What hangs on its hinge.
            sensor: Name of the sensor.
            tolerances: How exact the device is.

        Returns:
            The table.
        """
        pitch, yaw = (angles.ravel() for angles in np.meshgrid(_THIRDS, _THIRDS))
        inverse = np.asarray(np.linalg.inv(_basis(pitch, yaw)), dtype=np.float64)
        wrench: dict[float, FloatArray] = {}
        lasting: dict[float, dict[str, FloatArray]] = {}
        for lock in device.hinge.locks_deg:
            position = np.column_stack([pitch, yaw, np.full(len(pitch), np.deg2rad(lock))])
            poses = Poses(device=device, load=load, position=position, count=np.ones(len(pitch)))
            loads = poses.uncertain(sensor, tolerances)
            wrench[lock] = inverse @ loads.wrench
            lasting[lock] = {name: inverse @ change for name, change in loads.lasting.items()}
        return cls(wrench=wrench, lasting=lasting)

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
        names = dict.fromkeys(name for errors in self.lasting.values() for name in errors)
        wrench = np.zeros((len(poses), 6))
        lasting = {name: np.zeros_like(wrench) for name in names}
        for lock, table in self.wrench.items():
            at = np.abs(hinge - lock) < 1.0
            wrench[at] = basis[at] @ table
            for name, change in self.lasting[lock].items():
                lasting[name][at] = basis[at] @ change
        return UncertainLoads(
            wrench=wrench,
            count=np.diff(np.append(starts, len(position))),
            lasting=lasting,
            fresh=np.stack([lasting["pitch"], lasting["yaw"]], axis=2),
        )


def _basis(pitch: FloatArray, yaw: FloatArray) -> FloatArray:
    """Products of the waves of both; shape (n, 9)."""
    waves = [np.column_stack([np.ones(len(angle)), np.cos(angle), np.sin(angle)]) for angle in (pitch, yaw)]
    return np.einsum("ni,nj->nij", *waves).reshape(len(pitch), 9)
