# SPDX-License-Identifier: BSD-3-Clause
"""Skin without a robot: the links that it is on, side by side, as nobody says where they are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import numpy as np

from forcetorque.experiment import schema
from forcetorque.experiment.inputs import Inputs
from forcetorque.recording import Recording
from forcetorque.robot import Joint, JointType, RobotModel
from forcetorque.spatial import Inertia, make_pose

BESIDE_M: Final = 0.4
"""From one link to the next: limbs of a humanoid do not touch; m."""
ROOT: Final = "side by side"
"""Link in place of a robot."""


def skin_frames_of(parsed: schema.ExperimentFile, recording: Recording, inputs: Inputs) -> tuple[str, ...]:
    """Name the links that patches and contacts of a skinManager are on.

    Args:
        parsed: Content of the experiment file.
        recording: The recording.
        inputs: Keeps track of the files that are read.

    Returns:
        Each of them once.
    """
    return tuple(dict.fromkeys((*_of_patches(parsed.patch, inputs), *_of_events(recording))))


def _of_patches(patches: Iterable[schema.Patch], inputs: Inputs) -> Iterator[str]:
    from forcetorque.exchange.skin import describe_patch  # here because most experiments have no skin

    for patch in patches:
        link = patch.link
        if link is None and patch.layout is not None:
            link = describe_patch(inputs.file(patch.layout)).frame
        if link:
            yield link


def _of_events(recording: Recording) -> Iterator[str]:
    for stream in recording.streams.values():
        frame = stream.signals["skin_event"].frame if "skin_event" in stream.signals else None
        if frame:
            yield frame


def links_side_by_side(links: Iterable[str]) -> RobotModel:
    """Make a model of links that nothing is known of.

    Args:
        links: Their names.

    Returns:
        Links without mass, each fixed to a root.
    """
    names = tuple(links)
    joints = {
        name: Joint(
            name=name,
            type=JointType.FIXED,
            parent=ROOT,
            child=name,
            parent_H_child=make_pose(np.eye(3), np.array([BESIDE_M * place, 0.0, 0.0])),
            axis=np.array([1.0, 0.0, 0.0]),  # a fixed joint has none
        )
        for place, name in enumerate(names)
    }
    masses = {name: Inertia.zero() for name in (ROOT, *names)}
    return RobotModel(name="links side by side, no robot", links=masses, joints=joints, sensors={})


def is_skin_alone(model: RobotModel) -> bool:
    """Tell links side by side from a robot.

    Args:
        model: A robot.

    Returns:
        Whether `links_side_by_side` made it.
    """
    return model.root_link == ROOT
