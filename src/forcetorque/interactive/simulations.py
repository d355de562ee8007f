# SPDX-License-Identifier: BSD-3-Clause
"""Recordings with known sensors, for scripts and notebooks."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # what simulates takes long to import, and most scripts do not
    from forcetorque.experiment.simulated.recordings import WrittenScenario


def simulate(
    scenario: Path | str, folder: Path | str, *, progress: Callable[[str], None] | None = None
) -> WrittenScenario:
    """Make recordings of a simulated robot whose sensors are known: `simulate("wrist", "simulated")`.

    Args:
        scenario: Scenario file (TOML), or a bundled one: icub-insitu, stance, switching, wrist.
        folder: Folder to make; it is there as a whole or not at all.
        progress: Called with a line for people at every recording, such as `print`.

    Returns:
        What was written: an experiment file per recording.

    Raises:
        ForceTorqueError: If there is no such scenario, or the folder is there already.
    """
    from forcetorque.experiment.simulated.recordings import write_scenario
    from forcetorque.simulation.scenario import bundled_scenario, load_scenario

    file = scenario if str(scenario).endswith(".toml") else bundled_scenario(str(scenario))
    return write_scenario(load_scenario(Path(file)), folder, progress=progress)
