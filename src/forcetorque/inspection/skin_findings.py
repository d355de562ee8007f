# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with the taxels of an experiment, as findings: one for each ailment, with the taxels that have it."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.base.errors import ForceTorqueError
from forcetorque.inspection.findings import inspect_recording
from forcetorque.recording.recording import Finding
from forcetorque.skin.experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.taxels.health import Ailment
from forcetorque.skin.taxels.recording import PatchRecording, patch_recordings

_NAMED = 12
"""Taxels that a message names; more are counted."""


def inspect_patches(experiment: PatchExperiment) -> tuple[Finding, ...]:
    """Look for what is wrong with a recording of skin, and with its taxels.

    Args:
        experiment: The experiment.

    Returns:
        Findings of the streams, then of the taxels in every interval with a pressure.
    """
    return (*inspect_recording(experiment.recording), *taxel_findings(experiment))


def taxel_findings(experiment: PatchExperiment) -> tuple[Finding, ...]:
    """Look for what is wrong with the taxels of an experiment.

    Args:
        experiment: The experiment.

    Returns:
        Findings of every interval with a pressure.
    """
    return tuple(finding for patch in experiment.patches for finding in _of_patch(experiment, patch))


def _of_patch(experiment: PatchExperiment, patch: ExperimentPatch) -> Iterator[Finding]:
    if patch.pressure is None:
        return
    start = experiment.recording.start_ns
    try:
        recordings = patch_recordings(experiment, patch)
    except ForceTorqueError as error:
        yield Finding(stream=patch.counts, kind="not_compared", message=f"no look at the taxels: {error}", count=0)
        return
    for recording in recordings:
        for ailment in Ailment:
            yield from _with(patch, recording, ailment, start)


def _with(patch: ExperimentPatch, recording: PatchRecording, ailment: Ailment, start: int) -> Iterator[Finding]:
    columns = [int(patch.taxels[k]) for k, reasons in enumerate(recording.ailments) if ailment in reasons]
    if columns:
        named = ", ".join(map(str, columns[:_NAMED])) + (", ..." if len(columns) > _NAMED else "")
        yield Finding(
            stream=patch.counts,
            kind=f"taxel_{ailment.name.lower()}",
            message=f"{patch.name}: {len(columns)} of {len(patch.taxels)} taxels in {recording.label!r}: {named}",
            count=len(columns),
            start_ns=start + round(1e9 * float(recording.seconds[0])),
            end_ns=start + round(1e9 * float(recording.seconds[-1])),
            size=float(len(columns)),
            unit="taxels",
        )
