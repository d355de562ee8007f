# SPDX-License-Identifier: BSD-3-Clause
"""Six positive numbers, one for each axis of a wrench."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field
from pydantic_core import PydanticCustomError

from forcetorque.toml_table import Positive

_AXES = 6


def _of_six_axes(values: Any) -> Any:
    if isinstance(values, list | tuple) and len(values) != _AXES:
        raise PydanticCustomError("six_axes", "expected six numbers, of fx, fy, fz in N and of tx, ty, tz in N m")
    return values


SixPositive = Annotated[tuple[Positive, ...], Field(min_length=_AXES, max_length=_AXES), BeforeValidator(_of_six_axes)]
"""Of forces in N, then of moments in N m."""
