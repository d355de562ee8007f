# SPDX-License-Identifier: BSD-3-Clause
"""Sections of the experiment file, which capabilities register."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Generic, TypeVar

from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.base.inertia import Inertia
from forcetorque.base.lazy import named
from forcetorque.experiment.named_files import Inputs
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support
from forcetorque.results.capability import all_named
from forcetorque.robot.model import RobotModel

TableT = TypeVar("TableT")
ContentT = TypeVar("ContentT")


def require_link(model: RobotModel, link: str, where: str) -> None:
    """Refuse a link that the robot does not have.

    Args:
        model: The robot.
        link: Name of the link.
        where: File and table that name it, for the message.

    Raises:
        ExperimentError: If there is no such link.
    """
    require_known(link, model.links, ExperimentError, f"{where}: robot {model.name!r} has no link {link!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Loading:
    """What is known of an experiment when its sections are read."""

    parsed: Any
    """Content of the file, an `ExperimentFile`; of what is not recorded yet, without recording and intervals."""
    file: Path
    """The file, for messages."""
    inputs: Inputs
    """Resolves and remembers the files."""
    recording: Recording
    """What was measured; with intervals once these are read."""
    model: RobotModel
    """The robot, or what stands in for one; without links before it is known."""
    sensors: tuple[Any, ...] = ()
    """Its sensors, each an `ExperimentSensor`, once these are read."""
    supports: Mapping[str, Support | MovingSupport]
    """Supports of the file by frame."""
    stand_in: StandIn | None = None
    """What stands in for a robot; None where the file names one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StandIn:
    """What a section gives in place of a robot that the file does not name."""

    model: RobotModel
    """Its links."""
    supports: Mapping[str, MovingSupport] | None = None
    """Support of the intervals of each load by its name; None where intervals have supports of their own."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Section(Generic[TableT, ContentT]):
    """A table of the experiment file, and what becomes of it; sections with more to say derive from this."""

    key: str
    """Name of the table."""
    type: Any
    """Annotation of the table, for pydantic."""
    default: TableT
    """Table of a file that does not have it."""
    description: str
    """What it is for."""
    read: Callable[[TableT, Loading], ContentT]
    """Checks the table against robot and recording; raises `ExperimentError`."""
    empty: ContentT
    """Content of an experiment without it."""
    of_robot: bool = True
    """Whether it needs a robot: it is passed over where a load on a wrist sensor stands in for one."""
    of_plan: bool = False
    """Whether a file may have it before anything is recorded."""
    without_sensors: tuple[str, str] | None = None
    """Of a section that makes sense in a file without sensors: what such a file has, and which commands read it."""

    def check(self, table: TableT, file: Any) -> None:
        """Hold the table against the rest of the file.

        Args:
            table: The table.
            file: Content of the file, an `ExperimentFile`.

        Raises:
            ValueError: If they contradict each other.
        """

    def gives_forces(self, table: TableT) -> bool:
        """Say whether contact forces follow from the table without force-torque sensors.

        Returns:
            Whether they do.
        """
        return False

    def loaded_links(self, table: TableT) -> frozenset[str]:
        """Name links whose inertia is not that of the URDF.

        Returns:
            Links, or the frame of a sensor in place of a robot, that carry a load.
        """
        return frozenset()

    def stand_in(self, table: TableT, loading: Loading) -> StandIn | None:
        """Give what stands in for a robot that the file does not name.

        Args:
            table: The table.
            loading: What is known so far.

        Returns:
            Links and supports; None where the table gives none.

        Raises:
            ExperimentError: If the table contradicts the recording.
        """
        return None

    def place(self, table: TableT, loading: Loading, intervals: Sequence[Interval]) -> Sequence[Interval]:
        """Change the supports of intervals.

        Args:
            table: The table.
            loading: What is known so far.
            intervals: Intervals in the order of the file.

        Returns:
            The same, with supports that the table makes of them.
        """
        return intervals


@cache
def sections() -> tuple[Section[Any, Any], ...]:
    """Give the sections of all capabilities.

    Returns:
        Sections in the order of the capabilities.
    """
    return tuple(named(reference) for _, reference in all_named("sections"))


NO_ROBOT = RobotModel(name="none", links={"none": Inertia.zero()}, joints={}, sensors={})
"""Model of a `Loading` whose robot is not known yet."""
