# SPDX-License-Identifier: BSD-3-Clause
"""What of a question can be answered from the joints that a log holds."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from forcetorque.errors import ExperimentError
from forcetorque.estimation import Contact, ContactType, Question, required_joints_of
from forcetorque.robot.sub_model import outboard_bodies


def narrowed(
    question: Question, available: Collection[str], *, required: Collection[str]
) -> tuple[Question, list[str]]:
    """Leave out what needs joints that are not there.

    A torque is left out too if a contact that it depends on is: it would be wrong without. Contacts whose wrench is
    known need no equation, and stay.

    Args:
        question: Everything that is wanted.
        available: Joints whose motion is known.
        required: Contacts that somebody asked for by name.

    Returns:
        What can be answered, and what was left out, in words.

    Raises:
        ExperimentError: If a required contact would be left out.
    """
    kept: list[Contact] = []
    solved, left_out = [], []
    for part in question.parts:
        inside = [contact for contact in question.contacts if question.body_of(contact) in part.bodies]
        missing = _missing(question, available, contacts=inside, equations=(part.name,))
        if not missing:
            kept += inside
            solved.append(part.name)
            continue
        asked = [contact.name for contact in inside if contact.name in required]
        if asked:
            raise ExperimentError(
                f"contact {asked[0]!r}: its sub-model {part.name!r} cannot be solved, {_words(missing)}"
            )
        known = [contact for contact in inside if contact.type is ContactType.KNOWN]
        kept += known
        names = ", ".join(contact.name for contact in inside if contact not in known) or "none"
        left_out.append(f"sub-model {part.name} with its contacts ({names}): {_words(missing)}")
    torques = [joint for joint in question.torques if not _missing_for_torque(question, available, kept, joint)]
    dropped = [joint for joint in question.torques if joint not in torques]
    if dropped:
        left_out.append(f"torques of {', '.join(dropped)}: joints, or contacts that act on them, are not known")
    expected = []
    for sensor in question.expected:
        missing = _missing(question, available, expected=(sensor,))
        if missing:
            left_out.append(f"expected readings of {sensor}: {_words(missing)}")
        else:
            expected.append(sensor)
    contacts = tuple(contact for contact in question.contacts if contact in kept)
    answerable = replace(
        question, contacts=contacts, equations=tuple(solved), torques=tuple(torques), expected=tuple(expected)
    )
    return answerable, left_out


def _missing_for_torque(question: Question, available: Collection[str], kept: list[Contact], joint: str) -> list[str]:
    body = next(index for index, body in enumerate(question.tree.bodies) if body.joint == joint)
    outboard = outboard_bodies(question.tree, body)
    acting = [c for c in question.contacts if c in kept or outboard[question.body_of(c)]]
    return _missing(question, available, contacts=acting, torques=(joint,))


def _missing(
    question: Question,
    available: Collection[str],
    *,
    contacts: Collection[Contact] = (),
    equations: tuple[str, ...] = (),
    torques: tuple[str, ...] = (),
    expected: tuple[str, ...] = (),
) -> list[str]:
    part = replace(question, contacts=tuple(contacts), equations=equations, torques=torques, expected=expected)
    return [joint for joint in required_joints_of(part) if joint not in available]


def _words(missing: list[str]) -> str:
    return f"no stream holds the joint(s) {', '.join(missing)}"
