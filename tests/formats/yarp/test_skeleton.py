# SPDX-License-Identifier: BSD-3-Clause
"""Lines are grouped by what stands between their numbers."""

from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from forcetorque.formats.yarp import message as skeleton
from forcetorque.formats.yarp.message import group_lines

_LINE = "1 1.5 (2.5 -3) [ok]"
_LINES = st.lists(st.text(alphabet="01.-e() [ok]", max_size=12), min_size=1, max_size=12)


def test_lines_that_differ_in_numbers_share_a_group() -> None:
    """Number, length and sign of digits do not matter."""
    (group,) = group_lines(f"{_LINE}\n20000 1e-9 (-0.25 777) [ok]\n".encode())
    assert group.rows.tolist() == [0, 1]


@pytest.mark.parametrize(
    "other",
    [
        "1 1.5 (2.5) [ok]",
        "1 1.5 (2.5 ) [ok]",
        "1 1.5 ( -3) [ok]",
        "1 1.5 (2.5 -3) [fail]",
        "1 1.5 (2.5 -3)4 [ok]",
        "1 1.5 4(2.5 -3) [ok]",
        "1 1.5 (2.5 -3) [ok4]",
        "1 1.5 (2.5 -3) [ok]4",
        "1 1.5 (2.5  -3) [ok]",
        "1 1.5 () [ok]",
        "1 (2.5 -3) [ok]",
        "",
    ],
)
def test_lines_that_differ_in_structure_do_not(other: str) -> None:
    """Also a number that is missing or glued to a bracket makes another skeleton."""
    groups = group_lines(f"{_LINE}\n{other}\n{_LINE}\n".encode())
    assert [group.rows.tolist() for group in groups] == [[0, 2], [1]]


def _expected_groups(lines: list[str]) -> list[list[int]]:
    """Group by walking through the characters."""
    found: dict[str, list[int]] = {}
    for row, line in enumerate(lines):
        key = ""
        for character in line:
            if character not in "0123456789.+-eE":
                key += character
            elif not key.endswith("#"):
                key += "#"
        found.setdefault(key, []).append(row)
    return list(found.values())


@given(lines=_LINES, piece=st.sampled_from([1, 2, 7, 1 << 18]))
def test_groups_share_out_the_lines(lines: list[str], piece: int) -> None:
    """Every line is in one group, in order, wherever the pieces of the text are cut."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(skeleton, "_PIECE_SIZE", piece)
        groups = group_lines("".join(line + "\n" for line in lines).encode())
    assert [group.rows.tolist() for group in groups] == _expected_groups(lines)
    for group in groups:
        assert group.text.decode().split("\n")[:-1] == [lines[row] for row in group.rows]


@given(
    forms=st.lists(st.sampled_from([" ", "(", ")", " (", ")) "]), max_size=4),
    digits=st.lists(st.integers(0, 3), min_size=1, max_size=40),
    piece=st.sampled_from([1, 2, 7, 1 << 18]),
)
def test_beginnings_end_before_a_character_of_the_skeleton(forms: list[str], digits: list[int], piece: int) -> None:
    """Every line is cut before the same one, wherever the pieces of the text are cut."""
    structure = "".join(forms) + "\n"
    lines = ["".join("1" * (1 + n + i) + form for i, form in enumerate(forms)) for n in digits]
    text = "".join(line + "\n" for line in lines)
    for length in range(len(structure)):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(skeleton, "_PIECE_SIZE", piece)
            (group,) = group_lines(text.encode(), n_structure=length)
        assert group.text.decode() == text
        expected = []
        for line in lines:
            places = [i for i, character in enumerate(line + "\n") if character not in "1"]
            expected.append(line[: places[length]] + "\n")
        assert group.beginnings.decode() == "".join(expected)


def test_among_other_lines_beginnings_are_whole_lines() -> None:
    """There nothing is cut off, and neither is where everything is needed."""
    groups = group_lines(b"1 (2)\n1 (2) 3\n", n_structure=1)
    assert [group.beginnings for group in groups] == [b"1 (2)\n", b"1 (2) 3\n"]
    (group,) = group_lines(b"1 (2)\n3 (4)\n")
    assert group.beginnings == group.text == b"1 (2)\n3 (4)\n"


def test_every_byte_is_structure_or_part_of_a_number() -> None:
    """All of ASCII, each character alone between two brackets."""
    seen = 0
    for byte in set(range(128)) - {ord("\n")}:
        (group,) = group_lines(b"(%c)\n" % byte)
        structure = bytes(character & 0x7F for character in group.skeleton)
        assert structure == (b"()\n" if chr(byte) in "0123456789.+-eE" else b"(%c)\n" % byte)
        seen += len(structure) == 3
    assert seen == 15
