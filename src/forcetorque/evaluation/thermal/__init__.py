# SPDX-License-Identifier: BSD-3-Clause
"""Drift of a reading with temperature at a constant load: per degree, with time, and between heating and cooling."""

from forcetorque.evaluation.thermal.branches import Branches, find_branches
from forcetorque.evaluation.thermal.cycles import Cycles, cycles_of
from forcetorque.evaluation.thermal.drift import DriftFit, fit_drift
from forcetorque.evaluation.thermal.load_step import LoadStep, find_load_step

__all__ = ["Branches", "Cycles", "DriftFit", "LoadStep", "cycles_of", "find_branches", "find_load_step", "fit_drift"]
