# SPDX-License-Identifier: BSD-3-Clause
"""A campaign: one sensor over several recordings, under names that tell them apart."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.scenes.experiments import PARQUET, edit
from tests.scenes.studies import CALIBRATION, FILES, SENSOR, VALIDATION


def _campaign(folder: Path, files: Sequence[str] = FILES) -> Campaign:
    return Campaign([SensorRun(load_experiment(folder / file), SENSOR) for file in files])


def _without_session(folder: Path, files: Sequence[str] = FILES) -> None:
    for file in files:
        text = (folder / file).read_text(encoding="utf-8")
        lines = [line for line in text.splitlines() if not line.startswith("session")]
        (folder / file).write_text("\n".join(lines), encoding="utf-8")


def test_the_samples_are_those_of_the_runs_in_their_order(recorded: Path) -> None:
    """Readings, references and variables of every file, with the session that it states and its recording."""
    campaign = _campaign(recorded)
    data_sets = campaign.data_sets(Use.CALIBRATION, variables=["temperature"])
    assert [one.label for one in data_sets] == [file.removesuffix(".toml") for file in CALIBRATION]
    assert {one.session for one in data_sets} == {"power-up 0"}
    assert [one.recording for one in data_sets] == [f"arm {one.label}" for one in data_sets]
    assert campaign.recordings == campaign.experiments == tuple(f"arm {file.removesuffix('.toml')}" for file in FILES)
    for file, data in zip(CALIBRATION, data_sets, strict=True):
        (samples,) = SensorRun(load_experiment(recorded / file), SENSOR).samples(
            Use.CALIBRATION, variables=["temperature"]
        )
        assert np.array_equal(data.raw, samples.raw)
        assert np.array_equal(data.reference, samples.samples.reference)
        assert np.array_equal(data.variables, samples.samples.variables)
    judged = campaign.samples(Use.VALIDATION)
    assert [(one.label, one.session) for one in judged] == [("day_1", "power-up 1"), ("day_2", "power-up 2")]


def test_a_run_by_itself_is_a_campaign_with_the_names_of_its_file(intact: Path) -> None:
    """Labels and inputs are those of the file; both intervals are of the recording's one session."""
    run = SensorRun(load_experiment(intact / PARQUET), "arm_ft")
    campaign = Campaign(run)
    (fitted,), (judged,) = campaign.samples(Use.CALIBRATION), campaign.samples(Use.VALIDATION)
    assert (fitted.label, judged.label) == ("fit", "judge")
    assert fitted.session == judged.session == fitted.recording == "small arm"
    assert campaign.inputs_sha256 == run.experiment.inputs_sha256
    assert (campaign.sensor, campaign.identity) == (run.sensor, run.identity)
    assert (fitted.fitted.session, fitted.fitted.experiment) == ("small arm", "small arm")


def test_a_session_left_out_is_one_per_recording(days: Path) -> None:
    """Whatever other files state, and whatever the label is."""
    _without_session(days, CALIBRATION)
    campaign = _campaign(days)
    data_sets = campaign.data_sets(Use.CALIBRATION)
    assert [one.session for one in data_sets] == [f"arm {file.removesuffix('.toml')}" for file in CALIBRATION]
    assert [one.session for one in campaign.samples(Use.VALIDATION)] == ["power-up 1", "power-up 2"]


def test_recordings_of_one_name_are_sessions_of_their_own(days: Path) -> None:
    """They are told apart by their file, and a session that a file states is still shared."""
    _without_session(days, CALIBRATION[:2])
    for file in CALIBRATION:
        edit(days / file, f'name = "arm {file.removesuffix(".toml")}"', 'name = "arm"')
    campaign = _campaign(days, CALIBRATION)
    data_sets = campaign.data_sets(Use.CALIBRATION)
    assert [one.session for one in data_sets] == ["arm (grid_cold)", "arm (grid_warm)", "power-up 0", "power-up 0"]
    assert [one.recording for one in data_sets] == [f"arm ({file.removesuffix('.toml')})" for file in CALIBRATION]
    assert campaign.experiments == ("arm",) * 4


def test_a_session_that_another_file_states_is_not_taken_for_the_recording(days: Path) -> None:
    """A file without a session whose experiment has the name of another file's session."""
    _without_session(days, CALIBRATION[:1])
    edit(days / CALIBRATION[0], 'name = "arm grid_cold"', 'name = "power-up 0"')
    sessions = [one.session for one in _campaign(days, CALIBRATION[:2]).data_sets(Use.CALIBRATION)]
    assert sessions == ["power-up 0 (grid_cold)", "power-up 0"]


def test_files_of_one_name_get_their_folders(days: Path, tmp_path: Path) -> None:
    """Labels, sessions and recordings alike."""
    _without_session(days)
    other = Path(shutil.copytree(days, tmp_path / "again"))
    campaign = Campaign(
        [SensorRun(load_experiment(folder / "move_cold.toml"), SENSOR) for folder in (days, other)],
    )
    fitted = campaign.samples(Use.CALIBRATION)
    assert [one.label for one in fitted] == ["days/move_cold/move_cold", "again/move_cold/move_cold"]
    assert [one.session for one in fitted] == ["arm move_cold (days/move_cold)", "arm move_cold (again/move_cold)"]
    for run, one in zip(campaign.runs, fitted, strict=True):
        # whoever reads the file by itself finds the session of the campaign
        assert one.session in run.experiment.session_names("move_cold")
        assert len({other.session for other in fitted} & set(run.experiment.session_names("move_cold"))) == 1


def test_another_robot_is_no_other_sensor(days: Path) -> None:
    """A tool that was changed is another URDF with another name; the sensor is where it was."""
    shutil.copyfile(days / "robot.urdf", days / "tool.urdf")
    edit(days / "tool.urdf", 'robot name="arm"', 'robot name="arm with a tool"')
    edit(days / "move_cold.toml", "robot.urdf", "tool.urdf")
    campaign = _campaign(days, CALIBRATION)
    assert campaign.identity.robot == "arm"
    assert len(campaign.data_sets(Use.CALIBRATION)) == len(CALIBRATION)


def _another_serial(file: Path) -> None:
    edit(file, 'serial = "SIM001"', 'serial = "SIM002"')


def _no_prior(file: Path) -> None:
    edit(file, 'prior = "matrix_SIM001.txt"\n', "")


def _another_direction(file: Path) -> None:
    shutil.copyfile(file.parent / "robot.urdf", file.parent / "turned.urdf")
    edit(file.parent / "turned.urdf", "child_to_parent", "parent_to_child")
    edit(file, "robot.urdf", "turned.urdf")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (_another_serial, "serial number of .*grid_cold.toml, SIM001, got SIM002; .* leave one of the two out"),
        (_no_prior, "prior matrix of .*grid_cold.toml, got another; .* specify the same in both"),
        (_another_direction, "mounting .*child_to_parent, got .*parent_to_child"),
    ],
)
def test_another_sensor_is_refused(days: Path, change: Callable[[Path], None], message: str) -> None:
    """Or one that is read in another way, by the rules of a study."""
    change(days / "move_warm.toml")
    with pytest.raises(ExperimentError, match=message):
        _campaign(days, ("grid_cold.toml", "move_warm.toml"))


def test_a_file_twice_and_no_file_are_refused(days: Path) -> None:
    """Samples would count twice; without a run there is no sensor."""
    with pytest.raises(ExperimentError, match=r"grid_cold\.toml: expected every experiment file once"):
        _campaign(days, ("grid_cold.toml", "grid_cold.toml"))
    with pytest.raises(ExperimentError, match="at least one run of a sensor, got none"):
        Campaign([])


def test_a_use_that_no_file_has_is_refused(recorded: Path) -> None:
    """One file that has it is enough."""
    assert len(_campaign(recorded, (CALIBRATION[0], VALIDATION[0])).samples(Use.VALIDATION)) == 1
    with pytest.raises(ExperimentError, match='expected an interval with use = "validation", it has none'):
        _campaign(recorded, CALIBRATION).samples(Use.VALIDATION)


@pytest.mark.long
def test_the_artefact_says_what_lambda_was_chosen_on(recorded: Path) -> None:
    """Whole recordings where there are several, else pieces of the one."""
    options = {"regularisation": "held-out", "kind": ESTIMATION_TYPES["OnTdTO"], "code_version": "1", "created": "now"}
    several = calibrate_sensor(_campaign(recorded, CALIBRATION), **options)
    single = calibrate_sensor(_campaign(recorded, CALIBRATION[:1]), **options)
    assert several.selection.rule.endswith("; blocks are whole recordings")
    assert single.selection.rule.endswith("; blocks are equal contiguous pieces of the intervals")
