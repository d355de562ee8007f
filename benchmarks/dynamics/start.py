# SPDX-License-Identifier: BSD-3-Clause
"""First answer of a new process: with nothing compiled before, and from the compiled copy on disk."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time

_PROGRAM = """
import time
start = time.perf_counter()
import icub_models
from forcetorque.robot.mechanics import Estimates, Evaluator, Question, estimate
from forcetorque.robot import JointMotion, RootMotion, build_tree, read_urdf
import numpy as np
tree = build_tree(read_urdf(icub_models.get_model_file("iCubGazeboV2_7")), "root_link")
names = tuple(body.joint for body in tree.bodies if body.joint)
joints = JointMotion.at_rest(names, np.zeros((10, len(names))))
question = Question(tree=tree, expected=tuple(tree.cuts), equations=())
estimate(question, joints, RootMotion.fixed([0, 0, -1]), evaluator=Evaluator.COMPILED)
print(time.perf_counter() - start)
"""


def start_seconds(repeats: int) -> dict[str, list[float]]:
    """Time whole programs that read a robot and give ten samples of expected readings, imports included.

    Args:
        repeats: Number of programs that compile, and of programs that find the copy.

    Returns:
        Seconds by name.
    """
    cold, cached = [], []
    for _ in range(repeats):
        with tempfile.TemporaryDirectory() as folder:
            cold.append(_run(folder))
            cached.append(_run(folder))
    return {"first answer, nothing compiled before, s": cold, "first answer, compiled copy on disk, s": cached}


def _run(folder: str) -> float:
    environment = os.environ | {"NUMBA_CACHE_DIR": folder}
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", _PROGRAM], check=True, env=environment, capture_output=True)
    return time.perf_counter() - start
