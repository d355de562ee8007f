# SPDX-License-Identifier: BSD-3-Clause
"""Fresh copies of small complete experiments for every test."""

from tests.scenes.experiment_folders import arm, days, intact, intact_warm, recorded, warm

__all__ = ["arm", "days", "intact", "intact_warm", "recorded", "warm"]
