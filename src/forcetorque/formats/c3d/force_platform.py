# SPDX-License-Identifier: BSD-3-Clause
"""Force plates of a C3D file: their geometry, and their wrenches about the centre of the surface [1].

Axes of a plate: corners 1 to 4 lie at (+, +), (-, +), (-, -), (+, -), so x runs from corner 2 to 1, y from corner 4
to 1, and z = x cross y, down into the plate where the corners are as the format has them.

References:
    [1] Motion Lab Systems, The C3D file format user guide, chapter on force platforms.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FormatError
from forcetorque.base.pose import cross, make_pose
from forcetorque.base.units import SI_FACTORS
from forcetorque.base.wrench import WRENCH_UNITS
from forcetorque.formats.c3d.c3d_file import C3dFile
from forcetorque.formats.c3d.plate_conventions import C3dLog, OriginFrom, factor_of, stated_unit

_CHANNELS: Final = {1: 6, 2: 6, 3: 8, 4: 6}
"""Number of channels of each type that is read."""
EDGE_M: Final = (0.05, 10.0)
"""Least and largest edge of a plate; m."""
_SQUARE: Final = 0.05
"""Cosine of the angle between two edges up to which a plate is a rectangle."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ForcePlate(ArrayRecord):
    """A force plate, with its wrench as the file has it."""

    number: int
    """Number in the file, from 1."""
    type: int
    """FORCE_PLATFORM:TYPE."""
    wrench: FloatArray = field(metadata=array("n", 6))
    """Wrench along the axes of the plate, about the centre of its surface; shape (n, 6); N, N m; about the origin of
    the sensor where `origin_m` is None."""
    origin_m: FloatArray | None = field(default=None, metadata=array(3))
    """Vector from the origin of the sensor to the centre of the surface along the axes of the plate; shape (3,); m;
    zero for a type that measures about the surface; None where the sign of ORIGIN is open."""
    corners_m: FloatArray | None = field(default=None, metadata=array(4, 3))
    """Corners in the frame of the markers; shape (4, 3); m; None where they are of no plate."""
    cal_matrix: FloatArray | None = field(default=None, metadata=array(6, 6))
    """Wrench by channels, in the units of the file: CAL_MATRIX of type 4, the identity for type 2; shape (6, 6); None
    for types whose channels are no wrench."""
    unit_factors: FloatArray | None = field(default=None, metadata=array(6))
    """Factors from the units of that wrench to N and N m; shape (6,); None likewise."""

    @property
    def name(self) -> str:
        """Name of its stream, and of its frame."""
        return _name(self.number)

    @property
    def frame(self) -> str:
        """Frame of `wrench`."""
        return self.name if self.origin_m is not None else f"{self.name}_sensor"

    @property
    def half_edges_m(self) -> FloatArray | None:
        """Half of the edges along x and y; shape (2,); m; None without corners."""
        if self.corners_m is None:
            return None
        one, two, _, four = self.corners_m
        return 0.5 * np.array([np.linalg.norm(one - two), np.linalg.norm(one - four)])

    @property
    def lab_H_plate(self) -> FloatArray | None:
        """Pose of the plate in the frame of the markers; shape (4, 4); m; None without corners."""
        return None if self.corners_m is None else pose_of_corners(self.corners_m)


def pose_of_corners(corners_m: FloatArray) -> FloatArray:
    """Compute the pose of a plate.

    Args:
        corners_m: Corners 1 to 4 in a frame; shape (4, 3); m.

    Returns:
        Pose of the plate in that frame, its origin the mean of the corners; shape (4, 4); m.
    """
    one, two, _, four = corners_m
    x = (one - two) / np.linalg.norm(one - two)
    z = np.cross(x, one - four)
    z = z / np.linalg.norm(z)
    return make_pose(np.column_stack([x, np.cross(z, x), z]), corners_m.mean(axis=0))


def undetermined_keys(file: C3dFile) -> set[str]:
    """Name what a file leaves open.

    Args:
        file: The file.

    Returns:
        Keys of the `[recording]` table.
    """
    plates = list(_Stated.all(file))
    keys = set()
    if factor_of(stated_unit(file.length_unit), "m") is None and (plates or file.markers.size):
        keys.add("length_unit")
    for plate in plates:
        units = tuple(file.analog_units[k] for k in plate.channels)
        forces, moments = (units[:3], units[3:]) if plate.type == 2 else (units, ())
        if plate.type == 4:
            forces, moments = plate.output_units[:3], plate.output_units[3:]
        elif plate.type == 1:
            forces, moments = units[:3], units[5:]
        if any(factor_of(stated_unit(unit), "N") is None for unit in forces):
            keys.add("force_unit")
        if any(factor_of(stated_unit(unit), "N m") is None for unit in moments):
            keys.add("moment_unit")
        if plate.origin_is_open:
            keys.add("origin_from")
    return keys


def plate_names(file: C3dFile) -> tuple[str, ...]:
    """Name the plates of a file, whose wrenches may be undetermined yet.

    Args:
        file: The file.

    Returns:
        Names of their streams, in the order of the file.
    """
    return tuple(_name(plate.number) for plate in _Stated.all(file))


def _name(number: int) -> str:
    return f"plate{number}"


def force_plates(file: C3dFile, table: C3dLog) -> tuple[ForcePlate, ...]:
    """Compute the wrenches of all plates.

    Args:
        file: The file.
        table: Units where the file states none, and where ORIGIN begins where that is open.

    Returns:
        The plates in the order of the file.

    Raises:
        FormatError: If a plate is of a type that is not read, or its parameters contradict themselves.
    """
    return tuple(_plate(file, stated, table) for stated in _Stated.all(file))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Stated:
    """Parameters of one plate as the file has them."""

    number: int
    type: int
    channels: tuple[int, ...]
    corners: FloatArray
    origin: FloatArray
    cal_matrix: FloatArray | None
    output_units: tuple[str, ...]

    @classmethod
    def all(cls, file: C3dFile) -> Iterator[_Stated]:
        """Read the parameters of all plates."""
        used = file.numbers("FORCE_PLATFORM:USED")
        types = file.numbers("FORCE_PLATFORM:TYPE", None)
        count = 0 if used is None else int(used)
        if count == 0:
            return
        channel = file.numbers("FORCE_PLATFORM:CHANNEL", None, None)
        corners = file.numbers("FORCE_PLATFORM:CORNERS", 3, 4, None)
        origin = file.numbers("FORCE_PLATFORM:ORIGIN", 3, None)
        for key, values in {"TYPE": types, "CHANNEL": channel, "CORNERS": corners, "ORIGIN": origin}.items():
            if values is None or values.shape[-1] < count:
                got = 0 if values is None else values.shape[-1]
                raise FormatError(f"{file.path}: FORCE_PLATFORM:{key}: expected {count} plates, got {got}")
        if types is None or channel is None or corners is None or origin is None:
            return
        units = file.parameters.get("FORCE_PLATFORM:UNITS")
        output_units = units if isinstance(units, tuple) and len(units) >= 6 * count else ("",) * 6 * count
        for k in range(count):
            kind = int(types[k])
            if kind not in _CHANNELS:
                raise FormatError(
                    f"{file.path}: plate {k + 1}: FORCE_PLATFORM:TYPE: expected 1 to 4, got {kind}; export the plate "
                    "as type 2, forces and moments"
                )
            yield cls(
                number=k + 1,
                type=kind,
                channels=_channel_indices(file, k, channel[:, k], _CHANNELS[kind]),
                corners=corners[:, :, k].T,
                origin=origin[:, k],
                cal_matrix=_cal_matrix(file, k, count) if kind == 4 else None,
                output_units=output_units[6 * k : 6 * k + 6],
            )

    @property
    def origin_is_open(self) -> bool:
        """Whether ORIGIN has not the sign that the format defines."""
        if self.type == 1:
            return False
        vector = self.origin if self.type != 3 else self.origin[2:]
        return bool(vector.any() and not vector[-1] < 0.0)


def _channel_indices(file: C3dFile, plate: int, numbers: FloatArray, count: int) -> tuple[int, ...]:
    indices = tuple(int(number) - 1 for number in numbers[:count])
    if len(indices) < count or any(not 0 <= k < len(file.analog_labels) for k in indices):
        raise FormatError(
            f"{file.path}: plate {plate + 1}: FORCE_PLATFORM:CHANNEL: expected {count} numbers from 1 to "
            f"{len(file.analog_labels)}, got {', '.join(f'{number:g}' for number in numbers)}"
        )
    return indices


def _cal_matrix(file: C3dFile, plate: int, count: int) -> FloatArray:
    matrices = file.numbers("FORCE_PLATFORM:CAL_MATRIX", 6, 6, None)
    if matrices is None or matrices.shape[-1] < count or not matrices[:, :, plate].any():
        raise FormatError(
            f"{file.path}: plate {plate + 1}: FORCE_PLATFORM:CAL_MATRIX: expected a matrix, as type 4 needs, got none"
        )
    return matrices[:, :, plate]


def zero_frames(file: C3dFile) -> tuple[int, int] | None:
    """Give the frames without load whose mean is subtracted.

    Args:
        file: The file.

    Returns:
        First and last frame of FORCE_PLATFORM:ZERO, from 1; None for none.

    Raises:
        FormatError: If the file does not have these frames.
    """
    values = file.numbers("FORCE_PLATFORM:ZERO", 2)
    if values is None:
        return None
    first, last = (int(value) for value in values)
    if last == 0:
        return None
    if not 1 <= first <= last <= len(file.markers):
        raise FormatError(
            f"{file.path}: FORCE_PLATFORM:ZERO: expected frames from 1 to {len(file.markers)}, got {first} to {last}"
        )
    return first, last


def _plate(file: C3dFile, stated: _Stated, table: C3dLog) -> ForcePlate:
    channels = file.analog[:, stated.channels]
    zero = zero_frames(file)
    if zero is not None:
        baseline = channels[(zero[0] - 1) * file.samples_per_frame : zero[1] * file.samples_per_frame].mean(axis=0)
        if stated.type == 1:
            baseline[3:5] = 0.0  # a centre of pressure has no baseline
        channels = channels - baseline
    length = factor_of(stated_unit(file.length_unit) or table.length_unit, "m")
    if length is None:
        raise FormatError(f"{file.path}: POINT:UNITS: expected m or mm, got {file.length_unit!r}; state length_unit")
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        wrench = _sensor_wrench(file, stated, channels, length, table)
        origin: FloatArray | None = length * _surface(stated, table)
        if stated.origin_is_open and table.origin_from is None:
            origin = None
        if origin is not None:
            wrench = np.hstack([wrench[:, :3], wrench[:, 3:] + cross(wrench[:, :3], origin)])
    corners = length * stated.corners
    units = stated.output_units if stated.type == 4 else [file.analog_units[k] for k in stated.channels]
    is_linear = stated.type in (2, 4)
    return ForcePlate(
        number=stated.number,
        type=stated.type,
        wrench=wrench,
        origin_m=origin,
        corners_m=corners if _is_rectangle(corners) else None,
        cal_matrix=(np.eye(6) if stated.cal_matrix is None else stated.cal_matrix) if is_linear else None,
        unit_factors=np.array(
            [_factor(file, unit, dimension, table) for unit, dimension in zip(units, WRENCH_UNITS, strict=True)]
        )
        if is_linear
        else None,
    )


def _surface(stated: _Stated, table: C3dLog) -> FloatArray:
    """Vector from the origin of the sensor to the centre of the surface, in the unit of the file; shape (3,)."""
    if stated.type == 1:
        return np.zeros(3)
    vector = stated.origin if stated.type != 3 else stated.origin * (0.0, 0.0, 1.0)
    return -vector if stated.origin_is_open and table.origin_from is OriginFrom.SURFACE else vector


def _is_rectangle(corners_m: FloatArray) -> bool:
    one, two, three, four = corners_m
    edges = np.array([one - two, two - three, three - four, four - one])
    with np.errstate(over="ignore", invalid="ignore"):
        lengths = np.linalg.norm(edges, axis=1)
        if not ((lengths > EDGE_M[0]) & (lengths < EDGE_M[1])).all():
            return False
        turned = np.roll(edges, 1, axis=0)
        cosines = (edges * turned).sum(axis=1) / (lengths * np.roll(lengths, 1))
    return bool((np.abs(cosines) < _SQUARE).all())


def _sensor_wrench(file: C3dFile, stated: _Stated, channels: FloatArray, length: float, table: C3dLog) -> FloatArray:
    """Wrench about the origin of the sensor; shape (n, 6); N, N m."""
    units: Sequence[str] = [file.analog_units[k] for k in stated.channels]
    if stated.type == 4 and stated.cal_matrix is not None:
        channels, units = channels @ stated.cal_matrix.T, stated.output_units
    if stated.type == 3:
        return _of_kistler(channels * [_factor(file, unit, "N", table) for unit in units], length * stated.origin)
    dimensions = ("N", "N", "N", "m", "m", "N m") if stated.type == 1 else WRENCH_UNITS
    values = channels * [
        _factor(file, unit, dimension, table) for unit, dimension in zip(units, dimensions, strict=True)
    ]
    if stated.type != 1:
        return values
    fz, x, y = values[:, 2], values[:, 3], values[:, 4]
    return np.column_stack([values[:, :3], y * fz, -x * fz, values[:, 5]])


def _factor(file: C3dFile, unit: str, dimension: str, table: C3dLog) -> float:
    """Factor of a channel: by its own unit, else by the key of the table."""
    factor = factor_of(stated_unit(unit), dimension)
    if factor is not None:
        return factor
    key = {"m": "length_unit", "N": "force_unit", "N m": "moment_unit"}[dimension]
    chosen = getattr(table, key)
    if chosen is None:
        raise FormatError(f"{file.path}: ANALOG:UNITS: expected a unit such as {dimension}, got {unit!r}; state {key}")
    return SI_FACTORS[chosen][1]


def _of_kistler(channels: FloatArray, origin_m: FloatArray) -> FloatArray:
    """Wrench of a plate of type 3 about the centre between its four sensors; shape (n, 6); N, N m."""
    fx12, fx34, fy14, fy23, fz1, fz2, fz3, fz4 = channels.T
    a, b, _ = origin_m
    moment = (
        b * (fz1 + fz2 - fz3 - fz4),
        a * (fz2 + fz3 - fz1 - fz4),
        b * (fx34 - fx12) + a * (fy14 - fy23),
    )
    return np.column_stack([fx12 + fx34, fy14 + fy23, fz1 + fz2 + fz3 + fz4, *moment])


def centre_of_pressure(wrench: FloatArray) -> FloatArray:
    """Compute where a force acts on the surface without a moment along it.

    Args:
        wrench: Wrenches along the axes of a plate, about the centre of its surface; shape (n, 6); N, N m.

    Returns:
        x and y from the centre; shape (n, 2); m. The sign of the wrench does not matter.
    """
    return np.column_stack([-wrench[:, 4], wrench[:, 3]]) / wrench[:, 2:3]
