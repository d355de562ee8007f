# SPDX-License-Identifier: BSD-3-Clause
"""What a robot looks like: shapes and meshes of its URDF, and sticks with a note where those are missing."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingExtraError
from forcetorque.base.inertia import Inertia
from forcetorque.payload.load_on_wrist_sensor import load_model
from forcetorque.payload.load_tables import Load
from forcetorque.robot.model import RobotModel
from forcetorque.robot.urdf import read_urdf
from forcetorque.viewer.meshes import (
    MOST_TRIANGLES,
    Triangles,
    clustered,
    find_mesh,
    package_folders,
    read_mesh,
    simplified,
)
from forcetorque.viewer.robot_shapes import GREY, Geometry, read_visuals, robot_geometry
from forcetorque.viewer.scene_arrays import Block, read_array
from tests.scenes.robots import PENDULUM_URDF, icub, joint_xml, robot_xml

pytest.importorskip("trimesh")

_CORNERS = (("0 0 0", "1 0 0", "0 1 0"), ("1 0 0", "1 1 0", "0 1 0"))
_FACETS = "".join(
    f"facet normal 0 0 1\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n" for a, b, c in _CORNERS
)
SQUARE = f"solid square\n{_FACETS}endsolid square\n"
"""Two triangles that make a square whose normal is z."""


def _link(name: str, *visuals: str) -> str:
    return f"<link name='{name}'>{''.join(visuals)}</link>"


def _visual(geometry: str, *, xyz: str = "0 0 0", material: str = "") -> str:
    return f"<visual><origin xyz='{xyz}'/><geometry>{geometry}</geometry>{material}</visual>"


def _mesh(name: str, scale: str = "") -> str:
    return _visual(f"<mesh filename='{name}'{scale and f' scale={chr(39)}{scale}{chr(39)}'}/>")


def _write(folder: Path, *elements: str) -> Path:
    file = folder / "robot.urdf"
    file.write_text(robot_xml(*elements), encoding="utf-8")
    return file


def _geometry(file: Path, *folders: Path) -> tuple[Geometry, Block]:
    block = Block()
    return robot_geometry(read_urdf(file), file, block, mesh_folders=folders), block


def test_simple_shapes_have_their_sizes_poses_and_colours(tmp_path: Path) -> None:
    """Boxes, cylinders and spheres are taken as they are, with their own colour, a named one or grey."""
    file = _write(
        tmp_path,
        "<material name='blue'><color rgba='0 0 1 0.5'/></material>",
        _link(
            "base",
            _visual("<box size='1 2 3'/>", xyz="1 2 3", material="<material name='blue'/>"),
            _visual("<cylinder radius='0.1' length='2'/>", material="<material><color rgba='2 0 0 1'/></material>"),
            _visual("<sphere radius='0.3'/>", material="<material name='unheard of'/>"),
            _visual("<capsule radius='1' length='2'/>"),
        ),
    )
    shapes = _geometry(file)[0].shapes
    assert [(shape.kind, shape.size) for shape in shapes] == [
        ("box", (1.0, 2.0, 3.0)),
        ("cylinder", (0.1, 2.0)),
        ("sphere", (0.3,)),
    ]
    assert [shape.colour for shape in shapes] == [(0.0, 0.0, 1.0, 0.5), (1.0, 0.0, 0.0, 1.0), GREY]
    np.testing.assert_array_equal(np.reshape(shapes[0].link_H_shape, (4, 4))[:3, 3], [1, 2, 3])


@pytest.mark.parametrize(
    ("geometry", "message"),
    [
        ("<box size='1 2'/>", "<link name='base'>: <visual>: <box>: expected 3 finite"),
        ("<sphere/>", "<sphere>: expected the attribute radius, got none"),
        ("<mesh/>", "<mesh>: expected the attribute filename"),
        ("<cylinder radius='x' length='1'/>", "<cylinder>: expected 1 number"),
    ],
)
def test_a_misstated_shape_is_refused_with_its_place(tmp_path: Path, geometry: str, message: str) -> None:
    """The message says which link and element, what was expected and what came."""
    file = _write(tmp_path, _link("base", _visual(geometry)))
    with pytest.raises(FormatError, match=message):
        read_visuals(file)


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("square.stl", "square.stl"),
        ("meshes/square.stl", "meshes/square.stl"),
        ("package://kind/meshes/square.stl", "../kind/meshes/square.stl"),
        ("package://kind/meshes/a%20square.stl", "../kind/meshes/a square.stl"),
        ("model://kind/square.stl", "../kind/square.stl"),
    ],
)
def test_meshes_are_found_by_every_kind_of_name(tmp_path: Path, name: str, place: str) -> None:
    """Beside the file, or in a package that lies around it."""
    folder = tmp_path / "robots"
    mesh = folder / place
    mesh.parent.mkdir(parents=True, exist_ok=True)
    folder.mkdir(exist_ok=True)
    mesh.write_text(SQUARE, encoding="ascii")
    geometry, _ = _geometry(_write(folder, _link("base", _mesh(name))))
    assert [shape.kind for shape in geometry.shapes] == ["mesh"]
    assert geometry.notes == ()


def test_given_folders_and_those_of_the_environment_are_looked_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A folder that is named comes before those of ROS, of which the older and the newer variable count."""
    urdf = _write(tmp_path, _link("base"))
    for place in ("given/kind", "old/kind", "new/share/kind"):
        (tmp_path / "far" / place).mkdir(parents=True)
        (tmp_path / "far" / place / "m.stl").write_text(SQUARE, encoding="ascii")
    far = tmp_path / "far"
    assert find_mesh("package://kind/m.stl", urdf, package_folders(urdf)) is None
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{far / 'new'}:/nowhere")
    assert find_mesh("package://kind/m.stl", urdf, package_folders(urdf)) == far / "new/share/kind/m.stl"
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(far / "old"))
    assert find_mesh("package://kind/m.stl", urdf, package_folders(urdf)) == far / "old/kind/m.stl"
    folders = package_folders(urdf, [far / "given"])
    assert find_mesh("package://kind/m.stl", urdf, folders) == far / "given/kind/m.stl"
    assert find_mesh("package://other/m.stl", urdf, folders) is None
    assert find_mesh("package://other/m.stl", urdf, folders, packages=[far / "old/kind"]) == far / "old/kind/m.stl"
    assert find_mesh((far / "old/kind/m.stl").as_uri(), urdf, ()) == far / "old/kind/m.stl"
    assert find_mesh("https://example.org/m.stl", urdf, folders) is None


def test_a_mesh_is_stored_once_scaled_and_not_inside_out(tmp_path: Path) -> None:
    """Two links share a mesh of one scale; a mirrored one is another, whose triangles are turned round."""
    (tmp_path / "square.stl").write_text(SQUARE, encoding="ascii")
    file = _write(
        tmp_path,
        _link("a", _mesh("square.stl", "2 2 2"), _mesh("square.stl", "-1 1 1")),
        _link("b", _mesh("square.stl", "2 2 2")),
        joint_xml("ab", "a", "b"),
    )
    geometry, block = _geometry(file)
    assert [(shape.mesh, shape.size) for shape in geometry.shapes] == [(0, (1, 1, 1)), (1, (1, 1, 1)), (0, (1, 1, 1))]
    first, mirrored = (
        (read_array(block.bytes(), mesh.vertices), read_array(block.bytes(), mesh.faces)) for mesh in geometry.meshes
    )
    assert first[0].max() == 2.0
    assert mirrored[0].min() == -1.0
    for vertices, faces in (first, mirrored):
        corners = vertices[faces]
        assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] > 0).all()


def test_missing_meshes_become_sticks_with_a_note(tmp_path: Path) -> None:
    """Links without their mesh are joined by sticks, the others keep their shape; the note says where was looked."""
    file = _write(
        tmp_path,
        _link("a", _mesh("package://kind/a.stl")),
        _link("b", _visual("<sphere radius='0.1'/>")),
        _link("c", _mesh("package://kind/c.stl")),
        _link("d"),
        joint_xml("ab", "a", "b", xyz="0 0 2"),
        joint_xml("bc", "b", "c", xyz="0 1 0"),
        joint_xml("bd", "b", "d", xyz="0 1 0"),
    )
    geometry, _ = _geometry(file)
    assert [(shape.link, shape.kind) for shape in geometry.shapes] == [
        ("b", "sphere"),
        ("a", "cylinder"),
        ("c", "sphere"),
    ]
    stick = geometry.shapes[1]
    np.testing.assert_allclose(np.reshape(stick.link_H_shape, (4, 4))[:3, 3], [0, 0, 1])
    assert stick.size[1] == 2.0
    first, second = geometry.notes
    assert first.startswith("2 mesh(es) not found (package://kind/a.stl, package://kind/c.stl); looked in ")
    assert str(tmp_path) in first
    assert second == "links without their mesh are drawn as sticks from joint to joint"


def test_a_robot_without_shapes_is_drawn_as_sticks(tmp_path: Path) -> None:
    """Every link has something to see, and the note says why."""
    file = tmp_path / "robot.urdf"
    file.write_text(PENDULUM_URDF, encoding="utf-8")
    geometry, _ = _geometry(file)
    assert [shape.link for shape in geometry.shapes] == ["arm", "bob"]
    assert geometry.notes == ("the robot has no shapes to draw: sticks join its joints",)


@pytest.mark.parametrize("centre", [(0.0, 0.0, 0.05), (0.3, -0.4, 0.0)])
def test_a_load_without_a_robot_is_its_centre_of_mass_at_scale(centre: tuple[float, float, float]) -> None:
    """A stick from the frame of the sensor to a ball at the centre, which is smaller than the distance."""
    load = Inertia.about_centre_of_mass(mass=0.5, centre_of_mass=centre, second_moment=np.zeros((3, 3)))
    geometry = robot_geometry(_load(load), None, Block())
    stick, ball = geometry.shapes
    distance = float(np.linalg.norm(centre))
    assert (stick.link, stick.kind, ball.link, ball.kind) == ("load", "cylinder", "load", "sphere")
    assert stick.size[1] == pytest.approx(distance)
    np.testing.assert_allclose(np.reshape(stick.link_H_shape, (4, 4))[:3, 3], 0.5 * np.array(centre))
    np.testing.assert_allclose(np.reshape(ball.link_H_shape, (4, 4))[:3, 3], centre)
    assert stick.size[0] < ball.size[0] < 0.1 * distance
    assert geometry.notes == (
        "no robot: a ball marks the stated centre of mass of the load, at scale from the sensor's frame",
    )


def test_of_a_load_that_nothing_is_stated_of_no_centre_is_drawn() -> None:
    """Only the sensor's frame is left, and the note says so."""
    geometry = robot_geometry(_load(Inertia.zero()), None, Block())
    assert geometry.shapes == ()
    assert geometry.notes == ("no robot and no stated centre of mass of a load: the sensor's frame is drawn alone",)


def test_a_centre_of_mass_at_the_origin_is_a_stated_one() -> None:
    """There is nothing to draw beside the frame, and the note does not deny what is stated."""
    load = Inertia.about_centre_of_mass(mass=0.5, centre_of_mass=np.zeros(3), second_moment=np.zeros((3, 3)))
    geometry = robot_geometry(_load(load), None, Block())
    assert geometry.shapes == ()
    assert geometry.notes == (
        "no robot: the sensor's frame is drawn alone, as the stated centre of mass of the load is at its origin",
    )


def _load(inertia: Inertia) -> RobotModel:
    table = Load.model_validate({"frame": "ft", "motion": ["log"], "measure_direction": "child_to_parent"})
    return load_model(table, "wrist", inertia)


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("m.stl", "no mesh at all", "m.stl: expected"),
        ("m.stl", "", "m.stl: expected"),
        ("m.obj", "v 0 0 0\nf 1 2 9\n", "m.obj: expected"),
        ("m.ply", "ply\nformat ascii 1.0\nelement vertex x\n", "m.ply: expected"),
        ("m.glb", "glTF", "m.glb: expected"),
        ("m.step", "", "m.step: expected a mesh that ends in .stl, .obj"),
    ],
)
def test_a_damaged_mesh_is_a_note(tmp_path: Path, name: str, content: str, reason: str) -> None:
    """The rest of the robot is drawn; the note names file and reason."""
    (tmp_path / name).write_text(content, encoding="ascii")
    geometry, _ = _geometry(_write(tmp_path, _link("a", _mesh(name))))
    assert [shape.kind for shape in geometry.shapes] == ["sphere"]
    assert geometry.notes[0].startswith("1 mesh(es) not read: ")
    assert reason in geometry.notes[0]


@pytest.mark.parametrize(("suffix", "module"), [(".stl", "trimesh"), (".dae", "collada")])
def test_what_reads_meshes_may_be_absent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, suffix: str, module: str
) -> None:
    """Without the optional reader the robot is drawn as sticks, and the note says what to install."""
    monkeypatch.setitem(sys.modules, module, None)
    (tmp_path / f"m{suffix}").write_text(SQUARE, encoding="ascii")
    with pytest.raises(MissingExtraError, match="pip install"):
        read_mesh(tmp_path / f"m{suffix}", (1, 1, 1))
    geometry, _ = _geometry(_write(tmp_path, _link("a", _mesh(f"m{suffix}"))))
    assert "pip install" in geometry.notes[0]


COLLADA = """<?xml version="1.0"?>
<!DOCTYPE COLLADA [<!ENTITY a "0">]>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""
"""A triangle, behind an entity."""


def test_collada_is_read_without_entities(tmp_path: Path) -> None:
    """A mesh in DAE has its triangle; one with entities, which its reader would expand, is refused."""
    pytest.importorskip("collada", reason="meshes in DAE need pycollada")
    file = tmp_path / "m.dae"
    file.write_text(COLLADA, encoding="ascii")
    with pytest.raises(FormatError, match="expected plain XML"):
        read_mesh(file, (1, 1, 1))
    lines = COLLADA.splitlines(keepends=True)
    file.write_text("".join([lines[0], *lines[2:]]), encoding="ascii")
    mesh = read_mesh(file, (2, 1, 1))
    np.testing.assert_array_equal(mesh.vertices[mesh.faces[0]], [[0, 0, 0], [2, 0, 0], [0, 1, 0]])
    file.write_text(file.read_text(encoding="ascii").replace('meter="1"', 'meter="0.001"'), encoding="ascii")
    mesh = read_mesh(file, (2, 1, 1))
    np.testing.assert_array_equal(mesh.vertices[mesh.faces[0]], [[0, 0, 0], [0.002, 0, 0], [0, 0.001, 0]])


def _ball(count: int) -> Triangles:
    """A sphere of the radius 1 of about so many triangles."""
    import trimesh

    ball = trimesh.creation.uv_sphere(radius=1.0, count=[int(np.sqrt(count / 2)) + 1] * 2)
    return Triangles(vertices=np.asarray(ball.vertices), faces=np.asarray(ball.faces, dtype=np.uint32))


def test_joining_vertices_keeps_the_surface_where_it_is() -> None:
    """No vertex is further from the surface than the diagonal of a cell, every face has three corners."""
    ball, cell = _ball(20_000), 0.1
    reduced = clustered(ball, cell)
    assert len(reduced.faces) < 0.3 * len(ball.faces)
    off = np.abs(np.linalg.norm(reduced.vertices, axis=1) - 1.0)
    assert off.max() < cell * np.sqrt(3.0)
    assert set(np.unique(reduced.faces)) == set(range(len(reduced.vertices)))
    assert all(len(set(face)) == 3 for face in reduced.faces.tolist())


def test_few_triangles_are_left_alone_and_many_are_reduced_together() -> None:
    """Meshes below the limit are the same objects; above it all are reduced until they fit."""
    few, many = [_ball(1000), _ball(2000)], [_ball(60_000), _ball(90_000)]
    assert all(a is b for a, b in zip(simplified(few), few, strict=True))
    reduced = simplified(many)
    assert 0.3 * MOST_TRIANGLES < sum(len(mesh.faces) for mesh in reduced) <= MOST_TRIANGLES
    assert simplified([]) == ()


@pytest.mark.long
def test_an_icub_has_all_its_meshes() -> None:
    """The installed package of models is found without being named; its triangles are reduced to what a page bears."""
    geometry, block = _geometry(icub("iCubGenova04"))
    assert {shape.kind for shape in geometry.shapes} == {"mesh"}
    assert len(geometry.meshes) > 20
    triangles = sum(mesh.faces.shape[0] for mesh in geometry.meshes)
    assert triangles <= MOST_TRIANGLES
    (note,) = geometry.notes
    assert note.startswith("meshes are simplified from ")
    assert len(block.bytes()) < 5e6
