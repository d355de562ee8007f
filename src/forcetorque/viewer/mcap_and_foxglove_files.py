# SPDX-License-Identifier: BSD-3-Clause
"""A scene as a bag of ROS 2 in one MCAP file, and the layout in which Foxglove opens it.

Messages of a topic differ in stamps and numbers alone: one is made by rosbags, and its bytes are the template of all.

References:
[1] foxglove/studio (MPL-2.0), packages/studio-base/src/providers/CurrentLayoutProvider/defaultLayout.ts: panels by
    `TYPE!ID` in `configById`, and a binary tree of them in `layout`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.formats.ros.bag import mcap_writer, typestore
from forcetorque.results.figure_style import COLOURS, REFERENCE_COLOUR
from forcetorque.viewer.viewer_log import LoggedFrame, LoggedWrench, ViewerLog

DESCRIPTION, ARROWS, EVENTS = "/robot_description", "/arrows", "/rosout"
"""Topics of the URDF, of forces as arrows, and of events."""
_SHAFT_M, _HEAD_M = 0.012, 0.025
_INFORMATION, _WARNING = 20, 30
"""Levels of rcl_interfaces/msg/Log."""
_NANO = 1_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Messages:
    """Messages of a topic, one for each row."""

    topic: str
    type: str
    stamp_ns: IntArray
    rows: Sequence[bytes]
    latched: bool = False


class _Mark:
    """Numbers that stand in a template where others are put in later; no number of a message is like one of them."""

    def __init__(self) -> None:
        self.count = 0

    def double(self) -> float:
        self.count += 1
        return float(np.frombuffer(np.uint64(0x7A5B_C3D1_0000_0000 + self.count).tobytes(), dtype="<f8")[0])

    @staticmethod
    def stamp(types: Any) -> Any:
        return types["builtin_interfaces/msg/Time"](sec=0x5AC3_71B9, nanosec=0xC5D2_96E7)


def write_mcap(path: Path, log: ViewerLog) -> int:
    """Write a log as MCAP with messages of ROS 2.

    Topics: `/tf` and `/tf_static`; `/joint_states`; `/robot_description` with the URDF; a
    geometry_msgs/msg/WrenchStamped for every wrench of the log, `/SENSOR/expected`, `/SENSOR/SERIES` and
    `/SENSOR/SERIES/error`; `/arrows` with forces as visualization_msgs/msg/MarkerArray; `/rosout` with events.

    Args:
        path: File to write or to replace.
        log: The log.

    Returns:
        Its size; bytes.
    """
    types = typestore(path)
    topics = [
        *_transforms(log, types),
        *_joint_states(log, types),
        *_description(log, types),
        *_wrenches(log, types),
        *_arrows(log, types),
        *_events(log, types),
    ]
    with mcap_writer(path) as writer:
        connections = [
            writer.add_connection(one.topic, one.type, typestore=types, offered_qos_profiles=_quality(one))
            for one in topics
        ]
        for topic, row in _in_time(topics):
            writer.write(connections[topic], int(topics[topic].stamp_ns[row]), topics[topic].rows[row])
    return path.stat().st_size


def _in_time(topics: Sequence[_Messages]) -> Iterator[tuple[int, int]]:
    """Topic and row of all messages, by their stamps."""
    stamps = np.concatenate([one.stamp_ns for one in topics])
    numbers = np.repeat(np.arange(len(topics)), [len(one.stamp_ns) for one in topics])
    rows = np.concatenate([np.arange(len(one.stamp_ns)) for one in topics])
    order = np.argsort(stamps, kind="stable")
    return zip(numbers[order].tolist(), rows[order].tolist(), strict=True)


def _quality(topic: _Messages) -> Sequence[Any]:
    if not topic.latched:
        return ()
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime

    never = QosTime(sec=2147483647, nsec=4294967295)
    return (
        Qos(
            history=QosHistory.KEEP_LAST,
            depth=1,
            reliability=QosReliability.RELIABLE,
            durability=QosDurability.TRANSIENT_LOCAL,
            deadline=never,
            lifespan=never,
            liveliness=QosLiveliness.AUTOMATIC,
            liveliness_lease_duration=never,
            avoid_ros_namespace_conventions=False,
        ),
    )


def _filled(
    types: Any, kind: str, message: Any, marks: Sequence[float], values: FloatArray, stamp_ns: IntArray
) -> list[bytes]:
    """Messages like one, with other stamps, and at its marks other numbers, of shape (rows, marks)."""
    template = bytes(types.serialize_cdr(message, kind))
    block = np.tile(np.frombuffer(template, dtype=np.uint8), (len(stamp_ns), 1))
    times = np.stack([stamp_ns // _NANO, stamp_ns % _NANO], axis=1).astype("<u4")
    mark = _Mark.stamp(types.types)
    at = 0
    pattern = np.array([mark.sec, mark.nanosec], dtype="<u4").tobytes()
    while (at := template.find(pattern, at)) >= 0:
        block[:, at : at + 8] = times.view(np.uint8)
        at += 8
    for column, number in enumerate(marks):
        place = template.index(np.array(number, dtype="<f8").tobytes())
        block[:, place : place + 8] = _bytes(values[:, column])
    return [row.tobytes() for row in block]


def _bytes(values: FloatArray) -> npt.NDArray[np.uint8]:
    return np.ascontiguousarray(values, dtype="<f8").view(np.uint8).reshape(-1, 8)


def _header(types: Any, frame: str) -> Any:
    return types.types["std_msgs/msg/Header"](stamp=_Mark.stamp(types.types), frame_id=frame)


def _transforms(log: ViewerLog, types: Any) -> Iterator[_Messages]:
    for topic, is_static in (("/tf_static", True), ("/tf", False)):
        frames = [frame for frame in log.frames if (len(frame.poses) == 1) is is_static]
        stamp_ns = log.pose_ns[:1] if is_static else log.pose_ns
        if frames:
            kind = "tf2_msgs/msg/TFMessage"
            rows = _transform_rows(frames, types, kind, stamp_ns)
            yield _Messages(topic=topic, type=kind, stamp_ns=stamp_ns, rows=rows, latched=is_static)


def _transform_rows(frames: Sequence[LoggedFrame], types: Any, kind: str, stamp_ns: IntArray) -> list[bytes]:
    known, mark, marks, transforms = types.types, _Mark(), list[float](), []
    for frame in frames:
        x, y, z, qw, qx, qy, qz = numbers = [mark.double() for _ in range(7)]
        marks += numbers
        transforms.append(
            known["geometry_msgs/msg/TransformStamped"](
                header=_header(types, frame.parent),
                child_frame_id=frame.name,
                transform=known["geometry_msgs/msg/Transform"](
                    translation=known["geometry_msgs/msg/Vector3"](x=x, y=y, z=z),
                    rotation=known["geometry_msgs/msg/Quaternion"](x=qx, y=qy, z=qz, w=qw),
                ),
            )
        )
    values = np.hstack([frame.poses for frame in frames])
    return _filled(types, kind, known[kind](transforms=transforms), marks, values, stamp_ns)


def _joint_states(log: ViewerLog, types: Any) -> Iterator[_Messages]:
    if not log.joints:
        return
    kind, mark = "sensor_msgs/msg/JointState", _Mark()
    marks = [mark.double() for _ in log.joints]
    none = np.zeros(0)
    message = types.types[kind](
        header=_header(types, ""), name=list(log.joints), position=np.array(marks), velocity=none, effort=none
    )
    rows = _filled(types, kind, message, marks, log.positions, log.stamp_ns)
    yield _Messages(topic="/joint_states", type=kind, stamp_ns=log.stamp_ns, rows=rows)


def _description(log: ViewerLog, types: Any) -> Iterator[_Messages]:
    if log.urdf is None:
        return
    kind = "std_msgs/msg/String"
    text = log.urdf.read_text(encoding="utf-8")
    rows = [bytes(types.serialize_cdr(types.types[kind](data=text), kind))]
    yield _Messages(topic=DESCRIPTION, type=kind, stamp_ns=log.stamp_ns[:1], rows=rows, latched=True)


def _wrenches(log: ViewerLog, types: Any) -> Iterator[_Messages]:
    known, kind = types.types, "geometry_msgs/msg/WrenchStamped"
    for wrench in log.wrenches:
        mark = _Mark()
        marks = [mark.double() for _ in range(6)]
        force, torque = (known["geometry_msgs/msg/Vector3"](*marks[half]) for half in (slice(3), slice(3, 6)))
        message = known[kind](
            header=_header(types, wrench.frame), wrench=known["geometry_msgs/msg/Wrench"](force=force, torque=torque)
        )
        stamp_ns = log.stamp_ns[wrench.known]
        if len(stamp_ns):
            rows = _filled(types, kind, message, marks, wrench.values[wrench.known], stamp_ns)
            yield _Messages(topic=f"/{wrench.name}", type=kind, stamp_ns=stamp_ns, rows=rows)


def _arrows(log: ViewerLog, types: Any) -> Iterator[_Messages]:
    known, kind, mark = types.types, "visualization_msgs/msg/MarkerArray", _Mark()
    point, colour = known["geometry_msgs/msg/Point"], known["std_msgs/msg/ColorRGBA"]
    markers, marks, tips = [], list[float](), []
    for number, (wrench, tip) in enumerate(log.arrows()):
        numbers = [mark.double() for _ in range(3)]
        red, green, blue = (int(colour_of(wrench.kind, number)[at : at + 2], 16) / 255.0 for at in (1, 3, 5))
        markers.append(
            _marker(
                types,
                header=_header(types, wrench.frame),
                ns=wrench.name,
                scale=known["geometry_msgs/msg/Vector3"](x=_SHAFT_M, y=_HEAD_M, z=0.0),
                color=colour(r=red, g=green, b=blue, a=1.0),
                points=[point(x=0.0, y=0.0, z=0.0), point(*numbers)],
            )
        )
        marks += numbers
        tips.append(np.nan_to_num(tip, nan=0.0))  # an arrow without a length, where there is no wrench
    if markers:
        rows = _filled(types, kind, known[kind](markers=markers), marks, np.hstack(tips), log.pose_ns)
        yield _Messages(topic=ARROWS, type=kind, stamp_ns=log.pose_ns, rows=rows)


def colour_of(kind: str, number: int) -> str:
    """Choose the colour of an arrow or a curve.

    Args:
        kind: Kind of the wrench.
        number: Number of the wrench in the log.

    Returns:
        `#RRGGBB`: black for what the model expects, else of the palette of figures.
    """
    return REFERENCE_COLOUR if kind == "expected" else COLOURS[number % 6]


def _marker(types: Any, **content: Any) -> Any:
    """An arrow; what a marker has beside it is empty."""
    known, none = types.types, np.zeros(0, dtype=np.uint8)
    nothing = known["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
    pose = known["geometry_msgs/msg/Pose"](
        position=known["geometry_msgs/msg/Point"](x=0.0, y=0.0, z=0.0),
        orientation=known["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
    )
    image = known["sensor_msgs/msg/CompressedImage"](
        header=known["std_msgs/msg/Header"](stamp=nothing, frame_id=""), format="", data=none
    )
    return known["visualization_msgs/msg/Marker"](
        id=0,
        type=0,
        action=0,
        pose=pose,
        lifetime=known["builtin_interfaces/msg/Duration"](sec=0, nanosec=0),
        frame_locked=True,
        colors=[],
        texture_resource="",
        texture=image,
        uv_coordinates=[],
        text="",
        mesh_resource="",
        mesh_file=known["visualization_msgs/msg/MeshFile"](filename="", data=none),
        mesh_use_embedded_materials=False,
        **content,
    )


def _events(log: ViewerLog, types: Any) -> Iterator[_Messages]:
    kind, rows = "rcl_interfaces/msg/Log", []
    for event in log.events:
        seconds, nanoseconds = divmod(event.stamp_ns, _NANO)
        message = types.types[kind](
            stamp=types.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanoseconds),
            level=_WARNING if event.is_warning else _INFORMATION,
            name="forcetorque",
            msg=event.text,
            file="",
            function="",
            line=0,
        )
        rows.append(bytes(types.serialize_cdr(message, kind)))
    if rows:
        stamp_ns = np.array([event.stamp_ns for event in log.events], dtype=np.int64)
        yield _Messages(topic=EVENTS, type=kind, stamp_ns=stamp_ns, rows=rows)


Panels: TypeAlias = dict[str, dict[str, object]]
Node: TypeAlias = str | dict[str, object]

_SCENE, _EVENTS, _TABS = "3D!scene", "RosOut!events", "Tab!wrenches"
_HALVES = {"force": (slice(0, 3), "N"), "torque": (slice(3, 6), "N m")}
_LAYOUT_INFORMATION = 2
"""Lowest level of messages that the panel of events shows: that of intervals."""


def layout_file(mcap: Path) -> Path:
    """Name the file of the layout.

    Args:
        mcap: File of the bag.

    Returns:
        `x.foxglove.json` beside `x.mcap`.
    """
    return mcap.with_suffix(".foxglove.json")


def write_layout(mcap: Path, log: ViewerLog) -> None:
    """Write the layout beside its bag.

    Args:
        mcap: File of the bag.
        log: What the bag holds.
    """
    write_bytes_atomically(layout_file(mcap), json.dumps(foxglove_layout(log), indent=1).encode())


def foxglove_layout(log: ViewerLog) -> dict[str, object]:
    """Lay out a log: the robot with arrows, forces and moments of every sensor over time, their errors, and events.

    Args:
        log: The log.

    Returns:
        The layout, as JSON has it.
    """
    panels: Panels = {_SCENE: _scene(log)}
    tabs = [{"title": title, "layout": _plots(title, wrenches, panels)} for title, wrenches in log.plots()]
    right: list[tuple[Node, float]] = []
    if tabs:
        panels[_TABS] = {"activeTabIdx": 0, "tabs": tabs}
        right.append((_TABS, 80.0))
    if log.events:
        panels[_EVENTS] = {"topicToRender": EVENTS, "minLogLevel": _LAYOUT_INFORMATION, "searchTerms": []}
        right.append((_EVENTS, 20.0))
    layout: Node = _SCENE
    if right:
        layout = _divided("row", layout, _column([node for node, _ in right], right[0][1]), 40.0)
    return {
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": layout,
    }


def _scene(log: ViewerLog) -> dict[str, object]:
    known = {DESCRIPTION: log.urdf is not None, ARROWS: any(True for _ in log.arrows())}
    return {
        "followMode": "follow-none",
        "followTf": log.world,
        "scene": {"transforms": {"showLabel": False, "axisScale": 0.3}},
        "topics": {topic: {"visible": True} for topic, is_there in known.items() if is_there},
        "layers": {"grid": {"layerId": "foxglove.Grid", "instanceId": "grid", "visible": True, "frameId": log.world}},
    }


def _plots(title: str, wrenches: Sequence[LoggedWrench], panels: Panels) -> Node:
    """Plots of forces and moments, one above the other."""
    names = []
    for half, (columns, unit) in _HALVES.items():
        name = f"Plot!{title.replace(': ', '_')}_{half}"
        paths = [
            {
                "value": f"/{wrench.name}.wrench.{half}.{axis}",
                "label": f"{component} {wrench.name}",
                "color": colour_of(wrench.kind, number),
                "enabled": True,
                "timestampMethod": "receiveTime",
            }
            for number, wrench in enumerate(wrenches)
            for axis, component in zip("xyz", WRENCH_COMPONENTS[columns], strict=True)
        ]
        panels[name] = {
            "title": f"{title}: {half}, {unit}",
            "paths": paths,
            "yAxisLabel": unit,
            "xAxisVal": "timestamp",
            "isSynced": True,
            "showLegend": True,
            "legendDisplay": "floating",
        }
        names.append(name)
    return _column(names, 50.0)


def _column(nodes: Sequence[Node], share: float) -> Node:
    """One node, or two with one above the other."""
    if len(nodes) == 1:
        return nodes[0]
    first, second = nodes
    return _divided("column", first, second, share)


def _divided(direction: str, first: Node, second: Node, share: float) -> Node:
    return {"direction": direction, "first": first, "second": second, "splitPercentage": share}
