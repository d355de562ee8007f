# SPDX-License-Identifier: BSD-3-Clause
"""What the generative model assumes before data: how far sensors deviate from their prior matrix, row by row."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Final, Literal

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, require_shape
from forcetorque.base.errors import FitError
from forcetorque.experiment.calibration.robot_model_error import OF_CABLES, MountTolerance, TermKind
from forcetorque.experiment.calibration.sensor_model import LinearVariable, measured_components

ACCURACY_SHARE: Final = 1e-3
"""Accuracy of the reference where nobody states it, as a share of the full scale."""
REPEATABILITY: Final = 0.003
"""Share of its response by which a sensor differs from one motion to the next (creep, hysteresis), unless stated."""

FRAME_M: Final = 0.1
"""Lever by which the frame of the reference may be displaced: as far as the origins of links and sensors lie apart."""


FRAME_ROOTS: Final = np.stack([np.diag([1.0] * 3 + [0.0] * 3)] * 3 + [np.diag([FRAME_M] * 3 + [1.0] * 3)] * 3)
"""L of every row, with L L^T the covariance of what gain, rotation and displacement of a frame do; shape (6, 6, 6)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scale:
    """Size that a kind of deviation is expected to have, and how many coefficients' worth of data that counts for."""

    expected: float
    """Root mean square deviation."""
    weight: float
    """Pseudo coefficients: data overrule the expectation when they determine more coefficients than that."""
    least: float = 0.0
    """Size below which no evidence takes it."""


SENSOR: Final = Scale(expected=0.06, weight=6.0)
"""Every coefficient of the matrix, relative to the root mean square of its row."""
FRAME: Final = Scale(expected=0.02, weight=6.0)
"""Gain, rotation and displacement of the reference."""
COEFFICIENTS: Final = Scale(expected=0.06, weight=0.5)
"""The same where the robot model may be wrong: gain and frame of the sensor then have sizes of their own.

The data of one sensor tell this size, so the expectation counts for half a coefficient: where it counts for two, more
simulated sensors get worse than they were. Where 0.045 is expected fewer do, but the foot of the yoga log, fitted free
and then stood upon, errs by more than the predicted 95 %.
"""
COEFFICIENTS_TOGETHER: Final = Scale(expected=0.06, weight=2.0)
"""The same in a joint fit, which holds the size: evidence would take errors of the model for errors of sensors."""
STATED: Final = Scale(expected=1.0, weight=4.0, least=1.0)
"""The same over what is stated of a prior matrix: evidence may find it larger, never smaller."""
GAIN: Final = Scale(expected=0.005, weight=0.25)
"""Gain of every channel, relative.

Few sensors have channels whose gains differ, and where they do data tell: where 2 % are expected, more simulated
sensors get worse than they were; where the expectation counts for a whole coefficient, intervals of sensors whose gains
differ by 5 % hold too little.
"""
ROTATION: Final = Scale(expected=float(np.radians(0.35)), weight=0.25)
"""Rotation of the sensor about each of its axes; rad."""
SHIFT: Final = Scale(expected=0.002, weight=6.0)
"""Shift of its origin along each of them; m. Centres of mass that are off look like one, so it is held."""
MODEL: Final = Scale(expected=1.0, weight=4.0, least=1.0)
"""Errors of the robot model of one kind, over their tolerance: evidence may find them larger, never smaller."""
MASS: Final = Scale(expected=1.0, weight=8.0, least=1.0)
"""The same of masses, for which evidence must be stronger: masses that all err alike read as a gain of the sensor."""
CABLE: Final = Scale(expected=1.0, weight=0.25)
"""The same of what cables and covers pull: few robots have none, and evidence may find it smaller too."""
QUADRATIC: Final = Scale(expected=0.02, weight=0.25)
"""Quadratic terms, over full scale, where the robot model may be wrong.

Where 5 % are expected, which count for six coefficients, legs and feet of a real log err by 1.1 times as much.
"""
QUADRATIC_ALONE: Final = Scale(expected=0.05, weight=6.0)
"""The same where nothing else covers creep taken for gain: of an exact robot model, or of a sensor without a prior."""
FLATTENED: Final = 1.0 / 3.0
"""What the derivative window took from the reference, over what one of twice the length would take besides.

The error of a window grows with the square of its length where the motion is smooth.
"""
FLATTENING: Final = Scale(expected=0.03, weight=np.inf)
"""By how much that may be otherwise, as where a motion has corners."""

_EXACT: Final = 1e-9
"""Size of what is exact: rad, m."""
_DEGREES: Final = ("degC", "K", "degF")
DRIFT_SHARE_PER_DEGREE: Final = 0.005
"""What a temperature coefficient may be: a share of full scale per degree."""
VARIABLE_SHARE: Final = 1.0
"""What any other variable may do over the range in which it was seen: a share of full scale."""


def variable_sizes(variable: LinearVariable, from_load: FloatArray, extent: float) -> FloatArray:
    """Say what a unit of a variable may add to the rows of the model.

    Args:
        variable: The variable.
        from_load: What a load does to the rows, in units of their own; shape (rows, 6).
        extent: Range over which the variable was seen; 0 before any data.

    Returns:
        Standard deviations: what is stated, or a share of full scale; shape (rows,); in these units per unit.

    Raises:
        FitError: If nothing is stated of a variable that is no temperature and did not move.
    """
    if variable.prior_deviation is not None:
        return np.asarray(np.linalg.norm(from_load * variable.prior_deviation, axis=1))
    if variable.unit in _DEGREES:
        return np.full(len(from_load), DRIFT_SHARE_PER_DEGREE)
    if not extent:
        raise FitError(
            f"variable {variable.name!r}: expected prior_deviation, what one {variable.unit or 'unit'} of it may do, "
            "or data at several values: it is no temperature, and its value is the same throughout the data, which "
            "says nothing of its coefficients; state it, record more, or leave the variable out"
        )
    return np.full(len(from_load), VARIABLE_SHARE / extent)


def model_scale(kind: TermKind) -> Scale:
    """Give the expected size of errors of the robot model of one kind, over their tolerance."""
    if kind in OF_CABLES:
        return CABLE
    return MASS if kind is TermKind.MASS else MODEL


def quadratic_scale(*, with_prior: bool, exact: bool) -> Scale:
    """Give the expected size of quadratic terms, of a sensor with a prior or of a robot model that is exact."""
    return QUADRATIC if with_prior and not exact else QUADRATIC_ALONE


def mount_scales(mount: MountTolerance) -> tuple[Scale, Scale]:
    """Give the expected sizes of rotation (rad) and shift (m) of the frame of a sensor.

    Args:
        mount: How far it may be off; sizes that are stated are never taken as smaller, as those of the robot model.

    Returns:
        Of rotation and shift.
    """
    return _stated_or(ROTATION, mount.rotation_rad), _stated_or(SHIFT, mount.shift_m)


def _stated_or(usual: Scale, size: float | None) -> Scale:
    if size is None:
        return usual
    return Scale(expected=max(size, _EXACT), weight=MODEL.weight, least=max(size, _EXACT))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Assumptions(ArrayRecord):
    """What is known of a sensor and of its reference beside data and prior matrix."""

    full_scale: FloatArray = field(metadata=array(None))
    """Full scale of every channel of the reading; shape (c,); counts, or N and N m where a wrench stands for counts."""
    accuracy: FloatArray | None = field(default=None, metadata=array(6))
    """Standard deviation of a slow error of the reference that no averaging takes away; shape (6,); N, N m.

    None for `ACCURACY_SHARE` of the full scale of every channel.
    """
    repeatability: float = REPEATABILITY
    """Share of its response by which the sensor differs from one motion to the next; only widens the covariance."""
    mount: MountTolerance = MountTolerance()
    """How far the frame of the sensor may be from that of the robot model, where the model may be wrong."""
    load_full_scale: FloatArray | None = field(default=None, metadata=array(6))
    """Largest loads of a sensor that measures fewer than six components; shape (6,); N, N m.

    One in a component that is not measured may move a channel as far as one in a component that is.
    """
    prior_size: FloatArray | None = field(default=None, metadata=array(6))
    """How far coefficients of the prior matrix are off, relative to the root mean square of their row, as a certificate
    has it of a sensor of six channels; shape (6,); None where nobody states it."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if not (np.isfinite(self.full_scale).all() and (self.full_scale > 0.0).all()):
            raise FitError(f"full_scale: expected numbers above 0, got {self.full_scale.tolist()}")
        if self.accuracy is not None and not (np.isfinite(self.accuracy).all() and (self.accuracy >= 0.0).all()):
            raise FitError(f"accuracy: expected numbers of at least 0 (N, N m), got {self.accuracy.tolist()}")
        if not 0.0 <= self.repeatability < 1.0:
            raise FitError(f"repeatability: expected a share from 0 to 1, got {self.repeatability:g}")

    @classmethod
    def of_counts(
        cls, channels: int, limit_counts: float, *, accuracy: Any = None, repeatability: float = REPEATABILITY
    ) -> Assumptions:
        """Assume channels of one range.

        Args:
            channels: Number c of channels.
            limit_counts: Largest magnitude of a reading; counts.
            accuracy: As of the class.
            repeatability: As of the class.

        Returns:
            The assumptions.
        """
        return cls(full_scale=np.full(channels, limit_counts), accuracy=accuracy, repeatability=repeatability)

    @property
    def states_accuracy(self) -> bool:
        """Whether an accuracy of the reference is given, other than 0."""
        return self.accuracy is not None and bool(self.accuracy.any())

    def reference_accuracy(self, matrix: FloatArray) -> FloatArray:
        """Give the accuracy of the reference.

        Args:
            matrix: Matrix of the sensor, for the full scale of each component; shape (6, c).

        Returns:
            Standard deviations; shape (6,); N, N m.
        """
        require_shape(matrix, name="matrix", shape=(6, len(self.full_scale)))
        if self.accuracy is not None:
            return self.accuracy
        return ACCURACY_SHARE * np.linalg.norm(matrix * self.full_scale, axis=1)


def stated_prior_size(
    matrix: FloatArray, full_scale: FloatArray, load_full_scale: FloatArray, deviation: FloatArray
) -> FloatArray:
    """Give the size of errors of a prior matrix that make its readings as uncertain as is stated.

    Args:
        matrix: Prior matrix; shape (6, c); N, N m per count.
        full_scale: Full scale of every channel; shape (c,); counts.
        load_full_scale: Full scale of every component; shape (6,); N, N m.
        deviation: Standard deviation of the error of every component, root mean square over the six loads of full scale
            along one component each; shape (6,); N, N m.

    Returns:
        Relative to the root mean square of the row; shape (6,).
    """
    scaled = matrix * full_scale
    squares = (np.linalg.pinv(scaled) ** 2).sum(axis=0) * load_full_scale**2
    return np.asarray(deviation / np.sqrt((scaled**2).mean(axis=1) * squares.mean()))


LOADS = 6
"""Coefficients of a row of the matrix, one for each component of a load; and components of a wrench."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rows:
    """The rows of the model, each in units of its own size."""

    space: Literal["wrench", "channel"]
    """What the rows are."""
    unit: FloatArray
    """Size of each row; shape (rows,); N, N m in wrench space, counts in channel space."""
    group: IntArray
    """Rows of one number share the sizes of their deviations: forces and moments, or all channels; shape (rows,)."""
    from_raw: FloatArray
    """What reads the rows off the raw readings, in these units; shape (rows, c)."""
    from_load: FloatArray
    """What a load is expected to do to the rows, in these units; shape (rows, 6)."""
    load_to_full_scale: FloatArray
    """Share of full scale that a load makes of six independent readings; shape (6, 6)."""
    sensor_root: FloatArray
    """L of every row, with L L^T the covariance of its six coefficients where the sensor differs by 1; (rows, 6, 6)."""
    frame_root: FloatArray
    """The same for gain, rotation and displacement of the reference; shape (rows, 6, 6)."""
    accuracy: FloatArray
    """Standard deviation of the slow error of the reference, in these units; shape (rows,)."""

    def prior_sizes(self, assumptions: Assumptions, usual: float) -> FloatArray:
        """Give the sizes of the errors of the prior matrix.

        Args:
            assumptions: What is known of the sensor.
            usual: Size where nobody states one.

        Returns:
            What `sensor_root` of every row is to be multiplied by; shape (rows,).
        """
        return np.full(len(self.unit), usual) if assumptions.prior_size is None else assumptions.prior_size


def rows_of(matrix: FloatArray, assumptions: Assumptions, *, in_wrench: bool) -> Rows:
    """Choose the rows.

    Args:
        matrix: Prior matrix; without a prior one that reads the data roughly, for the sizes; shape (6, c).
        assumptions: What is known beside it.
        in_wrench: Whether the rows of six channels are components of the wrench.

    Returns:
        The rows.
    """
    scaled = matrix * assumptions.full_scale  # N, N m per full scale of a channel
    response = np.asarray(np.linalg.pinv(scaled), dtype=np.float64)
    channels = len(response)
    size = np.sqrt((scaled**2).mean(axis=1))
    accuracy = assumptions.reference_accuracy(matrix)
    spread = sensor_root(response)
    if assumptions.load_full_scale is not None:
        disturbances = np.diag(~measured_components(matrix) / assumptions.load_full_scale)
        spread = sensor_root(np.vstack([response, disturbances]))
    if channels == LOADS and in_wrench and size.all():
        return Rows(
            space="wrench",
            unit=size,
            group=np.repeat([0, 1], 3),
            from_raw=matrix / size[:, None],
            from_load=np.diag(1.0 / size),
            load_to_full_scale=response,
            sensor_root=np.stack([spread] * LOADS),
            frame_root=FRAME_ROOTS / size[:, None, None],
            accuracy=accuracy / size,
        )
    _, strengths, directions = np.linalg.svd(response, full_matrices=False)
    readings = np.zeros((LOADS, LOADS))
    readings[: len(strengths)] = np.sqrt(LOADS / channels) * strengths[:, None] * directions
    squares = np.einsum("ji,iab->jab", response**2, FRAME_ROOTS @ FRAME_ROOTS)
    return Rows(
        space="channel",
        unit=np.array(assumptions.full_scale),
        group=np.zeros(channels, dtype=np.int64),
        from_raw=np.diag(1.0 / assumptions.full_scale),
        from_load=response,
        load_to_full_scale=readings,
        sensor_root=np.stack([spread / np.sqrt(channels)] * channels),
        frame_root=np.sqrt(squares),
        accuracy=_channel_accuracy(response, accuracy, assumptions),
    )


def _channel_accuracy(response: FloatArray, accuracy: FloatArray, assumptions: Assumptions) -> FloatArray:
    if assumptions.accuracy is None:
        return np.full(len(response), ACCURACY_SHARE)
    return np.sqrt(response**2 @ accuracy**2)


def sensor_root(response: FloatArray) -> FloatArray:
    """Give L, with L L^T the covariance of the six coefficients of a row that is off by as much as it is large.

    Args:
        response: Shares of full scale that loads make of the channels; shape (c, 6).

    Returns:
        L; shape (6, 6).
    """
    vectors, values, _ = np.linalg.svd(response.T @ response)
    return vectors * np.sqrt(values)
