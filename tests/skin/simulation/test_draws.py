# SPDX-License-Identifier: BSD-3-Clause
"""What is drawn at random for simulated skin has the ranges and deviations that its docstrings state."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.simulation import objects_on_skin as contact
from forcetorque.skin.simulation.objects_on_skin import ClothStrip, Palm, contacts
from forcetorque.skin.simulation.recordings import NOISE_COUNTS, REST_COUNTS, SWING_COUNTS, TaxelResponses
from forcetorque.skin.simulation.temperature import COUNTS_PER_K, SPREAD, HeatResponses
from forcetorque.skin.taxels.taxel_faults import TaxelFault
from tests.scenes.chambers import HIGHEST_PA, chamber, responses

COUNT = 4000
MEAN_RADIUS_M = 0.05
TAXELS = np.array([[0.1, 0.2], [0.3, -0.1], [-0.4, 0.0]])


def _body(press: Callable[[contact.SkinContact], Any] | None = None) -> Any:
    """Three taxels on a chart, far from each other."""
    surface = SimpleNamespace(mean_radius_m=MEAN_RADIUS_M, chart=lambda positions: TAXELS)
    return SimpleNamespace(surface=surface, layout=SimpleNamespace(positions=None, name="patch"), press=press)


def _drawn(draw: Callable[[Any, np.random.Generator], Any], read: Callable[[Any], Any]) -> FloatArray:
    rng = np.random.default_rng(51)
    return np.array([read(draw(_body(), rng)) for _ in range(COUNT)])


def _taxels() -> TaxelResponses:
    return TaxelResponses.drawn(COUNT, np.random.default_rng(52))


def _heat() -> HeatResponses:
    layout: Any = SimpleNamespace(__len__=lambda self: COUNT, thermal_pads=np.arange(COUNT))
    return HeatResponses.drawn(_Sized(layout.thermal_pads), np.random.default_rng(53))  # type: ignore[arg-type]


class _Sized:
    """A layout of as many taxels as pads."""

    def __init__(self, thermal_pads: FloatArray) -> None:
        self.thermal_pads = thermal_pads

    def __len__(self) -> int:
        return len(self.thermal_pads)


def _placed() -> list[contact.SkinContact]:
    """Contacts of a body on which each has room."""
    on_skin = SimpleNamespace
    truths = contacts(
        _body(lambda one: on_skin(on_skin=1.0, contact=one)), np.random.default_rng(54), COUNT, on_skin=0.96
    )
    return [one.contact for one in truths]


PLACED = _placed()


def _beside() -> FloatArray:
    places = np.array([one.place for one in PLACED])
    return (places - TAXELS[np.linalg.norm(places[:, None] - TAXELS, axis=2).argmin(axis=1)]).ravel()


UNIFORM: dict[str, tuple[Callable[[], FloatArray], float, float]] = {
    "rest of a taxel": (lambda: _taxels().rest - REST_COUNTS, -0.5, 0.5),
    "bend of a taxel": (lambda: _taxels().bend, 0.0, 0.5),
    "hysteresis of a taxel": (lambda: _taxels().hysteresis, 0.02, 0.07),
    "rest of a pad": (lambda: _heat().pad_rest - REST_COUNTS, -0.5, 0.5),
    "radius of a weight": (lambda: _drawn(contact._flat_weight, lambda one: one.radius_m), 0.015, 0.035),
    "radius of a ball": (lambda: _drawn(contact._sphere, lambda one: one.radius_m), 0.04, 0.12),
    "length of a palm": (lambda: _drawn(contact._palm, lambda one: one.half_lengths_m[0]), 0.03, 0.045),
    "breadth of a palm": (lambda: _drawn(contact._palm, lambda one: one.half_lengths_m[1]), 0.025, 0.035),
    "bend of a palm": (lambda: _drawn(contact._palm, lambda one: one.bend_per_m * MEAN_RADIUS_M), 0.7, 0.95),
    "bulges along a palm": (
        lambda: _drawn(contact._palm, lambda one: one.bulges[:, 0] / one.half_lengths_m[0]).ravel(),
        -1.0,
        1.0,
    ),
    "bulges across a palm": (
        lambda: _drawn(contact._palm, lambda one: one.bulges[:, 1] / one.half_lengths_m[1]).ravel(),
        -1.0,
        1.0,
    ),
    "depth of bulges": (lambda: _drawn(contact._palm, lambda one: one.bulges[:, 2]).ravel(), 0.0, 0.001),
    "width of bulges": (lambda: _drawn(contact._palm, lambda one: one.bulges[:, 3]).ravel(), 0.012, 0.02),
    "width of cloth": (lambda: _drawn(contact._cloth_strip, lambda one: one.width_m), 0.015, 0.03),
    "arc of cloth": (
        lambda: np.degrees(_drawn(contact._cloth_strip, lambda one: one.arc_m) / MEAN_RADIUS_M),
        50.0,
        110.0,
    ),
    "place beside a taxel": (_beside, -0.005, 0.005),
    "turn of what is no hand": (
        lambda: np.array([one.spin for one in PLACED if not isinstance(one.thing, Palm)]),
        0.0,
        2.0 * np.pi,
    ),
    "logarithm of a mass": (
        lambda: np.log([one.mass_kg for one in PLACED if not isinstance(one.thing, ClothStrip)]),
        np.log(0.2),
        np.log(3.0),
    ),
    "logarithm of the mass on cloth": (
        lambda: np.log([one.mass_kg for one in PLACED if isinstance(one.thing, ClothStrip)]),
        0.0,
        np.log(3.0),
    ),
}
NORMAL: dict[str, tuple[Callable[[], FloatArray], float, float]] = {
    "logarithm of the swing of a taxel": (lambda: np.log(_taxels().swing), np.log(SWING_COUNTS), 0.15),
    "fall of a taxel by heat": (lambda: _heat().taxels / COUNTS_PER_K, 1.0, SPREAD),
    "fall of a pad by heat": (lambda: _heat().pads / COUNTS_PER_K, 1.0, SPREAD),
    "tilt of a weight": (lambda: _drawn(contact._flat_weight, lambda one: one.tilt).ravel(), 0.0, 0.02),
    "turn of a hand": (lambda: np.array([one.spin for one in PLACED if isinstance(one.thing, Palm)]), 0.0, 0.2),
}


@pytest.mark.parametrize("name", UNIFORM)
def test_what_is_drawn_evenly_fills_its_range(name: str) -> None:
    """None of a thousand or more lies outside; the outermost are within 2 % of the ends, as in all but 1e-8 of runs."""
    draw, low, high = UNIFORM[name]
    values = draw()
    assert len(values) >= 1000
    assert low <= values.min() < low + 0.02 * (high - low)
    assert high - 0.02 * (high - low) < values.max() <= high
    assert values.mean() == pytest.approx(0.5 * (low + high), abs=0.05 * (high - low))


@pytest.mark.parametrize("name", NORMAL)
def test_what_is_drawn_about_a_mean_has_its_deviation(name: str) -> None:
    """Of a thousand or more, mean and deviation within three and a half of their standard errors."""
    draw, mean, deviation = NORMAL[name]
    values = draw()
    assert len(values) >= 1000
    assert values.mean() == pytest.approx(mean, abs=3.5 * deviation / np.sqrt(len(values)))
    assert values.std() == pytest.approx(deviation, rel=3.5 / np.sqrt(2.0 * len(values)))


def test_noise_of_taxels_and_of_the_gauge_is_the_stated_one() -> None:
    """0.65 counts each, and 20 Pa of the pressure that is recorded beside them."""
    np.testing.assert_array_equal(_taxels().noise, NOISE_COUNTS)
    gauge = chamber(responses(), 5).stream("chamber").signal("pressure").values[:, 0]
    second = np.diff(gauge, n=2)  # of a ramp nothing is left
    assert second[5:].std() == pytest.approx(20.0 * np.sqrt(6.0), rel=0.1)


def _sent(fault: TaxelFault | None) -> tuple[FloatArray, FloatArray]:
    """What a taxel sends, and the pressure over its peak."""
    recording = chamber(responses(), 5, broken={} if fault is None else {3: fault})
    gauge = recording.stream("chamber").signal("pressure").values[:, 0]
    return recording.stream("counts").signal("taxel_counts").values[:, 3], gauge / HIGHEST_PA


def test_broken_taxels_send_what_their_fault_says() -> None:
    """By its size: 300 counts of fall wrap, 255 at a rail, five jumps of 60, a rise by 10, a noise of 6 counts."""
    sound, share = _sent(None)
    rest = sound[share < 0.01].mean()
    wraps, peak = _sent(TaxelFault.WRAPS)[0], share.argmax()
    assert np.median(wraps[peak - 3 : peak + 4]) == pytest.approx((rest - 300.0) % 256.0, abs=6.0)
    rails = _sent(TaxelFault.RAILS)[0]
    assert (rails[share > 0.51] == 255.0).all()
    np.testing.assert_allclose(rails[share < 0.49], rest, atol=2.0)
    jumps = _sent(TaxelFault.JUMPS)[0] - sound
    assert np.count_nonzero(jumps) == 5
    np.testing.assert_allclose(jumps[jumps != 0.0], -60.0, atol=1.0)
    rises = _sent(TaxelFault.RISES)[0]
    assert np.polyfit(share, rises, 1)[0] == pytest.approx(10.0, rel=0.02)
    noisy = _sent(TaxelFault.NOISE)[0] - sound
    assert noisy.std() == pytest.approx(6.0, rel=0.1)
