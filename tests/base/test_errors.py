# SPDX-License-Identifier: BSD-3-Clause
"""What messages are made of."""

from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import known_names, quoted


@given(st.text())
def test_any_text_is_quoted_on_one_short_line(text: str) -> None:
    """Whatever a file holds, a message that quotes it stays one line; a short text is quoted whole."""
    shown = quoted(text)
    assert len(shown.splitlines()) == 1
    assert len(quoted("x" * len(text))) <= len("'...'") + 40
    assert len(text) > 40 or shown == repr(text)


@pytest.mark.parametrize(
    ("wanted", "known", "likely"),
    [
        ("torso_pitch", ("r_hip_pitch", "l_hip_pitch"), None),
        ("l_hip_pitch", ("r_hip_pitch", "r_hip_roll"), None),
        ("r_hip_pich", ("r_hip_yaw", "r_hip_pitch"), "r_hip_pitch"),
        ("arm_tf", ("arm_ft", "leg_ft"), "arm_ft"),
        ("l_leg", ("r_leg_ft", "l_leg_ft"), "l_leg_ft"),
        ("mini_45", ("mini40", "mini45"), "mini45"),
    ],
)
def test_only_a_name_of_the_same_words_is_suggested(wanted: str, known: tuple[str, ...], likely: str | None) -> None:
    """Another joint is none, however many letters both share; a misspelt word, or one word more, is the same name."""
    message = known_names(wanted, known)
    assert message.startswith("known: " if likely is None else f'did you mean "{likely}"? known: ')
