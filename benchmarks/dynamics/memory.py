# SPDX-License-Identifier: BSD-3-Clause
"""Memory and time of expected readings where all samples are in mapped files.

Run as a program of its own, so that memory which other parts have freed does not hide growth. What
grows is anonymous memory: pages of mapped files belong to the system's cache and are given back.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from benchmarks.dynamics.problem import Problem, icub_problem
from forcetorque.base.arrays import FloatArray
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.motion import JointMotion, RootMotion

_BATCH = 65_536
_RESERVE = 5e9
"""Bytes that stay free on the disk."""


def memory_figures(samples: int) -> dict[str, Any]:
    """Measure in a program of its own.

    Args:
        samples: Number of samples.

    Returns:
        Figures by name, or the reason why there are none.
    """
    command = [sys.executable, "-m", "benchmarks.dynamics.memory", str(samples)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        return {"failed": done.stderr.strip().splitlines()[-1:]}
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def _measure(samples: int) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        problem = icub_problem(_BATCH)
        question = problem.expected_question()
        shapes = _inputs(problem)
        row_bytes = 8 * sum(values.shape[1] for values in shapes.values()) + 48 * len(problem.sensors)
        free = shutil.disk_usage(folder).free
        if free < samples * row_bytes + _RESERVE:
            return {"skipped": f"{free / 1e9:.0f} GB of disk are free, {samples * row_bytes / 1e9:.1f} GB are needed"}
        mapped = {key: _write(folder / key, values, samples) for key, values in shapes.items()}

        def make(field: str, shape: tuple[int, ...], dtype: npt.DTypeLike) -> npt.NDArray[Any]:
            if 0 in shape:
                return np.empty(shape, dtype=dtype)
            return np.memmap(folder / f"out_{field}", dtype=dtype, mode="w+", shape=shape)

        out = Estimates.empty(question.layout, samples, make=make)
        growth: list[float] = []
        start = time.perf_counter()
        with _growth_of_memory(growth):
            joints = JointMotion(
                names=problem.joints.names, **{key: mapped[key] for key in ("position", "velocity", "acceleration")}
            )
            root = RootMotion(
                **{k: mapped[k] for k in ("proper_acceleration", "angular_velocity", "angular_acceleration")}
            )
            estimate(question, joints, root, out=out, evaluator=Evaluator.COMPILED, threads=2)
        seconds = time.perf_counter() - start
        first = problem_answer(problem)
        same = all(np.array_equal(out.expected[i : i + 1000], first[:1000]) for i in range(0, samples - 1000, _BATCH))
        return {
            "samples": samples,
            "bytes of inputs and outputs per sample": row_bytes,
            "largest growth of anonymous memory, MB": round(max(growth) / 1e6, 2),
            "time per sample, ns": round(seconds / samples * 1e9, 1),
            "same as in memory": same,
        }


def problem_answer(problem: Problem) -> FloatArray:
    """Answer the same question in memory.

    Args:
        problem: Robot and motion.

    Returns:
        Expected readings; shape (n, sensors, 6); N, N m.
    """
    return estimate(problem.expected_question(), problem.joints, problem.root, evaluator=Evaluator.COMPILED).expected


def _inputs(problem: Problem) -> dict[str, FloatArray]:
    names = ("position", "velocity", "acceleration")
    motions = ("proper_acceleration", "angular_velocity", "angular_acceleration")
    joints = {name: getattr(problem.joints, name) for name in names}
    return joints | {name: getattr(problem.root, name) for name in motions}


def _write(path: Path, values: FloatArray, samples: int) -> npt.NDArray[Any]:
    """Repeat a batch in a file until there are enough samples, and map the file for reading."""
    with path.open("wb") as file:
        for start in range(0, samples, len(values)):
            values[: samples - start].tofile(file)
    return np.memmap(path, dtype=np.float64, mode="r", shape=(samples, values.shape[1]))


@contextmanager
def _growth_of_memory(growth: list[float]) -> Iterator[None]:
    """Collect how many bytes of anonymous memory there are beyond those at the start, every millisecond."""
    before, done = _anonymous_bytes(), threading.Event()

    def watch() -> None:
        while not done.is_set():
            growth.append(_anonymous_bytes() - before)
            done.wait(1e-3)

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()


def _anonymous_bytes() -> float:
    for line in Path("/proc/self/status").read_text(encoding="utf-8").splitlines():
        if line.startswith("RssAnon:"):
            return float(line.split()[1]) * 1024.0
    raise OSError("this system does not tell the anonymous memory of a process")


if __name__ == "__main__":
    print(json.dumps(_measure(int(sys.argv[1]))))
