# SPDX-License-Identifier: BSD-3-Clause
"""The layout in which Foxglove opens the bag of a scene, which a bag itself cannot hold.

References:
[1] foxglove/studio (MPL-2.0), packages/studio-base/src/providers/CurrentLayoutProvider/defaultLayout.ts: panels by
    `TYPE!ID` in `configById`, and a binary tree of them in `layout`.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TypeAlias

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.viewer.mcap_file import ARROWS, DESCRIPTION, EVENTS, colour_of
from forcetorque.viewer.viewer_log import LoggedWrench, ViewerLog

Panels: TypeAlias = dict[str, dict[str, object]]
Node: TypeAlias = str | dict[str, object]

_SCENE, _EVENTS, _TABS = "3D!scene", "RosOut!events", "Tab!wrenches"
_HALVES = {"force": (slice(0, 3), "N"), "torque": (slice(3, 6), "N m")}
_INFORMATION = 2
"""Lowest level of messages that the panel of events shows: that of intervals."""


def layout_file(mcap: Path) -> Path:
    """Name the file of the layout.

    Args:
        mcap: File of the bag.

    Returns:
        `x.foxglove.json` beside `x.mcap`.
    """
    return mcap.with_suffix(".foxglove.json")


def write_layout(mcap: Path, log: ViewerLog) -> None:
    """Write the layout beside its bag.

    Args:
        mcap: File of the bag.
        log: What the bag holds.
    """
    write_bytes_atomically(layout_file(mcap), json.dumps(foxglove_layout(log), indent=1).encode())


def foxglove_layout(log: ViewerLog) -> dict[str, object]:
    """Lay out a log: the robot with arrows, forces and moments of every sensor over time, their errors, and events.

    Args:
        log: The log.

    Returns:
        The layout, as JSON has it.
    """
    panels: Panels = {_SCENE: _scene(log)}
    tabs = [{"title": title, "layout": _plots(title, wrenches, panels)} for title, wrenches in log.plots()]
    right: list[tuple[Node, float]] = []
    if tabs:
        panels[_TABS] = {"activeTabIdx": 0, "tabs": tabs}
        right.append((_TABS, 80.0))
    if log.events:
        panels[_EVENTS] = {"topicToRender": EVENTS, "minLogLevel": _INFORMATION, "searchTerms": []}
        right.append((_EVENTS, 20.0))
    layout: Node = _SCENE
    if right:
        layout = _divided("row", layout, _column([node for node, _ in right], right[0][1]), 40.0)
    return {
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": layout,
    }


def _scene(log: ViewerLog) -> dict[str, object]:
    known = {DESCRIPTION: log.urdf is not None, ARROWS: any(True for _ in log.arrows())}
    return {
        "followMode": "follow-none",
        "followTf": log.world,
        "scene": {"transforms": {"showLabel": False, "axisScale": 0.3}},
        "topics": {topic: {"visible": True} for topic, is_there in known.items() if is_there},
        "layers": {"grid": {"layerId": "foxglove.Grid", "instanceId": "grid", "visible": True, "frameId": log.world}},
    }


def _plots(title: str, wrenches: Sequence[LoggedWrench], panels: Panels) -> Node:
    """Plots of forces and moments, one above the other."""
    names = []
    for half, (columns, unit) in _HALVES.items():
        name = f"Plot!{title.replace(': ', '_')}_{half}"
        paths = [
            {
                "value": f"/{wrench.name}.wrench.{half}.{axis}",
                "label": f"{component} {wrench.name}",
                "color": colour_of(wrench.kind, number),
                "enabled": True,
                "timestampMethod": "receiveTime",
            }
            for number, wrench in enumerate(wrenches)
            for axis, component in zip("xyz", WRENCH_COMPONENTS[columns], strict=True)
        ]
        panels[name] = {
            "title": f"{title}: {half}, {unit}",
            "paths": paths,
            "yAxisLabel": unit,
            "xAxisVal": "timestamp",
            "isSynced": True,
            "showLegend": True,
            "legendDisplay": "floating",
        }
        names.append(name)
    return _column(names, 50.0)


def _column(nodes: Sequence[Node], share: float) -> Node:
    """One node, or two with one above the other."""
    if len(nodes) == 1:
        return nodes[0]
    first, second = nodes
    return _divided("column", first, second, share)


def _divided(direction: str, first: Node, second: Node, share: float) -> Node:
    return {"direction": direction, "first": first, "second": second, "splitPercentage": share}
