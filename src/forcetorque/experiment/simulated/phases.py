# SPDX-License-Identifier: BSD-3-Clause
"""Supports and intervals in the experiment file of a simulated recording whose support changes."""

from __future__ import annotations

import json
from collections.abc import Iterator

from forcetorque.arrays import FloatArray
from forcetorque.recording import Use
from forcetorque.simulation.motions import Phase, PhaseKind
from forcetorque.simulation.scenario import INTERVAL_MARGIN_S, SimulatedRecording
from forcetorque.simulation.trace import IMU_STREAM


def support_text(link: str, *, down: FloatArray | None) -> str:
    """Write a support.

    Args:
        link: Link that stands still, or whose motion an IMU tells.
        down: Direction in which things fall, in the axes of the link; shape (3,); None where the IMU tells it.

    Returns:
        The table, TOML.
    """
    if down is None:
        return f'\n[[support]]\nframe = "{link}"\nimu = ["{IMU_STREAM}"]\n'
    direction = ", ".join(repr(float(value)) for value in down)
    return f'\n[[support]]\nframe = "{link}"\ngravity_direction = [{direction}]\n'


def phases_text(simulated: SimulatedRecording) -> Iterator[str]:
    """Write supports and intervals, one for each phase.

    Gravity is imposed where a foot stands, as on level ground; of a robot that hangs its IMU tells it. While both feet
    stand nobody knows what each bears: both are touched, and the IMU tells how the robot moves. Landing is ignored.

    Args:
        simulated: The recording, with an IMU.

    Yields:
        Tables, TOML.
    """
    phases, movement = simulated.movement.phases, simulated.movement
    bearing = {phase.touched[0]: phase.kind for phase in phases if len(phase.touched) == 1}
    for link, kind in bearing.items():
        down = -movement.base_pose([0.0], link)[0, 2, :3]  # a link that bears alone stands in the same way all the time
        yield support_text(link, down=None if kind is PhaseKind.HANGING else down)
    for phase in phases:
        yield _interval_text(simulated, phase)


def _interval_text(simulated: SimulatedRecording, phase: Phase) -> str:
    start_s = max(phase.start_s, INTERVAL_MARGIN_S)
    end_s = min(phase.end_s, simulated.movement.duration_s - INTERVAL_MARGIN_S)
    use, support = simulated.use, f'support = "{phase.touched[0]}"\n'
    if phase.kind is PhaseKind.LANDING:
        use, support = Use.IGNORE, ""
    elif phase.kind is PhaseKind.DOUBLE_SUPPORT:
        support = f"touched = {json.dumps(phase.touched)}\n"
    return (
        f'\n[[interval]]\nlabel = "{phase.label}"\nstart_s = {start_s:.3f}\nend_s = {end_s:.3f}\n'
        f'use = "{use.value}"\n{support}'
        f"kind = {json.dumps(phase.kind.value)}\nsession = {json.dumps(simulated.session)}\n"
    )
