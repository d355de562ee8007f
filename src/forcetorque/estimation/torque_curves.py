# SPDX-License-Identifier: BSD-3-Clause
"""What a figure of joint torques is drawn of: torques over time by source, and how far they may be off."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.estimation.estimate import IntervalEstimates
from forcetorque.estimation.torque.fusion import FUSED, IntervalFusion
from forcetorque.experiment.experiment import Experiment
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot.model import JointType
from forcetorque.skin.experiment import force_patches

MOST_JOINTS: Final = 6
"""Joints that have room in one figure."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Piece:
    """Torques of one interval."""

    stamp_ns: IntArray
    joints: tuple[str, ...]
    told: Mapping[str, tuple[FloatArray, FloatArray | None]]
    """Torques and their standard deviations by source; shape (n, joints) each; N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorquePicture:
    """Torques of some joints over all intervals, one after the other; NaN between two, and where a source is silent."""

    seconds: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    joints: tuple[str, ...]
    """Rotary joints whose torque changes most, at most `MOST_JOINTS`."""
    torques: Mapping[str, FloatArray]
    """Torques by source; shape (n, joints) each; N m."""
    deviations: Mapping[str, FloatArray]
    """Standard deviations of those that have any; shape (n, joints) each; N m."""
    left_out: tuple[str, ...]
    """Other rotary joints."""


def torque_picture(
    experiment: Experiment, spans: Sequence[IntervalEstimates] = (), fusions: Sequence[IntervalFusion] = ()
) -> TorquePicture:
    """Put torques of all intervals beside each other, by source where they were fused.

    Args:
        experiment: The experiment.
        spans: Its estimates, as `estimate_experiment` gives them; needed where there are no fusions.
        fusions: Its fusions, as `fuse_experiment` gives them.

    Returns:
        What is drawn.

    Raises:
        ExperimentError: If no torque of a rotary joint is known.
    """
    several = [_of_fusion(one) for one in fusions] or [_of_estimates(experiment, span) for span in spans]
    pieces = sorted((piece for piece in several if len(piece.stamp_ns)), key=lambda piece: int(piece.stamp_ns[0]))
    rotary = [
        joint
        for joint in dict.fromkeys(joint for piece in pieces for joint in piece.joints)
        if experiment.model.joints[joint].type is not JointType.PRISMATIC
    ]
    sources = dict.fromkeys(source for piece in pieces for source in piece.told)
    torques = {source: _joined(pieces, rotary, source, 0) for source in sources}
    changes = {joint: _change([values[:, k] for values in torques.values()]) for k, joint in enumerate(rotary)}
    known = [joint for joint in rotary if np.isfinite(changes[joint])]
    if not known:
        raise ExperimentError(
            f"experiment {experiment.name!r}: expected the torque of a rotary joint to draw, got none; warnings of "
            "`forcetorque estimate` say what the log lacks"
        )
    most = sorted(known, key=changes.__getitem__)[-MOST_JOINTS:]
    drawn = [joint for joint in rotary if joint in most]
    deviations = {source: _joined(pieces, drawn, source, 1) for source in sources}
    stamps = np.concatenate([np.append(piece.stamp_ns, piece.stamp_ns[-1]) for piece in pieces])
    return TorquePicture(
        seconds=seconds_since(stamps, experiment.recording.start_ns),
        joints=tuple(drawn),
        torques={source: _joined(pieces, drawn, source, 0) for source in sources},
        deviations={source: values for source, values in deviations.items() if np.isfinite(values).any()},
        left_out=tuple(joint for joint in known if joint not in drawn),
    )


def _of_fusion(one: IntervalFusion) -> _Piece:
    told = {source.name: (source.torque, _deviation(source.covariance)) for source in one.sources}
    told[FUSED] = (one.fusion.torque, _deviation(one.fusion.covariance))
    return _Piece(stamp_ns=one.fusion.stamp_ns, joints=one.fusion.joints, told=told)


def _of_estimates(experiment: Experiment, span: IntervalEstimates) -> _Piece:
    there = {"sensors": experiment.sensors, "skin": force_patches(experiment)}
    name = " and ".join(what for what, some in there.items() if some)
    deviation = None if span.uncertain is None else span.uncertain.torque_sd
    told = {name: (span.estimates.torques, deviation)}
    return _Piece(stamp_ns=span.stamp_ns, joints=span.estimates.layout.joints, told=told)


def _deviation(covariance: FloatArray) -> FloatArray:
    return np.sqrt(np.einsum("njj->nj", covariance))


def _joined(pieces: Sequence[_Piece], joints: Sequence[str], source: str, which: int) -> FloatArray:
    """Torques (0) or deviations (1) of a source over all intervals, with a gap after each; shape (n, joints); N m."""
    blocks = []
    for piece in pieces:
        block = np.full((len(piece.stamp_ns) + 1, len(joints)), np.nan)
        values = piece.told[source][which] if source in piece.told else None
        for column, joint in enumerate(joints):
            if values is not None and joint in piece.joints:
                block[:-1, column] = values[:, piece.joints.index(joint)]
        blocks.append(block)
    return np.concatenate(blocks)


def _change(several: Sequence[FloatArray]) -> float:
    """Largest standard deviation over time of any source; NaN where none knows the torque."""
    return max((float(np.nanstd(values)) for values in several if np.isfinite(values).any()), default=np.nan)
