# SPDX-License-Identifier: BSD-3-Clause
"""Samples over time as data sets of xarray: named dimensions, coordinates with names, units in attributes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import IntArray
from forcetorque.base.errors import needs_extra
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS

TIME: Final = "time"
"""Dimension of samples; its coordinate is the stamp, ns since the epoch of the clock."""
AXIS: Final = "axis"
"""Dimension of the six components of a wrench."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LabelledArray:
    """Samples of one quantity."""

    values: Any
    """Samples; shape (n, ...), one axis per dimension."""
    dims: tuple[str, ...]
    """Dimensions, `TIME` first."""
    units: str | tuple[str, ...]
    """Unit of all numbers, or of each along the last dimension."""
    attributes: Mapping[str, str] = field(default_factory=dict)
    """What else is known of them, such as the frame and a description."""


def wrench_array(values: Any, *dims: str, **attributes: str) -> LabelledArray:
    """Label wrenches.

    Args:
        values: Wrenches; shape (n, ..., 6); N, N m.
        dims: Dimensions between time and axis.
        attributes: As of `LabelledArray`.

    Returns:
        The labelled array.
    """
    return LabelledArray(values=values, dims=(TIME, *dims, AXIS), units=WRENCH_UNITS, attributes=attributes)


def xarray_dataset(
    stamp_ns: IntArray,
    arrays: Mapping[str, LabelledArray],
    coordinates: Mapping[str, Sequence[str]],
    **attributes: str,
) -> Any:
    """Make a data set.

    Args:
        stamp_ns: Instants; shape (n,); ns since the epoch of the clock.
        arrays: Arrays by name.
        coordinates: Names along dimensions other than time and axis, by dimension.
        attributes: What is known of all.

    Returns:
        `xarray.Dataset`; every variable has `units`, several apart by commas.

    Raises:
        MissingExtraError: If xarray is not installed.
    """
    with needs_extra("to_xarray needs xarray", "frames"):
        import xarray
    variables = {
        name: (
            array.dims,
            np.asarray(array.values),
            {
                "units": array.units if isinstance(array.units, str) else ", ".join(array.units),
                **array.attributes,
            },
        )
        for name, array in arrays.items()
    }
    named = {AXIS: list(WRENCH_COMPONENTS)} if any(AXIS in array.dims for array in arrays.values()) else {}
    stamps = {TIME: (TIME, stamp_ns, {"units": "ns", "long_name": "time since the epoch of the clock"})}
    names = {dim: list(labels) for dim, labels in coordinates.items()}
    return xarray.Dataset(variables, coords={**stamps, **named, **names}, attrs=attributes)
