# SPDX-License-Identifier: BSD-3-Clause
"""The mount of a sensor: any rotation and shift against the robot model, estimated from known wrenches."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import permutations, product

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array
from forcetorque.base.errors import FitError
from forcetorque.base.pose import skew
from forcetorque.base.wrench import FORCE

_AXES = ("x", "y", "z")
_ALONG = 0.9995
"""Least component of a unit vector that is said to lie along an axis: 1.8 degrees."""


def quarter_turns() -> list[FloatArray]:
    """List the 24 rotations that bring axes to axes.

    Returns:
        Rotations, none first; shape (3, 3) each.
    """
    turns = []
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            turn = np.eye(3)[list(order)] * np.array(signs)[:, None]
            if np.linalg.det(turn) > 0.0:
                turns.append(turn)
    return sorted(turns, key=lambda turn: -float(np.trace(turn)))


def nearest_rotation(response: FloatArray) -> FloatArray:
    """Find the rotation that is nearest to a matrix up to its size (Procrustes).

    Args:
        response: Forces over what they are expected to be, `force = response @ expected`; shape (3, 3).

    Returns:
        The rotation; shape (3, 3).
    """
    left, _, right = np.linalg.svd(response)
    flip = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(left @ right))) or 1.0])
    return left @ flip @ right


def rotation_by(vector: FloatArray) -> FloatArray:
    """Rotate by a rotation vector (Rodrigues).

    Args:
        vector: Axis times angle; shape (3,); rad.

    Returns:
        The rotation; shape (3, 3).
    """
    angle = float(np.linalg.norm(vector))
    hat = skew(vector)
    if angle < 1e-12:
        return np.eye(3) + hat
    return np.eye(3) + np.sin(angle) / angle * hat + (1.0 - np.cos(angle)) / angle**2 * hat @ hat


def rotation_vector(rotation: FloatArray) -> FloatArray:
    """Give axis times angle of a rotation.

    Args:
        rotation: The rotation; shape (3, 3).

    Returns:
        Shape (3,); rad, of a size from 0 to pi.
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    # a copy: before scipy 1.16 no rotation is made of an array that is read-only
    return np.asarray(Rotation.from_matrix(np.array(rotation)).as_rotvec(), dtype=np.float64)


def rotation_words(vector: FloatArray) -> str:
    """Name a rotation.

    Args:
        vector: Axis times angle; shape (3,); rad.

    Returns:
        Text such as `17.2 deg about z`, or `-5.0 deg about (0.60, 0.00, 0.80)`.
    """
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return "0.0 deg"
    axis = vector / angle
    k = int(np.abs(axis).argmax())
    sign = float(np.sign(axis[k]))
    about = _AXES[k] if abs(axis[k]) > _ALONG else "({:.2f}, {:.2f}, {:.2f})".format(*(sign * axis + 0.0))
    return f"{sign * np.rad2deg(angle):.1f} deg about {about}"


_SPREAD = 0.1
"""Standard deviation of the coefficients of a matrix, relative to its row: mounted sensors are off by half as much."""
_LEVER_M = 0.03
"""Full scale of moments over that of forces, where nobody states them; m."""
_HELD = 1e-12
"""Share of the information of an unknown that holds it where no load tells it."""
_FIRST_STEPS, _REFINED, _STEPS = 4, 3, 30
"""Steps from every start, how many of the best go on, and their steps."""
_SETTLED = 1e-9
"""Step at which a mount does not move any more; rad, m."""
_ROTATION_RAD, _SHIFT_M = np.deg2rad(8.0), 0.05
"""Standard deviations from which on a rotation or a shift is not determined."""
_FEWEST = 10.0
"""Independent samples that a recording counts for at least, however slow its noise is."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MountEstimate(ArrayRecord):
    """Where a sensor sits against where the robot model says that it does."""

    rotation: FloatArray = field(metadata=array(3, 3))
    """`sensor_R_stated`; shape (3, 3)."""
    shift: FloatArray = field(metadata=array(3))
    """Origin of the sensor in its stated frame; shape (3,); m."""
    deviations: FloatArray = field(metadata=array(6))
    """Standard deviations of a small rotation about the sensor's axes and of the shift; shape (6,); rad, m."""
    covariance: FloatArray = field(metadata=array(6, 6))
    """Their covariance; shape (6, 6)."""
    residual_before: FloatArray = field(metadata=array(6))
    """Root mean square of what the stated mount leaves; shape (6,); N, N m."""
    residual_after: FloatArray = field(metadata=array(6))
    """The same with the estimated mount and the matrix as it is; shape (6,); N, N m."""

    @property
    def undetermined(self) -> str:
        """What the data leave open, with the motion that is missing; empty where they determine the mount."""
        values, vectors = np.linalg.eigh(self.covariance[:3, :3])
        if values[-1] > _ROTATION_RAD**2:
            unit = vectors[:, -1] * np.sign(vectors[np.abs(vectors[:, -1]).argmax(), -1])
            axis = "({:.2f}, {:.2f}, {:.2f})".format(*(unit + 0.0))
            return (
                f"the rotation about {axis} is known to ±{np.rad2deg(np.sqrt(values[-1])):.2g} deg only; turn the "
                "sensor about two level axes, with a known weight beyond it, so that gravity moves in its axes"
            )
        if self.deviations[3:].max() > _SHIFT_M:
            return (
                f"the shift is known to ±{1e3 * self.deviations[3:].max():.2g} mm only; turn the sensor about two "
                "level axes with a heavier known weight beyond it"
            )
        return ""

    @property
    def standard_deviations_off(self) -> float:
        """Distance of the rotation from none, in standard deviations along its axis."""
        vector = rotation_vector(self.rotation)
        angle = float(np.linalg.norm(vector))
        if angle == 0.0:
            return 0.0
        unit = vector / angle
        return angle / float(np.sqrt(unit @ self.covariance[:3, :3] @ unit))


def estimate_mount(
    measured: FloatArray, expected: FloatArray, group: IntArray, *, full_scale: FloatArray | None = None
) -> MountEstimate:
    """Estimate rotation and shift of a sensor from known wrenches, whatever its offset is.

    A reading is `(1 + E) X(R, p) expected + offset`. E, the error of the matrix that reads the sensor, has a standard
    deviation of a tenth of its row. It starts from the rotation that is nearest to the response of the forces, and from
    the 24 turns that bring axes to axes, of which the best is refined.

    Args:
        measured: Wrenches that the sensor reads; shape (n, 6); N, N m.
        expected: Wrenches that it must read in its stated frame; shape (n, 6); N, N m.
        group: Number of the offset of each sample; shape (n,).
        full_scale: Full scale of the sensor, which gives its lever; shape (6,); N, N m; 30 mm if left out.

    Returns:
        The mount.

    Raises:
        FitError: If there are fewer than seven samples, or the expected force does not change.
    """
    reading, wrench = measured.copy(), expected.copy()
    for number in np.unique(group):
        mine = group == number
        reading[mine] -= reading[mine].mean(axis=0)
        wrench[mine] -= wrench[mine].mean(axis=0)
    if len(wrench) < 7 or not np.abs(wrench[:, FORCE]).max(initial=0.0) > 1e-6:
        raise FitError(
            f"mount: expected at least 7 samples of a load that moves, got {len(wrench)}; turn the sensor about two "
            "level axes, with a known weight beyond it"
        )
    problem = _MountProblem.of(reading, wrench, full_scale)
    response = reading[:, FORCE].T @ wrench[:, FORCE]
    starts = [nearest_rotation(response), *quarter_turns()]
    coarse = sorted((problem.fitted(start, steps=_FIRST_STEPS) for start in starts), key=lambda fit: fit[0])
    fits = [problem.fitted(rotation) for _, rotation, _, _ in coarse[:_REFINED]]
    _, rotation, shift, covariance = min(fits, key=lambda fit: fit[0])
    after = reading - wrench @ wrench_map(rotation, shift).T
    return MountEstimate(
        rotation=rotation,
        shift=shift,
        deviations=np.sqrt(np.diag(covariance)),
        covariance=covariance,
        residual_before=np.sqrt(((reading - wrench) ** 2).mean(axis=0)),
        residual_after=np.sqrt((after**2).mean(axis=0)),
    )


def wrench_map(rotation: FloatArray, shift: FloatArray) -> FloatArray:
    """Express wrenches of a stated frame in that of a sensor which sits otherwise.

    Args:
        rotation: `sensor_R_stated`; shape (3, 3).
        shift: Origin of the sensor in the stated frame; shape (3,); m.

    Returns:
        Shape (6, 6): `force = R f`, `moment = R (m - p x f)`.
    """
    turned = np.zeros((6, 6))
    turned[:3, :3] = turned[3:, 3:] = rotation
    turned[3:, :3] = -rotation @ skew(shift)
    return turned


_Fitted = tuple[float, FloatArray, FloatArray, FloatArray]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _MountProblem:
    """Sufficient statistics: `response @ root` against that of the model, over the noise."""

    target: FloatArray
    """Best response by least squares, times the root of the loads' moments, over the noise; shape (6, r)."""
    root: FloatArray
    """Root of the loads' second moments in the directions that they move; shape (6, r)."""
    noise: FloatArray
    """Standard deviation of a mean reading over all samples; shape (6,)."""
    spread: FloatArray
    """Standard deviation of E; shape (6, 6)."""

    @classmethod
    def of(cls, reading: FloatArray, wrench: FloatArray, full_scale: FloatArray | None) -> _MountProblem:
        lever = _LEVER_M if full_scale is None else float(full_scale[3:].mean() / full_scale[:3].mean())
        sizes = np.repeat([1.0, lever], 3)
        squares, directions = np.linalg.eigh((wrench / sizes).T @ (wrench / sizes) / len(wrench))
        moving = squares > 1e-9 * squares[-1]
        root = sizes[:, None] * directions[:, moving] * np.sqrt(squares[moving])
        along = (wrench / sizes) @ directions[:, moving] / np.sqrt(squares[moving])
        follows = reading.T @ along / len(wrench)
        left = reading - along @ follows.T
        noise = np.sqrt((left**2).mean(axis=0))
        noise = np.maximum(noise, 1e-6 * sizes * np.abs(reading / sizes).max())
        lag = (left[1:] * left[:-1]).mean(axis=0) / np.maximum((left**2).mean(axis=0), 1e-300)
        lag = np.clip(lag, 0.0, 0.99)
        count = np.maximum(len(wrench) * (1.0 - lag) / (1.0 + lag), _FEWEST)
        return cls(
            target=follows, root=root, noise=noise / np.sqrt(count), spread=_SPREAD * sizes[:, None] / sizes[None, :]
        )

    def fitted(self, start: FloatArray, *, steps: int = _STEPS) -> _Fitted:
        """Cost, rotation, shift and the covariance of both, from a first rotation (Gauss-Newton)."""
        rotation, shift, error = start, np.zeros(3), np.zeros((6, 6))
        # what no load tells has no end: a radian or a metre stands for it
        free = np.diag([1.0] * 6 + [0.0] * 36)
        for _ in range(steps):
            information, sides, _ = self._linear(rotation, shift, error)
            held = np.diag(_HELD * np.diag(information)) + _HELD * free
            step = np.asarray(np.linalg.solve(information + held, sides), dtype=np.float64)
            turn = float(np.linalg.norm(step[:3]))
            rotation = rotation_by(step[:3] * min(1.0, 1.0 / max(turn, 1e-12))) @ rotation
            shift, error = np.asarray(shift + step[3:6]), error + step[6:].reshape(6, 6)
            if np.abs(step[:6]).max() < _SETTLED:
                break
        information, _, cost = self._linear(rotation, shift, error)
        covariance = np.asarray(np.linalg.inv(information + free)[:6, :6], dtype=np.float64)
        return cost, rotation, shift, covariance

    def _linear(
        self, rotation: FloatArray, shift: FloatArray, error: FloatArray
    ) -> tuple[FloatArray, FloatArray, float]:
        """Normal equations of rotation (3), shift (3) and E (36): matrix, right side, and the cost so far."""
        placed, matrix = wrench_map(rotation, shift), np.eye(6) + error
        turns = np.zeros((6, 6, 6))
        turns[:3, :3, :3] = turns[:3, 3:, 3:] = skew(np.eye(3))
        turns[:3] = turns[:3] @ placed
        turns[3:, 3:, :3] = -rotation @ skew(np.eye(3))
        weight = 1.0 / self.noise[:, None]
        of_mount = (matrix @ turns @ self.root * weight).reshape(6, -1)
        load = placed @ self.root
        of_error = np.einsum("ik,jr->ijkr", np.diag(weight[:, 0]), load).reshape(36, -1)
        design = np.vstack([of_mount, of_error])
        left = ((self.target - matrix @ load) * weight).ravel()
        precision = self.spread.ravel() ** -2.0
        information, sides = design @ design.T, design @ left
        information[6:, 6:] += np.diag(precision)
        sides[6:] -= precision * error.ravel()
        return information, sides, float(left @ left + precision @ error.ravel() ** 2)
