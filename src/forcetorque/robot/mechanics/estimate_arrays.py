# SPDX-License-Identifier: BSD-3-Clause
"""What an estimation gives, in arrays that may be handed in to be filled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray, IntArray, require_shape
from forcetorque.base.errors import EstimationError, ShapeError, require_known

MakeArray = Callable[[str, tuple[int, ...], npt.DTypeLike], npt.NDArray[Any]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Names of the columns of every result; what was not asked for has none."""

    sensors: tuple[str, ...]
    """Sensors of `expected`."""
    contacts: tuple[str, ...]
    """Contacts of `contact_wrenches`."""
    joints: tuple[str, ...]
    """Joints of `torques`."""
    links: tuple[str, ...]
    """Links of `net_wrenches`."""
    parts: tuple[str, ...]
    """Sub-models of `rank`, `condition` and `residual`, by the sensor at their base or the root link."""

    def shapes(self, n: int) -> dict[str, tuple[int, ...]]:
        """Give the shape of every result.

        Args:
            n: Number of samples.

        Returns:
            Shapes by field of `Estimates`.
        """
        return {
            "expected": (n, len(self.sensors), 6),
            "contact_wrenches": (n, len(self.contacts), 6),
            "torques": (n, len(self.joints)),
            "net_wrenches": (n, len(self.links), 6),
            "rank": (n, len(self.parts)),
            "condition": (n, len(self.parts)),
            "residual": (n, len(self.parts), 6),
        }


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Estimates:
    """Results of n samples; a sample with a gap (NaN) is NaN wherever the gap matters, and nowhere else.

    The arrays are written by the estimator and so are not read-only.
    """

    layout: Layout
    """Names of the columns."""
    expected: FloatArray
    """Expected readings, in the sensor's frame and direction; shape (n, sensors, 6); N, N m."""
    contact_wrenches: FloatArray
    """What the environment does to the robot, in and about the contact frame; shape (n, contacts, 6); N, N m."""
    torques: FloatArray
    """Inverse-dynamics torques: what the motor does along +q; shape (n, joints); N m, N where prismatic."""
    net_wrenches: FloatArray
    """Wrench that moves each link as it moves, gravity included (thesis 2.3), in its frame; shape (n, links, 6);
    N, N m."""
    rank: IntArray
    """Unknown components that the equation determines; shape (n, parts)."""
    condition: FloatArray
    """Largest over smallest determined singular value of the weighted equation; shape (n, parts); NaN for rank 0."""
    residual: FloatArray
    """Wrench on each sub-model that its contacts leave unexplained, in the frame of its sensor or of the root link;
    shape (n, parts, 6); N, N m."""

    def __post_init__(self) -> None:
        for field, shape in self.layout.shapes(len(self.expected)).items():
            array, wanted = getattr(self, field), _dtype(field)
            require_shape(array, name=field, shape=shape)
            if array.dtype != wanted or not array.flags.c_contiguous:
                raise ShapeError(f"{field}: expected a C-ordered array of {wanted}, got {array.dtype}")

    @classmethod
    def empty(cls, layout: Layout, n: int, *, make: MakeArray | None = None) -> Estimates:
        """Make room for results.

        Args:
            layout: Names of the columns.
            n: Number of samples.
            make: Makes an array from the field's name, its shape and type, such as a mapped file; memory if None.

        Returns:
            Results that are not filled yet.
        """
        make_array = make or (lambda _, shape, dtype: np.empty(shape, dtype=dtype))
        arrays: dict[str, Any] = {
            name: make_array(name, shape, _dtype(name)) for name, shape in layout.shapes(n).items()
        }
        return cls(layout=layout, **arrays)

    def __len__(self) -> int:
        return len(self.expected)

    def samples(self, block: slice) -> Estimates:
        """Look at some of the samples.

        Args:
            block: Range of samples, without a step.

        Returns:
            Views of the same memory.
        """
        arrays: dict[str, Any] = {name: getattr(self, name)[block] for name in self.layout.shapes(0)}
        return Estimates(layout=self.layout, **arrays)

    def expected_of(self, sensor: str) -> FloatArray:
        """Give the expected readings of a sensor.

        Args:
            sensor: Its name.

        Returns:
            Readings; shape (n, 6); N, N m.
        """
        return self.expected[:, column_of(sensor, self.layout.sensors, "expected reading")]

    def contact(self, name: str) -> FloatArray:
        """Give the wrenches of a contact.

        Returns:
            Wrenches in the contact frame; shape (n, 6); N, N m.
        """
        return self.contact_wrenches[:, column_of(name, self.layout.contacts, "contact")]

    def torque(self, joint: str) -> FloatArray:
        """Give the torques of a joint.

        Args:
            joint: Its name.

        Returns:
            Torques; shape (n,); N m, N where prismatic.
        """
        return self.torques[:, column_of(joint, self.layout.joints, "torque")]

    def net_wrench(self, link: str) -> FloatArray:
        """Give the net wrenches of a link.

        Args:
            link: Its name.

        Returns:
            Wrenches in the link's frame; shape (n, 6); N, N m.
        """
        return self.net_wrenches[:, column_of(link, self.layout.links, "net wrench")]

    def residual_of(self, part: str) -> FloatArray:
        """Give what the contacts of a sub-model leave unexplained.

        Args:
            part: Sensor at its base, or the root link.

        Returns:
            Wrenches in the frame of that sensor or link; shape (n, 6); N, N m.
        """
        return self.residual[:, column_of(part, self.layout.parts, "sub-model")]


def _dtype(field: str) -> np.dtype[Any]:
    return np.dtype(np.int64 if field == "rank" else np.float64)


def column_of(name: str, names: tuple[str, ...], what: str) -> int:
    """Find the column of a name among those of a result.

    Args:
        name: The name.
        names: Names of the columns.
        what: What they are, for messages.

    Returns:
        Its number.

    Raises:
        EstimationError: If it was not asked for.
    """
    require_known(name, names, EstimationError, f"no {what} of {name!r} was asked for")
    return names.index(name)
