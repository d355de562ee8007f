# SPDX-License-Identifier: BSD-3-Clause
"""First result of a new process: with nothing compiled before, and from the compiled copy on disk."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile


def start_seconds(repeats: int) -> dict[str, list[float]]:
    """Measure whole programs that read a robot and give ten samples of expected readings, imports included.

    Args:
        repeats: Number of programs that compile, and of programs that find the copy.

    Returns:
        Processor seconds by name.
    """
    cold, cached = [], []
    for _ in range(repeats):
        with tempfile.TemporaryDirectory() as folder:
            cold.append(_run(folder))
            cached.append(_run(folder))
    return {"first answer, nothing compiled before, s": cold, "first answer, compiled copy on disk, s": cached}


def _run(folder: str) -> float:
    environment = os.environ | {"NUMBA_CACHE_DIR": folder}
    with subprocess.Popen([sys.executable, "-m", "benchmarks.dynamics.start"], env=environment) as run:
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode:
        raise SystemExit(f"benchmarks.dynamics.start: exit code {run.returncode}")
    return usage.ru_utime + usage.ru_stime


def _first_result() -> None:
    import icub_models
    import numpy as np

    from forcetorque.robot.mechanics.estimate import Evaluator, estimate
    from forcetorque.robot.mechanics.estimated_quantities import Question
    from forcetorque.robot.motion import JointMotion, RootMotion
    from forcetorque.robot.tree import build_tree
    from forcetorque.robot.urdf import read_urdf

    tree = build_tree(read_urdf(icub_models.get_model_file("iCubGazeboV2_7")), "root_link")
    names = tuple(body.joint for body in tree.bodies if body.joint)
    joints = JointMotion.at_rest(names, np.zeros((10, len(names))))
    question = Question(tree=tree, expected=tuple(tree.cuts), equations=())
    estimate(question, joints, RootMotion.fixed([0, 0, -1]), evaluator=Evaluator.COMPILED)


if __name__ == "__main__":
    _first_result()
