# SPDX-License-Identifier: BSD-3-Clause
"""Short recordings of the bundled scenario of contact switching."""

from __future__ import annotations

from typing import Any

from forcetorque.base.toml_file import read_toml
from forcetorque.simulation.scenario.scenario_file import ScenarioFile, bundled_scenario


def short_switching(**sensors: Any) -> ScenarioFile:
    """The bundled file with fewer postures, shorter rests and fewer samples, and other keys of its sensors."""
    content = read_toml(bundled_scenario("switching"), ScenarioFile, what="a scenario")
    motion = {"postures": 2, "still_s": 1.0, "speed": 1.0}
    entries = tuple(
        entry.model_copy(update={"motion": entry.motion.model_copy(update=motion), "rate_hz": 25.0})
        for entry in content.recording
    )
    return content.model_copy(update={"recording": entries}).with_sensors(**sensors)
