# SPDX-License-Identifier: BSD-3-Clause
"""A residual that repeats with the load is an error of the model; one that does not repeat is not."""

from __future__ import annotations

from operator import itemgetter

import numpy as np
import pytest

from forcetorque.inspection.model_errors import ModelErrors

RATE = 20
SECONDS = 120.0
LIMIT_N = 4.0
RUN = (1000, 1060)
"""Three seconds in which something may touch the limb."""


def _errors(touched: bool = False, *, share: float = 0.3) -> ModelErrors:
    """A limb of 40 N that turns, whose fx takes a share of fz; in `RUN` a force of 10 N along x, or none."""
    seconds = np.arange(SECONDS * RATE) / RATE
    angle = 1.2 * np.sin(0.37 * seconds) + 0.4 * np.sin(1.1 * seconds)
    expected = np.zeros((len(seconds), 6))
    expected[:, 0], expected[:, 2] = 40.0 * np.sin(angle), -40.0 * np.cos(angle)
    residual = np.random.default_rng(1).normal(size=expected.shape) * 0.1
    residual[:, 0] += share * expected[:, 2]
    residual[:, 0] -= np.median(residual[:, 0])
    if touched:
        residual[RUN[0] : RUN[1] + 1, 0] += 10.0
    return ModelErrors(residual=residual, expected=expected, usable=np.ones(len(seconds), dtype=bool))


def _explains(errors: ModelErrors, first: int = RUN[0], last: int = RUN[1], shortest: int = 10) -> bool:
    return errors.explain_level(
        first,
        last,
        itemgetter((slice(None), 0)),
        np.full(last - first + 1, LIMIT_N),
        axes=slice(0, 1),
        is_moment=False,
        margin=RATE,
        shortest=shortest,
    )


def test_a_residual_that_repeats_with_the_load_is_explained_and_a_contact_is_not() -> None:
    """The same interval with and without 10 N on top, in a limb whose model is 30 % off in one direction."""
    assert _explains(_errors())
    assert not _explains(_errors(touched=True))


def test_a_residual_under_a_load_that_the_rest_of_the_log_does_not_have_is_not_predicted() -> None:
    """In the interval the limb is turned farther than ever; any model may be 20 % off, but not 30 %."""
    errors = _errors(share=0.45)
    expected = np.array(errors.expected)
    expected[RUN[0] : RUN[1] + 1, 2] = 40.0
    residual = np.array(errors.residual)
    residual[RUN[0] : RUN[1] + 1, 0] = 0.45 * 60.0
    beyond = ModelErrors(residual=residual, expected=expected, usable=errors.usable)
    assert not _explains(beyond)
    residual[RUN[0] : RUN[1] + 1, 0] = 0.15 * 40.0
    assert _explains(ModelErrors(residual=residual, expected=expected, usable=errors.usable))


@pytest.mark.parametrize("size", [12.0, -12.0])
def test_a_step_is_one_where_the_load_stays_and_none_where_it_explains_the_change(size: float) -> None:
    """Two levels of the expected force along z, between which fx changes by 30 % of that; and without the change."""
    n = 400
    expected = np.zeros((n, 6))
    expected[:, 2] = np.sign(size) * np.where(np.arange(n) // 50 % 2, 20.0, -20.0)
    residual = np.random.default_rng(2).normal(size=(n, 6)) * 0.1
    residual[:, 0] += 0.3 * expected[:, 2]
    errors = ModelErrors(residual=residual, expected=expected, usable=np.ones(n, dtype=bool))
    moved, stayed = (slice(130, 150), slice(150, 170)), (slice(102, 120), slice(120, 138))
    assert errors.explain_step(size, 0, *moved, LIMIT_N)
    assert not errors.explain_step(-size, 0, *moved, LIMIT_N)
    assert not errors.explain_step(size, 0, *stayed, LIMIT_N)


def test_a_drift_is_left_beside_the_load() -> None:
    """What follows the load is taken out, what grows with time stays but for what happens to follow the load."""
    errors = _errors()
    drift = np.linspace(-5.0, 5.0, len(errors.residual))
    residual = np.array(errors.residual)
    residual[:, 0] += drift
    beside = ModelErrors(residual=residual, expected=errors.expected, usable=errors.usable).beside_load()
    assert np.abs(beside[:, 0] - drift).mean() < 0.5
    assert np.abs(errors.beside_load()[:, 0]).max() < 1.0
