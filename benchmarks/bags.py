# SPDX-License-Identifier: BSD-3-Clause
"""Reading a topic of 50 000 messages from bags: our reader beside a loop that deserialises message by message.

Ratios are times of the loop divided by ours, so above 1 where we are faster: both read the same bag, in turn, and end
with the same array.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.formats.ros.bag import opened_bag
from forcetorque.formats.ros.topic_stream import topic_stream
from tests.formats.ros.bags import FORMS, Types, write_bag

MESSAGES = 50_000
JOINTS = [f"joint_{k}" for k in range(7)]
NONE = np.zeros(0)


def _ours(path: Path) -> np.ndarray:
    with opened_bag(path) as bag:
        stream, _ = topic_stream(bag, "/t", name="s", frame=None, world=None, joint_units={})
    return next(iter(stream.signals.values())).values


def _loop(path: Path, take: Callable[[Any], list[float]]) -> np.ndarray:
    store = get_typestore(Stores.ROS2_HUMBLE)
    rows = []
    with AnyReader([path], default_typestore=store) as reader:
        for connection, _, data in reader.messages():
            rows.append(take(reader.deserialize(data, connection.msgtype)))
    return np.array(rows)


def _wrench(message: Any) -> list[float]:
    force, torque = message.wrench.force, message.wrench.torque
    return [force.x, force.y, force.z, torque.x, torque.y, torque.z]


def _position(message: Any) -> list[float]:
    return list(message.position)


def _bag(folder: Path, form: str, kind: str, count: int) -> tuple[Path, Callable[[Any], list[float]]]:
    types, rng = Types(form), np.random.default_rng(1)
    (folder / kind).mkdir()
    if kind == "WrenchStamped":
        rows = rng.normal(size=(count, 6))
        messages = [types.wrench(k, row) for k, row in enumerate(rows)]
        return write_bag(folder / kind, form, {"/t": ("geometry_msgs/msg/WrenchStamped", messages)}), _wrench
    rows = rng.normal(size=(count, len(JOINTS)))
    messages = [types.joints(k, JOINTS, row, row, NONE) for k, row in enumerate(rows)]
    return write_bag(folder / kind, form, {"/t": ("sensor_msgs/msg/JointState", messages)}), _position


def main() -> None:
    """Time both on every form of bag, and write the ratios."""
    options = arguments(__doc__ or "")
    count, rounds = (2_000, 3) if options.quick else (MESSAGES, 6)
    ratios, seconds, equal = {}, {}, {}
    for kind in ("WrenchStamped", "JointState"):
        for form in FORMS:
            name = f"{kind} {form}"
            with tempfile.TemporaryDirectory() as folder:
                path, take = _bag(Path(folder), form, kind, count)
                tasks = {name: partial(_ours, path), f"{name} loop": partial(_loop, path, take)}
                equal[name] = bool(np.array_equal(_ours(path), _loop(path, take)))
                times = interleaved(tasks, rounds=rounds)
            seconds |= times
            ratios[f"{name}, loop"] = median_ratio(times[f"{name} loop"], times[name])
            ratios[f"{name}, loop, smallest"] = min(
                loop / ours for ours, loop in zip(times[name], times[f"{name} loop"], strict=True)
            )
    write_result(
        options.json,
        ratios=ratios,
        seconds=seconds,
        accuracy={"equal": equal},
        rounds=rounds,
        packages=("numpy", "rosbags"),
        figures={"messages": count},
    )


if __name__ == "__main__":
    main()
