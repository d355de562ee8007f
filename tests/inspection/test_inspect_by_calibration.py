# SPDX-License-Identifier: BSD-3-Clause
"""`inspect --calibration` reads the sensor by a calibration in place of its prior."""

from __future__ import annotations

from pathlib import Path

from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET


def test_a_sensor_is_read_by_a_calibration(arm: Path, run: Run) -> None:
    """The calibrated sensor of a clean log has no finding; a log without an experiment file refuses the option."""
    new = arm / "new.json"
    assert run("calibrate", arm / PARQUET, "-o", new).code == 0
    result = run("inspect", arm / PARQUET, "-c", new, "--format", "json").result()
    assert result["findings"] == []
    assert result["streams"]["arm_ft"]["samples"] > 1000
    assert "expected an experiment file, got a log" in run("inspect", arm / "recording", "-c", new).error()
