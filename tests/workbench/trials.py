# SPDX-License-Identifier: BSD-3-Clause
"""Simulated sensors with one fault each, and what is named of it; `python -m tests.workbench.trials` prints a table."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.workbench.faults import Examined, Fault, Suspect, examine, suspects
from forcetorque.workbench.fit import stated_scatter
from forcetorque.workbench.simulated_benches import BenchFaults, Specimen, simulate_specimen
from tests.scenes.benches import PLACEMENT, thesis_loads

_POSITIONS = 24


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """A kind of fault."""

    faults: Callable[[int, int, float], BenchFaults]
    """Faults by position, another position and a sign."""
    is_named: Callable[[Suspect, int, int], bool]
    """Whether a suspect is it."""


def _single(fault: Fault) -> Callable[[Suspect, int, int], bool]:
    return lambda suspect, p, q: suspect.fault is fault and suspect.positions == (p,)


TRIALS = {
    "two rows swapped": Trial(
        faults=lambda p, q, sign: BenchFaults(swapped=(p, q)),
        is_named=lambda suspect, p, q: suspect.fault is Fault.SWAPPED and set(suspect.positions) == {p, q},
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
        is_named=lambda suspect, p, q: suspect.structure_forgotten and suspect.positions == (p,),
    ),
    "plate tilted by 1 deg": Trial(
        faults=lambda p, q, sign: BenchFaults(plate_rad=np.deg2rad(1.0)),
        is_named=lambda suspect, p, q: suspect.fault is Fault.PLATE_TILTED,
    ),
    "plate tilted by 0.3 deg": Trial(
        faults=lambda p, q, sign: BenchFaults(plate_rad=np.deg2rad(0.3)),
        is_named=lambda suspect, p, q: suspect.fault is Fault.PLATE_TILTED,
    ),
}


def specimens(
    count: int, seed: int, trial: Trial | None = None, *, with_prior: bool = False
) -> tuple[list[Specimen], list[tuple[int, int]]]:
    """Draw sensors with a fault each, and the positions that it is about."""
    rng, loads = np.random.default_rng(seed), thesis_loads()
    drawn, places = [], []
    for k in range(count):
        p, q = (int(place) for place in rng.choice(_POSITIONS, 2, replace=False))
        faults = None if trial is None else trial.faults(p, q, float(rng.choice([-1.0, 1.0])))
        drawn.append(simulate_specimen(loads, PLACEMENT, rng, faults=faults, serial=f"S{k}", with_prior=with_prior))
        places.append((p, q))
    return drawn, places


def examined(drawn: list[Specimen]) -> list[Examined]:
    """Look for faults of each by what is stated of the bench."""
    return [examine([specimen.bench])[0] for specimen in drawn]


def examined_together(drawn: list[Specimen]) -> list[Examined]:
    """Look for faults of all, where nothing is stated of the bench, by how they scatter."""
    return examine([replace(specimen.bench, placement=None) for specimen in drawn])


def named_share(trial: Trial, count: int, seed: int, *, among: int = 0) -> float:
    """Share of sensors in which the fault is named first, with its positions; among sound ones by their scatter."""
    drawn, places = specimens(count, seed, trial)
    sound, _ = specimens(among, seed + 1)
    rows = examined_together([*drawn, *sound]) if among else examined(drawn)
    return float(
        np.mean(
            [
                bool(one.suspects) and trial.is_named(one.suspects[0], p, q)
                for one, (p, q) in zip(rows, places, strict=False)
            ]
        )
    )


def alarm_share(count: int, seed: int, *, together: bool = False) -> float:
    """Share of sound sensors in which anything is named."""
    drawn, _ = specimens(count, seed)
    rows = examined_together(drawn) if together else examined(drawn)
    return float(np.mean([bool(one.suspects) for one in rows]))


def plainly_named_share(count: int, seed: int) -> float:
    """Share of swaps in which both positions have the two largest residuals of an unweighted fit of readings to loads.

    Residuals are counted over the full scale of the channels, as the one unit that all of them have.
    """
    drawn, places = specimens(count, seed, TRIALS["two rows swapped"])
    hits = []
    for specimen, pair in zip(drawn, places, strict=True):
        bench = specimen.bench
        design = np.hstack([bench.raw, np.ones((len(bench), 1))])
        known = bench.loads.wrench
        left = known - design @ np.linalg.lstsq(design, known, rcond=None)[0]
        size = np.linalg.norm(left / np.abs(known).max(axis=0), axis=1)
        hits.append(set(np.argsort(-size)[:2].tolist()) == set(pair))
    return float(np.mean(hits))


def plate_alarm_share(count: int, seed: int) -> float:
    """Share of sensors in which a plate that is tilted by a degree is seen, where nobody asks for that fault."""
    drawn, _ = specimens(count, seed, TRIALS["plate tilted by 1 deg"])
    others = [fault for fault in Fault if fault is not Fault.PLATE_TILTED]
    alarms = []
    for specimen, one in zip(drawn, examined(drawn), strict=True):
        scatter = stated_scatter(specimen.bench, np.linalg.inv(specimen.response), PLACEMENT)
        alarms.append(bool(suspects(one.bench.loads, one.error, scatter, kinds=others)))
    return float(np.mean(alarms))


if __name__ == "__main__":
    amount = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    sys.stdout.write(f"by what is stated of the bench: alarms of sound sensors {alarm_share(amount, 100):.3f}\n")
    for name, kind in TRIALS.items():
        sys.stdout.write(f"  {name}: {named_share(kind, amount, 101):.3f}\n")
    sys.stdout.write(f"  plate tilted by 1 deg, not asked for: alarms {plate_alarm_share(amount, 101):.3f}\n")
    sys.stdout.write(f"swaps by the plain residual: {plainly_named_share(amount, 101):.3f}\n")
    sys.stdout.write(f"by the scatter of sensors: alarms of sound ones {alarm_share(amount, 100, together=True):.3f}\n")
    for name in list(TRIALS)[:3]:
        share = named_share(TRIALS[name], amount // 5, 101, among=amount - amount // 5)
        sys.stdout.write(f"  {name}: {share:.3f}\n")
