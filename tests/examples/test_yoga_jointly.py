# SPDX-License-Identifier: BSD-3-Clause
"""The example of all leg sensors of a real robot at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque import calibrate_jointly, load_experiment

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "15_icub_yoga_jointly.toml"

pytestmark = pytest.mark.real_data


def test_four_sensors_come_out_of_one_stretch(data_dir: Path, tmp_path: Path) -> None:
    """Every part is closed better than by the priors, what stands on the leg counts, and what is open is said."""
    copy = tmp_path / EXAMPLE.name
    copy.write_text(EXAMPLE.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
    result = calibrate_jointly([load_experiment(copy)], folder=tmp_path / "calibrations")
    assert [entry.calibration.sensor.serial for entry in result.calibrations] == ["SN026", "SN230", "SN217", "SN229"]
    assert result.joint is not None
    parts = {row.part: row for row in result.joint.parts}
    weight = "weight on l_leg_ft_sensor, r_leg_ft_sensor"
    assert set(parts) == {"l_foot_ft_sensor", "r_leg_ft_sensor", "r_foot_ft_sensor", weight}
    assert all(row.force_after_N < 0.5 * row.force_before_N for row in parts.values())
    assert parts[weight].moment_after_Nm is None
    assert result.warnings[0].startswith("stance gain not determined: ")
