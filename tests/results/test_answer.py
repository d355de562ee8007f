# SPDX-License-Identifier: BSD-3-Clause
"""Answers: the verdict first, the worst first, commands that can be copied, and warnings that are counted."""

from __future__ import annotations

import shlex
from dataclasses import replace

import pytest

from forcetorque.results.answer import (
    EXPERIMENT,
    FIRST_EXPERIMENT,
    MOST_LINES,
    Answer,
    Concern,
    answer_text,
    typed,
    warnings_text,
)
from forcetorque.results.number_text import amount, bounded, plus_minus

GOOD = Answer(
    subject="left (L1), l.json",
    verdict="USE",
    why=("force error 0.5 N (95 %: 0.8 N)",),
    step="export the matrix",
    command=typed("export", "l.json"),
    written=("l.png",),
)
BAD = Answer(
    subject="right (R1), r.json",
    verdict="DO NOT USE",
    why=("force error 9 N (95 %: 12 N, allowed 2 N)",),
    step="look for faults of the recording",
    command=typed("inspect", EXPERIMENT),
    written=("r.png",),
    concern=Concern.BAD,
)


def test_the_worst_comes_first_with_its_reason_and_its_step() -> None:
    """The others have a line each; files of all are named."""
    assert answer_text([GOOD, BAD], 40, "walk.toml").splitlines() == [
        "right (R1), r.json            DO NOT USE",
        "  force error 9 N (95 %: 12 N, allowed",
        "  2 N)",
        "left (L1), l.json                    USE",
        "written: r.png, l.png",
        "next: look for faults of the recording",
        "  forcetorque inspect walk.toml",
    ]


def test_lines_of_a_file_stand_below_the_step_as_they_are() -> None:
    """They are copied, so that none is wrapped; the reason gives way to them."""
    lines = ("[[load_case]]", 'name = "a name that is longer than the screen is wide"')
    text = answer_text([replace(BAD, lines=lines)], 40, "walk.toml", most=6).splitlines()
    assert text[1].endswith("…")
    assert text[-4:] == [
        "next: look for faults of the recording",
        "  [[load_case]]",
        '  name = "a name that is longer than the screen is wide"',
        "  forcetorque inspect walk.toml",
    ]


def test_reasons_without_room_are_left_out() -> None:
    """The last one that has room ends in an ellipsis; verdict, files and command stay, and one line of why."""
    whole = answer_text([BAD, GOOD], 40, "walk.toml")
    assert answer_text([BAD, GOOD], 40, "walk.toml", most=7) == whole
    for most in (2, 6):
        cut = answer_text([BAD, GOOD], 40, "walk.toml", most=most).splitlines()
        assert cut[1] == "  force error 9 N (95 %: 12 N, allowed …"
        assert [cut[0], *cut[2:]] == [line for k, line in enumerate(whole.splitlines()) if k not in (1, 2)]


def test_alike_answers_keep_their_order() -> None:
    """So that the first sensor of the file stays the first."""
    others = [Answer(subject=name, verdict="USE") for name in ("b", "a", "c")]
    assert [line[0] for line in answer_text(others, 20).splitlines()] == ["b", "a", "c"]


def test_nothing_is_next_where_nothing_is_to_be_done() -> None:
    """A line only."""
    assert answer_text([Answer(subject="arm", verdict="USE")], 12) == "arm      USE\n"


def test_a_verdict_without_room_goes_below() -> None:
    """A gap of two characters at least, else a line of its own."""
    answer = Answer(subject="arm_ft", verdict="DO NOT USE")
    assert answer_text([answer], 18) == "arm_ft  DO NOT USE\n"
    assert answer_text([answer], 17) == "arm_ft\n  DO NOT USE\n"


@pytest.mark.parametrize("width", [20, 40, 60, 80])
def test_a_command_can_be_copied_at_every_width(width: int) -> None:
    """A shell joins its lines to the words that were given; none is wider than the terminal."""
    words = ("accept", EXPERIMENT, "-c", "my arm.json", "--spec", "limits.toml", "--format", "json")
    answer = Answer(subject="arm", verdict="ACCEPTED", command=typed(*words))
    lines = answer_text([answer], width, shlex.quote("a b.toml")).splitlines()[1:]
    expected = ["forcetorque", "accept", "a b.toml", *words[2:]]
    assert shlex.split("\n".join(lines).replace("\\\n", "")) == expected  # a shell takes these two characters off
    assert max(map(len, lines)) <= width


def test_warnings_are_counted_and_cut_to_a_line() -> None:
    """The first three, where there is room for as many."""
    sentences = ("the first of the warnings is long", "second", "third", "fourth")
    assert warnings_text(sentences, 24).splitlines() == [
        "4 warnings, 3 shown:",
        "  the first of the …",
        "  second",
        "  third",
    ]
    assert warnings_text(sentences, 24, 1).count("\n") == 2
    assert warnings_text(sentences, 24, -3) == "4 warnings, none shown\n"
    assert warnings_text(sentences[:1], 60) == "1 warning:\n  the first of the warnings is long\n"
    assert warnings_text((), 60) == ""
    assert MOST_LINES == 12


def test_intervals_have_one_form() -> None:
    """A size with its bound, a number with its half-width, both with two digits that count."""
    assert bounded(0.8512, 1.402, "N") == "0.85 N (95 %: 1.4 N)"
    assert bounded(0.8512, None, "N") == "0.85 N (95 %: no bound)"
    assert plus_minus(1.23712, 0.0123, "kg") == "1.237 kg (95 %: ±0.012 kg)"
    assert plus_minus((0.13, -2.34), 0.21, "N") == "(0.13, -2.34) N (95 %: ±0.21 N)"
    assert plus_minus(0.5, None, "") == "0.500 (95 %: no bound)"
    assert plus_minus((119.0581, -4.2), None, "N") == "(119, -4) N (95 %: no bound)"


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0 N"), (324.4, "324 N"), (99.96, "100 N"), (12.34, "12 N"), (0.0432, "0.043 N"), (-0.5, "-0.5 N")],
)
def test_an_amount_has_two_digits_that_count(value: float, text: str) -> None:
    """And no power of ten, however small it is."""
    assert amount(value, "N") == text
    assert "e" not in amount(1e-7, "N")


def test_a_command_of_one_file_has_the_first_of_several() -> None:
    """Where others have all; without files both have a word for any."""
    one, all_ = (
        Answer(subject="arm", verdict="USE", command=typed("inspect", name)) for name in (FIRST_EXPERIMENT, EXPERIMENT)
    )
    assert answer_text([one], 80, "a.toml b.toml", "a.toml").splitlines()[-1] == "  forcetorque inspect a.toml"
    assert answer_text([all_], 80, "a.toml b.toml", "a.toml").splitlines()[-1] == "  forcetorque inspect a.toml b.toml"
    assert answer_text([one], 80).splitlines()[-1] == "  forcetorque inspect EXPERIMENT.toml"


def test_every_sensor_that_asks_for_attention_has_its_reason() -> None:
    """A line each where there is room, before more of the worst; what is left out is marked by an ellipsis."""
    worst = replace(BAD, why=("force error 9 N (95 %: 12 N, allowed 2 N)", "9 samples not fitted"))
    doubtful = replace(GOOD, verdict="NOT ENOUGH DATA", why=("1 N, allowed 0.5 N", "more"), concern=Concern.UNCERTAIN)
    whole = answer_text([GOOD, doubtful, worst], 40).splitlines()
    assert whole[1:6] == [
        "  force error 9 N (95 %: 12 N, allowed",
        "  2 N)",
        "  9 samples not fitted",
        "left (L1), l.json        NOT ENOUGH DATA",
        "  1 N, allowed 0.5 N",
    ]
    least = len(whole) - 4
    cut = [answer_text([GOOD, doubtful, worst], 40, most=least + room).splitlines() for room in range(4)]
    assert {lines[1] for lines in cut} == {"  force error 9 N (95 %: 12 N, allowed …"}
    assert [whole[5] in lines for lines in cut] == [False, False, True, True]
    assert [whole[3] in lines for lines in cut] == [False, False, False, True]
