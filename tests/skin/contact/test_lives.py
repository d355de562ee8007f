# SPDX-License-Identifier: BSD-3-Clause
"""Contacts keep their numbers while they slide, cross, pause, merge and split."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.skin.contact.contact_tracking import PAUSE_S, REACH_M, ContactLives

PITCH_M = 0.0065
SIZE = 40
"""Taxels along and across a flat patch."""
PERIOD_S = 0.1

Disc = tuple[float, float]
"""Middle of a disc of pressed taxels; in taxels."""


def _frame(*contacts: list[Disc], radius: float = 2.0) -> tuple[FloatArray, BoolArray]:
    """Places and taxels of contacts, of which each may be several discs that touch."""
    across, along = np.meshgrid(np.arange(SIZE), np.arange(SIZE), indexing="ij")
    masks = [
        np.logical_or.reduce([(across - x) ** 2 + (along - y) ** 2 <= radius**2 for x, y in discs]).ravel()
        for discs in contacts
    ]
    grid = PITCH_M * np.stack([across.ravel(), along.ravel(), np.zeros(SIZE**2)], axis=1)
    places = np.array([grid[mask].mean(axis=0) for mask in masks]).reshape(-1, 3)
    return places, np.array(masks, dtype=np.bool_).reshape(-1, SIZE**2)


class Course:
    """Frames one after the other."""

    def __init__(self) -> None:
        self.lives = ContactLives()
        self.seconds = 0.0

    def add(self, *contacts: list[Disc], passed_s: float = PERIOD_S) -> list[int]:
        """Add a frame and give the numbers of its contacts."""
        self.seconds += passed_s
        return self.lives.follow(self.seconds, *_frame(*contacts)).tolist()


def test_contacts_that_pass_each_other_keep_their_numbers() -> None:
    """In whatever order a frame lists them: two that slide past each other, with a taxel between their edges."""
    course, rng, exchanged = Course(), np.random.default_rng(1), 0
    for step in range(30):
        right, left = [(5.0 + step, 12.0)], [(34.0 - step, 17.0)]
        swapped = bool(rng.integers(2)) and step > 0
        exchanged += swapped
        numbers = course.add(*([left, right] if swapped else [right, left]))
        assert numbers == ([2, 1] if swapped else [1, 2])
    assert len(course.lives.lives) == 2
    # negative control: by their place in the frame alone they would have been exchanged
    assert exchanged > 5


def test_a_quick_contact_is_followed_by_its_place() -> None:
    """Three taxels in a frame, more than it is wide; a jump beyond the reach is another contact."""
    course = Course()
    numbers = [course.lives.follow(0.1 * k, *_frame([(5.0 + 2.9 * k, 9.0)], radius=1.0)).tolist() for k in range(8)]
    assert numbers == [[1]] * 8
    far = 5.0 + 2.9 * 7 + 1.5 * REACH_M / PITCH_M
    assert course.lives.follow(0.8, *_frame([(far, 9.0)], radius=1.0)).tolist() == [2]


def test_contacts_merge_and_split() -> None:
    """The larger share goes on under its number; what comes off later is a new contact."""
    course = Course()
    assert course.add([(10.0, 10.0), (12.0, 10.0)], [(18.0, 10.0)]) == [1, 2]
    assert course.add([(10.0, 10.0), (12.0, 10.0), (15.0, 10.0), (18.0, 10.0)]) == [1]
    assert course.add([(10.0, 10.0), (12.0, 10.0), (15.0, 10.0)]) == [1]
    assert course.add([(10.0, 10.0), (12.0, 10.0)], [(16.0, 10.0)]) == [1, 3]
    first, second, third = course.lives.lives
    assert (first.split_from, first.merged_into) == (None, None)
    assert (second.merged_into, second.seen_s) == (1, pytest.approx(PERIOD_S))
    assert (third.split_from, third.begun_s) == (1, pytest.approx(4 * PERIOD_S))


def test_contacts_that_cross_through_each_other_are_said_to_have_merged() -> None:
    """Nobody can tell which of both comes out on which side: one goes on, the other is new and split from it."""
    course = Course()
    for step in range(21):
        one, other = (10.0 + step, 10.0), (30.0 - step, 10.0)
        apart = abs(one[0] - other[0]) > 5.0
        course.add(*([[one], [other]] if apart else [[one, other]]))
    first, second, third = course.lives.lives
    assert {first.merged_into, second.merged_into} == {None, (1 if first.merged_into is None else 2)}
    assert third.split_from == (1 if first.merged_into is None else 2)


def test_a_pause_is_bridged_and_a_longer_one_is_not() -> None:
    """A faint contact may be missed in single frames."""
    course = Course()
    assert course.add([(10.0, 10.0)]) == [1]
    assert course.add() == []
    assert course.add([(10.0, 10.0)]) == [1]
    assert course.add([(10.0, 10.0)], passed_s=1.1 * PAUSE_S) == [2]
    assert [life.split_from for life in course.lives.lives] == [None, None]


def test_without_taxels_places_are_enough() -> None:
    """As of contacts that a skinManager sends."""
    lives, none = ContactLives(), np.zeros((2, 0), dtype=np.bool_)
    first = np.array([[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]])
    assert lives.follow(0.0, first, none).tolist() == [1, 2]
    assert lives.follow(0.02, first[::-1] + 0.004, none).tolist() == [2, 1]
    assert lives.follow(0.04, np.zeros((0, 3)), none[:0]).tolist() == []
