# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS 2 in MCAP, read back by rosbags and by the library of MCAP: the same samples, stamps and frames."""

from __future__ import annotations

import json
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import MissingExtraError
from forcetorque.formats.ros.bag import opened_bag, typestore
from forcetorque.viewer.mcap_and_foxglove_files import layout_file, write_layout, write_mcap
from forcetorque.viewer.scene_builder import BuiltScene
from forcetorque.viewer.viewer_log import ViewerLog, viewer_log

pytest.importorskip("rosbags")
_NANO = 1_000_000_000


@pytest.fixture(scope="module")
def log(built: BuiltScene) -> ViewerLog:
    """Log of the intact experiment."""
    return viewer_log(built)


@pytest.fixture(scope="module")
def bag(log: ViewerLog, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The log as a bag."""
    file = tmp_path_factory.mktemp("mcap") / "view.mcap"
    assert write_mcap(file, log) == file.stat().st_size
    assert [path.name for path in file.parent.iterdir()] == ["view.mcap"]
    write_layout(file, log)
    return file


@pytest.fixture(scope="module")
def messages(bag: Path) -> dict[str, list[tuple[int, Any]]]:
    """Stamps of the log and messages by topic, as rosbags reads them."""
    types, found = typestore(bag), defaultdict[str, list[tuple[int, Any]]](list)
    with opened_bag(bag) as opened:
        for topic, kind in opened.types.items():
            for stamps, data in opened.messages(topic):
                for stamp, message in zip(stamps.tolist(), data, strict=True):
                    found[topic].append((stamp, types.deserialize_cdr(message, kind)))
                    # no byte beside those that rosbags writes
                    assert bytes(types.serialize_cdr(found[topic][-1][1], kind)) == bytes(message)
    return found


def _stamp(header: Any) -> int:
    return int(header.stamp.sec * _NANO + header.stamp.nanosec)


def test_every_wrench_is_a_topic(log: ViewerLog, messages: dict[str, list[tuple[int, Any]]]) -> None:
    """WrenchStamped with the stamps, frames and numbers of the log; instants without a wrench have no message."""
    assert log.wrenches
    for wrench in log.wrenches:
        found = messages[f"/{wrench.name}"]
        assert [stamp for stamp, _ in found] == log.stamp_ns[wrench.known].tolist()
        assert {message.header.frame_id for _, message in found} == {wrench.frame}
        assert all(_stamp(message.header) == stamp for stamp, message in found)
        halves = ((message.wrench.force, message.wrench.torque) for _, message in found)
        values = [[part for half in both for part in (half.x, half.y, half.z)] for both in halves]
        np.testing.assert_array_equal(values, wrench.values[wrench.known])


def test_frames_are_transforms(log: ViewerLog, messages: dict[str, list[tuple[int, Any]]]) -> None:
    """What stays goes by /tf_static once, what moves by /tf at every pose."""
    moving = [frame for frame in log.frames if len(frame.poses) > 1]
    staying = [frame for frame in log.frames if len(frame.poses) == 1]
    for topic, frames, stamps in (("/tf", moving, log.pose_ns), ("/tf_static", staying, log.pose_ns[:1])):
        assert frames
        assert [stamp for stamp, _ in messages[topic]] == stamps.tolist()
        for row, (stamp, message) in enumerate(messages[topic]):
            for frame, one in zip(frames, message.transforms, strict=True):
                move, turn = one.transform.translation, one.transform.rotation
                assert (one.header.frame_id, one.child_frame_id) == (frame.parent, frame.name)
                assert _stamp(one.header) == stamp
                assert [move.x, move.y, move.z, turn.w, turn.x, turn.y, turn.z] == frame.poses[row].tolist()


def test_the_robot_and_its_joints_are_in_the_bag(log: ViewerLog, messages: dict[str, list[tuple[int, Any]]]) -> None:
    """The URDF as it is, and the coordinates of the joints."""
    assert log.urdf is not None
    ((_, description),) = messages["/robot_description"]
    assert description.data == log.urdf.read_text(encoding="utf-8")
    states = [message for _, message in messages["/joint_states"]]
    assert {tuple(state.name) for state in states} == {log.joints}
    np.testing.assert_array_equal([state.position for state in states], log.positions)


def test_arrows_point_to_the_tips(log: ViewerLog, messages: dict[str, list[tuple[int, Any]]]) -> None:
    """From the origin of the frame of each wrench; of no length where there is no wrench."""
    arrows = list(log.arrows())
    assert arrows
    for row, (_, message) in enumerate(messages["/arrows"]):
        for (wrench, tips), marker in zip(arrows, message.markers, strict=True):
            start, end = marker.points
            assert (marker.header.frame_id, marker.ns, marker.type) == (wrench.frame, wrench.name, marker.ARROW)
            assert (start.x, start.y, start.z) == (0.0, 0.0, 0.0)
            assert [end.x, end.y, end.z] == np.nan_to_num(tips[row]).tolist()


def test_events_are_log_messages(log: ViewerLog, messages: dict[str, list[tuple[int, Any]]]) -> None:
    """Findings warn, intervals inform."""
    found = [(stamp, message.msg, message.level >= message.WARN) for stamp, message in messages["/rosout"]]
    assert found == [(event.stamp_ns, event.text, event.is_warning) for event in log.events]


def test_the_library_of_mcap_reads_the_same(bag: Path, messages: dict[str, list[tuple[int, Any]]]) -> None:
    """In the order of time, with schemas of ROS 2."""
    reader = pytest.importorskip("mcap.reader")
    counts, last = defaultdict[str, int](int), 0
    with bag.open("rb") as stream:
        for schema, channel, message in reader.make_reader(stream, validate_crcs=True).iter_messages():
            assert (schema.encoding, channel.message_encoding) == ("ros2msg", "cdr")
            assert message.log_time >= last
            last = message.log_time
            counts[channel.topic] += 1
    assert counts == {topic: len(found) for topic, found in messages.items()}


def _panels(node: Any, configurations: dict[str, Any]) -> Iterator[str]:
    """Panels of a tree and of the tabs in it."""
    if isinstance(node, str):
        yield node
        for tab in configurations[node].get("tabs", ()):
            yield from _panels(tab["layout"], configurations)
    else:
        assert node["direction"] in ("row", "column")
        assert 0.0 < node["splitPercentage"] < 100.0
        for part in ("first", "second"):
            yield from _panels(node[part], configurations)


def _field(message: Any, path: str) -> float:
    for name in path.split("."):
        message = getattr(message, name)
    return float(message)


def test_the_layout_shows_what_the_bag_has(
    bag: Path, log: ViewerLog, messages: dict[str, list[tuple[int, Any]]]
) -> None:
    """Every panel stands in the tree once; its topics, types and fields are those of the bag."""
    with opened_bag(bag) as opened:
        types = opened.types
    layout = json.loads(layout_file(bag).read_bytes())
    configurations = layout["configById"]
    assert sorted(_panels(layout["layout"], configurations)) == sorted(configurations)
    by_kind = defaultdict[str, list[Any]](list)
    for name, configuration in configurations.items():
        by_kind[name.partition("!")[0]].append(configuration)
    (scene,), (events,) = by_kind["3D"], by_kind["RosOut"]
    kinds = {topic: types[topic] for topic in scene["topics"]}
    assert kinds == {
        "/robot_description": "std_msgs/msg/String",
        "/arrows": "visualization_msgs/msg/MarkerArray",
    }
    assert scene["followTf"] in {
        one.header.frame_id for _, message in messages["/tf_static"] for one in message.transforms
    }
    assert types[events["topicToRender"]] == "rcl_interfaces/msg/Log"
    assert events["minLogLevel"] <= min(message.level for _, message in messages["/rosout"]) // 10
    shown = defaultdict[str, set[str]](set)
    for plot in by_kind["Plot"]:
        assert plot["paths"]
        for path in plot["paths"]:
            topic, _, field = path["value"].partition(".")
            assert types[topic] == "geometry_msgs/msg/WrenchStamped"
            assert np.isfinite(_field(messages[topic][0][1], field))
            assert ("error" in plot["title"]) is topic.endswith("/error")
            shown[topic].add(field)
    assert set(shown) == {f"/{wrench.name}" for wrench in log.wrenches if len(wrench.known)}
    assert {len(fields) for fields in shown.values()} == {6}


def test_without_rosbags_the_extra_is_named(log: ViewerLog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is written."""
    monkeypatch.setitem(sys.modules, "rosbags.typesys", None)
    with pytest.raises(MissingExtraError, match=r"MCAP is written by rosbags: pip install 'forcetorque\[ros\]'"):
        write_mcap(tmp_path / "view.mcap", log)
    assert list(tmp_path.iterdir()) == []
