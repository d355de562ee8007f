# SPDX-License-Identifier: BSD-3-Clause
"""Jobs in processes: errors are outcomes, and a process that dies takes nothing with it."""

from __future__ import annotations

import os
import signal

import pytest

from forcetorque.base.errors import FormatError
from forcetorque.fleet.process_pool import LocalPool, Outcome


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
    Outcome(index=2, error="two: expected another number", is_of_data=True),
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
