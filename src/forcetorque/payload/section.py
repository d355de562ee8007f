# SPDX-License-Identifier: BSD-3-Clause
"""The section `load` of an experiment file: loads that stand in for a robot, or hang on its links.

What reads loads is imported where a file has them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from forcetorque.experiment.experiment_file import ExperimentFile
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.section import Loading, Section, StandIn
from forcetorque.payload.load_tables import (
    AnyLoad,
    LinkLoad,
    Loads,
    OneOrSeveral,
    link_tables,
    require_link_loads,
    require_loads_of,
    require_one_sensor,
    wrist_tables,
)
from forcetorque.recording.recording import Interval, MovingSupport, Use

if TYPE_CHECKING:
    from forcetorque.payload.load_on_wrist_sensor import WristLoads
    from forcetorque.payload.loads_on_robot_links import LinkLoads


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadSection(Section[Loads | None, "WristLoads | LinkLoads | None"]):
    """The loads of an experiment: they stand in for a robot, or hang on its links in some intervals."""

    def check(self, table: Loads | None, file: ExperimentFile) -> None:  # noqa: D102
        if file.sensor:
            _require_robot_or_load(table, file)
        if table is not None:
            if file.robot is None:
                require_one_sensor(wrist_tables(table))
            require_loads_of(table, [one for one in file.interval if one.use is not Use.IGNORE])

    def loaded_links(self, table: Loads | None) -> frozenset[str]:  # noqa: D102
        return frozenset(load.link if isinstance(load, LinkLoad) else load.frame for load in table or ())

    def stand_in(self, table: Loads | None, loading: Loading) -> StandIn | None:  # noqa: D102
        tables = wrist_tables(table)
        if not tables or not loading.parsed.sensor:
            return None
        from forcetorque.payload.load_on_wrist_sensor import load_model, stated_inertia, stated_loads

        load = tables[0]
        supports = {
            one.name: MovingSupport(frame=load.frame, motion_streams=load.streams, is_unknown=not load.streams)
            for one in tables
        }
        with stated_in(f"{loading.file}: load"):
            for stream in load.streams:
                loading.recording.stream(stream)
            if load.applied is not None:
                loading.recording.stream(load.applied).signal("applied_wrench")
            inertia = stated_inertia(stated_loads(tables, loading.inputs)[0])
        return StandIn(model=load_model(load, loading.parsed.sensor[0].name, inertia), supports=supports)

    def place(  # noqa: D102
        self, table: Loads | None, loading: Loading, intervals: Sequence[Interval]
    ) -> Sequence[Interval]:
        if table is None:
            return intervals
        from forcetorque.payload.loads_on_robot_links import with_loads_named

        return with_loads_named(intervals, [span.load for span in loading.parsed.interval], link_tables(table))


def _require_robot_or_load(loads: Loads | None, file: ExperimentFile) -> None:
    if file.robot is None and loads is None:
        raise ValueError("expected [robot] with a URDF, or [load] for a wrist sensor")
    if loads is not None and file.robot is not None:
        require_link_loads(loads)
    if file.robot is None and link_tables(loads):
        raise ValueError("[[load]] with link hangs on a link of a robot: expected [robot] with its URDF, got none")
    if file.robot is not None and not file.support and not any(one.contact_links for one in file.interval):
        raise ValueError("expected [[support]]: the frame that the robot stands on, or contact_links in [[interval]]")
    alone = loads is not None and file.robot is None
    if alone and (file.support or len(file.sensor) > 1):
        raise ValueError("with [load] there is one [[sensor]] and no [[support]]")
    if alone and any(one.contact_links for one in file.interval):
        raise ValueError("with [load] nothing else touches: leave out contact_links")
    if loads is not None and any(one.contact_links and one.use is not Use.IGNORE for one in file.interval):
        raise ValueError(
            "with [[load]] on a link every interval names its support: leave out contact_links, or state the load "
            "in the URDF"
        )
    if loads is None and any(one.load for one in file.interval):
        raise ValueError("load of [[interval]] names a [[load]], of which there is none")


def _read(table: Loads | None, loading: Loading) -> WristLoads | LinkLoads | None:
    if table is None:
        return None
    from forcetorque.payload.load_on_wrist_sensor import read_wrist_loads
    from forcetorque.payload.loads_on_robot_links import read_link_loads

    if loading.stand_in is not None and loading.stand_in.supports is not None:
        supports = loading.stand_in.supports
        return read_wrist_loads(wrist_tables(table), loading.file, supports, loading.sensors[0], loading.inputs)
    return read_link_loads(link_tables(table), loading)


LOAD = LoadSection(
    key="load",
    type=Annotated[tuple[AnyLoad, ...], OneOrSeveral()] | None,
    default=None,
    description="What hangs on a wrist sensor, in place of a robot, or on a link of the robot; of several `[[load]]` "
    "an interval says which.",
    read=_read,
    empty=None,
    of_robot=False,
)
