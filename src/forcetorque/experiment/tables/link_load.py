# SPDX-License-Identifier: BSD-3-Clause
"""What hangs on a link of a robot, as the experiment file states it: `[[load]]` beside `[robot]`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.experiment.tables.wrist import Load
from forcetorque.toml_table import NotNegative, Table, Text

_OF_A_SENSOR = {"frame", "motion", "applied", "measure_direction"}
"""Keys of a load on a wrist sensor without a robot."""


class LinkLoad(Table):
    """What hangs on a link of a robot, such as the tool of an arm; the URDF is without it."""

    name: Text = "load"
    """Name, by which an interval says that this load hangs on the robot."""
    link: Text
    """Link of the URDF that it is fastened to, beyond the sensor as seen from the support."""
    mass_kg: NotNegative | None = None
    """Mass; left out to estimate it on the calibration intervals; 0 where nothing hangs."""
    centre_of_mass_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Centre of mass in the frame of the link; left out to estimate it."""
    inertia_kgm2: Annotated[FloatArray, ArrayField((3, 3))] | Literal["unknown"] | None = None
    """Inertia about the centre of mass, along the link's axes; `unknown` to estimate it; a point mass if left out."""
    weighed: Path | None = Field(default=None, alias="from")
    """In place of these: the load of that name in a result of `forcetorque payload --format json`, as surely as it was
    told there."""

    @model_validator(mode="after")
    def _stated_or_weighed(self) -> LinkLoad:
        stated = (self.mass_kg, self.centre_of_mass_m, self.inertia_kgm2)
        if self.weighed is not None and any(value is not None for value in stated):
            raise PydanticCustomError(
                "load_twice", "from says what the load is: leave mass_kg, centre_of_mass_m and inertia_kgm2 out"
            )
        return self


def _kind_of_load(value: Any) -> str:
    keys = value.keys() if isinstance(value, dict) else ()
    if isinstance(value, Load) or (not {"link", "from"} & set(keys) and _OF_A_SENSOR & set(keys)):
        return "on a sensor"
    return "on a link"


AnyLoad = Annotated[
    Annotated[Load, Tag("on a sensor")] | Annotated[LinkLoad, Tag("on a link")], Discriminator(_kind_of_load)
]
"""A table `[load]`: on a wrist sensor without a robot, or on a link of one."""


def require_link_loads(loads: Sequence[Load | LinkLoad]) -> None:
    """Refuse loads beside a robot that are not fastened to a link, or share a name.

    Args:
        loads: The loads.

    Raises:
        PydanticCustomError: If it is so.
    """
    if any(isinstance(load, Load) for load in loads):
        raise PydanticCustomError(
            "load_link",
            "beside [robot] a [[load]] needs link, the link of the URDF that it is fastened to; frame, motion and "
            "measure_direction are for a wrist sensor without [robot]",
        )
    if len({load.name for load in loads}) < len(loads):
        raise PydanticCustomError("load_names", "expected [[load]] with names that differ")
