# SPDX-License-Identifier: BSD-3-Clause
"""Columns of Arrow become arrays as Arrow itself would make them, and pandas stays out."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pytest

from forcetorque.base.arrow import arrow_array, arrow_numbers


@pytest.mark.parametrize(
    "column",
    [
        pa.array([1.5, None, 3.0, float("nan"), -1e300, None, 7.0, 8.0, 9.0]),
        pa.array([1.5, None, 3.0, None, 5.0]).slice(1, 3),
        pa.array(range(20)).slice(9),
        pa.array([], pa.float64()),
        pa.array([2**62, -1]),
        pa.chunked_array([[1.0, None], [], [3.0]]),
        pa.chunked_array([], pa.int64()),
    ],
)
def test_numbers_are_those_of_arrow(column: pa.Array) -> None:
    """With empty values, slices and chunks, of both types."""
    numbers = arrow_numbers(column)
    expected = column.to_numpy() if isinstance(column, pa.ChunkedArray) else column.to_numpy(zero_copy_only=False)
    np.testing.assert_array_equal(numbers, expected)
    assert numbers.dtype == expected.dtype


@pytest.mark.parametrize(
    "numbers",
    [
        np.array([1.0, np.nan, -0.0]),
        np.arange(6.0).reshape(2, 3)[:, 1],
        np.broadcast_to(np.array(2.0), 3),
        np.array([2**62, -1]),
        np.zeros(0),
    ],
)
def test_arrays_are_those_of_arrow(numbers: npt.NDArray[Any]) -> None:
    """With NaN, steps in memory, both types, and nothing at all."""
    array = arrow_array(numbers)
    array.validate(full=True)
    assert array.type == pa.array(numbers).type
    assert array.null_count == 0
    np.testing.assert_array_equal(arrow_numbers(array), numbers)


_SCRIPT = """
import sys, pyarrow as pa
import numpy as np
from forcetorque.base.arrow import arrow_array, arrow_numbers
column = pa.Array.from_buffers(pa.int64(), 1, [None, pa.py_buffer(bytes(8))])
print({})
print("pandas" in sys.modules)
"""


def _loads_pandas(expression: str) -> bool:
    run = subprocess.run([sys.executable, "-c", _SCRIPT.format(expression)], capture_output=True, text=True, check=True)
    return run.stdout.split()[-1] == "True"


@pytest.mark.long
def test_pandas_is_not_loaded() -> None:
    """Negative control: by Arrow's own conversion it is, so there is a reason to have ours."""
    assert not _loads_pandas("arrow_numbers(column), arrow_array(np.zeros(1))")
    assert _loads_pandas("column.to_numpy()")
    assert _loads_pandas("pa.array(np.zeros(1))")
