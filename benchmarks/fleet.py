# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of a fleet per second, against workers and number; memory against length; overhead per job.

Every recording is the same log of a simulated arm, 20 s at 100 Hz, under an experiment file of its own, so that each is
read and reduced; seconds include the start of processes. The peer is the same log by hand with pandas: read, means over
a second, second moments. It has no expected wrenches, findings or hashes. Overhead is that of jobs that do nothing, on
processes, and on a Dask cluster of two workers where distributed is installed; with `--quick` it is mostly noise.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pandas as pd

from benchmarks.commands import command_cost, simulated_recordings
from benchmarks.harness import arguments, write_result
from forcetorque.fleet.job import AddJob, run_add
from forcetorque.fleet.pool import DaskPool, LocalPool, Pool
from forcetorque.fleet.sensor_record import AddOptions
from forcetorque.fleet.source import RecordingSource

_DAYS, _HOURS, _ROBOTS, _CORE_HOUR_EUR = 365, 8, 1000, 0.05
"""On paper: days of a year, hours of logs a day, robots, and what a core costs for an hour."""


def nothing(_: int) -> int:
    """Do nothing."""
    return 0


def _copies(file: Path, number: int, prefix: str) -> list[Path]:
    """Experiment files of one log, each of another content."""
    text, made = file.read_text(encoding="utf-8"), []
    for k in range(number):
        copy = file.with_name(f"{prefix}_{k:05d}.toml")
        copy.write_text(f"# {prefix} {k}\n{text}", encoding="utf-8")
        made.append(copy)
    return made


def _added_s(pool: Pool, files: list[Path], dataset: Path) -> float:
    jobs = [AddJob(source=RecordingSource(experiment=file), dataset=dataset, options=AddOptions()) for file in files]
    start = time.perf_counter()
    outcomes = list(pool.outcomes(run_add, jobs))
    failed = [one.error for one in outcomes if one.error is not None]
    if failed:
        raise SystemExit(failed[0])
    return time.perf_counter() - start


def _jobs_s(pool: Pool, number: int) -> float:
    """Seconds of a job that does nothing, without those that starting takes."""
    start = time.perf_counter()
    list(pool.outcomes(nothing, range(2)))
    begun = time.perf_counter()
    list(pool.outcomes(nothing, range(2 + number)))
    return max(time.perf_counter() - begun - (begun - start), 0.0) / number


def _by_hand_s(log: Path, rounds: int) -> float:
    """Seconds of the peer."""
    start = time.perf_counter()
    for _ in range(rounds):
        for file in sorted(log.glob("*.parquet")):
            frame = pd.read_parquet(file)
            numbers = frame.select_dtypes("number")
            seconds = (numbers.iloc[:, 0] - numbers.iloc[0, 0]) // 10**9
            numbers.groupby(seconds).mean()
            np.cov(numbers.to_numpy(dtype=np.float64).T)
    return (time.perf_counter() - start) / rounds


@contextmanager
def _cluster(folder: Path) -> Iterator[str | None]:
    """Address of a cluster of two workers; None without distributed."""
    try:
        from distributed import LocalCluster
    except ImportError:
        yield None
        return
    with LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(folder), host="127.0.0.1"
    ) as cluster:
        yield cluster.scheduler_address


def main() -> None:
    """Measure, and write figures and ratios."""
    options = arguments(__doc__ or "")
    lengths, numbers, jobs = ((20.0, 80.0), (4,), 20) if options.quick else ((20.0, 600.0, 3600.0), (10, 200), 500)
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        made = simulated_recordings(folder, "logs", "arm", {f"r{value:g}": value for value in lengths})
        files = dict(zip(lengths, made, strict=True))
        short = files[lengths[0]]
        rates: dict[str, float] = {}
        for number in numbers:
            for workers in (1, 2):
                name = f"{number} recordings, {workers} workers"
                own = _copies(short, number, f"n{number}w{workers}")
                rates[name] = number / _added_s(LocalPool(workers=workers), own, folder / name.replace(" ", "_"))
                figures[f"{name}, recordings_per_s"] = rates[name]
        by_hand = _by_hand_s(short.with_suffix(""), 3)
        figures["by hand with pandas, recordings_per_s"] = 1.0 / by_hand
        for seconds, file in files.items():
            figures[f"{seconds:g} s, peak_MB"] = command_cost(
                "fleet", "add", file, "--into", folder / f"length_{seconds:g}"
            )[1]
        figures["job on processes, ms"] = 1e3 * _jobs_s(LocalPool(workers=2), jobs)
        with _cluster(folder) as address:
            if address is not None:
                figures["job on Dask, ms"] = 1e3 * _jobs_s(DaskPool(address=address), jobs)
    first, two = (f"{numbers[-1]} recordings, {workers} workers" for workers in (1, 2))
    core_s_per_hour = 3600.0 / lengths[0] / rates[first]
    figures["core_s per hour of logs"] = core_s_per_hour
    figures["on paper: cores for 1000 robots of 8 h a day"] = core_s_per_hour * _HOURS * _ROBOTS / 86400.0
    figures["on paper: EUR per robot and year"] = core_s_per_hour * _HOURS * _DAYS / 3600.0 * _CORE_HOUR_EUR
    write_result(
        options.json,
        ratios={
            "two workers, one worker": rates[two] / rates[first],
            "time of fleet add, by hand with pandas": 1.0 / rates[first] / by_hand,
        },
        seconds={},
        accuracy={},
        rounds=1,
        packages=("numpy", "pyarrow", "pandas"),
        figures={**figures, "log_s": lengths[0]},
    )


if __name__ == "__main__":
    main()
