# SPDX-License-Identifier: BSD-3-Clause
"""A recording of ten minutes at 100 Hz of a humanoid with six sensors: seconds to make and to write it."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from benchmarks.harness import arguments, interleaved, write_result
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import random_movement
from forcetorque.simulation.robots import named_robot
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.simulation.simulated_sensor import SimulatedSensor
from forcetorque.simulation.trace import record


def main() -> None:
    """Time making and writing, and write the seconds."""
    options = arguments(__doc__ or "")
    seconds, rounds = (20.0, 3) if options.quick else (600.0, 10)
    model = read_urdf(named_robot(["iCubGazeboV2_7", "biped"]))
    stand = Stand(model=model, support=model.root_link, gravity_direction=np.array([0.0, 0.0, -1.0]))
    movement = random_movement(stand, rng=np.random.default_rng(1), duration_s=seconds)
    matrix = np.linalg.inv(FAMILIES["standard"].nominal())
    sensor = SimulatedSensor(matrix=matrix, offset=np.zeros(6), noise_counts=3.0, noise_corner_hz=0.5)
    sensors = dict.fromkeys(model.sensors, sensor)

    def make() -> Recording:
        return record(movement, sensors, rate_hz=100.0, rng=np.random.default_rng(2), temperature_degC=(25.0, 30.0))

    made = make()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "recording"
        tasks = {"make": make, "write": lambda: write_recording(folder, made)}
        timed = interleaved(tasks, rounds=rounds)
        back = read_recording(folder)
    timed["make and write"] = [a + b for a, b in zip(timed["make"], timed["write"], strict=True)]
    same = all(np.array_equal(back.stream(s).stamp_ns, stream.stamp_ns) for s, stream in made.streams.items())
    write_result(
        options.json,
        ratios={"recorded seconds per second, made and written": seconds / float(np.median(timed["make and write"]))},
        seconds=timed,
        accuracy={"reads back the same": same, "samples of all sensors": sum(len(made.stream(s)) for s in sensors)},
        rounds=rounds,
        packages=("numpy", "numba", "pyarrow"),
    )


if __name__ == "__main__":
    main()
