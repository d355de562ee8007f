# SPDX-License-Identifier: BSD-3-Clause
"""Simulated recordings written from Python: what the command line writes, and nothing if something fails."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.loading import load_experiment
from forcetorque.simulation import recordings as simulated
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import Scenario, build_scenario
from forcetorque.simulation.scenario.scenario_file import ScenarioFile
from tests.results.showing import require_shown


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    """A robot that moves for some seconds."""
    motion = {"kind": "random", "duration_s": 4.0, "slowest_hz": 0.3, "speed": 2.0}
    return build_scenario(
        ScenarioFile.model_validate(
            {
                "schema": "forcetorque/scenario/1",
                "name": "short",
                "seed": 3,
                "robot": {"model": ["arm"]},
                "recording": [{"name": "fit", "motion": motion}],
            }
        )
    )


def test_what_is_written_says_what_it_is(scenario: Scenario, tmp_path: Path) -> None:
    """The folder has an experiment that can be read and the truth about it; the result shows itself."""
    lines: list[str] = []
    written = write_scenario(scenario, tmp_path / "new" / "out", progress=lines.append)
    (row,) = written.recordings
    experiment = load_experiment(Path(written.folder) / row.experiment)
    assert row.samples == sum(len(experiment.recording.stream(sensor.stream)) for sensor in experiment.sensors)
    truth = json.loads(Path(written.truth).read_text(encoding="utf-8"))
    assert truth["recordings"].keys() == {"fit"}
    assert lines == ["writing fit: random, 4 s"]
    require_shown(written)
    assert [record["recording"] for record in written.records()] == ["fit"]


def test_a_folder_that_is_there_is_kept(scenario: Scenario, tmp_path: Path) -> None:
    """Nothing is written over."""
    (tmp_path / "out").mkdir()
    with pytest.raises(ForceTorqueError, match=r"out: expected a new folder, it is there already"):
        write_scenario(scenario, tmp_path / "out")
    assert list((tmp_path / "out").iterdir()) == []


def test_a_scenario_that_cannot_be_written_leaves_nothing(
    scenario: Scenario, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The folder is there as a whole or not at all, with the parents that it needed."""

    def full(*_: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr(simulated, "write_recording", full)
    with pytest.raises(OSError, match="no space left"):
        write_scenario(scenario, tmp_path / "new" / "out")
    assert list(tmp_path.iterdir()) == []
