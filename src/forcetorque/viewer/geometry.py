# SPDX-License-Identifier: BSD-3-Clause
"""What to draw of a robot: the shapes and meshes of its URDF, and sticks where those are missing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FormatError, MissingExtraError
from forcetorque.robot import RobotModel
from forcetorque.spatial import make_pose
from forcetorque.spatial.rotation import rotation_with_z_along
from forcetorque.viewer.block import Block
from forcetorque.viewer.mesh_files import Triangles, find_mesh, package_folders, read_mesh
from forcetorque.viewer.scene import Mesh, Shape
from forcetorque.viewer.simplify import simplified
from forcetorque.viewer.visuals import GREY, Visual, read_visuals

_THIN = 1.0 / 80.0
"""Radius of a stick, relative to the reach of the robot."""
_NAMES = 3
"""So many names are listed in a note."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Geometry:
    """What to draw of a robot."""

    shapes: tuple[Shape, ...]
    """Shapes at links."""
    meshes: tuple[Mesh, ...]
    """Meshes of the shapes."""
    notes: tuple[str, ...]
    """What is missing, and where it was looked for."""


def robot_geometry(
    model: RobotModel, urdf: Path | None, block: Block, *, mesh_folders: Sequence[Path] = ()
) -> Geometry:
    """Collect what a robot looks like.

    Args:
        model: The robot.
        urdf: Its file; None for a load without one.
        block: Takes the meshes.
        mesh_folders: Folders with packages of meshes, or packages themselves, that are looked at first.

    Returns:
        Shapes and meshes; sticks from joint to joint for links whose meshes are missing, and for all links where
        nothing can be drawn.
    """
    visuals = () if urdf is None else read_visuals(urdf)
    library = _Library(urdf, mesh_folders)
    drawn = [(visual, library.index(visual)) for visual in visuals if visual.link in model.links]
    lacking = {visual.link for visual, mesh in drawn if visual.kind == "mesh" and mesh is None}
    shapes = [_shape(visual, mesh) for visual, mesh in drawn if visual.kind != "mesh" or mesh is not None]
    notes = library.notes()
    if not visuals:
        notes += ["the robot has no shapes to draw: sticks join its joints"]
    elif lacking:
        notes += ["links without their mesh are drawn as sticks from joint to joint"]
    reduced = simplified(library.read)
    if reduced != tuple(library.read):
        before, after = (sum(len(mesh.faces) for mesh in meshes) for meshes in (library.read, reduced))
        notes += [f"meshes are simplified from {before} to {after} triangles"]
    shapes += _sticks(model, model.links if not shapes else lacking)
    meshes = tuple(
        Mesh(vertices=block.add(mesh.vertices, "float32"), faces=block.add(mesh.faces, "uint32")) for mesh in reduced
    )
    return Geometry(shapes=tuple(shapes), meshes=meshes, notes=tuple(notes))


class _Library:
    """Meshes by file and scale, each read once."""

    def __init__(self, urdf: Path | None, mesh_folders: Sequence[Path]) -> None:
        self.urdf = urdf
        self.given = tuple(mesh_folders)
        self.folders = () if urdf is None else package_folders(urdf, mesh_folders)
        self.read: list[Triangles] = []
        self._known: dict[tuple[str, tuple[float, ...]], int | None] = {}
        self._missing: dict[str, None] = {}
        self._unread: dict[str, list[str]] = {}

    def index(self, visual: Visual) -> int | None:
        """Index of the mesh of a visual; None if it has none or none can be read."""
        if visual.file is None or self.urdf is None:
            return None
        key = (visual.file, visual.size)
        if key not in self._known:
            mesh = self._open(visual.file, visual.size, self.urdf)
            self._known[key] = None if mesh is None else len(self.read)
            self.read += [] if mesh is None else [mesh]
        return self._known[key]

    def notes(self) -> list[str]:
        """Say what could not be drawn."""
        lines = []
        if self._missing:
            looked = ", ".join(map(str, self.folders))
            lines.append(f"{len(self._missing)} mesh(es) not found ({_some(self._missing)}); looked in {looked}")
        return [*lines, *(f"{len(files)} mesh(es) not read: {reason}" for reason, files in self._unread.items())]

    def _open(self, name: str, scale: tuple[float, ...], urdf: Path) -> Triangles | None:
        file = find_mesh(name, urdf, self.folders, packages=self.given)
        if file is None:
            self._missing[name] = None
            return None
        try:
            return read_mesh(file, scale)
        except (FormatError, MissingExtraError) as error:
            self._unread.setdefault(str(error), []).append(name)
            return None


def _some(names: Iterable[str]) -> str:
    listed = list(names)
    return ", ".join(listed[:_NAMES]) + (", ..." if len(listed) > _NAMES else "")


def _shape(visual: Visual, mesh: int | None) -> Shape:
    return Shape(
        link=visual.link,
        link_H_shape=flat(visual.link_H_visual),
        kind=visual.kind,
        size=(1.0, 1.0, 1.0) if visual.kind == "mesh" else visual.size,  # the vertices are scaled
        mesh=mesh,
        colour=visual.colour,
    )


def _sticks(model: RobotModel, links: Iterable[str]) -> list[Shape]:
    """A cylinder from the origin of each link to those of its children, and a ball where it has none."""
    radius = _THIN * _reach(model)
    shapes = []
    for link in model.links:
        if link not in links:
            continue
        ends = [joint.parent_H_child[:3, 3] for joint in model.joints.values() if joint.parent == link]
        shapes += [_stick(link, end, radius) for end in ends if np.linalg.norm(end) > radius]
        if not ends:
            shapes.append(
                Shape(link=link, link_H_shape=flat(np.eye(4)), kind="sphere", size=(radius,), mesh=None, colour=GREY)
            )
    return shapes


def _stick(link: str, end: FloatArray, radius: float) -> Shape:
    length = float(np.linalg.norm(end))
    pose = make_pose(rotation_with_z_along(end), 0.5 * end)
    return Shape(link=link, link_H_shape=flat(pose), kind="cylinder", size=(radius, length), mesh=None, colour=GREY)


def _reach(model: RobotModel) -> float:
    """Longest way from the root along the joints; m; 1 for a robot of no size."""
    parent = {joint.child: joint for joint in model.joints.values()}
    longest = 0.0
    for link in model.links:
        way, here = 0.0, link
        while here in parent:
            way += float(np.linalg.norm(parent[here].parent_H_child[:3, 3]))
            here = parent[here].parent
        longest = max(longest, way)
    return longest or 1.0


def flat(values: FloatArray) -> tuple[float, ...]:
    """Give the numbers of an array row by row, as the header holds them.

    Args:
        values: Array of any shape.

    Returns:
        Its numbers.
    """
    return tuple(float(value) for value in values.ravel())
