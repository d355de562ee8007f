# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file of a simulated recording of a calibration device."""

from __future__ import annotations

import json

from forcetorque.exsitu.device import BASE, DeviceFile, DeviceRecording
from forcetorque.simulation.scenario import INTERVAL_MARGIN_S
from forcetorque.simulation.trace import IMU_STREAM


def device_experiment_text(device: DeviceFile, simulated: DeviceRecording, *, urdf: str, recording: str) -> str:
    """Write the experiment file of a recording.

    Args:
        device: The device.
        simulated: The recording.
        urdf: File of the device with its load.
        recording: Folder of the recording.

    Returns:
        The file, TOML; an interval for every stretch in which the position of the hinge is known.
    """
    simulation = device.simulation
    name = json.dumps(f"{device.name}, {simulated.load.name}")
    text = [
        f'schema = "forcetorque/experiment/1"\nname = {name}\n',
        f"\n[robot]\nurdf = {json.dumps(urdf)}\ngravity = {device.gravity!r}\n",
        f'\n[recording]\nformat = "parquet"\npath = {json.dumps(recording)}\n',
        *(_sensor_text(device, number) for number in range(len(device.sensor))),
        f"\n[calibration]\naccuracy = {{ force_N = {simulation.accuracy_N!r}, "
        f"moment_Nm = {simulation.accuracy_Nm!r} }}\n",
        f'\n[[support]]\nframe = "{BASE}"\n{_gravity(device)}\n',
    ]
    text += [
        f"\n[[interval]]\nlabel = {json.dumps(f'{simulated.load.name}, {stretch.name}')}\n"
        f"start_s = {stretch.start_s + INTERVAL_MARGIN_S:.3f}\nend_s = {stretch.end_s - INTERVAL_MARGIN_S:.3f}\n"
        f'use = "{simulated.use.value}"\nsupport = "{BASE}"\n'
        for stretch in simulated.stretches
    ]
    return "".join(text)


def matrix_file(serial: str) -> str:
    """Name the file of the matrix that a sensor had before.

    Args:
        serial: Serial number.

    Returns:
        Name of the file.
    """
    return f"matrix_{serial}.txt"


def _sensor_text(device: DeviceFile, number: int) -> str:
    sensor = device.sensor[number]
    prior = f"prior = {json.dumps(matrix_file(sensor.serial))}\n" if device.simulation.prior else ""
    return (
        f"\n[[sensor]]\nname = {json.dumps(sensor.name)}\nstream = {json.dumps(sensor.name)}\n"
        f"serial = {json.dumps(sensor.serial)}\n{prior}"
        f"limit_counts = {float(device.simulation.sensors.limit_counts)!r}\n"
    )


def _gravity(device: DeviceFile) -> str:
    """An IMU tells gravity where there is one; else the base is taken to be level."""
    return f'imu = ["{IMU_STREAM}"]' if device.simulation.imu is not None else "gravity_direction = [0.0, 0.0, -1.0]"
