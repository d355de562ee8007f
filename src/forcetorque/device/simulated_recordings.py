# SPDX-License-Identifier: BSD-3-Clause
"""Simulated recordings of a device, and its files: URDFs, trajectories, experiment files, logs and the truth."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.output_file import new_folder
from forcetorque.device.components import AttachedLoad, device_load
from forcetorque.device.design import DeviceDesign, DeviceRecordingRow
from forcetorque.device.device_file import DeviceFile
from forcetorque.device.motion import DeviceTrajectory
from forcetorque.device.robot_model import BASE, device_model
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.planning.trajectory_files import write_trajectory
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.storage import write_recording
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.urdf_and_mjcf_text import write_urdf
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.recordings import TRUTH_FILE, TRUTH_SCHEMA
from forcetorque.simulation.scenario.scenario import INTERVAL_MARGIN_S, draw_imu
from forcetorque.simulation.sensor_family import Specimen, draw_specimen
from forcetorque.simulation.trace import EPOCH_NS, IMU_STREAM, record

_SENSORS, _POWER_UP, _NOISE, _IMU = 1, 2, 6, 8
"""Keys of streams of random numbers: one more load changes no other."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeviceRecording:
    """A recording of one load."""

    load: AttachedLoad
    """Load attached to the device."""
    model: RobotModel
    """The device with the load."""
    trajectory: DeviceTrajectory
    """Its motion."""
    recording: Recording
    """The log."""
    use: Use
    """Calibration or validation."""


def draw_sensors(file: DeviceFile) -> dict[str, Specimen]:
    """Draw the sensors of a device and switch them on; the device is not switched off between loads.

    Args:
        file: The device, with the description of its sensors.

    Returns:
        The sensors by name, with their true values.
    """
    seed, sensors = file.simulation.seed, {}
    for k, sensor in enumerate(file.sensor):
        drawn = draw_specimen(file.simulation.sensors, k, np.random.default_rng([seed, _SENSORS, k]))
        powered = drawn.powered_up(np.random.default_rng([seed, _POWER_UP, drawn.number]))
        sensors[sensor.name] = replace(drawn, serial=sensor.serial, sensor=powered)
    return sensors


def simulate_device(file: DeviceFile, sensors: Mapping[str, Specimen]) -> Iterator[DeviceRecording]:
    """Simulate a recording of the motion of a device with every load of its file.

    Args:
        file: The device, its motion and loads.
        sensors: Its sensors.

    Yields:
        A recording per load.
    """
    simulation = file.simulation
    uses = {Use.CALIBRATION: simulation.loads_kg, Use.VALIDATION: simulation.validation_kg}
    loads = [(load, use) for use, loads in uses.items() for load in loads]
    for number, (load_kg, use) in enumerate(loads):
        load = device_load(file, load_kg)
        trajectory = DeviceTrajectory(device=file, load=load, sequence=file.sequence, hold_s=file.motion.hold_s)
        model = device_model(file, load)
        imu = None
        if simulation.imu is not None:
            imu = draw_imu(simulation.imu, model, np.random.default_rng([simulation.seed, _IMU]), where=file.name)
        recording = record(
            _movement(trajectory, model),
            {name: sensor.sensor for name, sensor in sensors.items()},
            rate_hz=simulation.rate_hz,
            rng=np.random.default_rng([simulation.seed, _NOISE, number]),
            imu=imu,
        )
        logged = _with_logged_hinge(recording, trajectory)
        yield DeviceRecording(load=load, model=model, trajectory=trajectory, recording=logged, use=use)


def known_intervals(trajectory: DeviceTrajectory) -> list[tuple[str, float, float]]:
    """Find the intervals in which the position of the hinge is known.

    Args:
        trajectory: Motion of the device.

    Returns:
        Name, such as `hinge 90, 1`, start and end in s: of the whole trajectory with an encoder, else of the intervals
        in which the hinge stays locked.
    """
    sequence, ways = trajectory.sequence, trajectory.ways
    if trajectory.device.hinge.encoder:
        return [("all", 0.0, trajectory.duration_s)]
    swings = np.flatnonzero(sequence.unlocked)
    starts = [0.0, *(ways.departures_s + ways.durations_s)[swings].tolist()]
    ends = [*ways.departures_s[swings].tolist(), trajectory.duration_s]
    locks = np.rint(np.rad2deg(sequence.postures[[0, *(swings + 1)], -1])).astype(int)
    return [
        (f"hinge {lock}, {number}", start, end)
        for number, (lock, start, end) in enumerate(zip(locks, starts, ends, strict=True), start=1)
    ]


def _with_logged_hinge(recording: Recording, trajectory: DeviceTrajectory) -> Recording:
    """The recording as logged: without an encoder the position of the hinge is that of its last lock."""
    if trajectory.device.hinge.encoder:
        return recording
    sequence, ways = trajectory.sequence, trajectory.ways
    joints = recording.stream("joints")
    time_s = seconds_since(joints.stamp_ns, EPOCH_NS)
    arrived = np.searchsorted(ways.departures_s + ways.durations_s, time_s, side="right")
    position = np.array(joints.signals["position"].values)
    position[:, -1] = sequence.postures[arrived, -1]
    signal = replace(joints.signals["position"], values=position)
    return replace(recording, streams={**recording.streams, "joints": replace(joints, signals={"position": signal})})


def _movement(trajectory: DeviceTrajectory, model: RobotModel) -> Movement:
    return Movement(
        name=trajectory.sequence.name,
        kind=MovementKind.GRID,
        model=model,
        support=BASE,
        world_H_support=np.eye(4),
        duration_s=trajectory.duration_s,
        trajectory=trajectory,
    )


def device_experiment_text(device: DeviceFile, simulated: DeviceRecording, *, urdf: str, recording: str) -> str:
    """Write the experiment file of a recording.

    Args:
        device: The device.
        simulated: The recording.
        urdf: File of the device with its load.
        recording: Folder of the recording.

    Returns:
        The file, TOML, with the intervals in which the position of the hinge is known.
    """
    simulation = device.simulation
    title = json.dumps(f"{device.name}, {simulated.load.name}")
    text = [
        f'schema = "forcetorque/experiment/1"\nname = {title}\n',
        f'\n[robot]\nurdf = {json.dumps(urdf)}\ngravity = {device.gravity!r}\ntolerance = "exact"\n',
        f'\n[recording]\nformat = "parquet"\npath = {json.dumps(recording)}\n',
        *(_sensor_text(device, number) for number in range(len(device.sensor))),
        f"\n[calibration]\naccuracy = {{ force_N = {simulation.accuracy_N!r}, "
        f"moment_Nm = {simulation.accuracy_Nm!r} }}\n",
        f'\n[[support]]\nframe = "{BASE}"\n{_gravity(device)}\n',
    ]
    text += [
        f"\n[[interval]]\nlabel = {json.dumps(f'{simulated.load.name}, {name}')}\n"
        f"start_s = {start_s + INTERVAL_MARGIN_S:.3f}\nend_s = {end_s - INTERVAL_MARGIN_S:.3f}\n"
        f'use = "{simulated.use.value}"\nsupport = "{BASE}"\n'
        for name, start_s, end_s in known_intervals(simulated.trajectory)
    ]
    return "".join(text)


def matrix_file(serial: str) -> str:
    """Name the file of the prior matrix of a sensor.

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
    """Source of gravity: the IMU where there is one, else a level base."""
    return f'imu = ["{IMU_STREAM}"]' if device.simulation.imu is not None else "gravity_direction = [0.0, 0.0, -1.0]"


def write_device(
    design: DeviceDesign, output: Path | str, *, progress: Callable[[str], None] = lambda _: None
) -> DeviceDesign:
    """Write a device, all or nothing.

    The files are a URDF for every load that is simulated and, for the 12 steps, one of the device with its axes
    swapped; trajectories of the motors as a table, for ROS and for YARP; a log and an experiment file for every load;
    the true values of the sensors.

    Args:
        design: The device.
        output: Folder to make.
        progress: Called with messages about the progress.

    Returns:
        The result with its recordings and the name of the folder.
    """
    file, rows = design.file, []
    sensors = draw_sensors(file)
    with new_folder(Path(output)) as folder:
        for name, trajectory in design.trajectories.items():
            motors = trajectory.device.joint_names[:-1]
            write_trajectory(folder, _stem(name), partial(_motors, trajectory), ("rad",) * len(motors))
            if trajectory.device.yaw_first != file.yaw_first:
                write_urdf(folder / "device_axes_swapped.urdf", device_model(trajectory.device, trajectory.load))
        for simulated in simulate_device(file, sensors):
            progress(f"writing {simulated.load.name}: {simulated.trajectory.duration_s:.0f} s")
            rows.append(_write_recording(folder, file, simulated))
        _write_truth(folder, file, sensors)
    return design.model_copy(update={"recordings": tuple(rows), "folder": str(output)})


def _stem(name: str) -> str:
    return name.replace(",", "").replace(" ", "_")


def _motors(trajectory: DeviceTrajectory, rate_hz: float) -> tuple[FloatArray, JointMotion]:
    """Motion of all joints but the hinge, which gravity moves."""
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


def _write_truth(folder: Path, file: DeviceFile, drawn: Mapping[str, Specimen]) -> None:
    """Write true values of the sensors, and their prior matrices where experiment files name them."""
    sensors = {}
    for name, sensor in drawn.items():
        if file.simulation.prior:
            write_matrix_file(folder / matrix_file(sensor.serial), encode_matrix(sensor.workbench))
        sensors[name] = {
            "serial": sensor.serial,
            "matrix": sensor.sensor.matrix.tolist(),
            "workbench_matrix": sensor.workbench.tolist(),
            "offset": sensor.sensor.offset.tolist(),
            "noise_counts": sensor.sensor.noise_counts,
        }
    truth = {"schema": TRUTH_SCHEMA, "scenario": file.name, "seed": file.simulation.seed, "sensors": sensors}
    (folder / TRUTH_FILE).write_text(json.dumps(truth, indent=2, allow_nan=False) + "\n", encoding="utf-8")
