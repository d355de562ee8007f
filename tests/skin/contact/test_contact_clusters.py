# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of a frame: which taxels, where, what they do, and how far to trust it."""

from __future__ import annotations

from typing import Final

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError, SkinError
from forcetorque.skin.contact.contact_clusters import NO_CONTACT, clusters, find_contacts, lobes
from forcetorque.skin.contact.pressure_frame import PressureFrame
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.result import contact_rows
from tests.skin.layout.skins import PITCH_M, plane_layout

PLATE: Final = plane_layout(rows=20, columns=24)
PATCH: Final = SkinPatch.of(PLATE)
MIDDLE: Final = PLATE.positions.mean(axis=0)
EVERY: Final = np.ones(len(PLATE), dtype=bool)
HILL_M: Final = 0.009


def hill(place: FloatArray, height_Pa: float = 2e4) -> FloatArray:
    """Pressures of a hill that ends, so that what is far from it is exactly 0."""
    distance = np.linalg.norm(PLATE.positions - place, axis=1)
    return np.where(distance < 3.0 * HILL_M, height_Pa * np.exp(-0.5 * (distance / HILL_M) ** 2), 0.0)


def frame_of(pressures: FloatArray) -> PressureFrame:
    """A frame in which whatever is pressed is active."""
    return PressureFrame(pressures=pressures, active=pressures > 0.0)


def test_one_contact_is_told_whole() -> None:
    """Its wrench is that of the operator; its places are the hill's, its normal the plate's."""
    pressures = hill(MIDDLE)
    contacts = find_contacts(PATCH, frame_of(pressures))
    assert len(contacts) == 1
    np.testing.assert_allclose(contacts.wrench[0], PATCH.operator().wrench(pressures), rtol=1e-12)
    np.testing.assert_allclose(contacts.normal_force_N[0], contacts.force_N[0], rtol=1e-12)
    np.testing.assert_array_equal(contacts.taxels(0), np.flatnonzero(pressures))
    np.testing.assert_allclose(contacts.centre_of_pressure[0], MIDDLE, atol=0.1 * PITCH_M)
    np.testing.assert_allclose(contacts.centroid[0], MIDDLE, atol=0.1 * PITCH_M)
    np.testing.assert_allclose(contacts.normal[0], [0.0, 0.0, 1.0], atol=1e-12)
    np.testing.assert_allclose(contacts.area_m2[0], PATCH.operator().areas[pressures > 0.0].sum())
    assert contacts.peak_Pa[0] == pressures.max()
    assert contacts.edge_share[0] == 0.0
    assert not contacts.beyond_range[0]


def test_the_row_of_a_contact_is_in_its_units() -> None:
    """A row states mm2 and kPa of an area in m2 and a pressure in Pa; all else is as of the contact."""
    frame = frame_of(hill(MIDDLE))
    contacts = find_contacts(PATCH, frame)
    (row,) = contact_rows(PATCH, frame, contacts, 2.5)
    assert (row.time_s, row.contact, row.active, row.lobes) == (2.5, 1, np.count_nonzero(frame.active), 1)
    of_taxel_mm2 = np.sqrt(0.75) * (1e3 * PITCH_M) ** 2  # of a triangular lattice
    assert row.area_mm2 == pytest.approx(row.active * of_taxel_mm2, rel=0.01)
    assert row.peak_kPa == pytest.approx(frame.pressures.max() / 1000.0)
    for name, of_row in (
        ("centroid", row.centroid_m),
        ("centre_of_pressure", row.centre_of_pressure_m),
        ("wrench", row.wrench),
        ("force_N", row.force_N),
        ("normal_force_N", row.normal_force_N),
    ):
        np.testing.assert_array_equal(of_row, getattr(contacts, name)[0], err_msg=name)
    assert row.taxels == tuple(PLATE.taxels[np.flatnonzero(frame.active)].tolist())


def test_only_active_taxels_and_one_ring_count() -> None:
    """What the rest of the patch reads, rounding mostly, is not summed; what the ring reads is."""
    pressures = hill(MIDDLE)
    active = pressures > 0.0
    ring = PATCH.surface.with_ring(active)
    noise = np.random.default_rng(1).uniform(-300.0, 300.0, len(PLATE))
    quiet = find_contacts(PATCH, PressureFrame(pressures=np.where(ring, pressures + noise, pressures), active=active))
    noisy = find_contacts(PATCH, PressureFrame(pressures=pressures + noise, active=active))
    np.testing.assert_allclose(noisy.wrench, quiet.wrench, rtol=1e-12)
    assert not np.allclose(noisy.wrench, find_contacts(PATCH, frame_of(pressures)).wrench, rtol=1e-6)


def test_two_contacts_are_two() -> None:
    """Far apart each has its own wrench, and both together that of the sum."""
    away = np.array([6.0 * HILL_M, 0.0, 0.0])
    first, second = hill(MIDDLE - away / 1.5), hill(MIDDLE + away / 1.5, 1e4)
    contacts = find_contacts(PATCH, frame_of(first + second))
    assert len(contacts) == 2
    np.testing.assert_array_equal(contacts.identity, [1, 2])
    order = np.argsort(contacts.centroid[:, 0])
    for number, pressures in zip(order, (first, second), strict=True):
        np.testing.assert_allclose(contacts.wrench[number], PATCH.operator().wrench(pressures), rtol=1e-12)


def test_two_that_touch_stay_one_and_say_so() -> None:
    """Hills that run into each other are one contact with two lobes; a single hill has one."""
    away = np.array([3.5 * HILL_M, 0.0, 0.0])
    pressures = hill(MIDDLE - away / 2.0) + hill(MIDDLE + away / 2.0, 1.5e4)
    contacts = find_contacts(PATCH, frame_of(pressures))
    assert len(contacts) == 1
    np.testing.assert_array_equal(lobes(PATCH.surface, contacts, pressures), [2])
    alone = find_contacts(PATCH, frame_of(hill(MIDDLE)))
    np.testing.assert_array_equal(lobes(PATCH.surface, alone, hill(MIDDLE)), [1])


def test_a_taxel_of_the_ring_goes_to_the_nearest() -> None:
    """Between two rows of active taxels, one row apart from the ring: every taxel belongs to the row it is next to."""
    row = np.rint(PLATE.positions[:, 1] / PITCH_M / np.sqrt(0.75)).astype(int)
    active = (row == 5) | (row == 8)
    contact = clusters(PATCH.surface, active, EVERY)
    lower, upper = contact[row == 5][0], contact[row == 8][0]
    assert lower != upper
    inside = ~PATCH.at_edge  # along the edge every second row is a neighbour too
    assert (contact[inside & ((row == 4) | (row == 6))] == lower).all()
    assert (contact[inside & ((row == 7) | (row == 9))] == upper).all()
    assert (contact[inside & ((row < 4) | (row > 9))] == NO_CONTACT).all()


def test_a_single_taxel_is_no_contact() -> None:
    """One may be noise; a frame without any is none."""
    alone = np.zeros(len(PLATE))
    alone[100] = 1e4
    assert len(find_contacts(PATCH, frame_of(alone))) == 0
    last = np.arange(len(PLATE)) == 100
    assert len(find_contacts(PATCH, PressureFrame(pressures=alone, active=last, live=last))) == 0
    nothing = find_contacts(PATCH, frame_of(np.zeros(len(PLATE))))
    assert nothing.wrench.shape == (0, 6)
    assert lobes(PATCH.surface, nothing, np.zeros(len(PLATE))).shape == (0,)


def test_labels_reach_the_ends_of_a_long_contact() -> None:
    """A strip that winds over the patch is one contact, however its taxels are numbered."""
    row = np.rint(PLATE.positions[:, 1] / PITCH_M / np.sqrt(0.75)).astype(int)
    column = np.arange(len(PLATE)) % 24
    active = (row % 4 == 0) | ((column == 23) & (row % 8 < 4)) | ((column == 0) & (row % 8 >= 4))
    contact = clusters(PATCH.surface, active & (row < 17), EVERY)
    assert set(contact[active & (row < 17)]) == {0}


def test_dead_taxels_join_and_do_not_count() -> None:
    """A contact that a line of dead taxels crosses stays one, and loses little of its force."""
    pressures = hill(MIDDLE)
    live = np.abs(PLATE.positions[:, 0] - MIDDLE[0]) > 0.4 * PITCH_M
    read = np.where(live, pressures, np.nan)
    contacts = find_contacts(PATCH, PressureFrame(pressures=read, active=pressures > 0.0, live=live))
    whole = find_contacts(PATCH, frame_of(pressures))
    assert len(contacts) == 1
    assert not (contacts.active & ~live).any()
    np.testing.assert_allclose(contacts.force_N, whole.force_N, rtol=0.1)
    assert contacts.force_sd_N[0] > 1.2 * whole.force_sd_N[0]


def test_the_edge_and_the_range_are_flagged() -> None:
    """A contact at the corner has force at the edge; one taxel beyond its range is enough."""
    pressures = hill(PLATE.positions[0])
    beyond = pressures == pressures.max()
    contacts = find_contacts(PATCH, PressureFrame(pressures=pressures, active=pressures > 0.0, beyond_range=beyond))
    assert contacts.edge_share[0] > 0.3
    assert contacts.beyond_range[0]


def test_errors_of_pressures_become_those_of_the_wrench() -> None:
    """Noise of every taxel by itself: W diag(sd^2) W', on top of what is not known between taxels."""
    pressures = hill(MIDDLE)
    active = pressures > 0.0
    sd = np.full(len(PLATE), 500.0)
    without = find_contacts(PATCH, PressureFrame(pressures=pressures, active=active))
    with_noise = find_contacts(PATCH, PressureFrame(pressures=pressures, active=active, sd_Pa=sd))
    weights = PATCH.operator().weights[:, PATCH.surface.with_ring(active)]
    np.testing.assert_allclose(with_noise.covariance - without.covariance, [500.0**2 * weights @ weights.T], rtol=1e-9)
    assert 0.0 < without.force_sd_N[0] < with_noise.force_sd_N[0]
    # negative control: unknown for a method whose error no contact tells
    simple = SkinPatch.of(PLATE, "simple", taxel_area_m2=39e-6)
    assert np.isnan(find_contacts(simple, frame_of(pressures)).force_sd_N).all()


def test_hysteresis_stands_apart() -> None:
    """It errs all one way: it is summed as it is, and is not in the covariance."""
    pressures = hill(MIDDLE)
    lag = 0.05 * pressures
    plain = find_contacts(PATCH, frame_of(pressures))
    lagging = find_contacts(PATCH, PressureFrame(pressures=pressures, active=pressures > 0.0, hysteresis_Pa=lag))
    np.testing.assert_allclose(lagging.hysteresis_N, 0.05 * plain.force_N, rtol=1e-9)
    np.testing.assert_array_equal(lagging.covariance, plain.covariance)
    assert plain.hysteresis_N[0] == 0.0


def test_frames_of_another_patch_or_with_nonsense_are_refused() -> None:
    """Wrong lengths and numbers that are none; a dead taxel may say what it likes."""
    with pytest.raises(ShapeError, match="active"):
        PressureFrame(pressures=np.zeros(5), active=np.zeros(4, dtype=bool))
    with pytest.raises(ShapeError, match=r"frame.pressures: expected an array of shape \(480\)"):
        find_contacts(PATCH, PressureFrame(pressures=np.zeros(5), active=np.zeros(5, dtype=bool)))
    with pytest.raises(SkinError, match="at the 2th from 0"):
        PressureFrame(pressures=np.array([0.0, 1.0, np.nan]), active=np.zeros(3, dtype=bool))
    PressureFrame(pressures=np.array([0.0, np.nan]), active=np.zeros(2, dtype=bool), live=np.array([True, False]))


def test_the_covariance_is_that_of_noise_of_what_is_between_taxels_and_of_the_shape() -> None:
    """Of exact taxels: 30.3 % of what neighbours do not foretell, each by itself, and 3.1 % of the wrench at once."""
    pressures = hill(MIDDLE) * np.random.default_rng(3).uniform(0.2, 1.8, len(PLATE))
    (covariance,) = find_contacts(PATCH, frame_of(pressures)).covariance
    taxels = np.flatnonzero(PATCH.surface.with_ring(pressures > 0.0))
    between = 0.303 * PATCH.predicted_pressures(EVERY).residual(pressures, taxels)
    weights = PATCH.operator().weights[:, taxels]
    wrench = PATCH.operator().wrench(pressures)
    np.testing.assert_allclose(
        covariance, (weights * between**2) @ weights.T + 0.031**2 * np.outer(wrench, wrench), rtol=1e-9, atol=1e-18
    )
    # each part is seen
    assert 0.1 < 0.031**2 * wrench[2] ** 2 / covariance[2, 2] < 0.99


@pytest.mark.parametrize(
    ("beyond", "active", "flagged"), [(True, True, True), (True, False, False), (False, True, False)]
)
def test_one_taxel_beyond_its_range_flags_its_contact_alone(beyond: bool, active: bool, flagged: bool) -> None:
    """If it is active; of two contacts the other is none of it."""
    far = MIDDLE + [0.0, 0.035, 0.0]
    pressures = hill(MIDDLE) + hill(far)
    taxel = int(np.linalg.norm(PLATE.positions - far, axis=1).argmin())
    awake = pressures > 0.0
    awake[taxel] = active
    over = np.zeros(len(PLATE), dtype=bool)
    over[taxel] = beyond
    contacts = find_contacts(PATCH, PressureFrame(pressures=pressures, active=awake, beyond_range=over))
    if len(contacts) == 2:
        own = contacts.contact[taxel]
        assert contacts.beyond_range.tolist() == [flagged and number == own for number in range(2)]
    else:
        assert contacts.beyond_range.tolist() == [flagged]


@pytest.mark.parametrize(("saddle", "hills"), [(0.15, 2), (0.30, 2), (0.45, 2), (0.60, 2), (0.70, 1)])
def test_hills_are_two_where_the_pressure_between_falls_below_two_thirds(saddle: float, hills: int) -> None:
    """Of the peak; one that falls less far is one."""
    rows = np.round((PLATE.positions[:, 0] - MIDDLE[0]) / (0.5 * PITCH_M)).astype(int)
    across = np.abs(PLATE.positions[:, 1] - MIDDLE[1]) < 2.1 * PITCH_M
    near = np.abs(rows) <= 6
    height = np.where(np.abs(rows) <= 1, saddle, 1.0)
    pressures = np.where(across & near, 2e4 * height, 0.0)
    frame = frame_of(pressures)
    contacts = find_contacts(PATCH, frame)
    assert len(contacts) == 1
    assert lobes(PATCH.surface, contacts, frame.pressures).tolist() == [hills]
