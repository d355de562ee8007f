# SPDX-License-Identifier: BSD-3-Clause
"""The robots, the random motions and the questions that every part of the benchmark shares."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import icub_models
import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, moving_joints
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree
from forcetorque.robot.urdf import read_urdf

ROBOT = "iCubGazeboV2_7"
ROOT = "root_link"
TOUCHED = ("root_link", "l_hand", "r_hand", "l_lower_leg", "r_lower_leg", "l_sole", "r_sole")
"""One link per sub-model, each with a full unknown wrench."""
GRAVITY = 9.80665


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Problem:
    """A robot in random motion on a floating base."""

    urdf: Path
    """Its URDF."""
    model: RobotModel
    """The robot."""
    tree: BodyTree
    """The robot from its root link."""
    joints: JointMotion
    """Motion of all joints."""
    root: RootMotion
    """Motion of the root link."""
    readings: Wrenches
    """What the sensors read: the expected readings and noise, so that contacts carry something."""

    @property
    def sensors(self) -> tuple[str, ...]:
        """All sensors."""
        return tuple(self.tree.cuts)

    def expected_question(self, sensors: Sequence[str] | None = None) -> Question:
        """Ask for expected readings alone.

        Args:
            sensors: Which; all if None.

        Returns:
            The question.
        """
        return Question(tree=self.tree, expected=tuple(sensors or self.sensors), equations=())

    def contact_question(self) -> Question:
        """Ask for seven contact wrenches and all torques, and not for expected readings.

        Returns:
            The question.
        """
        contacts = tuple(Contact(link=link) for link in TOUCHED)
        joints = moving_joints(self.tree)
        return Question(tree=self.tree, measured=self.sensors, contacts=contacts, torques=joints, equations=())

    def base(self) -> FloatArray:
        """Stack the motion of the root link as peers want it.

        Returns:
            Proper acceleration, angular velocity, angular acceleration; shape (n, 9).
        """
        root = self.root
        return np.hstack([root.proper_acceleration, root.angular_velocity, root.angular_acceleration])


def icub_problem(samples: int) -> Problem:
    """Move the iCub at random.

    Args:
        samples: Number of samples.

    Returns:
        The problem.
    """
    urdf = Path(icub_models.get_model_file(ROBOT))
    model = read_urdf(urdf)
    return make_problem(urdf, model, build_tree(model, ROOT), samples)


def make_problem(urdf: Path, model: RobotModel, tree: BodyTree, samples: int) -> Problem:
    """Move a robot at random.

    Args:
        urdf: Its URDF.
        model: The robot.
        tree: The robot from its root link.
        samples: Number of samples.

    Returns:
        The problem, always with the same numbers.
    """
    rng = np.random.default_rng(1)
    names = moving_joints(tree)
    position, velocity, acceleration = (frozen(rng.uniform(-s, s, (samples, len(names)))) for s in (1.5, 2.0, 5.0))
    joints = JointMotion(names=names, position=position, velocity=velocity, acceleration=acceleration)
    root = RootMotion(
        proper_acceleration=frozen(rng.normal(scale=2.0, size=(samples, 3)) + [0.0, 0.0, GRAVITY]),
        angular_velocity=frozen(rng.normal(size=(samples, 3))),
        angular_acceleration=frozen(rng.normal(scale=3.0, size=(samples, 3))),
    )
    sensors = tuple(tree.cuts)
    question = Question(tree=tree, expected=sensors, equations=())
    expected = estimate(question, joints, root, evaluator=Evaluator.COMPILED).expected
    readings = Wrenches(names=sensors, values=frozen(expected + rng.normal(scale=5.0, size=expected.shape)))
    return Problem(urdf=urdf, model=model, tree=tree, joints=joints, root=root, readings=readings)


def frozen(values: FloatArray) -> FloatArray:
    """Make an array read-only, so that it is not copied again.

    Args:
        values: The array.

    Returns:
        The same array.
    """
    values.setflags(write=False)
    return values


class Ours:
    """Our answer to a question, into results that are used again in every round."""

    def __init__(self, problem: Problem, question: Question, *, samples: int | None = None) -> None:
        """Make room for the results.

        Args:
            problem: Robot and motion.
            question: What is asked.
            samples: Number of samples, the first ones; all if None.
        """
        block = slice(0, len(problem.joints) if samples is None else samples)
        root = problem.root
        self.question = question
        self.joints = problem.joints.samples(block)
        self.root = RootMotion(
            proper_acceleration=root.proper_acceleration[block],
            angular_velocity=root.angular_velocity[block],
            angular_acceleration=root.angular_acceleration[block],
        )
        self.measured = Wrenches(names=problem.readings.names, values=problem.readings.values[block])
        self.out = Estimates.empty(question.layout, block.stop)
        self.samples = block.stop

    def compiled(self, threads: int) -> None:
        """Answer with the compiled evaluator.

        Args:
            threads: Number of threads.
        """
        self._estimate(Evaluator.COMPILED, threads)

    def readable(self) -> None:
        """Answer with the readable evaluator."""
        self._estimate(Evaluator.READABLE, None)

    def _estimate(self, evaluator: Evaluator, threads: int | None) -> None:
        measured = self.measured if self.question.measured else None
        estimate(
            self.question,
            self.joints,
            self.root,
            measured=measured,
            out=self.out,
            evaluator=evaluator,
            threads=threads,
        )
