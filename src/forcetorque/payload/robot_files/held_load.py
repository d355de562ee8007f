# SPDX-License-Identifier: BSD-3-Clause
"""What hangs on a sensor: the load of a wrist sensor, or the distal links of a robot with the load on one of them."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from forcetorque.base.errors import ExperimentError
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.load_on_wrist_sensor import LOAD_LINK, WristLoads, inertia_of_stated, wrist_loads
from forcetorque.payload.loads_on_robot_links import LinkLoads, carrying, link_loads
from forcetorque.payload.result import WeighedLoad
from forcetorque.robot.model import ForceTorqueSensor, RobotModel, SensorFrame
from forcetorque.robot.tree import BodyTree, build_tree, cut_of, outboard_bodies


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldLoad:
    """A rigid load on a sensor."""

    inertia: Inertia
    """In and about the frame of the measurement."""
    has_inertia: bool
    """Whether its moments of inertia are known."""
    frame: str
    """Name of that frame."""
    direction: MeasureDirection
    """Who acts on whom in the measurement; the load is the child."""


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
            joints move or a support is, or its mount is to be estimated.
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
    return HeldLoad(inertia=inertia, has_inertia=has_inertia, frame=frame, direction=wrist.direction)


def _distal_load(run: SensorRun, weighed: WeighedLoad | None) -> HeldLoad:
    """Lump the links beyond a sensor, of which no joint moves, and the load on them."""
    experiment, name = run.experiment, run.sensor.name
    if run.sensor.mount_is_unknown:
        raise ExperimentError(
            f'sensor {name!r}: expected a mount that is stated, of which a robot is told, got mount = "unknown"; state '
            "what `forcetorque payload` estimates"
        )
    model, has_inertia = _loaded_model(experiment, link_loads(experiment), weighed)
    sensor = model.sensors[name]
    tree = build_tree(model, model.joints[sensor.joint].parent)
    _require_rigid(tree, experiment, name)
    cut = tree.cuts[name]
    inertia = tree.bodies[cut.body].inertia.expressed_in(invert_pose(cut.body_H_sensor))
    frame = _frame(model, sensor)
    return HeldLoad(inertia=inertia, has_inertia=has_inertia, frame=frame, direction=sensor.direction)


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


def _require_rigid(tree: BodyTree, experiment: Experiment, sensor: str) -> None:
    """Refuse a load that changes with the posture, or that the robot stands on."""
    beyond = outboard_bodies(tree, cut_of(tree, sensor))
    distal = [body for body, is_beyond in zip(tree.bodies, beyond, strict=True) if is_beyond]
    links = {link for body in distal for link in body.links}
    for interval in experiment.recording.intervals:
        if interval.support is not None and interval.support.frame in links:
            raise ExperimentError(
                f"interval {interval.label!r}: expected a support inboard of {sensor!r}, of whose load a robot is "
                f"told, got {interval.support.frame!r}, which is beyond it"
            )
    if len(distal) > 1:
        joints = ", ".join(repr(body.joint) for body in distal[1:] if body.joint is not None) or "another sensor"
        raise ExperimentError(
            f"sensor {sensor!r}: expected a rigid load, of which a robot is told, got {joints} beyond it; give these "
            'joints of the URDF type="fixed", in the posture in which the tool is used'
        )


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
