# SPDX-License-Identifier: BSD-3-Clause
"""What a robot has to know of a load and of the sensor that carries it, whatever the form of its file."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import FloatArray, array, check_arrays
from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import MeasureDirection, reading_sign


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RobotLoad:
    """A rigid load on a sensor that stands still or moves slowly.

    matrix reading = sign mass [g; c x g] + bias,    sign 1 for child_to_parent, -1 for parent_to_child
    """

    sensor: str
    """Name of the sensor."""
    frame: str
    """Name of its frame."""
    direction: MeasureDirection
    """Who acts on whom in the reading; the load is the child."""
    mass: float
    """Mass; kg."""
    centre_of_mass: FloatArray = field(metadata=array(3))
    """Position c in the sensor's frame; shape (3,); m."""
    inertia: FloatArray | None = field(default=None, metadata=array(3, 3))
    """About the centre of mass along the sensor's axes; shape (3, 3); kg m2; None where it is unknown."""
    bias: FloatArray = field(metadata=array(6))
    """Reading without load; shape (6,); N, N m."""
    matrix: FloatArray = field(default_factory=lambda: np.eye(6), metadata=array(6, None))
    """What makes a wrench of the reading; shape (6, c); the identity where the sensor sends wrenches."""
    posture: str = ""
    """Positions of joints beyond the sensor for which it holds; empty for none."""
    override: str | None = None
    """Why it is told although it is doubtful; None where it is not."""

    def __post_init__(self) -> None:
        check_arrays(self)
        for name in ("centre_of_mass", "inertia", "bias", "matrix"):
            values = getattr(self, name)
            if values is not None and not np.isfinite(values).all():
                raise FormatError(f"load of {self.sensor!r}: {name}: expected finite numbers, got {values.tolist()}")
        if not (np.isfinite(self.mass) and self.mass >= 0.0):
            raise FormatError(f"load of {self.sensor!r}: mass: expected at least 0 kg, got {self.mass:g}")

    @property
    def weight_sign(self) -> float:
        """1 where the sensor reads the weight of the load, -1 where it reads what holds that up."""
        # a load at rest has the proper acceleration -g
        return -reading_sign(self.direction, child_is_outboard=True)

    def multiplier(self, *, where: str) -> FloatArray:
        """Give the matrix as one factor per component.

        Args:
            where: Name of the form that has no place for more, for the message.

        Returns:
            The factors; shape (6,).

        Raises:
            FormatError: If a component needs more than its own channel.
        """
        matrix = self.matrix
        if matrix.shape != (6, 6) or (matrix != np.diag(np.diag(matrix))).any() or not np.diag(matrix).all():
            raise FormatError(
                f"{where}: expected a matrix that is diagonal, since its file holds one factor per component; that of "
                f"{self.sensor!r}, of shape {matrix.shape}, mixes channels; let the driver send wrenches"
            )
        return np.diag(matrix)

    def require_direction(self, direction: MeasureDirection, *, where: str) -> None:
        """Refuse a form whose program takes the reading the other way round.

        Args:
            direction: Who acts on whom in its model of the reading.
            where: Name of the form, for the message.

        Raises:
            FormatError: If the sensor reads the other way round.
        """
        if self.direction != direction:
            raise FormatError(
                f"{where}: expected a reading of measure_direction {direction}, got that of {self.sensor!r}, "
                f"{self.direction}: its program would add the weight in place of taking it off; turn the sign of the "
                "readings in the driver, and weigh again"
            )
