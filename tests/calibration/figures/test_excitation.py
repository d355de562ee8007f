# SPDX-License-Identifier: BSD-3-Clause
"""Excitation: each direction at its size and share, those not excited told apart, and what it is made of."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from pydantic import ValidationError

from forcetorque.base.errors import ShapeError
from forcetorque.calibration.figures.excitation import excitation_figure
from forcetorque.experiment.calibration.excitation import EXPLAINED_SHARE
from forcetorque.experiment.calibration.provenance import Validity
from forcetorque.results.figure_style import PAPER, REFERENCE_COLOUR, look, png_bytes
from tests.report.drawing import excitation_of_sensors, legend_of, panels, validity_of_directions, words

TURN = np.sqrt(0.5)
DIRECTIONS = np.array([[-TURN, -TURN, 0.0], [0.0, 0.0, 1.0], [TURN, -TURN, 0.0]])


def _leg(excited: tuple[bool, bool, bool] = (True, True, False), directions: np.ndarray = DIRECTIONS) -> Validity:
    return validity_of_directions(np.array([4e6, 900.0, 0.0]), np.array([0.99, 0.6, 0.2]), excited, directions)


def test_points_lie_at_deviation_and_share(drawn: list[Figure]) -> None:
    """The root of the variance on a logarithmic axis, the share in percent; one of 0 at the left edge, named 0."""
    excitation_figure({"leg": _leg()})
    strength, share, _ = panels(drawn[0])
    points = [line.get_xydata()[0].tolist() for line in strength.lines if len(line.get_xdata()) == 1]
    assert strength.get_xscale() == "log"
    assert points == [[2000.0, 0.0], [30.0, 1.0], [strength.get_xlim()[0], 2.0]]
    assert [text.get_text() for text in strength.texts] == ["2000", "30", "0"]
    shares = [line.get_xydata()[0] for line in share.lines if len(line.get_xdata()) == 1]
    np.testing.assert_allclose(shares, [[99.0, 0.0], [60.0, 1.0], [20.0, 2.0]])
    assert share.lines[0].get_xdata()[0] == 100.0 * EXPLAINED_SHARE
    # the strongest is on top
    assert strength.get_ylim() == share.get_ylim() == (2.5, -0.5)


def test_what_is_not_excited_differs_in_colour_marker_and_line(drawn: list[Figure]) -> None:
    """As it was given, not as the share would have it; the legend says which."""
    excitation_figure({"leg": _leg((True, False, True))})
    for panel in panels(drawn[0])[:2]:
        points = [line for line in panel.lines if len(line.get_xdata()) == 1]
        assert [line.get_color() for line in points] == [look(k).colour for k in (0, 1, 0)]
        assert [line.get_marker() for line in points] == ["o", "X", "o"]
        stems = [
            line.get_linestyle() for line in panel.lines if line.get_color() != "#000000" and len(line.get_xdata()) == 2
        ]
        assert stems == ["-", ":", "-"]
    assert legend_of(drawn[0])[:2] == ["excited by the loads", "not excited"]


def test_directions_are_written_with_their_largest_part_positive(drawn: list[Figure]) -> None:
    """The sign of an eigenvector means nothing; numbers have theirs, and letters are white where the cell is dark."""
    excitation_figure({"leg": _leg()})
    parts = panels(drawn[0])[2]
    written = np.reshape([text.get_text() for text in parts.texts], (3, 3)).tolist()
    assert written == [["0.71", "0.71", "0.00"], ["0.00", "0.00", "1.00"], ["0.71", "−0.71", "0.00"]]
    np.testing.assert_allclose(parts.images[0].get_array()[0], [TURN, TURN, 0.0])
    assert [text.get_color() for text in parts.texts[3:6]] == [REFERENCE_COLOUR, REFERENCE_COLOUR, PAPER]
    flipped = {"leg": _leg(directions=-DIRECTIONS)}
    assert png_bytes(excitation_figure(flipped)) == png_bytes(excitation_figure({"leg": _leg()}))


def test_a_row_per_sensor_each_with_its_channels(drawn: list[Figure]) -> None:
    """Sensors of six and twelve channels below each other; where numbers have no room the minus signs stay."""
    args = excitation_of_sensors(np.random.default_rng(1), 6, 12)
    excitation_figure(args)
    assert len(panels(drawn[0])) == 6
    assert [panels(drawn[0])[k].get_title(loc="left") for k in (0, 3)] == list(args)
    wide = panels(drawn[0])[5]
    assert wide.images[0].get_array().shape == (12, 12)
    assert {text.get_text() for text in wide.texts} == {"", "–"}
    assert "–: negative" in wide.get_xlabel()
    assert "negative" not in panels(drawn[0])[2].get_xlabel()


def test_names_are_shown_as_they_are(drawn: list[Figure]) -> None:
    """Without formulas."""
    excitation_figure({"leg_$1$": _leg()})
    assert r"leg_\$1\$" in words(drawn[0])


def test_nothing_that_moves_is_drawn_too(drawn: list[Figure]) -> None:
    """Without a scale all lie at the left edge."""
    excitation_figure({"still": validity_of_directions(np.zeros(2), np.zeros(2), (False, False), np.eye(2))})
    assert [text.get_text() for text in panels(drawn[0])[0].texts] == ["0", "0"]


def test_no_sensor_is_refused() -> None:
    """There is nothing to draw."""
    with pytest.raises(ShapeError, match="sensors: expected at least one sensor"):
        excitation_figure({})


@pytest.mark.parametrize("damage", [{"explained": np.zeros(2)}, {"excited": (True,)}, {"directions": np.zeros((3, 2))}])
def test_directions_of_other_lengths_are_refused(damage: dict[str, Any]) -> None:
    """Where what supports a calibration is made or read."""
    with pytest.raises(ValidationError, match="expected explained, excited and directions of 3 raw directions"):
        Validity(**(_leg().model_dump() | damage))


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("explained", 1.1, "explained: expected numbers of 0 to 1"),
        ("explained", -0.1, "explained: expected numbers of 0 to 1"),
        ("directions", -1.1, "directions: expected numbers of -1 to 1"),
    ],
)
def test_shares_and_directions_beyond_one_are_refused(field: str, value: float, words: str) -> None:
    """A share is between 0 and 1, a component of a direction between -1 and 1."""
    made = _leg().model_dump()
    wrong = np.array(made[field], dtype=float)
    wrong.flat[0] = value
    with pytest.raises(ValidationError, match=words):
        Validity(**(made | {field: wrong}))
