# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of Rerun, read back by its library: the same samples, stamps and frames, and a layout."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import MissingExtraError
from forcetorque.viewer.rerun_file import frame_entities, write_rrd
from forcetorque.viewer.scene_builder import BuiltScene
from forcetorque.viewer.viewer_log import viewer_log
from tests.app.outcome import Run
from tests.formats.ur_rtde.recordings import Tool, recorded, write_text

SINGLE = 1e-6
"""Rerun keeps poses and arrows in 24 bits."""


def rrd_columns(file: Path) -> tuple[dict[str, dict[str, list[Any]]], list[str]]:
    """Read columns over time by entity, and the kinds of what the file holds, by the library of Rerun."""
    reader = pytest.importorskip("rerun.chunk").RrdReader(file)
    found: dict[str, dict[str, list[Any]]] = {}
    for chunk in reader.stream():
        if not chunk.is_static and not chunk.entity_path.startswith("/__"):
            batch = chunk.to_record_batch()
            columns = found.setdefault(chunk.entity_path, {})
            for name in batch.schema.names:
                column = batch.column(name)
                is_time = name == "time"
                columns.setdefault(name, []).extend(column.cast("int64").to_pylist() if is_time else column.to_pylist())
    return found, [entry.kind for entry in (*reader.recordings(), *reader.blueprints())]


@pytest.mark.long
def test_the_file_reads_back(built: BuiltScene, tmp_path: Path) -> None:
    """Wrenches to the last bit with the stamps of the log, poses and arrows at theirs; events; and one layout."""
    pytest.importorskip("rerun")
    log, file = viewer_log(built), tmp_path / "view.rrd"
    assert write_rrd(file, log) == file.stat().st_size
    columns, kinds = rrd_columns(file)
    assert sorted(kinds) == ["blueprint", "recording"]
    for wrench in log.wrenches:
        for half, part in (("force", slice(3)), ("torque", slice(3, 6))):
            found = columns[f"/{wrench.name}/{half}"]
            assert found["time"] == log.stamp_ns[wrench.known].tolist()
            np.testing.assert_array_equal(found["Scalars:scalars"], wrench.values[wrench.known, part])
    places = frame_entities(log)
    for frame in log.frames:
        poses = frame.poses
        if len(poses) > 1:
            found = columns[f"/{places[frame.name]}"]
            assert found["time"] == log.pose_ns.tolist()
            np.testing.assert_allclose(np.squeeze(found["Transform3D:translation"]), poses[:, :3], atol=SINGLE)
            quat_xyzw = np.squeeze(found["Transform3D:quaternion"])
            np.testing.assert_allclose(quat_xyzw, poses[:, [4, 5, 6, 3]], atol=SINGLE)
    for wrench, tips in log.arrows():
        found = columns[f"/{places[wrench.frame]}/{wrench.name.replace('/', '_')}"]
        assert found["time"] == log.pose_ns.tolist()
        np.testing.assert_allclose(np.squeeze(found["Arrows3D:vectors"]), np.nan_to_num(tips), atol=SINGLE)
    texts = [text for (text,) in columns["/events"]["TextLog:text"]]
    assert sorted(texts) == sorted(event.text for event in log.events)


@pytest.mark.long
def test_a_load_of_a_log_reads_back(run: Run, tmp_path: Path) -> None:
    """The error of the measured wrench is noise; the answer is an event."""
    pytest.importorskip("rerun")
    log = write_text(tmp_path / "log.txt", recorded(Tool(), poses=10, samples=4, raw=True))
    ended = run("payload", log, "--view", tmp_path / "tool.rrd")
    assert ended.code == 0, ended.err
    columns, kinds = rrd_columns(tmp_path / "tool.rrd")
    assert sorted(kinds) == ["blueprint", "recording"]
    errors = np.array(columns["/wrist/logged/error/force"]["Scalars:scalars"])
    assert 0.0 < np.sqrt((errors**2).mean()) < 0.2
    assert any(text.startswith("payload: wrist") for (text,) in columns["/events"]["TextLog:text"])


def test_without_rerun_the_extra_is_named(built: BuiltScene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is written."""
    monkeypatch.setitem(sys.modules, "rerun", None)
    with pytest.raises(MissingExtraError, match=r"written by rerun-sdk: pip install 'forcetorque\[rerun\]'"):
        write_rrd(tmp_path / "view.rrd", viewer_log(built))
    assert list(tmp_path.iterdir()) == []
