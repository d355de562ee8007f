# SPDX-License-Identifier: BSD-3-Clause
"""How far contacts and torques of a leg under skin are off, and how often inside their 95 % intervals.

`python -m tests.estimation.uncertain.limb_trials` prints the figures of docs/skin/estimation.md: skin on a cylinder,
taxels of 8 bits, a sensor with noise, all simulated.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import wrench_matrix
from forcetorque.estimation.skin_contacts import skin_sources
from forcetorque.estimation.uncertain.estimate_with_covariance import UncertainEstimates, estimate_with_covariance
from forcetorque.estimation.uncertain.input_errors import tangent_maps
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import MinimumNorm, Question
from forcetorque.robot.tree import build_tree
from tests.estimation.uncertain.limb import FOOT, FRICTION, Draws, Shin, cylinder, draw
from tests.skin.contact_trials import leg_layout

SEED: Final = 11
DRAWS: Final = 200
WIDE: Final = 1.96
"""Half a 95 % interval over the standard deviation."""
LENGTH_SCALE_M: Final = 0.1
"""Moment over force that the smallest solution weighs alike; m."""
LEG_OBJECTS: Final = 300
"""Objects on the leg that draws choose from."""
FEW_TAXELS: Final = 11
"""With so few active taxels a contact is felt too strongly, by more than is stated."""
_TOLD: Final = 1e-9
"""N, N m: a smaller standard deviation is that of a component that is exact."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """One set of contacts."""

    skin: int
    """Contacts on skin."""
    foot: bool
    """Whether a full wrench acts at the foot, off the skin."""
    friction: float
    """True coefficient."""
    believed: float | None
    """Coefficient that the estimator is told; None for free tangents."""


CASES: Final[Mapping[str, Case]] = {
    "two contacts, one on skin, no friction": Case(skin=1, foot=True, friction=0.0, believed=0.0),
    "three contacts, two on skin, no friction": Case(skin=2, foot=True, friction=0.0, believed=0.0),
    "two contacts, one on skin, friction": Case(skin=1, foot=True, friction=FRICTION, believed=FRICTION),
    "three contacts, two on skin, friction": Case(skin=2, foot=True, friction=FRICTION, believed=FRICTION),
    "two contacts, one on skin, friction hidden": Case(skin=1, foot=True, friction=FRICTION, believed=0.0),
    "two contacts, all on skin, tangents free": Case(skin=2, foot=False, friction=FRICTION, believed=None),
    "three contacts, all on skin, tangents free": Case(skin=3, foot=False, friction=FRICTION, believed=None),
}


@dataclass(frozen=True, kw_only=True)
class Figures:
    """What came out of one quantity."""

    inside: float
    """Share of numbers inside their 95 % intervals."""
    numbers: int
    """How many."""
    rmse: float
    """Root mean square of the norm of the error; N, or N m of torques."""
    sd: float
    """The same as predicted."""


def drawn(shin: Shin, case: Case, *, seed: int = SEED, draws: int = DRAWS) -> Draws:
    """Touch the leg."""
    return draw(shin, seed, draws, case.skin, friction=case.friction, believed=case.believed, foot=case.foot)


def answered(touched: Draws, case: Case) -> UncertainEstimates:
    """Estimate."""
    question = touched.question(foot=case.foot)
    simulation = touched.simulation
    return estimate_with_covariance(
        question,
        simulation.joints,
        simulation.root,
        measured=touched.measured,
        known=touched.known(),
        uncertainty=touched.uncertainty(),
    )


def figures(touched: Draws, answer: UncertainEstimates) -> dict[str, Figures]:
    """Compare with the truth: forces on skin, the foot's force and moment where it is touched, torques."""
    skin = [
        (answer.contact(source.contact.name) - touched.skin_truth[:, k], answer.contact_sd(source.contact.name))
        for k, source in enumerate(touched.sources)
    ]
    results = {
        "skin force": _figures(*(np.concatenate([one[side][:, :3] for one in skin]) for side in (0, 1))),
    }
    if "foot" in answer.contacts:
        error, sd = answer.contact("foot") - touched.foot, answer.contact_sd("foot")
        results |= {"foot force": _figures(error[:, :3], sd[:, :3]), "foot moment": _figures(error[:, 3:], sd[:, 3:])}
    for joint in answer.joints:
        error = answer.torque(joint) - touched.simulation.torque(joint)
        sd = answer.torque_sd[:, answer.joints.index(joint)]
        if (sd > _TOLD).any():
            results[f"torque of {joint}"] = _figures(error[:, None], sd[:, None])
    return results


def _figures(error: FloatArray, sd: FloatArray) -> Figures:
    return Figures(
        inside=float((np.abs(error) <= WIDE * sd)[sd > _TOLD].mean()),
        numbers=int((sd > _TOLD).sum()),
        rmse=float(np.sqrt((error**2).sum(axis=1).mean())),
        sd=float(np.sqrt((sd**2).sum(axis=1).mean())),
    )


def inside_by_taxels(touched: Draws, answer: UncertainEstimates) -> dict[str, tuple[float, int]]:
    """Share of skin forces inside their intervals, and draws, where a contact has few active taxels and where none."""
    few = touched.fewest <= FEW_TAXELS
    inside = [
        np.abs(answer.contact(source.contact.name) - touched.skin_truth[:, k])[:, :3]
        <= WIDE * answer.contact_sd(source.contact.name)[:, :3]
        for k, source in enumerate(touched.sources)
    ]
    shares = np.mean(inside, axis=(0, 2))
    sides = {f"up to {FEW_TAXELS} taxels": few, "more": ~few}
    return {name: (float(shares[rows].mean()), int(rows.sum())) for name, rows in sides.items() if rows.any()}


def normalised_errors(shin: Shin, seed: int = SEED) -> FloatArray:
    """Errors of what the skin tells of every object in scope, over their standard deviations; shape (k, 6).

    Along two tangents and the normal at the true centre of pressure, and about them.
    """
    rng = np.random.default_rng(seed)
    rows = []
    for truth in shin.truths:
        told = shin.felt([truth], rng)
        if len(told) != 1:
            continue
        (source,) = skin_sources("shin", "shank", [told], np.zeros(1, dtype=np.int64), friction=0.0)
        normal = -truth.wrench[:3] / np.linalg.norm(truth.wrench[:3])
        tangents = tangent_maps(truth.centre[None], normal[None])[0, :3].T
        centre_H_shank = np.eye(4)
        centre_H_shank[:3, :3] = np.vstack([tangents, normal])
        centre_H_shank[:3, 3] = -centre_H_shank[:3, :3] @ truth.centre
        matrix = wrench_matrix(centre_H_shank)
        sd = np.sqrt(np.diag(matrix @ source.covariance[0] @ matrix.T))
        rows.append(matrix @ (source.wrench[0] - truth.wrench) / sd)
    return np.array(rows)


def smallest_error(touched: Draws, *, foot: bool) -> float:
    """Root mean square error of a contact's force by the smallest wrenches that explain the sensor, without skin."""
    centres = touched.centres.mean(axis=0)
    contacts = [Contact.at_point("shank", centre, name=f"shin {k + 1}") for k, centre in enumerate(centres)]
    question = Question(
        tree=build_tree(touched.simulation.model, "base"),
        measured=("knee_ft",),
        contacts=(Contact(link="base"), *([FOOT] if foot else []), *contacts),
        minimum_norm=MinimumNorm(length_scale=LENGTH_SCALE_M),
    )
    least = estimate(question, touched.simulation.joints, touched.simulation.root, measured=touched.measured)
    errors = [least.contact(one.name)[:, :3] - touched.skin_truth[:, k, :3] for k, one in enumerate(contacts)]
    if foot:
        errors.append(least.contact("foot")[:, :3] - touched.foot[:, :3])
    return float(np.sqrt((np.concatenate(errors) ** 2).sum(axis=1).mean()))


def main() -> None:
    """Print errors and shares inside intervals."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--draws", type=int, default=DRAWS)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--skin-seed", type=int, default=2, help="seed of taxels and objects on the leg")
    parser.add_argument("--data", type=Path, help="folder of measured data: the layout of a leg in place of a cylinder")
    options = parser.parse_args()
    shin = (
        cylinder()
        if options.data is None
        else Shin(leg_layout(options.data), objects=LEG_OBJECTS, seed=options.skin_seed)
    )
    normalised = normalised_errors(shin, options.seed)
    rms = ", ".join(f"{number:.2f}" for number in np.sqrt((normalised**2).mean(axis=0)))
    print(f"{len(normalised)} objects: normalised errors along and about tangents and normal {rms}")  # noqa: T201
    for name, case in CASES.items():
        touched = drawn(shin, case, seed=options.seed, draws=options.draws)
        print(f"{name}; smallest norm without skin: {smallest_error(touched, foot=case.foot):.2f} N")  # noqa: T201
        answer = answered(touched, case)
        for side, (share, count) in inside_by_taxels(touched, answer).items():
            print(f"  skin force by the contact with the fewest taxels, {side}: {share:.1%} of {count} draws inside")  # noqa: T201
        for what, one in figures(touched, answer).items():
            line = f"{one.inside:.1%} of {one.numbers} inside, rmse {one.rmse:.3f}, predicted {one.sd:.3f}"
            print(f"  {what}: {line}")  # noqa: T201


if __name__ == "__main__":
    main()
