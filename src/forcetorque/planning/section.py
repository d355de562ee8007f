# SPDX-License-Identifier: BSD-3-Clause
"""The `[plan]` section of an experiment file: what can be recorded next, checked against the robot."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ExperimentError, known_names, require_known
from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text
from forcetorque.experiment.section import Loading, Section, require_link
from forcetorque.recording.recording import Support


class PlanTool(Table):
    """Something that may be attached while recording."""

    name: Text
    """Name, unique in the file; `none` is what the robot is without any."""
    frame: Text
    """Link that carries it."""
    mass_kg: Positive
    """Mass; kg."""
    centre_of_mass_m: Annotated[FloatArray, ArrayField((3,))]
    """Centre of mass in the axes of the frame; m."""


def _as_list(value: Any) -> Any:
    return [value] if isinstance(value, str) else value


_Names = Annotated[
    tuple[Text, ...],
    BeforeValidator(_as_list),
    WithJsonSchema({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}),
]


class PlanTable(Table):
    """Limits of what `forcetorque plan` may ask for; collisions, floor and balance are not known to it."""

    clearance_deg: NotNegative | None = None
    """What joints keep away from the limits of the URDF; deg; stated here or on the command line."""
    support: _Names = ()
    """Frame, or frames, of [[support]] that may hold the robot; those of the calibration intervals if left out."""
    hold_s: NotNegative = 1.0
    """How long the robot rests at every posture; s."""
    speed: Positive = 0.5
    """Largest speed of any joint; that of the URDF holds where it is lower; rad/s or m/s."""
    ranges: dict[Text, tuple[Finite, Finite]] = Field(default_factory=dict)
    """Lowest and highest position of joints beside the limits of the URDF; deg, m for those that slide; a joint with a
    range may move though it is not of the sensor's limb, and one whose range is a single position stays there."""
    tool: tuple[PlanTool, ...] = ()
    """What may be attached, one at a time; nothing attached is always a choice."""
    temperatures: tuple[Finite, ...] = ()
    """Values of the variable `temperature` that can be reached; degC."""

    @model_validator(mode="after")
    def _does_not_contradict_itself(self) -> PlanTable:
        for joint, (low, high) in self.ranges.items():
            if low > high:
                raise ValueError(f"ranges: joint {joint}: expected [lowest, highest], got {low:g} to {high:g}")
        names = ["none", *(tool.name for tool in self.tool)]
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"two tools are called {name}; name them apart")
        return self


def _checked(table: PlanTable | None, loading: Loading) -> PlanTable | None:
    """The table, whose joints, links and supports exist."""
    if table is None:
        return None
    file, model = loading.file, loading.model
    free = [joint.name for joint in model.joints.values() if joint.type.moves and joint.mimic is None]
    for joint in table.ranges:
        require_known(
            joint, free, ExperimentError, f"{file}: plan: ranges: robot {model.name!r} has no free joint {joint!r}"
        )
    for tool in table.tool:
        require_link(model, tool.frame, f"{file}: plan: tool {tool.name!r}")
    still = [support.frame for support in loading.supports.values() if isinstance(support, Support)]
    for frame in table.support:
        if frame not in still:
            raise ExperimentError(
                f"{file}: plan: support: no [[support]] at rest has the frame {frame!r}; {known_names(frame, still)}; "
                "add one with its gravity_direction"
            )
    return table


PLAN: Section[PlanTable | None, PlanTable | None] = Section(
    key="plan",
    type=PlanTable | None,
    default=None,
    description="What can be recorded next, for `forcetorque plan`.",
    read=_checked,
    empty=None,
    of_plan=True,
)
