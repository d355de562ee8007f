# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file of a simulated recording."""

from __future__ import annotations

import json

from forcetorque.experiment.simulated.phases import phases_text, support_text
from forcetorque.simulation.motions import Movement
from forcetorque.simulation.scenario import INTERVAL_MARGIN_S, Scenario, SimulatedRecording


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
