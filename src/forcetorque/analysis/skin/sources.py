# SPDX-License-Identifier: BSD-3-Clause
"""The patches of an experiment as sources of known wrenches, and what readings of sensors are worth beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from forcetorque.analysis.runs.reading import Correction
from forcetorque.analysis.skin.wrench import PatchFrames, patch_frames
from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.estimation import Estimates
from forcetorque.estimation.uncertain import (
    OLDEST_S,
    SkinSource,
    UncertainEstimates,
    Uncertainty,
    frames_before,
    skin_sources,
)
from forcetorque.experiment import Experiment
from forcetorque.robot import Wrenches


def frames_of_patches(experiment: Experiment) -> tuple[PatchFrames, ...]:
    """Read what the patches say over the whole recording: their rest is at its beginning.

    Args:
        experiment: The experiment.

    Returns:
        Contacts of every patch that has a table; none where there is no skin.
    """
    skin = experiment.skin
    if skin is None:
        return ()
    return tuple(patch_frames(skin, patch.table, patch=patch.name) for patch in skin.patches if patch.table is not None)


def sources_at(experiment: Experiment, patches: Sequence[PatchFrames], at_ns: IntArray) -> tuple[SkinSource, ...]:
    """Give the contacts on skin at instants, each as the newest frame before has it.

    Args:
        experiment: The experiment.
        patches: What its patches say.
        at_ns: Instants; shape (n,); ns.

    Returns:
        A source for each contact.
    """
    return tuple(source for frames in patches for source in _sources(experiment, frames, at_ns))


def _sources(experiment: Experiment, frames: PatchFrames, at_ns: IntArray) -> Iterator[SkinSource]:
    patch, start_ns = frames.patch, experiment.recording.start_ns
    frame_ns = start_ns + np.array([np.rint(1e9 * middle) for middle, _, _ in frames.looked], dtype=np.int64)
    oldest_s = OLDEST_S if patch.oldest_s is None else patch.oldest_s
    rows = frames_before(frame_ns, at_ns, patch=patch.name, oldest_s=oldest_s)
    link = frames.skin.layout.frame if patch.link is None else patch.link
    contacts = [contacts for _, _, contacts in frames.looked]
    both = np.concatenate([rows, np.minimum(rows + 1, len(contacts) - 1)])
    now = np.arange(len(both)) < len(rows)
    for source in skin_sources(patch.name, link, contacts, both, friction=patch.friction):
        yield source.of_samples(now).on_the_way_to(source.of_samples(~now))


def uncertainty_of(
    experiment: Experiment,
    corrections: Mapping[str, Correction],
    sources: Sequence[SkinSource],
    measured: Wrenches,
    *,
    label: str,
) -> Uncertainty:
    """Say what skin and sensors err by: sensors as their calibration predicts at these readings.

    Args:
        experiment: The experiment.
        corrections: How its sensors are read.
        sources: Contacts on skin.
        measured: Readings; n samples.
        label: Label of the interval, for its session.

    Returns:
        Covariances; a sensor that no calibration with a posterior reads counts as exact.
    """
    sessions = experiment.session_names(label)
    return Uncertainty(
        measured={
            name: covariance
            for name, correction in corrections.items()
            if (covariance := _predicted(correction, measured.of_name(name), sessions)) is not None
        },
        known={source.contact.name: source.covariance for source in sources},
        tangents={source.contact.name: source.tangents for source in sources if source.tangents is not None},
    )


def _predicted(correction: Correction, readings: FloatArray, sessions: Sequence[str]) -> FloatArray | None:
    posterior = None if correction.calibration is None else correction.calibration.posterior
    if posterior is None:
        return None
    session = next((name for name in sessions if name in posterior.sessions), None)
    whole: BoolArray = np.all(np.isfinite(readings), axis=1)
    predicted = posterior.error_covariance(np.where(whole[:, None], readings, 0.0), session=session)
    return np.where(whole[:, None, None], predicted, np.nan)


def with_skin(plain: Estimates, answer: UncertainEstimates) -> Estimates:
    """Put what skin and sensors say together in place of what sensors say beside the push of the skin.

    Args:
        plain: Estimates in which skin has no friction and no error.
        answer: Estimates with both, of the same samples.

    Returns:
        The former with contacts and torques of the latter.
    """
    columns = [answer.contacts.index(name) for name in plain.layout.contacts]
    wrenches = np.ascontiguousarray(answer.contact_wrenches[:, columns])
    fields = {name: getattr(plain, name) for name in plain.layout.shapes(0)}
    fields |= {"contact_wrenches": wrenches, "torques": np.ascontiguousarray(answer.torques)}
    return Estimates(layout=plain.layout, **fields)
