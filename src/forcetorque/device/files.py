# SPDX-License-Identifier: BSD-3-Clause
"""A device on disk: URDFs, trajectories, simulated recordings with their experiment files, and the truth."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from pathlib import Path

from forcetorque.base.arrays import FloatArray
from forcetorque.base.files import new_folder
from forcetorque.device.device import DeviceDesign, DeviceRecordingRow
from forcetorque.device.file import DeviceFile
from forcetorque.device.model import BASE, device_model
from forcetorque.device.recording import DeviceRecording, DeviceSpecimens, simulate_device
from forcetorque.device.trajectory import DeviceTrajectory
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.planning.trajectory import write_trajectory
from forcetorque.recording.storage import write_recording
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.urdf_text import write_urdf
from forcetorque.simulation.recordings.truth import TRUTH_FILE, TRUTH_SCHEMA
from forcetorque.simulation.scenario.plan import INTERVAL_MARGIN_S
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


def write_device(
    design: DeviceDesign, output: Path | str, *, progress: Callable[[str], None] = lambda _: None
) -> DeviceDesign:
    """Write a device, all or nothing.

    A URDF for every load that is simulated and, for the 12 steps, one of the device with its axes swapped;
    trajectories of the motors as a table, for ROS and for YARP; a log and an experiment file for every load; the truth
    of its sensors.

    Args:
        design: The device.
        output: Folder to make.
        progress: Called with what is being done.

    Returns:
        The design with its recordings and the name of the folder.
    """
    file, rows = design.file, []
    specimens = DeviceSpecimens.draw(file)
    with new_folder(Path(output)) as folder:
        for name, trajectory in design.trajectories.items():
            motors = trajectory.device.joint_names[:-1]
            write_trajectory(folder, _stem(name), partial(_motors, trajectory), ("rad",) * len(motors))
            if trajectory.device.yaw_first != file.yaw_first:
                write_urdf(folder / "device_axes_swapped.urdf", device_model(trajectory.device, trajectory.load))
        for simulated in simulate_device(file, specimens):
            progress(f"writing {simulated.load.name}: {simulated.trajectory.duration_s:.0f} s")
            rows.append(_write_recording(folder, file, simulated))
        _write_truth(folder, file, specimens)
    return design.model_copy(update={"recordings": tuple(rows), "folder": str(output)})


def _stem(name: str) -> str:
    return name.replace(",", "").replace(" ", "_")


def _motors(trajectory: DeviceTrajectory, rate_hz: float) -> tuple[FloatArray, JointMotion]:
    """What motors do: all joints but the hinge, which gravity moves."""
    time, motion = trajectory.sampled(rate_hz)
    return time, JointMotion(
        names=motion.names[:-1],
        position=motion.position[:, :-1],
        velocity=motion.velocity[:, :-1],
        acceleration=motion.acceleration[:, :-1],
    )


def _write_recording(folder: Path, file: DeviceFile, simulated: DeviceRecording) -> DeviceRecordingRow:
    stem = _stem(simulated.load.name)
    urdf = f"device_{stem}.urdf"
    write_urdf(folder / urdf, simulated.model)
    write_recording(folder / stem, simulated.recording)
    text = device_experiment_text(file, simulated, urdf=urdf, recording=stem)
    (folder / f"{stem}.toml").write_text(text, encoding="utf-8")
    held = [simulated.recording.stream(name).held for name in file.sensor_names]
    return DeviceRecordingRow(
        experiment=f"{stem}.toml",
        load=simulated.load.name,
        use=simulated.use.value,
        seconds=simulated.trajectory.duration_s,
        samples=sum(len(values) for values in held),
        saturated=int(sum(values.sum() for values in held)),
    )


def _write_truth(folder: Path, file: DeviceFile, specimens: DeviceSpecimens) -> None:
    """What is true of the sensors, and the matrices that they had before where experiment files name them."""
    sensors = {}
    for name, specimen in specimens.specimens.items():
        if file.simulation.prior:
            write_matrix_file(folder / matrix_file(specimen.serial), encode_matrix(specimen.workbench))
        sensors[name] = {
            "serial": specimen.serial,
            "matrix": specimen.sensor.matrix.tolist(),
            "workbench_matrix": specimen.workbench.tolist(),
            "offset": specimens.mounted[name].offset.tolist(),
            "noise_counts": specimen.sensor.noise_counts,
        }
    truth = {"schema": TRUTH_SCHEMA, "scenario": file.name, "seed": file.simulation.seed, "sensors": sensors}
    (folder / TRUTH_FILE).write_text(json.dumps(truth, indent=2, allow_nan=False) + "\n", encoding="utf-8")
