# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a problem of known loads: what was read, how the load moved, which load it was, and in which power-up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only, read_only_integers
from forcetorque.errors import FitError, ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadRows:
    """n readings of one sensor, means or still poses, in the order in which they were taken."""

    wrench: FloatArray
    """Readings as wrenches in the sensor's frame and direction; shape (n, 6); N, N m."""
    proper_acceleration: FloatArray
    """Of the sensor's origin along its axes, `-g` where it is still; shape (n, 3); m/s2."""
    angular_velocity_products: FloatArray | None = None
    """Products `w w'` of the angular velocity w along the sensor's axes, as means over each row, because products of
    means lose what varies within a row; shape (n, 3, 3); rad2/s2; None where it stands still or turns slowly."""
    angular_acceleration: FloatArray | None = None
    """Along the sensor's axes; shape (n, 3); rad/s2; given if the products of the angular velocity are."""
    time_s: FloatArray | None = None
    """Instants, not falling within a session; shape (n,); s; None for poses without instants, whose noise is taken for
    independent: their order counts for drift only."""
    session: IntArray
    """Number of the power-up of each row; shape (n,)."""
    block: IntArray
    """Number of the interval or series of each row, within which the bias is surely one; shape (n,)."""
    load: IntArray
    """Number of the load on the sensor; shape (n,)."""
    share: FloatArray
    """Samples in each row over the usual number; shape (n,)."""
    columns: FloatArray | None = None
    """What a unit of mass (kg), first moment (kg m) and inertia (xx, yy, zz, xy, xz, yz; kg m2) about the origin of the
    load's own frame adds to the wrench that moves it, in the sensor's frame, as means over each row; shape (n, 6, 10);
    None where the load's frame is the sensor's, so that the motion of each row tells it."""
    known: FloatArray | None = None
    """What the sensor reads of bodies beyond it that are no load, such as links of a robot; shape (n, 6); N, N m."""
    variables: FloatArray | None = None
    """Temperatures, or whatever else moves the bias linearly; shape (n, v)."""
    orientation: FloatArray | None = None
    """`world_R_sensor`, z of the world up; shape (n, 3, 3); None where only gravity was logged."""
    names: tuple[str, ...]
    """Where each row is from, such as `poses 17`; n words."""

    def __post_init__(self) -> None:
        wrench = read_only(self.wrench, name="wrench", shape=(None, 6))
        n = len(wrench)
        object.__setattr__(self, "wrench", wrench)
        shapes: dict[str, tuple[int | None, ...]] = {
            "proper_acceleration": (n, 3),
            "angular_velocity_products": (n, 3, 3),
            "angular_acceleration": (n, 3),
            "columns": (n, 6, 10),
            "known": (n, 6),
            "time_s": (n,),
            "share": (n,),
            "variables": (n, None),
            "orientation": (n, 3, 3),
        }
        for field, shape in shapes.items():
            if getattr(self, field) is not None:
                object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))
        for field in ("session", "block", "load"):
            object.__setattr__(self, field, read_only_integers(getattr(self, field), name=field, shape=(n,)))
        if len(self.names) != n:
            raise ShapeError(f"names: expected {n}, one for each row, got {len(self.names)}")
        if (self.angular_velocity_products is None) != (self.angular_acceleration is None):
            raise FitError("angular velocity and angular_acceleration: expected both or neither")
        self._require_finite()

    def __len__(self) -> int:
        return len(self.wrench)

    def moved(self, values: FloatArray) -> FloatArray:
        """Take values from their mean in each power-up, in which the bias is one.

        Args:
            values: Of the rows; shape (n, k).

        Returns:
            What changes within power-ups; shape (n, k).
        """
        moved = values.copy()
        for session in np.unique(self.session):
            mine = self.session == session
            moved[mine] -= moved[mine].mean(axis=0)
        return moved

    def _require_finite(self) -> None:
        for field in (
            "wrench",
            "proper_acceleration",
            "angular_velocity_products",
            "angular_acceleration",
            "variables",
        ):
            values = getattr(self, field)
            if values is None:
                continue
            lacking = ~np.isfinite(values).all(axis=tuple(range(1, values.ndim)))
            if lacking.any():
                first = int(np.flatnonzero(lacking)[0])
                raise FitError(
                    f"{field}: row {self.names[first]!r} has a value that is no finite number ({int(lacking.sum())} "
                    "such rows); leave these rows out, or mend the log"
                )

    @classmethod
    def of_poses(
        cls,
        wrench: Any,
        proper_acceleration: Any,
        *,
        angular_velocity: Any = None,
        session: Sequence[int] | None = None,
        **others: Any,
    ) -> LoadRows:
        """Take still poses, or any rows that are counted alike.

        Args:
            wrench: As of the class.
            proper_acceleration: As of the class.
            angular_velocity: Of rows that are single instants, along the sensor's axes; shape (n, 3); rad/s; None of
                poses that are still.
            session: As of the class; one for all if left out.
            others: As of the class; blocks are the sessions, the load is the first, rows are numbered from 1.

        Returns:
            The rows.
        """
        n = len(np.asarray(wrench))
        number = np.zeros(n, dtype=np.int64) if session is None else np.asarray(session)
        default: dict[str, Any] = {
            "block": number,
            "load": np.zeros(n, dtype=np.int64),
            "share": np.ones(n),
            "names": tuple(f"row {k}" for k in range(1, n + 1)),
        }
        if angular_velocity is not None:
            velocity = read_only(angular_velocity, name="angular_velocity", shape=(n, 3))
            default["angular_velocity_products"] = velocity[:, :, None] * velocity[:, None, :]
        return cls(wrench=wrench, proper_acceleration=proper_acceleration, session=number, **(default | others))
