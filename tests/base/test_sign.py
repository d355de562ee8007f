# SPDX-License-Identifier: BSD-3-Clause
"""The sign rule, by hand."""

from __future__ import annotations

import pytest

from forcetorque.base.wrench import MeasureDirection, reading_sign

BY_HAND = {
    # S is what the inboard part exerts on the outboard part
    (MeasureDirection.CHILD_TO_PARENT, True): -1.0,  # outboard acts on inboard
    (MeasureDirection.PARENT_TO_CHILD, True): +1.0,  # inboard acts on outboard
    (MeasureDirection.CHILD_TO_PARENT, False): +1.0,  # the child is inboard and acts on the outboard parent
    (MeasureDirection.PARENT_TO_CHILD, False): -1.0,  # the parent is outboard and acts on the inboard child
}


@pytest.mark.parametrize(("direction", "child_is_outboard"), BY_HAND)
def test_sign_by_hand(direction: MeasureDirection, child_is_outboard: bool) -> None:
    """Each of the four combinations has the sign that who acts on whom demands."""
    assert reading_sign(direction, child_is_outboard=child_is_outboard) == BY_HAND[direction, child_is_outboard]


def test_each_choice_flips_the_sign() -> None:
    """Negative control: neither the direction nor the side is ignored."""
    assert len(BY_HAND) == 4
    for outboard in (True, False):
        signs = {reading_sign(direction, child_is_outboard=outboard) for direction in MeasureDirection}
        assert signs == {1.0, -1.0}


@pytest.mark.parametrize("direction", list(MeasureDirection))
def test_the_bare_word_means_the_same(direction: MeasureDirection) -> None:
    """A direction given as text is never silently read as the other one."""
    word: MeasureDirection = direction.value  # type: ignore[assignment]
    assert reading_sign(word, child_is_outboard=True) == BY_HAND[direction, True]


def test_an_unknown_word_is_refused() -> None:
    """A misspelt direction has no sign."""
    word: MeasureDirection = "parent-to-child"  # type: ignore[assignment]
    with pytest.raises(ValueError, match="'parent-to-child' is not a valid MeasureDirection"):
        reading_sign(word, child_is_outboard=True)
