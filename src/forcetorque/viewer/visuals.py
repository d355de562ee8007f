# SPDX-License-Identifier: BSD-3-Clause
"""The `<visual>` elements of a URDF file: what its links look like."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FormatError
from forcetorque.robot.urdf_attributes import UrdfPlace, number, numbers, origin, required
from forcetorque.xml_file import read_xml

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
