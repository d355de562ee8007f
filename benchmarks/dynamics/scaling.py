# SPDX-License-Identifier: BSD-3-Clause
"""Our time against the number of links and sensors, and against the number of samples of a task."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from unittest import mock

import icub_models

from benchmarks.dynamics.problem import ROOT, Ours, Problem, make_problem
from forcetorque.robot.compiled import run
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf

CHAIN_JOINTS = (4, 8, 16, 32, 64)
OTHER_ROBOTS = ("iCubGenova02", "iCubGenova03", "iCubLisboa01")
CHUNKS = (1024, 4096, 16384, 65536)

Task = tuple[int, Callable[[], object]]
"""Samples, and what to time."""


def by_links(folder: Path, samples: int) -> dict[str, Task]:
    """Expected readings of chains with one sensor at their base, and of other robots with all of theirs.

    Args:
        folder: Where the chains' URDFs go.
        samples: Number of samples.

    Returns:
        Tasks by name.
    """
    tasks: dict[str, Task] = {}
    for joints in CHAIN_JOINTS:
        urdf = folder / f"chain_{joints}.urdf"
        urdf.write_text(_chain(joints), encoding="utf-8")
        tasks[f"expected of 1 sensor, chain of {joints} joints"] = _expected(urdf, "base", samples)
    for name in OTHER_ROBOTS:
        urdf = Path(icub_models.get_model_file(name))
        tasks[f"expected of all sensors, {name}"] = _expected(urdf, ROOT, samples)
    return tasks


def by_sensors(problem: Problem, samples: int) -> dict[str, Task]:
    """Expected readings of one foot, and of one to six sensors, feet first.

    Args:
        problem: The iCub.
        samples: Number of samples.

    Returns:
        Tasks by name.
    """
    order = sorted(problem.sensors, key=lambda name: ("foot" not in name, "leg" not in name, name))
    tasks: dict[str, Task] = {}
    for count in range(1, len(order) + 1):
        ours = Ours(problem, problem.expected_question(order[:count]), samples=samples)
        tasks[f"expected of {count} sensors ({', '.join(order[:count])})"] = samples, partial(ours.compiled, 2)
    return tasks


def by_chunk(problem: Problem, samples: int) -> dict[str, Task]:
    """Expected readings of all sensors with tasks of different sizes.

    Args:
        problem: The iCub.
        samples: Number of samples.

    Returns:
        Tasks by name.
    """
    ours = Ours(problem, problem.expected_question(), samples=samples)

    def timed(chunk: int) -> None:
        with _chunk_size(chunk):
            ours.compiled(2)

    return {f"expected of 6 sensors, tasks of {chunk} samples": (samples, partial(timed, chunk)) for chunk in CHUNKS}


@contextmanager
def _chunk_size(samples: int) -> Iterator[None]:
    with mock.patch.object(run, "_CHUNK", samples):
        yield


def _expected(urdf: Path, root: str, samples: int) -> Task:
    model = read_urdf(urdf)
    tree = build_tree(model, root)
    problem = make_problem(urdf, model, tree, samples)
    ours = Ours(problem, Question(tree=tree, expected=problem.sensors, equations=()))
    return samples, partial(ours.compiled, 2)


def _chain(joints: int) -> str:
    """Give the URDF of a chain of equal links behind one sensor."""
    inertial = (
        "<inertial><origin xyz='0.01 0.02 0.1'/><mass value='1.5'/>"
        "<inertia ixx='0.02' ixy='0.001' ixz='0.002' iyy='0.03' iyz='0.001' izz='0.01'/></inertial>"
    )
    lines = ["<robot name='chain'>", f"<link name='base'>{inertial}</link>", f"<link name='link_0'>{inertial}</link>"]
    lines.append("<joint name='ft' type='fixed'><parent link='base'/><child link='link_0'/></joint>")
    for k in range(joints):
        axis = ("1 0 0", "0 1 0", "0 0 1")[k % 3]
        lines.append(f"<link name='link_{k + 1}'>{inertial}</link>")
        lines.append(
            f"<joint name='joint_{k}' type='continuous'><parent link='link_{k}'/><child link='link_{k + 1}'/>"
            f"<origin xyz='0.02 0 0.2' rpy='0.1 0.2 0.3'/><axis xyz='{axis}'/></joint>"
        )
    lines.append(
        "<sensor name='ft' type='force_torque'><parent joint='ft'/><force_torque><frame>child</frame>"
        "<measure_direction>child_to_parent</measure_direction></force_torque></sensor></robot>"
    )
    return "\n".join(lines)
