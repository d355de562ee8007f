# SPDX-License-Identifier: BSD-3-Clause
"""What hangs on a sensor: the load of a wrist sensor, or the distal links of a robot with the load on one of them."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.errors import ExperimentError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.logged_posture import JointRow
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.load_on_wrist_sensor import LOAD_LINK, WristLoads, inertia_of_stated, wrist_loads
from forcetorque.payload.loads_on_robot_links import LinkLoads, carrying, link_loads
from forcetorque.payload.result import WeighedLoad
from forcetorque.recording.recording import Use
from forcetorque.robot.dynamics import body_poses
from forcetorque.robot.model import ForceTorqueSensor, RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import BodyTree, Coordinate, build_tree, cut_of, outboard_bodies


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldLoad:
    """A rigid load on a sensor."""

    inertia: Inertia
    """In and about the frame of the measurement."""
    has_inertia: bool
    """Whether the moments of inertia of the `[[load]]` are known."""
    links: Inertia
    """What of it are links of the URDF, in and about the same frame."""
    load: str = ""
    """Name of the `[[load]]` on these links; empty for none."""
    frame: str
    """Name of that frame."""
    direction: MeasureDirection
    """Who acts on whom in the measurement; the load is the child."""
    posture: tuple[JointRow, ...] = ()
    """Joints beyond the sensor where they stood; none of a load without joints."""


def held_load(run: SensorRun, weighed: WeighedLoad | None) -> HeldLoad:
    """Find all that hangs on a sensor.

    Of a robot these are the links beyond the sensor, with a `[[load]]` on one of them.

    Args:
        run: The sensor.
        weighed: What recordings say of the load; that of the run alone if None.

    Returns:
        The load.

    Raises:
        ExperimentError: If there are several loads, the data leave the load open, or beyond the sensor of a robot
            joints move or are not logged, or a support is, or its mount is to be estimated.
    """
    wrist = wrist_loads(run.experiment)
    return _distal_load(run, weighed) if wrist is None else _wrist_load(run.experiment, wrist, weighed)


def _wrist_load(experiment: Experiment, wrist: WristLoads, weighed: WeighedLoad | None) -> HeldLoad:
    _require_one_load(wrist.supports)
    if weighed is None:
        (support,) = wrist.supports.values()
        inertia, has_inertia = experiment.model_on(support).links[LOAD_LINK], wrist.loads[0].inertia is not None
    else:
        inertia, has_inertia = _of_weighed(weighed)
    frame = next(iter(experiment.model.links))
    return HeldLoad(
        inertia=inertia, has_inertia=has_inertia, links=Inertia.zero(), frame=frame, direction=wrist.direction
    )


def _distal_load(run: SensorRun, weighed: WeighedLoad | None) -> HeldLoad:
    """Lump the links beyond a sensor, whose joints stand still, and the load on them."""
    experiment, name = run.experiment, run.sensor.name
    if run.sensor.mount_is_unknown:
        raise ExperimentError(
            f'sensor {name!r}: expected a mount that is stated, of which a robot is told, got mount = "unknown"; state '
            "what `forcetorque payload` estimates"
        )
    on_links = link_loads(experiment)
    model, has_inertia = _loaded_model(experiment, on_links, weighed)
    sensor = model.sensors[name]
    tree = build_tree(model, model.joints[sensor.joint].parent)
    distal = _distal_bodies(tree, experiment, name)
    posture = _posture(experiment, name, [tree.bodies[k].coordinate for k in distal])
    joints = JointMotion.at_rest([row.joint for row in posture], [[row.position for row in posture]])
    poses, cut = body_poses(tree, joints, distal), tree.cuts[name]
    sensor_H_root = invert_pose(poses[cut.body][0] @ cut.body_H_sensor)
    bare = build_tree(experiment.model, tree.root_link)
    inertia, links = (
        sum((one.bodies[k].inertia.expressed_in(sensor_H_root @ poses[k][0]) for k in distal), Inertia.zero())
        for one in (tree, bare)
    )
    beyond = {link for k in distal for link in tree.bodies[k].links}
    loads = [] if on_links is None else [load.name for load in on_links.loads if on_links.links[0] in beyond]
    return HeldLoad(
        inertia=inertia,
        has_inertia=has_inertia or not loads,
        links=links,
        load="".join(loads),
        frame=_frame(model, sensor),
        direction=sensor.direction,
        posture=posture,
    )


def _loaded_model(
    experiment: Experiment, on_links: LinkLoads | None, weighed: WeighedLoad | None
) -> tuple[RobotModel, bool]:
    """The robot with its load, and whether all of the inertia is known."""
    if on_links is None:
        return experiment.model, True
    _require_one_load([load.name for load in on_links.loads])
    (load,), (link,) = on_links.loads, on_links.links
    if weighed is not None:
        inertia, has_inertia = _of_weighed(weighed)
        return carrying(experiment.model, link, inertia), has_inertia
    if load.is_known:
        return carrying(experiment.model, link, inertia_of_stated(load)), load.inertia is not None or not load.mass
    (support, _), *_ = on_links.supports
    return on_links.model_on(support, experiment), load.inertia is not None


def _distal_bodies(tree: BodyTree, experiment: Experiment, sensor: str) -> list[int]:
    """Bodies beyond a sensor; that the robot stands on one of them, or has another sensor there, is refused."""
    beyond = np.flatnonzero(outboard_bodies(tree, cut_of(tree, sensor))).tolist()
    links = {link for k in beyond for link in tree.bodies[k].links}
    for interval in experiment.recording.intervals:
        if interval.support is not None and interval.support.frame in links:
            raise ExperimentError(
                f"interval {interval.label!r}: expected a support inboard of {sensor!r}, of whose load a robot is "
                f"told, got {interval.support.frame!r}, which is beyond it"
            )
    others = [name for name, cut in tree.cuts.items() if cut.body in beyond[1:]]
    if others:
        raise ExperimentError(
            f"sensor {sensor!r}: expected a rigid load, of which a robot is told, got another sensor beyond it, "
            f"{', '.join(map(repr, others))}; leave that one out of the experiment file"
        )
    return beyond


_HELD = {"rad": 5e-3, "m": 5e-4}
"""Range of a joint that stands still, by its unit (heuristic)."""


def _posture(experiment: Experiment, sensor: str, coordinates: Sequence[Coordinate | None]) -> tuple[JointRow, ...]:
    """Where the joints beyond a sensor stand in all intervals; that one moves, or is not logged, is refused."""
    logged, moving, posture = experiment.recording.joint_signals("position"), [], []
    for joint in dict.fromkeys(coordinate.joint for coordinate in coordinates if coordinate is not None):
        positions, unit = np.zeros(0), ""
        if joint in logged:
            stream, signal = logged[joint]
            unit = signal.units[signal.columns.index(joint)]
            parts = [one.holds(stream.stamp_ns) for one in experiment.recording.intervals if one.use is not Use.IGNORE]
            inside = np.logical_or.reduce(parts) if parts else np.ones(len(stream), dtype=bool)
            positions = signal.column(joint)[inside]
            positions = positions[np.isfinite(positions)]
        if not len(positions) or float(np.ptp(positions)) > _HELD[unit]:
            moving.append(joint)
        else:
            posture.append(JointRow(joint=joint, position=float(np.median(positions)), unit=unit))
    if moving:
        raise ExperimentError(
            f"sensor {sensor!r}: expected a rigid load, of which a robot is told, got "
            f"{', '.join(map(repr, moving))} beyond it, which move or are not logged; give these joints of the URDF "
            'type="fixed", in the posture in which the tool is used, or record them at rest'
        )
    return tuple(posture)


def _frame(model: RobotModel, sensor: ForceTorqueSensor) -> str:
    """Link along whose axes the sensor measures; its own name where no link has them."""
    joint = model.joints[sensor.joint]
    if sensor.frame is SensorFrame.PARENT:
        return joint.parent
    if sensor.frame is SensorFrame.CHILD or np.array_equal(sensor.child_H_sensor, np.eye(4)):
        return joint.child
    return sensor.name


def _require_one_load(names: Collection[str]) -> None:
    """Refuse several loads, of which one would be written."""
    if len(names) != 1:
        raise ExperimentError(
            f"expected one [[load]], of which a robot is told, got {', '.join(map(repr, names))}: leave the others, "
            "and their intervals, out of the experiment file"
        )


def _of_weighed(weighed: WeighedLoad) -> tuple[Inertia, bool]:
    """What recordings say of the only load, in and about its frame, and whether moments of inertia are known."""
    _require_one_load([load.load for load in weighed.loads])
    (load,) = weighed.loads
    if load.mass_kg is None or None in load.centre_of_mass_m:
        raise ExperimentError(
            f"expected a load that the recordings determine, of which a robot is told, they leave {load.load!r} "
            "open: `forcetorque payload` says what to record"
        )
    about_centre = np.array(np.zeros((3, 3)) if load.inertia_kgm2 is None else load.inertia_kgm2, dtype=np.float64)
    has_inertia = load.inertia_kgm2 is not None and bool(np.isfinite(about_centre).all())
    inertia = Inertia.about_centre_of_mass(
        mass=load.mass_kg,
        centre_of_mass=np.array(load.centre_of_mass_m, dtype=np.float64),
        second_moment=about_centre if has_inertia else np.zeros((3, 3)),
    )
    return inertia, has_inertia
