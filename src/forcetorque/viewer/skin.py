# SPDX-License-Identifier: BSD-3-Clause
"""Patches of skin in a scene: pressures, contacts with their uncertainty, events of a skinManager."""

from __future__ import annotations

from collections.abc import Container, Sequence
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.recording.alignment import gap_limit_ns, seconds_since, usable_samples
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.skin.contact.contact_tracking import followed_places
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.wrench.pressures_over_recording import AVERAGED
from forcetorque.skin.wrench.skin_wrench import PatchFrames, WrenchChoice, patch_frames
from forcetorque.viewer.scene import SkinContactFrames, SkinEventSeries, SkinPatch
from forcetorque.viewer.scene_arrays import Block, SceneDraft


def contact_frames(
    block: Block,
    *,
    time_s: FloatArray,
    hold_s: float,
    places: Sequence[FloatArray],
    forces: Sequence[FloatArray],
    identities: Sequence[IntArray],
    covariances: Sequence[FloatArray] | None = None,
) -> SkinContactFrames:
    """Put the contacts of k frames into the block of a scene.

    Args:
        block: Takes the arrays.
        time_s: Start of each frame; shape (k,); s.
        hold_s: How long a frame is shown; s.
        places: Centres of pressure in each frame; shape (c, 3); m.
        forces: What the contacts do to the link, or a heuristic of it; shape (c, 3).
        identities: Numbers that contacts keep; shape (c,).
        covariances: Covariances of the forces; shape (c, 3, 3); N^2; None where nobody knows them.

    Returns:
        Where the arrays are.
    """
    first = np.concatenate([[0], np.cumsum([len(place) for place in places])])
    spread = None if covariances is None else half_axes(np.concatenate([np.zeros((0, 3, 3)), *covariances]))
    return SkinContactFrames(
        time_s=block.add(time_s, "float64"),
        hold_s=hold_s,
        first=block.add(first, "uint32"),
        place=block.add(np.concatenate([np.zeros((0, 3)), *places]), "float32"),
        force=block.add(np.concatenate([np.zeros((0, 3)), *forces]), "float32"),
        spread=None if spread is None else block.add(spread.reshape(-1, 9), "float32"),
        identity=block.add(np.concatenate([np.zeros(0, dtype=np.int64), *identities]), "uint32"),
    )


def half_axes(covariances: FloatArray) -> FloatArray:
    """Give the half axes of the ellipsoids of one standard deviation.

    Args:
        covariances: Covariances; shape (m, 3, 3); NaN where unknown.

    Returns:
        Matrices A whose columns are the half axes, A A^T = covariance; shape (m, 3, 3).
    """
    known = np.isfinite(covariances).all(axis=(1, 2))
    axes = np.full(covariances.shape, np.nan)
    variances, directions = np.linalg.eigh(covariances[known])
    axes[known] = directions * np.sqrt(np.maximum(variances, 0.0))[:, None, :]
    return axes


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
                f"patch {patch.name!r} is not shown: [[patch]] states no table; make one by `forcetorque skin "
                'calibrate` and state it there, as table = "FILE.json"'
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
    middles = np.array([middle for middle, _, _ in frames.read.frames])
    pressure = np.array([np.where(c.contact >= 0, frame.pressures, 0.0) for _, frame, c in frames.read.frames])
    contacts = [contacts for _, _, contacts in frames.read.frames]
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


MOST_MESSAGES: Final = 50_000
"""Messages of a stream that a page holds: 17 minutes at 50 Hz; of longer logs one in so many."""


def scene_skin_events(
    recording: Recording, clock: str, links: Container[str], draft: SceneDraft
) -> tuple[SkinEventSeries, ...]:
    """Collect the contacts of every stream of skin events.

    Args:
        recording: The recording.
        clock: Clock of what is shown besides.
        links: Links of the robot.
        draft: Takes the arrays, and what is missing.

    Returns:
        The streams of that clock whose frame the robot has.
    """
    shown = []
    for stream in recording.streams.values():
        if "skin_event" not in stream.signals:
            continue
        frame = stream.signal("skin_event").frame or ""
        if stream.clock != clock:
            draft.notes.append(
                f"contacts of {stream.name!r} are not shown: their clock is {stream.clock!r}, not {clock!r}"
            )
            continue
        if frame not in links:
            draft.notes.append(f"contacts of {stream.name!r} are not shown: the robot has no link {frame!r}")
            continue
        shown.append(_series(stream, frame, recording.start_ns, draft.block))
        draft.notes.append(f"contacts of {stream.name!r}: their arrows are the skinManager's heuristic, not newtons")
    return tuple(shown)


def _series(stream: Stream, frame: str, start_ns: int, block: Block) -> SkinEventSeries:
    signal = stream.signal("skin_event")
    rows = usable_samples(stream.stamp_ns)
    rows = rows[:: -(-len(rows) // MOST_MESSAGES)]
    places, heuristics = _vectors(signal, "pressed")[rows], _vectors(signal, "heuristic")[rows]
    seen: BoolArray = np.logical_and.reduce(np.isfinite(places), axis=2)
    times = seconds_since(stream.stamp_ns[rows], start_ns)
    pressed = [place[one] for place, one in zip(places, seen, strict=True)]
    return SkinEventSeries(
        name=stream.name,
        link=frame,
        contacts=contact_frames(
            block,
            time_s=times,
            hold_s=1e-9 * gap_limit_ns(stream.stamp_ns[rows]),
            places=pressed,
            forces=[heuristic[one] for heuristic, one in zip(heuristics, seen, strict=True)],
            identities=followed_places(times, pressed),
        ),
    )


def _vectors(signal: Signal, name: str) -> FloatArray:
    """Vectors of a name; of every message and of as many contacts as a message has at most; shape (n, slots, 3)."""
    slots = dict.fromkeys(column.partition(".")[0] for column in signal.columns)
    columns = [signal.columns.index(f"{slot}.{name}_{axis}") for slot in slots for axis in "xyz"]
    return signal.values[:, columns].reshape(len(signal.values), len(slots), 3)
