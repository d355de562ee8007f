# SPDX-License-Identifier: BSD-3-Clause
"""A load of an earlier result is known as well as that result says, and no better than anything is weighed."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.base.inertia import Inertia
from forcetorque.payload.export.load_parameters import require_rigid
from forcetorque.payload.identification.estimation_problem import Load
from forcetorque.payload.identification.parameter_vector import six_of
from forcetorque.payload.load_from_result_file import (
    SCHEMA,
    _of_usual_size,
    read_load_from_file,
    read_wrist_load_from_file,
)
from forcetorque.payload.load_tables import LinkLoad
from forcetorque.payload.loads_on_robot_links import read_link_loads
from forcetorque.robot.urdf import read_urdf_text

INERTIAL = [1.5, 0.03, 0.0, 0.15, 4e-3, 0.0, 0.0, 4e-3, 0.0, 3e-3]


def _written(folder: Path, covariance: FloatArray) -> Path:
    load = {"load": "tool", "estimated": True, "mass_kg": INERTIAL[0], "link": "hand", "inertial": INERTIAL}
    file = folder / "payload.json"
    content = {"schema": SCHEMA, "serial": "FT1", "loads": [load | {"covariance": covariance.tolist()}]}
    file.write_text(json.dumps(content), encoding="utf-8")
    return file


def test_the_precision_is_that_of_the_covariance(tmp_path: Path) -> None:
    """With correlations, of standard deviations far above what is rounded."""
    root = np.diag([0.02, *[0.005] * 3, *[0.001] * 6]) @ np.random.default_rng(2).normal(size=(10, 10))
    covariance = root @ root.T
    found = read_load_from_file(_written(tmp_path, 0.5 * (covariance + covariance.T)), "tool", "hand")
    np.testing.assert_allclose(found.load.precision @ covariance, np.eye(10), atol=1e-2)
    np.testing.assert_array_equal(found.load.expected, INERTIAL)
    assert (found.serial, found.known_loads) == ("FT1", ())


def test_a_stated_load_is_as_exact_as_anything_is_weighed(tmp_path: Path) -> None:
    """Without a deviation: 0.1 g, 10 g mm, 1 kg mm2, and no singular matrix."""
    found = read_load_from_file(_written(tmp_path, np.zeros((10, 10))), "tool", "hand")
    deviations = 1.0 / np.sqrt(np.diag(found.load.precision))
    np.testing.assert_allclose(deviations, [1e-4, *[1e-5] * 3, *[1e-6] * 6])


@pytest.mark.parametrize("covariance", [-np.eye(10), np.eye(10) + np.eye(10, k=1)])
def test_a_matrix_that_is_no_covariance_is_refused(tmp_path: Path, covariance: FloatArray) -> None:
    """Negative, or without symmetry."""
    with pytest.raises(FormatError, match="covariance: expected a symmetric positive matrix of 'tool'"):
        read_load_from_file(_written(tmp_path, covariance), "tool", "hand")


@pytest.mark.parametrize("mass", [0.4, 3.0])
def test_a_load_stands_for_a_stated_one_where_its_mass_is_known_to_a_twentieth(tmp_path: Path, mass: float) -> None:
    """Half of its interval over it, for light and heavy ones; its centre is kept."""
    for share, is_known in ((0.049, True), (0.051, False)):
        load = {"load": "tool", "estimated": True, "mass_kg": mass, "mass_half_width_95_kg": share * mass}
        load |= {"centre_of_mass_m": [0.0, 0.01, 0.05], "inertia_kgm2": None}
        file = tmp_path / "payload.json"
        content = {"schema": SCHEMA, "serial": "FT1", "frame": "wrist", "loads": [load]}
        file.write_text(json.dumps(content), encoding="utf-8")
        if is_known:
            found = read_wrist_load_from_file(file, "tool", "wrist").load
            assert found.mass == mass
            np.testing.assert_array_equal(found.centre_of_mass, [0.0, 0.01, 0.05])
        else:
            with pytest.raises(ExperimentError, match=r"expected a mass that is known to 5 % \(95 %\)"):
                read_wrist_load_from_file(file, "tool", "wrist")


def test_a_load_of_usual_size_is_a_body_of_a_tenth_of_a_metre_about_its_centre() -> None:
    """By the parallel axis theorem, component by component, and its deviation by the square of the radius."""
    mass, (x, y, z) = 2.5, (centre := np.array([0.1, -0.2, 0.3]))
    point = Inertia.about_centre_of_mass(mass=mass, centre_of_mass=centre, second_moment=np.zeros((3, 3)))
    estimate: Any = SimpleNamespace(mass=mass, centre_of_mass=centre)
    load = _of_usual_size(Load(name="tool", inertia="unknown"), estimate)
    assert load.expected is not None
    assert load.precision is not None
    own = [y * y + z * z, x * x + z * z, x * x + y * y, -x * y, -x * z, -y * z]
    np.testing.assert_allclose(load.expected, [0.0] * 4 + [mass * one for one in own], rtol=1e-12)
    np.testing.assert_allclose(load.expected[4:], six_of(point.second_moment), rtol=1e-12)
    np.testing.assert_allclose(np.diag(load.precision), [0.0] * 4 + [1.0 / (mass * 0.1**2) ** 2] * 6, rtol=1e-12)
    assert not (load.precision - np.diag(np.diag(load.precision))).any()


@pytest.mark.parametrize(
    ("moments", "is_rigid"),
    [((1.0, 2.0, 2.999), True), ((1.0, 2.0, 3.001), False), ((1e-9, 1.0, 1.0), True), ((-1e-9, 1.0, 1.0), False)],
)
def test_a_rigid_body_has_no_moment_above_the_sum_of_the_others(moments: tuple[float, ...], is_rigid: bool) -> None:
    """Nor one below zero, along any axes."""
    axes = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    inertia = axes @ np.diag(moments) @ axes.T
    if is_rigid:
        require_rigid(inertia, "tool")
    else:
        with pytest.raises(FormatError, match="tool: expected an inertia of a rigid body"):
            require_rigid(inertia, "tool")


def test_each_load_of_an_experiment_is_that_of_its_own_result(tmp_path: Path) -> None:
    """Two of results, with a specified one between them, stay in the order of the file."""
    for name, mass in (("gripper", 0.8), ("weight", 5.0)):
        inertial = [mass, *INERTIAL[1:]]
        load = {"load": name, "estimated": True, "mass_kg": mass, "link": "hand", "inertial": inertial}
        content = {"schema": SCHEMA, "serial": "FT1", "loads": [load | {"covariance": np.zeros((10, 10)).tolist()}]}
        (tmp_path / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")
    tables = [
        LinkLoad.model_validate({"name": "gripper", "link": "hand", "from": "gripper.json"}),
        LinkLoad.model_validate({"name": "plate", "link": "hand", "mass_kg": 2.0}),
        LinkLoad.model_validate({"name": "weight", "link": "hand", "from": "weight.json"}),
    ]
    loading: Any = SimpleNamespace(
        file=tmp_path / "experiment.toml",
        model=SimpleNamespace(name="arm", links={"hand": None}),
        sensors=(),
        inputs=SimpleNamespace(file=lambda name: tmp_path / name),
        parsed=SimpleNamespace(interval=[]),
        recording=SimpleNamespace(intervals=[]),
    )
    loads = read_link_loads(tables, loading)
    assert loads is not None
    assert [load.name for load in loads.loads] == ["gripper", "plate", "weight"]
    known = [None if load.expected is None else float(load.expected[0]) for load in loads.loads]
    assert (known, loads.loads[1].mass) == ([0.8, None, 5.0], 2.0)
    assert [file.load.name for file in loads.weighed] == ["gripper", "weight"]


BODY = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
ARM = f"""<robot name="arm"><link name="base"/><link name="shelf"/>
<joint name="side" type="fixed"><parent link="base"/><child link="shelf"/></joint>
<link name="arm">{BODY}</link>
<joint name="lower" type="fixed"><parent link="base"/><child link="arm"/></joint>
<link name="hand">{BODY}</link>
<joint name="wrist" type="fixed"><parent link="arm"/><child link="hand"/></joint>
<gazebo reference="lower"><sensor name="low" type="force_torque"/></gazebo>
<gazebo reference="wrist"><sensor name="high" type="force_torque"/></gazebo></robot>"""


def _loads_of(folder: Path, *links: str, mass_kg: float | None = None) -> Any:
    """Loads on links of an arm with two sensors, each in an interval of its own."""
    supports = [SimpleNamespace(frame="base") for _ in links]
    tables = [LinkLoad(name=f"load {k}", link=link, mass_kg=mass_kg) for k, link in enumerate(links)]
    loading: Any = SimpleNamespace(
        file=folder / "experiment.toml",
        model=read_urdf_text(ARM, where="arm"),
        sensors=tuple(SimpleNamespace(name=name) for name in ("low", "high")),
        parsed=SimpleNamespace(interval=[SimpleNamespace(label=str(k), load=f"load {k}") for k in range(len(links))]),
        recording=SimpleNamespace(
            intervals=[SimpleNamespace(label=str(k), support=support) for k, support in enumerate(supports)]
        ),
    )
    return read_link_loads(tables, loading)


@pytest.mark.parametrize(
    ("links", "sensor"), [(("hand",), "high"), (("arm",), "low"), (("hand", "arm"), "low"), (("arm", "hand"), "low")]
)
def test_the_nearest_sensor_that_feels_every_load_identifies_them(
    tmp_path: Path, links: tuple[str, ...], sensor: str
) -> None:
    """On the hand that of the wrist, on the link before it only the lower one."""
    assert _loads_of(tmp_path, *links).sensor.name == sensor


@pytest.mark.parametrize("links", [("shelf",), ("hand", "shelf"), ("shelf", "hand")])
def test_a_load_that_no_sensor_feels_is_refused(tmp_path: Path, links: tuple[str, ...]) -> None:
    """Beside a load on the hand too, and of a gram; a load of nothing may be on any link."""
    where = rf"load\[{links.index('shelf')}\] .*: expected a link beyond a sensor .* got 'shelf', whose load no sensor"
    for mass_kg in (None, 1e-3, 1.0):
        with pytest.raises(ExperimentError, match=where):
            _loads_of(tmp_path, *links, mass_kg=mass_kg)
    assert _loads_of(tmp_path, *links, mass_kg=0.0).sensor is None
