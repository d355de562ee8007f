# SPDX-License-Identifier: BSD-3-Clause
"""The skin of an experiment in its report: contacts of every patch, and a heuristic that is named one."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError
from forcetorque.estimation.figures import torque_figure
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Recording
from forcetorque.report.experiment_assessment import ExperimentAssessment, assess_experiment
from forcetorque.report.sensor_assessment import Demands
from forcetorque.results.document.content import Figure, List, Section, Text
from forcetorque.results.table import Table
from forcetorque.skin.figures import skin_event_figure
from forcetorque.skin.report_blocks import skin_section
from forcetorque.skin.section import PATCHES
from forcetorque.skin.wrench.result import skin_event_rows
from forcetorque.skin.wrench.skin_wrench import skin_wrench
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, edit
from tests.scenes.skin_arm import EVENT, EVENT_S, EVENTS, PATCH, SKIN, write_skin_arm


@pytest.fixture(scope="module", name="folder")
def skin_folder(intact: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with skin on the arm; nobody changes it."""
    folder = tmp_path_factory.mktemp("skin")
    write_skin_arm(intact, folder)
    return folder


@pytest.fixture(scope="module", name="assessed")
def skin_assessed(folder: Path) -> ExperimentAssessment:
    """All that is said about it."""
    return assess_experiment(load_experiment(folder / SKIN), {}, file=SKIN, demands=Demands())


def _texts(section: Section) -> str:
    return "\n".join(block.text for block in section.blocks if isinstance(block, Text))


@pytest.mark.long
def test_the_contacts_are_those_of_the_command(folder: Path, assessed: ExperimentAssessment) -> None:
    """Numbers and pictures of `skin wrench`; the JSON has every contact."""
    alone = skin_wrench(folder / SKIN, folder / "shank.json")
    (patch,) = assessed.skin
    assert patch.model_dump(exclude={"picture"}) == alone.model_dump(exclude={"picture"})
    assert len(assessed.model_dump(mode="json")["skin"][0]["contacts"]) == len(alone.contacts) > 20
    section = skin_section(assessed)
    tables = [block.caption for block in section.blocks if isinstance(block, Table)]
    assert tables[0].startswith(f"{PATCH}: contacts, force ± standard deviation")
    assert len([block for block in section.blocks if isinstance(block, Figure)]) == 2


@pytest.mark.long
def test_the_heuristic_is_told_apart(assessed: ExperimentAssessment) -> None:
    """Its row counts messages and contacts; words and captions say that it is no newtons."""
    (row,) = assessed.skin_events
    expected = round((EVENT_S[1] - EVENT_S[0]) * 50.0)
    assert (row.stream, row.messages_with_contact, row.contacts, row.most) == (EVENTS, expected, expected, 1)
    assert row.largest_heuristic == pytest.approx(float(np.linalg.norm(EVENT[4:7])))
    section = skin_section(assessed)
    assert "it is no newtons" in _texts(section)
    captions = [block.caption for block in section.blocks if isinstance(block, (Table, Figure))]
    assert len([caption for caption in captions if "not newtons" in caption]) == 2
    assert not any(name.endswith("_N") for name in type(row).model_fields)


def test_another_clock_is_not_laid_beside(folder: Path) -> None:
    """Contacts that another clock stamped have no instant in the recording."""
    streams = dict(load_experiment(folder / SKIN).recording.streams)
    assert len(skin_event_rows(Recording(streams=streams))[0]) == 1
    streams[EVENTS] = replace(streams[EVENTS], clock="yarp sender")
    assert skin_event_rows(Recording(streams=streams)) == ((), ())


def test_without_skin_there_is_no_section(intact: Path) -> None:
    """An experiment of sensors alone says nothing of skin."""
    experiment = load_experiment(intact / PARQUET)
    assert experiment.section(PATCHES) is None
    assessed = assess_experiment(experiment, {}, file=PARQUET, demands=Demands())
    assert skin_section(assessed).blocks == ()


@some_cases(
    ("old", "new", "words"),
    [('table = "shank.json"\n', "", "states no table"), ('serial = "S1"', 'serial = "S2"', "its own table")],
)
def test_a_patch_that_cannot_be_read_is_said(folder: Path, tmp_path: Path, old: str, new: str, words: str) -> None:
    """It does not cost the document."""
    copy = Path(shutil.copytree(folder, tmp_path / "copy"))
    edit(copy / SKIN, old, new)
    assessed = assess_experiment(load_experiment(copy / SKIN), {}, file=SKIN, demands=Demands())
    assert assessed.skin == ()
    (points,) = (block.points for block in skin_section(assessed).blocks if isinstance(block, List))
    assert words in points[0]


def test_torques_state_their_error_and_refuse_what_does_not_fit() -> None:
    """The legend has the root mean square over all joints; a deviation of no estimate is refused."""
    time, truth = np.arange(50) * 0.1, np.zeros((50, 2))
    skin = np.column_stack([np.full(50, 0.3), np.full(50, -0.4)])
    figure = torque_figure(time, ("knee", "hip"), {"skin": skin}, reference=("truth", truth))
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["skin: RMSE 0.354 N m", "truth"]
    with pytest.raises(ShapeError, match="got one of 'ft'"):
        torque_figure(time, ("knee", "hip"), {"skin": skin}, deviations={"ft": skin})
    with pytest.raises(ShapeError, match="reference"):
        torque_figure(time, ("knee", "hip"), {"skin": skin}, reference=("truth", truth[:9]))
    with pytest.raises(ShapeError, match="at least one to draw"):
        torque_figure(time, (), {"skin": skin})
    with pytest.raises(ShapeError, match="at least one stream"):
        skin_event_figure(())
