# SPDX-License-Identifier: BSD-3-Clause
"""Floating-point operations of a question per sample, counted from its plan.

Every addition, subtraction and multiplication of the formulas in `robot/compiled/recursion_and_vectors.py` counts as
one; that is also what the compiler's vector loops hold, with a multiply-add counted as two. Moving
data and marking gaps are not counted.
"""

from __future__ import annotations

from forcetorque.robot.compiled.plan import Plan, plan_of
from forcetorque.robot.mechanics.estimated_quantities import Question, needs_of

_ADD, _DOT, _CROSS, _ROTATE, _TURN_Z = 3, 5, 9, 15, 6
_SWING = _CROSS + 2 * _DOT + 4 * _ADD  # alpha x r + (omega . r) omega - (omega . omega) r
_ANGLES = 40  # reduction 8, polynomials 28, which quarter 4
_MOVE = (_ADD + _SWING + _ROTATE + _TURN_Z) + 2 * (_ROTATE + _TURN_Z) + 6
_NET_WRENCH = (2 * _ADD + _SWING) + 2 * (_ROTATE + _CROSS + _ADD)
_ACROSS = 2 * (_ROTATE + _TURN_Z) + _CROSS + _ADD  # a wrench across a joint
_SIX = 6  # a sum of two wrenches
_FRAME = 2 * _ROTATE + _CROSS + _ADD + 6  # a wrench to or from a frame of a body, times a sign


def operations_per_sample(question: Question) -> int:
    """Count the operations of a question whose sub-models all have one full wrench, on rotary joints.

    Args:
        question: The question.

    Returns:
        Floating-point operations per sample.

    Raises:
        ValueError: If it has prismatic joints or sub-models that are solved in the least squares.
    """
    plan, _ = plan_of(question, needs_of(question), frozenset())
    bodies, parts = plan.bodies, plan.parts
    if bodies.slides.any() or not parts.closed.all() or (parts.column >= 0).any():
        raise ValueError("expected rotary joints, one full wrench per sub-model, and no equations")
    moved = int((bodies.coordinate >= 0).sum())
    count = moved * (_ANGLES + _MOVE) + int(bodies.weighed.sum()) * _NET_WRENCH
    count += sum(_carry(plan, body) for body in plan.sums.expected)
    count += len(plan.expected_frames.body) * _FRAME
    if len(parts.base):
        count += len(plan.measured_frames.body) * (_FRAME + _SIX)
        count += sum(_carry(plan, body) for body in plan.sums.parts)
    for part in range(len(parts.base)):
        contact = parts.members[parts.first[part]]
        path = plan.contacts.path[contact]
        reading = _SIX if parts.reading[part] >= 0 else 0
        count += reading + _SIX + sum(_carry(plan, body) for body in path[path >= 0]) + _FRAME
    return count


def _carry(plan: Plan, body: int) -> int:
    """Take a wrench across what a body hangs on, and add it up."""
    return _SIX if plan.bodies.coordinate[body] < 0 else _ACROSS + _SIX
