# SPDX-License-Identifier: BSD-3-Clause
"""Datasets of LeRobot: v2.1 and v3.0 are read alike, by names of elements, with made-up times that say so."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.lerobot.dataset import dataset_of_file, read_dataset
from forcetorque.formats.lerobot.log_format import LeRobotFormat, LeRobotLog
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.registry import format_name, recognised_format
from forcetorque.formats.tabular.row_readers import columnar_file
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.inspect import inspect_log
from tests.formats.lerobot.datasets import FPS, WRENCH, tool_episodes, write_dataset

EPISODES = tool_episodes([40, 30, 50])
VERSIONS = ("v2.1", "v3.0")


def read(root: Path, episode: int = 1, **signal: Any) -> LogReading:
    """Read the wrench of an episode."""
    stated = {
        "quantity": "wrench",
        "columns": [f"observation.wrench.{name}" for name in WRENCH],
        "units": ["N"] * 3 + ["N m"] * 3,
        "frame": "sensor",
    }
    stream = {"name": "arm", "signal": [stated | signal]}
    table = LeRobotLog.model_validate({"format": "lerobot", "path": root, "episode": episode, "stream": [stream]})
    context = ExperimentContext(experiment=root / "x.toml", inputs=Inputs(root), sensors={}, joint_units={})
    return LeRobotFormat().read(table, context)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("variable_lists", [False, True])
def test_an_episode_is_read(tmp_path: Path, version: str, variable_lists: bool) -> None:
    """By names of elements, from fixed and variable lists, and from the second file of several."""
    root = write_dataset(tmp_path / "d", EPISODES, version=version, per_file=2, variable_lists=variable_lists)
    for number, frames in enumerate(EPISODES):
        (stream,) = read(root, number).streams
        np.testing.assert_array_equal(stream.signals["wrench"].values, frames["observation.wrench"])
        assert len(stream) == len(frames["observation.wrench"])


def test_row_groups_without_the_episode_are_left_out(tmp_path: Path) -> None:
    """By their statistics; where a file has none, or groups hold several episodes, the same frames are read."""
    root = write_dataset(tmp_path / "d", EPISODES)
    file = root / "data" / "chunk-000" / "file-000.parquet"
    whole, lengths = pq.read_table(file), []
    expected = EPISODES[1]["observation.wrench"]
    for options in ({}, {"row_group_size": 50}, {"write_statistics": False}):
        if options:
            pq.write_table(whole, file, **options)
        _, batches = columnar_file(file)
        lengths.append(sum(map(len, batches(["episode_index"], holding=("episode_index", 1)))))
        np.testing.assert_array_equal(read(root, 1).streams[0].signals["wrench"].values, expected)
    assert lengths == [30, 100, 120]


def test_times_are_made_up_and_say_so(tmp_path: Path) -> None:
    """Stamps are even; the finding names the rate and that no delay is seen."""
    reading = read(write_dataset(tmp_path / "d", EPISODES))
    (stream,), (finding,) = reading.streams, reading.findings
    np.testing.assert_array_equal(np.diff(stream.stamp_ns), round(1e9 / FPS))
    assert (finding.kind, finding.size) == ("stated_rate", FPS)
    assert "made up" in finding.message
    assert "delays" in finding.message


@pytest.mark.parametrize("version", VERSIONS)
def test_dataset_and_file_are_recognised(tmp_path: Path, version: str) -> None:
    """A dataset, and any of its files of frames; a table beside them is a table."""
    root = write_dataset(tmp_path / "d", EPISODES, version=version)
    files = sorted(root.glob("data/*/*.parquet"))
    assert files
    for path in (root, *files):
        known = recognised_format(path)
        assert known is not None
        assert format_name(known) == "lerobot"
    other = tmp_path / "other.parquet"
    pq.write_table(pa.table({"t": [0.0, 0.1]}), other)
    known = recognised_format(other)
    assert known is not None
    assert format_name(known) == "tabular"
    assert dataset_of_file(other) is None


@pytest.mark.parametrize(
    ("names", "label"),
    [
        (["fx", "fy", "fz"], "force.fx"),
        ({"motors": ["fx", "fy", "fz"]}, "force.fx"),
        ([["fx", "fy", "fz"]], "force.fx"),
        ({"fz": 2, "fx": 0, "fy": 1}, "force.fx"),
        (None, "force[0]"),
        (["fx", "fy"], "force[0]"),
        (["fx", "fx", "fy"], "force[0]"),
    ],
)
def test_names_of_elements(tmp_path: Path, names: Any, label: str) -> None:
    """In every form that datasets have; places where there is not one name for each element."""
    root = write_dataset(tmp_path / "d", [{"force": np.zeros((4, 3))}], names={"force": names})
    assert next(iter(read_dataset(root).labels)) == label


def test_draft_asks_what_the_format_lacks(tmp_path: Path) -> None:
    """Episode, units, sense and direction are questions; names and rate are not."""
    root = write_dataset(tmp_path / "d", EPISODES)
    text = draft_experiment(root, tmp_path / "x.toml").content
    for asked in ('episode = "?"', 'units = "?"', 'sense = "?"', 'measure_direction = "?"'):
        assert asked in text
    assert 'format = "lerobot"' in text
    assert '"observation.wrench.fx"' in text
    one = draft_experiment(
        write_dataset(tmp_path / "e", EPISODES, version="v2.1") / "data" / "chunk-000" / "episode_000002.parquet",
        tmp_path / "y.toml",
    ).content
    assert "episode = 2\n" in one
    assert 'path = "e"' in one


def test_inspection_names_columns_and_times(tmp_path: Path) -> None:
    """Every element with its range over all episodes, and what the times are."""
    inspection = inspect_log(write_dataset(tmp_path / "d", EPISODES))
    rows = {row.column: row for row in inspection.unread}
    every = np.concatenate([episode["observation.wrench"] for episode in EPISODES])
    assert rows["observation.wrench.fx"].largest == pytest.approx(every[:, 0].max())
    assert rows["observation.wrench.fx"].looks_like == "wrench"
    assert inspection.times is not None
    assert "3 episode(s)" in inspection.times


def _changed_info(root: Path, **changes: Any) -> None:
    file = root / "meta" / "info.json"
    file.write_text(json.dumps(json.loads(file.read_text(encoding="utf-8")) | changes), encoding="utf-8")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"codebase_version": "v1.6"}, "codebase_version: expected v2.1 or v3.0"),
        ({"fps": 0}, "fps: expected frames per second above 0"),
        ({"data_path": "../{chunk_index:03d}.parquet"}, "below the folder"),
        ({"data_path": "{chunk_index.__class__}.parquet"}, "below the folder"),
        ({"data_path": "data/{user}.parquet"}, "known: chunk_index, file_index"),
        ({"features": {"a": 1}}, "expected dtype and shape"),
    ],
)
def test_damaged_descriptions_are_refused(tmp_path: Path, changes: dict[str, Any], message: str) -> None:
    """With the key that is wrong; no path leads out of the dataset."""
    root = write_dataset(tmp_path / "d", EPISODES[:1])
    _changed_info(root, **changes)
    with pytest.raises(FormatError, match=message):
        read_dataset(root).episodes  # noqa: B018


def test_frames_that_contradict_the_description_are_refused(tmp_path: Path) -> None:
    """A feature that the file lacks, or of another width, an episode that is not there, frames out of order."""
    root = write_dataset(tmp_path / "d", EPISODES)
    with pytest.raises(FormatError, match="expected a number from 0 to 2, got 3"):
        read(root, 3)
    with pytest.raises(FormatError, match='did you mean "observation.wrench.fx"'):
        read(root, columns=["observation.wrench.fxx", *(f"observation.wrench.f{axis}" for axis in "yzxyz")])
    file = root / "data" / "chunk-000" / "file-000.parquet"
    whole = pq.read_table(file)
    for table, message in (
        (whole.drop_columns(["observation.wrench"]), "expected 6 number"),
        (whole.drop_columns(["frame_index"]), "expected a column frame_index"),
        (whole.slice(1), "expected 40 rows|frame_index: expected 0"),
        (whole.take(list(range(len(whole)))[::-1]), "frame_index: expected 0, got 39"),
    ):
        pq.write_table(table, file)
        with pytest.raises(FormatError, match=message):
            read(root, 0)


@pytest.mark.real_data
@pytest.mark.parametrize("name", ["wrench_v21", "wrench_v30"])
def test_official_datasets_are_read(data_dir: Path, name: str) -> None:
    """Both layouts hold the same frames; episode 2 has the fault that its truth names."""
    folder = data_dir / "lerobot_wrench"
    (stream,) = read(folder / name, 2).streams
    wrench = stream.signals["wrench"].values
    assert wrench.shape == (200, 6)
    assert (wrench[100:, 3] == np.float32(0.123)).all()
