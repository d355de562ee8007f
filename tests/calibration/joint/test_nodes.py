# SPDX-License-Identifier: BSD-3-Clause
"""Windows as three nodes: exact for parabolas and their products, quiet for noise, honest about gaps."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from forcetorque.calibration.joint.window_nodes import Stretch, WindowNodes
from forcetorque.calibration.joint.windows import PIECE_S, WINDOW_S, part_windows, window_means
from forcetorque.robot.mechanics.sub_model_equations import untouched_parts
from tests.calibration.joint.swaying import FEET, RATE_HZ, SENSORS, swaying


@cache
def _stretch() -> Stretch:
    """Twenty seconds of a motion."""
    return swaying(1, noise=0.0).stretch


def _with_readings(stretch: Stretch, values: np.ndarray) -> Stretch:
    return Stretch(
        label="",
        recording="",
        session="",
        time_s=stretch.time_s,
        tree=stretch.tree,
        joints=stretch.joints,
        root=stretch.root,
        readings={"one": values},
        touched=(),
    )


def test_products_of_parabolas_have_their_exact_means() -> None:
    """The product is of fourth degree; its mean over a window is that of the integral."""
    stretch = _stretch()
    time = stretch.time_s
    windows = WindowNodes(time, 0.25)
    values = np.stack([1.0 + 3.0 * time - 2.0 * time**2] * 6, axis=1)
    (at_nodes,) = windows.condensed(_with_readings(stretch, values)).readings.values()
    squares = windows.node_means(at_nodes**2)[:, 0]
    polynomial = np.polynomial.Polynomial([1.0, 3.0, -2.0])
    integral = (polynomial**2).integ()
    half = 0.125
    whole = windows.counts == 25
    exact = (integral(windows.time_s + half) - integral(windows.time_s - half)) / (2.0 * half)
    np.testing.assert_allclose(squares[whole], exact[whole], rtol=1e-9)


def test_noise_is_averaged_as_far_as_a_parabola_can() -> None:
    """The mean over the nodes is nearly that over the samples: noise of 25 samples is down to a fifth."""
    stretch = _stretch()
    noise = np.random.default_rng(1).normal(size=(len(stretch), 6))
    windows = WindowNodes(stretch.time_s, 0.25)
    (at_nodes,) = windows.condensed(_with_readings(stretch, noise)).readings.values()
    np.testing.assert_allclose(windows.node_means(at_nodes), windows.means(noise), atol=0.02)
    assert windows.node_means(at_nodes)[windows.counts == 25].std() < 0.22
    # negative control: samples at the nodes themselves would keep more of it
    assert noise[::8].reshape(-1, 6).std() > 0.9


def test_windows_of_few_samples_are_no_parabolas() -> None:
    """One sample stays as it is, two make a line; a gap stays in its window."""
    stretch = _stretch()
    rows = np.r_[np.arange(0, 25), 25, 50, 60, np.arange(75, 100)]
    piece = Stretch(
        label="",
        recording="",
        session="",
        time_s=stretch.time_s[rows],
        tree=stretch.tree,
        joints=stretch.joints.samples(rows),
        root=stretch.root.samples(rows),
        readings={"one": np.stack([stretch.time_s[rows]] * 6, axis=1)},
        touched=(),
    )
    windows = WindowNodes(piece.time_s, 0.25)
    assert windows.counts.tolist() == [25, 1, 2, 25]
    nodes = windows.condensed(piece)
    np.testing.assert_allclose(nodes.readings["one"][:, 0], nodes.time_s, atol=2e-4)
    values = np.ones((len(rows), 6))
    values[3] = np.nan
    (gap,) = windows.condensed(_with_readings(piece, values)).readings.values()
    assert np.isnan(gap[:3]).all()
    np.testing.assert_allclose(gap[3:], 1.0)


def test_rates_of_parabolas_are_exact_at_the_nodes() -> None:
    """At the places of Gauss in a window of whole samples; of two samples the rate is their slope, of one 0."""
    time = np.r_[np.arange(0, 25), 25, 50, 60, np.arange(75, 100)] / 100.0
    windows = WindowNodes(time, 0.25)
    assert windows.counts.tolist() == [25, 1, 2, 25]
    np.testing.assert_allclose(windows.time_s, [0.12, 0.25, 0.55, 0.87], rtol=1e-12)
    polynomial = np.polynomial.Polynomial([2.0, -3.0, 4.0])
    values = np.stack([polynomial(time), 5.0 * time], axis=1)
    places, _ = np.polynomial.legendre.leggauss(3)
    nodes = windows.time_s[:, None] + 0.125 * places
    parabola, line = windows.rates(values).reshape(4, 3, 2).transpose(2, 0, 1)
    np.testing.assert_allclose(parabola[[0, 3]], polynomial.deriv()(nodes[[0, 3]]), rtol=1e-9)
    np.testing.assert_allclose(parabola[2], (polynomial(0.6) - polynomial(0.5)) / 0.1, rtol=1e-9)
    np.testing.assert_allclose(line, [[5.0] * 3, [0.0] * 3, [5.0] * 3, [5.0] * 3], atol=1e-9)


def test_pieces_are_the_stretch() -> None:
    """Equal pieces that follow each other; one of a short stretch."""
    stretch = _stretch()
    pieces = list(stretch.pieces(6.0))
    assert len(pieces) == 4
    np.testing.assert_array_equal(np.concatenate([piece.time_s for piece in pieces]), stretch.time_s)
    assert len(list(stretch.pieces(1e3))) == 1


def test_what_else_was_logged_is_averaged_over_the_windows_of_the_equations() -> None:
    """Also where a recording is so long that it is worked on in pieces, which begin anywhere between two windows."""
    once, rows = _stretch(), np.arange(13013)
    again = rows % len(once)
    stretch = replace(
        once,
        time_s=rows / RATE_HZ,
        joints=once.joints.samples(again),
        root=once.root.samples(again),
        readings={name: values[again] for name, values in once.readings.items()},
    )
    parts = untouched_parts(stretch.tree, SENSORS, FEET)
    assert len(list(stretch.pieces(PIECE_S))) == 2
    times, means = window_means(stretch, stretch.time_s[:, None])
    np.testing.assert_allclose(means[:, 0], times)
    for windows in part_windows(stretch, parts, ()):
        np.testing.assert_array_equal(windows.time_s, times)
    # negative control: windows of the whole stretch are others
    assert not np.isin(WindowNodes(stretch.time_s, WINDOW_S).time_s, times).all()


def test_windows_begin_with_the_first_sample() -> None:
    """Wherever on the clock that lies, all windows but the last are whole."""
    for start_s in (0.0, 0.1, 7.13):
        windows = WindowNodes(start_s + 0.01 * np.arange(60), 0.25)
        assert windows.counts.tolist() == [25, 25, 10]
        assert windows.time_s[0] == pytest.approx(start_s + 0.12, abs=1e-12)
