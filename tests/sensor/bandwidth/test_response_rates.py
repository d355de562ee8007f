# SPDX-License-Identifier: BSD-3-Clause
"""Intervals of responses hold the truth, whatever excited the sensor, and what no force drives is refused."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.units import NORMAL_95
from forcetorque.sensor.bandwidth.driven_response import driven_response
from forcetorque.sensor.bandwidth.excited_records import EvenRecord, ExcitationKind, ExcitedRecord
from forcetorque.sensor.bandwidth.pooled_decays import Decays, free_decays
from forcetorque.sensor.bandwidth.second_order import SecondOrder, inverse_filter
from tests.scenes.excited_sensors import GRAVITY, MASS_KG, Spring, released, swung, tapped

DRAWS = 200
LEAST, MOST = 0.90, 0.98
FZ = 2


def excited(spring: Spring, force: FloatArray, reading: FloatArray, rng: np.random.Generator) -> ExcitedRecord:
    """A record in which the force acts along z."""
    wrench, applied = 0.05 * rng.normal(size=(len(reading), 6)), np.zeros((len(reading), 6))
    wrench[:, FZ], applied[:, FZ] = reading, force
    both = (EvenRecord(start_s=0.0, rate_hz=spring.rate_hz, signals=signals) for signals in (wrench, applied))
    return ExcitedRecord(name="simulated", wrench=next(both), force=next(both), highest_hz=np.inf)


def tap(seed: int) -> tuple[Spring, ExcitedRecord, Decays]:
    """Eight taps."""
    rng = np.random.default_rng(seed)
    spring = Spring.drawn(rng)
    _, force, reading = spring.read(rng, tapped(rng, spring))
    record = excited(spring, force, reading, rng)
    return spring, record, free_decays([record], ExcitationKind.IMPACT, FZ, weight_N=None)


def _share(held: list[FloatArray]) -> FloatArray:
    share: FloatArray = np.mean(held, axis=0)
    return share


def _holds(fit: SecondOrder, truth: FloatArray) -> FloatArray:
    return np.abs(np.array([fit.natural_frequency_hz, fit.damping, fit.gain]) - truth) < fit.half_width


@pytest.mark.long
def test_taps_hold_the_truth() -> None:
    """Free decays with and without a measured force, and the filter on a swing of forces that was not fitted."""
    free, driven, single, ratios = [], [], [], []
    for seed in range(7000, 7000 + DRAWS):
        spring, record, decays = tap(seed)
        pooled = (decays.frequency, decays.damping)
        free.append([abs(one.mean - true) < one.half_width for one, true in zip(pooled, spring.truth, strict=False)])
        single += [
            np.abs([one.frequency_hz, one.damping] - spring.truth[:2]) < NORMAL_95 * one.error
            for one in decays.ring_downs
        ]
        _, fit = driven_response([record], decays, ExcitationKind.IMPACT, FZ, None)
        driven.append(_holds(fit, spring.truth))
        ratios.append([held_out_ratio(spring, fit, seed, cut_off) for cut_off in (None, 1.5)])
    for share in (_share(free), _share(driven)):
        assert ((share >= LEAST) & (share <= MOST)).all(), share
    # of one decay: noise that the resonance colours is told less well by a quiet second than by all events
    assert (_share(single) > 0.8).all(), _share(single)
    # with the cut-off that is the default, and with a higher one
    assert (np.max(ratios, axis=0) < [0.75, 0.65]).all()


@pytest.mark.long
def test_released_weights_hold_the_truth() -> None:
    """Five releases of 2 kg, the gain by the weight alone."""
    held = []
    for seed in range(8000, 8000 + DRAWS):
        rng = np.random.default_rng(seed)
        spring = Spring.drawn(rng)
        _, force, reading = spring.read(rng, released(rng, spring))
        record = excited(spring, force, reading, rng)
        fit = free_decays([record], ExcitationKind.RELEASE, None, weight_N=MASS_KG * GRAVITY).second_order
        assert fit is not None
        held.append(_holds(fit, spring.truth))
    assert ((_share(held) >= LEAST) & (_share(held) <= MOST)).all(), _share(held)


@pytest.mark.long
def test_swings_hold_the_truth() -> None:
    """A mass that swings for two minutes on an arm that yields."""
    held = []
    for seed in range(9000, 9000 + DRAWS):
        rng = np.random.default_rng(seed)
        spring = Spring.drawn(rng, slow=True)
        _, force, reading = spring.read(rng, swung(rng, spring))
        record = excited(spring, force, reading, rng)
        _, fit = driven_response([record], None, ExcitationKind.PENDULUM, FZ, None)
        held.append(_holds(fit, spring.truth))
    assert ((_share(held) >= LEAST) & (_share(held) <= MOST)).all(), _share(held)


def held_out_ratio(spring: Spring, fit: SecondOrder, seed: int, share: float | None) -> float:
    """Error of a corrected reading over that of the reading, of other forces than were fitted.

    The cut-off is a share of the natural frequency, the default if None.
    """
    rng = np.random.default_rng(seed + 100_000)
    time = spring.instants(6.0)
    force = np.zeros(len(time))
    for _ in range(4):  # pushes of 50 to 200 ms, not taps
        start, length = rng.uniform(0.5, 5.0), rng.uniform(0.05, 0.2)
        phase = (time - start) / length
        force += np.where((phase > 0.0) & (phase < 1.0), rng.uniform(10.0, 40.0), 0.0)
    _, measured, reading = spring.read(rng, force)
    cut_off = None if share is None else share * fit.natural_frequency_hz
    correct = inverse_filter(fit, spring.rate_hz, cut_off_hz=cut_off, name="held out")
    quiet = reading[: round(0.4 * spring.rate_hz)].mean()
    with_filter = correct.apply(reading - quiet) - measured
    without = (reading - quiet) / fit.gain - measured
    return float(with_filter.std() / without.std())


@pytest.mark.long
def test_a_transfer_function_is_refused_at_known_rates() -> None:
    """A force that is not the one that acts is refused, and one that is measured well is not."""
    refused = {"measured": 0, "of another record": 0, "half of the power": 0}
    for seed in range(11000, 11000 + DRAWS):
        spring, record, decays = tap(seed)
        rng = np.random.default_rng(seed + 1)
        _, other, _ = spring.read(rng, tapped(rng, spring))
        n = min(len(other), len(record.wrench))
        wrench = record.wrench.signals[:n].copy()
        true = record.force.signals[:n, FZ] if record.force is not None else other
        swing = wrench[:, FZ] - np.median(wrench[:, FZ])
        half = wrench[:, FZ] + rng.permutation(swing)
        for name, force, reading in (
            ("measured", true, wrench[:, FZ]),
            ("of another record", other[:n], wrench[:, FZ]),
            ("half of the power", true, half),
        ):
            case = excited(spring, force, reading, rng)
            try:
                driven_response([case], decays, ExcitationKind.IMPACT, FZ, None)
            except FitError:
                refused[name] += 1
    assert refused["measured"] <= 0.01 * DRAWS
    assert refused["of another record"] >= 0.99 * DRAWS
    assert refused["half of the power"] >= 0.95 * DRAWS
