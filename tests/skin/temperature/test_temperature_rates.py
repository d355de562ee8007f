# SPDX-License-Identifier: BSD-3-Clause
"""A contact of 9.8 N held for sixteen minutes at ten degrees of heat, on a real layout: draws of taxels and objects.

`tests/skin/temperature_trials.py` prints what these tests hold.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest

from forcetorque.skin.simulation.objects_on_skin import SkinBody
from forcetorque.skin.simulation.temperature import Warmth
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from tests.skin.contact_trials import leg_layout
from tests.skin.temperature_trials import INSIDE, MINUTES, OUTSIDE, HeldContact, WarmPatch, share_within

pytestmark = [pytest.mark.real_data, pytest.mark.long]

DRAWS = 12
SEED = 101
"""Other draws than those that docs/skin/temperature.md tells of."""
Trials = Mapping[str, Sequence[HeldContact]]


@pytest.fixture(scope="module", name="draws")
def drawn_patches(data_dir: Path) -> list[WarmPatch]:
    """Patches with own taxels, gains learned in a warm-up, and an object each."""
    layout = leg_layout(data_dir)
    patch, body = SkinPatch.of(layout), SkinBody.of(layout)
    return [WarmPatch(patch, body, SEED + k) for k in range(DRAWS)]


def _told(draws: Sequence[WarmPatch], warmth: Warmth) -> Trials:
    by_draw = [draw.follow(warmth) for draw in draws]
    return {rule: [told[rule] for told in by_draw] for rule in by_draw[0]}


@pytest.fixture(scope="module", name="inside")
def heated_from_inside(draws: list[WarmPatch]) -> Trials:
    """By rule, while motors heat the patch."""
    return _told(draws, INSIDE)


@pytest.fixture(scope="module", name="outside")
def heated_from_outside(draws: list[WarmPatch]) -> Trials:
    """By rule, while the object heats it."""
    return _told(draws, OUTSIDE)


def _errors(trials: Sequence[HeldContact]) -> np.ndarray:
    assert len(trials) == DRAWS
    return np.array([trial.at(16)[0] for trial in trials])


def test_from_inside(inside: Trials) -> None:
    """At most 0.7 N, where the firmware's rule errs by more than the contact, and a high-pass by all of it."""
    assert _errors(inside["learned"]).mean() < 0.7
    assert _errors(inside["firmware"]).mean() > 10.0
    assert _errors(inside["none"]).mean() > 100.0
    true = np.array([trial.true_N for trial in inside["high-pass"]])
    np.testing.assert_allclose(_errors(inside["high-pass"]), true, atol=0.1)


def test_from_outside(outside: Trials) -> None:
    """No rule is much better than another: pads do not see it, and the error is that of the contact."""
    for rule in ("learned", "firmware", "high-pass"):
        assert 7.0 < _errors(outside[rule]).mean() < 13.0


@pytest.mark.parametrize("minutes", MINUTES)
def test_the_limit_contains_what_no_pad_tells(outside: Trials, minutes: int) -> None:
    """In at least 90 % of draws, from the first minute on; half of it would not be enough there."""
    trials = outside["learned"]
    assert share_within(trials, minutes) >= 0.9
    at = np.array([trial.at(1) for trial in trials])
    assert np.mean(at[:, 0] <= 0.5 * at[:, 1]) < 0.9
