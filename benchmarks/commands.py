# SPDX-License-Identifier: BSD-3-Clause
"""Commands of the package in processes of their own: simulated recordings, and what a command costs."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

_SCENARIO = """schema = "forcetorque/scenario/1"
name = "{name}"
seed = 11
[robot]
model = ["{robot}"]
[sensors]
noise_counts = 3.0
offset_counts = 1500.0
mounting_sd = 0.05
"""
_RECORDING = """[[recording]]
name = "{name}"
motion = {{ kind = "random", duration_s = {seconds} }}
temperature_degC = [24.0, 25.0]
"""
_COMMAND = (sys.executable, "-m", "forcetorque")


def simulated_recordings(folder: Path, name: str, robot: str, seconds: Mapping[str, float]) -> list[Path]:
    """Simulate recordings of a random motion.

    Args:
        folder: Where a scenario file and a folder of this name are made.
        name: Their name.
        robot: Name of the robot.
        seconds: Duration by name of each recording; s.

    Returns:
        Experiment files.
    """
    text = _SCENARIO.format(name=name, robot=robot)
    text += "".join(_RECORDING.format(name=key, seconds=value) for key, value in seconds.items())
    (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    made = folder / name
    subprocess.run([*_COMMAND, "simulate", folder / f"{name}.toml", "-o", made], check=True, capture_output=True)
    return [made / f"{key}.toml" for key in seconds]


def command_cost(*words: object) -> tuple[float, float]:
    """Run a command of the package.

    Args:
        words: What is typed after its name.

    Returns:
        CPU seconds and peak memory; s, MB.

    Raises:
        SystemExit: If it fails.
    """
    with subprocess.Popen([*_COMMAND, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode:
        raise SystemExit(f"{words}: exit code {run.returncode}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0
