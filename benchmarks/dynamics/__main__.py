# SPDX-License-Identifier: BSD-3-Clause
"""Expected readings, contact wrenches and torques of an iCub on a floating base, beside other libraries.

Tasks that are compared run in turn in one program. Slow ones take fewer samples, so all times are
per sample. Peers make their objects once; arrays are converted per sample where the library takes one
sample at a time, and that is part of the time unless the name says that the calls run alone.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.dynamics import peak, scaling
from benchmarks.dynamics.idyntree_loop import IDynTreeLoop
from benchmarks.dynamics.memory import memory_figures
from benchmarks.dynamics.mujoco_loop import MujocoLoop
from benchmarks.dynamics.operations import operations_per_sample
from benchmarks.dynamics.pinocchio_peers import PinocchioBatch, PinocchioLoop
from benchmarks.dynamics.problem import Ours, Problem, icub_problem
from benchmarks.dynamics.start import start_seconds
from benchmarks.harness import arguments, interleaved, median_ratio, write_result

THREADS = 2
OURS = "ours compiled, 2 threads"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sizes:
    """Samples of a round, per task, and rounds."""

    rounds: int
    compiled: int
    readable: int
    idyntree: int
    pinocchio: int
    batch: int
    mujoco: int
    mapped: int
    starts: int


FULL = Sizes(
    rounds=15,
    compiled=200_000,
    readable=20_000,
    idyntree=1500,
    pinocchio=2000,
    batch=50_000,
    mujoco=1000,
    mapped=10_000_000,
    starts=3,
)
QUICK = Sizes(
    rounds=3,
    compiled=20_000,
    readable=4000,
    idyntree=300,
    pinocchio=400,
    batch=10_000,
    mujoco=200,
    mapped=200_000,
    starts=2,
)


class Comparison:
    """Ours and peers on the same motion: what to time, and how far the answers differ."""

    def __init__(self, problem: Problem, sizes: Sizes) -> None:
        """Make every object that a user makes once.

        Args:
            problem: Robot and motion.
            sizes: Samples per task.
        """
        self.expected = Ours(problem, problem.expected_question())
        self.contacts = Ours(problem, problem.contact_question())
        self.readable_expected = Ours(problem, problem.expected_question(), samples=sizes.readable)
        self.readable_contacts = Ours(problem, problem.contact_question(), samples=sizes.readable)
        self.idyntree = IDynTreeLoop(problem, samples=sizes.idyntree)
        self.pinocchio = PinocchioLoop(problem, samples=sizes.pinocchio)
        self.batch = PinocchioBatch(problem, samples=sizes.batch, threads=THREADS)
        self.mujoco = MujocoLoop(problem, samples=sizes.mujoco)

    def tasks(self) -> dict[str, scaling.Task]:
        """List what is compared.

        Returns:
            Samples and function by name.
        """
        n = self.expected.samples
        return {
            f"expected, {OURS}": (n, partial(self.expected.compiled, THREADS)),
            "expected, ours compiled, 1 thread": (n, partial(self.expected.compiled, 1)),
            "expected, ours readable": (self.readable_expected.samples, self.readable_expected.readable),
            "expected, iDynTree loop": (self.idyntree.samples, self.idyntree.expected),
            "expected, iDynTree calls alone": (self.idyntree.samples, self.idyntree.expected_calls_alone),
            "expected, Pinocchio loop": (self.pinocchio.samples, self.pinocchio.expected),
            "expected, Pinocchio parallel batch": (self.batch.samples, self.batch.expected),
            "expected, Pinocchio parallel batch without packing": (self.batch.samples, self.batch.without_packing),
            "expected, MuJoCo loop": (self.mujoco.samples, self.mujoco.expected),
            f"contact and torque, {OURS}": (n, partial(self.contacts.compiled, THREADS)),
            "contact and torque, ours compiled, 1 thread": (n, partial(self.contacts.compiled, 1)),
            "contact and torque, ours readable": (self.readable_contacts.samples, self.readable_contacts.readable),
            "contact and torque, iDynTree loop": (self.idyntree.samples, self.idyntree.contacts_and_torques),
            "contact and torque, iDynTree calls alone": (
                self.idyntree.samples,
                self.idyntree.contacts_and_torques_calls_alone,
            ),
        }

    def accuracy(self) -> dict[str, dict[str, float]]:
        """Compare all answers with those of the compiled evaluator.

        Returns:
            Largest difference of forces, and of moments and torques, by name.
        """
        self.expected.compiled(THREADS)
        self.contacts.compiled(THREADS)
        self.readable_expected.readable()
        self.readable_contacts.readable()
        found = {
            "ours readable": self.readable_expected.out.expected,
            "iDynTree": self.idyntree.expected(),
            "Pinocchio loop": self.pinocchio.expected(),
            "Pinocchio parallel batch": self.batch.expected(),
            "MuJoCo": self.mujoco.expected(),
        }
        result = {f"expected, {name}": _largest(self.expected.out.expected, values) for name, values in found.items()}
        contacts, torques = self.idyntree.contacts_and_torques()
        ours, readable = self.contacts.out, self.readable_contacts.out
        contacts = self.idyntree.in_contact_frames(contacts)
        result["contact, iDynTree"] = _largest(ours.contact_wrenches, contacts)
        result["contact, ours readable"] = _largest(ours.contact_wrenches, readable.contact_wrenches)
        for name, values in (("iDynTree", torques), ("ours readable", readable.torques)):
            result[f"torque, {name}"] = {"N m": float(np.abs(ours.torques[: len(values)] - values).max())}
        return result


def main() -> None:
    """Time everything and write the result."""
    options = arguments(__doc__ or "")
    sizes = QUICK if options.quick else FULL
    figures: dict[str, Any] = {"load average at the start": os.getloadavg()}
    problem = icub_problem(sizes.compiled)
    comparison = Comparison(problem, sizes)
    tasks = comparison.tasks()
    bursts = {f"peak, {threads} threads": (1, partial(peak.burn, threads)) for threads in (1, THREADS)}
    compared = _seconds_per_sample(tasks | bursts, sizes.rounds)
    with tempfile.TemporaryDirectory() as folder:
        growing = scaling.by_links(Path(folder), sizes.compiled) | scaling.by_sensors(problem, sizes.compiled)
        grown = _seconds_per_sample(growing | scaling.by_chunk(problem, sizes.compiled), sizes.rounds)
    starts = start_seconds(sizes.starts)
    figures |= _shares_of_peak(comparison, compared)
    figures["samples per round"] = {name: samples for name, (samples, _) in tasks.items()}
    figures["mapped files"] = memory_figures(sizes.mapped)
    figures["load average at the end"] = os.getloadavg()
    per_sample = {f"{name}, s per sample": v for name, v in (compared | grown).items() if name not in bursts}
    write_result(
        options.json,
        ratios=_ratios(compared),
        seconds=per_sample | starts,
        accuracy=comparison.accuracy(),
        rounds=sizes.rounds,
        packages=("numpy", "numba", "idyntree", "pin", "mujoco", "icub-models"),
        figures=figures,
    )
    for name, value in figures.items():
        print(f"{name}: {value}")


def _seconds_per_sample(tasks: dict[str, scaling.Task], rounds: int) -> dict[str, list[float]]:
    calls: dict[str, Callable[[], object]] = {name: call for name, (_, call) in tasks.items()}
    seconds = interleaved(calls, rounds=rounds)
    return {name: [value / tasks[name][0] for value in values] for name, values in seconds.items()}


def _ratios(seconds: dict[str, list[float]]) -> dict[str, float]:
    """Speed of ours on two threads against everything else that answers the same."""
    ratios = {}
    for what in ("expected", "contact and torque"):
        ours = f"{what}, {OURS}"
        for name, values in seconds.items():
            if name.startswith(f"{what}, ") and name != ours:
                ratios[f"{what}, speed of {OURS} against {name.removeprefix(f'{what}, ')}"] = 1.0 / median_ratio(
                    seconds[ours], values
                )
    return ratios


def _shares_of_peak(comparison: Comparison, seconds: dict[str, list[float]]) -> dict[str, Any]:
    """Relate the operations per second of ours to the peak of the same rounds."""
    figures: dict[str, Any] = {}
    peaks = {
        threads: [threads * peak.OPERATIONS / s for s in seconds[f"peak, {threads} threads"]]
        for threads in (1, THREADS)
    }
    for threads, values in peaks.items():
        figures[f"peak of multiply-adds, {threads} threads, GFLOP/s"] = round(float(np.median(values)) / 1e9, 1)
    for what, ours in (("expected", comparison.expected), ("contact and torque", comparison.contacts)):
        operations = operations_per_sample(ours.question)
        figures[f"{what}, floating-point operations per sample"] = operations
        for threads, name in ((1, "ours compiled, 1 thread"), (THREADS, OURS)):
            rates = [operations / s for s in seconds[f"{what}, {name}"]]
            share = float(np.median([rate / top for rate, top in zip(rates, peaks[threads], strict=True)]))
            figures[f"{what}, {name}, GFLOP/s"] = round(float(np.median(rates)) / 1e9, 1)
            figures[f"{what}, {name}, share of peak"] = round(share, 3)
    return figures


def _largest(ours: Any, theirs: Any) -> dict[str, float]:
    difference = np.abs(ours[: len(theirs)] - theirs).reshape(-1, 6)
    return {"N": float(difference[:, :3].max()), "N m": float(difference[:, 3:].max())}


if __name__ == "__main__":
    main()
