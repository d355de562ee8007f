# SPDX-License-Identifier: BSD-3-Clause
"""Experiment files: from TOML to a checked content."""

from __future__ import annotations

from pathlib import Path

from forcetorque.experiment.schema import ExperimentFile
from forcetorque.toml_table import read_toml


def parse_experiment(path: Path | str) -> ExperimentFile:
    """Read and check an experiment file, without opening what it points to.

    Args:
        path: TOML file.

    Returns:
        Its content.
    """
    return read_toml(path, ExperimentFile, what="an experiment file")
