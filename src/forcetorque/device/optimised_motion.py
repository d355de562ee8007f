# SPDX-License-Identifier: BSD-3-Clause
"""Optimised motion of a device of limited duration, by the search that plans recordings of robots.

`forcetorque.planning` chooses and changes postures; this module has the ways between them: the hinge changes its lock
only where gravity takes the load there, with the arm straight down at one end and level at the other.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.device.components import AttachedLoad, Device
from forcetorque.device.excitation_options import SAMPLES, held_out_loads, sample_noise
from forcetorque.device.motion import Sequence, joint_ranges, joint_speeds
from forcetorque.device.tolerances import RestTable, Tolerances
from forcetorque.planning.information import blank_posterior
from forcetorque.planning.posture_search import Choices, Volume, picked_orders, search
from forcetorque.simulation.motions.trajectories import Waypoints, shortest_moves
from forcetorque.workbench.excitation import MatrixError, load_sizes

_SEED: Final = 22
_AROUND_DEG: Final = 360.0
_YAW_OF_LOCK: Final = {90.0: (0.0, 360.0), -90.0: (180.0,)}
"""Positions of yaw in which gravity takes the load from 0 to a lock; deg."""
_QUARTER: Final = np.pi / 2.0
_START: Final = (-90.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DesignedMotion:
    """A motion through postures, with the predicted error of the matrix."""

    postures: FloatArray
    """Chosen postures, without those in which the lock is changed; shape (k, 3); rad."""
    sequence: Sequence
    """All postures."""
    duration_s: float
    """Duration; s."""
    value: float
    """Logarithm of the volume of the covariance of the matrix, by noise and by errors of the device."""
    squares: tuple[float, float]
    """Mean squares of the predicted errors of force and moment at held-out loads; N^2, (N m)^2."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Designer:
    """Search of motions of a device with one load."""

    device: Device
    """The device, with locks at -90, 0 and 90 degrees and no turn."""
    load: AttachedLoad
    """Attached load."""
    sensor: str
    """Sensor to calibrate."""
    seconds: float
    """Longest duration of the motion; s."""
    hold_s: float = 1.0
    """Rest at every posture; s."""
    candidates: int = 240
    """Number of postures to choose from."""
    swaps: int = 1000
    """Number of exchanges of postures that are tried."""
    tolerances: Tolerances = Tolerances()
    """Tolerances of the device."""
    rest: RestTable = field(init=False)
    """Expected wrenches at rest."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "rest", RestTable.of(self.device, self.load, self.sensor, self.tolerances))

    def improve(self, initial: FloatArray) -> DesignedMotion:
        """Find the motion of least volume whose predicted mean square errors are not larger than those of another one.

        Volume alone would accept a larger error of the moment for a smaller one of the force.

        Args:
            initial: Postures of the other motion, from which one search starts too; shape (k, 3); rad.

        Returns:
            The best motion that was tried.
        """
        most = np.array(self.through(initial).squares)

        def valued(postures: FloatArray) -> DesignedMotion:
            motion = self.through(postures)
            return motion if (np.array(motion.squares) <= most).all() else replace(motion, value=np.inf)

        rng = np.random.default_rng(_SEED)
        drawn = self._drawn(rng)
        loads = self.rest.loads(drawn)
        choices = Choices(
            columns=loads.wrench,
            travel_s=lambda start: self._travel(drawn[start], drawn),
            hold_s=self.hold_s,
            seconds=self.seconds - self.hold_s,
        )
        noise = np.diag(sample_noise()) + (loads.independent**2).sum(axis=2).mean(axis=0)
        posterior = blank_posterior(np.sqrt(noise), load_sizes(loads.wrench))
        return search(
            valued,
            drawn,
            [*picked_orders(posterior, Volume(), choices, drawn), initial],
            seconds=self.seconds,
            swaps=self.swaps,
            rng=rng,
        )

    def through(self, postures: FloatArray) -> DesignedMotion:
        """Compute the motion through postures.

        Args:
            postures: Postures in order; shape (k, 3); rad.

        Returns:
            The motion.
        """
        visited, unlocked = [postures[0]], [False]
        for start, end in itertools.pairwise(postures):
            for posture, free in zip(*_ways(start, end[None]), strict=True):
                if np.abs(posture[0] - visited[-1]).max() > 0.0:
                    visited.append(posture[0])
                    unlocked.append(free)
        sequence = Sequence(
            name="optimised",
            joints=self.device.joint_names,
            postures=np.stack(visited),
            steps=tuple(range(1, len(visited) + 1)),
            unlocked=tuple(unlocked[1:]),
        )
        line = Waypoints.at_speed(sequence.joints, sequence.postures, self._speeds, hold_s=self.hold_s)
        error = self._error(sequence, line)
        return DesignedMotion(
            postures=postures,
            sequence=sequence,
            duration_s=line.duration_s,
            value=error.volume,
            squares=error.mean_squares(held_out_loads()),
        )

    @property
    def _speeds(self) -> FloatArray:
        speeds = joint_speeds(self.device)
        return np.array([speeds[joint] for joint in self.device.joint_names])

    def _error(self, sequence: Sequence, line: Waypoints) -> MatrixError:
        seconds = np.linspace(0.0, line.duration_s, SAMPLES)
        way = np.clip(np.searchsorted(line.departures_s, seconds, side="right") - 1, 0, None)
        locked = ~np.array(sequence.unlocked)[way]
        return self.rest.loads(line(seconds[locked]).position).matrix_error(sample_noise())

    def _drawn(self, rng: np.random.Generator) -> FloatArray:
        """Postures to choose from, the start first, all at a lock and half of them at multiples of 45 degrees."""
        low, high = joint_ranges(self.device)["pitch"]
        drawn = np.column_stack(
            [
                rng.uniform(max(low, -90.0), min(high, 90.0), self.candidates),
                rng.uniform(0.0, _AROUND_DEG, self.candidates),
                rng.choice(self.device.hinge.locks_deg, self.candidates),
            ]
        )
        drawn[::2, :2] = 45.0 * np.rint(drawn[::2, :2] / 45.0)
        drawn[0] = _START
        return np.deg2rad(drawn)

    def _travel(self, start: FloatArray, postures: FloatArray) -> FloatArray:
        """Time from a posture to others, rests included; shape (n,); s."""
        seconds, locks = np.zeros(len(postures)), _degrees(postures[:, -1])
        speeds = self._speeds
        for lock in np.unique(locks):
            ends = postures[locks == lock]
            visited = [np.tile(start, (len(ends), 1)), *_ways(start, ends)[0]]
            for begin, end in itertools.pairwise(visited):
                seconds[locks == lock] += shortest_moves(end - begin, speeds) + self.hold_s
        return seconds


def _ways(start: FloatArray, ends: FloatArray) -> tuple[list[FloatArray], list[bool]]:
    """Postures after the start on the ways to ends at one lock, and whether the hinge is unlocked on the way to each.

    Args:
        start: Posture; shape (3,); rad.
        ends: Postures at one lock; shape (n, 3); rad.

    Returns:
        Postures of all ways, each of shape (n, 3), in rad, and as many flags.
    """
    before, after = float(_degrees(start[-1])), float(_degrees(ends[0, -1]))
    postures: list[FloatArray] = []
    if before not in (after, 0.0):
        yaw = _nearest(np.full(len(ends), start[1]), before)
        postures += [_at(0.0, yaw, before), _at(-_QUARTER, yaw, 0.0)]
    if after not in (before, 0.0):
        yaw = _nearest(ends[:, 1], after)
        postures += [_at(-_QUARTER, yaw, 0.0), _at(0.0, yaw, after)]
    # on every second way gravity takes the load to a lock
    return [*postures, ends], [*(number % 2 == 1 for number in range(len(postures))), False]


def _at(pitch: float, yaw: FloatArray, lock_deg: float) -> FloatArray:
    return np.column_stack([np.full(len(yaw), pitch), yaw, np.full(len(yaw), np.deg2rad(lock_deg))])


def _nearest(yaw: FloatArray, lock_deg: float) -> FloatArray:
    """The nearest position of yaw in which gravity takes the load to a lock; shape (n,); rad."""
    allowed = np.deg2rad(_YAW_OF_LOCK[lock_deg])
    return allowed[np.abs(yaw[:, None] - allowed).argmin(axis=1)]


def _degrees(angle: FloatArray) -> FloatArray:
    return np.rad2deg(angle).round(6)
