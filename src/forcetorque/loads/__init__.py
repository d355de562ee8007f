# SPDX-License-Identifier: BSD-3-Clause
"""Known loads: loads, biases and mounting of one sensor from readings under loads, in one estimation problem."""

from forcetorque.loads.expected import instants, load_wrench
from forcetorque.loads.guess import Guess
from forcetorque.loads.load import Load
from forcetorque.loads.open import spanned_directions
from forcetorque.loads.partly_known import MatrixSpread, settled
from forcetorque.loads.problem import LoadProblem
from forcetorque.loads.rows import LoadRows
from forcetorque.loads.solution import (
    BiasTest,
    DisagreeingRow,
    DriftChoice,
    Hypothesis,
    LoadEstimate,
    LoadSolution,
    OpenDirection,
    SessionEstimate,
    VariableEstimate,
)
from forcetorque.loads.solve import solve
from forcetorque.loads.together import together

__all__ = [
    "BiasTest",
    "DisagreeingRow",
    "DriftChoice",
    "Guess",
    "Hypothesis",
    "Load",
    "LoadEstimate",
    "LoadProblem",
    "LoadRows",
    "LoadSolution",
    "MatrixSpread",
    "OpenDirection",
    "SessionEstimate",
    "VariableEstimate",
    "instants",
    "load_wrench",
    "settled",
    "solve",
    "spanned_directions",
    "together",
]
