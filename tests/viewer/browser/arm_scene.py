# SPDX-License-Identifier: BSD-3-Clause
"""A scene whose every number is known: an arm of three joints that carries its hand past a wall."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.viewer.posture import scene_joints
from forcetorque.viewer.robot_shapes import flat, robot_geometry
from forcetorque.viewer.scene import (
    ContactSeries,
    Ellipsoid,
    Robot,
    Scene,
    SceneFinding,
    SceneInterval,
    Sensor,
    Sphere,
    WrenchSeries,
)
from forcetorque.viewer.scene_arrays import Block, peak
from forcetorque.viewer.scene_builder import BuiltScene

SAMPLES = 600
RATE_HZ = 50.0
COORDINATES = ("turn", "lift", "reach")
DEVIATION = 0.02
"""Standard deviation of the error of one calibration, as a share of each component."""
WALL = slice(400, 450)
"""Samples in which the hand touches a wall."""

URDF = """<robot name="arm">
  <link name="base"><visual><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.09" length="0.2"/></geometry>
    <material name="dark"><color rgba="0.35 0.38 0.42 1"/></material></visual></link>
  <link name="column"><visual><origin xyz="0 0 0.15"/><geometry><box size="0.09 0.09 0.3"/></geometry>
    <material name="light"><color rgba="0.8 0.82 0.85 1"/></material></visual></link>
  <link name="upper"><visual><origin xyz="0.15 0 0"/><geometry><box size="0.3 0.07 0.07"/></geometry>
    <material name="light"/></visual></link>
  <link name="fore"><visual><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.05 0.05"/></geometry>
    <material name="dark"/></visual></link>
  <link name="hand"><visual><geometry><mesh filename="hand.stl" scale="0.06 0.06 0.06"/></geometry>
    <material name="tool"><color rgba="0.9 0.75 0.4 1"/></material></visual></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="column"/><origin xyz="0 0 0.2"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="lift" type="revolute"><parent link="column"/><child link="upper"/>
    <origin xyz="0 0 0.3" rpy="0.3 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="shoulder_mount" type="fixed"><parent link="upper"/><child link="fore_base"/>
    <origin xyz="0.3 0 0"/></joint>
  <link name="fore_base"/>
  <joint name="reach" type="prismatic"><parent link="fore_base"/><child link="fore"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.2" effort="1" velocity="1"/></joint>
  <joint name="wrist_mount" type="fixed"><parent link="fore"/><child link="hand"/>
    <origin xyz="0.2 0 0" rpy="0 0.4 0"/></joint>
  <link name="finger"/>
  <joint name="curl" type="revolute"><parent link="hand"/><child link="finger"/><origin xyz="0.1 0 0" rpy="0.2 0 0"/>
    <axis xyz="0 0.6 0.8"/><mimic joint="lift" multiplier="-0.5" offset="0.1"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
</robot>"""

HAND = """solid hand
facet normal 0 0 0
outer loop
vertex 0 -1 -1
vertex 0 1 -1
vertex 2 0 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 1 -1
vertex 0 0 1
vertex 2 0 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0 1
vertex 0 -1 -1
vertex 2 0 0
endloop
endfacet
endsolid hand
"""

_WEIGHTS = {"shoulder_ft": ("fore_base", 45.0), "wrist_ft": ("hand", 12.0)}
"""Link of each sensor, and what hangs on it; N."""
_STRETCH = np.array([[1.12, 0.03, 0.0], [0.02, 0.93, 0.04], [0.0, -0.02, 1.04]])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Arm:
    """The scene and what it was made of."""

    built: BuiltScene
    model: RobotModel
    positions: FloatArray
    time_s: FloatArray

    def link_pose(self, link: str, sample: int) -> FloatArray:
        """Pose of a link in the world by the library; shape (4, 4)."""
        tree = build_tree(self.model, self.model.root_link)
        joints = JointMotion.at_rest(COORDINATES, self.positions[sample : sample + 1])
        return root_pose(sample) @ link_pose(tree, joints, link)[0]


def root_pose(sample: int) -> FloatArray:
    """Pose of the base in the world: it stands beside the origin and is turned about z."""
    angle = 0.3 + 0.0002 * sample
    pose = np.eye(4)
    pose[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    pose[:3, 3] = [0.2, -0.1, 0.05]
    return pose


def arm_scene(
    folder: Path, *, meshes: bool = True, expected: bool = True, samples: int = SAMPLES, notes: tuple[str, ...] = ()
) -> Arm:
    """Make the scene.

    Args:
        folder: Takes the robot's files.
        meshes: Whether the mesh of the hand is found.
        expected: Whether expected wrenches are known.
        samples: Number of samples; 0 for none.
        notes: Further notes.

    Returns:
        The scene.
    """
    urdf = folder / "arm.urdf"
    urdf.write_text(URDF)
    if meshes:
        (folder / "hand.stl").write_text(HAND)
    model, block = read_urdf(urdf), Block()
    time_s = 0.25 + np.arange(samples) / RATE_HZ
    positions = _positions(samples)
    if samples:
        # 0.1 s are missing where the clock jumps, so that samples are not evenly spaced
        time_s[samples // 3 :] += 0.1
    geometry = robot_geometry(model, urdf, block)
    sensors = tuple(
        _sensor(block, model, name, positions, expected=expected, stretch=0.4 if name == "wrist_ft" else 1.0)
        for name in _WEIGHTS
    )
    touch = np.full((samples, 6), np.nan)
    touch[WALL] = [0.0, 0.0, -14.0, 0.4, 0.0, 0.0]
    scene = Scene(
        title="arm at the wall",
        provenance=("arm.toml sha256 00", "forcetorque test"),
        samples=samples,
        start_ns="1700000000000000000",
        end_s=float(time_s[-1]) + 1e-9 if samples else 0.0,
        time_s=block.add(time_s, "float64"),
        positions=block.add(positions, "float32"),
        coordinates=COORDINATES,
        root=block.add(np.array([_root_row(i) for i in range(samples)]).reshape(-1, 7), "float32"),
        robot=Robot(
            name=model.name,
            root_link=model.root_link,
            links=tuple(model.links),
            joints=scene_joints(model, COORDINATES),
            shapes=geometry.shapes,
            meshes=geometry.meshes,
        ),
        sensors=sensors,
        contacts=(
            ContactSeries(name="wall", link="hand", link_H_contact=flat(np.eye(4)), values=block.add(touch, "float32")),
        ),
        intervals=_intervals(time_s),
        findings=_findings(time_s),
        notes=(*geometry.notes, *notes),
        annotations_url=None,
    )
    return Arm(
        built=BuiltScene(scene=scene, block=block.bytes()),
        model=model,
        positions=positions.astype(np.float32).astype(np.float64),
        time_s=time_s,
    )


def _positions(samples: int) -> FloatArray:
    phase = np.linspace(0.0, 1.0, samples, endpoint=False)
    return np.column_stack(
        [
            1.6 * np.sin(2 * np.pi * 2 * phase),
            0.9 * np.sin(2 * np.pi * 7 * phase + 0.4),
            0.08 + 0.06 * np.sin(2 * np.pi * 3 * phase),
        ]
    )


def _root_row(sample: int) -> list[float]:
    half = (0.3 + 0.0002 * sample) / 2
    return [0.2, -0.1, 0.05, np.cos(half), 0.0, 0.0, np.sin(half)]


def _sensor(
    block: Block, model: RobotModel, name: str, positions: FloatArray, *, expected: bool, stretch: float
) -> Sensor:
    link, weight = _WEIGHTS[name]
    truth = _gravity(model, link, positions, weight)
    matrix = np.eye(3) + stretch * (_STRETCH - np.eye(3))
    offset = np.array([0.12, -0.08, 0.05]) * weight
    noise = np.random.default_rng(len(name)).normal(scale=0.006 * weight, size=(2, *truth.shape))
    logged = truth @ np.kron(np.eye(2), matrix).T + np.tile(offset, 2) * [1, 1, 1, 0.1, 0.1, 0.1] + noise[0]
    touched = np.zeros_like(truth)
    touched[WALL] = [0.5 * weight, -0.3 * weight, 0.2 * weight, 0.02 * weight, 0.0, 0.0]
    good = truth + 0.6 * noise[1] + touched
    fair = truth @ np.kron(np.eye(2), np.eye(3) + 0.3 * (matrix - np.eye(3))).T + noise[1] + touched
    reference = Sphere(centre=(0.0, 0.0, 0.0), radius=weight)
    seen = Ellipsoid(centre=flat(offset), axes=flat(weight * matrix))
    found = [("expected", truth)] if expected else []
    found += [("logged", logged + touched), ("calibration March", fair), ("calibration May", good)]
    return Sensor(
        name=name,
        serial="SN001" if name == "shoulder_ft" else "SN002",
        link=link,
        link_H_sensor=flat(np.eye(4)),
        acting=link,
        acted_on="upper" if name == "shoulder_ft" else "fore",
        wrenches=tuple(
            WrenchSeries(
                name=series,
                role="expected" if series == "expected" else "measured",
                calibrated=series.startswith("calibration"),
                peak=peak(values),
                values=block.add(values, "float32"),
                deviation=block.add(DEVIATION * np.abs(truth), "float32") if series.endswith("March") else None,
                reference_force=reference if series == "expected" else None,
                reference_moment=None,
                ellipsoid_force=seen if series == "logged" else None,
                ellipsoid_moment=None,
            )
            for series, values in found
        ),
    )


def _gravity(model: RobotModel, link: str, positions: FloatArray, weight: float) -> FloatArray:
    """Weight in a link's axes, 0.1 m along its x."""
    poses = link_pose(build_tree(model, model.root_link), JointMotion.at_rest(COORDINATES, positions), link)
    force = -weight * poses[:, 2, :3]
    return np.hstack([force, np.cross([0.1, 0.0, 0.0], force)])


def _intervals(time_s: FloatArray) -> tuple[SceneInterval, ...]:
    if not len(time_s):
        return ()
    spans = (("moving", "calibration", 30, 290, "base"), ("held out", "validation", 300, 560, "base"))
    return (
        *(
            SceneInterval(
                label=label,
                use=use,  # type: ignore[arg-type]
                start_s=float(time_s[a]),
                end_s=float(time_s[b]),
                support=support,
                states_support=True,
            )
            for label, use, a, b, support in spans
        ),
        SceneInterval(
            label="wall",
            use="ignore",
            start_s=float(time_s[WALL.start]),
            end_s=float(time_s[WALL.stop]),
            support=None,
            states_support=True,
        ),
    )


def _findings(time_s: FloatArray) -> tuple[SceneFinding, ...]:
    if not len(time_s):
        return ()
    at = [float(time_s[k]) for k in (199, 200, 400, 450)]
    return (
        SceneFinding(stream="shoulder", kind="gap", message="0.12 s without a sample", start_s=at[0], end_s=at[1]),
        SceneFinding(stream="wrist", kind="contact", message="something carries the hand", start_s=at[2], end_s=at[3]),
        SceneFinding(stream="joints", kind="stuck", message="no instant", start_s=None, end_s=None),
    )
