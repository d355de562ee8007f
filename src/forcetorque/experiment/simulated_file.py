# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file of a simulated recording."""

from __future__ import annotations

import json

from forcetorque.simulation.scenario import INTERVAL_MARGIN_S, Scenario, SimulatedRecording


def experiment_text(scenario: Scenario, simulated: SimulatedRecording, log: str, *, temperature: bool) -> str:
    """Write the experiment file of a recording.

    Args:
        scenario: Its scenario.
        simulated: The recording.
        log: The table `[recording]`, without its head.
        temperature: Whether sensors have their temperature as variable.

    Returns:
        The file, TOML; the whole recording is one interval, but for a margin at either end.
    """
    down = ", ".join(repr(float(value)) for value in simulated.movement.gravity_direction)
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
    # the model of a simulated robot is exact
    text.append("\n[calibration]\naccuracy = { force_N = 0.0, moment_Nm = 0.0 }\n")
    text.append(f'\n[[support]]\nframe = "{simulated.movement.support}"\ngravity_direction = [{down}]\n')
    text.append(
        f'\n[[interval]]\nlabel = "{simulated.name}"\nstart_s = {INTERVAL_MARGIN_S}\nuse = "{simulated.use.value}"\n'
        f'support = "{simulated.movement.support}"\nend_s = {simulated.movement.duration_s - INTERVAL_MARGIN_S:.3f}\n'
        f"kind = {json.dumps(simulated.kind)}\nsession = {json.dumps(simulated.session)}\n"
    )
    return "".join(text)
