# SPDX-License-Identifier: BSD-3-Clause
"""Findings on the recording of an experiment, of a long one segment by segment, so that it does not fill the memory."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.long_recording import forget_recording, joined_findings, recorded_segments
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.recording.recording import Finding


def inspect_segments(
    experiment: Experiment,
    *,
    calibrations: Mapping[str, Calibration] | None = None,
    sensors: Collection[str] | None = None,
    progress: Progress = lambda _: None,
) -> tuple[Finding, ...]:
    """Find faults of the recording of an experiment, of a long one in one segment after the other.

    Args:
        experiment: The experiment.
        calibrations: As of `inspect_experiment`.
        sensors: As of `inspect_experiment`.
        progress: As of `inspect_experiment`.

    Returns:
        Findings as of `inspect_experiment`; what was found in some segments alone says so.
    """
    segments = recorded_segments(experiment)
    if len(segments) == 1:
        return inspect_experiment(experiment, calibrations=calibrations, sensors=sensors, progress=progress)
    time_left = TimeLeft(progress, f"inspecting {experiment.name}", len(segments))
    forget_recording(experiment)  # which was looked at as it was read
    findings: list[Sequence[Finding]] = []
    for segment in segments:
        part = replace(experiment, recording=segment.recording)
        findings.append(inspect_experiment(part, calibrations=calibrations, sensors=sensors))
        del part
        forget_recording(experiment)
        time_left.at(len(findings))
    return joined_findings(segments, findings)
