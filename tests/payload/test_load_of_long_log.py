# SPDX-License-Identifier: BSD-3-Clause
"""The load of a long log is estimated segment by segment, by means that may span several postures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload import samples_from_recordings
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.log_without_experiment import described_log, experiment_of_description
from forcetorque.payload.result import WeighedLoad
from tests.cases import some_cases
from tests.formats.ur_rtde.recordings import Tool, recorded, write_binary
from tests.scenes.segments import short_segments

TOOL = Tool()


def _weighed(log: Path, **specified: object) -> WeighedLoad:
    stated = {"moment_about": "flange"} | specified
    experiment, _, _ = experiment_of_description(log, described_log(log, stated), stated, Path())
    return weigh_load(SensorRun(experiment, experiment.sensors[0]))


def _log(folder: Path, *, samples: int = 125, lost: int = 0) -> Path:
    """40 postures at 125 Hz, the first readings lost."""
    columns = recorded(TOOL, poses=40, samples=samples, raw=False)
    columns["actual_TCP_force_1"][:lost] = np.nan
    return write_binary(folder / "log", columns)


_SHARE = 1e-6
"""Of an interval, for sums in another order."""


@some_cases("lost", [20, 0])
def test_segments_change_nothing(tmp_path: Path, lost: int) -> None:
    """Loads and what is left out, wherever segments end."""
    log = _log(tmp_path, samples=400, lost=lost)
    whole = _weighed(log)
    with short_segments(7.3):
        parts = _weighed(log)
    assert parts.left_out == whole.left_out == lost
    assert parts.observations == whole.observations
    ((one,), (other,)) = parts.loads, whole.loads
    assert one.mass_kg is not None
    assert other.mass_kg is not None
    assert other.mass_half_width_95_kg is not None
    assert abs(one.mass_kg - other.mass_kg) < _SHARE * other.mass_half_width_95_kg
    centres = np.array([one.centre_of_mass_m, other.centre_of_mass_m], dtype=float)
    halves = np.array(other.centre_of_mass_half_width_95_m, dtype=float)
    assert (np.abs(centres[0] - centres[1]) < _SHARE * halves).all()
    assert parts.warnings == whole.warnings
    assert len(whole.warnings) == bool(lost)


def test_means_over_several_postures_have_the_size_of_gravity(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is that of the samples; gravity in another unit is named all the same."""
    monkeypatch.setattr(samples_from_recordings, "MOST_ROWS", 20)
    log = _log(tmp_path)
    right, wrong = _weighed(log), _weighed(log, gravity=1.0)
    assert right.observations < 25
    assert right.hypotheses == ()
    assert right.loads[0].mass_kg == pytest.approx(TOOL.mass, abs=0.01)
    assert [one.name for one in wrong.hypotheses] == ["unit of gravity"]
