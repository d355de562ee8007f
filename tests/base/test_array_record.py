# SPDX-License-Identifier: BSD-3-Clause
"""Declared fields of records: shapes that agree, kinds of numbers, tuples, mappings, and nothing to change."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, check_arrays, mapping, names
from forcetorque.base.errors import ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples(ArrayRecord):
    """Every kind of declaration."""

    channels: tuple[str, ...] = field(metadata=names("c"))
    raw: FloatArray = field(metadata=array("n", "c"))
    stamp_ns: IntArray = field(metadata=array("n", dtype="int"))
    saturated: BoolArray | None = field(default=None, metadata=array("n", dtype="bool"))
    loads: Mapping[str, FloatArray] = field(default_factory=dict, metadata=mapping("n", 6))
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Positive:
    """A record with a check of its own."""

    values: FloatArray = field(metadata=array(None))

    def __post_init__(self) -> None:
        check_arrays(self)
        if (self.values <= 0.0).any():
            raise ValueError("expected positive numbers")


def _samples(**changes: Any) -> Samples:
    given = {"channels": ["a", "b"], "raw": [[1, 2], [3, 4], [5, 6]], "stamp_ns": [1, 2, 3]}
    return Samples(**given | changes)


def test_values_become_what_is_declared() -> None:
    """Lists become arrays and tuples; None stays where nothing is given."""
    one = _samples(loads={"left": np.zeros((3, 6))}, saturated=[0, 1, 0])
    assert one.channels == ("a", "b")
    assert one.raw.dtype == np.float64
    assert one.stamp_ns.dtype == np.int64
    assert one.saturated is not None
    assert one.saturated.tolist() == [False, True, False]
    assert _samples().saturated is None


def test_nothing_can_be_changed() -> None:
    """Neither arrays nor mappings, also not through what was given."""
    given = np.ones((3, 2))
    one = _samples(raw=given, loads={"left": np.zeros((3, 6))})
    given[0, 0] = 7.0
    assert one.raw[0, 0] == 1.0
    for values in (one.raw, one.stamp_ns, one.loads["left"]):
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1
    with pytest.raises(TypeError):
        one.loads["right"] = one.loads["left"]  # type: ignore[index]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"raw": [1.0, 2.0]}, r"raw: expected an array of shape \(n, 2\)"),
        ({"raw": np.ones((3, 3))}, r"raw: expected an array of shape \(n, 2\), got \(3, 3\)"),
        ({"stamp_ns": [1, 2]}, r"stamp_ns: expected an array of shape \(3\), got \(2,\)"),
        ({"stamp_ns": [1, 2, 2.5]}, "stamp_ns: expected whole numbers, got 2.5"),
        ({"saturated": [True]}, "saturated: expected an array of shape"),
        ({"loads": {"left": np.zeros((2, 6))}}, "loads of 'left': expected an array of shape"),
    ],
)
def test_shapes_agree_within_a_record(changes: dict[str, Any], message: str) -> None:
    """An axis of one name has one length."""
    with pytest.raises(ShapeError, match=message):
        _samples(**changes)


def test_a_check_of_its_own_comes_after() -> None:
    """It sees arrays."""
    assert Positive(values=[1.0]).values.shape == (1,)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="positive"):
        Positive(values=[0.0])  # type: ignore[arg-type]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Square(ArrayRecord):
    """Two axes of one name in one field."""

    covariance: FloatArray = field(metadata=array("k", "k"))


def test_axes_of_one_field_agree() -> None:
    """A square matrix is square."""
    assert Square(covariance=np.eye(2)).covariance.shape == (2, 2)
    with pytest.raises(ShapeError, match=r"covariance: expected axes k of one length, got \(2, 3\)"):
        Square(covariance=np.ones((2, 3)))
