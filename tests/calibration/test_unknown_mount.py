# SPDX-License-Identifier: BSD-3-Clause
"""A sensor that is turned against its stated frame: warned of, estimated where the file asks for it, or refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.scenes.wrist_postures import write_postures

TURN_DEG = np.array([0.0, 0.0, 17.2])
SHIFT_M = np.array([0.01, -0.02, 0.015])
ALL = '[[interval]]\nlabel = "all"\nstart_s = 0.0\nuse = "calibration"\n'
POSTURES = Rotation.random(8, random_state=3)
ABOUT_ONE_AXIS = Rotation.from_rotvec(np.outer(np.linspace(0.0, 300.0, 8), [0.0, 0.0, 1.0]), degrees=True)
SEED = 41


def _written(folder: Path, turn_deg: np.ndarray, postures: Rotation = POSTURES, mount: str = "") -> Path:
    """A log of which the readings are those of a sensor that is turned by `turn_deg` and shifted."""
    path = write_postures(folder, seed=SEED, postures=postures)
    header, *_ = (folder / "log.csv").read_text().split("\n", 1)
    values = np.loadtxt(folder / "log.csv", delimiter=",", skiprows=1)
    force, moment = values[:, 1:4], values[:, 4:7]
    if turn_deg.any():
        moment = moment - np.cross(SHIFT_M, force)
    into = Rotation.from_rotvec(turn_deg, degrees=True).inv()
    values[:, 1:7] = np.hstack([into.apply(force), into.apply(moment)])
    np.savetxt(folder / "log.csv", values, delimiter=",", header=header, comments="", fmt="%.9g")
    head, *_ = path.read_text().split("[[interval]]")
    path.write_text(head.replace('prior = "identity"', f'prior = "identity"\n{mount}') + ALL)
    return path


def _run(path: Path) -> SensorRun:
    return SensorRun(load_experiment(path), "wrist")


def _calibrated(path: Path) -> Calibration:
    return calibrate_sensor(_run(path), code_version="0", created="2026-01-01T00:00:00Z")


def test_a_turned_sensor_is_warned_of_and_estimated(tmp_path: Path) -> None:
    """Without the key a warning proposes it; with it the mount lies within its interval and the matrix stays."""
    warned = _calibrated(_written(tmp_path, TURN_DEG))
    (sentence,) = (doubt for doubt in warned.warnings if doubt.startswith("turned by"))
    assert "set mount = \"unknown\" for sensor 'wrist'" in sentence
    assert warned.mount is None
    calibration = _calibrated(_written(tmp_path, TURN_DEG, mount='mount = "unknown"'))
    mount = calibration.mount
    assert mount is not None
    assert mount.rotation_half_width_deg is not None
    assert mount.shift_half_width_mm is not None
    assert (np.abs(mount.rotation_deg - TURN_DEG) < mount.rotation_half_width_deg).all()
    assert (np.abs(mount.shift_mm - 1e3 * SHIFT_M) < mount.shift_half_width_mm).all()
    assert not any(doubt.startswith("turned by") for doubt in calibration.warnings)
    # the sensor itself is exact
    assert np.abs(calibration.matrix[:3, :3] - np.eye(3)).max() < np.abs(warned.matrix[:3, :3] - np.eye(3)).max()
    assert "estimated mount: turned by" in mount.text
    assert Calibration.model_validate_json(calibration.model_dump_json(by_alias=True)).mount is not None


@pytest.mark.long
def test_a_mount_as_stated_is_no_warning(tmp_path: Path) -> None:
    """Negative control."""
    assert _calibrated(_written(tmp_path, np.zeros(3))).warnings == ()


@pytest.mark.long
def test_a_calibration_fits_the_mount_that_it_was_made_with(tmp_path: Path) -> None:
    """The printed key is stated for other analyses; without it, or unknown, they refuse."""
    unknown = _written(tmp_path, TURN_DEG, mount='mount = "unknown"')
    calibration = _calibrated(unknown)
    assert calibration.mount is not None
    with pytest.raises(ExperimentError, match="its mount is unknown"):
        _run(unknown).samples(Use.CALIBRATION)
    with pytest.raises(ExperimentError, match="with which it was fitted, got no mount"):
        _run(_written(tmp_path, TURN_DEG)).require_fit("new", calibration)
    stated = _run(_written(tmp_path, TURN_DEG, mount=calibration.mount.table))
    stated.require_fit("new", calibration)
    reference = stated.samples(Use.CALIBRATION)[0].samples
    left = reference.reading.values - reference.reference
    assert np.std(left[:, :3], axis=0).max() < 0.1 * np.std(reference.reference[:, :3])


@pytest.mark.parametrize(
    "postures",
    [Rotation.from_rotvec(np.outer([0.0, 5.0] * 4, [1.0, 0.0, 0.0]), degrees=True), ABOUT_ONE_AXIS],
    ids=["rocked about one axis", "turned about gravity"],
)
def test_a_mount_that_the_motion_does_not_tell_is_refused(tmp_path: Path, postures: Rotation) -> None:
    """The error says what motion is missing."""
    path = _written(tmp_path, TURN_DEG, postures, mount='mount = "unknown"')
    with pytest.raises(FitError, match="turn the sensor about two level axes"):
        _calibrated(path)
