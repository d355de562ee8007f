# SPDX-License-Identifier: BSD-3-Clause
"""Compile what the tests use, once: two workers that begin with it at the same time would both wait for all of it.

`python -m tests.compile_ahead`, which `make test` runs beside the checks that use one processor. What was compiled
before is only loaded.
"""

from __future__ import annotations

import numpy as np

from forcetorque.live.compiled_sample import compiled_sample
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.motion import RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.study.candidate_errors import candidate_errors
from tests.scenes.robots import random_motion

if __name__ == "__main__":
    model = read_urdf(ARM_URDF)
    estimate(
        Question(tree=build_tree(model, "base"), expected=tuple(model.sensors)),
        random_motion(model, samples=1, seed=0),
        RootMotion.fixed([0.0, 0.0, -1.0]),
        evaluator=Evaluator.COMPILED,
    )
    candidate_errors(
        np.zeros((1, 6)), np.zeros((1, 6)), np.zeros((1, 6, 6)), np.zeros((1, 6)), evaluator=Evaluator.COMPILED
    )
    compiled_sample()
