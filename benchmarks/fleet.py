# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of a fleet per second, against workers and number; memory against length; overhead per job.

Every recording is the same log of a simulated arm, 20 s at 100 Hz, under an experiment file of its own, so that each is
read and reduced; seconds include the start of processes. The peer is a script with pandas or `dask.dataframe` that
reduces the same samples to the sums of a fit; it is given the expected wrenches, and has no findings or hashes.
Overhead is that of jobs that do nothing, on processes, and on a Dask cluster of two workers where distributed is
installed; with `--quick` it is mostly noise. What is said on paper is of processor time.
"""

from __future__ import annotations

import resource
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.commands import command_cost, simulated_recordings
from benchmarks.fleet_by_hand import with_dask, with_moments, with_pandas, write_tables
from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.base.arrays import FloatArray
from forcetorque.fleet.plan_file import PlannedRecording
from forcetorque.fleet.process_pool import DaskPool, LocalPool, Pool
from forcetorque.fleet.recording_source import RecordingSource
from forcetorque.fleet.run import run_add

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


def _added_s(pool: Pool, files: list[Path], dataset: Path) -> tuple[float, float]:
    """Seconds of the clock, and those of the processors."""
    jobs = [PlannedRecording(source=RecordingSource(experiment=file), robot=None) for file in files]
    start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    outcomes = list(pool.outcomes(partial(run_add, dataset=dataset), jobs))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    failed = [one.error for one in outcomes if one.error is not None]
    if failed:
        raise SystemExit(failed[0])
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.perf_counter() - start, cpu_s


def _jobs_s(pool: Pool, number: int) -> float:
    """Seconds of a job that does nothing, without those that starting takes."""
    start = time.perf_counter()
    list(pool.outcomes(nothing, range(2)))
    begun = time.perf_counter()
    list(pool.outcomes(nothing, range(2 + number)))
    return max(time.perf_counter() - begun - (begun - start), 0.0) / number


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
    rounds = 2 if options.quick else 5
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        made = simulated_recordings(folder, "logs", "arm", {f"r{value:g}": value for value in lengths})
        files = dict(zip(lengths, made, strict=True))
        short = files[lengths[0]]
        rates: dict[str, float] = {}
        costs: dict[str, float] = {}
        for number in numbers:
            for workers in (1, 2):
                name = f"{number} recordings, {workers} workers"
                own = _copies(short, number, f"n{number}w{workers}")
                clock_s, cpu_s = _added_s(LocalPool(workers=workers), own, folder / name.replace(" ", "_"))
                rates[name], costs[name] = number / clock_s, cpu_s / number
                figures[f"{name}, recordings_per_s"] = rates[name]
                figures[f"{name}, cpu_s of each"] = costs[name]
        for seconds, file in files.items():
            figures[f"{seconds:g} s, peak_MB"] = command_cost(
                "fleet", "add", file, "--into", folder / f"length_{seconds:g}"
            )[1]
        figures["job on processes, ms"] = 1e3 * _jobs_s(LocalPool(workers=2), jobs)
        with _cluster(folder) as address:
            if address is not None:
                figures["job on Dask, ms"] = 1e3 * _jobs_s(DaskPool(address=address), jobs)
            tables, prior = write_tables(short, numbers[-1], folder / "tables")
            tasks: dict[str, Callable[[], FloatArray]] = {
                "moments": partial(with_moments, tables, prior),
                "pandas by hand": partial(with_pandas, tables, prior),
            }
            if address is not None:
                tasks["dask.dataframe by hand"] = partial(with_dask, tables, prior, address)
            by_hand = with_pandas(tables, prior)
            differences = {name: float(np.abs(task() / by_hand - 1.0).max()) for name, task in tasks.items()}
            seconds = interleaved(tasks, rounds=rounds)
    by_pandas = seconds["pandas by hand"]
    each_s = statistics.median(by_pandas) / numbers[-1]
    figures["pandas by hand, recordings_per_s"] = 1.0 / each_s
    first, two = (f"{numbers[-1]} recordings, {workers} workers" for workers in (1, 2))
    core_s_per_hour = 3600.0 / lengths[0] * costs[first]
    figures["core_s per hour of logs"] = core_s_per_hour
    figures["on paper: cores for 1000 robots of 8 h a day"] = core_s_per_hour * _HOURS * _ROBOTS / 86400.0
    figures["on paper: EUR per robot and year"] = core_s_per_hour * _HOURS * _DAYS / 3600.0 * _CORE_HOUR_EUR
    write_result(
        options.json,
        ratios={
            "two workers, one worker": rates[two] / rates[first],
            "time of fleet add, sums alone with pandas": 1.0 / rates[first] / each_s,
            **{
                f"{name}, pandas by hand": median_ratio(own, by_pandas)
                for name, own in seconds.items()
                if own != by_pandas
            },
        },
        seconds=seconds,
        accuracy={f"{name}, relative difference of sums": value for name, value in differences.items()},
        rounds=rounds,
        packages=("numpy", "pyarrow", "pandas"),
        figures={**figures, "log_s": lengths[0]},
    )


if __name__ == "__main__":
    main()
