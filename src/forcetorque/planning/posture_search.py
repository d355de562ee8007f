# SPDX-License-Identifier: BSD-3-Clause
"""Postures and motions that lower the expected square error at the load cases (I-optimality) most."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, Protocol, TypeVar

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.evaluation.load_cases.load_case import LoadCase
from forcetorque.evaluation.load_cases.predicted_error import load_second_moment
from forcetorque.experiment.calibration.posterior import ModelPart, Posterior
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm
from forcetorque.planning.information import rows_by_model


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Readings:
    """One more reading at each of n postures, predicted from what is known."""

    with_unknowns: FloatArray
    """Covariance of the reading of every row with its unknowns; shape (rows, n, p)."""
    variance: FloatArray
    """Variance of the reading of every row; shape (rows, n)."""
    noise: FloatArray
    """That of its noise alone; shape (rows, 1)."""


HELPS = 0.05
"""Part by which a recording lowers an error at least, to be called a help."""


class Aim(Protocol):
    """What postures are picked for."""

    def gains(self, posterior: Posterior, centre: FloatArray, readings: Readings) -> FloatArray:
        """Compute by how much every posture would lower the aim.

        Args:
            posterior: What was known before.
            centre: What was taken off loads and variables; shape (6 + v,).
            readings: What would be read at the postures, by what is known now.

        Returns:
            The gains; shape (n,).
        """
        ...


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Volume:
    """Logarithm of the posterior volume of matrix and variables, for any load case; it has no unit of load."""

    def gains(self, posterior: Posterior, centre: FloatArray, readings: Readings) -> FloatArray:
        """As of `Aim`; the offset, of which every reading tells as much as any other, counts too.

        Args:
            posterior: As of `Aim`.
            centre: As of `Aim`.
            readings: As of `Aim`.

        Returns:
            The gains; shape (n,).
        """
        return 0.5 * np.log(readings.variance / readings.noise).sum(axis=0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Criterion:
    """Mean square force and moment error over the loads of a use, each over the square of what is allowed."""

    case: LoadCase
    """The use."""

    def row_weights(self, posterior: Posterior) -> FloatArray:
        """Compute the weight of a square error of every row.

        Args:
            posterior: What is known of the sensor.

        Returns:
            Weights; shape (rows,).
        """
        allowed = np.repeat(self.case.requirement, 3)
        return (posterior.to_wrench**2 / (allowed**2)[:, None]).sum(axis=0)

    def value(self, posterior: Posterior) -> float:
        """Give what is to be lowered.

        Args:
            posterior: What is known of the sensor.

        Returns:
            The expected square error over the allowed one, of force and moment together, without noise of a reading.
        """
        square = np.einsum("jk,ijk->i", load_second_moment(posterior, self.case), posterior.covariance)
        return float(self.row_weights(posterior) @ square)

    def shares(self, posterior: Posterior) -> FloatArray:
        """Compute the share of each component of the load.

        Args:
            posterior: What is known of the sensor.

        Returns:
            Parts of the value that come from loads along fx to tz alone; shape (6,).
        """
        moment = np.diag(load_second_moment(posterior, self.case))[:6]
        own = np.diagonal(posterior.mean_covariance, axis1=1, axis2=2)
        return (self.row_weights(posterior) @ own) * moment

    def gains(self, posterior: Posterior, centre: FloatArray, readings: Readings) -> FloatArray:
        """As of `Aim`.

        Args:
            posterior: As of `Aim`.
            centre: As of `Aim`.
            readings: As of `Aim`.

        Returns:
            The gains; shape (n,).
        """
        moment, covariance = self._moment(posterior, centre), readings.with_unknowns
        lowered = np.einsum("inj,jk,ink->in", covariance, moment, covariance, optimize=True)
        return self.row_weights(posterior) @ (lowered / readings.variance)

    def _moment(self, posterior: Posterior, centre: FloatArray) -> FloatArray:
        """Mean products at the loads of use of what the unknowns are multiplied by, for columns about their centre."""
        use = load_second_moment(posterior, self.case)
        size = len(centre)
        places = [*range(size), size + len(posterior.sessions) - 1]
        turned = np.eye(size + 1)
        turned[:size, size] = -centre
        return turned @ use[np.ix_(places, places)] @ turned.T


_OPEN = 1e6
"""Standard deviation of an unknown offset, over the noise of a posture."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Choices:
    """Postures that may be taken, and what each takes."""

    columns: FloatArray
    """Loads and variables at every posture; shape (n, 6 + v); the first posture is where the robot starts."""
    travel_s: Callable[[int], FloatArray]
    """From the number of a posture to the time from there to every posture, rest there included; shape (n,); s."""
    hold_s: float
    """How long it rests at a posture, at least a second counts; s."""
    seconds: float
    """How long all may take, the way back to the start included; s."""
    terms: tuple[ErrorTerm, ...] = ()
    """Errors of the robot model that the loads depend on."""
    model: FloatArray | None = None
    """Derivatives of the loads by these; shape (n, 6, terms); N, N m per unit of the term; None without terms."""


def pick(posterior: Posterior, aim: Aim, choices: Choices, *, haste: float) -> IntArray:
    """Pick postures greedily.

    The slow noise counts by what it moves on the way from one posture to the next; the exact worth of the whole is
    another matter, see `Knowledge.updated`.

    Args:
        posterior: What is known of the sensor.
        aim: What to lower.
        choices: The postures.
        haste: Power of the time by which the gain of a posture is divided: 1 for the most per second, 0 for the most
            per posture.

    Returns:
        Numbers of the postures in turn, the start first and last; shape (k,).
    """
    n, size = choices.columns.shape
    step_s = float(np.median(choices.travel_s(0)))
    noise = np.array(
        [
            _posture_variance(row.white, row.ratio, row.time_constant_s, choices.hold_s, step_s)
            for row in posterior.noise
        ]
    )
    known = _before(posterior, choices.terms, size)
    known[:, size, size] = _OPEN**2 * noise
    centre = choices.columns.mean(axis=0)
    design = np.column_stack([choices.columns - centre, np.ones(n)])
    model = np.zeros((len(noise), n, 0)) if choices.model is None else rows_by_model(posterior, choices.model)
    model = model - model.mean(axis=1, keepdims=True)
    picked, spent, way_back = [0], 0.0, choices.travel_s(0)
    while True:
        known = _taken(known, noise, design[picked[-1]], model[:, picked[-1]])
        gain = aim.gains(posterior, centre, _readings(known, noise, design, model))
        travel = choices.travel_s(picked[-1])
        reachable = spent + travel + way_back <= choices.seconds
        reachable[[0, picked[-1]]] = False
        if not reachable.any():
            return np.array([*picked, 0])
        picked.append(int(np.argmax(np.where(reachable, gain / travel**haste, -1.0))))
        spent += float(travel[picked[-1]])


def _posture_variance(white: float, ratio: float, time_s: float, hold_s: float, step_s: float) -> float:
    wandered = -np.expm1(-step_s / time_s) if ratio > 0.0 else 0.0
    return float(max(white, 1e-9) ** 2 * (1.0 / max(hold_s, 1.0) + ratio * wandered))


def _before(posterior: Posterior, terms: Sequence[ErrorTerm], size: int) -> FloatArray:
    """Covariance of loads and variables, an offset, and errors of the model; shape (rows, p, p)."""
    rows, unknowns = posterior.mean.shape
    model = (ModelPart.exact(rows, unknowns) if posterior.model is None else posterior.model).with_terms(terms)
    places = model.places(terms)
    known = np.zeros((rows, size + 1 + len(terms), size + 1 + len(terms)))
    known[:, :size, :size] = posterior.covariance[:, :size, :size]
    known[:, :6, :6] = posterior.mean_covariance
    known[:, size + 1 :, size + 1 :] = model.term_covariance[np.ix_(places, places)]
    known[:, :size, size + 1 :] = model.response[:, :size] @ model.term_covariance[:, places]
    known[:, size + 1 :, :size] = known[:, :size, size + 1 :].transpose(0, 2, 1)
    return known


def _taken(known: FloatArray, noise: FloatArray, design: FloatArray, model: FloatArray) -> FloatArray:
    """What is known once a reading more is taken; shape (rows, p, p)."""
    own = len(design)
    along = known[:, :, :own] @ design + np.einsum("ijt,it->ij", known[:, :, own:], model)
    variance = noise + along[:, :own] @ design + (along[:, own:] * model).sum(axis=1)
    return known - along[:, :, None] * along[:, None, :] / variance[:, None, None]


def _readings(known: FloatArray, noise: FloatArray, design: FloatArray, model: FloatArray) -> Readings:
    own = design.shape[1]
    covariance = np.einsum("ijk,nk->inj", known[:, :own, :own], design) + model @ known[:, own:, :own]
    variance = np.einsum("inj,nj->in", covariance, design) + noise[:, None]
    with_model = design @ known[:, :own, own:] + model @ known[:, own:, own:]
    variance += (with_model * model).sum(axis=2)
    return Readings(with_unknowns=covariance, variance=variance, noise=noise[:, None])


HASTES: Final = (1.0, 0.5, 0.0)
"""Powers of the time by which gains are divided, from the most per second to the most per posture: all are tried."""


class Motion(Protocol):
    """A motion through postures that was evaluated as a whole."""

    @property
    def postures(self) -> FloatArray:
        """Postures in turn; shape (k, j)."""
        ...

    @property
    def duration_s(self) -> float:
        """How long it takes; s."""
        ...

    @property
    def value(self) -> float:
        """What is to be lowered."""
        ...


M = TypeVar("M", bound=Motion)


def search(
    through: Callable[[FloatArray], M],
    drawn: FloatArray,
    orders: Sequence[FloatArray],
    *,
    seconds: float,
    swaps: int,
    rng: np.random.Generator,
) -> M:
    """Find a motion that is worth much.

    Args:
        through: From postures in turn to the motion through them.
        drawn: Postures that may be taken; shape (n, j).
        orders: Motions to begin from, as postures in turn.
        seconds: How long it may take; s. Only where no motion to begin from is as short may the answer be longer.
        swaps: Changes that are tried.
        rng: Source of the changes.

    Returns:
        The best of all that was tried.
    """
    best = min(map(through, orders), key=lambda motion: (motion.duration_s > seconds, motion.value))
    for _ in range(swaps):
        other = through(_changed(best.postures, drawn, rng))
        if other.duration_s <= seconds and other.value < best.value:
            best = other
    return best


def picked_orders(posterior: Posterior, aim: Aim, choices: Choices, drawn: FloatArray) -> list[FloatArray]:
    """Pick postures greedily, in haste and without.

    Args:
        posterior: What is known of the sensor.
        aim: What to lower.
        choices: The postures.
        drawn: The same as positions of joints; shape (n, j).

    Returns:
        Postures in turn, for each of `HASTES`.
    """
    return [drawn[pick(posterior, aim, choices, haste=haste)] for haste in HASTES]


def _changed(postures: FloatArray, drawn: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Another posture in place of one, between two, or two in another order; the ends stay."""
    last = len(postures) - 1
    new = drawn[rng.integers(1, len(drawn))]
    if last < 2 or rng.uniform() < 0.25:
        return np.insert(postures, rng.integers(1, last + 1), new, axis=0)
    changed = postures.copy()
    first, second = rng.integers(1, last, size=2)
    if first != second and rng.uniform() < 0.5:
        changed[[first, second]] = changed[[second, first]]
    else:
        changed[first] = new
    return changed
