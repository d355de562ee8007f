# SPDX-License-Identifier: BSD-3-Clause
"""Weight and bias of the tool of a dataset: identified from its own episodes, or with a load that is known.

What is taken off is weight at rest: forces of acceleration stay, because a dataset has no true times to derive them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FitError, FormatError
from forcetorque.base.stored_table import read_json
from forcetorque.base.units import MAD_TO_DEVIATION, NORMAL_95
from forcetorque.base.wrench import MeasureDirection, reading_sign
from forcetorque.payload.identification.estimation_problem import Load, LoadProblem, LoadRows
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.identification.measurement_model import changes, load_columns, load_wrench
from forcetorque.payload.identification.parameter_vector import Kind
from forcetorque.payload.load_from_result_file import SCHEMA

MOST_WINDOWS = 1500
"""Means that weight and bias are identified from, evenly over the dataset."""
_WINDOW_S = 0.2
"""Length of a mean; s."""
_BLOCKS = 12
"""Groups of neighbouring episodes whose biases are compared."""
_SESSIONS = 12
"""Episodes with a bias each that the weight is identified from, where every episode has its own."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class KnownLoad(ArrayRecord):
    """A load from a result of `forcetorque payload`."""

    mass_kg: float
    """Mass; kg."""
    centre_of_mass_m: FloatArray = field(metadata=array(3))
    """Centre of mass in the sensor's frame; shape (3,); m."""
    covariance: FloatArray = field(metadata=array(4, 4))
    """Of mass and first moment; shape (4, 4); kg, kg m."""


def read_known_load(file: Path) -> KnownLoad:
    """Read the load that `forcetorque payload FILE --format json` identified on a wrist sensor.

    Args:
        file: JSON file.

    Returns:
        The load; errors of its numbers are taken as independent.

    Raises:
        FormatError: If it is no such result, or has another number of loads than one with mass and centre of mass.
    """
    content = read_json(file, expected="a result of `forcetorque payload FILE --format json`, there is none")
    if not isinstance(content, dict) or content.get("schema") != SCHEMA:
        raise FormatError(f"{file}: expected a result of `forcetorque payload FILE --format json`, schema {SCHEMA!r}")
    loads = content.get("loads")
    if not isinstance(loads, list) or len(loads) != 1 or not isinstance(loads[0], dict):
        raise FormatError(f"{file}: loads: expected one load, the tool of the dataset")
    row = loads[0]
    if row.get("link") is not None:
        raise FormatError(f"{file}: loads: expected a load in the frame of the sensor, got one on link {row['link']!r}")
    mass, halves = row.get("mass_kg"), row.get("mass_half_width_95_kg")
    centre, centre_halves = row.get("centre_of_mass_m"), row.get("centre_of_mass_half_width_95_m")
    numbers = [_number(value) for value in (mass, halves, *_three(centre), *_three(centre_halves))]
    values = np.array([value for value in numbers if value is not None])
    if len(values) != len(numbers) or not values[0] > 0.0 or (values[[1, 5, 6, 7]] < 0.0).any():
        raise FormatError(f"{file}: loads: expected mass and centre of mass with intervals, got a load without them")
    error, error_of_centre = values[1] / NORMAL_95, values[5:] / NORMAL_95
    change = np.zeros((4, 4))
    change[0, 0], change[1:, 0], change[1:, 1:] = 1.0, values[2:5], values[0] * np.eye(3)
    covariance = change @ np.diag([error**2, *error_of_centre**2]) @ change.T
    return KnownLoad(mass_kg=float(values[0]), centre_of_mass_m=values[2:5], covariance=covariance)


def _three(values: Any) -> tuple[Any, Any, Any]:
    return (values[0], values[1], values[2]) if isinstance(values, list) and len(values) == 3 else (None, None, None)


def _number(value: Any) -> float | None:
    is_number = isinstance(value, int | float) and not isinstance(value, bool) and np.isfinite(value)
    return float(value) if is_number else None


class ToolSamples:
    """Means of measurement and gravity over short windows of the episodes of a dataset."""

    def __init__(self, rate_hz: float, total_frames: int) -> None:
        """Begin a dataset.

        Args:
            rate_hz: Frames per second.
            total_frames: Frames that may be used, of all episodes.
        """
        self._rate_hz = rate_hz
        self.size = max(1, round(_WINDOW_S * rate_hz))
        self._every = max(1, -(-total_frames // (self.size * MOST_WINDOWS)))
        self._windows = 0
        self._wrench: list[FloatArray] = []
        self._gravity: list[FloatArray] = []
        self._orientation: list[FloatArray] = []
        self._time_s: list[float] = []
        self._episode: list[int] = []
        self._frames = 0

    def add(self, episode: int, wrench: FloatArray, gravity: FloatArray, turned: FloatArray, usable: Any) -> None:
        """Take an episode.

        Args:
            episode: Its number.
            wrench: Measurements; shape (n, 6); N, N m.
            gravity: Along the sensor's axes; shape (n, 3); m/s2.
            turned: `world_R_sensor`; shape (n, 3, 3).
            usable: Which frames may be used; shape (n,).
        """
        for first in range(0, len(wrench) - self.size + 1, self.size):
            window = slice(first, first + self.size)
            self._windows += 1
            if self._windows % self._every or not usable[window].all():
                continue
            self._wrench.append(wrench[window].mean(axis=0))
            self._gravity.append(gravity[window].mean(axis=0))
            self._orientation.append(turned[first + self.size // 2])
            self._time_s.append((self._frames + first + 0.5 * (self.size - 1)) / self._rate_hz)
            self._episode.append(episode)
        self._frames += len(wrench)

    def problem(
        self, known: KnownLoad | None, direction: MeasureDirection, *, mount: bool, by_episode: bool
    ) -> LoadProblem:
        """Set up the estimation.

        Args:
            known: The load; None to identify it.
            direction: Who acts on whom in the measurement.
            mount: Whether the sensor is turned against the frame of the orientation by an unknown rotation.
            by_episode: Whether every episode has a bias of its own; some episodes are then taken.

        Returns:
            The problem.

        Raises:
            FitError: If there is no window.
        """
        if not self._wrench:
            raise FitError(
                f"expected {self.size} frames in a row with measurement and orientation, got none; the field "
                "or the orientation have gaps, or are stuck, all over it"
            )
        episode = np.array(self._episode)
        chosen = np.unique(episode)
        if by_episode:
            chosen = chosen[np.unique(np.linspace(0, len(chosen) - 1, _SESSIONS).round().astype(int))]
        mine = np.isin(episode, chosen)
        number = np.searchsorted(chosen, episode[mine])
        groups = min(len(chosen), _BLOCKS)
        block = number if by_episode else number * groups // len(chosen)
        names = [f"episode {value}" for value in chosen]
        rows = LoadRows(
            wrench=np.array(self._wrench)[mine],
            proper_acceleration=-np.array(self._gravity)[mine],
            time_s=np.array(self._time_s)[mine],
            session=number if by_episode else np.zeros(len(number), dtype=np.int64),
            block=block,
            load=np.zeros(len(number), dtype=np.int64),
            share=np.ones(len(number)),
            names=tuple(
                f"episode {value} at {time:.2f} s of the dataset"
                for value, time in zip(episode[mine], np.array(self._time_s)[mine], strict=True)
            ),
        )
        return LoadProblem(
            rows=rows,
            loads=(_load(known),),
            sessions=tuple(names) if by_episode else ("dataset",),
            blocks=tuple(names) if by_episode else tuple(f"episodes of part {k + 1}" for k in range(groups)),
            direction=direction,
            drift=False,
            mount=mount,
        )


def _load(known: KnownLoad | None) -> Load:
    if known is None:
        return Load(name="load")
    return Load(name="load", mass=known.mass_kg, centre_of_mass=known.centre_of_mass_m)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tool(ArrayRecord):
    """What is taken off the measurement of a sensor."""

    problem: LoadProblem
    """What was fitted, of which load and direction are used."""
    solution: LoadSolution
    """Load and biases."""
    known: KnownLoad | None
    """The load, where it was not identified."""
    noise: FloatArray = field(metadata=array(6))
    """Standard deviation of a frame's noise; shape (6,); N, N m."""
    by_episode: bool
    """Whether every episode has a bias of its own."""

    def taken_off(self, wrench: FloatArray, gravity: FloatArray, rate_hz: float) -> tuple[FloatArray, FloatArray]:
        """Take weight and bias off the frames of an episode.

        Args:
            wrench: Measurements; shape (n, 6); N, N m; NaN where there is none.
            gravity: Along the axes of the orientation's frame; shape (n, 3); m/s2; NaN where it is not known.
            rate_hz: Frames per second.

        Returns:
            What is left, shape (n, 6), NaN where measurement or gravity are; and the covariance of its error, noise of
            a frame included; shape (n, 6, 6).
        """
        left, covariance = np.full(wrench.shape, np.nan), np.full((len(wrench), 6, 6), np.nan)
        usable = np.isfinite(wrench).all(axis=1) & np.isfinite(gravity).all(axis=1)
        if not usable.any():
            return left, covariance
        rows = LoadRows.of_poses(wrench[usable], -gravity[usable])
        problem = replace(self.problem, rows=rows, sessions=self.problem.sessions[:1], blocks=("episode",))
        guess = self.solution.guess
        weight = load_wrench(problem, guess)
        of_bias = np.array([one.kind is Kind.BIAS for one in guess.parameters])
        design = changes(problem, guess)
        spread = self.solution.covariance
        if self.by_episode:
            design, spread = design[:, :, ~of_bias], spread[np.ix_(~of_bias, ~of_bias)]
            bias, bias_covariance = _bias_of_episode(wrench[usable] - weight, rate_hz)
        else:
            design[:, :, of_bias & np.array([one.owner != 0 for one in guess.parameters])] = 0.0
            bias, bias_covariance = guess.of(Kind.BIAS, 0), np.zeros((6, 6))
        error = np.einsum("nip,pq,njq->nij", design, spread, design) + bias_covariance
        if self.known is not None:
            sign = reading_sign(self.problem.direction, child_is_outboard=True)
            columns = sign * load_columns(rows, guess.rotation, np.zeros(0))[:, :, :4]
            error = error + np.einsum("nip,pq,njq->nij", columns, self.known.covariance, columns)
        left[usable] = wrench[usable] - weight - bias
        covariance[usable] = error + np.diag(self.noise**2)
        return left, covariance


def _bias_of_episode(left: FloatArray, rate_hz: float) -> tuple[FloatArray, FloatArray]:
    """Median of what the weight leaves, and its covariance by windows that are taken as independent."""
    size = max(1, round(_WINDOW_S * rate_hz))
    windows = np.array([block.mean(axis=0) for block in np.array_split(left, max(1, len(left) // size))])
    bias = np.median(windows, axis=0)
    scatter = MAD_TO_DEVIATION * np.median(np.abs(windows - bias), axis=0)
    # variance of a median of normal numbers: pi / 2 of that of a mean
    return bias, np.diag(0.5 * np.pi * scatter**2 / len(windows))


def identified(
    samples: ToolSamples,
    noises: Sequence[FloatArray],
    *,
    known: KnownLoad | None,
    direction: MeasureDirection,
    mount: bool,
    by_episode: bool,
) -> Tool:
    """Identify weight and bias, or the bias under a known load.

    Args:
        samples: Means of the episodes.
        noises: Standard deviation of white noise in each episode, NaN where it is not known; shapes (6,).
        known: The load; None to identify it.
        direction: Who acts on whom in the measurement.
        mount: As of `ToolSamples.problem`.
        by_episode: As of `ToolSamples.problem`.

    Returns:
        The tool.

    Raises:
        FitError: If the episodes do not determine it, or say a mass below zero.
    """
    problem = samples.problem(known, direction, mount=mount, by_episode=by_episode)
    solution = solve(problem)
    (load,) = solution.loads
    if not load.is_determined or not np.isfinite(solution.covariance).all():
        reasons = "; ".join(solution.open_directions) or "gravity does not turn in the sensor"
        raise FitError(f"the episodes do not determine weight and bias: {reasons}; give --load, or turn the wrist more")
    if not load.mass > 0.0:
        reasons = "; ".join(f"{row.name}: {row.description}" for row in solution.hypotheses)
        raise FitError(
            f"expected a mass above 0 kg, got {load.mass:.3g} kg; check --sense and --direction, whose signs "
            f"decide it{f': {reasons}' if reasons else ''}"
        )
    known_noise = np.array([noise for noise in noises if np.isfinite(noise).all()])
    scatter = MAD_TO_DEVIATION * np.median(np.abs(solution.residual), axis=0) * np.sqrt(samples.size)
    noise = np.median(known_noise, axis=0) if len(known_noise) else scatter
    return Tool(problem=problem, solution=solution, known=known, noise=noise, by_episode=by_episode)
