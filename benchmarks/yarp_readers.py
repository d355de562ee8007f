# SPDX-License-Identifier: BSD-3-Clause
"""YARP logs: our readers against plain pyarrow.csv (analog) and a split-and-float loop (stateExt).

The logs are synthetic, of the size and form of a 75 s recording at 100 Hz.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow.csv as pacsv

from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.formats.yarp.joint_and_sensor_ports import read_analog, read_state_ext

JOINTS = tuple(f"joint_{k}" for k in range(6))
_EPOCH = 1457614036.0


def _write_logs(folder: Path, *, messages: int) -> tuple[Path, Path]:
    """Write an analog and a stateExt port and give their folders."""
    rng = np.random.default_rng(1)
    stamps = [f"{_EPOCH + 0.01 * k:.6f}" for k in range(messages)]
    wrench = rng.normal(scale=50.0, size=(messages, 6))
    analog, state = folder / "analog:o", folder / "stateExt:o"
    for port in (analog, state):
        port.mkdir()
        (port / "info.log").write_text("Type: Bottle;\n[0.0] /port [connected]\n")
    rows = (" ".join(f"{v:.6f}" for v in row) for row in wrench)
    (analog / "data.log").write_text(
        "".join(f"{k} {s} {r}\n" for k, (s, r) in enumerate(zip(stamps, rows, strict=True)))
    )
    numbers = rng.normal(scale=30.0, size=(messages, 8, 6))
    modes = "(1903325044 1903325044 1903325044 1903325044 1903325044 1903325044) [ok]"
    lines = []
    for k, stamp in enumerate(stamps):
        groups = " ".join("(" + " ".join(f"{v:.6f}" for v in group) + ") [ok]" for group in numbers[k])
        lines.append(f"{k} {stamp} {groups} {modes} {modes}\n")
    (state / "data.log").write_text("".join(lines))
    return analog, state


def _split_and_float(path: Path) -> np.ndarray:
    """The loop that people write: split each line, keep the numbers."""
    rows = []
    with path.open(encoding="utf-8") as stream:
        for line in stream:
            words = line.replace("(", " ").replace(")", " ").split()
            rows.append([float(word) for word in words if word not in ("[ok]", "[fail]")])
    return np.array(rows)


def _with_processor_time(task: Callable[[], object], seconds: list[float]) -> Callable[[], None]:
    """Also note the processor time of a task, which other programs on the machine disturb less."""

    def run() -> None:
        start = time.process_time()
        task()
        seconds.append(time.process_time() - start)

    return run


def main() -> None:
    """Time both readers and write the ratios."""
    options = arguments(__doc__ or "")
    messages, rounds = (2000, 3) if options.quick else (7500, 15)
    with tempfile.TemporaryDirectory() as name:
        analog, state = _write_logs(Path(name), messages=messages)
        parse = pacsv.ParseOptions(delimiter=" ")
        read = pacsv.ReadOptions(autogenerate_column_names=True)
        tasks = {
            "read_analog": lambda: read_analog(analog, stream="ft", frame="ft"),
            "pyarrow.csv": lambda: pacsv.read_csv(analog / "data.log", parse_options=parse, read_options=read),
            "read_state_ext": lambda: read_state_ext(state, stream="leg", joints=JOINTS),
            "split_and_float": lambda: _split_and_float(state / "data.log"),
        }
        processor: dict[str, list[float]] = {name: [] for name in tasks}
        timed = {name: _with_processor_time(task, processor[name]) for name, task in tasks.items()}
        seconds = interleaved(timed, rounds=rounds)
        seconds |= {f"{name}, processor": values[1:] for name, values in processor.items()}
        ours = read_state_ext(state, stream="leg", joints=JOINTS).stream.signal("position").values
        loop = np.deg2rad(_split_and_float(state / "data.log")[:, 2:8])
    write_result(
        options.json,
        ratios={
            "analog, time against pyarrow.csv": median_ratio(seconds["read_analog"], seconds["pyarrow.csv"]),
            "stateExt, speed against split-and-float": 1.0
            / median_ratio(seconds["read_state_ext"], seconds["split_and_float"]),
            "analog, processor time against pyarrow.csv": median_ratio(
                seconds["read_analog, processor"], seconds["pyarrow.csv, processor"]
            ),
            "stateExt, processor speed against split-and-float": 1.0
            / median_ratio(seconds["read_state_ext, processor"], seconds["split_and_float, processor"]),
        },
        seconds=seconds,
        accuracy={"position, largest difference, rad": float(np.abs(ours - loop).max())},
        rounds=rounds,
        packages=("numpy", "pyarrow"),
    )


if __name__ == "__main__":
    main()
