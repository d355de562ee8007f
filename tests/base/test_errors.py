# SPDX-License-Identifier: BSD-3-Clause
"""What messages are made of."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from forcetorque.base.errors import quoted


@given(st.text())
def test_any_text_is_quoted_on_one_short_line(text: str) -> None:
    """Whatever a file holds, a message that quotes it stays one line; a short text is quoted whole."""
    shown = quoted(text)
    assert len(shown.splitlines()) == 1
    assert len(quoted("x" * len(text))) <= len("'...'") + 40
    assert len(text) > 40 or shown == repr(text)
