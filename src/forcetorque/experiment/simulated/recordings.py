# SPDX-License-Identifier: BSD-3-Clause
"""Simulated recordings as experiments on disk: files that every question reads, and what is true of their sensors."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from forcetorque.arrays import FloatArray
from forcetorque.atomic import write_bytes_atomically
from forcetorque.exchange.icub import encode_matrix, write_matrix_file
from forcetorque.experiment.simulated.network import write_port_logs
from forcetorque.experiment.simulated.recording_file import experiment_text
from forcetorque.experiment.simulated.truth import TRUTH_FILE, TRUTH_SCHEMA
from forcetorque.new_folder import new_folder
from forcetorque.recording import write_recording
from forcetorque.recording.quality import spans
from forcetorque.result import Result, Row, Shown, Table, table_of
from forcetorque.simulation.scenario import Scenario, SimulatedRecording, simulate
from forcetorque.simulation.scenario.specimen import Specimen


class WrittenRecording(Row):
    """One recording."""

    recording: Annotated[str, Shown("recording")]
    """Name of its folder."""
    experiment: str
    """Experiment file."""
    kind: Annotated[str, Shown("motion")]
    """Kind of movement."""
    use: Annotated[str, Shown("use")]
    """What it is for."""
    duration_s: Annotated[float, Shown("seconds", digits=0)]
    """Length."""
    samples: Annotated[int, Shown("samples")]
    """Samples of all sensors."""
    saturated: Annotated[int, Shown("saturated")]
    """How many of them are saturated."""


class WrittenScenario(Result):
    """Recordings of a scenario on disk."""

    schema_name: Literal["forcetorque/simulate/1"] = Field(default="forcetorque/simulate/1", alias="schema")
    """Form of the result."""
    scenario: str
    """Name of the scenario."""
    folder: str
    """Where everything is."""
    truth: str
    """File with what is true of the sensors."""
    recordings: tuple[WrittenRecording, ...]
    """Recordings."""

    def blocks(self) -> Iterator[Table | str]:
        """Give a table of the recordings.

        Yields:
            A table and a sentence.
        """
        yield table_of(self.recordings, self.scenario)
        yield f"everything is in {self.folder}, the truth in {self.truth}"


def write_scenario(
    scenario: Scenario, folder: Path | str, *, progress: Callable[[str], None] | None = None
) -> WrittenScenario:
    """Simulate a scenario, and write each recording with its experiment file.

    With a network in the scenario every recording is written a second time, as a folder of YARP logs.

    Args:
        scenario: The scenario.
        folder: Folder to make; it is there as a whole or not at all.
        progress: Called with a line for people at every recording.

    Returns:
        What was written.

    Raises:
        ForceTorqueError: If the folder is there already.
    """
    output = Path(folder)
    truth: dict[str, Any] = {
        "schema": TRUTH_SCHEMA,
        "scenario": scenario.file.name,
        "seed": scenario.file.seed,
    }
    rows = []
    with new_folder(output) as fresh:
        shutil.copyfile(scenario.urdf, fresh / "robot.urdf")
        truth |= _robot_truth(scenario)
        matrices = {name: _write_matrix(specimen, fresh) for name, specimen in scenario.specimens.items()}
        truth["sensors"] = {name: _sensor_truth(scenario, name, matrix) for name, matrix in matrices.items()}
        truth["recordings"] = {}
        for simulated in simulate(scenario):
            if progress is not None:
                movement = simulated.movement
                progress(f"writing {simulated.name}: {movement.kind}, {movement.duration_s:.0f} s")
            _write(scenario, simulated, fresh)
            truth["recordings"][simulated.name] = _recording_truth(simulated, matrices)
            rows.append(_row(simulated))
        text = json.dumps(truth, indent=2, allow_nan=False) + "\n"
        write_bytes_atomically(fresh / TRUTH_FILE, text.encode())
    return WrittenScenario(
        scenario=scenario.file.name,
        folder=str(output),
        truth=str(output / TRUTH_FILE),
        recordings=tuple(rows),
    )


def _robot_truth(scenario: Scenario) -> dict[str, Any]:
    """How the robot differs from the URDF beside it, and its IMU from a perfect one; nothing where there is nothing."""
    truth: dict[str, Any] = {}
    errors, imu = scenario.robot_errors, scenario.imu
    if errors is not None:
        truth["robot_errors"] = {
            "mass": dict(errors.mass),
            "centre_m": {link: shift.tolist() for link, shift in errors.centre_m.items()},
            "joint_zero_rad": dict(errors.joint_zero_rad),
        }
    if imu is not None:
        truth["imu"] = {
            "link": imu.link,
            "accelerometer_bias": imu.accelerometer_bias.tolist(),
            "accelerometer_noise": imu.accelerometer_noise,
            "gyroscope_bias": imu.gyroscope_bias.tolist(),
            "gyroscope_noise": imu.gyroscope_noise,
        }
    return truth


def _write_matrix(specimen: Specimen, folder: Path) -> FloatArray:
    """Write the workbench matrix of a sensor; the matrix that the file holds, whose coefficients have 16 bits."""
    encoded = encode_matrix(specimen.workbench)
    write_matrix_file(folder / f"matrix_{specimen.serial}.txt", encoded)
    return encoded.matrix


def _sensor_truth(scenario: Scenario, name: str, written: FloatArray) -> dict[str, Any]:
    """What is true of a sensor, and of the matrix that was written as its prior."""
    specimen = scenario.specimens[name]
    drift = specimen.sensor.drift
    return {
        "serial": specimen.serial,
        "matrix": specimen.sensor.matrix.tolist(),
        "workbench_matrix": specimen.workbench.tolist(),
        "matrix_error": specimen.sensor.matrix_error(written).tolist(),
        "noise_counts": specimen.sensor.noise_counts,
        "drift_counts_per_degC": None if drift is None else drift.slope.tolist(),
        "reference_degC": None if drift is None else drift.reference_degC,
    }


def _recording_truth(simulated: SimulatedRecording, matrices: Mapping[str, FloatArray]) -> dict[str, Any]:
    sensors = {}
    for name, sensor in simulated.sensors.items():
        held = simulated.recording.stream(name).held
        sensors[name] = {
            "offset": sensor.offset.tolist(),
            "bias": sensor.bias(matrices[name]).tolist(),
            "saturated_samples": [[first, last] for first, last in spans(held)],
        }
    standing = simulated.movement.carriage is None
    return {
        "kind": simulated.movement.kind.value,
        "support": simulated.movement.support if standing else None,
        "gravity_direction": simulated.movement.gravity_direction.tolist() if standing else None,
        "duration_s": simulated.movement.duration_s,
        "touches": [touch.contact.name for touch in simulated.movement.external],
        "contacts": _contacts_folder(simulated) if simulated.movement.external else None,
        "phases": [asdict(phase) for phase in simulated.movement.phases],
        "sensors": sensors,
    }


def _write(scenario: Scenario, simulated: SimulatedRecording, folder: Path) -> None:
    write_recording(folder / simulated.name, simulated.recording)
    if simulated.movement.external:
        write_recording(folder / _contacts_folder(simulated), simulated.contacts())
    measured = any("temperature" in simulated.recording.stream(name).signals for name in scenario.specimens)
    log = f'format = "parquet"\npath = "{simulated.name}"\n'
    text = experiment_text(scenario, simulated, log, temperature=measured)
    (folder / f"{simulated.name}.toml").write_text(text, encoding="utf-8")
    if scenario.file.network is not None:
        write_port_logs(scenario, simulated, folder, scenario.file.network)


def _contacts_folder(simulated: SimulatedRecording) -> str:
    """Where the true wrenches of all touches are."""
    return f"{simulated.name}_contacts"


def _row(simulated: SimulatedRecording) -> WrittenRecording:
    held = [simulated.recording.stream(name).held for name in simulated.sensors]
    return WrittenRecording(
        recording=simulated.name,
        experiment=f"{simulated.name}.toml",
        kind=simulated.movement.kind.value,
        use=simulated.use.value,
        duration_s=simulated.movement.duration_s,
        samples=sum(len(values) for values in held),
        saturated=int(sum(values.sum() for values in held)),
    )
