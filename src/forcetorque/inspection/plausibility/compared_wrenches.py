# SPDX-License-Identifier: BSD-3-Clause
"""Measured and expected wrenches that plausibility checks compare, from a robot or a workbench."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Literal, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, require_shape
from forcetorque.experiment.calibration.moments import DataSet, Moments, symmetric_pseudo_inverse
from forcetorque.robot.motion import CHECK_JOINT_UNIT

_SHARED = 0.5
"""Share of the movement of the reference that neighbouring samples have in common, below which white noise cannot be
told from the rest.

Of a motion that is sampled as a sensor is they share nearly all; of poses in any order, a row for each, nothing.
"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Movement(ArrayRecord):
    """Second moments of k columns of reading and six of reference about the mean of each data set.

    What the linear variables and a slow drift explain is taken out, in each data set by itself, as its offset is.
    """

    count: int
    """Number of samples."""
    second: FloatArray = field(metadata=array("width", "width"))
    """Mean products of reading and reference; shape (k + 6, k + 6)."""
    lasting: FloatArray = field(metadata=array("width", "width"))
    """The same of what neighbouring samples share: white noise is not in it; shape (k + 6, k + 6).

    All of `second` where the reference itself differs from sample to sample, as in a table of poses.
    """
    size: FloatArray = field(metadata=array(6))
    """Root mean square of the reference, its mean included; shape (6,); N, N m."""

    def __post_init__(self) -> None:
        check_arrays(self)
        # the two axes of one array are not compared with each other there
        require_shape(self.second, name="second", shape=(len(self.second), len(self.second)))

    @classmethod
    def of(cls, data_sets: Sequence[DataSet], prior: FloatArray | None) -> Self:
        """Reduce data sets.

        Args:
            data_sets: Data sets of at least two samples each.
            prior: Matrix that makes a wrench of the raw reading; shape (6, c); None to take the channels as they are.

        Returns:
            The movement; its reading is a wrench if there is a prior, else raw counts.
        """
        channels = data_sets[0].raw.shape[1]
        reading = np.eye(channels) if prior is None else prior
        turn = np.zeros((len(reading) + 6, channels + 6))
        turn[: len(reading), :channels], turn[len(reading) :, channels:] = reading, np.eye(6)
        counts = np.array([len(data.raw) for data in data_sets])
        share = counts / counts.sum()
        second = turn @ np.tensordot(share, [_second(*_columns(data)) for data in data_sets], 1) @ turn.T
        # the mean of two neighbours holds half of the white noise, and all of what both share
        halved = turn @ np.tensordot(share, [_second(*map(_paired, _columns(data))) for data in data_sets], 1) @ turn.T
        square = np.tensordot(share, [(data.reference**2).mean(axis=0) for data in data_sets], 1)
        shared = 2.0 * halved - second
        lasting = shared if _lasts(shared, second, square) else second
        return cls(count=int(counts.sum()), second=second, lasting=lasting, size=np.sqrt(square))

    @property
    def columns(self) -> int:
        """Number k of columns of the reading."""
        return len(self.second) - 6

    @property
    def follows(self) -> FloatArray:
        """Matrix by which the reading follows the reference, by least squares; shape (k, 6)."""
        k = self.columns
        return self.second[:k, k:] @ symmetric_pseudo_inverse(self.second[k:, k:])

    def left(self, second: FloatArray) -> FloatArray:
        """Take out of the reading what follows the reference.

        Args:
            second: `second` or `lasting`; shape (k + 6, k + 6).

        Returns:
            Mean square of the rest of every column; shape (k,).
        """
        rest = np.hstack([np.eye(self.columns), -self.follows])
        return np.maximum(np.einsum("ij,jk,ik->i", rest, second, rest), 0.0)


def _lasts(shared: FloatArray, second: FloatArray, square: FloatArray) -> bool:
    """Whether neighbouring samples have the same load: components of the reference count by how much they move."""
    worth = np.divide(1.0, square, out=np.zeros(6), where=square > 0.0)
    return bool(worth @ np.diag(shared)[-6:] >= _SHARED * (worth @ np.diag(second)[-6:]))


def _columns(data: DataSet) -> tuple[FloatArray, FloatArray, FloatArray]:
    along = np.linspace(-1.0, 1.0, len(data.raw))[:, None]
    return data.raw, data.reference, np.hstack([data.variables, along, along**2])


def _paired(values: FloatArray) -> FloatArray:
    return 0.5 * (values[1:] + values[:-1])


def _second(raw: Any, reference: Any, variables: Any) -> FloatArray:
    return Moments.of(raw, reference, variables).without_variables().second


DoubtKind = Literal["span", "scale", "axis", "delay"]
"""What is doubtful: whether the reading follows the reference at all, by how much in all or in one axis, or when."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Doubt:
    """A reason not to trust whatever is fitted to some data."""

    kind: DoubtKind
    """What is doubtful: that the reading follows the reference at all, by how much in all or in one axis, or when."""
    message: str
    """What was seen, its likely cause, and what to change."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Setup:
    """Limits and messages that differ between setups."""

    doubtful_gain: float
    """Change of the gain from that of the prior from which on there is a doubt."""
    doubtful_axis: float | None
    """Gain of one component over the median of all six, up or down, from which on there is a doubt; None for none."""
    gain_causes: tuple[tuple[float, float, str], ...]
    """What gains between two limits point to; small ones are known to some hundredths only."""
    joints_move_too_little: bool
    """Whether a large gain may be that of joints whose degrees were read as radians."""
    check_gain: str
    """Where to look if the gain is wrong."""
    check_sign: str
    """Where to look if the whole reading runs against the loads."""
    check_axes: str
    """Where to look if single axes do."""
    check_moment: str
    """Where to look if moments alone are too small."""
    check_span: str
    """Where to look if the reading does not follow the loads."""
    give_mass: str
    """What to do without any load."""
    move_load: str
    """What to do about a load that stands still, with what it is likely to be."""


ROBOT: Final = Setup(
    doubtful_gain=0.1,  # mounted sensors stay below
    doubtful_axis=None,  # errors of the robot model differ from axis to axis too
    gain_causes=(
        (300.0, 3000.0, "are masses 1000 times too small, or the prior in N per 1000 counts?"),
        (7.0, 14.0, "is the prior in kgf instead of N?"),
        (1.5, 2.6, "does the model have half of the true mass?"),
        (0.4, 0.65, "does the model have twice the true mass?"),
        (0.07, 0.14, "are weights given instead of masses?"),
        (-0.1, 0.02, "are the masses in grams instead of kg?"),
    ),
    joints_move_too_little=True,
    check_gain="check the mass of the links beyond the sensor in the file that urdf of [robot] names, or mass_kg of "
    "[load], and whether prior of [[sensor]] is its own, at the amplifier gains of the recording",
    check_sign="is gravity_direction of [[support]] the direction in which things fall, and measure_direction of "
    "[[sensor]], [load] or the URDF's sensor tag the right way round?",
    check_axes="is gravity_direction of [[support]] given in the axes of its frame, the sensor's frame in the URDF "
    "turned as the sensor is, and prior of [[sensor]] its own?",
    check_moment="are moments logged in N m and stated in another unit? check units of [[recording.stream]], and prior "
    "of [[sensor]]",
    check_span=f"{CHECK_JOINT_UNIT}, frame and gravity_direction of [[support]], and whether stream of [[sensor]] is "
    "its own; a load that is lighter than the sensor's drift needs a heavier one beside it",
    give_mass="so the model has no mass beyond the sensor; give the links of the tool their mass in the file that urdf "
    "of [robot] names, or mass_kg of [load]",
    move_load="as of a limb that stands still; in the experiment file set start_s and end_s of every [[interval]] with "
    'use = "calibration" to where the limb moves, among arrays calibrate',
)
"""A sensor in a robot, whose loads are those of a model."""

WORKBENCH: Final = Setup(
    doubtful_gain=0.5,  # sensors of one type are .7 to 1.4 times their nominal matrix
    doubtful_axis=1.25,  # .92 to 1.09 in 180 simulated sensors of three types
    gain_causes=(
        (300.0, 3000.0, "is the prior in N per 1000 counts, or are masses in t or forces in kN?"),
        (7.0, 14.0, "is the prior in kgf instead of N, or are forces in kgf?"),
        (0.07, 0.14, "are weights in N given as masses in kg?"),
        (-0.1, 0.02, "are the masses in grams instead of kg?"),
    ),
    joints_move_too_little=False,
    check_gain="check the masses or the units of the known wrenches of the loads, and whether prior of [sensor] is of "
    "this type of sensor, at the amplifier gains of the recording; without prior, loads in all six directions "
    "determine the matrix",
    check_sign="is measure_direction of [sensor] the right way round, and prior of [sensor] in the same sense?",
    check_axes="are the directions of the loads given in the axes of the sensor, and is prior of [sensor] of this type "
    "of sensor?",
    check_moment="check the units of moments, or of the positions of weights, in the loads, and prior of [sensor]",
    check_span="check that the readings are in the order of the loads, files and channels of [measurements], and "
    "whether prior of [sensor] is of this type of sensor",
    give_mass="so nothing hangs on the sensor; give the loads their masses, or their wrenches",
    move_load="as of one load; record other loads",
)
"""A sensor on a workbench, under loads that were weighed."""
