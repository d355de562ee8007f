# SPDX-License-Identifier: BSD-3-Clause
"""Untouched parts of a robot by what of their joints was logged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

from forcetorque.estimation.part_equations import joints_of_cuts, joints_of_part, sensors_of
from forcetorque.experiment import Experiment
from forcetorque.robot import BodyTree
from forcetorque.robot.sub_model import SubModel


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoggedParts:
    """Parts that can be used, and why others cannot."""

    parts: tuple[SubModel, ...]
    """Parts whose joints were all logged."""
    weighed: tuple[SubModel, ...]
    """Parts that can be weighed at least: the joints between their sensors were logged."""
    left_out: tuple[str, ...]
    """What the others lack, in words."""

    @classmethod
    def of(cls, experiment: Experiment, parts: Sequence[SubModel], tree: BodyTree) -> Self:
        """Look for the joints of parts in a log.

        Args:
            experiment: The experiment.
            parts: The parts.
            tree: The robot that they are of.

        Returns:
            The same parts by what was logged.
        """
        available = set(experiment.recording.joint_signals("position"))
        logged, weighed, lacking = [], [], []
        for part in parts:
            missing = [joint for joint in joints_of_part(tree, part) if joint not in available]
            if not missing:
                logged.append(part)
            elif available.issuperset(joints_of_cuts(tree, part)):
                weighed.append(replace(part, name=f"weight on {', '.join(sensors_of(part))}"))
            else:
                lacking.append(f"part {part.name!r} needs the joint(s) {', '.join(missing)}, which the log lacks")
        return cls(parts=tuple(logged), weighed=tuple(weighed), left_out=tuple(lacking))

    @property
    def sensors(self) -> frozenset[str]:
        """Sensors that bound them."""
        return frozenset(name for part in (*self.parts, *self.weighed) for name in sensors_of(part))

    def joints(self, tree: BodyTree) -> tuple[str, ...]:
        """Name the joints whose motion they need.

        Args:
            tree: The robot that they are of.

        Returns:
            Joints, each once.
        """
        whole = (joint for part in self.parts for joint in joints_of_part(tree, part))
        cuts = (joint for part in self.weighed for joint in joints_of_cuts(tree, part))
        return tuple(dict.fromkeys((*whole, *cuts)))
