# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as scripts give them: arrays, lists, masked arrays, columns and frames of pandas."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError


def numbers(given: Any, name: str) -> FloatArray:
    """Take what is given as numbers, NaN where none is; text of numbers is accepted, instants and complex are not.

    Args:
        given: An array, or what NumPy makes one of.
        name: Name of the argument, for the message.

    Returns:
        The numbers.

    Raises:
        ExperimentError: If it holds anything else.
    """
    refusal = ExperimentError(f"{name}: expected numbers, got {brief(given)}")
    try:
        array = _plain(given)
        values = array.astype(np.float64) if array.dtype.kind not in "mMc" else None
    except (TypeError, ValueError) as error:
        raise refusal from error
    if values is None:
        raise refusal
    return values


def brief(given: Any) -> str:
    """Describe an argument in a few words, of any size.

    Args:
        given: The argument.

    Returns:
        Its value if it is short, else its type and shape.
    """
    shape = getattr(given, "shape", None)
    if shape is not None:
        return f"{type(given).__name__} of shape {shape}"
    return repr(given) if given is None or isinstance(given, str | int | float) else f"a {type(given).__name__}"


def _plain(given: Any) -> npt.NDArray[Any]:
    """An array of numpy, whose NaN stands for what is masked and for what pandas knows to be missing."""
    if isinstance(given, np.ma.MaskedArray):
        return np.where(np.ma.getmaskarray(given), np.nan, given.data)
    array = np.asarray(given)
    if array.dtype == object and hasattr(given, "to_numpy"):  # of pandas, where numbers that may be missing are objects
        return np.asarray(given.to_numpy(dtype=np.float64, na_value=np.nan))
    return array
