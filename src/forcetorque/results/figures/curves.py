# SPDX-License-Identifier: BSD-3-Clause
"""Curves that can be drawn: checked input, long recordings thinned without losing a peak, line styles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.recording.alignment import GAP_PERIODS
from forcetorque.results.figures.canvas import Look

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def drawable(values: Any, *, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    """Copy values to an array in which everything that is not a finite number is NaN, which no figure draws.

    Args:
        values: Anything NumPy can turn into numbers.
        name: Name of the argument, for the message.
        shape: Expected shape; `None` accepts any length of that axis but zero.

    Returns:
        A float64 array of that shape.

    Raises:
        ShapeError: If the shape differs, or the array is empty.
    """
    array = np.array(values, dtype=np.float64)
    require_shape(array, name=name, shape=shape)
    if not array.size:
        raise ShapeError(f"{name}: expected at least one sample to draw, got none, of shape {array.shape}")
    array[~np.isfinite(array)] = np.nan
    return array


def drawable_each(given: Mapping[str, Any], *, name: str, shape: tuple[int | None, ...]) -> dict[str, FloatArray]:
    """Do the same for every array of a mapping.

    Args:
        given: Arrays by their names.
        name: Name of the argument, for the message.
        shape: Expected shape of each.

    Returns:
        Arrays by their names, in the same order.

    Raises:
        ShapeError: If the mapping is empty, a shape differs, or an array is empty.
    """
    if not given:
        raise ShapeError(f"{name}: expected at least one name with its array to draw, got none")
    return {key: drawable(values, name=f"{name}[{key!r}]", shape=shape) for key, values in given.items()}


def instants(time_s: Any, *, name: str = "time_s") -> FloatArray:
    """Check that times can be an axis.

    Args:
        time_s: Instants of samples; shape (n,), n at least 1; s.
        name: Name of the argument, for the message.

    Returns:
        The same as an array.

    Raises:
        ShapeError: If the shape differs, there are none, one is not a finite number, or they fall.
    """
    time = drawable(time_s, name=name, shape=(None,))
    # a step from or to a NaN is no step forward
    forward = np.append(np.isfinite(time[0]), np.diff(time) >= 0.0)
    if not forward.all():
        at = int(np.argmin(forward))
        raise ShapeError(f"{name}: expected finite instants that do not fall, got {time[at]:g} s at index {at}")
    return time


DRAWN_SAMPLES = 2000
"""Samples of a line beyond which its smallest and largest values stand for stretches of them."""
DRAWN_POINTS = 3000
"""Points of a cloud beyond which some stand for all."""


def thinned_line(time_s: FloatArray, values: FloatArray, samples: int = DRAWN_SAMPLES) -> tuple[FloatArray, FloatArray]:
    """Take a line of bearable length that keeps every peak and is broken where the samples pause.

    Values that are not numbers break it too, where a whole stretch has none.

    Args:
        time_s: Instants, not falling, at least one; shape (n,); s.
        values: Columns to draw; shape (n, k).
        samples: Length beyond which it is thinned.

    Returns:
        Instants and values of the m points to draw, each unbroken part with a row of NaN after it; shapes (m,), (m, k).
    """
    steps = np.diff(time_s)
    pause = GAP_PERIODS * np.median(steps) if len(steps) else np.inf
    breaks = np.flatnonzero(steps > pause) + 1
    stride = -(-2 * len(time_s) // samples)
    times: list[FloatArray] = []
    drawn: list[FloatArray] = []
    for time, part in zip(np.split(time_s, breaks), np.split(values, breaks), strict=True):
        shown_time, shown = (time, part) if stride <= 2 else _envelope(time, part, stride)
        times += [shown_time, shown_time[-1:]]
        drawn += [shown, np.full((1, values.shape[1]), np.nan)]
    return np.concatenate(times), np.concatenate(drawn)


def thinned_cloud(points: FloatArray, limit: int = DRAWN_POINTS) -> FloatArray:
    """Take points of a cloud evenly in the order of time, first and last among them.

    Args:
        points: The cloud; shape (n, k).
        limit: Greatest number to take, at least 2.

    Returns:
        At most that many of the points; shape (m, k).
    """
    if len(points) <= limit:
        return points
    return points[np.linspace(0, len(points) - 1, limit).round().astype(np.int64)]


def _envelope(time_s: FloatArray, values: FloatArray, stride: int) -> tuple[FloatArray, FloatArray]:
    starts = np.arange(0, len(time_s), stride)
    # fmin, fmax: a missing value must not take the peak beside it along
    smallest, largest = np.fmin.reduceat(values, starts), np.fmax.reduceat(values, starts)
    ends = np.stack([smallest, largest], axis=1).reshape(-1, values.shape[1])
    return np.repeat(time_s[starts], 2), ends


_POINTS = 12
"""Points along a line."""


def draw_over_time(panel: Axes, time_s: FloatArray, values: FloatArray, style: Look, *, turn: int, count: int) -> None:
    """Draw a thinned line over time, with a point here and there.

    Args:
        panel: The panel.
        time_s: Instants, as `thinned_line` gives them; shape (m,); s.
        values: What is drawn, NaN where the line breaks; shape (m,).
        style: Colour of the line and shape of its points; the line is solid.
        turn: Place of the line among those of the panel, so that points of two lines do not meet.
        count: How many lines the panel has.
    """
    where = time_s[0] + (time_s[-1] - time_s[0]) * (np.arange(_POINTS) + (turn + 0.5) / count) / _POINTS
    points = np.minimum(np.searchsorted(time_s, where), len(time_s) - 1)
    panel.plot(
        time_s,
        values,
        color=style.colour,
        linewidth=1.0,
        marker=style.marker,
        markersize=6.5,
        markeredgecolor="white",
        markeredgewidth=0.6,
        markevery=[int(k) for k in points if np.isfinite(values[k])],
    )


def rms_words(wrenches: FloatArray) -> str | None:
    """Give the root mean squares of the norms of force and moment.

    Args:
        wrenches: Wrenches; shape (n, 6); N, N m; NaN in gaps.

    Returns:
        Such as `1.2 N, 0.03 N m`; None where no wrench is whole.
    """
    whole = wrenches[np.isfinite(wrenches).all(axis=1)]
    if not len(whole):
        return None
    force, moment = (np.sqrt((whole[:, part] ** 2).sum(axis=1).mean()) for part in FORCE_AND_MOMENT)
    return f"{force:.3g} N, {moment:.3g} N m"
