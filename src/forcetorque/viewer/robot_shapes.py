# SPDX-License-Identifier: BSD-3-Clause
"""What to draw of a robot: shapes and meshes of its URDF, and sticks where those are missing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, MissingExtraError
from forcetorque.base.input_file import read_xml
from forcetorque.base.pose import make_pose, rotation_with_z_along
from forcetorque.robot.model import RobotModel
from forcetorque.robot.urdf import UrdfPlace, number, numbers, origin, required
from forcetorque.viewer.meshes import Triangles, find_mesh, package_folders, read_mesh, simplified
from forcetorque.viewer.scene import Mesh, Shape
from forcetorque.viewer.scene_arrays import Block

GREY = (0.72, 0.72, 0.72, 1.0)
"""Colour of what has none."""

Colour = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Visual:
    """One shape of a link."""

    link: str
    """Link."""
    link_H_visual: FloatArray
    """Its pose; shape (4, 4); m."""
    kind: Literal["box", "cylinder", "sphere", "mesh"]
    """What it is."""
    size: tuple[float, ...]
    """Box: x, y, z; cylinder: radius, length along z; sphere: radius; mesh: scale x, y, z."""
    file: str | None
    """Mesh file as the URDF names it; None for other kinds."""
    colour: Colour
    """Red, green, blue, opacity."""


def read_visuals(path: Path) -> tuple[Visual, ...]:
    """Read what the links of a robot look like.

    Args:
        path: URDF file that `read_urdf` has accepted.

    Returns:
        Shapes in the order of the file; capsules, which URDF does not have, and empty geometries are left out.

    Raises:
        FormatError: If an element lacks or misstates what it must say.
    """
    robot = read_xml(path)
    if robot is None:
        raise FormatError(f"{path}: expected the root element <robot>, got nothing")
    place = UrdfPlace(str(path))
    materials = {}
    for material in robot.findall("material"):
        name = material.get("name", "")
        colour = _stated_colour(place.inside(f"<material name={name!r}>"), material)
        if colour is not None:
            materials[name] = colour
    visuals = []
    for link in robot.findall("link"):
        name = required(place.inside("<link>"), link, "name")
        for visual in link.findall("visual"):
            read = _visual(place.inside(f"<link name={name!r}>: <visual>"), name, visual, materials)
            visuals += [] if read is None else [read]
    return tuple(visuals)


def _visual(place: UrdfPlace, link: str, visual: Element, materials: dict[str, Colour]) -> Visual | None:
    geometry = visual.find("geometry")
    for element in () if geometry is None else tuple(geometry):
        inner = place.inside(f"<{element.tag}>")
        kind: Literal["box", "cylinder", "sphere", "mesh"]
        file, size = None, np.ones(3)
        if element.tag == "box":
            kind, size = "box", numbers(inner, element, "size", count=3)
        elif element.tag == "cylinder":
            kind, size = "cylinder", np.array([number(inner, element, "radius"), number(inner, element, "length")])
        elif element.tag == "sphere":
            kind, size = "sphere", np.array([number(inner, element, "radius")])
        elif element.tag == "mesh":
            kind, file = "mesh", required(inner, element, "filename")
            size = numbers(inner, element, "scale", count=3) if element.get("scale") else size
        else:
            continue
        return Visual(
            link=link,
            link_H_visual=origin(place, visual),
            kind=kind,
            size=tuple(size.tolist()),
            file=file,
            colour=_colour(place, visual.find("material"), materials),
        )
    return None


def _colour(place: UrdfPlace, material: Element | None, materials: dict[str, Colour]) -> Colour:
    if material is None:
        return GREY
    own = _stated_colour(place.inside("<material>"), material)
    return own or materials.get(material.get("name", ""), GREY)


def _stated_colour(place: UrdfPlace, material: Element) -> Colour | None:
    element = material.find("color")
    if element is None or element.get("rgba") is None:
        return None
    red, green, blue, opacity = np.clip(numbers(place.inside("<color>"), element, "rgba", count=4), 0.0, 1.0).tolist()
    return red, green, blue, opacity


_THIN = 1.0 / 80.0
"""Radius of a stick, relative to the reach of the robot."""
_LOAD_STICK, _LOAD_BALL = 1.0 / 100.0, 1.0 / 12.0
"""Radii of what is drawn of a load without a robot, relative to the distance of its centre of mass."""
_LOAD = "no robot: a ball marks the stated centre of mass of the load, at scale from the sensor's frame"
_FRAME = "no robot and no stated centre of mass of a load: the sensor's frame is drawn alone"
_AT_FRAME = "no robot: the sensor's frame is drawn alone, as the stated centre of mass of the load is at its origin"
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
    reach = _reach(model)
    loads = [] if urdf is not None or reach else _loads(model)
    if urdf is None and not reach:
        has_mass = any(link.mass > 0.0 for link in model.links.values())
        notes += [_LOAD if loads else _AT_FRAME if has_mass else _FRAME]
    elif not visuals:
        notes += ["the robot has no shapes to draw: sticks join its joints"]
    elif lacking:
        notes += ["links without their mesh are drawn as sticks from joint to joint"]
    reduced = simplified(library.read)
    if reduced != tuple(library.read):
        before, after = (sum(len(mesh.faces) for mesh in meshes) for meshes in (library.read, reduced))
        notes += [f"meshes are simplified from {before} to {after} triangles"]
    shapes += loads if urdf is None and not reach else _sticks(model, model.links if not shapes else lacking, reach)
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


def _loads(model: RobotModel) -> list[Shape]:
    """A stick from the frame of the sensor to the centre of mass of its load, and a ball there."""
    shapes = []
    for link, inertia in model.links.items():
        centre = inertia.first_moment / (inertia.mass or 1.0)
        distance = float(np.linalg.norm(centre))
        if inertia.mass > 0.0 and distance > 0.0:
            shapes.append(_stick(link, centre, _LOAD_STICK * distance))
            shapes.append(_ball(link, make_pose(np.eye(3), centre), _LOAD_BALL * distance))
    return shapes


def _sticks(model: RobotModel, links: Iterable[str], reach: float) -> list[Shape]:
    """A cylinder from the origin of each link to those of its children, and a ball where it has none."""
    radius = _THIN * (reach or 1.0)
    shapes = []
    for link in model.links:
        if link not in links:
            continue
        ends = [joint.parent_H_child[:3, 3] for joint in model.joints.values() if joint.parent == link]
        shapes += [_stick(link, end, radius) for end in ends if np.linalg.norm(end) > radius]
        if not ends:
            shapes.append(_ball(link, np.eye(4), radius))
    return shapes


def _ball(link: str, link_H_ball: FloatArray, radius: float) -> Shape:
    return Shape(link=link, link_H_shape=flat(link_H_ball), kind="sphere", size=(radius,), mesh=None, colour=GREY)


def _stick(link: str, end: FloatArray, radius: float) -> Shape:
    length = float(np.linalg.norm(end))
    pose = make_pose(rotation_with_z_along(end), 0.5 * end)
    return Shape(link=link, link_H_shape=flat(pose), kind="cylinder", size=(radius, length), mesh=None, colour=GREY)


def _reach(model: RobotModel) -> float:
    """Longest way from the root along the joints; m."""
    parent = {joint.child: joint for joint in model.joints.values()}
    longest = 0.0
    for link in model.links:
        way, here = 0.0, link
        while here in parent:
            way += float(np.linalg.norm(parent[here].parent_H_child[:3, 3]))
            here = parent[here].parent
        longest = max(longest, way)
    return longest


def flat(values: FloatArray) -> tuple[float, ...]:
    """Give the numbers of an array row by row, as the header holds them.

    Args:
        values: Array of any shape.

    Returns:
        Its numbers.
    """
    return tuple(float(value) for value in values.ravel())
