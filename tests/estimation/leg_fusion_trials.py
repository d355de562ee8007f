# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of a simulated leg, by an experiment file as users write it: FT sensor, skin and motors, one broken.

`python -m tests.estimation.leg_fusion_trials` prints figures of docs/estimation/fusion.md. Counts of skin are simulated
taxel by taxel and read through a calibration; objects of 0.2 to 3 kg are put on the shank of a leg whose hip moves.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.estimation.skin_contacts import clock_stream
from forcetorque.estimation.torque.experiment_fusion import fuse_experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.offsets import corrections_of
from tests.scenes.moving_leg import DRIVEN, FILE, Faults, write_moving_leg

FIRST, SEEDS = 20, 20
"""Seeds on which nothing was chosen; those of other tests are below."""
ROWS: Final = 6
"""Of modules, about as many as a lower leg has."""
HOT_COUNTS: Final = 5.0
"""What heat of some 4 degrees takes from the taxels of one side."""
FAULTS: Final = {
    None: Faults(),
    "skin": Faults(hot_counts=HOT_COUNTS),
    "ft": Faults(ft_N=5.0),
    "current": Faults(friction=1.3),
}
"""What is wrong, by the source that is."""


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One leg, over the interval in which a source may be broken."""

    conflict: bool
    """Whether there is a conflict."""
    named: str | None
    """The source that is said to be in conflict."""
    squares: dict[str, float]
    """Mean squared error of each source and of all together; (N m)^2."""
    covered: float
    """Share of 95 % intervals of fused torques that hold the truth."""


def trials(broken: str | None, seeds: int = SEEDS) -> Iterator[Trial]:
    """Write and fuse a leg per seed."""
    for seed in range(FIRST, FIRST + seeds):
        with tempfile.TemporaryDirectory() as folder:
            yield _trial(Path(folder), seed, FAULTS[broken])


def _trial(folder: Path, seed: int, faults: Faults) -> Trial:
    simulation = write_moving_leg(folder, seed=seed, faults=faults, along=ROWS)
    experiment = load_experiment(folder / FILE, Purpose.FORCES)
    (_, judged), _ = fuse_experiment(experiment, corrections_of(experiment, {}))
    fusion = judged.fusion
    rows = np.searchsorted(clock_stream(experiment).stamp_ns, fusion.stamp_ns)
    truth = np.stack([simulation.torque(joint)[rows] for joint in DRIVEN], axis=1)
    told = {source.name: source.torque for source in judged.sources} | {"fused": fusion.torque}
    return Trial(
        conflict=fusion.conflict.is_there,
        named=fusion.conflict.source,
        squares={name: float(np.nanmean((torque - truth) ** 2)) for name, torque in told.items()},
        covered=float(np.mean(np.abs(fusion.torque - truth) <= fusion.half_width)),
    )


def rmse(some: Sequence[Trial], name: str) -> float:
    """Error of a source, pooled over seeds; N m."""
    return float(np.sqrt(np.mean([trial.squares[name] for trial in some])))


def in_words(broken: str | None, some: Sequence[Trial]) -> str:
    """Write figures down."""
    errors = ", ".join(f"{name} {rmse(some, name):.3f}" for name in some[0].squares)
    named = sum(trial.conflict and trial.named == broken for trial in some)
    conflicts, covered = sum(trial.conflict for trial in some), np.mean([trial.covered for trial in some])
    return (
        f"{broken or 'nothing'} broken, {len(some)} seeds: conflict in {conflicts}, named in {named}; "
        f"RMSE {errors} N m; 95 % intervals hold {covered:.1%}"
    )


def main() -> None:
    """Print errors, names and coverage."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--seeds", type=int, default=SEEDS)
    seeds: int = parser.parse_args().seeds
    for broken in FAULTS:
        print(in_words(broken, list(trials(broken, seeds))), flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
