# SPDX-License-Identifier: BSD-3-Clause
"""Objects on a simulated skin: they are carried, the truth does not depend on its grid, and taxels answer as stated."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, Final

import numpy as np
import pytest

from forcetorque.base.errors import ShapeError, SkinError
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.objects_on_skin import (
    ClothStrip,
    FlatWeight,
    Palm,
    SkinBody,
    SkinContact,
    SkinObject,
    Sphere,
    _disc,
    _rigid,
    contacts,
)
from forcetorque.skin.simulation.recordings import REFERENCE_PA, REST_COUNTS, Loading, TaxelResponses, contact_recording
from forcetorque.skin.simulation.temperature import HeatResponses, MotorHeat
from forcetorque.skin.simulation.true_surface import SurfacePoints, TrueSurface
from tests.scenes.patches import cylinder_patch

RADIUS_M: Final = 0.06
LEG: Final = cylinder_patch(across=9, along=6, radius_m=RADIUS_M).layout()


@pytest.fixture(scope="module", name="leg")
def made_leg() -> SkinBody:
    """A cylinder with real modules on it."""
    return SkinBody.of(LEG)


def test_the_surface_is_the_cylinder(leg: SkinBody) -> None:
    """Its radius to a third of a millimetre, normals to three degrees, area by its radius."""
    middle = leg.surface.at(leg.surface.chart(LEG.positions))
    np.testing.assert_allclose(np.hypot(*middle.positions[:, :2].T), RADIUS_M, atol=1e-3)
    assert ((middle.normals * LEG.normals).sum(axis=1) > np.cos(np.radians(4.0))).all()
    np.testing.assert_allclose(middle.stretch, 1.0, atol=0.03)


def test_points_of_a_disc_cover_it_evenly() -> None:
    """Their centre and second moments are those of the disc, and none lies outside."""
    points = _disc(0.03)
    assert np.hypot(*points.T).max() < 0.03
    np.testing.assert_allclose(points.mean(axis=0), 0.0, atol=1e-12)
    np.testing.assert_allclose(points.T @ points / len(points), 0.03**2 / 4.0 * np.eye(2), atol=0.01 * 0.03**2 / 4.0)


def test_a_palm_bends_as_a_cylinder_does() -> None:
    """Across by the circle of its curvature, to second order; bulges are as deep as stated; beside it is nothing."""
    curvature, across = 12.0, np.linspace(-0.01, 0.01, 9)
    palm = Palm(half_lengths_m=(0.05, 0.03), bend_per_m=curvature, bulges=np.zeros((0, 4)))
    circle = (np.sqrt(1.0 - (curvature * across) ** 2) - 1.0) / curvature
    np.testing.assert_allclose(palm.height(np.full(9, 0.01), across), circle, atol=0.01 * np.abs(circle).max())
    bulged = Palm(half_lengths_m=(0.05, 0.03), bend_per_m=curvature, bulges=np.array([[0.01, 0.005, 0.002, 0.004]]))
    at_bulge = np.array([0.01, 0.014]), np.array([0.005, 0.005])
    np.testing.assert_allclose(palm.height(*at_bulge) - bulged.height(*at_bulge), 0.002 * np.exp([0.0, -0.5]))
    assert np.isinf(palm.height(np.array([0.051, 0.0]), np.array([0.0, 0.031]))).all()


def test_a_cloth_strip_presses_on_its_area() -> None:
    """Its pressure over all that it reaches comes to width times length, since it falls off evenly at its sides."""
    strip = ClothStrip(width_m=0.02, arc_m=0.06, hem_m=0.004)
    step = 1e-4
    place = np.arange(-strip.reach_m, strip.reach_m, step) + 0.5 * step
    along, across = np.meshgrid(place, place)
    pressure = strip.pressure(along, across)
    np.testing.assert_allclose(pressure.sum() * step**2, 0.02 * 0.06, rtol=1e-3)
    assert pressure.max() == 1.0
    np.testing.assert_array_equal(pressure[np.abs(along) > 0.012], 0.0)


def test_a_patch_that_folds_back_has_no_such_surface() -> None:
    """Normals that point at the axis."""
    inside = SkinLayout(
        name="inside",
        frame="link",
        columns=LEG.columns,
        taxels=LEG.taxels,
        modules=LEG.modules,
        positions=LEG.positions,
        normals=np.where(np.arange(len(LEG))[:, None] < 5, -LEG.normals, LEG.normals),
        thermal_pads=LEG.thermal_pads,
        thermal_modules=LEG.thermal_modules,
    )
    with pytest.raises(SkinError, match="normals that turn back"):
        TrueSurface.through(inside)


@pytest.mark.parametrize(
    "thing",
    [
        FlatWeight(radius_m=0.02, tilt=(0.01, 0.0)),
        Sphere(radius_m=0.06),
        ClothStrip(width_m=0.02, arc_m=0.06, hem_m=0.003),
    ],
    ids=lambda thing: thing.kind,
)
def test_the_skin_carries_the_object(leg: SkinBody, thing: SkinObject) -> None:
    """Along the normal where it touches the wrench is its weight; the moment is that of a force through its centre."""
    place = leg.surface.chart(LEG.positions).mean(axis=0)
    truth = leg.press(SkinContact(thing=thing, mass_kg=1.0, place=place, spin=0.3))
    touch = leg.surface.at(place)
    np.testing.assert_allclose(truth.wrench[:3] @ touch.normals, -truth.load_N, rtol=1e-6)
    assert truth.normal_force_N > np.linalg.norm(truth.wrench[:3])
    moment = np.cross(truth.centre, truth.wrench[:3])
    np.testing.assert_allclose(truth.wrench[3:], moment, atol=0.02 * truth.load_N * RADIUS_M)
    assert truth.on_skin > 0.9  # corners of modules leave bare spots


@pytest.mark.parametrize("spin", [0.0, 0.5, 2.0, -1.0])
def test_an_object_is_turned_right_handed_about_the_normal(leg: SkinBody, spin: float) -> None:
    """The centre of pressure follows what stands out of its lower side; at spin 0 it lies along the limb, then across.

    Within a tenth of a radian for a bulge of a palm; the cylinder turns that of a tilted weight towards its own axis.
    """
    place = leg.surface.chart(LEG.positions).mean(axis=0)
    touch, axis = leg.surface.at(place), leg.surface.link_R_axis[:, 2]
    along = axis - touch.normals * (axis @ touch.normals)
    tangents = np.stack([along, np.cross(touch.normals, along)])

    def pressed(thing: SkinObject) -> np.ndarray:
        truth = leg.press(SkinContact(thing=thing, mass_kg=0.3, place=place, spin=spin))
        return tangents @ (truth.centre - touch.positions)

    bulge = pressed(Palm(half_lengths_m=(0.03, 0.03), bend_per_m=0.0, bulges=np.array([[0.01, 0.0, 0.006, 0.004]])))
    assert np.arctan2(bulge[1], bulge[0]) == pytest.approx(spin, abs=0.1)
    assert 0.004 < np.hypot(*bulge) < 0.01
    ends = np.array([[np.cos(spin), np.sin(spin)], [-np.sin(spin), np.cos(spin)]])
    for tilt, end in zip(((-0.1, 0.0), (0.0, -0.1)), ends, strict=True):
        assert pressed(FlatWeight(radius_m=0.02, tilt=tilt)) @ end > 0.002


def test_an_object_sees_the_skin_in_axes_of_its_own() -> None:
    """Where the normal leans to the axis, as on a cone, they are at right angles and of length 1.

    So distances stay, height is along the normal, and what faces away, or sideways, is not touched.
    """
    rng = np.random.default_rng(61)
    normal = np.array([0.6, 0.0, 0.8])
    touch = SurfacePoints(positions=np.array([0.1, 0.2, 0.3]), normals=normal, stretch=np.ones(()))
    cone: Any = SimpleNamespace(at=lambda place: touch, link_R_axis=np.eye(3))
    seen: list[np.ndarray] = []
    body: Any = SimpleNamespace(height=lambda along, across: seen.append(np.stack([along, across])) or 0.25 * along)
    offset = rng.normal(size=(20, 3))
    normals = np.where(np.arange(20)[:, None] < 18, normal, [[0.8, 0.0, -0.6]])
    normals[17] = -normal
    points = SurfacePoints(positions=touch.positions + offset, normals=normals, stretch=np.ones(20))
    contact = SkinContact(thing=body, mass_kg=1.0, place=np.zeros(2), spin=0.7)
    above = _rigid(cone, contact, body)(np.zeros((20, 2)), points)
    (place,) = seen
    height = offset @ normal
    np.testing.assert_allclose((place**2).sum(axis=0) + height**2, (offset**2).sum(axis=1))
    np.testing.assert_allclose(above[:17], (height - 0.25 * place[0])[:17])
    assert (above[17:] == -np.inf).all()


def test_a_ball_presses_as_hertz_would_on_springs(leg: SkinBody) -> None:
    """Springs under a paraboloid of radii a and b: depth d carries pi k sqrt(a b) d^2, and the peak is k d."""
    place = leg.surface.chart(LEG.positions).mean(axis=0)
    ball = Sphere(radius_m=0.06)
    truth = leg.press(SkinContact(thing=ball, mass_kg=0.5, place=place, spin=0.0))
    along, across = ball.radius_m, 1.0 / (1.0 / ball.radius_m + 1.0 / RADIUS_M)
    depth = np.sqrt(truth.load_N / (np.pi * ball.stiffness * np.sqrt(along * across)))
    np.testing.assert_allclose(truth.peak_Pa, ball.stiffness * depth, rtol=0.15)  # the surface is not quite a cylinder


@pytest.mark.long
def test_contacts_are_drawn_alike_for_one_seed(leg: SkinBody) -> None:
    """All four kinds, from 0.2 to 3 kg, on the skin; another seed draws others."""
    drawn = [list(contacts(leg, np.random.default_rng(seed), 8)) for seed in (3, 3, 4)]
    assert {one.contact.thing.kind for one in drawn[0]} == {"flat weight", "sphere", "palm", "cloth strip"}
    for one, same, other in zip(*drawn, strict=True):
        np.testing.assert_array_equal(one.pressures, same.pressures)
        assert not np.array_equal(one.wrench, other.wrench)
        assert 0.2 <= one.contact.mass_kg <= 3.0
        assert one.on_skin >= 0.96


def test_where_there_is_no_room_nothing_is_drawn(leg: SkinBody, monkeypatch: pytest.MonkeyPatch) -> None:
    """More than the whole force cannot be on the skin."""
    monkeypatch.setattr("forcetorque.skin.simulation.objects_on_skin._MOST_TRIES", 3)
    with pytest.raises(SkinError, match="expected room for a flat weight"):
        next(contacts(leg, np.random.default_rng(1), 1, on_skin=1.5))


def test_taxels_answer_as_stated() -> None:
    """Without load they rest, at the reference they fall by their swing, and they lag when pressure goes."""
    rng = np.random.default_rng(5)
    taxels = TaxelResponses.drawn(2000, rng)
    reference = np.full(2000, REFERENCE_PA)
    np.testing.assert_allclose(taxels.fall(reference), taxels.swing)
    assert np.all(np.diff([taxels.fall(np.full(2000, p)) for p in np.linspace(0.0, REFERENCE_PA, 20)], axis=0) > 0.0)
    half = taxels.fall(0.5 * reference, peak=reference) - taxels.fall(0.5 * reference)
    np.testing.assert_allclose(half, taxels.hysteresis * taxels.swing, rtol=1e-9)
    np.testing.assert_allclose(taxels.fall(0.0 * reference, peak=reference), 0.0, atol=1e-9)
    counts = taxels.counts(np.zeros(2000), rng, frames=50)
    assert counts.dtype == np.int64
    np.testing.assert_allclose(counts.mean(), REST_COUNTS, atol=0.05)
    np.testing.assert_allclose((counts - counts.mean(axis=0)).std(), np.hypot(0.65, 1 / np.sqrt(12)), rtol=0.03)
    assert taxels.counts(np.full(2000, 1e9), rng, frames=1).min() >= 0


def test_taxels_lag_while_an_object_is_taken_off_and_not_while_it_is_put_on(leg: SkinBody) -> None:
    """At the same share of its weight; of exact taxels with a large hysteresis, two ramps of one object."""
    drawn = TaxelResponses.drawn(len(LEG), np.random.default_rng(6))
    taxels = replace(drawn, noise=np.zeros(len(LEG)), hysteresis=np.full(len(LEG), 0.3))
    (truth,) = contacts(leg, np.random.default_rng(7), 1)
    loading = Loading(rest_s=0.5, ramp_s=0.4, hold_s=0.5)
    recording = contact_recording(LEG, taxels, [truth], np.random.default_rng(8), loading=loading)
    counts = recording.stream("counts").signal("taxel_counts").values[:, LEG.taxels]
    seconds, shares = loading.shares(1)
    peak = int(truth.pressures.argmax())
    middle = loading.rest_s + loading.ramp_s + 0.5 * loading.hold_s
    ramps = (seconds < middle, seconds > middle)
    seen = 0
    for row in np.flatnonzero((shares[:, 0] > 0.0) & (shares[:, 0] < 1.0)):
        now = shares[row, 0] * truth.pressures
        expected = taxels.rest - taxels.fall(now, truth.pressures if ramps[1][row] else now)
        np.testing.assert_allclose(counts[row], np.clip(expected, 0.0, 255.0), atol=0.5 + 1e-9)  # whole counts
        seen += 1
    assert seen > 10
    on, off = (counts[ramp & (np.abs(shares[:, 0] - 0.5) < 0.2), peak].mean() for ramp in ramps)
    assert on > off + 2.0


def test_motors_warm_taxels_and_pads_while_objects_rest(leg: SkinBody) -> None:
    """Mean readings fall by the rise times each answer, beside the pressure; without heat pads stay as they are."""
    rng = np.random.default_rng(4)
    taxels, heat = TaxelResponses.drawn(len(LEG), rng), HeatResponses.drawn(LEG, rng)
    truths, loading = list(contacts(leg, rng, 1)), Loading(rest_s=1.0, ramp_s=0.2, hold_s=1.0)
    seconds, _ = loading.shares(1)
    warm = MotorHeat(responses=heat, rise_K=np.full(len(seconds), 5.0))
    cold, hot = (
        contact_recording(LEG, taxels, truths, np.random.default_rng(5), loading=loading, heat=one)
        .stream("counts")
        .signal("taxel_counts")
        .values
        for one in (None, warm)
    )
    fall = (cold - hot).mean(axis=0)
    np.testing.assert_allclose(fall[LEG.taxels], 5.0 * heat.taxels, atol=0.5)
    np.testing.assert_allclose(hot[:, LEG.thermal_pads].mean(axis=0), heat.pad_rest - 5.0 * heat.pads, atol=0.5)
    assert (cold[:, LEG.thermal_pads] == REST_COUNTS).all()
    short = MotorHeat(responses=heat, rise_K=np.zeros(3))
    with pytest.raises(ShapeError, match="rise_K: expected one for each of .* messages, got 3"):
        contact_recording(LEG, taxels, truths, rng, loading=loading, heat=short)
