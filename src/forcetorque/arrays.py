# SPDX-License-Identifier: BSD-3-Clause
"""Read-only float64 arrays with a checked shape, as held by every data class."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.errors import ShapeError

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]


def read_only(values: Any, *, name: str, shape: tuple[int | None, ...]) -> FloatArray:
    """Copy values to a float64 array that nobody can change afterwards.

    An array that is read-only already, with all memory that it is a view of, is taken as it is: a
    recording of ten million samples need not be held twice, and a file mapped for reading not at all.

    Args:
        values: Anything NumPy can turn into numbers.
        name: Name of the argument, for the message.
        shape: Expected shape; `None` accepts any length of that axis.

    Returns:
        A read-only array of that shape.

    Raises:
        ShapeError: If the shape differs.
    """
    array = values if _is_frozen(values) else np.array(values, dtype=np.float64, order="C")
    require_shape(array, name=name, shape=shape)
    array.setflags(write=False)
    return array


def read_only_integers(values: Any, *, name: str, shape: tuple[int | None, ...]) -> IntArray:
    """Copy whole numbers to an int64 array that nobody can change afterwards.

    Args:
        values: Anything NumPy can turn into whole numbers; an empty list is none of them.
        name: Name of the argument, for the message.
        shape: Expected shape; `None` accepts any length of that axis.

    Returns:
        A read-only array of that shape.

    Raises:
        ShapeError: If the shape differs, or a number has a fraction.
    """
    numbers = np.asarray(values)
    require_shape(numbers, name=name, shape=shape)
    array = numbers.astype(np.int64)
    if not np.array_equal(array, numbers):
        raise ShapeError(f"{name}: expected whole numbers, got {numbers[array != numbers].flat[0]}")
    array.setflags(write=False)
    return array


def _is_frozen(values: Any) -> bool:
    """Whether it is a C-ordered float64 array that nobody holds a writable view of by accident."""
    if not isinstance(values, np.ndarray) or values.dtype != np.float64 or not values.flags.c_contiguous:
        return False
    while isinstance(values, np.ndarray):
        if values.flags.writeable:
            return False
        values = values.base
    return True


def require_shape(array: npt.NDArray[Any], *, name: str, shape: tuple[int | None, ...]) -> None:
    """Check the shape of an array; `None` accepts any length of that axis.

    Args:
        array: Array to check.
        name: Name of the argument, for the message.
        shape: Expected shape.

    Raises:
        ShapeError: If the shape differs.
    """
    fits = array.ndim == len(shape) and all(
        expected is None or got == expected for got, expected in zip(array.shape, shape, strict=True)
    )
    if not fits:
        wanted = "(" + ", ".join("n" if k is None else str(k) for k in shape) + ")"
        raise ShapeError(f"{name}: expected an array of shape {wanted}, got {array.shape}")


def require_last_axis(array: npt.NDArray[Any], *, name: str, length: int) -> None:
    """Check that the components of an array lie along its last axis.

    Args:
        array: Array to check, any number of leading axes.
        name: Name of the argument, for the message.
        length: Expected length of the last axis.

    Raises:
        ShapeError: If the array is a scalar or its last axis has another length.
    """
    if array.ndim == 0 or array.shape[-1] != length:
        raise ShapeError(f"{name}: expected shape (..., {length}), got {array.shape}")
