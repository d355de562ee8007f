# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios: files that say what is simulated, and what comes of them."""

from forcetorque.simulation.scenario.bundled import bundled_scenario
from forcetorque.simulation.scenario.plan import INTERVAL_MARGIN_S
from forcetorque.simulation.scenario.run import (
    Scenario,
    SimulatedRecording,
    build_scenario,
    load_scenario,
    simulate,
    trace_recordings,
)
from forcetorque.simulation.scenario.schema import ScenarioFile
from forcetorque.simulation.scenario.sensor_tables import LINEAR_ONLY

__all__ = [
    "INTERVAL_MARGIN_S",
    "LINEAR_ONLY",
    "Scenario",
    "ScenarioFile",
    "SimulatedRecording",
    "build_scenario",
    "bundled_scenario",
    "load_scenario",
    "simulate",
    "trace_recordings",
]
