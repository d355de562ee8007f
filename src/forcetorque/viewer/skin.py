# SPDX-License-Identifier: BSD-3-Clause
"""Patches of skin in a scene: pressures on their surface, and contacts with their uncertainty, over time."""

from __future__ import annotations

from collections.abc import Container
from typing import Final

import numpy as np

from forcetorque.analysis.skin.frames import AVERAGED
from forcetorque.analysis.skin.wrench import PatchFrames, patch_frames
from forcetorque.analysis.skin.wrench_choice import WrenchChoice
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import ExperimentPatch, PatchExperiment
from forcetorque.recording.alignment import usable_samples
from forcetorque.viewer.block import Block
from forcetorque.viewer.draft import SceneDraft
from forcetorque.viewer.scene import SkinPatch
from forcetorque.viewer.skin_contacts import contact_frames

MOST_PRESSURES: Final = 2_000_000
"""Pressures of a patch that a page holds, 8 MB: 17 minutes of 380 taxels at 50 Hz in means of 10 messages."""


def scene_skin(experiment: PatchExperiment, links: Container[str], draft: SceneDraft) -> tuple[SkinPatch, ...]:
    """Find pressures and contacts of every patch with a table, over the whole recording.

    Args:
        experiment: The patches.
        links: Links of the robot.
        draft: Takes the arrays, what is missing and where the rest comes from.

    Returns:
        The patches that can be shown.
    """
    shown = []
    for patch in experiment.patches:
        if patch.table is None:
            draft.notes.append(
                f"patch {patch.name!r} is not shown: [[patch]] states no table; skin calibrate makes one"
            )
            continue
        averaged = _averaged(experiment, patch)
        try:
            frames = patch_frames(experiment, patch.table, patch=patch.name, choice=WrenchChoice(averaged=averaged))
        except ForceTorqueError as error:
            draft.notes.append(f"patch {patch.name!r} is not shown: {error}")
            continue
        link = patch.link or frames.skin.layout.frame
        if link not in links:
            draft.notes.append(
                f"patch {patch.name!r} is not shown: the robot has no link {link!r}; state link in [[patch]]"
            )
            continue
        shown.append(_patch(patch.name, link, frames, _period_s(experiment, patch) * averaged, draft.block))
        draft.sources.append(f"{patch.name}: pressures and contacts by kriging, in means of {averaged} messages")
    return tuple(shown)


def _averaged(experiment: PatchExperiment, patch: ExperimentPatch) -> int:
    """Messages of a frame: more where a long log would fill the page."""
    messages = len(experiment.recording.stream(patch.counts))
    return max(AVERAGED, -(-messages * len(patch.taxels) // MOST_PRESSURES))


def _period_s(experiment: PatchExperiment, patch: ExperimentPatch) -> float:
    stamps = experiment.recording.stream(patch.counts).stamp_ns
    return 1e-9 * float(np.median(np.diff(stamps[usable_samples(stamps)])))


def _patch(name: str, link: str, frames: PatchFrames, hold_s: float, block: Block) -> SkinPatch:
    surface = frames.skin.surface
    middles = np.array([middle for middle, _, _ in frames.looked])
    pressure = np.array([np.where(c.contact >= 0, frame.pressures, 0.0) for _, frame, c in frames.looked])
    contacts = [contacts for _, _, contacts in frames.looked]
    return SkinPatch(
        name=name,
        link=link,
        vertices=block.add(frames.skin.layout.positions, "float32"),
        faces=block.add(surface.triangles, "uint32"),
        pressure=block.add(pressure.reshape(len(middles), -1), "float32"),
        largest_Pa=float(pressure.max(initial=0.0)),
        contacts=contact_frames(
            block,
            time_s=middles - 0.5 * hold_s,
            hold_s=hold_s,
            places=[one.centre_of_pressure for one in contacts],
            forces=[one.wrench[:, :3] for one in contacts],
            identities=[one.identity for one in contacts],
            covariances=[one.covariance[:, :3, :3] for one in contacts],
        ),
    )
