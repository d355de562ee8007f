# SPDX-License-Identifier: BSD-3-Clause
"""A scene as a recording of Rerun (`.rrd`), with the layout in which it opens."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import needs_extra
from forcetorque.base.output_file import replaced_file
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.viewer.mcap_and_foxglove_files import colour_of
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.viewer_log import ViewerLog

if TYPE_CHECKING:
    from forcetorque.viewer.scene import Shape

TIMELINE = "time"
"""Name of the timeline; stamps of the log."""
FRAMES = "world"
"""Entity that frames, shapes and arrows stand below."""
_RADIUS_M = 0.006
_HALVES = {"force": slice(0, 3), "torque": slice(3, 6)}


def write_rrd(path: Path, log: ViewerLog) -> int:
    """Write a log as a recording of Rerun.

    Entities: `world/.../FRAME`, below its parents, has the pose in its parent, its shapes and the arrows of forces;
    `SENSOR/SERIES/force` and `/torque` have three scalars, `SENSOR/SERIES/error` likewise; `events` has intervals and
    findings.

    Args:
        path: File to write or to replace.
        log: The log.

    Returns:
        Its size; bytes.
    """
    rerun = imported_rerun(path)
    with replaced_file(path) as temporary:
        stream = rerun.RecordingStream("forcetorque")
        stream.save(temporary, default_blueprint=_layout(log))
        stream.send_recording_name(log.title)
        stream.log(FRAMES, rerun.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        places = frame_entities(log)
        _send_frames(stream, rerun, log, places)
        _send_shapes(stream, rerun, log, places)
        _send_arrows(stream, rerun, log, places)
        _send_wrenches(stream, rerun, log)
        for event in log.events:
            stream.set_time(TIMELINE, timestamp=np.datetime64(event.stamp_ns, "ns"))
            stream.log("events", rerun.TextLog(event.text, level="WARN" if event.is_warning else "INFO"))
        stream.flush()
        stream.disconnect()
        return temporary.stat().st_size


def imported_rerun(path: Path) -> Any:
    """Import rerun-sdk.

    Args:
        path: File that it is needed for.

    Returns:
        The module.

    Raises:
        MissingExtraError: If it is not installed.
    """
    with needs_extra(f"{path}: recordings of Rerun are written by rerun-sdk", "rerun"):
        import rerun
    return rerun


def _times(rerun: Any, stamp_ns: IntArray) -> list[Any]:
    return [rerun.TimeColumn(TIMELINE, timestamp=stamp_ns.astype("datetime64[ns]"))]


def frame_entities(log: ViewerLog) -> dict[str, str]:
    """Name the entities of frames.

    Args:
        log: The log.

    Returns:
        Paths by frame, each below that of its parent.
    """
    places = {log.world: FRAMES}
    for frame in log.frames:
        places[frame.name] = f"{places[frame.parent]}/{_part(frame.name)}"
    return places


def _send_frames(stream: Any, rerun: Any, log: ViewerLog, places: Mapping[str, str]) -> None:
    for frame in log.frames:
        place, poses = places[frame.name], frame.poses
        quat_xyzw = poses[:, [4, 5, 6, 3]]
        if len(poses) == 1:
            pose = rerun.Transform3D(translation=poses[0, :3], quaternion=rerun.Quaternion(xyzw=quat_xyzw[0]))
            stream.log(place, pose, static=True)
        else:
            columns = rerun.Transform3D.columns(translation=poses[:, :3], quaternion=quat_xyzw)
            stream.send_columns(place, _times(rerun, log.pose_ns), columns)


def _send_shapes(stream: Any, rerun: Any, log: ViewerLog, places: Mapping[str, str]) -> None:
    for number, shape in enumerate(log.robot.shapes):
        pose = np.reshape(shape.link_H_shape, (4, 4))
        place = f"{places[shape.link]}/shape_{number}"
        scale = np.diag(shape.size) if shape.kind == "mesh" else np.eye(3)
        stream.log(place, rerun.Transform3D(translation=pose[:3, 3], mat3x3=pose[:3, :3] @ scale), static=True)
        stream.log(place, _drawn(rerun, shape, log), static=True)


def _drawn(rerun: Any, shape: Shape, log: ViewerLog) -> Any:
    colour = [round(255.0 * value) for value in shape.colour]
    if shape.kind == "mesh" and shape.mesh is not None:
        mesh = log.robot.meshes[shape.mesh]
        vertices, faces = read_array(log.block, mesh.vertices), read_array(log.block, mesh.faces)
        return rerun.Mesh3D(vertex_positions=vertices, triangle_indices=faces, albedo_factor=colour)
    if shape.kind == "box":
        return rerun.Boxes3D(sizes=[shape.size], colors=[colour], fill_mode="solid")
    if shape.kind == "cylinder":
        return rerun.Cylinders3D(lengths=[shape.size[1]], radii=[shape.size[0]], colors=[colour], fill_mode="solid")
    return rerun.Ellipsoids3D(radii=[shape.size[0]], colors=[colour], fill_mode="solid")


def _send_arrows(stream: Any, rerun: Any, log: ViewerLog, places: Mapping[str, str]) -> None:
    for number, (wrench, tips) in enumerate(log.arrows()):
        place = f"{places[wrench.frame]}/{wrench.name.replace('/', '_')}"
        look = rerun.Arrows3D.from_fields(colors=_colour(wrench.kind, number), radii=[_RADIUS_M])
        stream.log(place, look, static=True)
        # of no length where there is no wrench, or the last arrow would stay
        columns = rerun.Arrows3D.columns(vectors=np.nan_to_num(tips, nan=0.0))
        stream.send_columns(place, _times(rerun, log.pose_ns), columns)


def _send_wrenches(stream: Any, rerun: Any, log: ViewerLog) -> None:
    for wrench in log.wrenches:
        known = wrench.known
        if not len(known):
            continue
        for half, columns in _HALVES.items():
            place = f"{wrench.name}/{half}"
            names = [f"{component} {wrench.name}" for component in WRENCH_COMPONENTS[columns]]
            stream.log(place, rerun.SeriesLines(names=names), static=True)
            scalars = _scalars(rerun, wrench.values[known, columns])
            stream.send_columns(place, _times(rerun, log.stamp_ns[known]), scalars)


def _scalars(rerun: Any, values: FloatArray) -> Any:
    return rerun.Scalars.columns(scalars=np.ascontiguousarray(values))


def _colour(kind: str, number: int) -> list[int]:
    return [int(colour_of(kind, number)[1:], 16) * 256 + 255]


def _part(name: str) -> str:
    """A name as one part of the path of an entity."""
    return "".join(letter if letter.isalnum() or letter in "_-." else f"\\{letter}" for letter in name)


def _layout(log: ViewerLog) -> Any:
    import rerun.blueprint as blueprint

    curves = [
        blueprint.Vertical(
            *(
                blueprint.TimeSeriesView(
                    origin="/",
                    contents=[f"+ /{wrench.name}/{half}" for wrench in wrenches],
                    name=f"{title}: {half}, {unit}",
                )
                for half, unit in (("force", "N"), ("torque", "N m"))
            ),
            name=title,
        )
        for title, wrenches in log.plots()
    ]
    return blueprint.Blueprint(
        blueprint.Horizontal(
            blueprint.Spatial3DView(origin=f"/{FRAMES}", name=log.title),
            blueprint.Vertical(
                blueprint.Tabs(*curves), blueprint.TextLogView(origin="/events", name="Events"), row_shares=[4, 1]
            ),
            column_shares=[2, 3],
        ),
        collapse_panels=True,
    )
