# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque simulate`: recordings with known truth, in the project's own form and as YARP folders."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from forcetorque.atomic import write_bytes_atomically
from forcetorque.cli.new_folder import new_folder, refuse_existing
from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.exchange.icub import encode_matrix, read_matrix_file, write_matrix_file
from forcetorque.exchange.yarp import StreamPort, write_ports
from forcetorque.exchange.yarp.discover import PortKind
from forcetorque.recording import Recording, write_recording
from forcetorque.recording.quality import spans
from forcetorque.simulation import calibrated_by_board, fail_groups, jitter_stamps, lose_messages, offset_clocks
from forcetorque.simulation.scenario import (
    INTERVAL_MARGIN_S,
    Scenario,
    SimulatedRecording,
    bundled_scenario,
    load_scenario,
    simulate,
)
from forcetorque.simulation.scenario.schema import Network

_NETWORK = 4
"""What the network's random numbers are for, beside those of a scenario's plans and sensors."""


class RecordingRow(BaseModel):
    """One recording."""

    recording: str
    """Name of its folder."""
    experiment: str
    """Experiment file."""
    kind: str
    """Kind of movement."""
    use: str
    """What it is for."""
    duration_s: float
    """Length."""
    samples: int
    """Samples of all sensors."""
    saturated: int
    """How many of them are saturated."""


class SimulateResult(BaseModel):
    """What `forcetorque simulate` wrote."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/simulate/1"] = Field(default="forcetorque/simulate/1", alias="schema")
    """Form of the result."""
    scenario: str
    """Name of the scenario."""
    folder: str
    """Where everything is."""
    truth: str
    """File with what is true of the sensors."""
    recordings: list[RecordingRow]
    """Recordings."""


def run(scenario: str, *, output: Path, output_format: Format) -> None:
    """Simulate a scenario.

    Args:
        scenario: Scenario file, or the name of a bundled one.
        output: Folder to make.
        output_format: Form of the result.
    """
    log = start_logging()
    file = _file(scenario)
    refuse_existing(output)
    loaded = load_scenario(file)
    truth: dict[str, Any] = {
        "schema": "forcetorque/truth/1",
        "scenario": loaded.file.name,
        "seed": loaded.file.seed,
    }
    rows = []
    with new_folder(output) as fresh:
        shutil.copyfile(loaded.urdf, fresh / "robot.urdf")
        truth["sensors"] = {name: _sensor_truth(loaded, name, fresh) for name in loaded.specimens}
        truth["recordings"] = {}
        for made in simulate(loaded):
            log.info("writing %s: %s, %.0f s", made.name, made.movement.kind, made.movement.duration_s)
            _write(loaded, made, fresh)
            truth["recordings"][made.name] = _recording_truth(made)
            rows.append(_row(made))
        text = json.dumps(truth, indent=2, allow_nan=False) + "\n"
        write_bytes_atomically(fresh / "truth.json", text.encode())
    result = SimulateResult(
        scenario=loaded.file.name, folder=str(output), truth=str(output / "truth.json"), recordings=rows
    )
    flat = [row.model_dump() for row in rows]
    print_result(result.model_dump(mode="json", by_alias=True), flat, output_format, show=lambda: _show(result))


def _file(scenario: str) -> Path:
    path = Path(scenario)
    return path if path.suffix == ".toml" else bundled_scenario(scenario)


def _sensor_truth(scenario: Scenario, name: str, folder: Path) -> dict[str, Any]:
    specimen = scenario.specimens[name]
    file = folder / f"matrix_{specimen.serial}.txt"
    write_matrix_file(file, encode_matrix(specimen.workbench))
    drift = specimen.sensor.drift
    return {
        "serial": specimen.serial,
        "matrix": specimen.sensor.matrix.tolist(),
        "workbench_matrix": specimen.workbench.tolist(),
        "noise_counts": specimen.sensor.noise_counts,
        "drift_counts_per_degC": None if drift is None else drift.slope.tolist(),
        "reference_degC": None if drift is None else drift.reference_degC,
    }


def _recording_truth(made: SimulatedRecording) -> dict[str, Any]:
    sensors = {}
    for name, sensor in made.sensors.items():
        held = made.recording.stream(name).held
        sensors[name] = {
            "offset": sensor.offset.tolist(),
            "saturated_samples": [[first, last] for first, last in spans(held)],
        }
    return {
        "kind": made.movement.kind.value,
        "support": made.movement.support,
        "gravity_direction": made.movement.gravity_direction.tolist(),
        "duration_s": made.movement.duration_s,
        "touches": [touch.contact.name for touch in made.movement.external],
        "sensors": sensors,
    }


def _write(scenario: Scenario, made: SimulatedRecording, folder: Path) -> None:
    write_recording(folder / made.name, made.recording)
    measured = any("temperature" in made.recording.stream(name).signals for name in scenario.specimens)
    log = f'format = "parquet"\npath = "{made.name}"\n'
    text = _experiment(scenario, made, log, temperature=measured)
    (folder / f"{made.name}.toml").write_text(text, encoding="utf-8")
    if scenario.file.network is not None:
        _write_yarp(scenario, made, folder, scenario.file.network)


def _write_yarp(scenario: Scenario, made: SimulatedRecording, folder: Path, network: Network) -> None:
    """Write what a logger would have seen: wrenches that the boards compute, through a network with faults."""
    rng = np.random.default_rng([scenario.file.seed, _NETWORK, *made.name.encode()])
    recording = made.recording
    for name, specimen in scenario.specimens.items():
        stored = read_matrix_file(folder / f"matrix_{specimen.serial}.txt").matrix
        recording = calibrated_by_board(_streamed(recording, name), name, matrix=stored, frame=name)
    recording = _through(recording, network, rng)
    ports = [StreamPort(path="body/stateExt:o", kind=PortKind.STATE_EXT, stream="joints")]
    ports += [StreamPort(path=f"{name}/analog:o", kind=PortKind.ANALOG, stream=name) for name in scenario.specimens]
    write_ports(folder / f"{made.name}_yarp", recording, ports)
    joints = ", ".join(f'"{joint}"' for joint in recording.stream("joints").signal("position").columns)
    lines = [f'format = "yarp"\npath = "{made.name}_yarp"\n']
    lines.append(
        f'\n[[recording.stream]]\nkind = "state_ext"\nname = "joints"\nport = "body/stateExt:o"\njoints = [{joints}]\n'
    )
    for name in scenario.specimens:
        lines.append(f'\n[[recording.stream]]\nkind = "analog"\nname = "{name}"\nport = "{name}/analog:o"\n')
    text = _experiment(scenario, made, "".join(lines), temperature=False)
    (folder / f"{made.name}_yarp.toml").write_text(text, encoding="utf-8")


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


def _experiment(scenario: Scenario, made: SimulatedRecording, log: str, *, temperature: bool) -> str:
    down = ", ".join(repr(float(value)) for value in made.movement.gravity_direction)
    text = [
        f'schema = "forcetorque/experiment/1"\nname = "{scenario.file.name}, {made.name}"\n',
        f'\n[robot]\nurdf = "robot.urdf"\ngravity = {scenario.file.robot.gravity!r}\n\n[recording]\n{log}',
    ]
    for name, specimen in scenario.specimens.items():
        text.append(
            f'\n[[sensor]]\nname = "{name}"\nstream = "{name}"\nserial = "{specimen.serial}"\n'
            f'prior = "matrix_{specimen.serial}.txt"\nlimit_counts = {float(specimen.sensor.limit_counts)!r}\n'
        )
        if temperature:
            text.append('\n[[sensor.variable]]\nname = "temperature"\n')
    text.append(f'\n[[support]]\nframe = "{made.movement.support}"\ngravity_direction = [{down}]\n')
    text.append(
        f'\n[[interval]]\nlabel = "{made.name}"\nstart_s = {INTERVAL_MARGIN_S}\nuse = "{made.use.value}"\n'
        f'support = "{made.movement.support}"\nend_s = {made.movement.duration_s - INTERVAL_MARGIN_S:.3f}\n'
        f"kind = {json.dumps(made.kind)}\nsession = {json.dumps(made.session)}\n"
    )
    return "".join(text)


def _row(made: SimulatedRecording) -> RecordingRow:
    held = [made.recording.stream(name).held for name in made.sensors]
    return RecordingRow(
        recording=made.name,
        experiment=f"{made.name}.toml",
        kind=made.movement.kind.value,
        use=made.use.value,
        duration_s=made.movement.duration_s,
        samples=sum(len(values) for values in held),
        saturated=int(sum(values.sum() for values in held)),
    )


def _show(result: SimulateResult) -> None:
    screen = console()
    made = table("recording", "motion", "use", "seconds", "samples", "saturated", title=result.scenario)
    for row in result.recordings:
        made.add_row(row.recording, row.kind, row.use, f"{row.duration_s:.0f}", str(row.samples), str(row.saturated))
    screen.print(made)
    screen.print(f"everything is in {result.folder}, the truth in {result.truth}", soft_wrap=True)
