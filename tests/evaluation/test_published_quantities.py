# SPDX-License-Identifier: BSD-3-Clause
"""Every quantity of force spheres and drifts changes with units, signs, axes and exchange as that quantity must."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
from pydantic import BaseModel

from forcetorque.base.arrays import FloatArray
from forcetorque.evaluation.sphere.pooled_fit import pool_trials
from forcetorque.evaluation.sphere.sensor_sphere import analyse_sphere
from forcetorque.evaluation.trials.trials import drift_between
from tests.evaluation.sphere.clouds import DEFORMED, grid, map_of, slow_noise

GRAVITY, MASS = 9.81, 4.6
SAME = 1e-5
"""Of the largest number of a quantity: where the geometric fits end."""
ROUNDING = 1e-6
"""N and other units: a centre that is taken off is zero up to it."""
LEVER = np.array([[0.2, 0.15, -0.02], [-0.15, 0.25, 0.01], [0.02, -0.01, 0.3]])
"""Moments per force, of a kind that spans all directions; m."""
CYCLE, HALF_TURN = np.eye(3)[[2, 0, 1]], np.diag([1.0, -1.0, -1.0])


class Trial(NamedTuple):
    """Readings of a limb that goes over a sphere, and what the model expects."""

    wrench: FloatArray
    reference: FloatArray


@cache
def _trials() -> tuple[Trial, ...]:
    """Three, each with its offset; the sensor changes a little from one to the next."""
    rng = np.random.default_rng(7)
    trials = []
    for k, directions in enumerate((grid(700, 110.0), grid(700, 100.0)[:, [2, 0, 1]], grid(700, 105.0)[:, [1, 2, 0]])):
        expected = MASS * GRAVITY * np.hstack([directions, directions @ LEVER.T])
        matrix = np.kron(np.eye(2), (map_of(DEFORMED) / (MASS * GRAVITY)) * (1.0 + 0.02 * k))
        noise = np.hstack([slow_noise(rng, len(directions), size, 0.9) for size in (0.3, 0.01)])
        trials.append(Trial(expected @ matrix.T + [12.0, -30.0, 55.0, 1.0, -2.0, 0.5 + 0.1 * k] + noise, expected))
    return tuple(trials)


Numbers = dict[str, FloatArray]


def _numbers(result: object, name: str) -> Numbers:
    """Numbers of a result and of all that it is made of, by name."""
    if is_dataclass(result) or isinstance(result, BaseModel):
        own = [one.name for one in fields(result)] if is_dataclass(result) else list(type(result).model_fields)
        derived = [one for one in ("index", "axis_intersections", "half_widths") if hasattr(result, one)]
        parts = [_numbers(getattr(result, one), f"{name} {one}") for one in (*own, *derived)]
        return {key: values for part in parts for key, values in part.items()}
    is_text = isinstance(result, str) or (isinstance(result, tuple) and all(isinstance(one, str) for one in result))
    return {} if result is None or is_text else {name: np.array(result, dtype=np.float64)}


def _published(trials: tuple[Trial, ...], gravity: float = GRAVITY, mass: float = MASS) -> Numbers:
    analyses = [analyse_sphere(one.wrench, one.reference, gravity=gravity, mass=mass) for one in trials]
    alone = analyse_sphere(trials[0].wrench, None, gravity=gravity)
    pooled = pool_trials(
        [one.wrench[:, :3] for one in trials], [one.reference[:, :3] for one in trials], weight=mass * gravity
    )
    drift = drift_between(analyses[0].free, analyses[2].free, gravity=gravity)
    assert drift is not None
    results = {"sphere": analyses[0], "alone": alone, "pooled": pooled, "drift": drift}
    return {key: values for name, result in results.items() for key, values in _numbers(result, name).items()}


@cache
def _before() -> Numbers:
    return _published(_trials())


def _with(wrench: FloatArray) -> tuple[Trial, ...]:
    """The trials, readings and references times a matrix."""
    return tuple(Trial(one.wrench @ wrench.T, one.reference @ wrench.T) for one in _trials())


class Rule(NamedTuple):
    """How a quantity changes."""

    force: int = 0
    """Power of the unit of force."""
    shape: str = "number"
    """`number`; `vector`, `sizes` without a sign or `map` of three axes."""


LAST_WORD = {
    "centre": Rule(1, "vector"),
    "centres": Rule(1, "vector"),
    "Nm": Rule(1, "sizes"),
    "shape": Rule(-2, "map"),
    "matrix": Rule(0, "map"),
    "low": Rule(1, "sizes"),
    "high": Rule(1, "sizes"),
    "margin": Rule(1, "sizes"),
    "intersections": Rule(1, "sizes"),
    "widths": Rule(1, "sizes"),
    "algebraic": Rule(1),
    "geometric": Rule(1),
    "rms": Rule(1),
    "index": Rule(1),
    "radius": Rule(1),
    "mass": Rule(1),
    "kg": Rule(1, "sizes"),
    "N": Rule(1, "vector"),
}
"""By the last word of the name; others are counts, shares and verdicts, which stay."""


def _rule(name: str) -> Rule:
    if name.endswith("centre_Nm"):
        return Rule(1, "vector")
    if "margin" in name:
        return Rule(1, "sizes")
    return LAST_WORD.get(name.replace("_", " ").split()[-1], Rule())


def _turned(name: str, values: FloatArray, three: FloatArray) -> FloatArray:
    shape = _rule(name).shape
    if shape == "number" or not values.shape or values.shape[-1] != 3:
        return values
    if shape == "map":
        return three @ values @ three.T
    order = np.abs(three).argmax(axis=1)
    signs = three.sum(axis=1) if shape == "vector" else np.ones(3)
    return values[..., order] * signs


def _of_lighter(name: str, values: FloatArray) -> FloatArray:
    """The same forces where gravity is twice as strong."""
    if name.endswith("gravity"):
        return 2.0 * values
    return 0.5 * values if name.endswith(("kg", "mass")) else values


CHANGES: dict[str, tuple[Callable[[], Numbers], Callable[[str, FloatArray], FloatArray]]] = {
    "unit of force": (
        lambda: _published(_with(2.0 * np.eye(6)), mass=2.0 * MASS),
        lambda name, values: 2.0 ** _rule(name).force * values,
    ),
    "unit of mass": (
        lambda: _published(_trials(), gravity=2.0 * GRAVITY, mass=0.5 * MASS),
        _of_lighter,
    ),
    "axes": (lambda: _published(_with(np.kron(np.eye(2), CYCLE))), lambda name, values: _turned(name, values, CYCLE)),
    "half turn": (
        lambda: _published(_with(np.kron(np.eye(2), HALF_TURN))),
        lambda name, values: _turned(name, values, HALF_TURN),
    ),
}


@pytest.mark.parametrize("change", CHANGES)
def test_quantities_change_with_units_and_axes(change: str) -> None:
    """By the change of the quantity that its definition states, or not at all."""
    published, expected = CHANGES[change]
    before, after = _before(), published()
    assert before.keys() == after.keys()
    assert len(before) > 60
    wrong = []
    for name, values in before.items():
        if name.endswith("directions") and change in ("axes", "half turn"):
            continue  # counted in cells, which do not turn with the axes
        wanted = expected(name, values)
        largest = np.abs(wanted[np.isfinite(wanted)]).max(initial=0.0)
        if not np.allclose(after[name], wanted, rtol=SAME, atol=SAME * largest + ROUNDING, equal_nan=True):
            wrong.append((name, after[name].tolist(), wanted.tolist()))
    assert not wrong


def test_a_drift_backwards_has_the_other_sign() -> None:
    """And is as sure; of a sensor that reads 4 % more, the masses are 4 % larger, and the index too."""
    first, _, last = (analyse_sphere(one.wrench, one.reference, gravity=GRAVITY).free for one in _trials())
    there, back = drift_between(first, last, gravity=GRAVITY), drift_between(last, first, gravity=GRAVITY)
    assert there is not None
    assert back is not None
    forth, reverse = _numbers(there, "drift"), _numbers(back, "drift")
    for name, values in forth.items():
        wanted = values if "margin" in name or name.endswith("identifiable") else -values
        np.testing.assert_allclose(reverse[name], wanted, rtol=1e-9, err_msg=name)
    assert first.ellipsoid is not None
    np.testing.assert_allclose(forth["drift mass_kg"], 0.04 * first.ellipsoid.axis_intersections / GRAVITY, rtol=0.3)
    np.testing.assert_allclose(forth["drift index_kg"], 0.04 * first.index / GRAVITY, rtol=0.3)
