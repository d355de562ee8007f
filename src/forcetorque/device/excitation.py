# SPDX-License-Identifier: BSD-3-Clause
"""Excitation of a device against the workbench, and options that excite the sixth direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.device.description import AttachedLoad, Device, Turn, device_load
from forcetorque.device.motion import DeviceTrajectory, Sequence, twelve_steps
from forcetorque.device.tolerances import Poses, Tolerances
from forcetorque.workbench.bench import Placement
from forcetorque.workbench.excitation import UncertainLoads, load_sizes
from forcetorque.workbench.loads import THESIS_TABLE, read_loads


def workbench_loads(placement: Placement, samples: int) -> UncertainLoads:
    """Give the loads of the 24 positions of the thesis' workbench.

    Args:
        placement: How exactly weights are placed.
        samples: Samples of all positions together.

    Returns:
        The loads.
    """
    table = read_loads(THESIS_TABLE, measure_direction=MeasureDirection.CHILD_TO_PARENT)
    return UncertainLoads.of_bench(table, placement, samples=samples)


def least_excitation(loads: UncertainLoads, others: UncertainLoads) -> float:
    """Compare what loads excite, sample by sample, with what others do.

    The covariance of a matrix by noise alone is the inverse of the second moment of its loads about their mean, so that
    the ratio of both in the direction in which it is least tells whether any direction is known worse.

    Args:
        loads: Loads.
        others: Loads that span six directions.

    Returns:
        Least ratio of the spread of the loads to that of the others, over all directions; 0 where one is not spanned.
    """
    size = load_sizes(others.wrench)
    root = np.linalg.cholesky(_moment(others, size))
    half = np.linalg.solve(root, _moment(loads, size))
    ratios = np.linalg.eigvalsh(np.linalg.solve(root, half.T))
    return float(np.sqrt(max(ratios[0], 0.0)))


def _moment(loads: UncertainLoads, size: FloatArray) -> FloatArray:
    scaled = loads.wrench / size
    moved = scaled - np.average(scaled, axis=0, weights=loads.count)
    return (loads.count[:, None] * moved).T @ moved / loads.count.sum()


NEARER_M = 0.025
"""How much nearer to the hinge the centre of the second load is than that of the first; m."""
SECOND_KG = 15.0
"""Mass of the second load; kg."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Run:
    """A motion with one load."""

    device: Device
    """The device."""
    load: AttachedLoad
    """Load attached to its hinge."""
    sequence: Sequence
    """The motion."""
    hold_s: float = 1.0
    """Rest at every posture; s."""

    @property
    def trajectory(self) -> DeviceTrajectory:
        """The motion in time."""
        return DeviceTrajectory(device=self.device, load=self.load, sequence=self.sequence, hold_s=self.hold_s)

    def still_poses(self, *, spacing_deg: float = 30.0) -> Poses:
        """Rest at poses of the motion.

        Args:
            spacing_deg: How far any joint goes at most from one to the next; deg.

        Returns:
            The poses, each with one sample.
        """
        motion = self.sequence.still_poses(self.device, self.load, spacing_deg=spacing_deg)
        return Poses.of_samples(self.device, self.load, motion.position)

    def sampled(self, samples: int) -> Poses:
        """Sample the motion evenly in time, as slow as one likes.

        Args:
            samples: How many.

        Returns:
            The poses.
        """
        trajectory = self.trajectory
        seconds = np.linspace(0.0, trajectory.duration_s, samples)
        return Poses.of_samples(self.device, self.load, trajectory(seconds).position)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Remedy:
    """One way to excite a sensor."""

    name: str
    """Name."""
    words: str
    """What is done, as text."""
    runs: tuple[Run, ...]
    """Motions, one for each load."""

    def still_poses(self) -> list[Poses]:
        """Rest at poses of all motions.

        Returns:
            The poses with each load.
        """
        return [run.still_poses() for run in self.runs]

    def sampled(self, samples: int) -> list[Poses]:
        """Share samples out evenly among the motions.

        Args:
            samples: Samples of all together.

        Returns:
            The poses with each load.
        """
        return [run.sampled(samples // len(self.runs)) for run in self.runs]


def uncertain(poses: list[Poses], sensor: str, tolerances: Tolerances) -> UncertainLoads:
    """Join the loads of several motions with what may be wrong of them.

    Args:
        poses: Poses with each load.
        sensor: Name of the sensor.
        tolerances: How exact the device is.

    Returns:
        The loads; errors of the device are the same with every load.
    """
    return UncertainLoads.join([one.uncertain(sensor, tolerances) for one in poses])


def remedies(device: Device, load_kg: float) -> dict[str, Remedy]:
    """List what may be done.

    Args:
        device: The device, with locks at 0 and at 90 degrees.
        load_kg: The load; kg.

    Returns:
        The remedies by name, the 12 steps alone first.
    """
    load = device_load(device, load_kg)
    alone = Run(device=device, load=load, sequence=twelve_steps(device))
    nearer = AttachedLoad.point(SECOND_KG, float(load.centre_of_mass_m[2]) - NEARER_M)
    locked, turned = device.with_locks(-90.0, 0.0, 90.0), device.changed(turn=Turn())
    swinging = device.changed(hinge=device.hinge.model_copy(update={"encoder": True}))

    def as_built(name: str, words: str, other: AttachedLoad) -> Remedy:
        return Remedy(name=name, words=words, runs=(alone, Run(device=device, load=other, sequence=alone.sequence)))

    def changed(name: str, words: str, other: Device, sequence: Sequence) -> Remedy:
        return Remedy(name=name, words=words, runs=(Run(device=other, load=load, sequence=sequence),))

    every = (
        Remedy(name="12 steps", words="the 12 steps as the thesis has them", runs=(alone,)),
        changed(
            "third lock", "a lock at -90 deg, reached with yaw turned by 180 deg", locked, third_lock_steps(locked)
        ),
        changed("load turned", "a joint that turns the load by 90 deg about z", turned, _turn_steps(turned)),
        changed("free hinge", "an unlocked hinge with an encoder, yaw around", swinging, _swing_steps(swinging)),
        as_built("second load", f"12 steps more with {SECOND_KG:g} kg, 25 mm nearer to the hinge", nearer),
        as_built("empty carrier", "12 steps more with the empty carrier", device_load(device, 0.0)),
    )
    return {remedy.name: remedy for remedy in every}


def third_lock_steps(device: Device) -> Sequence:
    """Go on after the 12 steps to a lock at -90 degrees and turn yaw around there.

    The load goes back to 0 as it came. Yaw then turns by 180 degrees, so that gravity takes it to the other side.

    Args:
        device: A device with such a lock.

    Returns:
        The motion.
    """
    return _continued(
        device,
        "12 steps and third lock",
        [(-90.0, 360.0, 0.0), (-90.0, 180.0, 0.0), (0.0, 180.0, -90.0), (0.0, 540.0, -90.0)],
        unlocked=(True, False, True, False),
    )


def swing_at_yaw_zero(device: Device) -> Sequence:
    """Let the hinge swing after the 12 steps without ever turning yaw away from 0.

    Args:
        device: A device whose hinge has an encoder, if the samples of the swing are to count.

    Returns:
        The motion.
    """
    return _continued(device, "12 steps and swing", [(-90.0, 360.0, 0.0), (0.0, 360.0, 90.0)], unlocked=(True, True))


def _swing_steps(device: Device) -> Sequence:
    # pitch and yaw turn together, so that the axis of the hinge is never vertical, and each way ends at a lock
    return _continued(device, "12 steps and free hinge", [(-90.0, 0.0, 0.0), (0.0, 360.0, 90.0)], unlocked=(True, True))


def _turn_steps(device: Device) -> Sequence:
    steps = twelve_steps(device)
    first = np.rad2deg(steps.postures)
    around = [(0.0, 360.0, 90.0, 90.0), (0.0, 0.0, 90.0, 90.0)]
    return Sequence.of(
        device, "12 steps and turned load", np.vstack([first, around]), unlocked=(*steps.unlocked, False, False)
    )


def _continued(
    device: Device, name: str, ways: list[tuple[float, float, float]], *, unlocked: tuple[bool, ...]
) -> Sequence:
    """The 12 steps, and ways by pitch, yaw and hinge after them; deg."""
    steps = twelve_steps(device)
    return Sequence.of(
        device, name, np.vstack([np.rad2deg(steps.postures), ways]), unlocked=(*steps.unlocked, *unlocked)
    )
