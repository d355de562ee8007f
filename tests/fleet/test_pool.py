# SPDX-License-Identifier: BSD-3-Clause
"""Jobs in processes: errors are outcomes, and a process that dies takes nothing with it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.fleet.pool import DaskPool, LocalPool, Outcome


def job(argument: int) -> int:
    """Square a number; 2 is refused, 3 is a mistake, 4 kills the process."""
    if argument == 2:
        raise FormatError("two: expected\n another number")
    if argument == 3:
        raise KeyError("three")
    if argument == 4:
        os.kill(os.getpid(), signal.SIGKILL)
    return argument**2


EXPECTED = [
    Outcome(index=0, value=0),
    Outcome(index=1, value=1),
    Outcome(index=2, error="two: expected another number"),
    Outcome(index=3, error="KeyError: 'three'"),
    Outcome(index=4, error="its process ended without a result: killed, or out of memory"),
    Outcome(index=5, value=25),
    Outcome(index=6, value=36),
]


@pytest.mark.long
@pytest.mark.parametrize("workers", [1, 3])
def test_a_process_that_dies_takes_nothing_with_it(workers: int) -> None:
    """Of jobs that run beside it and that wait, each has its outcome, once."""
    outcomes = sorted(LocalPool(workers=workers).outcomes(job, range(7)), key=lambda outcome: outcome.index)
    assert outcomes == EXPECTED


def test_nothing_to_do_starts_no_process() -> None:
    """No argument, no outcome."""
    assert list(LocalPool(workers=2).outcomes(job, [])) == []


def test_no_scheduler_is_one_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """The address is named, and what starts a scheduler."""
    pytest.importorskip("distributed")
    monkeypatch.setattr("forcetorque.fleet.pool._WAIT_S", 0.3)
    with pytest.raises(ForceTorqueError, match=r"--dask tcp://127.0.0.1:9: expected the scheduler .* `dask scheduler`"):
        list(DaskPool(address="tcp://127.0.0.1:9").outcomes(job, [1]))


@pytest.mark.long
def test_a_cluster_gives_the_same(tmp_path: Path) -> None:
    """A scheduler and two workers on the loopback address; numbers and errors are those of local processes."""
    pytest.importorskip("distributed")
    file = tmp_path / "scheduler.json"
    base = [sys.executable, "-m"]
    scheduler = subprocess.Popen(
        [*base, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
        + ["--scheduler-file", str(file)],
        stderr=subprocess.DEVNULL,
    )
    processes = [scheduler]
    try:
        for _ in range(300):
            if file.is_file():
                break
            time.sleep(0.1)
        processes += [
            subprocess.Popen(
                [*base, "distributed.cli.dask_worker", "--scheduler-file", str(file), "--nthreads", "1"]
                + ["--no-dashboard", "--local-directory", str(tmp_path)],
                stderr=subprocess.DEVNULL,
            )
            for _ in range(2)
        ]
        import json

        address = json.loads(file.read_text(encoding="utf-8"))["address"]
        outcomes = sorted(DaskPool(address=address).outcomes(job, range(4)), key=lambda outcome: outcome.index)
        assert outcomes == EXPECTED[:4]
    finally:
        for process in reversed(processes):
            process.terminate()
            process.wait()
