# SPDX-License-Identifier: BSD-3-Clause
"""What callers give, checked and brought to arrays that can be drawn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import ShapeError


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
