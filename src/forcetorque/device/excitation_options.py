# SPDX-License-Identifier: BSD-3-Clause
"""Excitation of a device against the workbench, and options that excite the sixth direction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.device.components import AttachedLoad, Device, Turn, device_load
from forcetorque.device.motion import DeviceTrajectory, Sequence, twelve_steps
from forcetorque.device.tolerances import Poses
from forcetorque.experiment.workbench_file import THESIS_TABLE
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.workbench.excitation import UncertainLoads, load_sizes
from forcetorque.workbench.known_loads import read_loads
from forcetorque.workbench.position_means import Placement

HELD_OUT_FORCE_N: Final = 100.0
"""Standard deviation of every component of a held-out force; N."""
HELD_OUT_MOMENT_NM: Final = 5.0
"""The same of the moment; N m."""
SAMPLES: Final = 360
"""Samples of a calibration, by every motion and by the workbench."""
NOISE_COUNTS: Final = 1.0
"""Standard deviation of the noise of a sample; counts."""
FAMILY: Final = "standard"
"""Family that sensors are drawn from."""
_LOADS: Final = 400
_HELD_OUT_SEED: Final = 7_000_000
"""Held-out loads have other seeds than sensors and errors."""


def held_out_loads(seed: int = 0) -> FloatArray:
    """Draw loads that no calibration uses.

    Returns:
        Changes of load; shape (400, 6); N, N m.
    """
    size = np.repeat([HELD_OUT_FORCE_N, HELD_OUT_MOMENT_NM], 3)
    return size * np.random.default_rng(_HELD_OUT_SEED + seed).standard_normal((_LOADS, 6))


def sample_noise() -> FloatArray:
    """Compute the covariance of the noise of a sample of the nominal sensor; shape (6, 6); N, N m."""
    matrix = np.linalg.inv(FAMILIES[FAMILY].nominal())
    return NOISE_COUNTS**2 * matrix @ matrix.T


def workbench_loads(placement: Placement, samples: int) -> UncertainLoads:
    """Compute the loads of the 24 positions of the workbench of the thesis.

    Args:
        placement: Standard deviations of the placement of weights.
        samples: Samples of all positions together.

    Returns:
        The loads.
    """
    table = read_loads(THESIS_TABLE, measure_direction=MeasureDirection.CHILD_TO_PARENT)
    return UncertainLoads.of_bench(table, placement, samples=samples)


def least_excitation(loads: UncertainLoads, others: UncertainLoads) -> float:
    """Compare the excitation by loads, sample by sample, with that by other loads.

    The covariance of a matrix by noise alone is the inverse of the second moment of its loads about their mean. So the
    least ratio of both moments over all directions shows whether a direction is determined less accurately.

    Args:
        loads: Loads.
        others: Loads that span six directions.

    Returns:
        Least ratio of the standard deviations of the loads and of the others; 0 where a direction is not spanned.
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
class ExcitationOption:
    """One way to excite all six directions of a sensor."""

    name: str
    """Name."""
    description: str
    """What changes, as text."""
    trajectories: tuple[DeviceTrajectory, ...]
    """Motions, one for each load."""

    def sampled(self, samples: int) -> list[Poses]:
        """Divide samples evenly among the motions.

        Args:
            samples: Samples of all motions together.

        Returns:
            The poses with each load.
        """
        return [sampled_poses(trajectory, samples // len(self.trajectories)) for trajectory in self.trajectories]


def still_poses(trajectory: DeviceTrajectory, *, spacing_deg: float = 30.0) -> Poses:
    """Compute static poses along a motion.

    Args:
        trajectory: The motion.
        spacing_deg: Largest angle of any joint between consecutive poses; deg.

    Returns:
        The poses, each with one sample.
    """
    device, load = trajectory.device, trajectory.load
    motion = trajectory.sequence.still_poses(device, load, spacing_deg=spacing_deg)
    return Poses.of_samples(device, load, motion.position)


def sampled_poses(trajectory: DeviceTrajectory, samples: int) -> Poses:
    """Sample a motion evenly in time, without its velocities and accelerations.

    Args:
        trajectory: The motion.
        samples: Number of samples.

    Returns:
        The poses.
    """
    seconds = np.linspace(0.0, trajectory.duration_s, samples)
    return Poses.of_samples(trajectory.device, trajectory.load, trajectory(seconds).position)


def excitation_options(device: Device, load_kg: float) -> dict[str, ExcitationOption]:
    """List motions and changes of a device that may excite the sixth direction.

    Args:
        device: The device, with locks at 0 and at 90 degrees.
        load_kg: The load; kg.

    Returns:
        The options by name, the 12 steps without a change first.
    """
    load = device_load(device, load_kg)
    twelve = DeviceTrajectory(device=device, load=load, sequence=twelve_steps(device))
    nearer = AttachedLoad.point(SECOND_KG, float(load.centre_of_mass_m[2]) - NEARER_M)
    locked, turned = device.with_locks(-90.0, 0.0, 90.0), device.changed(turn=Turn())
    swinging = device.changed(hinge=device.hinge.model_copy(update={"encoder": True}))

    def second_load(name: str, description: str, other: AttachedLoad) -> ExcitationOption:
        second = DeviceTrajectory(device=device, load=other, sequence=twelve.sequence)
        return ExcitationOption(name=name, description=description, trajectories=(twelve, second))

    def changed(name: str, description: str, other: Device, sequence: Sequence) -> ExcitationOption:
        trajectory = DeviceTrajectory(device=other, load=load, sequence=sequence)
        return ExcitationOption(name=name, description=description, trajectories=(trajectory,))

    options = (
        changed("12 steps", "the 12 steps as the thesis has them", device, twelve.sequence),
        changed(
            "third lock", "a lock at -90 deg, reached with yaw turned by 180 deg", locked, third_lock_steps(locked)
        ),
        changed("load turned", "a joint that turns the load by 90 deg about z", turned, _turn_steps(turned)),
        changed("free hinge", "an unlocked hinge with an encoder, yaw around", swinging, _swing_steps(swinging)),
        second_load("second load", f"12 steps more with {SECOND_KG:g} kg, 25 mm nearer to the hinge", nearer),
        second_load("empty carrier", "12 steps more with the empty carrier", device_load(device, 0.0)),
    )
    return {option.name: option for option in options}


def third_lock_steps(device: Device) -> Sequence:
    """Continue the 12 steps to a lock at -90 degrees, with a full turn of yaw there.

    The load goes back to 0 on the same way. Yaw then turns by 180 degrees, so that gravity takes it to the other side.

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
    """Continue the 12 steps with a swing of the hinge at yaw 0.

    Args:
        device: A device whose hinge has an encoder, if the samples of the swing are used.

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
