# SPDX-License-Identifier: BSD-3-Clause
"""Simulated recordings on disk, as a logger writes them, with their experiment file and their truth."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Annotated, Any, Final, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from forcetorque.base.arrays import ArrayField, FloatArray, true_runs
from forcetorque.base.errors import FormatError, ShapeError
from forcetorque.base.output_file import new_folder, write_bytes_atomically
from forcetorque.base.run_files import declare_input
from forcetorque.base.toml_file import first_error
from forcetorque.formats.icub_matrix import encode_matrix, read_matrix_file, write_matrix_file
from forcetorque.formats.yarp.log_format import PortKind
from forcetorque.formats.yarp.writing import StreamPort, write_ports
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.storage import write_recording
from forcetorque.results.answer import Answer, typed
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of
from forcetorque.simulation.motions.movement import Movement, MovementKind, Phase, PhaseKind
from forcetorque.simulation.network_faults import fail_groups, jitter_stamps, lose_messages, offset_clocks
from forcetorque.simulation.scenario.scenario import INTERVAL_MARGIN_S, Scenario, SimulatedRecording, simulate
from forcetorque.simulation.scenario.scenario_file import Load, Network
from forcetorque.simulation.sensor_family import Specimen
from forcetorque.simulation.simulated_sensor import calibrated_by_board
from forcetorque.simulation.trace import IMU_STREAM


def support_text(link: str, *, down: FloatArray | None) -> str:
    """Write a support.

    Args:
        link: Link that stands still, or whose motion an IMU measures.
        down: Direction in which things fall, in the axes of the link; shape (3,); None where the IMU measures it.

    Returns:
        The table, TOML.
    """
    if down is None:
        return f'\n[[support]]\nframe = "{link}"\nimu = ["{IMU_STREAM}"]\n'
    direction = ", ".join(repr(float(value)) for value in down)
    return f'\n[[support]]\nframe = "{link}"\ngravity_direction = [{direction}]\n'


def sole_text(link: str) -> str:
    """Write a sole: feet of simulated robots stand with the plane z = 0 of their links on the ground.

    Args:
        link: Link that stands.

    Returns:
        The table, TOML.
    """
    return f'\n[[sole]]\nframe = "{link}"\n'


def phases_text(simulated: SimulatedRecording) -> Iterator[str]:
    """Write supports, soles and intervals, one for each phase.

    Gravity is imposed where a foot stands, as on level ground; of a robot that hangs its IMU measures it. While both
    feet stand the load of each is unknown: both are touched, and the IMU measures how the robot moves. Landing is
    ignored.

    Args:
        simulated: The recording, with an IMU.

    Yields:
        Tables, TOML.
    """
    phases, movement = simulated.movement.phases, simulated.movement
    bearing = {phase.touched[0]: phase.kind for phase in phases if len(phase.touched) == 1}
    for link, kind in bearing.items():
        down = -movement.base_pose([0.0], link)[0, 2, :3]  # a link that bears alone stands in the same way all the time
        yield support_text(link, down=None if kind is PhaseKind.HANGING else down)
        if kind is not PhaseKind.HANGING:
            yield sole_text(link)
    for phase in phases:
        yield _phase_interval_text(simulated, phase)


def _phase_interval_text(simulated: SimulatedRecording, phase: Phase) -> str:
    start_s = max(phase.start_s, INTERVAL_MARGIN_S)
    end_s = min(phase.end_s, simulated.movement.duration_s - INTERVAL_MARGIN_S)
    use, support = simulated.use, f'support = "{phase.touched[0]}"\n'
    if phase.kind is PhaseKind.LANDING:
        use, support = Use.IGNORE, ""
    elif phase.kind is PhaseKind.DOUBLE_SUPPORT:
        support = f"contact_links = {json.dumps(phase.touched)}\n"
    return (
        f'\n[[interval]]\nlabel = "{phase.label}"\nstart_s = {start_s:.3f}\nend_s = {end_s:.3f}\n'
        f'use = "{use.value}"\n{support}'
        f"kind = {json.dumps(phase.kind.value)}\nsession = {json.dumps(simulated.session)}\n"
    )


def experiment_text(scenario: Scenario, simulated: SimulatedRecording, log: str, *, temperature: bool) -> str:
    """Write the experiment file of a recording.

    Args:
        scenario: Its scenario.
        simulated: The recording.
        log: The table `[recording]`, without its head.
        temperature: Whether sensors have their temperature as variable.

    Returns:
        The file, TOML. The whole recording is one interval, or one for each phase of its movement, but for a margin at
        either end.
    """
    text = [
        f'schema = "forcetorque/experiment/1"\nname = "{scenario.file.name}, {simulated.name}"\n',
        f'\n[robot]\nurdf = "robot.urdf"\ngravity = {scenario.file.robot.gravity!r}\n\n[recording]\n{log}',
    ]
    for name, specimen in scenario.specimens.items():
        text.append(
            f'\n[[sensor]]\nname = "{name}"\nstream = "{name}"\nserial = "{specimen.serial}"\n'
            f'prior = "matrix_{specimen.serial}.txt"\nlimit_counts = {float(specimen.sensor.limit_counts)!r}\n'
        )
        if temperature:
            text.append('\n[[sensor.variable]]\nname = "temperature"\n')
    if len(scenario.file.load) == 1:  # an interval names one load; more are in the truth alone
        text.append(_load_text(scenario.file.load[0]))
    if scenario.robot_errors is None:  # the model is exact
        text.append("\n[calibration]\naccuracy = { force_N = 0.0, moment_Nm = 0.0 }\n")
    if "velocity" in simulated.recording.stream("joints").signals:
        text.append('\n[processing]\nderivatives = "logged"\n')
    if simulated.movement.phases:
        text += phases_text(simulated)
    else:
        text += [_contacts_text(simulated.movement, imu=scenario.imu is not None), _interval_text(simulated)]
    return "".join(text)


def _load_text(load: Load) -> str:
    """The mass that is added to the robot, which the URDF lacks."""
    centre = ", ".join(repr(float(value)) for value in load.centre_of_mass_m)
    return f'\n[[load]]\nlink = "{load.link}"\nmass_kg = {load.mass_kg!r}\ncentre_of_mass_m = [{centre}]\n'


def _contacts_text(movement: Movement, *, imu: bool) -> str:
    """The support, soles of a robot on its feet and, of one on both, the other foot, whose contact is as unknown."""
    support, *others = movement.touched
    if movement.carriage is None:
        sole = sole_text(support) if movement.kind is MovementKind.BALANCING else ""
        return support_text(support, down=movement.gravity_direction) + sole
    # without an IMU the first foot stands all the time
    down = -movement.base_pose([0.0], support)[0, 2, :3]
    contacts = [f'\n[[contact]]\nframe = "{link}"\n' for link in others]
    soles = [sole_text(link) for link in movement.touched]
    return "".join([support_text(support, down=None if imu else down), *soles, *contacts])


def _interval_text(simulated: SimulatedRecording) -> str:
    """The whole recording but for a margin at either end."""
    end_s = simulated.movement.duration_s - INTERVAL_MARGIN_S
    return (
        f'\n[[interval]]\nlabel = "{simulated.name}"\nstart_s = {INTERVAL_MARGIN_S}\nuse = "{simulated.use.value}"\n'
        f'support = "{simulated.movement.touched[0]}"\nend_s = {end_s:.3f}\n'
        f"kind = {json.dumps(simulated.kind)}\nsession = {json.dumps(simulated.session)}\n"
    )


TRUTH_FILE: Final = "truth.json"
"""Name of the file."""
TRUTH_SCHEMA: Final = "forcetorque/truth/1"
"""Name and version of its form."""


class _Sensor(BaseModel):
    model_config = ConfigDict(defer_build=True, arbitrary_types_allowed=True)

    serial: str
    matrix: Annotated[FloatArray, ArrayField((6, None))]


class _Truth(BaseModel):
    schema_name: Literal["forcetorque/truth/1"] = Field(alias="schema")
    sensors: dict[str, _Sensor]


def true_matrix(experiment: Path, *, sensor: str, serial: str) -> FloatArray | None:
    """Find the true matrix of a sensor.

    Args:
        experiment: Experiment file.
        sensor: Name of the sensor.
        serial: Its serial number.

    Returns:
        The matrix, shape (6, c), N/count, N m/count; None where no truth is beside the file, or none of this sensor.

    Raises:
        FormatError: If the file beside it is not of this form.
    """
    file = experiment.parent / TRUTH_FILE
    if not file.is_file():
        return None
    declare_input(file)
    try:
        truth = _Truth.model_validate(json.loads(file.read_text(encoding="utf-8")))
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError, ShapeError) as error:
        raise FormatError(f"{file}: expected the truth of a simulation, got {error}; remove the file") from error
    except ValidationError as error:
        raise FormatError(f"{file}: {first_error(error)}; the file was changed by hand, remove it") from error
    known = truth.sensors.get(sensor)
    return known.matrix if known is not None and known.serial == serial else None


_NETWORK = 4
"""What the network's random numbers are for, beside those of a scenario's plans and sensors."""


def write_port_logs(scenario: Scenario, simulated: SimulatedRecording, folder: Path, network: Network) -> None:
    """Write the logs of a recording's ports: wrenches that the boards compute, through a network with faults.

    Args:
        scenario: The scenario.
        simulated: The recording.
        folder: Folder with the matrix files of the boards; logs and their experiment file go there too.
        network: What the network does to messages.
    """
    rng = np.random.default_rng([scenario.file.seed, _NETWORK, *simulated.name.encode()])
    recording = simulated.recording
    for name, specimen in scenario.specimens.items():
        stored = read_matrix_file(folder / f"matrix_{specimen.serial}.txt").matrix
        recording = calibrated_by_board(_streamed(recording, name), name, matrix=stored, frame=name)
    recording = _through(recording, network, rng)
    ports = [StreamPort(path="body/stateExt:o", kind=PortKind.STATE_EXT, stream="joints")]
    ports += [StreamPort(path=f"{name}/analog:o", kind=PortKind.ANALOG, stream=name) for name in scenario.specimens]
    write_ports(folder / f"{simulated.name}_yarp", recording, ports)
    joints = ", ".join(f'"{joint}"' for joint in recording.stream("joints").signal("position").columns)
    log = [f'format = "yarp"\npath = "{simulated.name}_yarp"\n']
    log.append(
        f'\n[[recording.stream]]\nkind = "state_ext"\nname = "joints"\nport = "body/stateExt:o"\njoints = [{joints}]\n'
    )
    for name in scenario.specimens:
        log.append(f'\n[[recording.stream]]\nkind = "analog"\nname = "{name}"\nport = "{name}/analog:o"\n')
    text = experiment_text(scenario, simulated, "".join(log), temperature=False)
    (folder / f"{simulated.name}_yarp.toml").write_text(text, encoding="utf-8")


def _streamed(recording: Recording, name: str) -> Recording:
    """Leave out saturated samples: ports of an iCub send nothing while the board holds (thesis 4.3.2)."""
    stream = recording.stream(name)
    sent = ~stream.held
    signals = {
        quantity: replace(signal, values=signal.values[sent])
        for quantity, signal in stream.signals.items()
        if quantity != "saturated"
    }
    left = replace(stream, stamp_ns=stream.stamp_ns[sent], signals=signals)
    return replace(recording, streams={**recording.streams, name: left})


def _through(recording: Recording, network: Network, rng: np.random.Generator) -> Recording:
    if network.jitter_s:
        recording = jitter_stamps(recording, largest_s=network.jitter_s, rng=rng)
    if network.clock_offset_s:
        ahead = rng.uniform(-network.clock_offset_s, network.clock_offset_s, len(recording.streams))
        recording = offset_clocks(recording, dict(zip(recording.streams, ahead.tolist(), strict=True)))
    if network.lost_messages:
        recording = lose_messages(recording, bursts=network.lost_messages, rng=rng)
    if network.failed_groups:
        recording = fail_groups(
            recording, quantity="position", bursts=network.failed_groups, rng=rng, streams=["joints"]
        )
    return recording


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

    def answers(self) -> Iterator[Answer]:
        """Say what was simulated, and where it is.

        Yields:
            One answer.
        """
        files = [row.experiment for row in self.recordings]
        uses = Counter(row.use for row in self.recordings)
        yield Answer(
            subject=self.scenario,
            verdict=f"{len(files)} RECORDING{'S' * (len(files) != 1)} WRITTEN",
            why=(
                f"{', '.join(f'{count} for {use}' for use, count in uses.items())}; "
                f"{sum(row.duration_s for row in self.recordings):.0f} s in all; the truth is in {self.truth}",
            ),
            step="look at a recording",
            command=typed("inspect", str(Path(self.folder) / files[0])) if files else "",
            written=(self.folder,),
        )

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
            "saturated_samples": [[first, last] for first, last in true_runs(held)],
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
