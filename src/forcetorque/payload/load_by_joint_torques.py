# SPDX-License-Identifier: BSD-3-Clause
"""The load of an arm by its joint torques at rest, where no wrench was logged.

    torque = unit_torque [m; m c] + bias + error,    in posture k and joint j

Each joint has a bias and a variance of its own. Errors of one posture, of which the noise of samples is the least part,
are one row: a posture counts once, however long and often it is held.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.arm_log import FLANGE, UNKNOWNS, LoggedTorques
from forcetorque.payload.export.load_parameters import RobotLoad
from forcetorque.payload.load_warnings import overruled, torque_doubt
from forcetorque.payload.result import ArmLog, LoadRow, load_words
from forcetorque.results.number_text import plus_minus
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, table_of

_SAME_RAD = 0.02
"""Largest difference of angles of samples in one posture; rad (heuristic)."""
_FEWEST = 4
"""Postures that leave something to estimate an error from."""
_DEPENDENT = 1e-3
"""Share of the torques of an unknown by which they change over the postures, below which it is open (heuristic)."""
_ROUNDS = 50
"""Steps of the variances of joints, which settle in some ten."""
_POOLED = 1.0
"""Postures that the variance over all joints counts for in that of each, so that none of few postures is taken for
exact."""
_SMALLEST = 1e-9
"""Share of the largest torque that an error of a joint is at least, which keeps weights finite."""
_BETTER = 0.7
"""Share of the residual that is left where logs hold several loads (heuristic)."""
_RARE = 1e-3
"""Probability of a better fit by a load of each log where they hold one, below which they seem to hold several."""
_UPPER = 0.975
"""Probability below the upper end of a 95 % interval."""


class JointTorqueRow(Row):
    """A joint."""

    joint: Annotated[str, Shown("joint")]
    """Its name."""
    bias_Nm: Annotated[float, Shown("bias", "N m", digits=3)]
    """Torque that is logged without a load."""
    residual_rms_Nm: Annotated[float, Shown("left over", "N m", digits=4)]
    """Root mean square of what load and bias leave."""


class TorqueLoad(DrawnResult):
    """What an arm holds beyond its flange, by its joint torques."""

    drawn_by: ClassVar[str] = "forcetorque.payload.figures:load_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("loads",)

    answered_by: ClassVar[str | None] = "forcetorque.payload.answers:torque_answers"
    of_several: ClassVar[tuple[str, ...]] = ("arms",)

    schema_name: Literal["forcetorque/payload_by_torques/1"] = Field(
        default="forcetorque/payload_by_torques/1", alias="schema"
    )
    """Form of the result."""
    experiment: str
    """Names of the logs."""
    load: LoadRow
    """Mass and centre of mass, along the axes of the flange from its origin."""
    joints: tuple[JointTorqueRow, ...]
    """Bias of each joint."""
    postures: int
    """Postures at rest."""
    samples: int
    """Samples in them."""
    arms: tuple[ArmLog, ...]
    """The logs."""
    robot_file: str | None = Field(default=None, exclude=True, repr=False)
    """File for a robot that was written; None for none."""

    @property
    def loads(self) -> tuple[LoadRow, ...]:
        """The load, as of a sensor there may be several."""
        return (self.load,)

    def blocks(self) -> Iterator[Table | str]:
        """Give the load, then the joints.

        Yields:
            A sentence and a table.
        """
        yield f"{self.postures} postures, {self.samples} samples: {load_words(self.load)}"
        yield table_of(self.joints, "torque that is logged without a load, and what load and bias leave")

    def records(self) -> list[dict[str, object]]:
        """Give a line for every joint.

        Returns:
            The lines: the load beside a joint.
        """
        return [self.load.flat() | joint.flat() for joint in self.joints]

    def robot_load(self, *, override: str | None = None) -> RobotLoad:
        """Give the load to write it for a robot.

        Args:
            override: Reason to tell of a doubtful load, which is written with it; refused if None.

        Returns:
            The load in the frame of the flange.

        Raises:
            ExperimentError: If the load is doubtful, without a reason.
        """
        sensor = "joint torques"
        note = overruled(torque_doubt(self.load), override, where=f"load by {sensor}")
        return RobotLoad(
            sensor=sensor,
            frame=FLANGE,
            direction=MeasureDirection.PARENT_TO_CHILD,
            mass=float(self.load.mass_kg or 0.0),
            centre_of_mass=np.array(self.load.centre_of_mass_m, dtype=np.float64),
            bias=np.zeros(6),
            override=note,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Stays:
    """Means over the samples of each stay in a posture."""

    position: FloatArray
    """Angles; shape (k, d); rad."""
    torque: FloatArray
    """Declared load included; shape (k, d); N m."""
    unit_torque: FloatArray
    """Shape (k, d, 4)."""
    samples: int
    """Number of all samples."""


def load_of_torques(logs: Sequence[LoggedTorques], arms: Sequence[ArmLog], names: str) -> TorqueLoad:
    """Estimate the load that arms hold, whose joints have the same biases.

    Args:
        logs: Logs of one arm with one load and in one power cycle.
        arms: What they are of, for the result.
        names: Names of the logs.

    Returns:
        The load with intervals.

    Raises:
        FitError: If there are too few postures, they leave something open, or the mass is not above zero.
    """
    parts = [_postures(_stays(log)) for log in logs]
    together = _postures(*parts)
    torque, unit_torque = together.torque, together.unit_torque
    _require_postures(unit_torque, names)
    values, covariance, deviation = _fit(torque, unit_torque)
    half_width = _quantile(len(torque) - 1) * np.sqrt(np.diagonal(covariance))
    mass, moment = values[0], values[1:]
    if half_width[0] > abs(mass):
        raise FitError(
            f"{names}: expected postures that determine the mass, got {len(torque)} that leave it at "
            f"{plus_minus(float(mass), float(half_width[0]), 'kg')}; hold the arm still in more that turn the wrist; "
            "or nothing is fastened to it beyond what the controller knows"
        )
    if mass < 0.0:
        raise FitError(
            f"{names}: expected a mass above 0 kg, got {plus_minus(float(mass), float(half_width[0]), 'kg')}: "
            "tau_ext_hat_filtered has the reversed sign, or the declared load is larger than the one that hangs there"
        )
    centre = moment / mass
    # c = h / m, of which the derivatives by m and h are -c / m and 1 / m
    slope = np.column_stack([-centre, np.eye(3)]) / mass
    centre_half = _quantile(len(torque) - 1) * np.sqrt(np.diagonal(slope @ covariance @ slope.T))
    residual = torque - unit_torque @ values
    bias = residual.mean(axis=0)
    return TorqueLoad(
        experiment=names,
        load=LoadRow(
            load="load",
            estimated=True,
            mass_kg=float(mass),
            mass_half_width_95_kg=float(half_width[0]),
            centre_of_mass_m=tuple(centre.tolist()),
            centre_of_mass_half_width_95_m=tuple(centre_half.tolist()),
            inertia_kgm2=None,
            inertia_half_width_95_kgm2=None,
        ),
        joints=tuple(
            JointTorqueRow(joint=name, bias_Nm=float(own), residual_rms_Nm=float(left))
            for name, own, left in zip(logs[0].joints, bias, deviation, strict=True)
        ),
        postures=len(torque),
        samples=together.samples,
        arms=tuple(arms),
        warnings=tuple(_loads_differ(parts, deviation)),
    )


def _stays(log: LoggedTorques) -> _Stays:
    known = np.column_stack([log.declared_mass, log.declared_mass[:, None] * log.declared_centre])
    torque = log.torque + np.einsum("nda,na->nd", log.unit_torque, known)
    still = np.flatnonzero(log.is_still)
    number = _stay_numbers(still, log.position)
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    counts = np.diff(starts, append=len(still))

    def means(values: FloatArray) -> FloatArray:
        sums = np.add.reduceat(values[still], starts, axis=0) if len(starts) else values[:0]
        return sums / counts.reshape(-1, *(1,) * (values.ndim - 1))

    return _Stays(
        position=means(log.position), torque=means(torque), unit_torque=means(log.unit_torque), samples=len(still)
    )


def _stay_numbers(still: IntArray, position: FloatArray) -> IntArray:
    """Number of the stay of each sample at rest; what moves to another posture and is not logged ends one too."""
    if not len(still):
        return still
    jumps = (np.diff(still) > 1) | (np.abs(np.diff(position[still], axis=0)).max(axis=1) > _SAME_RAD)
    starts = np.flatnonzero(np.concatenate([[True], jumps]))
    first = position[still[starts]]
    is_another = np.concatenate([[False], np.abs(np.diff(first, axis=0)).max(axis=1) > _SAME_RAD])
    return np.repeat(np.cumsum(is_another), np.diff(starts, append=len(still)))


def _postures(*parts: _Stays) -> _Stays:
    """Means over the stays in each posture; one that the arm takes again, in any part, is the same."""
    position = np.concatenate([part.position for part in parts])
    first = [int(np.argmax(np.abs(position - own).max(axis=1) <= _SAME_RAD)) for own in position]
    number = np.array(first, dtype=np.int64)

    def means(name: str) -> FloatArray:
        values = np.concatenate([getattr(part, name) for part in parts])
        rows = [values[number == posture].mean(axis=0) for posture in np.unique(number)]
        return np.array(rows) if rows else values

    return _Stays(
        position=means("position"),
        torque=means("torque"),
        unit_torque=means("unit_torque"),
        samples=sum(part.samples for part in parts),
    )


def _loads_differ(parts: Sequence[_Stays], deviation: FloatArray) -> Iterator[str]:
    """Say that logs hold several loads, where the torques go clearly better with one of each; deviations (d,)."""
    from scipy.special import fdtrc  # here because importing it takes longer than most commands

    if len(parts) < 2:
        return
    weighted = np.concatenate([part.unit_torque for part in parts]) / deviation[:, None]
    log = np.repeat(np.arange(len(parts)), [len(part.torque) for part in parts])
    own = np.concatenate([weighted * (log == k)[:, None, None] for k in range(len(parts))], axis=2)
    torque = np.concatenate([part.torque for part in parts]) / deviation
    (one, few), (several, many) = (_left(torque, design) for design in (weighted, own))
    freedom = torque.size - torque.shape[1] - many
    if many <= few or freedom <= 0:
        return
    ratio = (one - several) / (many - few) / max(several / freedom, np.finfo(float).tiny)
    left = float(np.sqrt(several / one)) if one else 1.0
    if left < _BETTER and fdtrc(many - few, freedom, ratio) < _RARE:
        yield (
            "the logs seem to hold different loads, weigh each by itself: a load of each log leaves "
            f"{100 * left:.0f} % of the residual"
        )


def _left(torque: FloatArray, design: FloatArray) -> tuple[float, int]:
    """Sum of squares that unknowns and a bias of each joint leave, and the number of unknowns that are determined."""
    y, columns = torque - torque.mean(axis=0), design - design.mean(axis=0)
    flat = columns.reshape(-1, columns.shape[2])
    values, _, rank, _ = np.linalg.lstsq(flat, y.ravel(), rcond=None)
    return float(((y.ravel() - flat @ values) ** 2).sum()), int(rank)


def postures_words(log: LoggedTorques) -> str:
    """Count the postures at rest of a log, where they are too few by themselves.

    Returns:
        A phrase.
    """
    count = len(_postures(_stays(log)).torque)
    few = "" if count >= _FEWEST else f", too few without another log: at least {_FEWEST} are needed"
    return f"it has {count} posture{'s' * (count != 1)} at rest{few}"


def _require_postures(unit_torque: FloatArray, names: str) -> None:
    if len(unit_torque) < _FEWEST:
        raise FitError(
            f"{names}: expected at least {_FEWEST} postures at rest, by which errors of joint torques are separable "
            f"from the load, got {len(unit_torque)}; hold the arm still in eight or more that turn the wrist"
        )
    centred = (unit_torque - unit_torque.mean(axis=0)).reshape(-1, len(UNKNOWNS))
    _, singular, rows = np.linalg.svd(centred / np.linalg.norm(unit_torque, axis=(0, 1)), full_matrices=False)
    open_rows = rows[singular < _DEPENDENT]
    if len(open_rows):
        lacking = [name for name, share in zip(UNKNOWNS, np.abs(open_rows).max(axis=0), strict=True) if share > 0.1]
        raise FitError(
            f"{names}: expected postures that determine the load, got {len(unit_torque)} that leave open "
            f"{', '.join(lacking)}; record some that turn the wrist about other horizontal axes"
        )


def _fit(torque: FloatArray, unit_torque: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Mass and first moment, shape (4,); their covariance; and the deviation of each joint, shape (d,)."""
    count = len(torque)
    y, design = torque - torque.mean(axis=0), unit_torque - unit_torque.mean(axis=0)
    least = _SMALLEST * max(float(np.abs(torque).max()), 1.0)
    values, deviation = np.zeros(len(UNKNOWNS)), np.ones(torque.shape[1])
    for _ in range(_ROUNDS):
        weighted = design / deviation[:, None]
        covariance = np.linalg.inv(np.einsum("nda,ndb->ab", weighted, weighted))
        values = covariance @ np.einsum("nda,nd->a", weighted, y / deviation)
        # what a joint contributes to the load it cannot say of its own error
        used = np.einsum("nda,ab,ndb->d", weighted, covariance, weighted)
        freedom = count - 1 - used
        squares = ((y - design @ values) ** 2).sum(axis=0)
        pooled = squares.sum() / freedom.sum()
        deviation = np.maximum(np.sqrt((squares + _POOLED * pooled) / (freedom + _POOLED)), least)
    weighted = design / deviation[:, None]
    return values, np.linalg.inv(np.einsum("nda,ndb->ab", weighted, weighted)), deviation


def _quantile(freedom: int) -> float:
    from scipy.special import stdtrit  # here because importing it takes longer than most commands

    return float(stdtrit(freedom, _UPPER))
