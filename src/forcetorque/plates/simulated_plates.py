# SPDX-License-Identifier: BSD-3-Clause
"""Simulated force plates with cross-talk and misplaced corners, under a person and under an instrumented pole."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.pose import invert_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import transform_wrench
from forcetorque.formats.c3d.force_platform import pose_of_corners
from forcetorque.formats.c3d.writing import Parameter, write_c3d

FRAME_RATE_HZ = 100.0
"""Frames of markers per second."""
SAMPLES_PER_FRAME = 10
"""Samples of plates and load cell in a frame."""
_SENSOR_BELOW_M = 0.04
"""Depth of the origin of the sensor below the surface."""
_POLE_M = 0.9
_MARKER_NOISE_M = 1e-4
_NOISE = np.repeat([0.2, 0.02], 3)
"""Noise of a sample; N, N m."""
_CELL_NOISE_N = 0.2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedPlate(ArrayRecord):
    """A plate that measures `distortion @ wrench + baseline`, and whose corners the file may misplace."""

    corners_m: FloatArray = field(metadata=array(4, 3))
    """True corners in the laboratory; shape (4, 3); m."""
    corner_error_m: FloatArray = field(metadata=array(3))
    """Shift of the corners in the file; shape (3,); m."""
    distortion: FloatArray = field(metadata=array(6, 6))
    """Measured by true wrench about the origin of the sensor; shape (6, 6)."""
    baseline: FloatArray = field(metadata=array(6))
    """Wrench that is measured without load; shape (6,); N, N m."""

    @classmethod
    def draw(
        cls,
        rng: np.random.Generator,
        *,
        centre_m: Sequence[float] = (0.3, 0.4),
        crosstalk: float,
        corner_error_m: float,
    ) -> SimulatedPlate:
        """Draw a plate of 0.5 m x 0.4 m.

        Args:
            rng: Source of the plate.
            centre_m: Where the centre of its surface is in the laboratory; m.
            crosstalk: Standard deviation of the gains, and of the cross-talk of forces and of moments; a force and a
                moment at 0.2 m count alike.
            corner_error_m: Shift of the corners in the file, in a random direction of the floor; m.

        Returns:
            The plate, with z down.
        """
        x, y = centre_m
        corners = np.array([[x + 0.25, y - 0.2, 0.0], [x - 0.25, y - 0.2, 0.0], [x - 0.25, y + 0.2, 0.0]])
        corners = np.vstack([corners, [x + 0.25, y + 0.2, 0.0]])
        angle = rng.uniform(0.0, 2.0 * np.pi)
        size = np.repeat([1.0, 0.2], 3)
        error = crosstalk * rng.standard_normal((6, 6)) * size[:, None] / size
        return cls(
            corners_m=corners,
            corner_error_m=corner_error_m * np.array([np.cos(angle), np.sin(angle), 0.0]),
            distortion=np.eye(6) + error,
            baseline=np.array([2.0, -1.0, 3.0, 0.15, -0.08, 0.04]),
        )

    def channels(self, force_N: FloatArray, point_m: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Measure forces on the plate.

        Args:
            force_N: Forces of the load on the plate along the axes of the laboratory; shape (n, 3); N.
            point_m: Where each acts; shape (n, 3); m.
            rng: Source of noise.

        Returns:
            The reaction, as most systems write it, with noise; shape (n, 6); N, N mm.
        """
        lab = np.hstack([force_N, np.cross(point_m, force_N)])
        plate_H_lab = invert_pose(pose_of_corners(self.corners_m))
        sensor_H_plate = np.eye(4)
        sensor_H_plate[2, 3] = -_SENSOR_BELOW_M
        reaction = -transform_wrench(sensor_H_plate @ plate_H_lab, lab)
        measured = reaction @ self.distortion.T + self.baseline + _NOISE * rng.standard_normal(reaction.shape)
        return measured * np.repeat([1.0, 1e3], 3)


def write_trial(
    path: Path,
    plates: Sequence[SimulatedPlate],
    channels: FloatArray,
    markers: Mapping[str, FloatArray],
    *,
    others: Sequence[tuple[str, str]] = (),
    force: bool = False,
) -> None:
    """Write a trial as C3D.

    Args:
        path: File to write.
        plates: The plates.
        channels: Channels of all plates, six each, then others; shape (n, c).
        markers: Positions by label; shape (f, 3) each; m.
        others: Name and unit of the other channels.
        force: Whether a file that is there may be replaced.
    """
    count = len(plates)
    components = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
    corners = np.stack([1e3 * (plate.corners_m + plate.corner_error_m).T for plate in plates], axis=2)
    labels = [f"{component}{k + 1}" for k in range(count) for component in components]
    parameters: dict[str, Parameter] = {
        "POINT:LABELS": tuple(markers),
        "POINT:UNITS": ("mm",),
        "ANALOG:LABELS": (*labels, *(name for name, _ in others)),
        "ANALOG:UNITS": (*(("N",) * 3 + ("Nmm",) * 3) * count, *(unit for _, unit in others)),
        "FORCE_PLATFORM:USED": np.array(count),
        "FORCE_PLATFORM:TYPE": np.full(count, 2),
        "FORCE_PLATFORM:ZERO": np.array([1, 0]),
        "FORCE_PLATFORM:CORNERS": corners,
        "FORCE_PLATFORM:ORIGIN": np.repeat([[0.0], [0.0], [-1e3 * _SENSOR_BELOW_M]], count, axis=1),
        "FORCE_PLATFORM:CHANNEL": np.arange(1, 6 * count + 1).reshape(6, count, order="F"),
    }
    positions = 1e3 * np.stack(list(markers.values()), axis=1)
    write_c3d(path, parameters, analog=channels, markers=positions, frame_rate_hz=FRAME_RATE_HZ, force=force)


def write_standing(
    path: Path,
    plates: Sequence[SimulatedPlate],
    rng: np.random.Generator,
    *,
    mass_kg: float = 71.5,
    seconds: float = 3.0,
    force: bool = False,
) -> None:
    """Simulate a person who stands on one plate after the other, then on all.

    Args:
        path: File to write.
        plates: The plates.
        rng: Source of sway and noise.
        mass_kg: Mass of the person; kg.
        seconds: Time on each plate, and on all; s.
        force: Whether a file that is there may be replaced.
    """
    phases = [[k] for k in range(len(plates))] + ([list(range(len(plates)))] if len(plates) > 1 else [])
    n = round(seconds * FRAME_RATE_HZ) * SAMPLES_PER_FRAME
    free = n // 6
    shares = np.zeros((len(phases) * (n + free), len(plates)))
    for number, bearing in enumerate(phases):
        start = number * (n + free) + free
        shares[start : start + n, bearing] = 1.0 / len(bearing)
    time = np.arange(len(shares)) / (FRAME_RATE_HZ * SAMPLES_PER_FRAME)
    sway = np.column_stack([np.sin(2.0 * time), np.cos(1.3 * time), np.zeros(len(time))])
    columns = []
    for k, plate in enumerate(plates):
        down = np.column_stack([0.004 * sway[:, 0], 0.003 * sway[:, 1], -np.ones(len(time))])
        weight = mass_kg * STANDARD_GRAVITY * shares[:, k : k + 1] * down
        point = plate.corners_m.mean(axis=0) + 0.01 * sway
        columns.append(plate.channels(weight, point, rng))
    frames = len(time) // SAMPLES_PER_FRAME
    write_trial(path, plates, np.hstack(columns), {"floor": np.zeros((frames, 3))}, force=force)


def write_pole_trial(
    path: Path,
    plate: SimulatedPlate,
    rng: np.random.Generator,
    *,
    pushes: int = 40,
    tip_error_m: float = 0.0,
    force: bool = False,
) -> None:
    """Simulate a pole with a load cell and markers at tip and head, pressed by hand at many places and tilts.

    Args:
        path: File to write; markers `pole_tip` and `pole_head`, channel `load_cell` (compression, N).
        plate: The plate.
        rng: Source of pushes and noise.
        pushes: Number of pushes of 0.6 s, with pauses without load.
        tip_error_m: Shift of the marker at the tip against the tip along x; m.
        force: Whether a file that is there may be replaced.
    """
    centre = plate.corners_m.mean(axis=0)
    frames_of_push, pause = 60, 30
    tips, heads, loads = [], [], []
    for _ in range(pushes):
        place = centre + np.array([*rng.uniform([-0.22, -0.17], [0.22, 0.17]), 0.0])
        tilt, turn = np.deg2rad(rng.uniform(0.0, 25.0)), rng.uniform(0.0, 2.0 * np.pi)
        axis = np.array([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])
        phase = np.linspace(0.0, np.pi, frames_of_push * SAMPLES_PER_FRAME)
        peak = rng.uniform(150.0, 450.0)
        loads += [np.zeros(pause * SAMPLES_PER_FRAME), peak * np.minimum(1.0, 3.0 * np.sin(phase))]
        tips.append(np.tile(place, (pause + frames_of_push, 1)))
        heads.append(np.tile(place + _POLE_M * axis, (pause + frames_of_push, 1)))
    tip, head, load = np.vstack(tips), np.vstack(heads), np.concatenate(loads)
    axis = np.repeat((head - tip) / _POLE_M, SAMPLES_PER_FRAME, axis=0)
    channels = plate.channels(-load[:, None] * axis, np.repeat(tip, SAMPLES_PER_FRAME, axis=0), rng)
    cell = load + _CELL_NOISE_N * rng.standard_normal(len(load))
    noise = [_MARKER_NOISE_M * rng.standard_normal(tip.shape) for _ in range(2)]
    markers = {"pole_tip": tip + noise[0] + np.array([tip_error_m, 0.0, 0.0]), "pole_head": head + noise[1]}
    write_trial(path, [plate], np.column_stack([channels, cell]), markers, others=[("load_cell", "N")], force=force)
