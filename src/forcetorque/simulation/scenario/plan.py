# SPDX-License-Identifier: BSD-3-Clause
"""What a robot does in the recordings of a scenario; sensors have no part in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.experiment.validation_set import OFFSET_S
from forcetorque.recording.recording import Use
from forcetorque.robot.model import RobotModel
from forcetorque.simulation.motions.contact_switching import contact_switching_movement
from forcetorque.simulation.motions.insitu import balancing_movement, grid_movement, z_torque_movement
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.motions.on_both_feet import (
    squat_movement,
    standing_movement,
    stepping_movement,
    sway_movement,
)
from forcetorque.simulation.motions.random_smooth import random_movement
from forcetorque.simulation.motions.stance import Stance, random_placement
from forcetorque.simulation.motions.stand import Stand
from forcetorque.simulation.scenario.file import Recorded, ScenarioFile
from forcetorque.simulation.trace import EPOCH_NS, Trace, trace_movement

_MOVEMENTS, _STAMPS, _PLACEMENTS = 3, 5, 7
"""What a stream of random numbers is for: each has its own, so that one more recording changes no other."""

_ON_BOTH_FEET = {
    MovementKind.STANDING: standing_movement,
    MovementKind.SWAY: sway_movement,
    MovementKind.SQUAT: squat_movement,
    MovementKind.STEPPING: stepping_movement,
}

_DAY_NS = 86_400_000_000_000
_HOUR_NS = 3_600_000_000_000

INTERVAL_MARGIN_S = 0.5
"""What the interval of a recording leaves out at either end: derivatives of the joints are poor there; s."""

_JUDGED_HZ = 10.0
"""Rate at which loads are averaged: every tenth sample of a recording has the same mean within some tenths of a
percent, for a tenth of the time."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plan:
    """One recording that is to be made."""

    name: str
    """Name of the recording."""
    entry: Recorded
    """What the file says of it."""
    index: int
    """Place of its entry in the file."""
    start_ns: int
    """When it starts; ns."""
    movement: Movement
    """What the robot does."""

    def trace(self, sensors: Sequence[str], *, seed: int, imu_link: str | None = None) -> Trace:
        """Find the loads on sensors.

        Args:
            sensors: Their names.
            seed: Seed of the scenario.
            imu_link: Link that an IMU is on; none if None.

        Returns:
            Joints, loads and the IMU's motion at the instants at which they are read.
        """
        rng = np.random.default_rng([seed, _STAMPS, self.index, 0])
        return trace_movement(
            self.movement,
            sensors,
            rate_hz=self.entry.rate_hz,
            rng=rng,
            start_ns=self.start_ns,
            imu_link=imu_link,
            exact=self.entry.exact,
        )


def plan_recordings(content: ScenarioFile, model: RobotModel) -> Iterator[Plan]:
    """Plan the motions of a scenario.

    Args:
        content: The scenario.
        model: Its robot, with its added loads.

    Yields:
        Recordings to make.
    """
    for index, entry in enumerate(content.recording):
        rng = np.random.default_rng([content.seed, _MOVEMENTS, index])
        placement = _placement(content.seed, entry.motion.placement)
        movement = _movement(entry, model, gravity=content.robot.gravity, rng=rng, placement=placement)
        start_ns = EPOCH_NS + entry.power_up * _DAY_NS + index * _HOUR_NS
        yield Plan(name=entry.name, entry=entry, index=index, start_ns=start_ns, movement=movement)


@lru_cache(maxsize=1)  # one sensor after the other is drawn for the same motions
def validation_loads(plans: tuple[Plan, ...], sensor: str) -> tuple[FloatArray, ...]:
    """Compute how the true loads of a sensor change in the recordings that are for validation.

    Args:
        plans: All recordings.
        sensor: The sensor.

    Returns:
        Its wrenches in the interval of each of them, evenly in time, less their mean over the first second, from which
        a study takes the offset; shapes (n, 6); N, N m.
    """
    changes = []
    for plan in plans:
        if plan.entry.use is Use.VALIDATION:
            time_s = np.arange(INTERVAL_MARGIN_S, plan.movement.duration_s - INTERVAL_MARGIN_S, 1.0 / _JUDGED_HZ)
            load = plan.movement.readings(time_s, [sensor]).of_name(sensor)
            change = load - load[time_s < INTERVAL_MARGIN_S + OFFSET_S].mean(axis=0)
            changes.append(read_only(change, name="loads", shape=(None, 6)))
    return tuple(changes)


def _placement(seed: int, number: int) -> FloatArray:
    """Where the feet stand; number 0 has them below the hips."""
    if number == 0:
        return np.zeros((2, 3))
    return random_placement(np.random.default_rng([seed, _PLACEMENTS, number]))


def _movement(
    entry: Recorded, model: RobotModel, *, gravity: float, rng: np.random.Generator, placement: FloatArray
) -> Movement:
    motion = entry.motion
    stand = Stand(
        model=model,
        support=entry.support or model.root_link,
        gravity_direction=entry.gravity_direction,
        speed=motion.speed,
        gravity=gravity,
    )
    sensor, swing = motion.sensor or "", motion.swing or ""
    if motion.kind is MovementKind.GRID:
        return grid_movement(stand, sensor, steps=motion.postures or 7, hold_s=motion.hold_s, name=entry.name)
    if motion.kind is MovementKind.Z_TORQUE:
        postures = motion.postures or 12
        return z_torque_movement(stand, sensor, rng=rng, postures=postures, hold_s=motion.hold_s, name=entry.name)
    if motion.kind is MovementKind.BALANCING:
        postures = motion.postures or 12
        return balancing_movement(stand, swing, rng=rng, postures=postures, hold_s=motion.hold_s, name=entry.name)
    if motion.kind is MovementKind.CONTACT_SWITCHING:
        return contact_switching_movement(
            Stance(stand=stand, other=swing, placement=placement),
            rng=rng,
            hook=motion.hook,
            postures=motion.postures or 3,
            still_s=motion.still_s,
            internal_force_N=motion.internal_force_N,
            name=entry.name,
        )
    duration = motion.duration_s or 0.0
    if motion.kind in _ON_BOTH_FEET:
        stance = Stance(stand=stand, other=swing, placement=placement)
        force, move = motion.internal_force_N, _ON_BOTH_FEET[motion.kind]
        return move(stance, rng=rng, duration_s=duration, internal_force_N=force, name=entry.name)
    return random_movement(stand, rng=rng, duration_s=duration, slowest_hz=motion.slowest_hz, name=entry.name)
