# SPDX-License-Identifier: BSD-3-Clause
"""Logs of arms and datasets: our readers against the loop that people write with pandas, pyarrow, numpy or json.

The logs are synthetic: ten minutes of RTDE at 125 Hz, states of libfranka, and one episode of fifty of a LeRobot
dataset. Ratios are processor time in the same round, ours divided by the loop's; both end with the same wrench, along
the axes of the flange where the log has other ones, or the same joint torques. Memory is by how much the peak of a
process of its own grows over what it had after its imports; what is imported only when a file is read is part of it.
"""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.compute as pc
import pyarrow.csv as pacsv
import pyarrow.parquet as pq
from scipy.spatial.transform import Rotation

from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.franka.log_format import FrankaFormat, FrankaLog
from forcetorque.formats.lerobot.log_format import LeRobotFormat, LeRobotLog
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.ur_rtde.log_format import UrRtdeFormat, UrRtdeLog
from tests.formats.franka.states import states, write_states, write_table
from tests.formats.lerobot.datasets import WRENCH, tool_episodes, write_dataset
from tests.formats.ur_rtde.recordings import Tool, recorded, write_binary, write_text

EPISODES, EPISODE = 50, 25
TORQUES = [f"state.tau_J[{k}]" for k in range(7)]
SIGNAL = {
    "quantity": "wrench",
    "columns": [f"observation.wrench.{name}" for name in WRENCH],
    "units": ["N"] * 3 + ["N m"] * 3,
    "frame": "sensor",
}


def _context(path: Path) -> ExperimentContext:
    return ExperimentContext(experiment=path.parent / "x.toml", inputs=Inputs(path.parent), sensors={}, joint_units={})


def _values(reading: LogReading, stream: str, quantity: str) -> np.ndarray:
    return next(one for one in reading.streams if one.name == stream).signal(quantity).values


def _rtde(path: Path) -> np.ndarray:
    table = UrRtdeLog.model_validate({"format": "ur_rtde", "path": path.name, "moment_about": "flange"})
    return _values(UrRtdeFormat().read(table, _context(path)), "wrist", "wrench")


def _franka(path: Path, *, stream: str, quantity: str) -> np.ndarray:
    table = FrankaLog.model_validate({"format": "franka", "path": path.name})
    return _values(FrankaFormat().read(table, _context(path)), stream, quantity)


def _lerobot(path: Path) -> np.ndarray:
    stated = {"episode": EPISODE, "stream": [{"name": "arm", "signal": [SIGNAL]}]}
    table = LeRobotLog.model_validate({"format": "lerobot", "path": path, **stated})
    return _values(LeRobotFormat().read(table, _context(path)), "arm", "wrench")


def _turned(numbers: Callable[[str, int], np.ndarray]) -> np.ndarray:
    """Wrench of RTDE along the axes of the flange; `numbers` gives the columns of a field."""
    pose, offset, wrench = numbers("actual_TCP_pose", 6), numbers("tcp_offset", 6), numbers("actual_TCP_force", 6)
    flange = Rotation.from_rotvec(pose[:, 3:]) * Rotation.from_rotvec(offset[:, 3:]).inv()
    return np.hstack([flange.inv().apply(wrench[:, :3]), flange.inv().apply(wrench[:, 3:])])


def _rtde_pandas(path: Path) -> np.ndarray:
    frame = pd.read_csv(path, sep=" ")
    return _turned(lambda field, n: np.array(frame[[f"{field}_{k}" for k in range(n)]]))


def _rtde_pyarrow(path: Path) -> np.ndarray:
    table = pacsv.read_csv(path, parse_options=pacsv.ParseOptions(delimiter=" "))
    return _turned(lambda field, n: np.column_stack([table[f"{field}_{k}"].to_numpy() for k in range(n)]))


def _rtde_numpy(path: Path) -> np.ndarray:
    with path.open("rb") as file:
        names, types = file.readline().decode().split(), file.readline().decode().split()
        kinds = [{"DOUBLE": ">f8", "UINT32": ">u4"}[one] for one in types]
        rows = np.fromfile(file, dtype=list(zip(names, kinds, strict=True)))
    return _turned(lambda field, n: np.column_stack([rows[f"{field}_{k}"].astype(float) for k in range(n)]))


def _franka_json(path: Path) -> np.ndarray:
    with path.open(encoding="utf-8") as file:
        logged = [json.loads(line) for line in file]
    flange_H_ee, ee_H_k = (
        np.array([state[field] for state in logged]).reshape(-1, 4, 4).transpose(0, 2, 1)
        for field in ("F_T_EE", "EE_T_K")
    )
    flange_H_k = flange_H_ee @ ee_H_k
    wrench = np.array([state["K_F_ext_hat_K"] for state in logged])
    force, moment = (np.einsum("nij,nj->ni", flange_H_k[:, :3, :3], half) for half in (wrench[:, :3], wrench[:, 3:]))
    return np.hstack([force, moment + np.cross(flange_H_k[:, :3, 3], force)])


def _torques_pandas(path: Path) -> np.ndarray:
    return pd.read_csv(path)[TORQUES].to_numpy(dtype=float)


def _torques_pyarrow(path: Path) -> np.ndarray:
    table = pacsv.read_csv(path)
    return np.column_stack([table[name].to_numpy() for name in TORQUES])


def _lerobot_pyarrow(path: Path) -> np.ndarray:
    is_21 = json.loads((path / "meta" / "info.json").read_text())["codebase_version"] == "v2.1"
    file = path / "data" / "chunk-000" / (f"episode_{EPISODE:06d}.parquet" if is_21 else "file-000.parquet")
    table = pq.read_table(file, columns=["episode_index", "observation.wrench"])
    column = table.filter(pc.equal(table["episode_index"], EPISODE))["observation.wrench"].combine_chunks()
    return column.flatten().to_numpy().reshape(-1, 6)


def _written(folder: Path, *, quick: bool) -> dict[str, tuple[Path, Callable[[Path], np.ndarray]]]:
    """Each log with our reader."""
    share = 10 if quick else 1
    columns = recorded(Tool(), poses=60 // share, samples=1250)
    cycles = [state | {"time": k} for k, state in enumerate(states(poses=300 // share, samples=100))]
    episodes = tool_episodes([1000 // share] * EPISODES)
    torques = partial(_franka, stream="joints", quantity="torque")
    return {
        "RTDE, text": (write_text(folder / "rtde.csv", columns), _rtde),
        "RTDE, binary": (write_binary(folder / "rtde.bin", columns), _rtde),
        "Franka, states": (
            write_states(folder / "states", cycles),
            partial(_franka, stream="wrist", quantity="wrench"),
        ),
        "Franka, table": (write_table(folder / "table.csv", cycles), torques),
        "LeRobot v2.1": (write_dataset(folder / "v21", episodes, version="v2.1"), _lerobot),
        "LeRobot v3.0": (write_dataset(folder / "v30", episodes, version="v3.0"), _lerobot),
    }


LOOPS: Mapping[str, Mapping[str, Callable[[Path], np.ndarray]]] = {
    "RTDE, text": {"pandas": _rtde_pandas, "pyarrow": _rtde_pyarrow},
    "RTDE, binary": {"numpy": _rtde_numpy},
    "Franka, states": {"json": _franka_json},
    "Franka, table": {"pandas": _torques_pandas, "pyarrow": _torques_pyarrow},
    "LeRobot v2.1": {"pyarrow": _lerobot_pyarrow},
    "LeRobot v3.0": {"pyarrow": _lerobot_pyarrow},
}
"""Loops by log and by what they are written with."""


def _resident_MB(field: str) -> float:
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith(f"{field}:")) / 1024.0


def _growth_MB(task: Callable[[], object]) -> float:
    before = _resident_MB("VmRSS")
    task()
    return _resident_MB("VmHWM") - before


def _peak_growth_MB(task: Callable[[], object]) -> float:
    """In a process of its own, so that one task leaves no memory for the next."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as process:
        return process.submit(_growth_MB, task).result()


def main() -> None:
    """Time the readers, measure their memory, and write ratios."""
    options = arguments(__doc__ or "")
    rounds = 3 if options.quick else 5
    ratios: dict[str, float] = {}
    seconds: dict[str, list[float]] = {}
    figures: dict[str, Any] = {}
    differences: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        for log, (path, ours) in _written(Path(name), quick=options.quick).items():
            tasks = {"ours": partial(ours, path)} | {peer: partial(loop, path) for peer, loop in LOOPS[log].items()}
            times = interleaved(tasks, rounds=rounds, clock=time.process_time)
            memory = {task: _peak_growth_MB(run) for task, run in tasks.items()}
            for peer, loop in LOOPS[log].items():
                ratios[f"{log}, against {peer}"] = median_ratio(times["ours"], times[peer])
                lost = np.isnan(values := ours(path))
                differences[f"{log}, {peer}"] = float(np.abs(values - loop(path))[~lost].max())
            seconds |= {f"{log}, {task}": spent for task, spent in times.items()}
            figures |= {f"{log}, {task}, peak_growth_MB": grown for task, grown in memory.items()}
    write_result(
        options.json,
        ratios=ratios,
        seconds=seconds,
        accuracy={"largest difference": differences},
        rounds=rounds,
        packages=("numpy", "pandas", "pyarrow"),
        figures=figures,
    )
    for name, value in figures.items():
        print(f"{name}: {value:.0f}")


if __name__ == "__main__":
    main()
