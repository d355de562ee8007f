# SPDX-License-Identifier: BSD-3-Clause
"""What the ground has to do to the feet for the robot to move as its joints and IMU say, without a force sensor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.pose import invert_pose
from forcetorque.experiment.contacts import contacts_in
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.offsets import intervals_in_use
from forcetorque.locomotion.section import SOLES, ExperimentSole, refuse_without_soles
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import (
    Sole,
    centre_of_mass,
    centre_of_pressure,
    coplanar,
    mass_of,
)
from forcetorque.locomotion.standing.interval_balance import BalanceOptions, FootPressure, IntervalBalance, RobotBalance
from forcetorque.locomotion.standing.support_phases import SupportPhases, phases_of_contacts, support_phases
from forcetorque.recording.alignment import interpolate, require_overlap, seconds_since, usable_samples
from forcetorque.recording.recording import Interval, MovingSupport, Support
from forcetorque.recording.stream import Stream
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.measured_and_expected_wrench import PaddedSamples, padded_samples
from forcetorque.robot.mechanics.question import Question, required_joints_of
from forcetorque.robot.tree import build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _OnSole:
    """The robot as if one sole alone bore it; n samples of the interval."""

    wrench: FloatArray
    """What the ground does to the sole, in and about its frame; shape (n, 6); N, N m."""
    com: FloatArray
    """Centre of mass in the frame of the sole; shape (n, 3); m."""
    poses: Mapping[str, FloatArray]
    """Pose of every sole in that frame; shape (n, 4, 4) each; m."""


def balance_by_motion(experiment: Experiment, options: BalanceOptions) -> Iterator[IntervalBalance]:
    """Compute what the ground does to the feet by masses, joints and IMU alone.

    Where one foot alone is down it bears all of it: force, moment, and so the centre of pressure, which is then the
    zero moment point. Of several feet only the sum is determined. Which feet are down follows from the vertical forces
    where soles have streams of them, else from what the interval states to be touched. An interval in which another
    link is touched too is not determined, and in no phase.

    Args:
        experiment: The experiment, with soles, joints and, unless a foot is stated to rest, an IMU.
        options: What counts as a contact and as a point.

    Yields:
        How the robot stood, in the order of the intervals.

    Raises:
        ExperimentError: If the file has no sole, every interval is to be ignored, or a joint that carries a mass was
            not logged, or no such joint moves, or thresholds are stated and not every sole has a stream.
    """
    refuse_without_soles(experiment)
    _refuse_unused(experiment, options)
    on_sole = _soles_by_link(experiment)
    for interval in intervals_in_use(experiment):
        with stated_in(f"interval {interval.label!r}"):
            yield _over(experiment, interval, options, on_sole)


def unused_forces(experiment: Experiment) -> str | None:
    """Say which logged forces are not used, since another sole has none.

    Args:
        experiment: The experiment, with soles.

    Returns:
        A sentence; None where every sole has a stream, or none.
    """
    entries = experiment.section(SOLES)
    streams = [entry.stream for entry in entries if entry.stream is not None]
    without = [entry.sole.frame for entry in entries if entry.stream is None]
    if not streams or not without:
        return None
    return (
        f"{experiment.name}: the forces of {', '.join(streams)} are not used, as {', '.join(without)} has no stream; "
        "which feet are down is as the intervals state"
    )


def _refuse_unused(experiment: Experiment, options: BalanceOptions) -> None:
    """Refuse options that nothing is done with."""
    entries = experiment.section(SOLES)
    if options.height_band_m is not None:
        raise ExperimentError("--height-band: expected force sensors for (5.22), got --by-motion; leave it out")
    default = BalanceOptions()
    stated = (options.touch, options.release, options.dwell_s) != (default.touch, default.release, default.dwell_s)
    if stated and any(entry.stream is None for entry in entries):
        raise ExperimentError(
            "--touch, --release, --dwell: expected a stream of vertical_force in every [[sole]], which they apply to, "
            "got soles without: the intervals state which feet are down; leave them out"
        )


def _soles_by_link(experiment: Experiment) -> dict[str, str]:
    """Frame of the sole by link: of the soles, and of links that are fixed to one sole alone."""
    frames = [entry.sole.frame for entry in experiment.section(SOLES)]
    # no sensor is read, so none cuts a foot
    links = build_tree(replace(experiment.model, sensors={}), frames[0]).frames
    by_link = {frame: frame for frame in frames}
    for link, (body, _) in links.items():
        on = [frame for frame in frames if links[frame][0] == body]
        if len(on) == 1:
            by_link[link] = on[0]
    return by_link


def _over(
    experiment: Experiment, interval: Interval, options: BalanceOptions, on_sole: Mapping[str, str]
) -> IntervalBalance:
    entries = experiment.section(SOLES)
    soles = [entry.sole for entry in entries]
    frames = [sole.frame for sole in soles]
    weight_N = mass_of(build_tree(experiment.model, frames[0])) * experiment.processing.gravity
    support = interval.support
    if support is None:
        raise ExperimentError("expected a support frame, or contact_links with an IMU, got neither")
    links = _touched(experiment, interval, support)
    stream = _joint_stream(experiment, soles[0])
    if beside := [link for link in links if link not in on_sole]:
        return _not_determined(experiment, interval, soles, beside, weight_N, stream)
    touched = {on_sole[link] for link in links}
    rooted = [sole for sole in soles if isinstance(support, MovingSupport) or sole.frame == on_sole[support.frame]]
    samples = padded_samples(experiment.recording, stream, interval, experiment.processing.smoothing)
    stamp_ns = samples.stamp_ns[samples.inside]
    time_s = seconds_since(stamp_ns, experiment.recording.start_ns)
    logged = _logged(experiment, entries, stream, stamp_ns)
    down: BoolArray = np.tile([frame in touched for frame in frames], (len(stamp_ns), 1))
    known = np.ones(len(stamp_ns), dtype=np.bool_)
    if logged is not None:
        by_forces = support_phases(logged, time_s, options.thresholds(weight_N))
        down, known = by_forces.down, by_forces.known
    bearing = {sole.frame: _on_sole(experiment, support, sole, soles, stream, samples) for sole in rooted}
    net = np.full(len(stamp_ns), np.nan)
    for sole, here in zip(soles, down.T, strict=True):
        if sole.frame in bearing:
            # of several feet any that is down has the sum along its normal
            net = np.where(np.isnan(net) & here, bearing[sole.frame].wrench[:, 2], net)
    # what bears the robot while no sole is down is not known, nor what a sole does whose motion is not
    phases = phases_of_contacts(frames, time_s, down, known & np.isfinite(net))
    forces, feet = {}, []
    for k, sole in enumerate(soles):
        alone: BoolArray = phases.down[:, k] & (phases.down.sum(axis=1) == 1)
        wrench = np.full((len(stamp_ns), 6), np.nan)
        if sole.frame in bearing:
            wrench[alone] = bearing[sole.frame].wrench[alone]
        # a foot in the air bears nothing
        wrench[~phases.down[:, k] & phases.known] = 0.0
        forces[sole.frame] = wrench[:, 2]
        feet.append(
            FootPressure(
                sole=sole,
                sensors=(),
                wrench=wrench,
                covariance=None,
                pressure=centre_of_pressure(wrench, least_load_N=options.least_load_N(weight_N)),
                reading_alone=None,
            )
        )
    return IntervalBalance(
        recording=experiment.name,
        label=interval.label,
        stamp_ns=stamp_ns,
        time_s=time_s,
        weight_N=weight_N,
        forces=forces,
        net_N=net,
        phases=phases,
        feet=tuple(feet),
        robot=_robot(bearing[rooted[0].frame], soles, rooted[0], phases, options, weight_N),
        refused=(SHARES,) if (phases.down.sum(axis=1) > 1).any() else (),
        logged_net_N=None if logged is None else np.sum(list(logged.values()), axis=0),
    )


SHARES = (
    "load of each foot while several are down: joints and IMU determine only the sum; the shares take a force sensor"
)
"""What motion does not show."""


def _touched(experiment: Experiment, interval: Interval, support: Support | MovingSupport) -> tuple[str, ...]:
    """The links that touch, by what the file states."""
    others = (entry.contact.link for entry in contacts_in(interval, experiment.contacts))
    return tuple(dict.fromkeys((support.frame, *others)))


def _not_determined(
    experiment: Experiment,
    interval: Interval,
    soles: Sequence[Sole],
    links: Sequence[str],
    weight_N: float,
    stream: Stream,
) -> IntervalBalance:
    """An interval in which something else bears the robot too."""
    stamp_ns = stream.stamp_ns[usable_samples(stream.stamp_ns)]
    stamp_ns = stamp_ns[interval.holds(stamp_ns)]
    time_s = seconds_since(stamp_ns, experiment.recording.start_ns)
    unknown: BoolArray = np.zeros(len(stamp_ns), dtype=np.bool_)
    frames = [sole.frame for sole in soles]
    return IntervalBalance(
        recording=experiment.name,
        label=interval.label,
        stamp_ns=stamp_ns,
        time_s=time_s,
        weight_N=weight_N,
        forces={frame: np.full(len(stamp_ns), np.nan) for frame in frames},
        net_N=np.full(len(stamp_ns), np.nan),
        phases=phases_of_contacts(frames, time_s, np.zeros((len(stamp_ns), len(frames)), dtype=np.bool_), unknown),
        refused=(
            f"{interval.label}: {', '.join(links)} is touched and no [[sole]]; the motion determines only the sum of "
            "all contacts",
        ),
    )


def _joint_stream(experiment: Experiment, sole: Sole) -> Stream:
    """The stream of the first joint that carries a mass, at whose instants is computed."""
    logged = experiment.recording.joint_signals("position")
    tree = build_tree(experiment.model, sole.frame)
    needed = required_joints_of(Question(tree=tree, contacts=(sole.contact,), equations=()))
    missing = [joint for joint in needed if joint not in logged]
    if missing:
        raise ExperimentError(
            f"the motion of the robot needs the positions of {', '.join(missing)}, which carry a mass and no stream "
            "holds; log them, or state where they are held, as fixed = { " + missing[0] + " = 0.0 } of [robot]"
        )
    if not needed:
        raise ExperimentError(
            "the motion of the robot needs a joint that moves a mass and was logged, got a robot whose joints are all "
            "held; leave those out of fixed of [robot] that the log has"
        )
    stream, _ = logged[needed[0]]
    return stream


def _on_sole(
    experiment: Experiment,
    support: Support | MovingSupport,
    sole: Sole,
    soles: Sequence[Sole],
    stream: Stream,
    samples: PaddedSamples,
) -> _OnSole:
    """What one sole bears if it bears the robot alone."""
    rooted = replace(support, frame=sole.frame) if isinstance(support, MovingSupport) else support
    tree = build_tree(experiment.model_on(rooted), rooted.frame)
    question = Question(tree=tree, contacts=(sole.contact,), equations=())
    joints, root = experiment.motion_at(rooted, required_joints_of(question), stream, samples.stamp_ns)
    inside = samples.inside
    root_H_sole = {one.frame: link_pose(tree, joints, one.frame) @ one.contact.link_H_contact for one in soles}
    sole_H_root = invert_pose(root_H_sole[sole.frame])
    com = np.einsum("nij,nj->ni", sole_H_root[:, :3, :3], centre_of_mass(tree, joints)) + sole_H_root[:, :3, 3]
    return _OnSole(
        wrench=samples.smoothed(estimate(question, joints, root).contact(sole.contact.name)),
        com=samples.smoothed(com),
        poses={frame: (sole_H_root @ pose)[inside] for frame, pose in root_H_sole.items()},
    )


def _logged(
    experiment: Experiment, entries: Sequence[ExperimentSole], joints: Stream, stamp_ns: IntArray
) -> dict[str, FloatArray] | None:
    """Logged vertical forces by sole at the instants; None where not every sole has a stream of them."""
    if any(entry.stream is None for entry in entries):
        return None
    forces = {}
    for entry in entries:
        stream = experiment.recording.stream(entry.stream or "")
        require_overlap(joints, stream)
        forces[entry.sole.frame] = interpolate(stream, stream.signal("vertical_force").values, stamp_ns)[:, 0]
    return forces


def _robot(
    ground: _OnSole,
    soles: Sequence[Sole],
    sole: Sole,
    phases: SupportPhases,
    options: BalanceOptions,
    weight_N: float,
) -> RobotBalance:
    """The zero moment point on the first sole that can be the ground, where that sole is down and the others level."""
    flat = coplanar([ground.poses[one.frame] for one in soles], phases.down, options.plane)
    stands = phases.down[:, [one.frame for one in soles].index(sole.frame)] & flat & phases.known
    wrench = np.where(stands[:, None], ground.wrench, np.nan)
    return RobotBalance(
        frame=sole.frame,
        pressure=centre_of_pressure(wrench, least_load_N=options.least_load_N(weight_N)),
        com=ground.com,
    )
