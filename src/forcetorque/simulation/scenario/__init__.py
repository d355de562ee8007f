# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios: files that say what is simulated, and what comes of them."""

from forcetorque.simulation.scenario.run import Scenario, SimulatedRecording, load_scenario, simulate
from forcetorque.simulation.scenario.schema import ScenarioFile

__all__ = ["Scenario", "ScenarioFile", "SimulatedRecording", "load_scenario", "simulate"]
