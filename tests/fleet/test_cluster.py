# SPDX-License-Identifier: BSD-3-Clause
"""A real scheduler of dask.distributed and two workers on the loopback address: results, and what ends under jobs."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.fleet import process_pool as pool_module
from forcetorque.fleet.parquet_dataset import Dataset
from forcetorque.fleet.process_pool import DaskPool, LocalPool, Outcome
from forcetorque.fleet.run import run_plan

LOST = "the cluster lost the job: its scheduler was restarted, or all workers ended; run the plan again"
DIED = "its process ended without a result: killed, or out of memory"
PLAN = """
schema = "forcetorque/fleet_plan/1"
dataset = "{dataset}"
calibrations = "{dataset}_calibrations"
[[recordings]]
experiments = "move_*.toml"
[[recordings]]
experiments = "day_*.toml"
"""


def job(argument: int) -> int:
    """Square a number; 2 is refused, 3 is a mistake, 4 kills the process."""
    if argument == 2:
        raise FormatError("two: expected\n another number")
    if argument == 3:
        raise KeyError("three")
    if argument == 4:
        os.kill(os.getpid(), signal.SIGKILL)
    return argument**2


def slow_job(argument: tuple[str, int]) -> int:
    """Square a number after half a second; a file in the folder says which process began to."""
    folder, number = argument
    Path(folder, f"{number}-{os.getpid()}").touch()
    time.sleep(0.5)
    return number**2


@dataclass
class Cluster:
    """A scheduler and its workers, each a process."""

    folder: Path
    port: int = 0
    address: str = ""
    scheduler: subprocess.Popen[bytes] | None = None
    workers: list[subprocess.Popen[bytes]] = field(default_factory=list)

    def start_scheduler(self) -> None:
        """Start it, at the address of an earlier one where there was one."""
        file = self.folder / "scheduler.json"
        file.unlink(missing_ok=True)
        self.scheduler = self._started(
            "dask_scheduler", "--host", "127.0.0.1", "--port", str(self.port), "--scheduler-file", str(file)
        )
        for _ in range(600):
            with suppress(FileNotFoundError, ValueError, KeyError):
                self.address = json.loads(file.read_text(encoding="utf-8"))["address"]
                self.port = int(self.address.rpartition(":")[2])
                return
            time.sleep(0.1)
        raise TimeoutError("the scheduler did not start")

    def start_worker(self) -> None:
        """Start one, of one thread, which no other process starts again."""
        self.workers.append(
            self._started(
                "dask_worker", self.address, "--nthreads", "1", "--no-nanny", "--local-directory", str(self.folder)
            )
        )

    def end(self) -> None:
        """End everything."""
        for process in [*self.workers, *([] if self.scheduler is None else [self.scheduler])]:
            process.kill()
            process.wait()

    def _started(self, module: str, *words: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{module}", "--no-dashboard", *words],
            stderr=subprocess.DEVNULL,
            env=os.environ | {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"},
        )


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    """A scheduler and two workers."""
    pytest.importorskip("distributed")
    folder = tmp_path / "cluster"
    folder.mkdir()
    made = Cluster(folder=folder)
    try:
        made.start_scheduler()
        made.start_worker()
        made.start_worker()
        yield made
    finally:
        made.end()


def _until(condition: Callable[[], object]) -> None:
    for _ in range(600):
        if condition():
            return
        time.sleep(0.1)
    raise TimeoutError("expected it within a minute")


def test_no_scheduler_is_one_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """The address is named, and what starts a scheduler."""
    pytest.importorskip("distributed")
    monkeypatch.setattr(pool_module, "_WAIT_S", 0.3)
    with pytest.raises(ForceTorqueError, match=r"--dask tcp://127.0.0.1:9: expected the scheduler .* `dask scheduler`"):
        list(DaskPool(address="tcp://127.0.0.1:9").outcomes(job, [1]))


@pytest.mark.long
def test_a_cluster_gives_the_same(cluster: Cluster) -> None:
    """Numbers and errors are those of local processes."""
    outcomes = sorted(DaskPool(address=cluster.address).outcomes(job, range(4)), key=lambda outcome: outcome.index)
    assert outcomes == [
        Outcome(index=0, value=0),
        Outcome(index=1, value=1),
        Outcome(index=2, error="two: expected another number", is_of_data=True),
        Outcome(index=3, error="KeyError: 'three'"),
    ]


@pytest.mark.long
def test_a_plan_gives_the_same_to_the_bit(cluster: Cluster, days: Path) -> None:
    """Files of the dataset byte by byte, and matrices, offsets and covariances of the calibrations."""
    made = {}
    for name, pool in (("local", LocalPool(workers=2)), ("dask", DaskPool(address=cluster.address))):
        plan = days / f"{name}.toml"
        plan.write_text(PLAN.format(dataset=name), encoding="utf-8")
        made[name] = run_plan(plan, pool)
        assert (made[name].added, made[name].failures) == (4, ())
    local, dask = Dataset(days / "local"), Dataset(days / "dask")
    assert local.present() == dask.present()
    for file in local.present():
        assert (local.folder / file.path).read_bytes() == (dask.folder / file.path).read_bytes()
    first, second = (read_calibration(made[name].sensors[0].file) for name in ("local", "dask"))
    assert np.array_equal(first.matrix, second.matrix)
    assert np.array_equal(first.offset, second.offset)
    assert first.posterior is not None
    assert second.posterior is not None
    assert np.array_equal(first.posterior.covariance, second.posterior.covariance)
    again = run_plan(days / "dask.toml", DaskPool(address=cluster.address))
    assert (again.added, again.present) == (0, 4)


@pytest.mark.long
def test_a_worker_that_is_killed_loses_nothing(cluster: Cluster, tmp_path: Path) -> None:
    """Its jobs run on the other worker; every job has one outcome."""
    begun = tmp_path / "begun"
    begun.mkdir()
    outcomes = DaskPool(address=cluster.address).outcomes(slow_job, [(str(begun), number) for number in range(8)])
    done = [next(outcomes)]
    victim = cluster.workers[0]
    _until(lambda: any(path.name.endswith(f"-{victim.pid}") for path in begun.iterdir()))
    victim.kill()
    done += outcomes
    assert sorted((one.index, one.value) for one in done) == [(number, number**2) for number in range(8)]


@pytest.mark.long
def test_a_job_that_kills_its_workers_is_one_error(cluster: Cluster, monkeypatch: pytest.MonkeyPatch) -> None:
    """After two workers died of it; what then has no worker left is given up, and said so."""
    monkeypatch.setattr(pool_module, "_LOOKS", 4)
    cluster.start_worker()
    outcomes = list(DaskPool(address=cluster.address).outcomes(job, [4, 1]))
    assert sorted((one.index, one.value, one.error) for one in outcomes) == [(0, None, DIED), (1, 1, None)]
    assert [one.error for one in DaskPool(address=cluster.address).outcomes(job, [4])] == [LOST]


@pytest.mark.long
def test_a_scheduler_that_is_restarted_loses_jobs_but_no_recording(cluster: Cluster, tmp_path: Path) -> None:
    """Every job has one outcome, those that were lost say so; the next run does them."""
    begun = tmp_path / "begun"
    begun.mkdir()
    arguments = [(str(begun), number) for number in range(8)]
    outcomes = DaskPool(address=cluster.address).outcomes(slow_job, arguments)
    done = [next(outcomes)]
    assert cluster.scheduler is not None
    cluster.scheduler.kill()
    cluster.scheduler.wait()
    cluster.start_scheduler()
    done += outcomes
    assert sorted(one.index for one in done) == list(range(8))
    assert {one.error for one in done if one.value is None} == {LOST}
    for worker in cluster.workers:
        worker.kill()
        worker.wait()
    cluster.start_worker()
    again = DaskPool(address=cluster.address).outcomes(slow_job, arguments)
    assert sorted((one.index, one.value) for one in again) == [(number, number**2) for number in range(8)]
