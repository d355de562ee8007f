# SPDX-License-Identifier: BSD-3-Clause
"""Payloads for arms and simulators: by each target's own arithmetic the load of the flange comes back."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from defusedxml.ElementTree import fromstring
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.wrench import MeasureDirection
from forcetorque.payload.export.arm_controllers_and_simulators import ARMS, READABLE_ARMS, read_arm_load
from forcetorque.payload.export.export import export_load
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.load_parameters import FlangeLoad, RobotLoad, flange_load
from forcetorque.robot.urdf import read_urdf

INERTIA = np.array([[0.004, -0.0008, 0.0003], [-0.0008, 0.005, 0.0006], [0.0003, 0.0006, 0.003]])
LOAD = RobotLoad(
    sensor="wrist",
    frame="tool0",
    direction=MeasureDirection.CHILD_TO_PARENT,
    mass=1.25,
    centre_of_mass=np.array([0.012, -0.008, 0.061]),
    inertia=INERTIA,
    bias=np.array([0.8, -0.5, 1.1, 0.02, -0.03, 0.01]),
)
DIGITS = 1e-8
"""Of nine digits that count."""
Back = tuple[float, FloatArray, FloatArray | None]


def _numbers(text: str) -> list[float]:
    return [float(word) for word in re.findall(r"(?<![\w.])-?\d+\.?\d*", text)]


def _symmetric(six: list[float]) -> FloatArray:
    xx, yy, zz, xy, xz, yz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _ur(text: str) -> Back:
    """URScript: set_target_payload(m, cog, [Ixx, Iyy, Izz, Ixy, Ixz, Iyz])."""
    (call,) = re.findall(r"^set_target_payload\((.*)\)$", text, re.MULTILINE)
    mass, *rest = _numbers(call)
    return mass, np.array(rest[:3]), _symmetric(rest[3:])


def _franka(text: str) -> Back:
    """Libfranka: setLoad(m, F_x_Cload, inertia column by column)."""
    (call,) = re.findall(r"^robot.set_load\((.*)\)$", text, re.MULTILINE)
    mass, *rest = _numbers(call)
    return mass, np.array(rest[:3]), np.array(rest[3:]).reshape(3, 3).T


def _kuka(text: str) -> Back:
    """KSS: the frame of J is turned by A about z, B about the new y, C about the new x; mm, deg."""
    centre, inertia = (",".join(rf"{name} (\S+)" for name in names) for names in ("XYZABC", "XYZ"))
    (found,) = re.findall(rf"^LOAD_DATA\[1\]={{M (\S+),CM {{{centre}}},J {{{inertia}}}}}$", text, re.MULTILINE)
    mass, x, y, z, a, b, c, *moments = map(float, found)
    turn = Rotation.from_euler("ZYX", [a, b, c], degrees=True).as_matrix()
    return mass, 1e-3 * np.array([x, y, z]), turn @ np.diag(moments) @ turn.T


def _abb(text: str) -> Back:
    """RAPID: [mass, [x, y, z] mm, [q1, q2, q3, q4] w first, ix, iy, iz]."""
    (found,) = re.findall(r"^PERS loaddata payload:=\[(.*)\];$", text, re.MULTILINE)
    mass, x, y, z, q1, q2, q3, q4, *moments = _numbers(found)
    turn = Rotation.from_quat([q2, q3, q4, q1]).as_matrix()
    assert np.linalg.norm([q1, q2, q3, q4]) == pytest.approx(1.0, abs=DIGITS)
    return mass, 1e-3 * np.array([x, y, z]), turn @ np.diag(moments) @ turn.T


def _fanuc(text: str) -> Back:
    """PAYLOAD SET: kg, cm, kgf cm s2 (1 kg m2 is 10.197); no products."""
    values = [float(line.split()[-1]) for line in text.splitlines()[1:]]
    return values[0], 1e-2 * np.array(values[1:4]), np.diag(values[4:]) / 10.1971621


def _xarm(text: str) -> Back:
    """SDK: set_tcp_load(kg, [x, y, z] mm), kept by save_conf."""
    (call,) = re.findall(r"^arm.set_tcp_load\((.*)\)\narm.save_conf\(\)$", text, re.MULTILINE)
    mass, *centre = _numbers(call)
    return mass, 1e-3 * np.array(centre), None


def _urdf(text: str) -> Back:
    """The reader of URDF: a link that is fixed to the flange, with the flange beside it."""
    root = fromstring(text)
    (inertial,) = root.iter("inertial")
    assert root.find("joint/parent").attrib == {"link": "tool0"}
    values = {tag.tag: tag.attrib for tag in inertial}
    six = [float(values["inertia"][name]) for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    return float(values["mass"]["value"]), np.array(_numbers(values["origin"]["xyz"])), _symmetric(six)


def _mjcf(text: str) -> Back:
    """MuJoCo: fullinertia is xx, yy, zz, xy, xz, yz about pos."""
    (inertial,) = fromstring(text).iter("inertial")
    attributes = inertial.attrib
    six = _numbers(attributes["fullinertia"])
    return float(attributes["mass"]), np.array(_numbers(attributes["pos"])), _symmetric(six)


TARGETS: dict[LoadFormat, Callable[[str], Back]] = {
    LoadFormat.UR: _ur,
    LoadFormat.FRANKA: _franka,
    LoadFormat.KUKA: _kuka,
    LoadFormat.ABB: _abb,
    LoadFormat.FANUC: _fanuc,
    LoadFormat.XARM: _xarm,
    LoadFormat.URDF: _urdf,
    LoadFormat.MJCF: _mjcf,
}


def _written(folder: Path, load: RobotLoad, form: LoadFormat, pose: FloatArray | None = None) -> tuple[str, str]:
    words = export_load(load, folder / "load", form, body_H_sensor=pose, force=True)
    return (folder / "load").read_text(encoding="utf-8"), words


@pytest.mark.parametrize("form", ARMS)
def test_the_load_comes_back(tmp_path: Path, form: LoadFormat) -> None:
    """Mass, centre and tensor by the arithmetic of the target; the bias that it lacks is named with its size."""
    text, words = _written(tmp_path, LOAD, form)
    mass, centre, inertia = TARGETS[form](text)
    assert mass == pytest.approx(LOAD.mass, rel=DIGITS)
    np.testing.assert_allclose(centre, LOAD.centre_of_mass, rtol=DIGITS)
    assert "it holds no bias: up to 1.1 N and 0.03 N m stay" in words
    if form is LoadFormat.XARM:
        assert inertia is None
        assert "it holds no inertia: up to 0.0055 N m are missed for each rad/s2" in words
        return
    assert inertia is not None
    expected = np.diag(np.diag(INERTIA)) if form is LoadFormat.FANUC else INERTIA
    np.testing.assert_allclose(inertia, expected, atol=DIGITS * 0.01)
    assert ("no products of inertia: up to 0.0008 N m" in words) == (form is LoadFormat.FANUC)


@pytest.mark.parametrize("form", READABLE_ARMS)
def test_a_written_load_is_read(tmp_path: Path, form: LoadFormat) -> None:
    """As the arithmetic of the target has it; another form, a second line and words in place of numbers are refused."""
    text, _ = _written(tmp_path, LOAD, form)
    mass, centre, inertia = TARGETS[form](text)
    load = read_arm_load(tmp_path / "load", form)
    assert load.mass == mass
    np.testing.assert_allclose(load.centre_of_mass, centre, rtol=0, atol=1e-15)
    assert inertia is not None
    np.testing.assert_allclose(load.inertia, inertia, rtol=0, atol=1e-15)
    number = "1.25"
    for broken in (text + text, text.replace(number, "heavy"), text.replace(number, "1e999"), "# nothing\n"):
        (tmp_path / "load").write_text(broken, encoding="utf-8")
        with pytest.raises(FormatError, match="expected"):
            read_arm_load(tmp_path / "load", form)


@pytest.mark.parametrize("form", ARMS)
def test_an_unknown_inertia_is_named(tmp_path: Path, form: LoadFormat) -> None:
    """Controllers get 0, simulators, which refuse that, a ball; both are said."""
    text, words = _written(tmp_path, replace(LOAD, inertia=None), form)
    inertia = TARGETS[form](text)[2]
    if inertia is None:
        assert "it holds no inertia: each 0.001 kg m2 of the load makes 0.001 N m for each rad/s2" in words
        return
    assert "the inertia is not known and written as" in words
    if form in (LoadFormat.URDF, LoadFormat.MJCF):
        radius = (3 * 1.25 / (4 * np.pi * 2700)) ** (1 / 3)
        np.testing.assert_allclose(inertia, 0.4 * 1.25 * radius**2 * np.eye(3), rtol=1e-6)
    else:
        assert not inertia.any()


def test_equal_moments_and_mirrors_are_no_trouble() -> None:
    """Principal axes are a rotation, of determinant 1, nearest to none, from which the tensor comes back."""
    rng = np.random.default_rng(3)
    for moments in ([1.0, 1.0, 1.0], [1.0, 1.0, 1.5], [0.7, 1.0, 1.5], [0.0, 0.0, 0.0]):
        for turn in (*Rotation.random(20, random_state=rng.integers(99)).as_matrix(), np.eye(3)):
            load = FlangeLoad(
                mass=1.0, centre_of_mass=np.zeros(3), inertia=turn @ np.diag(moments) @ turn.T, has_inertia=True
            )
            principal, axes = load.principal
            assert np.linalg.det(axes) == pytest.approx(1.0)
            np.testing.assert_allclose(axes @ np.diag(principal) @ axes.T, load.inertia, atol=1e-12)
    np.testing.assert_allclose(load.principal[1], np.eye(3))


def test_a_sensor_on_the_flange_has_a_pose(tmp_path: Path) -> None:
    """The centre and the tensor are moved into the flange; without a pose no frame is taken for it."""
    pose = make_pose(rotation_from_rpy([0.3, -0.2, 1.0]), [0.01, 0.02, -0.03])
    sensor = replace(LOAD, frame="wrist_ft")
    for form in ARMS:
        with pytest.raises(FormatError, match=rf"{form}: expected --sensor-pose, .* got the frame 'wrist_ft'"):
            _written(tmp_path, sensor, form)
    text, words = _written(tmp_path, sensor, LoadFormat.UR, pose)
    assert "each 0.1 kg of a sensor that is mounted on the flange makes 0.98 N" in words
    assert "mounted" not in _written(tmp_path, LOAD, LoadFormat.UR)[1]
    _, centre, inertia = _ur(text)
    np.testing.assert_allclose(centre, pose[:3, :3] @ LOAD.centre_of_mass + pose[:3, 3], rtol=1e-7)
    assert inertia is not None
    np.testing.assert_allclose(inertia, pose[:3, :3] @ INERTIA @ pose[:3, :3].T, atol=DIGITS * 0.01)


def test_what_a_target_refuses_is_refused(tmp_path: Path) -> None:
    """No rigid body, more than a controller takes, and a body without mass."""
    with pytest.raises(FormatError, match="franka: expected an inertia of a rigid body, .* got -0.001, 0.002, 0.003"):
        _written(tmp_path, replace(LOAD, inertia=np.diag([-0.001, 0.002, 0.003])), LoadFormat.FRANKA)
    assert flange_load(replace(LOAD, inertia=np.diag([0.001, 0.001, 0.0019])), "abb", None).has_inertia
    with pytest.raises(FormatError, match="expected an inertia of a rigid body"):
        flange_load(replace(LOAD, inertia=np.diag([0.001, 0.001, 0.0021])), "abb", None)
    with pytest.raises(FormatError, match="ur: expected an inertia of at most 133 kg m2, .* got 200"):
        _written(tmp_path, replace(LOAD, inertia=200.0 * np.eye(3)), LoadFormat.UR)
    nothing = replace(LOAD, mass=0.0, inertia=None)
    for form in (LoadFormat.URDF, LoadFormat.MJCF):
        with pytest.raises(FormatError, match=f"{form}: expected a mass above 0 kg"):
            _written(tmp_path, nothing, form)
    assert _ur(_written(tmp_path, nothing, LoadFormat.UR)[0])[0] == 0.0


def test_a_urdf_with_the_link_is_read(tmp_path: Path) -> None:
    """Beside the arm whose flange it names, by the reader of URDF."""
    text, _ = _written(tmp_path, LOAD, LoadFormat.URDF)
    arm = '<robot name="arm"><link name="base"/><link name="tool0"/><joint name="j" type="fixed"><parent link="base"/>'
    inner = text[text.index("<link") : text.rindex("</robot>")]
    file = tmp_path / "arm.urdf"
    file.write_text(f'{arm}<child link="tool0"/></joint>{inner}</robot>', encoding="utf-8")
    load = read_urdf(file).links["payload"]
    assert load.mass == pytest.approx(LOAD.mass)
    np.testing.assert_allclose(load.first_moment, LOAD.mass * LOAD.centre_of_mass, rtol=DIGITS)


def test_mujoco_takes_the_body(tmp_path: Path) -> None:
    """With a body that is included its flange weighs what the load weighs."""
    mujoco = pytest.importorskip("mujoco", reason="mujoco is not installed")
    _written(tmp_path, LOAD, LoadFormat.MJCF)
    model = tmp_path / "arm.xml"
    model.write_text(
        '<mujoco><worldbody><body name="tool0"><freejoint/><include file="load"/></body></worldbody></mujoco>',
        encoding="utf-8",
    )
    body = mujoco.MjModel.from_xml_path(str(model)).body("payload")
    assert float(body.mass[0]) == pytest.approx(LOAD.mass)
    turn = Rotation.from_quat(np.roll(body.iquat, -1)).as_matrix()
    np.testing.assert_allclose(turn @ np.diag(body.inertia) @ turn.T, INERTIA, atol=1e-9)
