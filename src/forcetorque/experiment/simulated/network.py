# SPDX-License-Identifier: BSD-3-Clause
"""A simulated recording as a logger on the robot's network would have seen it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.exchange.icub import read_matrix_file
from forcetorque.exchange.yarp import StreamPort, write_ports
from forcetorque.exchange.yarp.discover import PortKind
from forcetorque.experiment.simulated.recording_file import experiment_text
from forcetorque.recording import Recording
from forcetorque.simulation import calibrated_by_board, fail_groups, jitter_stamps, lose_messages, offset_clocks
from forcetorque.simulation.scenario import Scenario, SimulatedRecording
from forcetorque.simulation.scenario.schema import Network

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
