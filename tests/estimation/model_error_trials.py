# SPDX-License-Identifier: BSD-3-Clause
"""Fused joint torques of simulated arms whose masses, centres of mass and joint zeros differ from the model.

`python -m tests.estimation.model_error_trials` prints figures of docs/estimation/fusion.md. The arms are those of
`tests/estimation/torque/fusion_trials.py`; torques come from the wrong model, and friction is fitted to them.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.modified_robot import RobotErrors
from tests.estimation.torque.fusion_trials import JOINTS, Arm, Faults, Trial, figures, pooled

SEEDS: Final = 100
FIRST: Final = 5000
"""First seed that nothing was chosen on."""
STATED_ON: Final = range(500, 530)
"""Seeds whose errors give the deviations that are stated."""
LEAST_NM: Final = 0.005
PUSH_N: Final = 15.0


@dataclass(frozen=True, kw_only=True)
class Size:
    """Standard deviations of what differs between robot and model."""

    mass: float
    """Relative."""
    centre_m: float
    """Of each coordinate of centres of mass; m."""
    joint_zero_deg: float
    """Of joint zeros; degrees."""

    def draw(self, seed: int) -> Arm:
        """Draw the arm of a seed."""
        arm = Arm(seed)
        rng = np.random.default_rng(seed + 77_777)
        errors = RobotErrors.draw(
            arm.model,
            mass=self.mass,
            centre_m=self.centre_m,
            joint_zero_rad=np.deg2rad(self.joint_zero_deg),
            rng=rng,
        )
        return arm.with_robot(errors.applied_to(arm.model))


SIZES: Final = {
    "small": Size(mass=0.02, centre_m=0.002, joint_zero_deg=0.2),
    "large": Size(mass=0.1, centre_m=0.01, joint_zero_deg=1.0),
}


def deviations(size: Size) -> FloatArray:
    """Root mean square errors that the model alone makes, by joint; of sensor and skin the larger; shape (j,); N m."""
    squares = []
    for seed in STATED_ON:
        arm = size.draw(seed)
        motion, pushes = arm.motion(), arm.pushes(np.full(len(arm.seconds), PUSH_N), np.zeros(2))
        truth, reading = arm.truth(motion, pushes)
        asked = ((arm.question(arm.anywhere, ft=True), "arm_ft", reading), (arm.question(arm.push), "push", pushes))
        torques = [
            estimate(
                question,
                motion,
                arm.root,
                measured=Wrenches.of({name: wrench}) if name == "arm_ft" else None,
                known=Wrenches.of({name: wrench}) if name == "push" else None,
            ).torques
            for question, name, wrench in asked
        ]
        squares.append([((torque - truth) ** 2).mean(axis=0) for torque in torques])
    larger: FloatArray = np.maximum(np.sqrt(np.mean(squares, axis=0)).max(axis=0), LEAST_NM)
    return larger


def trials(size: Size, stated_nm: FloatArray, seeds: int = SEEDS, first: int = FIRST) -> list[Trial]:
    """Fuse the torques of one arm per seed."""
    return [size.draw(seed).stating(stated_nm).trial(Faults()) for seed in range(first, first + seeds)]


def in_words(what: str, stated: FloatArray, some: Sequence[Trial]) -> str:
    """Write figures down."""
    told = figures(some)
    errors = ", ".join(f"{name} {pooled(rmse):.3f}" for name, rmse in told.rmse.items())
    covered = np.mean([np.abs(trial.fusion.torque - trial.truth) <= trial.fusion.half_width for trial in some], (0, 1))
    return (
        f"{what}: {len(some)} seeds, stated {' '.join(f'{v:.3f}' for v in stated)} N m; RMSE {errors} N m; 95 % "
        f"intervals hold {told.covered:.1%} ({told.covered_unwidened:.1%} unwidened; by joint "
        f"{' '.join(f'{v:.1%}' for v in covered)}); conflict in {told.conflicts}, named {told.named}"
    )


def main() -> None:
    """Print errors and coverage for deviations stated by joint, as one number, and too small."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--seeds", type=int, default=SEEDS)
    seeds: int = parser.parse_args().seeds
    for name, size in SIZES.items():
        by_joint = deviations(size)
        one = np.full(len(JOINTS), float(np.sqrt((by_joint**2).mean())))
        for what, stated in (("by joint", by_joint), ("one number", one), ("a quarter", by_joint / 4.0)):
            print(in_words(f"{name}, {what}", stated, trials(size, stated, seeds)), flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
