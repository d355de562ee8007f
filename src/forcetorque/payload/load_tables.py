# SPDX-License-Identifier: BSD-3-Clause
"""The tables of loads: `[load]` of a wrist sensor and `[[load]]` of links."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, Protocol

from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    Tag,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import CoreSchema, core_schema

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import known_names
from forcetorque.base.toml_file import NotNegative, Table, Text
from forcetorque.base.wrench import MeasureDirection
from forcetorque.recording.recording import NO_MOTION

_OF_SENSOR = ("frame", "motion", "applied", "measure_direction", "drift", "mount", "tilt")
"""What is of the sensor, whatever hangs on it: stated with the first load."""


def _streams(value: Any) -> Any:
    """Names of streams; none for the word, which an empty list is not."""
    if value == NO_MOTION:
        return ()
    if value == []:
        raise ValueError('expected a stream or more, or "none" for a sensor by itself')
    return value


class Load(Table):
    """What hangs on a wrist sensor, in place of a robot."""

    name: Text = "load"
    """Name, by which an interval says that this load hangs on the sensor."""
    frame: Text
    """Frame of the sensor, along whose axes it and the motion streams read."""
    motion: (
        Annotated[
            tuple[Text, ...],
            BeforeValidator(_streams),
            WithJsonSchema(
                {
                    "anyOf": [
                        {"const": NO_MOTION},
                        {"type": "array", "items": {"type": "string", "minLength": 1}, "minItems": 1},
                    ]
                }
            ),
        ]
        | None
    ) = None
    """Streams with `gravity` (still poses), or `proper_acceleration` and `angular_velocity`; `none` for a sensor by
    itself, which is inspected, heated or tapped: nothing then says what it must read."""
    applied: Text | None = None
    """In place of motion and mass: stream with the `applied_wrench`, which is then what the sensor must read."""
    measure_direction: MeasureDirection = MeasureDirection.CHILD_TO_PARENT
    """Who acts on whom in the reading; the load is the child; left out with `motion = "none"` only."""
    mass_kg: NotNegative | None = None
    """Mass; left out to estimate it on the calibration intervals; 0 for the bare sensor."""
    centre_of_mass_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Centre of mass in the frame; left out to estimate it."""
    inertia_kgm2: Annotated[FloatArray, ArrayField((3, 3))] | Literal["unknown"] | None = None
    """Inertia about the centre of mass, along the frame's axes; `unknown` to estimate it; a point mass if left out."""
    weighed: Path | None = Field(default=None, alias="from")
    """In place of these: the load of that name in a result of `forcetorque payload --format json`, taken as stated."""
    drift: bool | None = None
    """Whether biases move evenly in time where loads are estimated; rows that are held out choose if left out."""
    mount: Literal["unknown"] | None = None
    """`unknown` where the sensor is turned against the axes of the motion streams: the rotation is then estimated."""
    tilt: Literal["unknown"] | None = None
    """`unknown` where the world of the orientation streams is not level: its tilt is then estimated."""

    @model_validator(mode="after")
    def _motion_or_wrench(self) -> Load:
        if (self.motion is None) == (self.applied is None):
            raise ValueError(
                "expected motion, the streams that tell how the load moves, or applied, a known wrench; "
                'motion = "none" is for a sensor by itself'
            )
        if self.motion != () and "measure_direction" not in self.model_fields_set:
            raise ValueError("expected measure_direction, child_to_parent or parent_to_child; it is never guessed")
        if self.applied is not None and (self.mass_kg is not None or self.centre_of_mass_m is not None):
            raise ValueError("applied says what the sensor must read: leave the mass out")
        if self.weighed is not None and (self.applied is not None or self.motion == ()):
            raise ValueError("from names a load that moves: expected motion with its streams")
        _require_stated_once(self)
        return self

    @property
    def streams(self) -> tuple[str, ...]:
        """Streams that say what the sensor must read."""
        return (self.applied or "",) if self.motion is None else self.motion


class OneOrSeveral:
    """Annotation of loads: one table is a list of one, and later ones have what is of the sensor from the first."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validate a table, or a list of tables.

        Args:
            source: Type that is annotated.
            handler: Gives its schema.

        Returns:
            The schema.
        """
        return core_schema.no_info_before_validator_function(_loads, handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Describe both forms.

        Args:
            schema: Schema of the list.
            handler: Gives its description.

        Returns:
            The description.
        """
        several = handler(schema)
        return {"anyOf": [several["items"], {"type": "array", "minItems": 1, "items": {"type": "object"}}]}


def _loads(value: Any) -> Any:
    if not isinstance(value, list):
        return (value,)
    first = value[0] if value and isinstance(value[0], dict) else {}
    shared = {key: first[key] for key in _OF_SENSOR if key in first}
    return tuple(shared | entry if isinstance(entry, dict) else entry for entry in value)


def require_one_sensor(loads: Sequence[Load]) -> None:
    """Refuse no load, one on a link, loads of one name, or that say different things of the sensor.

    Raises:
        ValueError: If it is so.
    """
    if not loads:
        raise ValueError("expected [load], or [[load]] for each of several, got none")
    if len({load.name for load in loads}) < len(loads):
        raise ValueError("expected [[load]] with names that differ")
    for key in _OF_SENSOR:
        if any(getattr(load, key) != getattr(loads[0], key) for load in loads):
            raise ValueError(f"{key} is of the sensor: state it in the first [[load]] only")


class _Named(Protocol):
    @property
    def name(self) -> str: ...


class _Interval(Protocol):
    @property
    def label(self) -> str: ...
    @property
    def load(self) -> str | None: ...


def require_loads_of(loads: Sequence[_Named], intervals: Sequence[_Interval]) -> None:
    """Refuse intervals that do not say which load hangs on the sensor.

    Args:
        loads: The loads.
        intervals: Intervals that are used.

    Raises:
        ValueError: If there are several loads and an interval names none, or one that is not there.
    """
    names = [load.name for load in loads]
    for interval in intervals:
        message = ""
        if interval.load is None and len(loads) > 1:
            message = f"expected load, the name of what hangs on the sensor: {', '.join(names)}"
        elif interval.load is not None and interval.load not in names:
            message = f"no [[load]] {interval.load!r}; {known_names(interval.load, names)}"
        if message:
            raise ValueError(f"interval {interval.label!r}: {message}")


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
    """Inertia about the centre of mass, along the link's axes; `unknown` to estimate it. If left out it is estimated
    where mass or centre of mass is, and that of a point mass where both are stated."""
    weighed: Path | None = Field(default=None, alias="from")
    """In place of these: the load of that name in a result of `forcetorque payload --format json`, as surely as it was
    told there."""

    @model_validator(mode="after")
    def _stated_or_weighed(self) -> LinkLoad:
        _require_stated_once(self)
        return self


def _require_stated_once(load: Load | LinkLoad) -> None:
    stated = (load.mass_kg, load.centre_of_mass_m, load.inertia_kgm2)
    if load.weighed is not None and any(value is not None for value in stated):
        raise ValueError("from says what the load is: leave mass_kg, centre_of_mass_m and inertia_kgm2 out")


def _kind_of_load(value: Any) -> str:
    keys = value.keys() if isinstance(value, dict) else ()
    if isinstance(value, Load) or ("link" not in keys and _OF_A_SENSOR & set(keys)):
        return "on a sensor"
    return "on a link"


AnyLoad = Annotated[
    Annotated[Load, Tag("on a sensor")] | Annotated[LinkLoad, Tag("on a link")], Discriminator(_kind_of_load)
]
"""A table `[load]`: on a wrist sensor without a robot, or on a link of one."""


def require_link_loads(loads: Sequence[Load | LinkLoad]) -> None:
    """Refuse loads beside a robot that are not fastened to a link, or share a name.

    Raises:
        ValueError: If it is so.
    """
    if any(isinstance(load, Load) for load in loads):
        raise ValueError(
            "beside [robot] a [[load]] needs link, the link of the URDF that it is fastened to; frame, motion and "
            "measure_direction are for a wrist sensor without [robot]"
        )
    if len({load.name for load in loads}) < len(loads):
        raise ValueError("expected [[load]] with names that differ")


Loads = tuple[Load | LinkLoad, ...]


def wrist_tables(loads: Loads | None) -> tuple[Load, ...]:
    """Give the loads on a wrist sensor, in place of a robot.

    Args:
        loads: Tables `[load]` of a file.

    Returns:
        Those without a robot.
    """
    return tuple(load for load in loads or () if isinstance(load, Load))


def link_tables(loads: Loads | None) -> tuple[LinkLoad, ...]:
    """Give the loads on links of the robot.

    Args:
        loads: Tables `[load]` of a file.

    Returns:
        Those with a link.
    """
    return tuple(load for load in loads or () if isinstance(load, LinkLoad))
