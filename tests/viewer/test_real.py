# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of measured logs: a balancing iCub, and a wrist sensor without a robot."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene, build_scene
from tests.viewer.poses import link_poses

pytestmark = [pytest.mark.real_data, pytest.mark.long]

EXAMPLES = Path(__file__).parents[2] / "examples"


def _built(name: str, data_dir: Path, folder: Path) -> BuiltScene:
    """Scene of an example."""
    file = folder / name
    text = (EXAMPLES / name).read_text(encoding="utf-8")
    file.write_text(text.replace("../../shared/data", data_dir.as_posix()), encoding="utf-8")
    robot = parse_experiment(file).robot
    return build_scene(load_experiment(file), {}, urdf=None if robot is None else file.parent / robot.urdf)


@pytest.fixture(scope="module", name="yoga")
def icub_on_one_leg(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> BuiltScene:
    """Scene of the yoga log."""
    return _built("08_icub_yoga_contacts.toml", data_dir, tmp_path_factory.mktemp("yoga"))


def test_a_balancing_icub_stands_on_its_left_foot(yoga: BuiltScene) -> None:
    """All 75 s are there; the left sole stands still, level and at the origin while the right foot is lifted."""
    seconds = read_array(yoga.block, yoga.scene.time_s)
    assert len(seconds) == yoga.scene.samples > 7000
    assert (np.diff(seconds) > 0.0).all()
    shown = [link_poses(yoga, sample) for sample in range(0, len(seconds), 100)]
    for poses in shown:
        np.testing.assert_allclose(poses["l_sole"], np.eye(4), rtol=0, atol=1e-6)
    height = np.array([poses["r_sole"][2, 3] for poses in shown])
    down, lifted = seconds[::100] < 10.0, (seconds[::100] > 30.0) & (seconds[::100] < 50.0)
    assert np.abs(height[down]).max() < 0.02
    assert height[lifted].min() > 0.1
    assert all(0.4 < poses["root_link"][2, 3] < 0.8 for poses in shown)  # it stands upright


def test_wrenches_of_the_icub_agree_where_its_foot_is_free(yoga: BuiltScene) -> None:
    """Measured and expected forces are some newtons apart in the free intervals and far apart on both feet."""
    leg, foot = yoga.scene.sensors
    assert (leg.name, foot.name) == ("r_leg_ft_sensor", "r_foot_ft_sensor")
    expected, logged = (read_array(yoga.block, series.values)[:, :3] for series in leg.wrenches)
    seconds = read_array(yoga.block, yoga.scene.time_s)
    error = np.linalg.norm(logged - expected, axis=1)
    assert np.nanmean(error[(seconds > 40.0) & (seconds < 58.0)]) < 5.0
    assert np.nanmean(error[seconds < 10.0]) > 100.0
    assert np.isnan(expected[(seconds > 17.1) & (seconds < 31.9)]).all()
    (weight,) = (series.reference_force for series in leg.wrenches if series.role == "expected")
    assert weight is not None
    assert weight.radius == pytest.approx(46.4, abs=0.1)
    assert {contact.name for contact in yoga.scene.contacts} >= {"r_leg_ft_sensor", "r_foot_ft_sensor"}
    assert yoga.scene.findings
    notes = "\n".join(yoga.scene.notes)
    assert "mesh(es) not found (model://iCubGenova02/meshes/dae/root.dae" in notes
    assert "no stream holds the position of 14 joint(s)" in notes


def test_a_wrist_sensor_turns_as_gravity_says(data_dir: Path, tmp_path: Path) -> None:
    """Without a robot the load hangs at the origin, turned so that the logged gravity points down."""
    built = _built("07_wrist_payload.toml", data_dir, tmp_path)
    assert built.scene.coordinates == ()
    (sensor,) = built.scene.sensors
    (series,) = (series for series in sensor.wrenches if series.role == "expected")
    force = read_array(built.block, series.values)[:, :3]
    for sample in range(built.scene.samples):
        world_R_sensor = link_poses(built, sample)[sensor.link][:3, :3]
        down = world_R_sensor @ force[sample] / np.linalg.norm(force[sample])
        np.testing.assert_allclose(down, [0, 0, -1], rtol=0, atol=1e-5)  # what hangs pulls downwards
    assert any("moves: it is kept in its place" in note for note in built.scene.notes)
