# SPDX-License-Identifier: BSD-3-Clause
"""The text of YARP messages becomes numbers, words, vocabs and nested lists."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, strategies as st

from forcetorque.base.errors import FormatError
from forcetorque.formats.yarp.message import Vocab, leaves, parse_bottle, quote

_VALUES: st.SearchStrategy[Any] = st.recursive(
    st.one_of(
        st.integers(-(10**18) + 1, 10**18 - 1),
        st.floats(allow_nan=False, allow_infinity=False),
        st.sampled_from(["nan", "inf", "word", "a b", 'with "quotes"', "back\\slash", "", "(", "[ok]"]),
        st.sampled_from([Vocab("ok"), Vocab("fail")]),
    ),
    lambda inner: st.lists(inner, max_size=4).map(tuple),
    max_leaves=12,
)


def _render(value: Any) -> str:
    if isinstance(value, tuple):
        return "(" + " ".join(map(_render, value)) + ")"
    if isinstance(value, Vocab):
        return f"[{value.text}]"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value)


def test_every_kind_of_element_by_hand() -> None:
    """Numbers keep their kind, words and strings are texts, lists nest and may be empty."""
    text = '12 -3.5 1e-05 word "two words" [ok] () (1.0 (2 [fail])) nan'
    expected = (12, -3.5, 1e-05, "word", "two words", Vocab("ok"), (), (1.0, (2, Vocab("fail"))), "nan")
    parsed = parse_bottle(text)
    assert parsed == expected
    assert [type(value) for value in parsed] == [type(value) for value in expected]


@given(st.lists(_VALUES, max_size=6).map(tuple))
def test_parsing_undoes_rendering(bottle: tuple[Any, ...]) -> None:
    """A message written in YARP's way is read back as it was."""
    assert parse_bottle(" ".join(map(_render, bottle))) == bottle


@pytest.mark.parametrize("text", ["1-2", "--1", "1e", "e5", ".", "-", "1.2.3", "nan", "-inf", "0x10", "1_0", "1,5"])
def test_what_only_resembles_a_number_is_a_word(text: str) -> None:
    """Python's own `float` accepts some of these; a log that holds them is damaged."""
    assert parse_bottle(text) == (text,)


@pytest.mark.parametrize("text", ["+1", "1.", ".5", "-.5", "1.e5", "1E5", "007"])
def test_unusual_spellings_of_numbers_are_numbers(text: str) -> None:
    """Every spelling that the fast conversion accepts is a number here, too."""
    assert parse_bottle(text) == (float(text),)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 (2 3", r'expected "\)"'),
        ("1 2) 3", r'expected "\("'),
        ('1 "2', "closed strings"),
        ("1 [ok", "closed"),
        ("1 ]", "got"),
    ],
)
def test_what_is_not_closed_is_refused(text: str, message: str) -> None:
    """Brackets and quotes come in pairs."""
    with pytest.raises(FormatError, match=message):
        parse_bottle(text)


def test_deep_nesting_does_not_exhaust_the_stack() -> None:
    """A damaged file cannot stop the program by opening very many lists."""
    depth = 100_000
    bottle = parse_bottle("(" * depth + "7" + ")" * depth)
    assert list(leaves(bottle)) == [7]
    with pytest.raises(FormatError, match="100000 open"):
        parse_bottle("(" * depth)


def test_leaves_come_in_the_order_of_the_text() -> None:
    """Walking through nested lists keeps the order."""
    assert list(leaves(parse_bottle("1 (2 (3) () 4) 5 (6)"))) == [1, 2, 3, 4, 5, 6]


@given(st.text())
def test_quotes_are_short_ascii_lines(text: str) -> None:
    """Messages stay on one line whatever a file contains."""
    shown = quote(text)
    assert shown.isascii()
    assert shown.isprintable()
    assert len(shown) < 500


@given(st.text(alphabet='01.-e()[]" \\aok\n\x00', max_size=30))
def test_any_text_is_parsed_or_refused(text: str) -> None:
    """No text raises anything but the error of this library."""
    try:
        parse_bottle(text)
    except FormatError as error:
        assert "expected" in str(error)  # noqa: PT017 - both outcomes are allowed
