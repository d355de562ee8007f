# SPDX-License-Identifier: BSD-3-Clause
"""What is said about the skin of an experiment: the contacts on every patch that states a table."""

from __future__ import annotations

from forcetorque.analysis.skin.wrench import SkinWrench, skin_wrench
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import PatchExperiment


def assess_skin(patches: PatchExperiment | None) -> tuple[tuple[SkinWrench, ...], tuple[str, ...]]:
    """Find the contacts on every patch of an experiment.

    Args:
        patches: The patches; None without any.

    Returns:
        Contacts of every patch that has a table, and sentences about the others.
    """
    answers, left_out = [], []
    for patch in () if patches is None else patches.patches:
        if patches is None or patch.table is None:
            left_out.append(f"{patch.name}: [[patch]] states no table, which `forcetorque skin calibrate` makes")
            continue
        try:
            answers.append(skin_wrench(patches, patch.table, patch=patch.name))
        except ForceTorqueError as error:
            left_out.append(f"{patch.name}: {error}")
    return tuple(answers), tuple(left_out)
