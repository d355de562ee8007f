# SPDX-License-Identifier: BSD-3-Clause
"""Detection rates of faults of simulated benches; `python -m tests.workbench.trials` prints a table."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.workbench.faults import DetectedFault, Fault, FaultSearch, detect_faults, search_faults
from forcetorque.workbench.matrix_fit import specified_scatter
from forcetorque.workbench.simulated_benches import BenchFaults, SimulatedBench, simulate_bench
from tests.scenes.benches import PLACEMENT, thesis_loads

_POSITIONS = 24


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """A kind of fault."""

    faults: Callable[[int, int, float], BenchFaults]
    """Faults by position, another position and a sign."""
    is_named: Callable[[DetectedFault, int, int], bool]
    """Whether a detected fault is this fault."""


def _single(fault: Fault) -> Callable[[DetectedFault, int, int], bool]:
    return lambda detected, p, q: detected.fault is fault and detected.positions == (p,)


TRIALS = {
    "two rows swapped": Trial(
        faults=lambda p, q, sign: BenchFaults(swapped=(p, q)),
        is_named=lambda fault, p, q: fault.fault is Fault.SWAPPED and set(fault.positions) == {p, q},
    ),
    "weight wrong by 5 %": Trial(
        faults=lambda p, q, sign: BenchFaults(weight={p: 0.05 * sign}), is_named=_single(Fault.WEIGHT)
    ),
    "row tilted by 2 deg": Trial(
        faults=lambda p, q, sign: BenchFaults(tilted_rad={p: np.deg2rad(2.0)}), is_named=_single(Fault.TILTED)
    ),
    "row tilted by 1 deg": Trial(
        faults=lambda p, q, sign: BenchFaults(tilted_rad={p: np.deg2rad(1.0)}), is_named=_single(Fault.TILTED)
    ),
    "row tilted by 0.5 deg": Trial(
        faults=lambda p, q, sign: BenchFaults(tilted_rad={p: np.deg2rad(0.5)}), is_named=_single(Fault.TILTED)
    ),
    "weight wrong by 1 %": Trial(
        faults=lambda p, q, sign: BenchFaults(weight={p: 0.01 * sign}), is_named=_single(Fault.WEIGHT)
    ),
    "0.2 kg of structure forgotten": Trial(
        faults=lambda p, q, sign: BenchFaults(no_structure=(p,)),
        is_named=lambda fault, p, q: fault.structure_forgotten and fault.positions == (p,),
    ),
    "plate tilted by 1 deg": Trial(
        faults=lambda p, q, sign: BenchFaults(plate_rad=np.deg2rad(1.0)),
        is_named=lambda fault, p, q: fault.fault is Fault.PLATE_TILTED,
    ),
    "plate tilted by 0.3 deg": Trial(
        faults=lambda p, q, sign: BenchFaults(plate_rad=np.deg2rad(0.3)),
        is_named=lambda fault, p, q: fault.fault is Fault.PLATE_TILTED,
    ),
}


def simulated_benches(
    count: int, seed: int, trial: Trial | None = None, *, with_prior: bool = False
) -> tuple[list[SimulatedBench], list[tuple[int, int]]]:
    """Draw sensors with a fault each, and the positions of the faults."""
    rng, loads = np.random.default_rng(seed), thesis_loads()
    drawn, pairs = [], []
    for k in range(count):
        p, q = (int(position) for position in rng.choice(_POSITIONS, 2, replace=False))
        faults = None if trial is None else trial.faults(p, q, float(rng.choice([-1.0, 1.0])))
        drawn.append(simulate_bench(loads, PLACEMENT, rng, faults=faults, serial=f"S{k}", with_prior=with_prior))
        pairs.append((p, q))
    return drawn, pairs


def searches_by_placement(drawn: list[SimulatedBench]) -> list[FaultSearch]:
    """Search faults of each sensor with the scatter of the specified placement."""
    return [search_faults([simulated.bench])[0] for simulated in drawn]


def searches_by_sensors(drawn: list[SimulatedBench]) -> list[FaultSearch]:
    """Search faults of all sensors with their common scatter, without a specified placement."""
    return search_faults([replace(simulated.bench, placement=None) for simulated in drawn])


def named_share(trial: Trial, count: int, seed: int, *, among: int = 0) -> float:
    """Share of sensors whose fault is detected first, with its positions; among undamaged sensors by their scatter."""
    drawn, pairs = simulated_benches(count, seed, trial)
    undamaged, _ = simulated_benches(among, seed + 1)
    rows = searches_by_sensors([*drawn, *undamaged]) if among else searches_by_placement(drawn)
    return float(
        np.mean(
            [
                bool(search.detected) and trial.is_named(search.detected[0], p, q)
                for search, (p, q) in zip(rows, pairs, strict=False)
            ]
        )
    )


def alarm_share(count: int, seed: int, *, together: bool = False) -> float:
    """Share of undamaged sensors with a detected fault."""
    drawn, _ = simulated_benches(count, seed)
    rows = searches_by_sensors(drawn) if together else searches_by_placement(drawn)
    return float(np.mean([bool(search.detected) for search in rows]))


def plainly_named_share(count: int, seed: int) -> float:
    """Share of swaps whose positions have the two largest residuals of an unweighted fit of raw samples to loads.

    Residuals are relative to the largest load of their component, which gives them one unit.
    """
    drawn, pairs = simulated_benches(count, seed, TRIALS["two rows swapped"])
    hits = []
    for simulated, pair in zip(drawn, pairs, strict=True):
        bench = simulated.bench
        design = np.hstack([bench.raw, np.ones((len(bench), 1))])
        known = bench.loads.wrench
        left = known - design @ np.linalg.lstsq(design, known, rcond=None)[0]
        size = np.linalg.norm(left / np.abs(known).max(axis=0), axis=1)
        hits.append(set(np.argsort(-size)[:2].tolist()) == set(pair))
    return float(np.mean(hits))


def plate_alarm_share(count: int, seed: int) -> float:
    """Share of sensors in which a plate tilted by a degree is detected as another fault."""
    drawn, _ = simulated_benches(count, seed, TRIALS["plate tilted by 1 deg"])
    others = [fault for fault in Fault if fault is not Fault.PLATE_TILTED]
    alarms = []
    for simulated, search in zip(drawn, searches_by_placement(drawn), strict=True):
        scatter = specified_scatter(simulated.bench, np.linalg.inv(simulated.response), PLACEMENT)
        alarms.append(bool(detect_faults(search.bench.loads, search.error, scatter, kinds=others)))
    return float(np.mean(alarms))


if __name__ == "__main__":
    amount = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    sys.stdout.write(f"by the specified placement: alarms of undamaged sensors {alarm_share(amount, 100):.3f}\n")
    for name, kind in TRIALS.items():
        sys.stdout.write(f"  {name}: {named_share(kind, amount, 101):.3f}\n")
    sys.stdout.write(f"  plate tilted by 1 deg, not among the faults: alarms {plate_alarm_share(amount, 101):.3f}\n")
    sys.stdout.write(f"swaps by the plain residual: {plainly_named_share(amount, 101):.3f}\n")
    sys.stdout.write(
        f"by the scatter of sensors: alarms of undamaged ones {alarm_share(amount, 100, together=True):.3f}\n"
    )
    for name in list(TRIALS)[:3]:
        share = named_share(TRIALS[name], amount // 5, 101, among=amount - amount // 5)
        sys.stdout.write(f"  {name}: {share:.3f}\n")
