# SPDX-License-Identifier: BSD-3-Clause
"""How many times as fast as a loop over iDynTree one thread is, by processor time, which other programs disturb less.

Printed are the smallest, median and largest ratio of rounds in turn.
"""

from __future__ import annotations

import statistics
import time

from benchmarks.dynamics.idyntree_loop import IDynTreeLoop
from benchmarks.dynamics.problem import Ours, icub_problem
from benchmarks.harness import arguments, interleaved, write_result

_ROUNDS, _OURS, _PEER = 8, 200_000, 1000
"""Rounds, and samples of each."""


def main() -> None:
    """Time both and write the result."""
    options = arguments(__doc__ or "")
    rounds, ours, peer = (3, 10_000, 300) if options.quick else (_ROUNDS, _OURS, _PEER)
    problem = icub_problem(ours)
    loop = IDynTreeLoop(problem, samples=peer)
    pairs = {
        "expected wrenches": (Ours(problem, problem.expected_question()), loop.expected),
        "contacts and torques": (Ours(problem, problem.contact_question()), loop.contacts_and_torques),
    }
    seconds: dict[str, list[float]] = {}
    ratios = {}
    for what, (compiled, calls) in pairs.items():
        timed = interleaved(
            {"ours": lambda compiled=compiled: compiled.compiled(1), "iDynTree": calls},
            rounds=rounds,
            clock=time.process_time,
        )
        seconds |= {f"{what}, {name}, s per round": values for name, values in timed.items()}
        faster = [(b / peer) / (a / ours) for a, b in zip(timed["ours"], timed["iDynTree"], strict=True)]
        for name, value in (("least", min), ("median", statistics.median), ("most", max)):
            ratios[f"{what}, {name}"] = value(faster)
        print(f"{what}: {min(faster):.0f} to {max(faster):.0f}, median {statistics.median(faster):.0f} times")
    write_result(
        options.json,
        ratios=ratios,
        seconds=seconds,
        accuracy={},
        rounds=rounds,
        packages=("numpy", "numba", "idyntree"),
    )


if __name__ == "__main__":
    main()
