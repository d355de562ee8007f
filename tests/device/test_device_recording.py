# SPDX-License-Identifier: BSD-3-Clause
"""What is logged of a device: the hinge where it is known, sensors with their truth, and one load as another."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.device.device_file import DeviceFile, read_device
from forcetorque.device.simulated_recordings import (
    DeviceRecording,
    _write_truth,
    draw_sensors,
    known_intervals,
    matrix_file,
    simulate_device,
)
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Use
from forcetorque.simulation.trace import EPOCH_NS

RATE_HZ = 20.0


def _file(**changes: object) -> DeviceFile:
    file = read_device()
    return file.changed(simulation=file.simulation.model_copy(update={"rate_hz": RATE_HZ, **changes}))


def _recordings(file: DeviceFile) -> list[DeviceRecording]:
    return list(simulate_device(file, draw_sensors(file)))


@pytest.fixture(scope="module")
def recordings() -> list[DeviceRecording]:
    """Of the device that comes with the library."""
    return _recordings(_file())


def test_there_is_one_for_each_load(recordings: list[DeviceRecording]) -> None:
    """Loads to calibrate with first, then those to judge with."""
    named = [(recording.load.name, recording.use) for recording in recordings]
    assert named == [("35 kg", Use.CALIBRATION), ("15 kg", Use.CALIBRATION), ("25 kg", Use.VALIDATION)]


def test_the_hinge_is_logged_at_locks_alone(recordings: list[DeviceRecording]) -> None:
    """Without an encoder it is at the last lock until it reaches the next, and known outside of the swing."""
    for recording in recordings:
        hinge = recording.recording.stream("joints").signals["position"].values[:, -1]
        assert set(np.rad2deg(hinge).round(9)) == {0.0, 90.0}
        (first_name, _, first_end_s), (second_name, second_start_s, _) = known_intervals(recording.trajectory)
        assert first_end_s < second_start_s
        assert (first_name, second_name) == ("hinge 0, 1", "hinge 90, 2")


def test_the_hinge_is_logged_where_it_is_in_known_intervals(recordings: list[DeviceRecording]) -> None:
    """From its lock to the swing and from the end of the swing on; in between the log has the lock that it left."""
    for recording in recordings:
        stamps = recording.recording.stream("joints").stamp_ns
        seconds = seconds_since(stamps, EPOCH_NS)
        logged = recording.recording.stream("joints").signals["position"].values[:, -1]
        hinge = recording.trajectory(seconds).position[:, -1]
        (_, _, first_end_s), (_, second_start_s, _) = known_intervals(recording.trajectory)
        swings = (seconds > first_end_s) & (seconds < second_start_s)
        np.testing.assert_allclose(logged[~swings], hinge[~swings], atol=1e-9)
        assert not logged[swings].any()
        assert (np.abs(logged - hinge)[swings] > 1e-6).mean() > 0.9


def test_an_encoder_of_the_hinge_sees_the_swing() -> None:
    """Then all of the recording is one interval."""
    file = _file(loads_kg=(35.0,), validation_kg=())
    file = file.changed(hinge=file.hinge.model_copy(update={"encoder": True}))
    (recording,) = _recordings(file)
    hinge = recording.recording.stream("joints").signals["position"].values[:, -1]
    assert ((hinge > 0.1) & (hinge < 1.4)).sum() > RATE_HZ
    assert [name for name, _, _ in known_intervals(recording.trajectory)] == ["all"]


def test_one_more_load_changes_no_other(recordings: list[DeviceRecording]) -> None:
    """Sensors, offsets and noise of a load are its own."""
    (alone,) = _recordings(_file(loads_kg=(35.0,), validation_kg=()))
    for stream in ("ft_1", "joints"):
        ours, theirs = (one.recording.stream(stream) for one in (alone, recordings[0]))
        for name, signal in ours.signals.items():
            np.testing.assert_array_equal(signal.values, theirs.signals[name].values)


def test_another_seed_is_another_sensor() -> None:
    """Negative control: matrices are drawn."""
    first, second = (draw_sensors(_file(seed=seed))["ft_1"].sensor.matrix for seed in (1, 2))
    assert np.abs(first - second).max() > 0.0


def test_sensors_keep_their_serial_numbers() -> None:
    """Three sensors in a stack are three different sensors."""
    file = _file().with_sensors(3)
    sensors = draw_sensors(file)
    assert [sensor.serial for sensor in sensors.values()] == [s.serial for s in file.sensor]
    matrices = [sensor.sensor.matrix for sensor in sensors.values()]
    assert all(np.abs(matrices[k] - matrices[k - 1]).max() > 0.0 for k in range(3))


def test_prior_matrices_are_written_where_they_are_named(tmp_path: Path) -> None:
    """They are those of the workbench within half a step of their code; without `prior` there is none."""
    file = _file(prior=True).with_sensors(2)
    sensors = draw_sensors(file)
    _write_truth(tmp_path, file, sensors)
    for sensor in sensors.values():
        written = read_matrix_file(tmp_path / matrix_file(sensor.serial))
        half_step = np.array(written.full_scale)[:, None] / 32767 / 2**16
        assert (np.abs(written.matrix - sensor.workbench) <= 1.001 * half_step).all()
        assert (np.abs(sensor.workbench) > 2.0 * half_step).any(axis=1).all()
    assert len(list(tmp_path.glob("matrix_*"))) == 2
    (tmp_path / "other").mkdir()
    _write_truth(tmp_path / "other", _file(), sensors)
    assert [path.name for path in (tmp_path / "other").iterdir()] == ["truth.json"]
