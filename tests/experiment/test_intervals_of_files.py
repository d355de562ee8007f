# SPDX-License-Identifier: BSD-3-Clause
"""Many short recordings by a pattern: an interval for each file, labelled by its name."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.robot_and_streams import RecordedLog, load_recorded
from forcetorque.locomotion.standing.foot_wrenches import FootForces, load_foot_forces
from forcetorque.skin.patches_of_experiment import PatchExperiment
from forcetorque.skin.section import load_patches
from tests.payload.test_wrist_load import TEXT

INTERVALS = """\
[[interval]]
label = "{file} fit"
files = "poses"
end_s = 3
use = "calibration"

[[interval]]
label = "{file} judge"
files = "poses"
start_s = 3
use = "validation"
"""
ROWS = {"2.csv": 6, "10.csv": 5, "7.csv": 4}


def _write(folder: Path, intervals: str = INTERVALS, rows: dict[str, int] | None = None) -> Path:
    """Still poses in several files."""
    rng = np.random.default_rng(2)
    (folder / "raw").mkdir()
    for name, count in (rows or ROWS).items():
        down = rng.normal(size=(count, 3))
        values = np.hstack([rng.normal(size=(count, 6)), down / np.linalg.norm(down, axis=1, keepdims=True)])
        lines = ["a,b,c,d,e,f,x,y,z", *(",".join(f"{value:.9g}" for value in row) for row in values)]
        (folder / "raw" / name).write_text("\n".join(lines) + "\n")
    text = TEXT.replace('file = "poses.csv"', 'file = "raw/*.csv"')
    path = folder / "wrist.toml"
    path.write_text(text[: text.index("[[interval]]")] + intervals)
    return path


def test_every_file_has_its_intervals(tmp_path: Path) -> None:
    """In the order of numbers in their names, with the samples of the file from its own begin on, and no other."""
    recording = load_experiment(_write(tmp_path)).recording
    stamps = recording.stream("poses").stamp_ns
    held = {one.label: np.flatnonzero(one.holds(stamps)).tolist() for one in recording.intervals}
    assert held == {
        "2 fit": [0, 1, 2], "7 fit": [6, 7, 8], "10 fit": [10, 11, 12],
        "2 judge": [3, 4, 5], "7 judge": [9], "10 judge": [13, 14],
    }  # fmt: skip


def test_files_of_a_log_that_is_continued_have_theirs_too(tmp_path: Path) -> None:
    """Of every folder, in the order of time."""
    for number, folder in enumerate(("morning", "evening")):
        (tmp_path / folder / "raw").mkdir(parents=True)
        rows = [f"{10 * number + k},{k},1,2,3,4,5,0,0,-1" for k in range(4)]
        (tmp_path / folder / "raw" / f"{folder}.csv").write_text("\n".join(["t,a,b,c,d,e,f,x,y,z", *rows, ""]))
    text = TEXT.replace('"poses.csv"', '"raw/*.csv"').replace('"row"', '{ column = "t", unit = "s" }')
    text = text.replace('path = "."', 'path = "morning"\ncontinued_in = ["evening"]')
    file = tmp_path / "wrist.toml"
    file.write_text(f"{text[: text.index('[[interval]]')]}{INTERVALS}".replace("end_s = 3", "end_s = 2.5"))
    recording = load_experiment(file).recording
    stamps = recording.stream("poses").stamp_ns
    held = {one.label: np.flatnonzero(one.holds(stamps)).tolist() for one in recording.intervals}
    assert held == {"morning fit": [0, 1, 2], "evening fit": [4, 5, 6], "morning judge": [3], "evening judge": [7]}


ALONE = """\
schema = "forcetorque/experiment/1"
name = "without a force-torque sensor"

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "poses"
file = "raw/*.csv"
stamp = "row"
signal = [SIGNALS]

"""
FOOT = """\
[[sole]]
frame = "sole"
stream = "poses"

"""
SKIN = """\
[[patch]]
name = "palm"
serial = "P1"
counts = "poses"
pressure = "poses"

"""
OF_FOOT = '{ quantity = "vertical_force", columns = ["a"], units = ["N"] }'
OF_SKIN = """\
{ quantity = "taxel_counts", columns = ["a", "b"], units = ["counts", "counts"] },
{ quantity = "pressure", columns = ["c"], units = ["kPa"] }"""


@pytest.mark.parametrize(
    ("load", "source", "signals"),
    [(load_foot_forces, FOOT, OF_FOOT), (load_patches, SKIN, OF_SKIN), (load_recorded, "", OF_FOOT)],
)
def test_files_have_their_intervals_without_a_sensor(
    tmp_path: Path, load: Callable[[Path], FootForces | PatchExperiment | RecordedLog], source: str, signals: str
) -> None:
    """Feet with vertical forces, skin and a log alone are cut as a sensor is."""
    path = _write(tmp_path)
    path.write_text(ALONE.replace("SIGNALS", signals.replace("\n", " ")) + source + INTERVALS)
    loaded = load(path)
    stamps = loaded.recording.stream("poses").stamp_ns
    held = [int(((stamps >= one.start_ns) & (stamps < one.end_ns)).sum()) for one in loaded.intervals]
    assert [one.label for one in loaded.intervals] == [
        "2 fit", "7 fit", "10 fit", "2 judge", "7 judge", "10 judge",
    ]  # fmt: skip
    assert held == [3, 3, 3, 3, 1, 2]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('files = "poses"', 'files = "forces"', "expected a stream of text tables, got 'forces'; known: poses"),
        ('label = "{file} fit"', 'label = "fit"', 'expected "{file}" in the label of an interval with files'),
        ("end_s = 3", "end_s = 30", "2.csv has samples of 5 s, expected as many as from start_s = 0 to end_s = 30"),
        ('label = "{file} judge"', 'label = "{file} fit"', "2 intervals are labelled '2 fit'"),
        ("start_s = 3", "start_s = 2", "overlap"),
    ],
)
def test_what_no_file_can_have_is_refused(tmp_path: Path, old: str, new: str, message: str) -> None:
    """A stream that is not there, one label for all, a span longer than a file, samples that are fitted and judged."""
    with pytest.raises(ForceTorqueError) as raised:
        load_experiment(_write(tmp_path, INTERVALS.replace(old, new)))
    assert message in str(raised.value)


def test_an_interval_without_files_needs_its_start(tmp_path: Path) -> None:
    """It is 0 for files alone."""
    with pytest.raises(ForceTorqueError, match="start_s"):
        load_experiment(_write(tmp_path, '[[interval]]\nlabel = "all"\nuse = "calibration"\n'))
