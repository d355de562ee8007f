# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of all sources of an experiment beside each other and fused, conflicts, and curves to draw."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Final, Literal

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.units import NORMAL_95
from forcetorque.estimation.estimate import IntervalEstimates
from forcetorque.estimation.section import FUSION
from forcetorque.estimation.torque.covariance_fusion import Fusion, fuse
from forcetorque.estimation.torque.experiment_sources import TorqueSources
from forcetorque.estimation.torque.motor_torque import Friction
from forcetorque.estimation.torque.torque_source import TorqueSource
from forcetorque.experiment.experiment import Experiment, ExperimentContact
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval, Use
from forcetorque.results.table import Row, Shown, Table, optional_table, table_of
from forcetorque.robot.model import JointType, RobotModel
from forcetorque.skin.section import force_patches
from forcetorque.skin.wrench.skin_wrench import PatchFrames

FUSED = "fused"
"""Name of all sources together."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalFusion:
    """Sources and their fusion over one interval."""

    interval: Interval
    """The interval."""
    sources: tuple[TorqueSource, ...]
    """The sources."""
    fusion: Fusion
    """All of them together."""

    def columns(self) -> Iterator[tuple[str, FloatArray]]:
        """Give what every source says, and all together with half of the 95 % interval, for a table of samples.

        Yields:
            Names such as `ft` and torques; shape (n, j).
        """
        for source in self.sources:
            yield source.name, source.torque
        yield FUSED, self.fusion.torque
        yield f"{FUSED}_half_width", self.fusion.half_width


class JointTorqueRow(Row):
    """The torque of one joint by one source over one interval."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    joint: Annotated[str, Shown("joint")]
    """The joint."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Unit of its torque."""
    source: Annotated[str, Shown("source")]
    """A source, or `fused`."""
    samples: Annotated[int, Shown("samples")]
    """Samples in which it says something."""
    mean: Annotated[float | None, Shown("mean", digits=3)]
    """Mean torque over these samples."""
    half_width_95: Annotated[float | None, Shown("± of a sample", digits=3)]
    """Half of the 95 % interval of one sample, the root mean square of all."""
    from_fused: Annotated[float | None, Shown("from fused", digits=3)]
    """Root mean square of its difference from the fused torque."""


class SourceRow(Row):
    """What one source has against the others over one interval."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    source: Annotated[str, Shown("source")]
    """The source."""
    innovation: Annotated[float, Shown("innovation^2", digits=2)]
    """Mean squared normalised innovation against the others together: about 1 if all is as specified."""
    degrees_of_freedom: int
    """Number of innovations."""
    windows_percent: Annotated[float, Shown("windows", "%", digits=1)]
    """Share of windows in which it alone is in conflict."""
    verdict: Annotated[Literal["used", "in conflict, left out", "suspected"], Shown("verdict")]
    """`in conflict` if the others agree without it alone; `suspected` if they do without another one too, so that all
    are used, in wider intervals."""


class FrictionRow(Row):
    """Friction of one joint, as fitted where the force-torque sensors are trusted."""

    joint: Annotated[str, Shown("joint")]
    """The joint."""
    coulomb: Annotated[float, Shown("Coulomb", digits=3, error="coulomb_half_width_95")]
    """Coulomb friction; N m, N where prismatic."""
    coulomb_half_width_95: float
    """Half of its 95 % interval."""
    viscous: Annotated[float, Shown("viscous", digits=3, error="viscous_half_width_95")]
    """Viscous friction; N m s/rad, N s/m."""
    viscous_half_width_95: float
    """Half of its 95 % interval."""
    inertia: Annotated[float, Shown("inertia", digits=3)]
    """Inertia of the rotor, seen from the joint; kg m2, kg."""
    offset: Annotated[float, Shown("offset", digits=3)]
    """Offset of the motor's reading, seen from the joint; N m, N."""
    deviation: Annotated[float, Shown("left", digits=3)]
    """Standard deviation of what friction leaves unexplained in a sample; N m, N."""


class TorqueFusion(Row):
    """Joint torques of all sources beside each other and fused."""

    false_alarm: float
    """Largest rate of intervals, or windows, with a conflict though all is as specified."""
    torques: tuple[JointTorqueRow, ...]
    """One per interval, joint and source, and one for all together."""
    sources: tuple[SourceRow, ...]
    """One per interval and source."""
    friction: tuple[FrictionRow, ...]
    """One per joint with a motor."""

    def blocks(self) -> Iterator[Table | str]:
        """Give tables of torques, sources and friction.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.torques, "joint torques")
        yield table_of(self.sources, "sources of joint torques")
        yield (
            f"where all variances are as specified, at most {self.false_alarm:.1%} of intervals, and of windows, have "
            "a conflict"
        )
        yield from optional_table(self.friction, "friction, fitted on the calibration intervals")

    def warnings(self) -> Iterator[str]:
        """Give warnings about sources in conflict.

        Yields:
            Sentences.
        """
        for row in self.sources:
            if row.verdict != "used":
                yield f"{row.interval}: source {row.source} is {row.verdict}"


def fuse_experiment(
    experiment: Experiment,
    corrections: Mapping[str, Correction],
    *,
    contacts: Sequence[ExperimentContact] | None = None,
    patches: Sequence[PatchFrames] | None = None,
) -> tuple[list[IntervalFusion], tuple[Friction, ...]]:
    """Fuse the joint torques of all sources over every interval that is not to be ignored.

    Args:
        experiment: The experiment, with `[fusion]`.
        corrections: How its sensors are read (`corrections_of`).
        contacts: Contacts in place of the experiment's.
        patches: What its patches say (`frames_of_patches`); they are read if None.

    Returns:
        Fusions in the order of the intervals, and the friction of the motors.

    Raises:
        ExperimentError: If the file lacks what a source needs, or there is only one source.
    """
    analysed = experiment if contacts is None else replace(experiment, contacts=tuple(contacts))
    sources = TorqueSources(analysed, corrections, patches)
    fusions = []
    for interval in experiment.recording.intervals:
        if interval.use is Use.IGNORE:
            continue
        with stated_in(f"interval {interval.label!r}"):
            several = sources.over(interval)
            table = sources.table
            fusion = fuse(several, false_alarm=table.false_alarm, window_s=table.window_s)
        fusions.append(IntervalFusion(interval=interval, sources=tuple(several), fusion=fusion))
    return fusions, sources.frictions


def summarise_fusion(
    experiment: Experiment, fusions: list[IntervalFusion], frictions: tuple[Friction, ...]
) -> TorqueFusion:
    """Summarise fused torques.

    Args:
        experiment: The experiment.
        fusions: As `fuse_experiment` gives them.
        frictions: Likewise.

    Returns:
        Tables.
    """
    return TorqueFusion(
        false_alarm=0.0 if (fusion := experiment.section(FUSION)) is None else fusion.false_alarm,
        torques=tuple(row for one in fusions for row in _torques(one, experiment.model)),
        sources=tuple(row for one in fusions for row in _sources(one)),
        friction=tuple(_friction(one) for one in frictions),
    )


def _torques(one: IntervalFusion, model: RobotModel) -> Iterator[JointTorqueRow]:
    torques = {source.name: (source.torque, source.covariance) for source in one.sources}
    torques[FUSED] = (one.fusion.torque, one.fusion.covariance)
    for k, joint in enumerate(one.fusion.joints):
        for name, (torque, covariance) in torques.items():
            known = np.isfinite(torque[:, k])
            apart = torque[:, k] - one.fusion.torque[:, k]
            yield JointTorqueRow(
                interval=one.interval.label,
                joint=joint,
                unit="N" if model.joints[joint].type is JointType.PRISMATIC else "N m",
                source=name,
                samples=int(np.count_nonzero(known)),
                mean=float(torque[known, k].mean()) if known.any() else None,
                half_width_95=NORMAL_95 * float(np.sqrt(covariance[known, k, k].mean())) if known.any() else None,
                from_fused=_root_mean_square(apart),
            )


def _root_mean_square(values: FloatArray) -> float | None:
    known = values[np.isfinite(values)]
    return float(np.sqrt((known**2).mean())) if len(known) else None


def _sources(one: IntervalFusion) -> Iterator[SourceRow]:
    conflict = one.fusion.conflict
    for source in one.sources:
        innovation = conflict.innovation(source.name)
        verdict: Literal["used", "in conflict, left out", "suspected"] = "used"
        if source.name in conflict.suspects or (conflict.is_there and not conflict.suspects):
            verdict = "in conflict, left out" if conflict.source == source.name else "suspected"
        yield SourceRow(
            interval=one.interval.label,
            source=source.name,
            innovation=innovation.ratio,
            degrees_of_freedom=innovation.degrees_of_freedom,
            windows_percent=100.0 * float(np.mean([window.source == source.name for window in one.fusion.windows])),
            verdict=verdict,
        )


def _friction(friction: Friction) -> FrictionRow:
    coulomb, viscous, inertia, offset = (float(value) for value in friction.coefficients)
    half = NORMAL_95 * np.sqrt(np.diag(friction.covariance))
    return FrictionRow(
        joint=friction.joint,
        coulomb=coulomb,
        coulomb_half_width_95=float(half[0]),
        viscous=viscous,
        viscous_half_width_95=float(half[1]),
        inertia=inertia,
        offset=offset,
        deviation=float(np.sqrt(friction.variance)),
    )


MOST_JOINTS: Final = 6
"""Joints that have room in one figure."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _IntervalTorques:
    """Torques of one interval."""

    stamp_ns: IntArray
    joints: tuple[str, ...]
    torques: Mapping[str, tuple[FloatArray, FloatArray | None]]
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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueHistory:
    """What `torque_picture` is made of."""

    experiment: Experiment
    """The experiment."""
    spans: Sequence[IntervalEstimates]
    """Its estimates."""
    fusions: Sequence[IntervalFusion] = ()
    """Its fusions; none where torques are not fused."""

    def picture(self) -> TorquePicture:
        """Put torques of all intervals beside each other."""
        return torque_picture(self.experiment, self.spans, self.fusions)


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
    sources = dict.fromkeys(source for piece in pieces for source in piece.torques)
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


def _of_fusion(one: IntervalFusion) -> _IntervalTorques:
    torques = {source.name: (source.torque, _deviation(source.covariance)) for source in one.sources}
    torques[FUSED] = (one.fusion.torque, _deviation(one.fusion.covariance))
    return _IntervalTorques(stamp_ns=one.fusion.stamp_ns, joints=one.fusion.joints, torques=torques)


def _of_estimates(experiment: Experiment, span: IntervalEstimates) -> _IntervalTorques:
    there = {"sensors": experiment.sensors, "skin": force_patches(experiment)}
    name = " and ".join(what for what, some in there.items() if some)
    deviation = None if span.uncertain is None else span.uncertain.torque_sd
    torques = {name: (span.estimates.torques, deviation)}
    return _IntervalTorques(stamp_ns=span.stamp_ns, joints=span.estimates.layout.joints, torques=torques)


def _deviation(covariance: FloatArray) -> FloatArray:
    return np.sqrt(np.einsum("njj->nj", covariance))


def _joined(pieces: Sequence[_IntervalTorques], joints: Sequence[str], source: str, which: int) -> FloatArray:
    """Torques (0) or deviations (1) of a source over all intervals, with a gap after each; shape (n, joints); N m."""
    blocks = []
    for piece in pieces:
        block = np.full((len(piece.stamp_ns) + 1, len(joints)), np.nan)
        values = piece.torques[source][which] if source in piece.torques else None
        for column, joint in enumerate(joints):
            if values is not None and joint in piece.joints:
                block[:-1, column] = values[:, piece.joints.index(joint)]
        blocks.append(block)
    return np.concatenate(blocks)


def _change(several: Sequence[FloatArray]) -> float:
    """Largest standard deviation over time of any source; NaN where none knows the torque."""
    return max((float(np.nanstd(values)) for values in several if np.isfinite(values).any()), default=np.nan)
