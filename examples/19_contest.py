# SPDX-License-Identifier: BSD-3-Clause
"""A contest of sensors and methods on the simulated calibration device: who errs less, and who is as good.

Usage: python examples/19_contest.py [FOLDER]

Stacks a bought sensor and two of ours on the device of thesis chapter 6, takes them through its 12 steps with 5 and
25 kg to fit and with 10, 15, 20 and 30 kg to judge, each of these twice, and runs `forcetorque bench contest`.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from forcetorque.device.components import device_load
from forcetorque.device.device_file import read_device
from forcetorque.device.motion import DeviceTrajectory, twelve_steps
from forcetorque.device.robot_model import BASE, device_model
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.recording.storage import write_recording
from forcetorque.robot.urdf_and_mjcf_text import write_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.movement import MovementKind
from forcetorque.simulation.simulated_sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix
from forcetorque.simulation.trace import record

DEVICE = read_device().with_sensors(3)
SERIALS = dict(zip(DEVICE.sensor_names, ("BOUGHT58", "OURS01", "OURS02"), strict=True))
MOUNTING = dict(zip(DEVICE.sensor_names, (0.01, 0.03, 0.03), strict=True))
"""By how much mounting changes a matrix, over its rows."""
RATE_HZ = 20.0

EXPERIMENT = """\
schema = "forcetorque/experiment/1"
name = "{name}"

[robot]
urdf = "device_{load:g}kg.urdf"
gravity = {gravity}

[recording]
format = "parquet"
path = "{name}"
{sensors}
[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "{name}"
start_s = 0.5
use = "{use}"
support = "base"
"""

SENSOR = """
[[sensor]]
name = "{name}"
stream = "{name}"
serial = "{serial}"
prior = "matrix_{serial}.txt"
"""

CONTESTANTS = """
[[contestant]]
name = "mini58 as bought"
sensor = "ft_1"
method = "maker"
catalogue = "mini58"

[[contestant]]
name = "ours 1, factory matrix"
sensor = "ft_1_2"
method = "maker"
catalogue = "FTsense Strain 1"

[[contestant]]
name = "ours 1, in situ"
sensor = "ft_1_2"
method = "in-situ"
catalogue = "FTsense Strain 1"

[[contestant]]
name = "ours 1, in situ, no prior"
sensor = "ft_1_2"
method = "in-situ-without-prior"
catalogue = "FTsense Strain 1"

[[contestant]]
name = "ours 2, in situ, 5 kg only"
sensor = "ft_1_3"
method = "in-situ"
fitted_on = ["fit_5kg.toml"]
catalogue = "FTsense Strain 1"

[[contestant]]
name = "ours 2, workbench"
sensor = "ft_1_3"
method = "workbench"
"""


def write_contest(
    folder: Path,
    *,
    fitted_kg: Sequence[float] = (5.0, 25.0),
    judged_kg: Sequence[float] = (10.0, 15.0, 20.0, 30.0),
    turns: int = 2,
) -> Path:
    """Write recordings, experiment files and the file of the contest.

    Args:
        folder: Where they go.
        fitted_kg: Loads to fit on, 5 kg among them; kg.
        judged_kg: Loads to judge by; kg.
        turns: How often each of these is hung.

    Returns:
        The file of the contest.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(3)
    factory = y_shaped_matrix(arm_m=0.05, counts_per_newton=6.0)
    sensors = {}
    for name, serial in SERIALS.items():
        mounted = distorted_by_mounting(factory, relative=MOUNTING[name], rng=rng)
        sensors[name] = SimulatedSensor(matrix=mounted, offset=rng.normal(size=6), noise_counts=4.0)
        write_matrix_file(folder / f"matrix_{serial}.txt", encode_matrix(factory))
    text = ['schema = "forcetorque/contestants/1"\nname = "three stacked sensors"\n']
    runs = [("calibration", f"fit_{load:g}kg", load) for load in fitted_kg]
    runs += [("validation", f"judge_{load:g}kg_{turn}", load) for load in judged_kg for turn in range(turns)]
    for k, (use, name, load) in enumerate(runs):
        _write_run(folder, name, load, use, sensors, rng)
        text.append(f'\n[[run]]\nexperiment = "{name}.toml"\nload_kg = {load}\nstarted_h = {0.1 * k:.1f}\n')
    config = folder / "contest.toml"
    config.write_text("".join(text) + CONTESTANTS, encoding="utf-8")
    return config


def _write_run(
    folder: Path,
    name: str,
    load_kg: float,
    use: str,
    sensors: dict[str, SimulatedSensor],
    rng: np.random.Generator,
) -> None:
    load = device_load(DEVICE, load_kg)
    model = device_model(DEVICE, load)
    write_urdf(folder / f"device_{load_kg:g}kg.urdf", model)
    trajectory = DeviceTrajectory(device=DEVICE, load=load, sequence=twelve_steps(DEVICE))
    stand = Stand(model=model, support=BASE, gravity_direction=[0.0, 0.0, -1.0], gravity=DEVICE.gravity)
    movement = stand.movement(name, MovementKind.GRID, trajectory, trajectory.duration_s)
    write_recording(folder / name, record(movement, sensors, rate_hz=RATE_HZ, rng=rng))
    stated = "".join(SENSOR.format(name=sensor, serial=serial) for sensor, serial in SERIALS.items())
    text = EXPERIMENT.format(name=name, load=load_kg, gravity=DEVICE.gravity, sensors=stated, use=use)
    (folder / f"{name}.toml").write_text(text, encoding="utf-8")


def main(folder: Path) -> None:
    """Make the data and let them meet."""
    config = write_contest(folder)
    command = [
        sys.executable,
        "-m",
        "forcetorque",
        "bench",
        "contest",
        str(config),
        "--figure",
        str(folder / "contest.png"),
    ]
    subprocess.run(command, check=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Compare sensors and methods on the simulated calibration device.")
    parser.add_argument(
        "folder",
        nargs="?",
        type=Path,
        default=Path("contest"),
        help="folder for recordings and files; made if it does not exist",
    )
    main(parser.parse_args().folder)
