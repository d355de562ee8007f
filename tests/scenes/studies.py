# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of the simulated arm on three days, cold and warm, each with its experiment file: data for a study."""

from __future__ import annotations

import json
import shutil
import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.recording.storage import write_recording
from forcetorque.simulation.scenario.scenario import Scenario, build_scenario, simulate
from forcetorque.simulation.scenario.scenario_file import ScenarioFile
from forcetorque.simulation.trace import Trace

SENSOR, SERIAL = "arm_ft", "SIM001"

CALIBRATION = ("grid_cold.toml", "grid_warm.toml", "move_cold.toml", "move_warm.toml")
"""Kinds `grid` and `random`, two each."""
VALIDATION = ("day_1.toml", "day_2.toml")
"""Each a session of its own, with offsets of its own."""
FILES = (*CALIBRATION, *VALIDATION)

SCENARIO = """
schema = "forcetorque/scenario/1"
name = "days"
seed = 3
[robot]
model = ["arm"]
[sensors]
noise_counts = 1.0
offset_counts = 500.0
power_up_counts = 60.0
drift_counts_per_degC = 10.0
mounting_sd = 0.05
[[recording]]
name = "grid_cold"
motion = { kind = "grid", sensor = "arm_ft", speed = 2.0, postures = 3 }
temperature_degC = [24.0, 25.0]
[[recording]]
name = "grid_warm"
motion = { kind = "grid", sensor = "arm_ft", speed = 2.0, postures = 3 }
temperature_degC = [36.0, 35.5]
[[recording]]
name = "move_cold"
motion = { kind = "random", duration_s = 8.0, slowest_hz = 0.3, speed = 2.0 }
temperature_degC = [25.0, 26.0]
[[recording]]
name = "move_warm"
motion = { kind = "random", duration_s = 8.0, slowest_hz = 0.3, speed = 2.0 }
temperature_degC = [35.5, 35.0]
[[recording]]
name = "day_1"
motion = { kind = "random", duration_s = 9.0, slowest_hz = 0.3, speed = 2.0 }
temperature_degC = [30.0, 31.0]
use = "validation"
power_up = 1
[[recording]]
name = "day_2"
motion = { kind = "random", duration_s = 7.0, slowest_hz = 0.3, speed = 2.0 }
temperature_degC = [27.0, 28.0]
use = "validation"
power_up = 2
""".replace("motion =", "rate_hz = 50.0\nmotion =")

_EXPERIMENT = """
schema = "forcetorque/experiment/1"
name = "arm {label}"

[robot]
urdf = "robot.urdf"

[recording]
format = "parquet"
path = "{label}"

[[sensor]]
name = "arm_ft"
stream = "arm_ft"
serial = "SIM001"
prior = "matrix_SIM001.txt"

[[sensor.variable]]
name = "temperature"

[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "{label}"
start_s = 0.5
end_s = {end_s}
use = "{use}"
support = "base"
kind = {kind}
session = {session}
"""


@cache
def scenario() -> Scenario:
    """The scenario, with the truth."""
    return build_scenario(ScenarioFile.model_validate(tomllib.loads(SCENARIO)))


def write_days(folder: Path, truth: Scenario | None = None, traces: Mapping[str, Trace] | None = None) -> None:
    """Write robot, prior, recordings and experiment files.

    Args:
        folder: Where they are written.
        truth: The scenario, with other sensors perhaps; that of `scenario` if left out.
        traces: What `trace_recordings` gave for it; computed if left out.
    """
    truth = truth or scenario()
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(truth.urdf, folder / "robot.urdf")
    write_matrix_file(folder / f"matrix_{SERIAL}.txt", encode_matrix(truth.specimens[SENSOR].workbench))
    for made in simulate(truth, traces):
        write_recording(folder / made.name, made.recording)
        text = _EXPERIMENT.format(
            label=made.name,
            use=made.use.value,
            kind=json.dumps(made.kind),
            session=json.dumps(f"{made.session}"),
            end_s=round(made.movement.duration_s - 0.5, 3),
        )
        (folder / f"{made.name}.toml").write_text(text, encoding="utf-8")
