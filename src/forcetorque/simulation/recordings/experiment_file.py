# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file of a simulated recording, with supports and intervals by its phases."""

from __future__ import annotations

import json
from collections.abc import Iterator

from forcetorque.base.arrays import FloatArray
from forcetorque.recording.recording import Use
from forcetorque.simulation.motions.movement import Movement, Phase, PhaseKind
from forcetorque.simulation.scenario.plan import INTERVAL_MARGIN_S
from forcetorque.simulation.scenario.run import Scenario, SimulatedRecording
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
        yield _phase_interval_text(simulated, phase)


def _phase_interval_text(simulated: SimulatedRecording, phase: Phase) -> str:
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


def experiment_text(scenario: Scenario, simulated: SimulatedRecording, log: str, *, temperature: bool) -> str:
    """Write the experiment file of a recording.

    Args:
        scenario: Its scenario.
        simulated: The recording.
        log: The table `[recording]`, without its head.
        temperature: Whether sensors have their temperature as variable.

    Returns:
        The file, TOML. The whole recording is one interval, or one for each phase of its movement, but for a margin at
        either end.
    """
    text = [
        f'schema = "forcetorque/experiment/1"\nname = "{scenario.file.name}, {simulated.name}"\n',
        f'\n[robot]\nurdf = "robot.urdf"\ngravity = {scenario.file.robot.gravity!r}\n\n[recording]\n{log}',
    ]
    for name, specimen in scenario.specimens.items():
        text.append(
            f'\n[[sensor]]\nname = "{name}"\nstream = "{name}"\nserial = "{specimen.serial}"\n'
            f'prior = "matrix_{specimen.serial}.txt"\nlimit_counts = {float(specimen.sensor.limit_counts)!r}\n'
        )
        if temperature:
            text.append('\n[[sensor.variable]]\nname = "temperature"\n')
    if scenario.robot_errors is None:  # the model is exact
        text.append("\n[calibration]\naccuracy = { force_N = 0.0, moment_Nm = 0.0 }\n")
    if "velocity" in simulated.recording.stream("joints").signals:
        text.append('\n[processing]\nderivatives = "logged"\n')
    if simulated.movement.phases:
        text += phases_text(simulated)
    else:
        text += [_contacts_text(simulated.movement, imu=scenario.imu is not None), _interval_text(simulated)]
    return "".join(text)


def _contacts_text(movement: Movement, *, imu: bool) -> str:
    """The support and, of a robot on both feet, the other foot, whose contact is as unknown."""
    support, *others = movement.touched
    if movement.carriage is None:
        return support_text(support, down=movement.gravity_direction)
    # without an IMU the first foot stands all the time
    down = -movement.base_pose([0.0], support)[0, 2, :3]
    contacts = [f'\n[[contact]]\nframe = "{link}"\n' for link in others]
    return support_text(support, down=None if imu else down) + "".join(contacts)


def _interval_text(simulated: SimulatedRecording) -> str:
    """The whole recording but for a margin at either end."""
    end_s = simulated.movement.duration_s - INTERVAL_MARGIN_S
    return (
        f'\n[[interval]]\nlabel = "{simulated.name}"\nstart_s = {INTERVAL_MARGIN_S}\nuse = "{simulated.use.value}"\n'
        f'support = "{simulated.movement.touched[0]}"\nend_s = {end_s:.3f}\n'
        f"kind = {json.dumps(simulated.kind)}\nsession = {json.dumps(simulated.session)}\n"
    )
