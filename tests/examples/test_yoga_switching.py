# SPDX-License-Identifier: BSD-3-Clause
"""The example of a real robot on both feet, on one, and on both again."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import load_experiment
from forcetorque.base.errors import ExperimentError

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "23_icub_yoga_switching.toml"

pytestmark = [pytest.mark.real_data, pytest.mark.long]


def test_the_feet_bear_the_weight_in_all_phases(data_dir: Path, tmp_path: Path) -> None:
    """With offsets of the left phase priors err by less than 4 N on both feet, where each bears half of the weight."""
    copy = tmp_path / EXAMPLE.name
    copy.write_text(EXAMPLE.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
    experiment = load_experiment(copy)
    result = experiment.coherence(offsets=["one-link-fixed-frame:left"])
    rows = {row.phase: row for row in result.rows}
    assert list(rows) == ["double", "left", "double again"]
    assert [row.evidence for row in result.rows] == [True, False, True]
    for phase in ("double", "double again"):
        assert np.linalg.norm(rows[phase].force_error_N) < 4.0
        assert abs(rows[phase].force_error_N[2]) < 1.0
        assert rows[phase].contact_links == ("l_sole", "r_sole")
        # arms and torso are not logged
        assert rows[phase].moment_error_Nm is None
    assert np.linalg.norm(rows["left"].force_error_N) < 0.5
    assert result.weight_N == pytest.approx(324.15, abs=0.01)
    assert any("the offset of forces is known, that of moments is not" in words for words in result.warnings)
    # by the joints the right sole leans by two degrees, as if each foot pushed the other
    assert any("'double': by the joints r_sole leans by 2.0 deg" in words for words in result.warnings)
    joints_alone = replace(experiment, supports=experiment.supports[:1])
    (first, *_) = joints_alone.coherence(offsets=["one-link-fixed-frame:left"]).rows
    assert np.linalg.norm(first.force_error_N) > 7.0
    # negative control: without offsets they are off by the weight
    (first, *_) = experiment.coherence(offsets=["none"]).rows
    assert np.linalg.norm(first.force_error_N) > 300.0
    with pytest.raises(ExperimentError, match="expected an IMU in the recording"):
        experiment.coherence(offsets=["one-link-imu:left"])
