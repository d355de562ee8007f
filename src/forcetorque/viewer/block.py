# SPDX-License-Identifier: BSD-3-Clause
"""The block of bytes with the arrays of a scene."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from forcetorque.viewer.scene import ArrayRef

ALIGNMENT = 8
"""Every array starts at a multiple of this many bytes."""


class Block:
    """Collects the arrays of a scene in one block of bytes."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._size = 0

    def add(self, values: npt.NDArray[Any], dtype: Literal["float32", "float64", "uint32"]) -> ArrayRef:
        """Append an array.

        Args:
            values: The array.
            dtype: Type to store it in.

        Returns:
            Where it is.
        """
        data = np.ascontiguousarray(values, dtype=np.dtype(dtype).newbyteorder("<")).tobytes()
        padding = -len(data) % ALIGNMENT
        reference = ArrayRef(offset=self._size, shape=tuple(values.shape), dtype=dtype)
        self._parts.append(data + b"\0" * padding)
        self._size += len(data) + padding
        return reference

    def bytes(self) -> bytes:
        """Give the whole block.

        Returns:
            Its bytes.
        """
        return b"".join(self._parts)


def read_array(block: bytes, reference: ArrayRef) -> npt.NDArray[Any]:
    """Give an array of a block.

    Args:
        block: The block.
        reference: Where the array is.

    Returns:
        The array, not to be changed.
    """
    dtype = np.dtype(reference.dtype).newbyteorder("<")
    count = int(np.prod(reference.shape))
    return np.frombuffer(block, dtype=dtype, count=count, offset=reference.offset).reshape(reference.shape)
